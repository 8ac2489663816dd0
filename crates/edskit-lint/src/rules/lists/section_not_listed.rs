use super::edits;
use crate::listing::List;
use crate::rule::rule;
use crate::wording::{FEW, few};
use crate::{Context, Report};
use edskit_model::Section;
use edskit_types::Index;

rule! {
    /// Described objects are in no list
    ///
    /// ## What it does
    /// Reports objects with a section of their own that no list names; one finding for each list that lacks some.
    /// Where the list itself is missing, LST001 says so. Data types and reserved indices belong into no list.
    ///
    /// ## Why is this bad
    /// Readers that go through the lists do not see the objects. Other readers do, so the same file gives different
    /// devices; in a DCF the values of the objects get lost.
    ///
    /// ## Example
    /// ```eds
    /// [ManufacturerObjects]
    /// SupportedObjects=1
    /// 1=0x2000
    ///
    /// [2000]
    /// ParameterName=Speed
    ///
    /// [2005]
    /// ParameterName=Ramp
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [ManufacturerObjects]
    /// SupportedObjects=2
    /// 1=0x2000
    /// 2=0x2005
    ///
    /// [2000]
    /// ParameterName=Speed
    ///
    /// [2005]
    /// ParameterName=Ramp
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.6.3.1.
    pub(crate) static SECTION_NOT_LISTED = {
        code: "LST005",
        name: "section-not-listed",
        group: Lists,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("unused section"), EdsDcfCheck("LST003")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let listing = context.listing();
    if context.sheet.objects().all(|object| listing.is_listed(object.index())) {
        return;
    }
    for list in List::ALL {
        let unlisted = listing.unlisted(context.sheet, list);
        if let Some(section) = list.section(context.sheet)
            && !unlisted.is_empty()
        {
            report_list(context, list, section, &unlisted, report);
        }
    }
}

fn report_list(
    context: &Context<'_>,
    list: List,
    section: Section<'_>,
    unlisted: &[Index],
    report: &mut Report,
) {
    let objects = unlisted.iter().take(FEW).filter_map(|&index| context.sheet.object(index));
    let mut places = objects.map(|object| object.span());
    let span = places.next().unwrap_or(section.span());
    let (verb, pronoun) = if unlisted.len() == 1 { ("is", "it") } else { ("are", "them") };
    let message =
        format!("{} {verb} described, but `[{}]` does not list {pronoun}", few(unlisted.iter()), list.name());
    let finding = report.add(span, message);
    for place in places {
        finding.label(place, "not listed either");
    }
    finding.label(section.span(), "the list");
    let first = context.listing().items_of(list).len() + 1;
    let count = first - 1 + unlisted.len();
    let more = if unlisted.len() == 1 { "" } else { " and so on" };
    finding.help(format!("add `{first}=0x{:04X}`{more}, and write `SupportedObjects={count}`", unlisted[0]));
    if edits::is_regular(context, list) {
        finding.unsafe_fix("Add them to the list", edits::append(context, list, unlisted));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    const LISTS: &str =
        "[MandatoryObjects]\nSupportedObjects=1\n1=0x1000\n\n[OptionalObjects]\nSupportedObjects=0\n";
    const OBJECTS: &str = "[1000]\n[1001]\n[1017]\n[1400]\n[6000]\n[2000]\n[A000]\n[1600]\n[0005]\n[C000]\n";

    #[test]
    fn each_list_gets_one_finding() {
        assert_eq!(
            findings(&SECTION_NOT_LISTED, &format!("{LISTS}{OBJECTS}")),
            [
                "8:1 warning: 1001h is described, but `[MandatoryObjects]` does not list it",
                "9:1 warning: 1017h, 1400h, 1600h, 6000h and 1 more are described, but `[OptionalObjects]` does not list them"
            ]
        );
        assert!(findings(&SECTION_NOT_LISTED, OBJECTS).is_empty());
    }

    #[test]
    fn the_fix_goes_on_numbering() {
        let fixed = fixed(&SECTION_NOT_LISTED, &format!("{LISTS}[1001]\n[1017]\n[1400]\n"));
        assert_eq!(
            fixed,
            "[MandatoryObjects]\nSupportedObjects=2\n1=0x1000\n2=0x1001\n\n[OptionalObjects]\nSupportedObjects=2\n1=0x1017\n2=0x1400\n[1001]\n[1017]\n[1400]\n"
        );
    }

    #[test]
    fn a_list_in_disorder_is_not_touched() {
        let text = "[ManufacturerObjects]\nSupportedObjects=3\n1=0x2000\n[2000]\n[2001]\n";
        assert_eq!(fixed(&SECTION_NOT_LISTED, text), text);
    }
}
