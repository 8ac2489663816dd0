use super::parts::count_entry;
use crate::numbering::one_wrong;
use crate::rule::rule;
use crate::{Context, Edit, Report};
use edskit_model::{KeyName, ModuleSection, Section, SectionKind, Span};

rule! {
    /// A list of a modular device has another number of items than it says
    ///
    /// ## What it does
    /// Compares `NrOfEntries` of `[MxFixedObjects]`, `[MxSubExtends]` and `[ConnectedModules]` with their items, and
    /// reports items that are not numbered from 1 without gaps.
    ///
    /// ## Why is this bad
    /// Readers ask for the items 1 to `NrOfEntries`. They miss the others, or stop at the first that is not there.
    ///
    /// ## Example
    /// ```eds
    /// [M1FixedObjects]
    /// NrOfEntries=2
    /// 1=0x2100
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [M1FixedObjects]
    /// NrOfEntries=1
    /// 1=0x2100
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 6.3 and 6.4.
    pub(crate) static MODULE_LIST_COUNT = {
        code: "MOD007",
        name: "module-list-count",
        group: Modules,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("51-55")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for section in context.sheet.other_sections() {
        let is_list = matches!(
            section.kind(),
            SectionKind::ConnectedModules
                | SectionKind::Module(_, ModuleSection::FixedObjects | ModuleSection::SubExtends)
        );
        if is_list {
            check_list(section, report);
        }
    }
}

fn check_list(section: Section<'_>, report: &mut Report) {
    let mut numbers: Vec<(u16, Span)> = section
        .all_numbered(KeyName::Item)
        .filter(|item| !item.is_empty())
        .map(|item| (item.key().number, item.key_span()))
        .collect();
    let name = section.name();
    numbers.sort_unstable();
    numbers.dedup_by_key(|(number, _)| *number);
    let items = if numbers.len() == 1 { "1 item".to_owned() } else { format!("{} items", numbers.len()) };
    let Some(entry) = count_entry(section) else {
        report
            .add(section.span(), format!("`[{name}]` has {items}, but no `NrOfEntries`"))
            .help(format!("add `NrOfEntries={}`", numbers.len()));
        return;
    };
    let Some(count) = entry.unsigned::<u16>().known() else { return };
    if usize::from(count) != numbers.len() {
        report
            .add(entry.value_span(), format!("NrOfEntries is {count}, but `[{name}]` has {items}"))
            .help(format!("write `NrOfEntries={}`, or add the items", numbers.len()))
            .unsafe_fix(
                format!("Write {}", numbers.len()),
                vec![Edit::replace(entry.value_span(), numbers.len().to_string())],
            );
    } else if let Some((key, due)) = wrong_key(section) {
        report
            .add(
                key,
                format!("item {} of `[{name}]` stands in the place of item {due}", section.sheet().text(key)),
            )
            .help(format!("write `{due}` for the key"))
            .unsafe_fix(format!("Write {due}"), vec![Edit::replace(key, due.to_string())]);
    } else if let Some((missing, (next, place))) =
        (1..=count).zip(&numbers).find(|(due, (number, _))| due != number)
    {
        report
            .add(*place, format!("`[{name}]` has an item {next}, but no item {missing}"))
            .help(format!("number the items from 1 to {count}"));
    }
}

/// The only key that is not the number of its place, and that number.
fn wrong_key(section: Section<'_>) -> Option<(Span, u16)> {
    let items = || section.all_numbered(KeyName::Item).filter(|item| !item.is_empty());
    let (place, due) = one_wrong(items().map(|item| item.key().number))?;
    Some((items().nth(place)?.key_span(), due))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    fn found(entries: &str) -> Vec<String> {
        findings(&MODULE_LIST_COUNT, &format!("[ConnectedModules]\n{entries}\n"))
    }

    #[test]
    fn items_are_counted_and_numbered() {
        assert!(found("NrOfEntries=2\n1=1\n2=1").is_empty() && found("NrOfEntries=0").is_empty());
        assert!(found("NrOfEntries=x\n1=1").is_empty());
        assert_eq!(
            found("NrOfEntries=3\n1=1\n2="),
            ["2:13 error: NrOfEntries is 3, but `[ConnectedModules]` has 1 item"]
        );
        assert_eq!(
            found("NrOfEntries=2\n1=1\n3=1"),
            ["4:1 error: item 3 of `[ConnectedModules]` stands in the place of item 2"]
        );
        assert_eq!(
            found("NrOfEntries=3\n1=1\n3=1\n4=1"),
            ["4:1 error: `[ConnectedModules]` has an item 3, but no item 2"]
        );
        assert_eq!(found("1=1\n2=1"), ["1:1 error: `[ConnectedModules]` has 2 items, but no `NrOfEntries`"]);
        assert_eq!(
            fixed(&MODULE_LIST_COUNT, "[M1SubExtends]\nNrOfEntries=0\n1=0x6000\n"),
            "[M1SubExtends]\nNrOfEntries=1\n1=0x6000\n"
        );
    }
}
