use super::structure::belongs_elsewhere;
use super::words::is_are;
use crate::edits::number_like;
use crate::rule::rule;
use crate::wording::count;
use crate::{Context, Edit, Report};
use edskit_model::{KeyName, Object, Section, SectionKind};

rule! {
    /// A list of compact sub-objects does not fit its object
    ///
    /// ## What it does
    /// Looks at the lists `[xxxxName]`, `[xxxxValue]` and `[xxxxDenotation]`. It reports an `NrOfEntries` that is
    /// missing or is not the number of listed entries, a sub-index above `CompactSubObj`, and a list whose object is
    /// not described or has no `CompactSubObj`. A list may leave sub-indexes out.
    ///
    /// ## Why is this bad
    /// Some readers stop after `NrOfEntries` entries, so names and values are lost. A sub-index that does not exist
    /// has neither.
    ///
    /// ## Example
    /// ```dcf
    /// [2010]
    /// ParameterName=Ramp
    /// ObjectType=0x8
    /// DataType=0x0006
    /// AccessType=rw
    /// CompactSubObj=5
    ///
    /// [2010Value]
    /// NrOfEntries=3
    /// 2=100
    /// 4=250
    /// ```
    ///
    /// ## Use instead
    /// ```dcf
    /// [2010]
    /// ParameterName=Ramp
    /// ObjectType=0x8
    /// DataType=0x0006
    /// AccessType=rw
    /// CompactSubObj=5
    ///
    /// [2010Value]
    /// NrOfEntries=2
    /// 2=100
    /// 4=250
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.6.3.4.2 and 5.3.3.2.
    pub(crate) static COMPACT_LIST_MISMATCH = {
        code: "OBJ017",
        name: "compact-list-mismatch",
        group: Objects,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [
            CanChkEds("40"), Dcfchk("invalid entry in"), Dcfchk("too many entries in"),
            Dcfchk("too few entries in"), Dcfchk("object not defined"), Dcfchk("invalid sub-index"),
            Dcfchk("object does not support compact storage"), Dcfchk("NrOfEntries entry missing"),
        ],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for section in context.sheet.other_sections() {
        if let SectionKind::CompactNames(index)
        | SectionKind::CompactValues(index)
        | SectionKind::CompactDenotations(index) = section.kind()
        {
            check_count(section, report);
            match context.sheet.object(index) {
                None => {
                    report
                        .add(
                            section.span(),
                            format!("`[{}]` belongs to {index}, which is not described", section.name()),
                        )
                        .help(format!("describe {index} with `CompactSubObj`, or leave the list out"));
                }
                Some(object) => check_keys(section, object, report),
            }
        }
    }
}

/// Either way of counting is right: with or without entries that have no value.
fn check_count(section: Section<'_>, report: &mut Report) {
    let listed = section.all_numbered(KeyName::Item).count();
    let filled = section.all_numbered(KeyName::Item).filter(|entry| !entry.is_empty()).count();
    let Some(entry) = section.filled(KeyName::NrOfEntries) else {
        report
            .add(section.span(), format!("`[{}]` has no NrOfEntries", section.name()))
            .help(format!("write `NrOfEntries={filled}`"));
        return;
    };
    let field = entry.unsigned::<u16>();
    let Some(claimed) = field.known().map(usize::from) else { return };
    if claimed == listed || claimed == filled {
        return;
    }
    let number = number_like(filled as u64, entry.raw());
    let entries = if filled == 1 { "1 entry".to_owned() } else { format!("{filled} entries") };
    let message = format!("NrOfEntries is {}, but {entries} {} listed", field.text(), is_are(filled));
    report
        .add(field.span(), message)
        .help(format!("write `NrOfEntries={number}`"))
        .unsafe_fix("Write the number of listed entries", vec![Edit::replace(field.span(), number)]);
}

fn check_keys(section: Section<'_>, object: Object<'_>, report: &mut Report) {
    let Some(compact) = object.compact_sub_obj() else {
        report
            .add(
                section.span(),
                format!(
                    "`[{}]` lists sub-indexes, but {} has no CompactSubObj",
                    section.name(),
                    object.index()
                ),
            )
            .label(object.section().span(), "its sub-objects are described one by one")
            .help("write names, values and denotations into the sub-objects' own sections");
        return;
    };
    if belongs_elsewhere(compact.entry) {
        return;
    }
    let Some(last) = compact.known() else { return };
    let is_beyond = |number: u16| number == 0 || number > u16::from(last);
    let mut beyond = section.all_numbered(KeyName::Item).filter(|entry| is_beyond(entry.key().number));
    let Some(first) = beyond.next() else { return };
    let more = beyond.count();
    let key = first.key_text();
    let message = if first.key().number == 0 {
        format!("`{key}` is no sub-index of the list, which begins with 1")
    } else {
        format!("`{key}` is above CompactSubObj, which is {}", compact.text())
    };
    let finding = report.add(first.key_span(), message);
    finding.label(compact.span(), format!("the last compact sub-index is {last}"));
    if more > 0 {
        finding.here(format!("and {} more", count(more, "key")));
    }
    finding.help("keys are the sub-indexes in decimal, from 1 to CompactSubObj");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings_in, fixed};

    fn findings(text: &str) -> Vec<String> {
        findings_in(&COMPACT_LIST_MISMATCH, "test.dcf", text.as_bytes())
    }

    const OBJECT: &str = "[2000]\nObjectType=8\nCompactSubObj=3\n";

    #[test]
    fn entries_are_counted_with_or_without_empty_ones() {
        for number in ["1", "2", "0x2"] {
            assert_eq!(findings(&format!("{OBJECT}[2000Name]\nNrOfEntries={number}\n1=a\n3=\n")), [""; 0]);
        }
        assert_eq!(
            findings(&format!("{OBJECT}[2000Name]\nNrOfEntries=3\n1=a\n3=\n")),
            ["5:13 warning: NrOfEntries is 3, but 1 entry is listed"]
        );
        assert_eq!(
            findings(&format!("{OBJECT}[2000Denotation]\n1=a\n")),
            ["4:1 warning: `[2000Denotation]` has no NrOfEntries"]
        );
        let text = format!("{OBJECT}[2000Value]\nNrOfEntries=0x04\n1=1\n2=2\n");
        assert_eq!(fixed(&COMPACT_LIST_MISMATCH, &text), text.replace("0x04", "0x02"));
    }

    #[test]
    fn keys_are_sub_indexes() {
        assert_eq!(
            findings(&format!("{OBJECT}[2000Name]\nNrOfEntries=2\n4=a\n5=b\n")),
            ["6:1 warning: `4` is above CompactSubObj, which is 3"]
        );
        assert_eq!(
            findings(&format!("{OBJECT}[2000Name]\nNrOfEntries=1\n0=a\n")),
            ["6:1 warning: `0` is no sub-index of the list, which begins with 1"]
        );
    }

    #[test]
    fn the_object_must_be_compact() {
        assert_eq!(
            findings("[2000]\nObjectType=8\n[2000Value]\nNrOfEntries=0\n[2001Value]\nNrOfEntries=0\n"),
            [
                "3:1 warning: `[2000Value]` lists sub-indexes, but 2000h has no CompactSubObj",
                "5:1 warning: `[2001Value]` belongs to 2001h, which is not described"
            ]
        );
    }
}
