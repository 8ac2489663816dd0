//! The three lists of objects, read once for all rules that ask about them.

use edskit_model::meant::without_prefix;
use edskit_model::{Datasheet, Document, Entry, KeyName, Section, SectionKind, Span};
use edskit_types::{Index, ObjectArea};

/// One of the lists of objects.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) enum List {
    Mandatory,
    Optional,
    Manufacturer,
}

impl List {
    pub(crate) const ALL: [List; 3] = [Self::Mandatory, Self::Optional, Self::Manufacturer];

    /// The section's name.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Mandatory => "MandatoryObjects",
            Self::Optional => "OptionalObjects",
            Self::Manufacturer => "ManufacturerObjects",
        }
    }

    /// What the list's section is.
    pub(crate) const fn kind(self) -> SectionKind {
        match self {
            Self::Mandatory => SectionKind::MandatoryObjects,
            Self::Optional => SectionKind::OptionalObjects,
            Self::Manufacturer => SectionKind::ManufacturerObjects,
        }
    }

    /// The list's section.
    pub(crate) fn section(self, sheet: &Datasheet) -> Option<Section<'_>> {
        sheet.section(self.kind())
    }

    /// The list that an object belongs into; `None` for data types and reserved indices.
    pub(crate) fn of(index: Index) -> Option<Self> {
        match index.area() {
            _ if MANDATORY.contains(&index) => Some(Self::Mandatory),
            ObjectArea::Manufacturer => Some(Self::Manufacturer),
            ObjectArea::Communication
            | ObjectArea::Profile
            | ObjectArea::NetworkVariable
            | ObjectArea::SystemVariable => Some(Self::Optional),
            ObjectArea::Reserved
            | ObjectArea::StaticDataType
            | ObjectArea::ComplexDataType
            | ObjectArea::ManufacturerDataType
            | ObjectArea::ProfileDataType => None,
        }
    }
}

/// The objects that every device has (CiA 301).
pub(crate) const MANDATORY: [Index; 3] = [Index::DEVICE_TYPE, Index::ERROR_REGISTER, Index::IDENTITY];

/// The first index that is no data type.
const FIRST_OBJECT: u16 = 0x1000;

/// What the key of an item is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum ItemKey {
    /// The item's number.
    Number(u16),
    /// The index itself, with something else for a value: `1000=1`.
    Index,
    /// Something that CiA 306 does not know, but the value is the index of a described object: `Index0=0x1000`.
    Other,
}

/// One item of a list that has a value.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Item {
    pub(crate) list: List,
    pub(crate) key: ItemKey,
    /// The index that is meant, if it can be known.
    pub(crate) index: Option<Index>,
    /// The index is hexadecimal, but lacks its `0x`: `1=1000`.
    pub(crate) lacks_prefix: bool,
    line: u32,
}

impl Item {
    /// Where the key stands.
    pub(crate) fn key_span(&self, document: &Document) -> Span {
        document.lines()[self.line as usize].key(document.to_bytes())
    }

    /// Where the value stands.
    pub(crate) fn value_span(&self, document: &Document) -> Span {
        document.lines()[self.line as usize].value(document.to_bytes())
    }

    /// The whole line with its ending.
    pub(crate) fn line_span(&self, document: &Document) -> Span {
        document.lines()[self.line as usize].full_span()
    }

    /// Key, `=` and value.
    pub(crate) fn span(&self, document: &Document) -> Span {
        document.lines()[self.line as usize].trimmed(document.to_bytes())
    }

    /// The item's number, if its key is one.
    pub(crate) fn number(&self) -> Option<u16> {
        match self.key {
            ItemKey::Number(number) => Some(number),
            ItemKey::Index | ItemKey::Other => None,
        }
    }
}

/// What the three lists say.
pub(crate) struct Listing {
    items: Vec<Item>,
    described: IndexSet,
    listed: IndexSet,
    /// Positions of items whose index an earlier item already has.
    again: Vec<u32>,
}

impl Listing {
    pub(crate) fn of(sheet: &Datasheet) -> Self {
        let mut described = IndexSet::new();
        for object in sheet.objects() {
            described.insert(object.index());
        }
        let mut listing = Self { items: Vec::new(), described, listed: IndexSet::new(), again: Vec::new() };
        for list in List::ALL {
            for entry in list.section(sheet).into_iter().flat_map(Section::entries) {
                if let Some(item) = listing.item(list, entry) {
                    listing.add(item);
                }
            }
        }
        listing
    }

    fn item(&self, list: List, entry: Entry<'_>) -> Option<Item> {
        let key = entry.key();
        let line = entry.line_number() as u32;
        let known = |index: u16| self.described.contains(Index(index)).then_some(Index(index));
        if key.name != KeyName::Item {
            if key.name != KeyName::Unknown {
                return None;
            }
            let index = known(entry.unsigned().known()?)?;
            return Some(Item { list, key: ItemKey::Other, index: Some(index), lacks_prefix: false, line });
        }
        // Digits without `0x` are looked up below.
        let is_bare = without_prefix(entry.raw()).is_some();
        let value = entry.unsigned();
        let value = if is_bare { value.value.ok() } else { value.known() };
        if let Some(index) = value.and_then(known) {
            let key = ItemKey::Number(key.number);
            return Some(Item { list, key, index: Some(index), lacks_prefix: false, line });
        }
        if entry.is_empty() {
            return None;
        }
        // Only what no section describes comes here, so it may take its time.
        let lacks_prefix = without_prefix(entry.raw()).and_then(known);
        let is_no_index = value.is_none_or(|value| value < FIRST_OBJECT);
        let from_key =
            is_no_index.then(|| without_prefix(entry.key_text().as_bytes())).flatten().and_then(known);
        let key = match (lacks_prefix, from_key) {
            (None, Some(_)) => ItemKey::Index,
            _ => ItemKey::Number(key.number),
        };
        let index = lacks_prefix.or(from_key).or(value.map(Index));
        Some(Item { list, key, index, lacks_prefix: lacks_prefix.is_some(), line })
    }

    fn add(&mut self, item: Item) {
        if let Some(index) = item.index
            && !self.listed.insert(index)
        {
            self.again.push(self.items.len() as u32);
        }
        self.items.push(item);
    }

    /// The items that have a value: list by list, in the order of the file.
    pub(crate) fn items(&self) -> &[Item] {
        &self.items
    }

    /// The items of one list.
    pub(crate) fn items_of(&self, list: List) -> &[Item] {
        let first = self.items.partition_point(|item| item.list < list);
        let end = self.items.partition_point(|item| item.list <= list);
        &self.items[first..end]
    }

    /// Whether an object has a section of its own.
    #[inline]
    pub(crate) fn is_described(&self, index: Index) -> bool {
        self.described.contains(index)
    }

    /// Whether any list names an object.
    #[inline]
    pub(crate) fn is_listed(&self, index: Index) -> bool {
        self.listed.contains(index)
    }

    /// Items whose index an earlier item already has.
    pub(crate) fn repeated(&self) -> impl ExactSizeIterator<Item = &Item> {
        self.again.iter().map(|&position| &self.items[position as usize])
    }

    /// Described objects that no list names although they belong into `list`.
    pub(crate) fn unlisted(&self, sheet: &Datasheet, list: List) -> Vec<Index> {
        let indices = sheet.objects().map(|object| object.index());
        indices.filter(|&index| !self.is_listed(index) && List::of(index) == Some(list)).collect()
    }
}

/// A set of indices: one bit for each.
struct IndexSet(Vec<u64>);

impl IndexSet {
    fn new() -> Self {
        Self(vec![0; 0x1_0000 / 64])
    }

    /// Whether `index` was not in the set before.
    #[inline]
    fn insert(&mut self, index: Index) -> bool {
        let word = &mut self.0[usize::from(index.0 / 64)];
        let bit = 1 << (index.0 % 64);
        let is_new = *word & bit == 0;
        *word |= bit;
        is_new
    }

    #[inline]
    fn contains(&self, index: Index) -> bool {
        self.0[usize::from(index.0 / 64)] >> (index.0 % 64) & 1 == 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn items(text: &str) -> Vec<(ItemKey, Option<u16>, bool)> {
        let listing = Listing::of(&Datasheet::parse(text.as_bytes()));
        let item = |item: &Item| (item.key, item.index.map(|index| index.0), item.lacks_prefix);
        listing.items().iter().map(item).collect()
    }

    #[test]
    fn an_item_means_what_is_described() {
        let number = ItemKey::Number;
        assert_eq!(items("[OptionalObjects]\n1=0x1017\n"), [(number(1), Some(0x1017), false)]);
        assert_eq!(items("[OptionalObjects]\n1=1017\n"), [(number(1), Some(1017), false)]);
        assert_eq!(items("[OptionalObjects]\n1=1017\n[1017]\n"), [(number(1), Some(0x1017), true)]);
        assert_eq!(items("[OptionalObjects]\n1=4119\n[1017]\n"), [(number(1), Some(0x1017), false)]);
        assert_eq!(items("[OptionalObjects]\n1=100C\n[100C]\n"), [(number(1), Some(0x100C), true)]);
        assert_eq!(items("[OptionalObjects]\n1=\n2=x\n"), [(number(2), None, false)]);
        assert_eq!(items("[OptionalObjects]\n1=0x1017 ; time\n"), [(number(1), Some(0x1017), false)]);
    }

    #[test]
    fn an_index_may_stand_in_the_key() {
        assert_eq!(items("[OptionalObjects]\n1017=1\n[1017]\n"), [(ItemKey::Index, Some(0x1017), false)]);
        assert_eq!(
            items("[OptionalObjects]\nIndex0=0x1017\n[1017]\n"),
            [(ItemKey::Other, Some(0x1017), false)]
        );
        assert_eq!(items("[OptionalObjects]\nIndex0=0x1017\n"), []);
        let large = "[OptionalObjects]\n1017=0x3000\n[1017]\n";
        assert_eq!(items(large), [(ItemKey::Number(1017), Some(0x3000), false)]);
    }

    #[test]
    fn lists_know_their_items_and_what_they_lack() {
        let text = "[ManufacturerObjects]\n1=0x2000\n2=0x2000\n[MandatoryObjects]\n1=0x1000\n[1000]\n[1017]\n[2001]\n[C000]\n[0005]\n";
        let sheet = Datasheet::parse(text.as_bytes());
        let listing = Listing::of(&sheet);
        assert_eq!(List::ALL.map(|list| listing.items_of(list).len()), [1, 0, 2]);
        assert_eq!(listing.repeated().map(|item| item.number()).collect::<Vec<_>>(), [Some(2)]);
        assert_eq!(listing.unlisted(&sheet, List::Optional), [Index(0x1017)]);
        assert_eq!(listing.unlisted(&sheet, List::Manufacturer), [Index(0x2001)]);
        assert!(listing.is_described(Index(0xC000)) && !listing.is_described(Index(0xFFFF)));
    }
}
