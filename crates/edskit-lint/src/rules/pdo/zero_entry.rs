use crate::pdos::{DescribedPdo, Target};
use crate::rule::rule;
use crate::{Context, Report, Severity};
use edskit_model::{DictionaryEntry, KeyName};
use edskit_types::SubIndex;

rule! {
    /// A counted mapping entry is 0 or has no value
    ///
    /// ## What it does
    /// Reports an entry of 0 among those that sub-index 00h of a mapping parameter counts, and one that is described
    /// there without a value. It is a warning where there is no value, where the PDO is not in use, and where all of
    /// them are 0: then sub-index 00h may stand for the room for entries.
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
        without_value(pdo, report);
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

/// Reports the counted entries that exist and have no value, in the compact form too.
fn without_value(pdo: &DescribedPdo<'_>, report: &mut Report) {
    let (Some(mapping), Some(count), Some(number)) = (pdo.mapping, pdo.count, pdo.mapped_count()) else {
        return;
    };
    let has_value = |entry: &DictionaryEntry<'_>| match entry.description() {
        Some(description) => {
            let keys = [KeyName::ParameterValue, KeyName::DefaultValue];
            keys.into_iter().any(|key| description.filled(key).is_some())
        }
        None => entry.value_field().is_some(),
    };
    let counted = (1..=number).filter_map(|sub_index| mapping.dictionary_entry(SubIndex(sub_index)));
    let empty: Vec<_> = counted.filter(|entry| !has_value(entry)).collect();
    let (Some(first), Some(last)) = (empty.first(), empty.last()) else { return };
    let which = match (first.sub_index.0, last.sub_index.0) {
        (first, last) if first == last => format!("entry {last} of {pdo} has"),
        (first, last) if usize::from(last - first) + 1 == empty.len() => {
            format!("entries {first} to {last} of {pdo} have")
        }
        (first, last) => format!("{} entries of {pdo} between {first} and {last} have", empty.len()),
    };
    // An entry of the compact form has no section: its count says that it is there.
    let place = first.description().map_or(count.span(), |description| description.span());
    let finding = report.add(place, format!("{which} no value, but the mapping has {number}"));
    // The device may have a value that the file does not know.
    finding.severity(Severity::Warning);
    if place != count.span() {
        finding.label(count.span(), "the number of mapped entries");
    }
    let used = first.sub_index.0 - 1;
    finding.help(match first.description() {
        Some(_) => format!("write {used} there, or name an object here"),
        None => format!("name an object for each entry in `[{:04X}Value]`", first.index.0),
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, findings_in};

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
    fn what_is_counted_needs_a_value() {
        for cob_id in ["0x205", "0x80000205"] {
            assert_eq!(
                found(cob_id, "4", &["", "", "", ""]),
                ["11:1 warning: entries 1 to 4 of RPDO1 have no value, but the mapping has 4"]
            );
        }
        assert_eq!(
            found("0x205", "2", &["0x20000010", ""]),
            ["14:1 warning: entry 2 of RPDO1 has no value, but the mapping has 2"]
        );
        assert!(found("0x205", "1", &["0x20000010", ""]).is_empty());
        let transmit =
            "[1A00]\nObjectType=9\n[1A00sub0]\nDataType=5\nDefaultValue=1\n[1A00sub1]\nDataType=7\n";
        assert_eq!(
            findings(&ZERO_ENTRY, transmit),
            ["6:1 warning: entry 1 of TPDO1 has no value, but the mapping has 1"]
        );
        let configured = format!("{transmit}ParameterValue=0x20000010\n");
        assert_eq!(findings_in(&ZERO_ENTRY, "a.dcf", configured.as_bytes()), [""; 0]);
    }

    #[test]
    fn the_compact_form_is_as_the_long_one() {
        let compact = |values: &str| {
            format!(
                "[1600]\nObjectType=9\nDataType=7\nAccessType=rw\nCompactSubObj=4\n{values}[6040]\nDataType=6\n"
            )
        };
        let list = |items: &str| compact(&format!("[1600Value]\nNrOfEntries=4\n{items}"));
        for (text, which) in [
            (compact(""), "entries 1 to 4 of RPDO1 have"),
            (list("1=0x60400010\n2=0x60400010\n3=\n"), "entries 3 to 4 of RPDO1 have"),
            (list("1=0x60400010\n3=0x60400010\n4=0x60400010\n"), "entry 2 of RPDO1 has"),
            (list("1=0x60400010\n3=0x60400010\n"), "2 entries of RPDO1 between 2 and 4 have"),
        ] {
            assert_eq!(
                findings(&ZERO_ENTRY, &text),
                [format!("5:15 warning: {which} no value, but the mapping has 4")]
            );
            let transmit = text.replace("1600", "1A00");
            assert_eq!(
                findings(&ZERO_ENTRY, &transmit),
                [format!("5:15 warning: {} no value, but the mapping has 4", which.replace("RPDO", "TPDO"))]
            );
            assert_eq!(findings_in(&ZERO_ENTRY, "a.dcf", text.as_bytes()).len(), 1);
        }
        let all = list("1=0x60400010\n2=0x60400010\n3=0x60400010\n4=0x60400010\n");
        assert_eq!(findings(&ZERO_ENTRY, &all), [""; 0]);
        let by_default = compact("").replace("CompactSubObj", "DefaultValue=0x60400010\nCompactSubObj");
        assert_eq!(findings(&ZERO_ENTRY, &by_default), [""; 0]);
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
