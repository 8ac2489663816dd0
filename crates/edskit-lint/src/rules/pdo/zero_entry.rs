use crate::pdos::Target;
use crate::rule::rule;
use crate::{Context, Report, Severity};

rule! {
    /// A counted mapping entry is 0
    ///
    /// ## What it does
    /// Reports an entry of 0 among those that sub-index 00h of a mapping parameter counts. It is a warning where the
    /// PDO is not in use, and where all of them are 0: then sub-index 00h may stand for the room for entries.
    ///
    /// ## Why is this bad
    /// The entry names no object. Devices refuse such a mapping, and tools stop decoding the PDO there.
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
    /// DefaultValue=2
    ///
    /// [1A00sub1]
    /// DataType=0x0007
    /// DefaultValue=0x22000010
    ///
    /// [1A00sub2]
    /// DataType=0x0007
    /// DefaultValue=0
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
    /// DefaultValue=1
    ///
    /// [1A00sub1]
    /// DataType=0x0007
    /// DefaultValue=0x22000010
    ///
    /// [1A00sub2]
    /// DataType=0x0007
    /// DefaultValue=0
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.5.2.36 and 7.5.2.38.
    pub(crate) static ZERO_ENTRY = {
        code: "PDO013",
        name: "zero-entry",
        group: Pdo,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("11")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for pdo in context.pdos() {
        let mut zeros = pdo.mapped().iter().filter(|entry| matches!(entry.target, Target::Zero));
        let (Some(first), Some(count)) = (zeros.next(), pdo.count) else { continue };
        let last = zeros.next_back().unwrap_or(first);
        let number: u8 = count.constant().unwrap_or_default();
        let which = if first.sub_index == last.sub_index {
            format!("entry {} of {pdo} is 0", first.sub_index.0)
        } else {
            format!("entries {} to {} of {pdo} are 0", first.sub_index.0, last.sub_index.0)
        };
        let used = pdo.mapped().iter().rposition(|entry| !matches!(entry.target, Target::Zero));
        let used = used.map_or(0, |position| pdo.mapped()[position].sub_index.0);
        let finding = report.add(first.value.span(), format!("{which}, but the mapping has {number}"));
        if used == 0 || pdo.is_valid() != Some(true) {
            finding.severity(Severity::Warning);
        }
        finding.label(count.span(), "the number of mapped entries");
        if used < first.sub_index.0 {
            finding.help(format!("write {used} there, or name an object here"));
        } else {
            finding.help("name an object here, or move the entries behind it up");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    fn found(cob_id: &str, count: &str, entries: &[&str]) -> Vec<String> {
        let mut text = format!(
            "[1400]\nObjectType=9\n[1400sub1]\nDataType=7\nDefaultValue={cob_id}\n[1600]\nObjectType=9\n[1600sub0]\nDataType=5\nDefaultValue={count}\n"
        );
        for (sub, entry) in entries.iter().enumerate() {
            text += &format!("[1600sub{}]\nDataType=7\nDefaultValue={entry}\n", sub + 1);
        }
        findings(&ZERO_ENTRY, &text)
    }

    #[test]
    fn only_what_is_counted_must_name_something() {
        assert_eq!(
            found("0x80000200", "2", &["0x20000010", "0x0"]),
            ["16:14 warning: entry 2 of RPDO1 is 0, but the mapping has 2"]
        );
        assert_eq!(
            found("0x205", "3", &["0", "0", "0"]),
            ["13:14 warning: entries 1 to 3 of RPDO1 are 0, but the mapping has 3"]
        );
        assert_eq!(
            found("0x205", "2", &["0x20000010", "0"]),
            ["16:14 error: entry 2 of RPDO1 is 0, but the mapping has 2"]
        );
        assert!(
            found("0x205", "1", &["0x20000010", "0"]).is_empty() && found("0x205", "", &["0"]).is_empty()
        );
    }
}
