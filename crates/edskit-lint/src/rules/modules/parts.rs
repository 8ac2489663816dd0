//! What the sections of modules say, brought together for the rules.

use crate::Context;
use edskit_model::{Entry, KeyName, ModuleSection, Section, SectionKind, Span};
use edskit_types::Index;

/// What a module does to objects.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Role {
    /// `[MxFixedObjects]`: it brings them.
    Fixed,
    /// `[MxSubExtends]`: it adds sub-indices to them.
    Extended,
}

impl Role {
    pub(super) const ALL: [Role; 2] = [Self::Fixed, Self::Extended];

    fn list(self) -> ModuleSection {
        match self {
            Self::Fixed => ModuleSection::FixedObjects,
            Self::Extended => ModuleSection::SubExtends,
        }
    }

    /// The name of the section that describes an object.
    pub(super) fn section_name(self, module: u16, index: Index) -> String {
        match self {
            Self::Fixed => format!("M{module}Fixed{:X}", index.0),
            Self::Extended => format!("M{module}SubExt{:X}", index.0),
        }
    }
}

/// The objects that one module brings or extends.
pub(super) struct Part<'a> {
    pub(super) module: u16,
    pub(super) role: Role,
    /// The list's section.
    pub(super) list: Option<Section<'a>>,
    /// What the list names, without items that are empty or no index.
    pub(super) items: Vec<(Index, Entry<'a>)>,
    /// The sections that describe objects.
    pub(super) described: Vec<(Index, Section<'a>)>,
    /// The sections of sub-objects.
    pub(super) subs: Vec<(Index, Section<'a>)>,
}

impl Part<'_> {
    pub(super) fn describes(&self, index: Index) -> bool {
        // Sections come sorted by their kind.
        self.described.binary_search_by_key(&index, |(described, _)| *described).is_ok()
    }

    /// Where a list names an object, or else the section that describes it: each object once.
    pub(super) fn objects(&self) -> Vec<(Index, Span)> {
        let listed = self.items.iter().map(|(index, entry)| (*index, entry.span()));
        let described = self.described.iter().map(|(index, section)| (*index, section.span()));
        let mut objects: Vec<_> = listed.chain(described).collect();
        objects.sort_by_key(|(index, _)| *index);
        objects.dedup_by_key(|(index, _)| *index);
        objects
    }
}

/// Every part of every module that has a section for it, in ascending order.
pub(super) fn of<'a>(context: &Context<'a>) -> Vec<Part<'a>> {
    let mut parts: Vec<Part<'a>> = Vec::new();
    for section in context.sheet.other_sections() {
        let SectionKind::Module(module, kind) = section.kind() else { continue };
        let role = match kind {
            ModuleSection::FixedObjects | ModuleSection::Fixed(_) | ModuleSection::FixedSub(..) => {
                Role::Fixed
            }
            ModuleSection::SubExtends | ModuleSection::SubExtension(_) => Role::Extended,
            ModuleSection::Info | ModuleSection::Comments => continue,
        };
        // The sections of a module come together, those of one role too.
        if parts.last().is_none_or(|part| part.module != module || part.role != role) {
            let list = context.sheet.section(SectionKind::Module(module, role.list()));
            let items = list.into_iter().flat_map(Section::items);
            let items =
                items.filter_map(|item| Some((Index(item.index.known()?), item.index.entry))).collect();
            parts.push(Part { module, role, list, items, described: Vec::new(), subs: Vec::new() });
        }
        let Some(part) = parts.last_mut() else { continue };
        match kind {
            ModuleSection::Fixed(index) | ModuleSection::SubExtension(index) => {
                part.described.push((index, section))
            }
            ModuleSection::FixedSub(index, _) => part.subs.push((index, section)),
            _ => {}
        }
    }
    parts
}

/// The entry that says how many items a list has.
pub(super) fn count_entry<'a>(section: Section<'a>) -> Option<Entry<'a>> {
    section.filled(KeyName::NrOfEntries)
}
