//! What the parameters of PDOs can be set to, and what follows (CiA 301 v4.2, 7.5.2.35 to 7.5.2.38).

use super::mapping::Slots;
use super::{MOST_ENTRIES, Parameters, PdoPolicy, Place, Remapping, Rpdo, Tpdo, remote, sub, synchronous};
use crate::Application;
use crate::Value;
use crate::context::Context;
use edskit_types::{
    AbortCode, CanId, CobId, MappingEntry, PdoDirection, SubIndex, Transmission, TransmissionType,
};

impl<A: Application + ?Sized> Context<'_, A> {
    /// Takes the configuration of all PDOs from the dictionary.
    pub(crate) fn configure_pdos(&mut self) {
        let mut first = 0;
        self.node.rpdos.fill(Rpdo::NEW);
        self.node.tpdos.fill(Tpdo::NEW);
        for direction in [PdoDirection::Receive, PdoDirection::Transmit] {
            let mut next = 0;
            let start = Place { direction, number: 0 }.communication();
            for (_, entry) in self.node.objects.table.entries_from(start) {
                let Some((place, false)) = Place::at(entry.index) else { break };
                if place.direction != direction || entry.sub_index.0 != sub::COB_ID {
                    continue;
                }
                let slots = Slots { first, capacity: self.mapping_capacity(place), ..Slots::NONE };
                first += u16::from(slots.capacity);
                if self.add(place, next, slots) {
                    next += 1;
                    self.pdo_changed(place, true);
                }
            }
        }
    }

    /// How many entries the mapping of a PDO can have.
    fn mapping_capacity(&self, place: Place) -> u8 {
        let entries = self.node.objects.table.entries_of(place.mapping());
        let is_entry = |sub_index: SubIndex| (1..=MOST_ENTRIES).contains(&sub_index.0);
        entries.filter(|(_, entry)| is_entry(entry.sub_index)).count() as u8
    }

    /// Gives a PDO its place among those at work; false where there is none.
    fn add(&mut self, place: Place, position: usize, slots: Slots) -> bool {
        let parameters = match place.direction {
            PdoDirection::Receive => self.node.rpdos.get_mut(position).map(|rpdo| &mut rpdo.parameters),
            PdoDirection::Transmit => self.node.tpdos.get_mut(position).map(|tpdo| &mut tpdo.parameters),
        };
        let Some(parameters) = parameters else { return false };
        parameters.number = place.number + 1;
        parameters.slots = slots;
        true
    }

    /// The parameters of a PDO among those at work.
    #[inline(never)]
    fn at_work(&mut self, place: Place) -> Option<&mut Parameters> {
        let is_it = |parameters: &&mut Parameters| parameters.number == place.number + 1;
        match place.direction {
            PdoDirection::Receive => self.node.rpdos.iter_mut().map(|rpdo| &mut rpdo.parameters).find(is_it),
            PdoDirection::Transmit => self.node.tpdos.iter_mut().map(|tpdo| &mut tpdo.parameters).find(is_it),
        }
    }

    fn slots_of(&mut self, place: Place) -> Slots {
        self.at_work(place).map_or(Slots::NONE, |parameters| parameters.slots)
    }

    fn meaning_of(&mut self, place: Place) -> Transmission {
        let transmission = self.node.objects.value(place.communication(), sub::TRANSMISSION_TYPE);
        self.meaning(place.direction, TransmissionType(transmission.unwrap_or(0xFF)))
    }

    /// What a transmission type means; reserved is also what the node has no service for.
    fn meaning(&mut self, direction: PdoDirection, transmission: TransmissionType) -> Transmission {
        let meaning = self.app.transmission(direction, transmission);
        let is_known = synchronous::knows(meaning) && remote::knows(meaning);
        if is_known { meaning } else { Transmission::Reserved }
    }

    /// The identifier of a PDO that exists.
    fn can_id_of(&mut self, place: Place) -> Option<CanId> {
        let can_id = self.node.valid_can_id(place.communication(), sub::COB_ID)?;
        (self.meaning_of(place) != Transmission::Reserved).then_some(can_id)
    }

    /// What follows from the parameters of a PDO: it takes them over, and what is left of the data, times and errors that
    /// it had under the old ones, the two directions say. `is_remapped` says that the mapping is another one too.
    pub(crate) fn pdo_changed(&mut self, place: Place, is_remapped: bool) {
        let index = place.communication();
        let cob_id = self.node.objects.value(index, sub::COB_ID).map_or(CobId(CobId::BIT_31), CobId);
        let (can_id, meaning) = (self.can_id_of(place), self.meaning_of(place));
        let event_time = self.node.objects.value(index, sub::EVENT_TIMER).unwrap_or_default();
        let Some(old) = self.at_work(place).copied() else { return };
        let policy = self.node.core.settings.pdos;
        let allows_rtr = !cob_id.bit30() && policy.answers_requests;
        let mut new = Parameters { can_id, allows_rtr, meaning, event_time, ..old };
        // Where writes make it invalid, its entries may be others when it is valid again.
        let is_remapped = is_remapped || policy.remapping == Remapping::Invalidates && old.can_id.is_none();
        if is_remapped {
            let count = self.node.objects.value(place.mapping(), 0).unwrap_or_default();
            let mapped = self.map(place, old.slots, count, true);
            new.slots = mapped.unwrap_or(Slots { count: 0, bits: 0, ..old.slots });
            new.is_mapping_invalid = mapped.is_err();
        }
        let number = new.number;
        match place.direction {
            PdoDirection::Receive => {
                let position = self.node.rpdos.iter().position(|rpdo| rpdo.parameters.number == number);
                self.rpdo_changed(position.unwrap_or_default(), new, is_remapped);
            }
            PdoDirection::Transmit => {
                let position = self.node.tpdos.iter().position(|tpdo| tpdo.parameters.number == number);
                let inhibit_time = self.node.objects.value(index, sub::INHIBIT_TIME).unwrap_or_default();
                let sync_start = self.node.objects.value(index, sub::SYNC_START);
                let sync_start = sync_start.filter(|value| is_sync_start(*value)).unwrap_or_default();
                let position = position.unwrap_or_default();
                self.tpdo_changed(position, new, inhibit_time, sync_start, is_remapped);
            }
        }
    }

    /// What a communication parameter can be set to.
    pub(crate) fn check_communication(
        &mut self,
        place: Place,
        sub_index: SubIndex,
        data: &[u8],
    ) -> Result<(), AbortCode> {
        let value = u32::from_bytes(data);
        let is_right = match sub_index.0 {
            sub::COB_ID => return self.node.check_cob_id(CobId(value)),
            sub::TRANSMISSION_TYPE => {
                let meaning = self.meaning(place.direction, TransmissionType(value as u8));
                meaning != Transmission::Reserved
            }
            sub::SYNC_START => is_sync_start(value as u8),
            _ => true,
        };
        if is_right { Ok(()) } else { Err(AbortCode::INVALID_VALUE) }
    }

    /// A communication parameter is about to be written: identifier, frame bit, inhibit time and SYNC start value cannot
    /// change while the PDO exists.
    pub(crate) fn check_communication_change(
        &mut self,
        place: Place,
        sub_index: SubIndex,
        new: CobId,
    ) -> Result<(), AbortCode> {
        let PdoPolicy { remapping, times_change_live, .. } = self.node.core.settings.pdos;
        let Some(can_id) = self.can_id_of(place) else {
            let is_checked_now = remapping == Remapping::Invalidates && new.is_valid();
            return if is_checked_now && sub_index.0 == sub::COB_ID {
                self.check_whole_mapping(place)
            } else {
                Ok(())
            };
        };
        match sub_index.0 {
            sub::COB_ID if new.is_valid() && new.can_id() != can_id => Err(AbortCode::INVALID_VALUE),
            sub::INHIBIT_TIME | sub::SYNC_START if !times_change_live => Err(AbortCode::DEVICE_STATE),
            _ => Ok(()),
        }
    }

    /// Whether the mapping in the dictionary can be carried.
    fn check_whole_mapping(&mut self, place: Place) -> Result<(), AbortCode> {
        let slots = self.slots_of(place);
        let count = self.node.objects.value(place.mapping(), 0).unwrap_or_default();
        self.map(place, slots, count, false).map(|_| ())
    }

    /// What a mapping parameter can be set to: an entry that can be carried, and a number of such entries that fit.
    pub(crate) fn check_mapping(
        &mut self,
        place: Place,
        sub_index: SubIndex,
        data: &[u8],
    ) -> Result<(), AbortCode> {
        if self.node.core.settings.pdos.remapping == Remapping::Invalidates {
            let is_too_high = sub_index.0 == 0 && u8::from_bytes(data) > self.slots_of(place).capacity;
            return if is_too_high { Err(AbortCode::PDO_LENGTH_EXCEEDED) } else { Ok(()) };
        }
        if sub_index.0 == 0 {
            let slots = self.slots_of(place);
            return self.map(place, slots, u8::from_bytes(data), false).map(|_| ());
        }
        match u32::from_bytes(data) {
            0 => Ok(()),
            entry => self.check_entry(place.direction, MappingEntry(entry)).map(|_| ()),
        }
    }

    /// A client or an RPDO has written a mapping parameter. Where that makes the PDO invalid, it is now.
    pub(crate) fn mapping_written(&mut self, place: Place) {
        if self.node.core.settings.pdos.remapping == Remapping::Invalidates {
            let index = place.communication();
            let cob_id = self.node.objects.value(index, sub::COB_ID).unwrap_or(0);
            self.node.objects.set_value(index, sub::COB_ID, cob_id | CobId::BIT_31);
            self.pdo_changed(place, true);
        }
    }

    /// A mapping parameter is about to be written: the PDO must not exist, an entry only while none counts.
    pub(crate) fn check_mapping_change(
        &mut self,
        place: Place,
        sub_index: SubIndex,
    ) -> Result<(), AbortCode> {
        if self.node.core.settings.pdos.remapping == Remapping::Invalidates {
            return Ok(());
        }
        if self.can_id_of(place).is_some() {
            return Err(AbortCode::UNSUPPORTED_ACCESS);
        }
        let counts = || self.node.objects.value::<u8>(place.mapping(), 0).unwrap_or_default() > 0;
        if sub_index.0 > 0 && counts() {
            return Err(AbortCode::UNSUPPORTED_ACCESS);
        }
        Ok(())
    }
}

/// Whether a number can be the counter of the SYNC message with which a TPDO begins; 0 for any.
fn is_sync_start(value: u8) -> bool {
    value <= 240
}
