use super::edits;
use crate::listing::{Item, List};
use crate::rule::rule;
use crate::wording::{FEW, few};
use crate::{Context, Edit, Report};
use edskit_types::{Index, ObjectArea};
use std::collections::{BTreeMap, HashSet};

rule! {
    /// An object is in the wrong list
    ///
    /// ## What it does
    /// Reports manufacturer objects (2000h to 5FFFh) outside `[ManufacturerObjects]`, other objects inside it, and
    /// 1000h, 1001h or 1018h among the optional ones; one finding for all objects that belong into the same list. 1018h
    /// is left alone in files of an edition before 4.0, where it was optional.
    ///
    /// ## Why is this bad
    /// Tools group the objects by the lists. Checkers look for the mandatory objects in their list only.
    ///
    /// ## Example
    /// ```eds
    /// [OptionalObjects]
    /// SupportedObjects=2
    /// 1=0x1017
    /// 2=0x2000
    ///
    /// [ManufacturerObjects]
    /// SupportedObjects=0
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [OptionalObjects]
    /// SupportedObjects=1
    /// 1=0x1017
    ///
    /// [ManufacturerObjects]
    /// SupportedObjects=1
    /// 1=0x2000
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.6.3.1.
    pub(crate) static WRONG_LIST = {
        code: "LST008",
        name: "wrong-list",
        group: Lists,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [
            CanChkEds("28"), EdsDcfCheck("LST005"), EdsDcfCheck("LST007"),
            Dcfchk("object is manufacturer-specific"), Dcfchk("object is not manufacturer-specific"),
        ],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let is_edition_4 = context
        .sheet
        .file_info()
        .and_then(|info| info.eds_version())
        .is_some_and(|version| matches!(version.raw(), [b'4'..=b'9', ..]));
    let mut misplaced: BTreeMap<(List, List), Vec<&Item>> = BTreeMap::new();
    for item in context.listing().items() {
        if let Some(right) = item.index.and_then(|index| right_list(item.list, index, is_edition_4)) {
            misplaced.entry((item.list, right)).or_default().push(item);
        }
    }
    for ((list, right), mut items) in misplaced {
        // What the right list names, too, is the matter of LST006.
        let there: HashSet<Index> =
            context.listing().items_of(right).iter().filter_map(|item| item.index).collect();
        items.retain(|item| item.index.is_some_and(|index| !there.contains(&index)));
        if !items.is_empty() {
            report_items(context, list, right, &items, report);
        }
    }
}

/// The list that an object belongs into, if it is not `list` without doubt.
fn right_list(list: List, index: Index, is_edition_4: bool) -> Option<List> {
    let right = List::of(index)?;
    let is_wrong = match (list, right) {
        // Profiles make other objects mandatory, so they may be there; LST009 tells.
        (List::Mandatory, List::Optional) => false,
        (List::Optional, List::Mandatory) => is_edition_4 || index != Index::IDENTITY,
        // Editions differ about the list of network and system variables.
        (List::Manufacturer, List::Optional) => {
            matches!(index.area(), ObjectArea::Communication | ObjectArea::Profile)
        }
        _ => list != right,
    };
    is_wrong.then_some(right)
}

fn report_items(context: &Context<'_>, list: List, right: List, misplaced: &[&Item], report: &mut Report) {
    let document = context.document();
    let indices: Vec<Index> = misplaced.iter().filter_map(|item| item.index).collect();
    let verb = if indices.len() == 1 { "belongs" } else { "belong" };
    let message =
        format!("`[{}]` lists {}, which {verb} into `[{}]`", list.name(), few(indices.iter()), right.name());
    let finding = report.add(misplaced[0].value_span(document), message);
    for item in misplaced.iter().take(FEW).skip(1) {
        finding.label(item.value_span(document), "this one, too");
    }
    finding.help(format!("list {} in `[{}]`", if indices.len() == 1 { "it" } else { "them" }, right.name()));
    if edits::is_regular(context, list) && edits::is_regular(context, right) {
        let moved: HashSet<Index> = indices.iter().copied().collect();
        let is_kept = |item: &Item| item.index.is_none_or(|index| !moved.contains(&index));
        let mut edits = edits::renumber(context, list, is_kept);
        edits.extend(edits::append(context, right, &indices));
        edits.sort_by_key(|edit: &Edit| edit.span);
        finding.unsafe_fix(format!("Move to [{}]", right.name()), edits);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    const LISTS: &str = "[MandatoryObjects]\nSupportedObjects=1\n1=0x2000\n[OptionalObjects]\nSupportedObjects=3\n1=0x1001\n2=0x2001\n3=0x1017\n[ManufacturerObjects]\nSupportedObjects=1\n1=0x6000\n";

    #[test]
    fn each_way_is_reported_once() {
        assert_eq!(
            findings(&WRONG_LIST, LISTS),
            [
                "3:3 warning: `[MandatoryObjects]` lists 2000h, which belongs into `[ManufacturerObjects]`",
                "6:3 warning: `[OptionalObjects]` lists 1001h, which belongs into `[MandatoryObjects]`",
                "7:3 warning: `[OptionalObjects]` lists 2001h, which belongs into `[ManufacturerObjects]`",
                "11:3 warning: `[ManufacturerObjects]` lists 6000h, which belongs into `[OptionalObjects]`"
            ]
        );
    }

    #[test]
    fn the_fixes_sort_the_objects_into_their_lists() {
        assert_eq!(
            fixed(&WRONG_LIST, LISTS),
            "[MandatoryObjects]\nSupportedObjects=1\n1=0x1001\n[OptionalObjects]\nSupportedObjects=2\n1=0x1017\n2=0x6000\n[ManufacturerObjects]\nSupportedObjects=2\n1=0x2000\n2=0x2001\n"
        );
    }

    #[test]
    fn what_may_be_right_is_left_alone() {
        for text in [
            "[MandatoryObjects]\n1=0x1017\n2=0x6040\n",
            "[OptionalObjects]\n1=0x1018\n2=0xA000\n3=0x0005\n4=0xC000\n",
            "[ManufacturerObjects]\n1=0xA000\n2=0x0040\n",
            "[OptionalObjects]\n1=0x2000\n[ManufacturerObjects]\n1=0x2000\n",
        ] {
            assert!(findings(&WRONG_LIST, text).is_empty(), "{text}");
        }
        let text = "[FileInfo]\nEDSVersion=4.0\n[OptionalObjects]\n1=0x1018\n";
        assert_eq!(findings(&WRONG_LIST, text).len(), 1);
    }
}
