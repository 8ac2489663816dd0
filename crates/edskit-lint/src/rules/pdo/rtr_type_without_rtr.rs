use crate::rule::rule;
use crate::{Context, Report};
use edskit_types::Transmission;

rule! {
    /// A TPDO is sent on remote request only, but does not allow remote requests
    ///
    /// ## What it does
    /// Reports a TPDO with transmission type 252 or 253 whose COB-ID has bit 30 set, which means that no RTR is
    /// allowed.
    ///
    /// ## Why is this bad
    /// The TPDO can never be sent.
    ///
    /// ## Example
    /// ```eds
    /// [1800]
    /// ParameterName=TPDO 1 communication parameter
    /// ObjectType=0x9
    /// SubNumber=3
    ///
    /// [1800sub1]
    /// ParameterName=COB-ID
    /// DataType=0x0007
    /// DefaultValue=$NODEID+0x40000180
    ///
    /// [1800sub2]
    /// ParameterName=Transmission type
    /// DataType=0x0005
    /// DefaultValue=253
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1800]
    /// ParameterName=TPDO 1 communication parameter
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
    /// DefaultValue=253
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.5.2.37.
    pub(crate) static RTR_TYPE_WITHOUT_RTR = {
        code: "PDO011",
        name: "rtr-type-without-rtr",
        group: Pdo,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for pdo in context.pdos() {
        if !matches!(pdo.transmission(), Some(Transmission::RtrSynchronous | Transmission::RtrEvent)) {
            continue;
        }
        let (Some(kind), Some(cob_id)) = (pdo.transmission_type, pdo.cob_id) else { continue };
        if !pdo.cob_id_bits().is_some_and(|bits| bits.bit30()) {
            continue;
        }
        let number: u8 = kind.constant().unwrap_or_default();
        report
            .add(
                kind.span(),
                format!("{pdo} is sent on request only (type {number}), but its COB-ID forbids requests"),
            )
            .label(cob_id.span(), "bit 30 (40000000h) says that no RTR is allowed")
            .help("clear bit 30 of the COB-ID, or choose another transmission type");
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    fn found(cob_id: &str, kind: &str) -> Vec<String> {
        let text = format!(
            "[1800]\nObjectType=9\n[1800sub1]\nDataType=7\nDefaultValue={cob_id}\n[1800sub2]\nDataType=5\nDefaultValue={kind}\n"
        );
        findings(&RTR_TYPE_WITHOUT_RTR, &text)
    }

    #[test]
    fn bit_30_forbids_requests() {
        assert_eq!(
            found("$NODEID+0x40000180", "252"),
            ["8:14 warning: TPDO1 is sent on request only (type 252), but its COB-ID forbids requests"]
        );
        assert_eq!(found("0xC0000180", "0xFD").len(), 1);
        assert!(found("0x40000180", "254").is_empty() && found("0x80000180", "253").is_empty());
        assert!(found("", "253").is_empty());
    }
}
