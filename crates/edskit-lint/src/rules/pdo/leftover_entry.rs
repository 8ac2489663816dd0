use crate::pdos::Target;
use crate::rule::rule;
use crate::{Context, Report};

rule! {
    /// A mapping entry is set, but not counted
    ///
    /// ## What it does
    /// Reports entries other than 0 and dummies behind those that sub-index 00h of a mapping parameter counts. A sub-index 00h of
    /// 0, a mapping that is switched off, may have entries.
    ///
    /// ## Why is this bad
    /// The entries map nothing. Either the number is too small, or they are left over from an older mapping.
    ///
    /// ## Example
    /// ```eds
    /// [1A00]
    /// ParameterName=TPDO 1 mapping parameter
    /// ObjectType=0x9
    /// SubNumber=3
    ///
    /// [1A00sub0]
    /// DataType=0x0005
    /// DefaultValue=1
    ///
    /// [1A00sub1]
    /// DataType=0x0007
    /// DefaultValue=0x22000010
    ///
    /// [1A00sub2]
    /// DataType=0x0007
    /// DefaultValue=0x22010010
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1A00]
    /// ParameterName=TPDO 1 mapping parameter
    /// ObjectType=0x9
    /// SubNumber=3
    ///
    /// [1A00sub0]
    /// DataType=0x0005
    /// DefaultValue=2
    ///
    /// [1A00sub1]
    /// DataType=0x0007
    /// DefaultValue=0x22000010
    ///
    /// [1A00sub2]
    /// DataType=0x0007
    /// DefaultValue=0x22010010
    /// ```
    ///
    /// ## References
    /// Engineering judgement: the device ignores the entries, but a reader of the file wonders.
    pub(crate) static LEFTOVER_ENTRY = {
        code: "PDO012",
        name: "leftover-entry",
        group: Pdo,
        severity: Info,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for pdo in context.pdos() {
        let Some(count) = pdo.mapped_count().filter(|count| *count > 0) else { continue };
        let mut set =
            pdo.leftover().iter().filter(|entry| !matches!(entry.target, Target::Zero | Target::Dummy));
        let Some(first) = set.next() else { continue };
        let last = set.next_back().unwrap_or(first);
        let which = if first.sub_index == last.sub_index {
            format!("entry {} of {pdo} is set", first.sub_index.0)
        } else {
            format!("entries {} to {} of {pdo} are set", first.sub_index.0, last.sub_index.0)
        };
        let are = if count == 1 { "is" } else { "are" };
        let finding = report.add(first.value.span(), format!("{which}, but only {count} {are} mapped"));
        if let Some(value) = pdo.count {
            finding.label(value.span(), "the number of mapped entries");
        }
        finding.help(format!("write {} there, or 0 here", last.sub_index.0));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    fn found(count: &str) -> Vec<String> {
        let mut text = format!("[1600]\nObjectType=9\n[1600sub0]\nDataType=5\nDefaultValue={count}\n");
        for (sub, entry) in ["0x20000010", "0x20010010", "0", "0x20020010", "0x00050008"].iter().enumerate() {
            text += &format!("[1600sub{}]\nDataType=7\nDefaultValue={entry}\n", sub + 1);
        }
        findings(&LEFTOVER_ENTRY, &text)
    }

    #[test]
    fn a_mapping_that_is_off_may_have_entries() {
        assert_eq!(found("1"), ["11:14 info: entries 2 to 4 of RPDO1 are set, but only 1 is mapped"]);
        assert_eq!(found("3"), ["17:14 info: entry 4 of RPDO1 is set, but only 3 are mapped"]);
        assert!(found("0").is_empty() && found("4").is_empty() && found("").is_empty());
    }
}
