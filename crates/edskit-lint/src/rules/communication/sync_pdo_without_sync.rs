use crate::evaluate::{Effective, node_ids};
use crate::rule::rule;
use crate::{Context, Report};
use edskit_types::{CobId, Index, PdoDirection, TransmissionType};

rule! {
    /// A synchronous PDO waits for a SYNC message that the device does not know
    ///
    /// ## What it does
    /// Reports a valid PDO with a synchronous transmission type (0 to 240, and 252 for a TPDO) in a file without 1005h. There is
    /// one finding for the file, at the first such PDO.
    ///
    /// ## Why is this bad
    /// 1005h says which message is the SYNC message. A device with synchronous PDOs has it; without it a master cannot set up
    /// the SYNC message for the device.
    ///
    /// ## Example
    /// ```eds
    /// [1800]
    /// ParameterName=TPDO communication parameter
    /// ObjectType=0x9
    /// SubNumber=3
    ///
    /// [1800sub1]
    /// ParameterName=COB-ID
    /// DataType=0x0007
    /// DefaultValue=$NODEID+0x180
    ///
    /// [1800sub2]
    /// ParameterName=Transmission type
    /// DataType=0x0005
    /// DefaultValue=1
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1005]
    /// ParameterName=COB-ID SYNC
    /// DataType=0x0007
    /// AccessType=rw
    /// DefaultValue=0x80
    ///
    /// [1800]
    /// ParameterName=TPDO communication parameter
    /// ObjectType=0x9
    /// SubNumber=3
    ///
    /// [1800sub1]
    /// ParameterName=COB-ID
    /// DataType=0x0007
    /// DefaultValue=$NODEID+0x180
    ///
    /// [1800sub2]
    /// ParameterName=Transmission type
    /// DataType=0x0005
    /// DefaultValue=1
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.5.2.5.
    pub(crate) static SYNC_PDO_WITHOUT_SYNC = {
        code: "COM017",
        name: "sync-pdo-without-sync",
        group: Communication,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    if context.sheet.object(Index::SYNC_COB_ID).is_some() {
        return;
    }
    let directions = [(PdoDirection::Receive, "RPDO"), (PdoDirection::Transmit, "TPDO")];
    let mut waiting = directions.into_iter().flat_map(|(direction, noun)| {
        context.sheet.pdos(direction).filter_map(move |pdo| {
            let communication = pdo.communication?;
            let is_valid =
                Effective::of(communication, 1)?.cob_id_at(node_ids(context).next()?).map(CobId::is_valid)?;
            let value = Effective::of(communication, 2)?;
            let transmission_type = TransmissionType(value.constant()?);
            let is_waiting = is_valid && transmission_type.is_synchronous(direction);
            is_waiting.then(|| (value, format!("{noun}{}", pdo.number), transmission_type))
        })
    });
    let Some((value, name, transmission_type)) = waiting.next() else { return };
    let others = match waiting.count() {
        0 => String::new(),
        1 => ", as one other PDO does".to_owned(),
        count => format!(", as {count} other PDOs do"),
    };
    report
        .add(value.span(), format!("{name} waits for the SYNC message{others}, but 1005h does not exist"))
        .here(format!("transmission type {transmission_type} is synchronous"))
        .help("describe 1005h, the COB-ID of the SYNC message, or write 254 for an event-driven PDO");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    fn pdo(index: &str, cob_id: &str, transmission_type: u8) -> String {
        format!(
            "[{index}]\nObjectType=9\n[{index}sub1]\nDataType=7\nDefaultValue={cob_id}\n[{index}sub2]\nDataType=5\nDefaultValue={transmission_type}\n"
        )
    }

    #[test]
    fn only_valid_synchronous_pdos_count() {
        let found = |pdos: &[String]| findings(&SYNC_PDO_WITHOUT_SYNC, &pdos.concat());
        assert!(found(&[pdo("1400", "0x80000000", 1), pdo("1800", "$NODEID+0x180", 253)]).is_empty());
        assert_eq!(
            found(&[pdo("1400", "0x80000000", 1), pdo("1800", "$NODEID+0x180", 252)]),
            ["16:14 warning: TPDO1 waits for the SYNC message, but 1005h does not exist"]
        );
        assert_eq!(
            found(&[pdo("1401", "0x201", 0), pdo("1800", "$NODEID+0x180", 1), pdo("1801", "0x281", 240)]),
            ["8:14 warning: RPDO2 waits for the SYNC message, as 2 other PDOs do, but 1005h does not exist"]
        );
        assert!(found(&[pdo("1400", "0x201", 0), "[1005]\n".to_owned()]).is_empty());
    }
}
