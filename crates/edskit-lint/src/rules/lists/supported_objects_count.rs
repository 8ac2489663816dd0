use super::edits;
use crate::listing::{Item, List};
use crate::rule::rule;
use crate::wording::count;
use crate::{Context, Report};
use edskit_model::{KeyName, Section};
use std::collections::HashSet;

rule! {
    /// SupportedObjects is missing, or is not the number of objects in the list
    ///
    /// ## What it does
    /// Compares `SupportedObjects` of each list with the number of its items that have a value.
    ///
    /// ## Why is this bad
    /// Readers ask for the items 1 to `SupportedObjects`. If it is too small, they miss the last objects without a
    /// word; if it is too large, they stop with an error. Without the entry they know nothing of the list.
    ///
    /// ## Example
    /// ```eds
    /// [OptionalObjects]
    /// SupportedObjects=3
    /// 1=0x1005
    /// 2=0x1017
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [OptionalObjects]
    /// SupportedObjects=2
    /// 1=0x1005
    /// 2=0x1017
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.6.3.1.
    pub(crate) static SUPPORTED_OBJECTS_COUNT = {
        code: "LST002",
        name: "supported-objects-count",
        group: Lists,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [
            CanChkEds("5"), EdsDcfCheck("LST001"), EdsDcfCheck("LIB001"),
            Dcfchk("SupportedObjects entry missing"), Dcfchk("too many entries in"),
        ],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for list in List::ALL {
        if let Some(section) = list.section(context.sheet) {
            check_list(context, list, section, report);
        }
    }
}

fn check_list(context: &Context<'_>, list: List, section: Section<'_>, report: &mut Report) {
    let items = context.listing().items_of(list);
    let listed = items.len();
    let (span, message) = match section.entry(KeyName::SupportedObjects) {
        None => (section.span(), format!("`[{}]` has no `SupportedObjects`", list.name())),
        Some(entry) if entry.is_empty() => {
            (entry.span(), format!("`SupportedObjects` of `[{}]` is empty", list.name()))
        }
        Some(entry) => {
            let Some(claimed) = entry.unsigned::<u16>().known() else { return };
            if usize::from(claimed) == listed || is_explained(items, claimed) {
                return;
            }
            let what = if listed == 0 { "no object".to_owned() } else { count(listed, "object") };
            let message = format!("`SupportedObjects` is {claimed}, but `[{}]` lists {what}", list.name());
            (entry.value_span(), message)
        }
    };
    let finding = report.add(span, message);
    if let Some(last) = items.last() {
        finding.label(last.span(context.document()), "the last item");
    }
    if let Some(empty) = section.all_numbered(KeyName::Item).find(|entry| entry.is_empty()) {
        finding.label(empty.span(), "empty, which counts as missing");
    }
    finding
        .help(format!("write `SupportedObjects={listed}`"))
        .unsafe_fix(format!("Write {listed}"), edits::count(context, section, listed).into_iter().collect());
}

/// Whether another rule tells why the numbers differ.
fn is_explained(items: &[Item], claimed: u16) -> bool {
    let numbers: HashSet<u16> = items.iter().filter_map(Item::number).collect();
    // A doubled key is the matter of SYN014, a gap before the last item that of LST003.
    let is_doubled = numbers.len() == usize::from(claimed);
    let has_gap = numbers.iter().max() == Some(&claimed) && numbers.len() < usize::from(claimed);
    is_doubled || has_gap
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn the_number_of_items_counts() {
        let text = "[MandatoryObjects]\nSupportedObjects=0\n1=0x1000\n[OptionalObjects]\nSupportedObjects=2\n1=0x1005\n2=\n[ManufacturerObjects]\nSupportedObjects=0x01\n1=0x2000\n";
        assert_eq!(
            findings(&SUPPORTED_OBJECTS_COUNT, text),
            [
                "2:18 error: `SupportedObjects` is 0, but `[MandatoryObjects]` lists 1 object",
                "5:18 error: `SupportedObjects` is 2, but `[OptionalObjects]` lists 1 object"
            ]
        );
        assert!(fixed(&SUPPORTED_OBJECTS_COUNT, text).contains("SupportedObjects=1\n1=0x1005"));
    }

    #[test]
    fn the_entry_must_be_there() {
        let text = "[OptionalObjects]\r\n1=0x1005\r\n[ManufacturerObjects]\r\nSupportedObjects=\r\n";
        assert_eq!(
            findings(&SUPPORTED_OBJECTS_COUNT, text),
            [
                "1:1 error: `[OptionalObjects]` has no `SupportedObjects`",
                "4:1 error: `SupportedObjects` of `[ManufacturerObjects]` is empty"
            ]
        );
        assert_eq!(
            fixed(&SUPPORTED_OBJECTS_COUNT, text),
            "[OptionalObjects]\r\nSupportedObjects=1\r\n1=0x1005\r\n[ManufacturerObjects]\r\nSupportedObjects=0\r\n"
        );
    }

    #[test]
    fn what_other_rules_report_is_left_to_them() {
        for text in [
            "[OptionalObjects]\nSupportedObjects=3\n1=0x1005\n3=0x1017\n",
            "[OptionalObjects]\nSupportedObjects=1\n1=0x1005\n1=0x1017\n",
            "[OptionalObjects]\nSupportedObjects=x\n1=0x1005\n",
            "[OptionalObjects]\nSupportedObjects=1\nIndex0=0x1005\n[1005]\n",
        ] {
            assert!(findings(&SUPPORTED_OBJECTS_COUNT, text).is_empty(), "{text}");
        }
    }
}
