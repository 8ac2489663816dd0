use crate::listing::Item;
use crate::rule::rule;
use crate::{Context, Report};
use edskit_model::{Datasheet, ModuleSection, Section, SectionKind};
use edskit_types::{Index, PdoDirection, SubIndex};
use std::collections::HashSet;

rule! {
    /// A list names an object that no section describes
    ///
    /// ## What it does
    /// Reports an item of a list whose index has no section. Objects that modules bring, and PDOs that exist through
    /// `CompactPDO`, need none.
    ///
    /// ## Why is this bad
    /// Readers look for the section of each listed object. Some refuse the file, others give the device an object
    /// without name, type and access.
    ///
    /// ## Example
    /// ```eds
    /// [OptionalObjects]
    /// SupportedObjects=2
    /// 1=0x1005
    /// 2=0x1017
    ///
    /// [1017]
    /// ParameterName=Producer heartbeat time
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [OptionalObjects]
    /// SupportedObjects=1
    /// 1=0x1017
    ///
    /// [1017]
    /// ParameterName=Producer heartbeat time
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.6.3.1 and 6.3.
    pub(crate) static LISTED_WITHOUT_SECTION = {
        code: "LST004",
        name: "listed-without-section",
        group: Lists,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [EdsDcfCheck("LST002"), Dcfchk("object not found")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let listing = context.listing();
    let lacks_section = |item: &&Item| item.index.is_some_and(|index| !listing.is_described(index));
    let mut lacking = listing.items().iter().filter(lacks_section).peekable();
    if lacking.peek().is_none() {
        return;
    }
    let mut elsewhere = described_elsewhere(context.sheet);
    elsewhere.extend(context.hidden_sections().iter().filter_map(|kind| match kind {
        SectionKind::Object(index) => Some(*index),
        _ => None,
    }));
    let lacking: Vec<(&Item, Index)> = lacking
        .filter_map(|item| Some((item, item.index.filter(|index| !elsewhere.contains(index))?)))
        .collect();
    let end = cut_off(context, &lacking);
    for (position, (item, index)) in lacking.into_iter().enumerate() {
        let section = format!("`[{index:X}]`");
        let end = end.filter(|_| position == 0);
        let early = if end.is_some() { ": the file ends early" } else { "" };
        let finding = report.add(
            item.value_span(context.document()),
            format!("{index} is listed, but has no section {section}{early}"),
        );
        match end {
            Some(last) => {
                finding
                    .label(last.span(), "the last section")
                    .help("the file is cut off: everything that is listed behind its last section is missing; get it whole from its source");
            }
            None => {
                finding
                    .help(format!("describe the object in a section {section}, or take it out of the list"));
            }
        }
    }
}

/// The last section of a file that ends early: of the listed objects those are missing that come behind it, in the order
/// of the lists or of their indices, and at least two.
fn cut_off<'a>(context: &Context<'a>, lacking: &[(&Item, Index)]) -> Option<Section<'a>> {
    let last = context.sheet.sections().last()?;
    let index = last.kind().index()?;
    let items = context.listing().items();
    let place = items.iter().position(|item| item.index == Some(index))?;
    let mut tail = items[place + 1..].iter().filter_map(|item| item.index);
    let is_end_of_lists =
        tail.clone().count() == lacking.len() && tail.all(|index| !context.listing().is_described(index));
    let behind = items.iter().filter(|item| item.index.is_some_and(|other| other > index)).count();
    let is_end_of_indices = behind == lacking.len() && lacking.iter().all(|(_, missing)| *missing > index);
    let is_tail = is_end_of_lists || is_end_of_indices;
    (lacking.len() > 1 && is_tail).then_some(last)
}

/// Objects that need no section of their own, or whose lack of one is the matter of OBJ010.
fn described_elsewhere(sheet: &Datasheet) -> HashSet<Index> {
    let modules = sheet.other_sections().filter_map(|section| match section.kind() {
        SectionKind::Module(_, ModuleSection::Fixed(index) | ModuleSection::SubExtension(index)) => {
            Some(index)
        }
        _ => None,
    });
    let pdos = [PdoDirection::Receive, PdoDirection::Transmit]
        .into_iter()
        .flat_map(|direction| sheet.implicit_pdos(direction))
        .flat_map(|pdo| [pdo.communication(), pdo.mapping()]);
    let parts = sheet.sub_objects().filter(|sub| sub.sub_index() != SubIndex(0)).map(|sub| sub.index());
    modules.chain(pdos).chain(parts).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn each_item_is_reported() {
        let text = "[ManufacturerObjects]\n1=0x2000\n2=0x2001\n3=8194\n4=x\n5=\n[2001]\n";
        assert_eq!(
            findings(&LISTED_WITHOUT_SECTION, text),
            [
                "2:3 error: 2000h is listed, but has no section `[2000]`",
                "4:3 error: 2002h is listed, but has no section `[2002]`"
            ]
        );
    }

    #[test]
    fn a_file_that_ends_early_is_told_once() {
        let help = |text: &str| -> Vec<bool> {
            let sheet = Datasheet::parse(text.as_bytes());
            let findings = crate::testing::lint(&LISTED_WITHOUT_SECTION, "a.eds", &sheet);
            findings.iter().map(|finding| finding.help.as_deref().unwrap().contains("cut off")).collect()
        };
        let lists =
            "[OptionalObjects]\n1=0x1017\n2=0x6000\n3=0x6001\n[ManufacturerObjects]\n1=0x2000\n2=0x2001\n";
        assert_eq!(help(&format!("{lists}[1017]\n[6000]\n[6000sub1]\n")), [true, false, false]);
        assert_eq!(help(&format!("{lists}[1017]\n[2000]\n[2001]\n")), [true, false], "sorted by index");
        assert_eq!(help(&format!("{lists}[1017]\n[6001]\n")), [false; 3], "6000h is missing before the end");
        assert_eq!(
            help(&format!("{lists}[1017]\n[6000]\n[6001]\n[2000]\n")),
            [false],
            "one may be a mistake"
        );
    }

    #[test]
    fn a_section_whose_header_lost_its_line_is_not_missing() {
        let text = "[OptionalObjects]\n1=0x1008\n2=0x1017\n[1008]\nPDOMapping=0[1017]\nParameterName=a\n";
        assert_eq!(findings(&LISTED_WITHOUT_SECTION, text), [""; 0]);
    }

    #[test]
    fn modules_and_compact_pdos_bring_objects() {
        let text = "[DeviceInfo]\nCompactPDO=3\nNrOfRXPDO=2\n[OptionalObjects]\n1=0x1400\n2=0x1601\n3=0x1402\n4=0x6000\n5=0x6100\n6=0x6200\n[M1SubExt6000]\nCount=1\n[M2Fixed6100]\n[6200sub1]\n";
        assert_eq!(
            findings(&LISTED_WITHOUT_SECTION, text),
            ["7:3 error: 1402h is listed, but has no section `[1402]`"]
        );
    }
}
