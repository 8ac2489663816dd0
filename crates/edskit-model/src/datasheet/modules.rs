//! Modular devices, by the sub-index method (CiA 306 v1.3, 6).

use super::{Datasheet, Description, Entry, Field, ListItem, Section};
use crate::key::KeyName;
use crate::section::{ModuleSection, SectionKind, decimal};
use core::ops::Deref;
use edskit_types::{Index, SubIndex};

/// The description of one module type.
#[derive(Clone, Copy, Debug)]
pub struct Module<'a> {
    sheet: &'a Datasheet,
    number: u16,
}

/// An object that a module adds sub-indices to; its attributes are those of its [`Description`].
#[derive(Clone, Copy, Debug)]
pub struct SubExtension<'a> {
    index: Index,
    description: Description<'a>,
}

/// How many sub-indices a module adds (CiA 306 v1.3, 6.3).
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ModuleCount {
    /// This many sub-indices for each module: `2`.
    SubIndices(u8),
    /// Several modules share one sub-index, each with this many bits: `0;2`.
    Bits(u8),
}

impl Datasheet {
    /// `[SupportedModules] NrOfEntries`: how many module types the file describes.
    pub fn supported_modules(&self) -> Option<Field<'_, u16>> {
        let section = self.section(SectionKind::SupportedModules)?;
        section.filled(KeyName::NrOfEntries).map(Entry::unsigned)
    }

    /// The module types that have a `[MxModuleInfo]`, in ascending order.
    pub fn modules(&self) -> impl Iterator<Item = Module<'_>> {
        self.other_sections().filter_map(move |section| match section.kind() {
            SectionKind::Module(number, ModuleSection::Info) => Some(Module { sheet: self, number }),
            _ => None,
        })
    }

    /// The module type with a number.
    pub fn module(&self, number: u16) -> Option<Module<'_>> {
        self.section(SectionKind::Module(number, ModuleSection::Info))?;
        Some(Module { sheet: self, number })
    }

    /// `[ConnectedModules]` of a DCF: module numbers in physical order.
    pub fn connected_modules(&self) -> impl Iterator<Item = Field<'_, u16>> {
        let section = self.section(SectionKind::ConnectedModules);
        section.into_iter().flat_map(|section| section.all_numbered(KeyName::Item).map(Entry::unsigned))
    }
}

impl<'a> Module<'a> {
    /// The number x of its sections `[Mx...]`.
    pub fn number(self) -> u16 {
        self.number
    }

    /// `[MxModuleInfo]`
    pub fn info(self) -> Option<Section<'a>> {
        self.part(ModuleSection::Info)
    }

    /// `[MxComments]`
    pub fn comments(self) -> Option<Section<'a>> {
        self.part(ModuleSection::Comments)
    }

    /// The objects that `[MxFixedObjects]` lists.
    pub fn fixed_objects(self) -> impl Iterator<Item = ListItem<'a>> {
        self.part(ModuleSection::FixedObjects).into_iter().flat_map(Section::items)
    }

    /// The description of a fixed object.
    pub fn fixed_object(self, index: Index) -> Option<Description<'a>> {
        self.part(ModuleSection::Fixed(index)).map(|section| Description { section })
    }

    /// The description of a fixed sub-object.
    pub fn fixed_sub_object(self, index: Index, sub_index: SubIndex) -> Option<Description<'a>> {
        self.part(ModuleSection::FixedSub(index, sub_index)).map(|section| Description { section })
    }

    /// The objects that `[MxSubExtends]` lists.
    pub fn sub_extends(self) -> impl Iterator<Item = ListItem<'a>> {
        self.part(ModuleSection::SubExtends).into_iter().flat_map(Section::items)
    }

    /// The extension of an object.
    pub fn sub_extension(self, index: Index) -> Option<SubExtension<'a>> {
        let section = self.part(ModuleSection::SubExtension(index))?;
        Some(SubExtension { index, description: Description { section } })
    }

    fn part(self, part: ModuleSection) -> Option<Section<'a>> {
        self.sheet.section(SectionKind::Module(self.number, part))
    }
}

impl<'a> SubExtension<'a> {
    /// The index of the object that is extended.
    pub fn index(self) -> Index {
        self.index
    }

    /// `Count`: how many sub-indices one module adds; `None` where it is missing or means nothing.
    pub fn count(self) -> Option<ModuleCount> {
        let raw = self.filled(KeyName::Count)?.raw();
        let byte = |text: &[u8]| decimal(text.trim_ascii()).and_then(|value| u8::try_from(value).ok());
        match raw.iter().position(|&byte| byte == b';') {
            None => byte(raw).map(ModuleCount::SubIndices),
            Some(semicolon) if byte(&raw[..semicolon]) == Some(0) => {
                byte(&raw[semicolon + 1..]).map(ModuleCount::Bits)
            }
            Some(_) => None,
        }
    }

    /// `ObjExtend`: the sub-index after which the next object goes on; 0 or missing for none.
    pub fn obj_extend(self) -> Option<Field<'a, u8>> {
        self.filled(KeyName::ObjExtend).map(Entry::unsigned)
    }
}

impl<'a> Deref for SubExtension<'a> {
    type Target = Description<'a>;

    fn deref(&self) -> &Description<'a> {
        &self.description
    }
}
