use crate::pdos::{self, DescribedPdo, Mapped, Target};
use crate::rule::rule;
use crate::{Context, Report, Severity};
use edskit_types::PdoDirection;

rule! {
    /// An object is mapped twice
    ///
    /// ## What it does
    /// Reports an object that stands twice in the mapping of one PDO, and as an information one that stands in the
    /// mappings of two RPDOs that are both in use; profiles such as CiA 402 define several RPDOs of which a master uses
    /// one. Two TPDOs may carry the same object.
    ///
    /// ## Why is this bad
    /// Two places of an RPDO, or two RPDOs, write the same object, and which value stays depends on the order in which
    /// the device unpacks or receives them. Twice in a TPDO is a waste, and mostly a slip.
    ///
    /// ## Example
    /// ```eds
    /// [1600]
    /// ParameterName=RPDO 1 mapping parameter
    /// ObjectType=0x9
    /// SubNumber=3
    ///
    /// [1600sub0]
    /// DataType=0x0005
    /// DefaultValue=2
    ///
    /// [1600sub1]
    /// DataType=0x0007
    /// DefaultValue=0x22000010
    ///
    /// [1600sub2]
    /// DataType=0x0007
    /// DefaultValue=0x22000010
    ///
    /// [2200]
    /// ParameterName=Speed
    /// DataType=0x0006
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1600]
    /// ParameterName=RPDO 1 mapping parameter
    /// ObjectType=0x9
    /// SubNumber=3
    ///
    /// [1600sub0]
    /// DataType=0x0005
    /// DefaultValue=1
    ///
    /// [1600sub1]
    /// DataType=0x0007
    /// DefaultValue=0x22000010
    ///
    /// [2200]
    /// ParameterName=Speed
    /// DataType=0x0006
    /// ```
    ///
    /// ## References
    /// Engineering judgement: CiA 301 does not forbid it, but leaves open which value counts.
    pub(crate) static DOUBLE_MAPPING = {
        code: "PDO014",
        name: "double-mapping",
        group: Pdo,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for pdo in context.pdos() {
        check_pdo(context, pdo, report);
    }
    check_receivers(context, report);
}

/// What an entry maps: index and sub-index. The length is the matter of PDO005.
fn object(context: &Context<'_>, mapped: &Mapped<'_>) -> Option<u32> {
    let is_object = match mapped.target {
        Target::Entry(_) => true,
        // An object that no section describes is the matter of PDO004, but for one that a module brings.
        Target::NoObject => context.is_modular(),
        _ => false,
    };
    is_object.then_some(mapped.entry.0 >> 8)
}

fn place(context: &Context<'_>, mapped: &Mapped<'_>) -> String {
    match mapped.target {
        Target::Entry(entry) => pdos::place_of(context.sheet, entry),
        _ => mapped.entry.to_string(),
    }
}

/// Looks for an object that stands twice in one mapping.
fn check_pdo(context: &Context<'_>, pdo: &DescribedPdo<'_>, report: &mut Report) {
    for (position, mapped) in pdo.mapped().iter().enumerate() {
        let Some(key) = object(context, mapped) else { continue };
        let first = pdo.mapped()[..position].iter().find(|first| object(context, first) == Some(key));
        let Some(first) = first else { continue };
        report
            .add(mapped.value.span(), format!("{pdo} maps {} twice", place(context, mapped)))
            .here(format!("entry {}", mapped.sub_index.0))
            .label(first.value.span(), format!("entry {}", first.sub_index.0))
            .help("map another object in one of the two places");
    }
}

/// Looks for objects that two RPDOs in use write.
fn check_receivers(context: &Context<'_>, report: &mut Report) {
    let mut written: Vec<(u32, &DescribedPdo<'_>, &Mapped<'_>)> = Vec::new();
    for pdo in context.pdos().iter().filter(|pdo| pdo.direction == PdoDirection::Receive) {
        if pdo.is_valid() == Some(true) {
            let entries = pdo.mapped().iter();
            written.extend(entries.filter_map(|mapped| Some((object(context, mapped)?, pdo, mapped))));
        }
    }
    // A stable sort keeps the PDOs of one object in order.
    written.sort_by_key(|(key, ..)| *key);
    for same in written.chunk_by(|(a, ..), (b, ..)| a == b) {
        let [(_, other, first), rest @ ..] = same else { continue };
        for (_, pdo, mapped) in rest.iter().filter(|(_, pdo, _)| pdo.number != other.number) {
            report
                .add(mapped.value.span(), format!("{pdo} and {other} both write {}", place(context, mapped)))
                .severity(Severity::Info)
                .here(format!("entry {} of {pdo}", mapped.sub_index.0))
                .label(first.value.span(), format!("entry {} of {other}", first.sub_index.0))
                .help("take it out of one of the two, or switch one of them off with bit 31 of its COB-ID");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    fn pdo(communication: u16, cob_id: &str, entries: &[&str]) -> String {
        let mapping = communication + 0x200;
        let mut text = format!(
            "[{communication:X}]\nObjectType=9\n[{communication:X}sub1]\nDataType=7\nDefaultValue={cob_id}\n\
             [{mapping:X}]\nObjectType=9\n[{mapping:X}sub0]\nDataType=5\nDefaultValue={}\n",
            entries.len()
        );
        for (sub, entry) in entries.iter().enumerate() {
            text += &format!("[{mapping:X}sub{}]\nDataType=7\nDefaultValue={entry}\n", sub + 1);
        }
        text
    }

    const OBJECT: &str = "[6040]\nDataType=6\n";

    #[test]
    fn two_rpdos_that_write_one_object() {
        let first = pdo(0x1400, "$NODEID+0x200", &["0x60400010"]);
        let second = |cob_id| format!("{first}{}{OBJECT}", pdo(0x1401, cob_id, &["0x60400010"]));
        assert_eq!(
            findings(&DOUBLE_MAPPING, &second("$NODEID+0x300")),
            ["26:14 info: RPDO2 and RPDO1 both write 6040h"]
        );
        assert!(findings(&DOUBLE_MAPPING, &second("$NODEID+0x80000300")).is_empty());
        let sent =
            pdo(0x1800, "$NODEID+0x180", &["0x60400010"]) + &pdo(0x1801, "$NODEID+0x280", &["0x60400010"]);
        assert!(findings(&DOUBLE_MAPPING, &(sent + OBJECT)).is_empty());
    }

    #[test]
    fn twice_in_one_pdo() {
        let text = pdo(0x1800, "$NODEID+0x180", &["0x60400010", "0x60400008"]) + OBJECT;
        assert_eq!(findings(&DOUBLE_MAPPING, &text), ["16:14 warning: TPDO1 maps 6040h twice"]);
        let unknown = pdo(0x1800, "$NODEID+0x180", &["0x60000108", "0x60000108"]);
        assert!(findings(&DOUBLE_MAPPING, &unknown).is_empty(), "PDO004");
        assert_eq!(findings(&DOUBLE_MAPPING, &(unknown + "[M1ModuleInfo]\n")).len(), 1);
        let dummies = pdo(0x1400, "$NODEID+0x200", &["0x00050008", "0x00050008", "0", "0"]);
        assert!(findings(&DOUBLE_MAPPING, &dummies).is_empty());
    }
}
