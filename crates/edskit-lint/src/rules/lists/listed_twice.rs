use super::edits;
use crate::listing::{Item, List};
use crate::rule::rule;
use crate::{Context, Finding, Report};
use edskit_types::Index;
use std::collections::{HashMap, HashSet};

rule! {
    /// An object is listed twice
    ///
    /// ## What it does
    /// Reports an index that one list names twice, or two lists name.
    ///
    /// ## Why is this bad
    /// Readers that make an object for each item make it twice, or refuse the second one. Often another index was
    /// meant.
    ///
    /// ## Example
    /// ```eds
    /// [OptionalObjects]
    /// SupportedObjects=3
    /// 1=0x1003
    /// 2=0x1005
    /// 3=0x1003
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [OptionalObjects]
    /// SupportedObjects=2
    /// 1=0x1003
    /// 2=0x1005
    /// ```
    ///
    /// ## References
    /// Engineering judgement: CiA 306 v1.3, 4.6.3.1 gives each object one list, and an object exists only once.
    pub(crate) static LISTED_TWICE = {
        code: "LST006",
        name: "listed-twice",
        group: Lists,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("37"), EdsDcfCheck("LST004")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let listing = context.listing();
    let repeated = listing.repeated();
    if repeated.len() == 0 {
        return;
    }
    let mut firsts: HashMap<Index, &Item> = HashMap::new();
    for item in listing.items() {
        if let Some(index) = item.index {
            firsts.entry(index).or_insert(item);
        }
    }
    let mut pairs = Vec::new();
    for again in repeated {
        let Some(index) = again.index else { continue };
        // The one in the list that the object does not belong into is too many.
        let first = firsts[&index];
        let is_misplaced = first.list != again.list && List::of(index) == Some(again.list);
        let (kept, spare) = if is_misplaced { (again, first) } else { (first, again) };
        pairs.push(Pair { kept, spare });
    }
    let mut mended = Vec::new();
    for pair in &pairs {
        let finding = report_pair(context, pair, report);
        // One fix for all of a list, because each of them numbers the whole list anew.
        if !mended.contains(&pair.lists()) {
            mended.push(pair.lists());
            mend(context, pair.lists(), &pairs, finding);
        }
    }
}

/// Two items with the same index.
struct Pair<'a> {
    kept: &'a Item,
    spare: &'a Item,
}

impl Pair<'_> {
    fn lists(&self) -> (List, List) {
        (self.kept.list, self.spare.list)
    }
}

fn report_pair<'r>(context: &Context<'_>, pair: &Pair<'_>, report: &'r mut Report) -> &'r mut Finding {
    let document = context.document();
    let index = pair.spare.index.map_or_else(String::new, |index| index.to_string());
    let (kept, spare) = (pair.kept.list.name(), pair.spare.list.name());
    let (message, help) = if kept == spare {
        let help = "take this one out, or write the index that was meant".to_owned();
        (format!("{index} is listed twice"), help)
    } else {
        (format!("{index} is listed in `[{spare}]` and in `[{kept}]`"), format!("leave it in `[{kept}]`"))
    };
    let finding = report.add(pair.spare.value_span(document), message);
    finding.label(pair.kept.value_span(document), "the other one").help(help)
}

fn mend(context: &Context<'_>, (kept, spare): (List, List), pairs: &[Pair<'_>], finding: &mut Finding) {
    if !edits::is_regular(context, spare) {
        return;
    }
    let alike = pairs.iter().filter(|pair| pair.lists() == (kept, spare));
    let numbers: HashSet<Option<u16>> = alike.map(|pair| pair.spare.number()).collect();
    let edits = edits::renumber(context, spare, |item| !numbers.contains(&item.number()));
    if kept == spare {
        finding.safe_fix(format!("Take the second ones out of [{}]", spare.name()), edits);
    } else {
        finding.unsafe_fix(format!("Take them out of [{}]", spare.name()), edits);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn the_second_one_goes() {
        let text = "[OptionalObjects]\nSupportedObjects=4\n1=0x1003\n2=4099\n3=0x1005\n4=0x1003\n";
        assert_eq!(
            findings(&LISTED_TWICE, text),
            ["4:3 warning: 1003h is listed twice", "6:3 warning: 1003h is listed twice"]
        );
        assert_eq!(fixed(&LISTED_TWICE, text), "[OptionalObjects]\nSupportedObjects=2\n1=0x1003\n2=0x1005\n");
    }

    #[test]
    fn the_right_list_keeps_it() {
        let text = "[OptionalObjects]\nSupportedObjects=2\n1=0x2000\n2=0x1005\n[ManufacturerObjects]\nSupportedObjects=1\n1=0x2000\n";
        assert_eq!(
            findings(&LISTED_TWICE, text),
            ["3:3 warning: 2000h is listed in `[OptionalObjects]` and in `[ManufacturerObjects]`"]
        );
        assert_eq!(
            fixed(&LISTED_TWICE, text),
            "[OptionalObjects]\nSupportedObjects=1\n1=0x1005\n[ManufacturerObjects]\nSupportedObjects=1\n1=0x2000\n"
        );
    }

    #[test]
    fn a_list_in_disorder_is_not_touched() {
        let text = "[OptionalObjects]\nSupportedObjects=9\n1=0x1003\n2=0x1003\n";
        assert_eq!(findings(&LISTED_TWICE, text).len(), 1);
        assert_eq!(fixed(&LISTED_TWICE, text), text);
    }
}
