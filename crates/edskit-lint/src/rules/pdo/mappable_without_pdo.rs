use crate::pdos::noun;
use crate::rule::rule;
use crate::{Context, Report};
use edskit_model::Field;
use edskit_types::{AccessType, Index, PdoDirection};

rule! {
    /// Objects can be mapped, but there is no PDO that could carry them
    ///
    /// ## What it does
    /// Reports `PDOMapping=1` at an object that only a TPDO can carry (`ro`, `rwr`, `const`) where the device has no
    /// TPDO, at one that only an RPDO can carry (`wo`, `rww`) where it has no RPDO, and at any where it has no PDO at
    /// all. There is one finding for each direction, at the first such object.
    ///
    /// ## Why is this bad
    /// The object promises something that the device cannot do, or the PDO is missing in the file.
    ///
    /// ## Example
    /// ```eds
    /// [DeviceInfo]
    /// NrOfRXPDO=0
    /// NrOfTXPDO=0
    ///
    /// [2200]
    /// ParameterName=Speed actual value
    /// DataType=0x0006
    /// AccessType=ro
    /// PDOMapping=1
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [DeviceInfo]
    /// NrOfRXPDO=0
    /// NrOfTXPDO=0
    ///
    /// [2200]
    /// ParameterName=Speed actual value
    /// DataType=0x0006
    /// AccessType=ro
    /// PDOMapping=0
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.6.3.2.
    pub(crate) static MAPPABLE_WITHOUT_PDO = {
        code: "PDO017",
        name: "mappable-without-pdo",
        group: Pdo,
        severity: Info,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("61")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    if context.is_modular() {
        return;
    }
    let has = |direction| has_pdo(context, direction);
    let (receives, transmits) = (has(PdoDirection::Receive), has(PdoDirection::Transmit));
    if receives && transmits {
        return;
    }
    let mut receive_only = Promises::default();
    let mut transmit_only = Promises::default();
    let mut any = Promises::default();
    let subs = context.sheet.sub_objects().map(|sub| (sub.index(), sub.description()));
    let objects = context.sheet.objects().map(|object| (object.index(), object.description()));
    for (index, description) in objects.chain(subs) {
        let Some(flag) = description.pdo_mapping().filter(|flag| flag.known() == Some(true)) else {
            continue;
        };
        match description.access() {
            Some(AccessType::Ro | AccessType::Rwr | AccessType::Const) if !transmits => {
                transmit_only.add(index, flag)
            }
            Some(AccessType::Wo | AccessType::Rww) if !receives => receive_only.add(index, flag),
            Some(AccessType::Rw) if !receives && !transmits => any.add(index, flag),
            _ => {}
        }
    }
    transmit_only.report(noun(PdoDirection::Transmit), report);
    receive_only.report(noun(PdoDirection::Receive), report);
    any.report("PDO", report);
}

/// Whether the file describes, counts or implies a PDO.
fn has_pdo(context: &Context<'_>, direction: PdoDirection) -> bool {
    let counted = || {
        let count = context.sheet.device_info().and_then(|info| info.pdo_count(direction));
        count.is_some_and(|count| count.known() != Some(0))
    };
    context.pdos().iter().any(|pdo| pdo.direction == direction) || counted()
}

/// Objects that promise what no PDO keeps.
#[derive(Default)]
struct Promises<'a> {
    count: usize,
    first: Option<(Index, Field<'a, bool>)>,
}

impl<'a> Promises<'a> {
    fn add(&mut self, index: Index, flag: Field<'a, bool>) {
        self.count += 1;
        if self.first.is_none_or(|(_, first)| flag.span() < first.span()) {
            self.first = Some((index, flag));
        }
    }

    fn report(&self, noun: &str, report: &mut Report) {
        let Some((index, flag)) = self.first else { return };
        let others = match self.count {
            1 => String::new(),
            count => format!(" and {} more", count - 1),
        };
        report
            .add(flag.span(), format!("{index}{others} can be mapped, but the device has no {noun}"))
            .help(format!("describe the {noun}s, or write `PDOMapping=0`"));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    fn object(index: &str, access: &str) -> String {
        format!("[{index}]\nDataType=6\nAccessType={access}\nPDOMapping=1\n")
    }

    #[test]
    fn each_direction_is_asked_for() {
        let text =
            object("2000", "ro") + &object("2001", "rww") + &object("2002", "rwr") + &object("2003", "rw");
        assert_eq!(
            findings(&MAPPABLE_WITHOUT_PDO, &text),
            [
                "4:12 info: 2000h and 1 more can be mapped, but the device has no TPDO",
                "8:12 info: 2001h can be mapped, but the device has no RPDO",
                "16:12 info: 2003h can be mapped, but the device has no PDO"
            ]
        );
        assert_eq!(findings(&MAPPABLE_WITHOUT_PDO, &format!("{text}[1800]\n[1A00]\n")).len(), 1);
        assert!(findings(&MAPPABLE_WITHOUT_PDO, &format!("{text}[1800]\n[1600]\n")).is_empty());
        let counted = "[DeviceInfo]\nNrOfRXPDO=1\nNrOfTXPDO=x\n";
        assert!(findings(&MAPPABLE_WITHOUT_PDO, &format!("{text}{counted}")).is_empty());
        assert!(
            findings(&MAPPABLE_WITHOUT_PDO, &format!("{text}[SupportedModules]\nNrOfEntries=1\n")).is_empty()
        );
    }
}
