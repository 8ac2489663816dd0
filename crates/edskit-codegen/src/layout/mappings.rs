//! Which values the PDOs carry at power-on, and whether they can.

use super::Layout;
use super::gather::Item;
use crate::{InputFile, Problem};
use core::fmt;
use edskit_lint::Severity;
use edskit_model::{Document, Position as TextPosition, Span};
use edskit_runtime::Flags;
use edskit_types::{CobId, DataType, Index, MappingEntry, PdoDirection, SubIndex};

/// The most entries of a mapping; a greater number stands for a multiplexed PDO.
const MOST_ENTRIES: u8 = 64;
/// How far a mapping parameter lies behind the communication parameter of its PDO.
const DISTANCE: u16 = 0x200;
/// The most bits of a PDO.
const MOST_BITS: u32 = 64;

/// What a PDO carries at power-on.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Mapping {
    /// Received or transmitted.
    pub direction: PdoDirection,
    /// From 1.
    pub number: u16,
    /// Whether the PDO exists at power-on: bit 31 of its COB-ID does not say otherwise. One that does not exist carries nothing
    /// as long as nobody switches it on.
    pub is_valid: bool,
    /// Where the number of entries stands.
    pub place: Place,
    /// The mapped entries in their order; those that are 0 are left out.
    pub entries: Vec<Mapped>,
}

/// One mapped entry.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Mapped {
    /// The sub-index of the mapping parameter.
    pub sub_index: SubIndex,
    /// What is mapped.
    pub entry: MappingEntry,
    /// Where that stands.
    pub place: Place,
}

/// Where something stands.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Place {
    /// In which file.
    pub file: InputFile,
    /// At which bytes.
    pub span: Span,
    /// At which line and column.
    pub position: TextPosition,
}

impl Place {
    /// Where the value of an entry stands.
    pub(super) fn of(item: &Item, document: &Document) -> Self {
        let span = item.value_span;
        let is_eds = item.source.file == InputFile::Eds;
        let position = if is_eds { document.position(span.start) } else { item.source.position };
        Self { file: item.source.file, span, position }
    }
}

impl Mapping {
    /// The bits of all entries.
    #[must_use]
    pub fn bits(&self) -> u32 {
        self.entries.iter().map(|mapped| u32::from(mapped.entry.bits())).sum()
    }
}

/// `RPDO1`, `TPDO12`.
impl fmt::Display for Mapping {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let noun = match self.direction {
            PdoDirection::Receive => "RPDO",
            PdoDirection::Transmit => "TPDO",
        };
        write!(f, "{noun}{}", self.number)
    }
}

impl Layout {
    /// What is wrong with the mappings of power-on: an error where the PDO exists, else a warning. The generated code checks
    /// those of existing PDOs once more when it is compiled.
    #[must_use]
    pub fn mapping_problems(&self) -> Vec<Problem> {
        let mut problems = Vec::new();
        for mapping in &self.mappings {
            let mut report = |place: &Place, message: String| {
                problems.push(Problem {
                    severity: if mapping.is_valid { Severity::Error } else { Severity::Warning },
                    code: "GEN",
                    file: place.file,
                    span: place.span,
                    position: place.position,
                    message,
                    help: None,
                });
            };
            if mapping.bits() > MOST_BITS {
                let message = format!("{mapping} carries {} bits, and a PDO has {MOST_BITS}", mapping.bits());
                report(&mapping.place, message);
            }
            for mapped in &mapping.entries {
                if let Err(reason) = self.check(mapping.direction, mapped.entry) {
                    let entry = mapped.entry;
                    let what = format!("{} sub-index {}", entry.index(), entry.sub_index());
                    let bits = entry.bits();
                    report(
                        &mapped.place,
                        format!("{mapping} cannot carry {what} with {bits} bits: {reason}"),
                    );
                }
            }
        }
        problems
    }

    /// Whether a PDO can carry what a mapping entry names.
    fn check(&self, direction: PdoDirection, mapping: MappingEntry) -> Result<(), &'static str> {
        let index = mapping.index();
        if mapping.is_dummy() {
            let is_allowed = self.dummies.checked_shr(index.0.into()).is_some_and(|bits| bits & 1 == 1);
            let has_length =
                DataType::from_index(index).and_then(DataType::bits) == Some(mapping.bits().into());
            return match direction {
                PdoDirection::Transmit => Err("a TPDO has no gaps"),
                PdoDirection::Receive if !is_allowed => Err("[DummyUsage] does not allow it"),
                PdoDirection::Receive if !has_length || mapping.sub_index().0 != 0 => {
                    Err("the data type has another length")
                }
                PdoDirection::Receive => Ok(()),
            };
        }
        let found = self.table().find(index, mapping.sub_index()).ok();
        let Some(entry) = found.and_then(|position| self.table().entry(position)) else {
            return Err("there is no such entry");
        };
        let right = match direction {
            PdoDirection::Receive => Flags::RPDO,
            PdoDirection::Transmit => Flags::TPDO,
        };
        if !entry.flags.has(right) {
            let is_mappable = entry.flags.has(Flags::RPDO) || entry.flags.has(Flags::TPDO);
            return Err(if is_mappable {
                "it can be mapped in the other direction only"
            } else {
                "it cannot be mapped"
            });
        }
        let bits = mapping.bits();
        let has_length = match entry.data_type {
            DataType::Boolean => bits == 1 || bits == 8,
            data_type if data_type.is_string() => {
                (1..=64).contains(&bits) && bits.is_multiple_of(8) && u16::from(bits / 8) <= entry.size
            }
            data_type => data_type.bits() == Some(bits.into()),
        };
        if has_length { Ok(()) } else { Err("it has another length") }
    }
}

/// The mappings of a dictionary whose items are sorted.
pub(super) fn read(items: &[Item], document: &Document) -> Vec<Mapping> {
    let mut mappings = Vec::new();
    for object in items.chunk_by(|a, b| a.index == b.index) {
        let Some((direction, number)) = pdo_of(object[0].index) else { continue };
        let place = |item: &Item| Place::of(item, document);
        let count = &object[0];
        let Some(mapped) = count.default.as_ref().filter(|_| count.sub_index == SubIndex(0)) else {
            continue;
        };
        let highest = mapped.bytes.first().copied().unwrap_or(0);
        if highest == 0 || highest > MOST_ENTRIES {
            continue;
        }
        let entries = object[1..].iter().filter(|item| item.sub_index.0 <= highest);
        let mapped = entries.map(|item| Mapped {
            sub_index: item.sub_index,
            entry: MappingEntry(value(item)),
            place: place(item),
        });
        // An entry of 0 names nothing: sub-index 00h may stand for the room for entries, which are mapped later.
        let mapped = mapped.filter(|mapped| mapped.entry != MappingEntry(0));
        let cob_id = Index(object[0].index.0 - DISTANCE);
        let cob_id =
            items.binary_search_by_key(&(cob_id, SubIndex(1)), Item::key).ok().map(|found| &items[found]);
        let is_valid = cob_id.is_none_or(|cob_id| CobId(value(cob_id)).is_valid());
        mappings.push(Mapping {
            direction,
            number,
            is_valid,
            place: place(count),
            entries: mapped.collect(),
        });
    }
    mappings
}

/// The default of an item as an unsigned number.
fn value(item: &Item) -> u32 {
    let bytes = item.default.as_ref().map_or(&[][..], |default| &default.bytes);
    bytes.iter().take(4).rev().fold(0, |number, byte| number << 8 | u32::from(*byte))
}

/// The PDO whose mapping parameter is at an index.
fn pdo_of(index: Index) -> Option<(PdoDirection, u16)> {
    if index.is_rpdo_mapping() {
        Some((PdoDirection::Receive, index.0 - Index::RPDO_MAPPING.0 + 1))
    } else if index.is_tpdo_mapping() {
        Some((PdoDirection::Transmit, index.0 - Index::TPDO_MAPPING.0 + 1))
    } else {
        None
    }
}
