//! The PDOs that a file describes: communication and mapping parameters brought together.

use super::{Datasheet, DictionaryEntry, Object};
use crate::value::Value;
use core::iter;
use edskit_types::{DataType, Index, MappingEntry, NodeId, PdoDirection, SubIndex, TransmissionType};

/// One described PDO.
#[derive(Clone, Copy, Debug)]
pub struct Pdo<'a> {
    /// Received or transmitted.
    pub direction: PdoDirection,
    /// The PDO number, 1..512.
    pub number: u16,
    /// The communication parameter, 1400h.. or 1800h..
    pub communication: Option<Object<'a>>,
    /// The mapping parameter, 1600h.. or 1A00h..
    pub mapping: Option<Object<'a>>,
}

/// How many PDOs there can be in each direction.
const MAXIMUM: u16 = 512;

impl Datasheet {
    /// The PDOs of which the communication or the mapping parameter is described, in ascending order.
    pub fn pdos(&self, direction: PdoDirection) -> impl Iterator<Item = Pdo<'_>> {
        let (communication, mapping) = match direction {
            PdoDirection::Receive => (Index::RPDO_COMMUNICATION, Index::RPDO_MAPPING),
            PdoDirection::Transmit => (Index::TPDO_COMMUNICATION, Index::TPDO_MAPPING),
        };
        let block = |first: Index| self.objects_in(first..=Index(first.0 + (MAXIMUM - 1)));
        let (mut communication, mut mapping) = (block(communication).peekable(), block(mapping).peekable());
        // Each block begins at a multiple of 512.
        let offset = |object: &Object<'_>| object.index().0 % MAXIMUM;
        iter::from_fn(move || {
            let next = [communication.peek(), mapping.peek()].into_iter().flatten().map(offset).min()?;
            let communication = communication.next_if(|object| offset(object) == next);
            let mapping = mapping.next_if(|object| offset(object) == next);
            Some(Pdo { direction, number: next + 1, communication, mapping })
        })
    }
}

impl<'a> Pdo<'a> {
    /// The COB-ID, symbolic where it depends on the node-ID.
    pub fn cob_id(self) -> Option<Value<'a>> {
        parameter(self.communication, 1)?.value()
    }

    /// The transmission type.
    pub fn transmission_type(self) -> Option<TransmissionType> {
        number(parameter(self.communication, 2)?, None).map(TransmissionType)
    }

    /// The inhibit time in multiples of 100 µs.
    pub fn inhibit_time(self) -> Option<u16> {
        number(parameter(self.communication, 3)?, None)
    }

    /// The event timer in milliseconds.
    pub fn event_timer(self) -> Option<u16> {
        number(parameter(self.communication, 5)?, None)
    }

    /// How many entries are mapped, by sub-index 00h of the mapping parameter.
    pub fn mapped_count(self) -> Option<u8> {
        number(parameter(self.mapping, 0)?, None)
    }

    /// The mapped entries by their sub-index, as many as sub-index 00h says; `None` for one that says nothing.
    pub fn mapped(self, node_id: Option<NodeId>) -> impl Iterator<Item = (SubIndex, Option<MappingEntry>)> {
        // More than 64 entries cannot be mapped; 254 and 255 stand for multiplexed PDOs.
        let count = self.mapped_count().filter(|count| *count <= 64).unwrap_or(0);
        (1..=count).map(move |sub_index| {
            let entry = parameter(self.mapping, sub_index).and_then(|entry| number(entry, node_id));
            (SubIndex(sub_index), entry.map(MappingEntry))
        })
    }
}

fn parameter(object: Option<Object<'_>>, sub_index: u8) -> Option<DictionaryEntry<'_>> {
    object?.dictionary_entry(SubIndex(sub_index))
}

fn number<T: TryFrom<i128>>(entry: DictionaryEntry<'_>, node_id: Option<NodeId>) -> Option<T> {
    let data_type = entry.data_type().unwrap_or(DataType::Unsigned32);
    T::try_from(entry.value()?.integer(data_type, node_id).ok()?).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    const TPDO: &str = "[1800]\nObjectType=9\nSubNumber=3\n[1800sub0]\nDataType=5\nDefaultValue=2\n[1800sub1]\nDataType=7\nDefaultValue=$NODEID+0x180\n[1800sub2]\nDataType=5\nDefaultValue=0xFE\n[1A00]\nObjectType=9\n[1A00sub0]\nDataType=5\nDefaultValue=2\n[1A00sub1]\nDataType=7\nDefaultValue=0x60410010\n[1A01]\nObjectType=9\n[1803]\nObjectType=9\n[1A03]\nObjectType=9\n";

    #[test]
    fn parameters_are_brought_together() {
        let sheet = Datasheet::parse(TPDO.as_bytes());
        let pdos: Vec<_> = sheet.pdos(PdoDirection::Transmit).collect();
        assert_eq!(pdos.iter().map(|pdo| pdo.number).collect::<Vec<_>>(), [1, 2, 4]);
        let first = pdos[0];
        assert!(matches!(first.cob_id(), Some(Value::Formula(formula)) if formula.offset() == 0x180));
        assert_eq!(first.transmission_type(), Some(TransmissionType(0xFE)));
        assert_eq!((first.inhibit_time(), first.event_timer()), (None, None));
        let mapped: Vec<_> = first.mapped(None).collect();
        assert_eq!(mapped, [(SubIndex(1), Some(MappingEntry(0x6041_0010))), (SubIndex(2), None)]);
        assert!(pdos[2].communication.is_some() && pdos[2].mapping.is_some());
        assert!(pdos[1].communication.is_none() && pdos[1].mapped(None).next().is_none());
        assert_eq!(sheet.pdos(PdoDirection::Receive).count(), 0);
    }
}
