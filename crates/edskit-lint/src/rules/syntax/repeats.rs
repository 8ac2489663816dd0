//! Sections that stand more than once.

use crate::Context;
use edskit_model::{Section, SectionKind};

/// The sections of CiA 306 that stand again, in whatever spelling, each with the first one of its kind.
pub(super) fn of_cia_306<'a>(context: &Context<'a>) -> impl Iterator<Item = (Section<'a>, Section<'a>)> {
    let sheet = context.sheet;
    let sections = sheet.has_repeated_sections().then(|| sheet.sections());
    let known = sections.into_iter().flatten().filter(|section| section.kind() != SectionKind::Unknown);
    known.filter_map(move |section| {
        let first = sheet.section(section.kind())?;
        (first.id() != section.id()).then_some((first, section))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::FileKind;
    use edskit_model::Datasheet;

    #[test]
    fn the_first_of_each_kind_is_not_one_of_them() {
        let sheet = Datasheet::parse(b"[1000]\n[x]\n[1001]\n[0x1000]\n[x]\n[1001]\n[1001]\n");
        let context = Context::new(&sheet, FileKind::Eds, None);
        let pairs: Vec<_> = of_cia_306(&context).map(|(first, again)| (first.id(), again.id())).collect();
        assert_eq!(pairs, [(0, 3), (2, 5), (2, 6)]);
    }
}
