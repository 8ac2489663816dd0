use super::edits;
use crate::listing::{Item, ItemKey, List};
use crate::numbering::one_wrong;
use crate::rule::rule;
use crate::{Context, Edit, Finding, Report};
use edskit_model::KeyName;

rule! {
    /// The keys of a list are not 1, 2, 3 and so on
    ///
    /// ## What it does
    /// Reports a list of objects whose keys leave a number out, begin with 0, have leading zeros, or are no numbers.
    /// The order in the file does not matter. Each list gives one finding.
    ///
    /// ## Why is this bad
    /// Names are texts: a reader asks for the keys `1`, `2`, `3` and does not find `03`. At a gap it stops, or takes
    /// an empty index, and the objects behind it are lost.
    ///
    /// ## Example
    /// ```eds
    /// [OptionalObjects]
    /// SupportedObjects=2
    /// 1=0x1005
    /// 3=0x1017
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
    /// CiA 306 v1.3, 4.2 and 4.6.3.1.
    pub(crate) static LIST_NUMBERING = {
        code: "LST003",
        name: "list-numbering-gap",
        group: Lists,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [
            CanChkEds("5"), CanChkEds("enumeration gap"), EdsDcfCheck("LST006"), Dcfchk("invalid entry in"),
            Dcfchk("entry missing in"),
        ],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for list in List::ALL {
        let items = context.listing().items_of(list);
        if let Some(item) = items.iter().find(|item| !matches!(item.key, ItemKey::Number(_))) {
            report_foreign(context, item, report);
        } else if let Some(item) = items.iter().find(|item| is_padded(context, item)) {
            let key = context.sheet.text(item.key_span(context.document()));
            let number = item.number().unwrap_or_default();
            let message = format!("key `{key}` of `[{}]` has a leading zero", list.name());
            let finding = report.add(item.key_span(context.document()), message);
            finding.help(format!("write `{number}`"));
            renumber(context, list, finding);
        } else if let Some((item, due)) = wrong_key(items) {
            report_wrong_key(context, item, due, report);
        } else if let Some(gap) = gap(items) {
            report_gap(context, list, gap, report);
        }
    }
}

/// The only item whose key is not the number of its place, and that number. One that stands twice is the matter of
/// SYN014.
fn wrong_key(items: &[Item]) -> Option<(&Item, u16)> {
    let (place, due) = one_wrong(items.iter().map(|item| item.number().unwrap_or_default()))?;
    let number = items[place].number()?;
    let stands_twice = items.iter().filter(|item| item.number() == Some(number)).count() > 1;
    // At the end of a list the items before it may have got lost as well.
    (!stands_twice && place + 1 < items.len()).then_some((&items[place], due))
}

fn report_wrong_key(context: &Context<'_>, item: &Item, due: u16, report: &mut Report) {
    let document = context.document();
    let key = item.key_span(document);
    let message = format!(
        "item {} of `[{}]` stands in the place of item {due}",
        context.sheet.text(key),
        item.list.name()
    );
    let finding = report.add(key, message);
    finding.here(format!("{due} is due here")).help(format!("write `{due}` for the key"));
    let items = context.listing().items_of(item.list);
    let edits = vec![Edit::replace(key, due.to_string())];
    let section = item.list.section(context.sheet);
    if section.is_some_and(|section| edits::count(context, section, items.len()).is_none()) {
        finding.safe_fix("Write the number that is due", edits);
    } else {
        finding.unsafe_fix("Write the number that is due", edits);
    }
}

fn is_padded(context: &Context<'_>, item: &Item) -> bool {
    let key = item.key_span(context.document()).slice(context.source());
    key.len() > 1 && key[0] == b'0'
}

/// A number that is missing, and the item with the next one.
struct Gap<'a> {
    missing: u16,
    next: &'a Item,
}

fn gap(items: &[Item]) -> Option<Gap<'_>> {
    let in_order =
        items.iter().enumerate().all(|(position, item)| item.number() == Some(position as u16 + 1));
    if in_order {
        return None;
    }
    let mut numbered: Vec<(u16, &Item)> =
        items.iter().filter_map(|item| Some((item.number()?, item))).collect();
    numbered.sort_by_key(|&(number, _)| number);
    // A number that stands twice in the place of the next one is the matter of SYN014.
    let first = numbered.first().map_or(0, |&(number, _)| number);
    if first > 0 && numbered.last().is_some_and(|&(last, _)| usize::from(last) <= numbered.len()) {
        return None;
    }
    numbered.dedup_by_key(|&mut (number, _)| number);
    let wrong =
        numbered.iter().enumerate().find(|(position, (number, _))| usize::from(*number) != position + 1);
    wrong.map(|(position, &(_, next))| Gap { missing: position as u16 + 1, next })
}

fn report_gap(context: &Context<'_>, list: List, gap: Gap<'_>, report: &mut Report) {
    let document = context.document();
    let number = gap.next.number().unwrap_or_default();
    let name = list.name();
    let message = match (number, gap.missing) {
        (0, _) => format!("`[{name}]` counts from 0 instead of 1"),
        (_, 1) => format!("`[{name}]` begins with item {number} instead of 1"),
        (_, missing) => format!("`[{name}]` goes on with item {number} after item {}", missing - 1),
    };
    let finding = report.add(gap.next.key_span(document), message);
    finding
        .help(format!("write `{}` for the key, and number the items behind it on from there", gap.missing));
    if let Some(section) = list.section(context.sheet)
        && let Some(empty) = section.numbered(KeyName::Item, gap.missing).filter(|entry| entry.is_empty())
    {
        finding.label(empty.span(), "empty, which counts as missing");
        return;
    }
    renumber(context, list, finding);
}

/// Offers to number the items of a list anew, if their order is clear.
fn renumber(context: &Context<'_>, list: List, finding: &mut Finding) {
    let items = context.listing().items_of(list);
    if !items.is_sorted_by(|before, after| before.number() < after.number()) {
        return;
    }
    let edits = edits::renumber(context, list, |_| true);
    let section = list.section(context.sheet);
    // Where the count is wrong, too, an item may have got lost.
    if section.is_some_and(|section| edits::count(context, section, items.len()).is_none()) {
        finding.safe_fix("Number the items anew", edits);
    } else {
        finding.unsafe_fix("Number the items anew", edits);
    }
}

/// A key that is an index or a word. The first one of the list stands for all of them.
fn report_foreign(context: &Context<'_>, item: &Item, report: &mut Report) {
    let document = context.document();
    let key = context.sheet.text(item.key_span(document));
    let list = item.list;
    let message = match item.key {
        ItemKey::Index => {
            format!("key `{key}` of `[{}]` is an index instead of the item's number", list.name())
        }
        ItemKey::Number(_) | ItemKey::Other => format!("key `{key}` of `[{}]` is no number", list.name()),
    };
    let finding = report.add(item.key_span(document), message);
    let items = context.listing().items_of(list);
    let mut edits = Vec::new();
    for (position, item) in items.iter().enumerate() {
        let Some(index) = item.index else { return };
        let line = format!("{}=0x{index:04X}", position + 1);
        if position == 0 {
            finding.help(format!("number the items from 1, with the index for a value: `{line}`"));
        }
        edits.push(match item.key {
            ItemKey::Index => Edit::replace(item.span(document), line),
            ItemKey::Number(_) | ItemKey::Other => {
                Edit::replace(item.key_span(document), (position + 1).to_string())
            }
        });
    }
    finding.unsafe_fix("Number the items", edits);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Applicability;
    use crate::testing::{findings, fixed, lint};
    use edskit_model::Datasheet;

    fn applicability(text: &str) -> Option<Applicability> {
        let findings = lint(&LIST_NUMBERING, "a.eds", &Datasheet::parse(text.as_bytes()));
        findings[0].fix.as_ref().map(|fix| fix.applicability)
    }

    #[test]
    fn every_kind_of_wrong_number_is_named() {
        for (items, message) in [
            ("01=0x1005\n02=0x1006", "3:1 error: key `01` of `[OptionalObjects]` has a leading zero"),
            ("0=0x1005\n1=0x1006", "3:1 error: `[OptionalObjects]` counts from 0 instead of 1"),
            ("2=0x1005\n3=0x1006", "3:1 error: `[OptionalObjects]` begins with item 2 instead of 1"),
            ("1=0x1005\n7=0x1006", "4:1 error: `[OptionalObjects]` goes on with item 7 after item 1"),
        ] {
            let text = format!("[OptionalObjects]\nSupportedObjects=2\n{items}\n");
            assert_eq!(findings(&LIST_NUMBERING, &text), [message]);
            assert_eq!(applicability(&text), Some(Applicability::Safe));
            let good = "[OptionalObjects]\nSupportedObjects=2\n1=0x1005\n2=0x1006\n";
            assert_eq!(fixed(&LIST_NUMBERING, &text), good);
        }
    }

    #[test]
    fn the_one_key_that_breaks_a_list_is_named() {
        let mut text = "[OptionalObjects]\nSupportedObjects=24\n".to_owned();
        for number in 1..=24 {
            text += &format!("{number}=0x{:04X}\n", 0x6000 + number);
        }
        for (old, new) in [("12=", "99="), ("1=", "77="), ("5=", "0=")] {
            let wrong = text.replacen(&format!("\n{old}"), &format!("\n{new}"), 1);
            let found = findings(&LIST_NUMBERING, &wrong);
            let (line, key) =
                (2 + old.trim_end_matches('=').parse::<usize>().unwrap(), new.trim_end_matches('='));
            let due = line - 2;
            assert_eq!(
                found,
                [format!(
                    "{line}:1 error: item {key} of `[OptionalObjects]` stands in the place of item {due}"
                )]
            );
            assert_eq!(fixed(&LIST_NUMBERING, &wrong), text);
        }
    }

    #[test]
    fn a_wrong_count_makes_the_fix_unsafe_and_a_wrong_order_impossible() {
        let text = "[OptionalObjects]\nSupportedObjects=3\n1=0x1005\n3=0x1006\n";
        assert_eq!(applicability(text), Some(Applicability::Unsafe));
        assert_eq!(
            fixed(&LIST_NUMBERING, text),
            text.replace("=3\n", "=2\n").replace("3=0x1006", "2=0x1006")
        );
        assert_eq!(applicability("[OptionalObjects]\nSupportedObjects=2\n3=0x1005\n1=0x1006\n"), None);
        assert_eq!(applicability("[OptionalObjects]\nSupportedObjects=3\n1=0x1005\n2=\n3=0x1006\n"), None);
    }

    #[test]
    fn other_orders_and_doubled_keys_are_fine_here() {
        for items in ["2=0x1005\n1=0x1006", "1=0x1005\n1=0x1006", "1=0x1005\n3=0x1006\n1=0x1007", ""] {
            let text = format!("[OptionalObjects]\n{items}\n");
            assert!(findings(&LIST_NUMBERING, &text).is_empty(), "{items}");
        }
    }

    #[test]
    fn keys_that_are_no_numbers_are_numbered() {
        let text = "[MandatoryObjects]\n1000=1\n1018=4\n[1000]\n[1018]\n";
        assert_eq!(
            findings(&LIST_NUMBERING, text),
            ["2:1 error: key `1000` of `[MandatoryObjects]` is an index instead of the item's number"]
        );
        assert_eq!(fixed(&LIST_NUMBERING, text), "[MandatoryObjects]\n1=0x1000\n2=0x1018\n[1000]\n[1018]\n");
        let text = "[MandatoryObjects]\nIndex0=0x1000\nIndex1=0x1018\n[1000]\n[1018]\n";
        assert_eq!(
            findings(&LIST_NUMBERING, text),
            ["2:1 error: key `Index0` of `[MandatoryObjects]` is no number"]
        );
        assert_eq!(fixed(&LIST_NUMBERING, text), text.replace("Index1", "2").replace("Index0", "1"));
    }
}
