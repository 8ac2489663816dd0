//! The PDOs that a file describes, read once for all rules that ask about them.

use crate::evaluate::Effective;
use core::fmt;
use edskit_model::{Datasheet, Description, DictionaryEntry, KeyName, Object, Pdo, Section};
use edskit_types::{
    CobId, DataType, MappingEntry, NodeId, PdoDirection, SubIndex, Transmission, TransmissionType,
};

/// The most entries of one mapping.
pub(crate) const MOST_ENTRIES: u8 = 64;
/// The most bits of one PDO.
pub(crate) const MOST_BITS: u32 = 64;

/// One described PDO with its parameters.
pub(crate) struct DescribedPdo<'a> {
    pub(crate) direction: PdoDirection,
    /// From 1.
    pub(crate) number: u16,
    /// 1400h.. or 1800h..
    pub(crate) communication: Option<Object<'a>>,
    /// 1600h.. or 1A00h..
    pub(crate) mapping: Option<Object<'a>>,
    /// Sub-index 01h of the communication parameter.
    pub(crate) cob_id: Option<Effective<'a>>,
    /// Sub-index 02h of the communication parameter.
    pub(crate) transmission_type: Option<Effective<'a>>,
    /// Sub-index 00h of the mapping parameter.
    pub(crate) count: Option<Effective<'a>>,
    /// The entries of the mapping parameter that say something, in ascending order.
    pub(crate) entries: Vec<Mapped<'a>>,
}

/// One entry of a mapping parameter.
#[derive(Clone, Copy)]
pub(crate) struct Mapped<'a> {
    pub(crate) sub_index: SubIndex,
    /// Where the entry stands.
    pub(crate) value: Effective<'a>,
    pub(crate) entry: MappingEntry,
    /// What is mapped.
    pub(crate) target: Target<'a>,
}

/// What a mapping entry names.
#[derive(Clone, Copy)]
pub(crate) enum Target<'a> {
    /// Nothing: the entry is 0.
    Zero,
    /// A data type, which only fills a gap.
    Dummy,
    /// An entry of the dictionary.
    Entry(DictionaryEntry<'a>),
    /// A sub-index that this object does not have.
    NoSubIndex(Object<'a>),
    /// An object that is not described.
    NoObject,
    /// Something behind the mapped entries, which nobody looks up.
    Leftover,
}

impl<'a> DescribedPdo<'a> {
    fn read(sheet: &'a Datasheet, pdo: Pdo<'a>) -> Self {
        let parameter = |object: Option<Object<'a>>, sub_index, data_type| {
            number(object?.dictionary_entry(SubIndex(sub_index))?, data_type)
        };
        let mut read = Self {
            direction: pdo.direction,
            number: pdo.number,
            communication: pdo.communication,
            mapping: pdo.mapping,
            cob_id: parameter(pdo.communication, 1, DataType::Unsigned32),
            transmission_type: parameter(pdo.communication, 2, DataType::Unsigned8),
            count: parameter(pdo.mapping, 0, DataType::Unsigned8),
            entries: Vec::new(),
        };
        if let Some(mapping) = pdo.mapping {
            read.entries = mapped(sheet, mapping, read.mapped_count().unwrap_or(0));
        }
        read
    }

    /// A parameter of the communication record.
    pub(crate) fn parameter(&self, sub_index: u8) -> Option<Effective<'a>> {
        Effective::of(self.communication?, sub_index)
    }

    /// How many entries are mapped, 0 to 64; `None` where the file says nothing, something invalid, or that the PDO is
    /// multiplexed.
    pub(crate) fn mapped_count(&self) -> Option<u8> {
        self.count?.constant().filter(|count| *count <= MOST_ENTRIES)
    }

    /// The entries that are mapped: those that sub-index 00h counts.
    pub(crate) fn mapped(&self) -> &[Mapped<'a>] {
        let count = self.mapped_count().unwrap_or(0);
        let end = self.entries.partition_point(|entry| entry.sub_index.0 <= count);
        &self.entries[..end]
    }

    /// The entries behind those that are mapped; none where sub-index 00h says nothing.
    pub(crate) fn leftover(&self) -> &[Mapped<'a>] {
        if self.mapped_count().is_some() { &self.entries[self.mapped().len()..] } else { &[] }
    }

    /// Whether bit 31 of the COB-ID says that the PDO is in use; `None` where the file says nothing.
    pub(crate) fn is_valid(&self) -> Option<bool> {
        self.cob_id_bits().map(CobId::is_valid)
    }

    /// The COB-ID at the lowest node-ID, for its bits 29 to 31.
    pub(crate) fn cob_id_bits(&self) -> Option<CobId> {
        self.cob_id?.cob_id_at(NodeId::MIN)
    }

    /// What the transmission type says.
    pub(crate) fn transmission(&self) -> Option<Transmission> {
        let number = self.transmission_type?.constant().map(TransmissionType)?;
        Some(number.meaning(self.direction))
    }
}

/// `RPDO1`, `TPDO12`.
impl fmt::Display for DescribedPdo<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", noun(self.direction), self.number)
    }
}

/// `RPDO`, `TPDO`.
pub(crate) const fn noun(direction: PdoDirection) -> &'static str {
    match direction {
        PdoDirection::Receive => "RPDO",
        PdoDirection::Transmit => "TPDO",
    }
}

impl<'a> Target<'a> {
    fn of(sheet: &'a Datasheet, entry: MappingEntry) -> Self {
        if entry.0 == 0 {
            return Self::Zero;
        }
        if entry.is_dummy() {
            return Self::Dummy;
        }
        let Some(object) = sheet.object(entry.index()) else { return Self::NoObject };
        object.dictionary_entry(entry.sub_index()).map_or(Self::NoSubIndex(object), Self::Entry)
    }
}

impl Target<'_> {
    fn of_leftover(entry: MappingEntry) -> Self {
        match entry {
            MappingEntry(0) => Self::Zero,
            _ if entry.is_dummy() => Self::Dummy,
            _ => Self::Leftover,
        }
    }
}

impl Mapped<'_> {
    /// The data type of what is mapped, if CiA 301 defines it.
    pub(crate) fn data_type(&self) -> Option<DataType> {
        match self.target {
            Target::Entry(entry) => entry.data_type(),
            Target::Dummy => DataType::from_index(self.entry.index()),
            _ => None,
        }
    }
}

/// Where the attributes of a dictionary entry stand: its own section, or that of an object with CompactSubObj.
pub(crate) fn attributes<'a>(sheet: &'a Datasheet, entry: DictionaryEntry<'a>) -> Option<Section<'a>> {
    match entry.description() {
        Some(description) => Some(description.section()),
        None => sheet.object(entry.index).map(|object| object.section()),
    }
}

/// `1 bit`, `8 bits`.
pub(crate) fn bits(count: impl Into<u32>) -> String {
    match count.into() {
        1 => "1 bit".to_owned(),
        count => format!("{count} bits"),
    }
}

/// `6040h`, `6000h sub-index 01h`.
pub(crate) fn place_of(sheet: &Datasheet, entry: DictionaryEntry<'_>) -> String {
    let code = sheet.object(entry.index).and_then(|object| object.object_code());
    if entry.sub_index.0 > 0 || code.is_some_and(|code| code.has_sub_objects()) {
        format!("{} sub-index {}", entry.index, entry.sub_index)
    } else {
        entry.index.to_string()
    }
}

/// Every PDO of the file, RPDOs first.
pub(crate) fn read(sheet: &Datasheet) -> Vec<DescribedPdo<'_>> {
    let directions = [PdoDirection::Receive, PdoDirection::Transmit];
    let pdos = directions.into_iter().flat_map(|direction| sheet.pdos(direction));
    pdos.map(|pdo| DescribedPdo::read(sheet, pdo)).collect()
}

/// The entries of a mapping parameter, of which `count` are mapped.
fn mapped<'a>(sheet: &'a Datasheet, mapping: Object<'a>, count: u8) -> Vec<Mapped<'a>> {
    let entry = |sub_index: SubIndex, value: Option<Effective<'a>>| {
        let value = value?;
        let entry = MappingEntry(value.constant()?);
        let target = if sub_index.0 <= count { Target::of(sheet, entry) } else { Target::of_leftover(entry) };
        Some(Mapped { sub_index, value, entry, target })
    };
    if mapping.compact_count() > 0 {
        let value = |sub_index| number(mapping.dictionary_entry(sub_index)?, DataType::Unsigned32);
        return (1..=MOST_ENTRIES).map(SubIndex).filter_map(|sub| entry(sub, value(sub))).collect();
    }
    let subs = mapping.sub_objects().filter(|sub| (1..=MOST_ENTRIES).contains(&sub.sub_index().0));
    subs.filter_map(|sub| entry(sub.sub_index(), described_number(sub.description(), DataType::Unsigned32)))
        .collect()
}

/// The number that an entry of the dictionary holds. CiA 301 fixes the data types of PDO parameters, so what the file
/// says about them is not read (COM002 compares it).
fn number<'a>(entry: DictionaryEntry<'a>, data_type: DataType) -> Option<Effective<'a>> {
    match entry.description() {
        Some(description) => described_number(description, data_type),
        None => Effective::new(entry.value_field()?, data_type),
    }
}

fn described_number<'a>(description: Description<'a>, data_type: DataType) -> Option<Effective<'a>> {
    let configured = description.filled(KeyName::ParameterValue);
    let entry = configured.or_else(|| description.filled(KeyName::DefaultValue))?;
    Effective::new(entry.value(Some(data_type)), data_type)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_know_what_they_name() {
        let text = "[1800]\nObjectType=9\n[1800sub1]\nDataType=7\nDefaultValue=$NODEID+0x80000180\n[1800sub2]\nDataType=5\nDefaultValue=1\n\
            [1A00]\nObjectType=9\n[1A00sub0]\nDataType=5\nDefaultValue=4\n[1A00sub1]\nDataType=7\nDefaultValue=0x60410010\n\
            [1A00sub2]\nDataType=7\nDefaultValue=0x00050008\n[1A00sub3]\nDataType=7\nDefaultValue=0x60410110\n\
            [1A00sub4]\nDataType=7\nDefaultValue=0\n[1A00sub5]\nDataType=7\nDefaultValue=0x60420010\n[6041]\nDataType=6\n";
        let sheet = Datasheet::parse(text.as_bytes());
        let pdos = read(&sheet);
        let [pdo] = &pdos[..] else { panic!("one PDO") };
        assert_eq!(pdo.to_string(), "TPDO1");
        assert_eq!(pdo.is_valid(), Some(false));
        assert_eq!(pdo.transmission(), Some(Transmission::SynchronousCyclic(1)));
        assert!(matches!(pdo.mapped()[0].target, Target::Entry(_)));
        assert!(matches!(pdo.mapped()[1].target, Target::Dummy));
        assert!(matches!(pdo.mapped()[2].target, Target::NoSubIndex(_)));
        assert!(matches!(pdo.mapped()[3].target, Target::Zero));
        assert_eq!(pdo.leftover().len(), 1);
        assert!(matches!(pdo.leftover()[0].target, Target::Leftover));
    }

    #[test]
    fn a_multiplexed_pdo_maps_nothing() {
        let text = "[1A00]\nObjectType=9\n[1A00sub0]\nDataType=5\nDefaultValue=255\n[1A00sub1]\nDataType=7\nDefaultValue=0x60410010\n";
        let sheet = Datasheet::parse(text.as_bytes());
        let pdos = read(&sheet);
        assert!(pdos[0].mapped().is_empty() && pdos[0].leftover().is_empty());
        assert_eq!(pdos[0].entries.len(), 1);
    }

    #[test]
    fn compact_mappings_are_read_too() {
        let text = "[1600]\nObjectType=9\nDataType=7\nCompactSubObj=8\n[1600Value]\nNrOfEntries=1\n2=0x60400010\n[6040]\nDataType=6\n";
        let sheet = Datasheet::parse(text.as_bytes());
        let pdos = read(&sheet);
        assert_eq!(pdos[0].mapped().iter().map(|mapped| mapped.sub_index.0).collect::<Vec<_>>(), [2]);
    }
}
