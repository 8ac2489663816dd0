//! The object dictionary as the file means it, compact storage expanded entry by entry (CiA 306 v1.3, 4.6.3.4).

use super::{Datasheet, Description, Entry, Field, Object};
use crate::key::KeyName;
use crate::section::SectionKind;
use crate::value::{Number, Value};
use edskit_types::{AccessType, DataType, Index, MappingEntry, PdoDirection, SubIndex};
use std::borrow::Cow;

/// What CiA 306 v1.3, 4.6.3.4.2 calls sub-index 00h of a compact object.
const COUNT_NAME: &str = "NrOfObjects";

/// One entry of the object dictionary: described in a section of its own, or by compact storage.
#[derive(Clone, Copy, Debug)]
pub struct DictionaryEntry<'a> {
    /// The index.
    pub index: Index,
    /// The sub-index.
    pub sub_index: SubIndex,
    origin: Origin<'a>,
}

#[derive(Clone, Copy, Debug)]
enum Origin<'a> {
    /// A section of its own.
    Described(Description<'a>),
    /// Sub-index 00h of an object with CompactSubObj.
    Count(Object<'a>),
    /// One of the equal sub-objects of an object with CompactSubObj.
    Element(Object<'a>),
}

impl<'a> DictionaryEntry<'a> {
    /// The section that describes the entry; `None` for one that exists through CompactSubObj.
    pub fn description(self) -> Option<Description<'a>> {
        match self.origin {
            Origin::Described(description) => Some(description),
            Origin::Count(_) | Origin::Element(_) => None,
        }
    }

    /// The name: ParameterName, the entry of `[xxxxName]`, or ParameterName and the decimal sub-index.
    pub fn name(self) -> Cow<'a, str> {
        let own_name =
            |description: Description<'a>| description.parameter_name().map_or(Cow::default(), Entry::text);
        match self.origin {
            Origin::Described(description) => own_name(description),
            Origin::Count(_) => Cow::Borrowed(COUNT_NAME),
            Origin::Element(object) => match self.listed(object, SectionKind::CompactNames) {
                Some(entry) => entry.text(),
                None => Cow::Owned(format!("{}{}", own_name(object.description()), self.sub_index.0)),
            },
        }
    }

    /// The data type, if it is one of CiA 301.
    pub fn data_type(self) -> Option<DataType> {
        match self.origin {
            Origin::Described(description) => description.standard_type(),
            Origin::Count(_) => Some(DataType::Unsigned8),
            Origin::Element(object) => object.standard_type(),
        }
    }

    /// The access.
    pub fn access(self) -> Option<AccessType> {
        match self.origin {
            Origin::Described(description) => description.access(),
            // Clearing the error history is to write its count, however it is stored (CiA 301 v4.2, 7.5.2.4).
            Origin::Count(object) if object.index() == Index::PREDEFINED_ERROR_FIELD => Some(AccessType::Rw),
            Origin::Count(_) => Some(AccessType::Ro),
            Origin::Element(object) => object.access(),
        }
    }

    /// Whether the entry may be mapped into a PDO.
    pub fn is_mappable(self) -> bool {
        match self.origin {
            Origin::Described(description) => description.is_mappable(),
            Origin::Count(_) => false,
            Origin::Element(object) => object.is_mappable(),
        }
    }

    /// The default value, if there is one that can be read.
    pub fn default_value(self) -> Option<Value<'a>> {
        match self.origin {
            Origin::Described(description) => description.default_value()?.known(),
            Origin::Count(object) if object.index() == Index::PREDEFINED_ERROR_FIELD => {
                Some(Value::Integer(Number::decimal(0)))
            }
            Origin::Count(object) => Some(Value::Integer(Number::decimal(object.compact_count().into()))),
            Origin::Element(object) => object.default_value()?.known(),
        }
    }

    /// The value that counts: ParameterValue or the entry of `[xxxxValue]` where there is one, else the default.
    pub fn value(self) -> Option<Value<'a>> {
        let configured = match self.origin {
            Origin::Described(description) => description.parameter_value().and_then(Field::known),
            Origin::Count(_) => None,
            Origin::Element(object) => self
                .listed(object, SectionKind::CompactValues)
                .and_then(|entry| entry.value(object.standard_type()).known()),
        };
        let value = configured.or_else(|| self.default_value());
        self.mapped_without_prefix().or(value)
    }

    /// The mapping entry that was meant where its `0x` was forgotten: `60410010`, of which only the hexadecimal reading names
    /// an entry of the dictionary.
    fn mapped_without_prefix(self) -> Option<Value<'a>> {
        let is_mapping = self.index.is_rpdo_mapping() || self.index.is_tpdo_mapping();
        if !is_mapping || !(1..=64).contains(&self.sub_index.0) {
            return None;
        }
        let entry = self.written()?.entry;
        let meant = entry.sheet.mapping_without_prefix(entry.raw())?;
        Number::parse(format!("0x{:08X}", meant.0).as_bytes()).ok().map(Value::Integer)
    }

    /// The value that counts, with its place: ParameterValue or the entry of `[xxxxValue]` where there is one, readable
    /// or not, else DefaultValue; CompactSubObj for sub-index 00h of a compact object.
    pub fn value_field(self) -> Option<Field<'a, Value<'a>>> {
        let field = self.written()?;
        let meant = self.mapped_without_prefix();
        Some(Field { value: meant.map_or(field.value, Ok), ..field })
    }

    /// The value that counts, as it is written.
    fn written(self) -> Option<Field<'a, Value<'a>>> {
        match self.origin {
            Origin::Described(description) => description.value(),
            // How many errors there are, no entry of the file can say.
            Origin::Count(object) if object.index() == Index::PREDEFINED_ERROR_FIELD => None,
            Origin::Count(object) => Some(object.compact_sub_obj()?.entry.value(Some(DataType::Unsigned8))),
            Origin::Element(object) => {
                let listed = self.listed(object, SectionKind::CompactValues);
                listed.map(|entry| entry.value(object.standard_type())).or_else(|| object.default_value())
            }
        }
    }

    /// The application's name in a DCF: Denotation, or the entry of `[xxxxDenotation]`.
    pub fn denotation(self) -> Option<Cow<'a, str>> {
        match self.origin {
            Origin::Described(description) => description.denotation().map(Entry::text),
            Origin::Count(_) => None,
            Origin::Element(object) => self.listed(object, SectionKind::CompactDenotations).map(Entry::text),
        }
    }

    /// The limits in force, readable or not: those of the description or, where it has none, those of its range type.
    pub fn limits(self) -> [Option<Field<'a, Value<'a>>>; 2] {
        let (description, own) = match self.origin {
            Origin::Described(description) => {
                (description, [description.low_limit(), description.high_limit()])
            }
            // A compact entry has no limits of its own.
            Origin::Element(object) => (object.description(), [None, None]),
            Origin::Count(_) => return [None, None],
        };
        let of_type =
            description.resolved_type().map_or([None, None], |resolved| [resolved.low, resolved.high]);
        let [own_low, own_high] = own;
        let [low, high] = of_type;
        [own_low.or(low), own_high.or(high)]
    }

    /// Whether it is one of the equal entries of an object with CompactSubObj and has no value, name or denotation of its
    /// own, nor is it their number.
    pub fn is_like_others(self) -> bool {
        let lists = [SectionKind::CompactNames, SectionKind::CompactValues, SectionKind::CompactDenotations];
        match self.origin {
            Origin::Described(_) => false,
            Origin::Count(_) => true,
            Origin::Element(object) => lists.into_iter().all(|kind| self.listed(object, kind).is_none()),
        }
    }

    fn listed(self, object: Object<'a>, kind: fn(Index) -> SectionKind) -> Option<Entry<'a>> {
        let list = object.sheet().section(kind(self.index))?;
        list.numbered(KeyName::Item, self.sub_index.0.into()).filter(|entry| !entry.is_empty())
    }
}

impl<'a> Object<'a> {
    /// How many sub-objects CompactSubObj claims; 0 for none.
    pub fn compact_count(self) -> u8 {
        self.compact_sub_obj().and_then(|field| field.known()).unwrap_or(0)
    }

    /// The entry at `sub_index`, described or compact.
    pub fn dictionary_entry(self, sub_index: SubIndex) -> Option<DictionaryEntry<'a>> {
        let entry = |origin| DictionaryEntry { index: self.index(), sub_index, origin };
        if let Some(sub) = self.sub_object(sub_index) {
            return Some(entry(Origin::Described(sub.description())));
        }
        let compact = self.compact_count();
        // Where the object code cannot be read, the sections say what the object is.
        let is_described = || self.sub_objects().len() > 0;
        let has_subs =
            compact > 0 || self.object_code().map_or_else(is_described, |code| code.has_sub_objects());
        let origin = if !has_subs {
            (sub_index.0 == 0).then_some(Origin::Described(self.description()))?
        } else if compact > 0 && sub_index.0 == 0 {
            Origin::Count(self)
        } else if sub_index.0 <= compact && sub_index.0 > 0 {
            Origin::Element(self)
        } else {
            return None;
        };
        Some(entry(origin))
    }

    /// Every entry of the object in ascending order, compact ones made as they are asked for.
    pub fn dictionary_entries(self) -> impl Iterator<Item = DictionaryEntry<'a>> {
        let last =
            self.sub_objects().next_back().map_or(0, |sub| sub.sub_index().0).max(self.compact_count());
        (0..=last).filter_map(move |sub_index| self.dictionary_entry(SubIndex(sub_index)))
    }
}

impl Datasheet {
    /// The entry at `index` and `sub_index`, described or compact.
    ///
    /// ```
    /// use edskit_model::Datasheet;
    /// use edskit_types::{Index, SubIndex};
    /// let sheet = Datasheet::parse(b"[2100]\nParameterName=Ramp\nObjectType=8\nDataType=5\nCompactSubObj=9\n");
    /// assert_eq!(sheet.dictionary_entry(Index(0x2100), SubIndex(3)).unwrap().name(), "Ramp3");
    /// ```
    pub fn dictionary_entry(&self, index: Index, sub_index: SubIndex) -> Option<DictionaryEntry<'_>> {
        self.object(index)?.dictionary_entry(sub_index)
    }

    /// The mapping entry whose `0x` was forgotten: eight decimal digits that name no entry of the dictionary, unless they are
    /// read as hexadecimal.
    pub(crate) fn mapping_without_prefix(&self, text: &[u8]) -> Option<MappingEntry> {
        if text.len() != 8 || !text.iter().all(u8::is_ascii_digit) {
            return None;
        }
        let text = core::str::from_utf8(text).ok()?;
        let is_there =
            |entry: &MappingEntry| self.dictionary_entry(entry.index(), entry.sub_index()).is_some();
        let written = MappingEntry(text.parse().ok()?);
        let meant = MappingEntry(u32::from_str_radix(text, 16).ok()?);
        (!is_there(&written) && is_there(&meant)).then_some(meant)
    }

    /// The PDOs that exist only through CompactPDO and the number of PDOs in `[DeviceInfo]`, in ascending order
    /// (CiA 306 v1.3, 4.6.3.4.1). They take the lowest communication indices that no object describes.
    pub fn implicit_pdos(&self, direction: PdoDirection) -> impl Iterator<Item = ImplicitPdo> + '_ {
        let info = self.device_info();
        let mask = info.and_then(|info| info.compact_pdo()?.known()).unwrap_or(0);
        let count = info.and_then(|info| info.pdo_count(direction)?.known()).unwrap_or(0);
        let base = communication_base(direction);
        let described = self.objects().filter(|object| object.index().0 & 0xFE00 == base & 0xFE00).count();
        let implicit = if mask == 0 { 0 } else { usize::from(count).saturating_sub(described) };
        (0..512u16)
            .map(move |offset| ImplicitPdo { direction, number: offset + 1, mask })
            .filter(|pdo| self.object(pdo.communication()).is_none())
            .take(implicit)
    }
}

fn communication_base(direction: PdoDirection) -> u16 {
    match direction {
        PdoDirection::Receive => Index::RPDO_COMMUNICATION.0,
        PdoDirection::Transmit => Index::TPDO_COMMUNICATION.0,
    }
}

/// A PDO that no section describes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct ImplicitPdo {
    /// Received or transmitted.
    pub direction: PdoDirection,
    /// The PDO number, 1..512.
    pub number: u16,
    /// CompactPDO: bit k-1 says whether sub-index k of the communication record exists.
    pub mask: u8,
}

impl ImplicitPdo {
    /// The index of the communication parameter.
    pub fn communication(self) -> Index {
        Index(communication_base(self.direction) + self.number - 1)
    }

    /// The index of the mapping parameter.
    pub fn mapping(self) -> Index {
        Index(self.communication().0 + 0x200)
    }

    /// Whether the communication record has a sub-index 1..8.
    pub fn has_sub_index(self, sub_index: SubIndex) -> bool {
        matches!(sub_index.0, 1..=8) && self.mask >> (sub_index.0 - 1) & 1 == 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const COMPACT: &str = "[2100]\nParameterName=Ramp\nObjectType=8\nDataType=0x6\nAccessType=rw\nDefaultValue=7\nPDOMapping=1\nCompactSubObj=3\n[2100Name]\nNrOfEntries=1\n2=Slope\n[2100Value]\nNrOfEntries=1\n3=0x20\n[2100Denotation]\nNrOfEntries=1\n1=Start\n[2100subFF]\nParameterName=Structure\nDataType=7\n";

    #[test]
    fn compact_sub_objects_are_made_on_demand() {
        let sheet = Datasheet::parse(COMPACT.as_bytes());
        let entries: Vec<_> = sheet.object(Index(0x2100)).unwrap().dictionary_entries().collect();
        let names: Vec<_> = entries.iter().map(|entry| entry.name()).collect();
        assert_eq!(names, ["NrOfObjects", "Ramp1", "Slope", "Ramp3", "Structure"]);
        let values: Vec<_> = entries[..4]
            .iter()
            .map(|entry| entry.value().unwrap().integer(entry.data_type().unwrap(), None).unwrap())
            .collect();
        assert_eq!(values, [3, 7, 7, 0x20]);
        assert_eq!(entries[1].denotation().as_deref(), Some("Start"));
        assert_eq!(entries[0].access(), Some(AccessType::Ro));
        assert!(!entries[0].is_mappable() && entries[1].is_mappable());
        assert_eq!(entries[4].sub_index, SubIndex(0xFF));
        assert!(sheet.dictionary_entry(Index(0x2100), SubIndex(4)).is_none());
        let places: Vec<_> =
            entries[..4].iter().map(|entry| entry.value_field().unwrap().entry.line_number() + 1).collect();
        assert_eq!(places, [8, 6, 6, 14]);
    }

    #[test]
    fn a_variable_has_sub_index_0_alone() {
        let sheet = Datasheet::parse(b"[1000]\nParameterName=Type\nDataType=7\nDefaultValue=3\n");
        let value = sheet.dictionary_entry(Index(0x1000), SubIndex(0)).unwrap().value().unwrap();
        assert_eq!(value.integer(DataType::Unsigned32, None), Ok(3));
        assert_eq!(sheet.dictionary_entry(Index(0x1000), SubIndex(0)).unwrap().name(), "Type");
        assert!(sheet.dictionary_entry(Index(0x1000), SubIndex(1)).is_none());
        assert!(sheet.dictionary_entry(Index(0x1001), SubIndex(0)).is_none());
    }

    #[test]
    fn a_mapping_may_lack_its_prefix() {
        let text = b"[1A00]\nObjectType=9\n[1A00sub1]\nDataType=7\nDefaultValue=60410010\n[1A00sub2]\nDataType=7\nDefaultValue=60420010\n[6041]\nDataType=6\n";
        let sheet = Datasheet::parse(text);
        let value = |sub_index| {
            let entry = sheet.dictionary_entry(Index(0x1A00), SubIndex(sub_index)).unwrap();
            let value = entry.value_field().unwrap().known().unwrap();
            assert_eq!(entry.value(), Some(value));
            value.integer(DataType::Unsigned32, None)
        };
        assert_eq!((value(1), value(2)), (Ok(0x6041_0010), Ok(60_420_010)), "6042h is not described");
        assert_eq!(sheet.assumed().len(), 1);
    }

    #[test]
    fn implicit_pdos_fill_the_gaps() {
        let sheet = Datasheet::parse(
            b"[DeviceInfo]\nCompactPDO=0x13\nNrOfRXPDO=3\nNrOfTXPDO=0\n[1401]\nObjectType=9\n",
        );
        let pdos: Vec<_> = sheet.implicit_pdos(PdoDirection::Receive).collect();
        assert_eq!(pdos.iter().map(|pdo| pdo.number).collect::<Vec<_>>(), [1, 3]);
        assert_eq!(pdos[1].communication(), Index(0x1402));
        assert_eq!(pdos[1].mapping(), Index(0x1602));
        assert!(pdos[0].has_sub_index(SubIndex(5)) && !pdos[0].has_sub_index(SubIndex(3)));
        assert_eq!(sheet.implicit_pdos(PdoDirection::Transmit).count(), 0);
    }
}
