//! Objects and sub-objects of the device.

use super::{Datasheet, Description, Section};
use core::ops::Deref;
use edskit_types::{Index, SubIndex};

/// A described object; its attributes are those of its [`Description`].
#[derive(Clone, Copy, Debug)]
pub struct Object<'a> {
    index: Index,
    description: Description<'a>,
    position: u32,
}

impl<'a> Object<'a> {
    #[inline]
    pub(super) fn new(sheet: &'a Datasheet, position: u32) -> Self {
        let record = &sheet.objects[position as usize];
        let section = Section { sheet, id: record.section };
        Self { index: record.index, description: Description { section }, position }
    }

    /// The index.
    #[inline]
    pub fn index(self) -> Index {
        self.index
    }

    /// Its own section.
    #[inline]
    pub fn description(self) -> Description<'a> {
        self.description
    }

    /// The described sub-objects in ascending order; [`Object::dictionary_entries`] also gives compact ones.
    #[inline]
    pub fn sub_objects(self) -> impl ExactSizeIterator<Item = SubObject<'a>> + DoubleEndedIterator {
        let sheet = self.sheet();
        let record = &sheet.objects[self.position as usize];
        (record.first_sub..record.end_sub).map(move |position| SubObject::new(sheet, position))
    }

    /// The described sub-object at `sub_index`.
    pub fn sub_object(self, sub_index: SubIndex) -> Option<SubObject<'a>> {
        self.sheet().sub_object(self.index, sub_index)
    }
}

impl<'a> Deref for Object<'a> {
    type Target = Description<'a>;

    fn deref(&self) -> &Description<'a> {
        &self.description
    }
}

/// A described sub-object; its attributes are those of its [`Description`].
#[derive(Clone, Copy, Debug)]
pub struct SubObject<'a> {
    index: Index,
    sub_index: SubIndex,
    description: Description<'a>,
}

impl<'a> SubObject<'a> {
    #[inline]
    pub(super) fn new(sheet: &'a Datasheet, position: u32) -> Self {
        let record = &sheet.sub_objects[position as usize];
        let section = Section { sheet, id: record.section };
        Self { index: record.index, sub_index: record.sub_index, description: Description { section } }
    }

    /// The index of the object.
    #[inline]
    pub fn index(self) -> Index {
        self.index
    }

    /// The sub-index.
    #[inline]
    pub fn sub_index(self) -> SubIndex {
        self.sub_index
    }

    /// Its own section.
    #[inline]
    pub fn description(self) -> Description<'a> {
        self.description
    }
}

impl<'a> Deref for SubObject<'a> {
    type Target = Description<'a>;

    fn deref(&self) -> &Description<'a> {
        &self.description
    }
}
