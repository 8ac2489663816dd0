//! What clients may write into the parameters of PDOs, and what follows (CiA 301 v4.2, 7.5.2.35 to 7.5.2.38).

use super::mapping::Slots;
use super::{MOST_ENTRIES, Parameters, Place, Rpdo, Tpdo, sub};
use crate::context::Context;
use crate::time::Timer;
use crate::{Microseconds, Value};
use edskit_types::{
    AbortCode, CobId, Index, MappingEntry, NmtState, PdoDirection, SubIndex, TransmissionType,
};

impl Context<'_> {
    /// Takes the configuration of all PDOs from the dictionary.
    pub(crate) fn configure_pdos(&mut self) {
        let mut first = 0;
        self.rpdos.fill(Rpdo::NEW);
        self.tpdos.fill(Tpdo::NEW);
        for direction in [PdoDirection::Receive, PdoDirection::Transmit] {
            let mut next = 0;
            let start = Place { direction, number: 0 }.communication();
            let entries = self.objects.table.entries_from(start);
            for (_, entry) in entries.take_while(|(_, entry)| Place::of_communication(entry.index).is_some())
            {
                let Some(place) = Place::of_communication(entry.index) else { continue };
                if place.direction != direction || entry.sub_index.0 != sub::COB_ID {
                    continue;
                }
                let slots = Slots { first, capacity: self.mapping_capacity(place), ..Slots::NONE };
                first += u16::from(slots.capacity);
                if self.add(place, next, slots) {
                    next += 1;
                    self.load_communication(place);
                    self.load_mapping(place);
                }
            }
        }
    }

    /// How many entries the mapping of a PDO can have.
    fn mapping_capacity(&self, place: Place) -> u8 {
        let entries = self.objects.table.entries_of(place.mapping());
        let is_entry = |sub_index: SubIndex| (1..=MOST_ENTRIES).contains(&sub_index.0);
        entries.filter(|(_, entry)| is_entry(entry.sub_index)).count() as u8
    }

    /// Gives a PDO its place among those at work; false where there is none.
    fn add(&mut self, place: Place, position: usize, slots: Slots) -> bool {
        let parameters = match place.direction {
            PdoDirection::Receive => self.rpdos.get_mut(position).map(|rpdo| &mut rpdo.parameters),
            PdoDirection::Transmit => self.tpdos.get_mut(position).map(|tpdo| &mut tpdo.parameters),
        };
        let Some(parameters) = parameters else { return false };
        parameters.number = place.number + 1;
        parameters.slots = slots;
        true
    }

    #[inline(never)]
    fn parameters(&mut self, place: Place) -> Option<&mut Parameters> {
        let is_it = |parameters: &&mut Parameters| parameters.number == place.number + 1;
        match place.direction {
            PdoDirection::Receive => self.rpdos.iter_mut().map(|rpdo| &mut rpdo.parameters).find(is_it),
            PdoDirection::Transmit => self.tpdos.iter_mut().map(|tpdo| &mut tpdo.parameters).find(is_it),
        }
    }

    fn cob_id_of(&self, place: Place) -> CobId {
        self.objects.value(place.communication(), sub::COB_ID).map_or(CobId(CobId::BIT_31), CobId)
    }

    fn slots_of(&mut self, place: Place) -> Slots {
        self.parameters(place).map_or(Slots::NONE, |parameters| parameters.slots)
    }

    /// A communication parameter has been written.
    pub(crate) fn load_communication(&mut self, place: Place) {
        let index = place.communication();
        let cob_id = self.cob_id_of(place);
        let can_id = cob_id.is_valid().then(|| cob_id.can_id());
        let transmission =
            TransmissionType(self.objects.value(index, sub::TRANSMISSION_TYPE).unwrap_or(0xFF));
        let event_time: u16 = self.objects.value(index, sub::EVENT_TIMER).unwrap_or_default();
        let event_time = Microseconds::from_milliseconds(event_time.into());
        let inhibit_time = self.objects.value(index, sub::INHIBIT_TIME).unwrap_or_default();
        let sync_start = self.objects.value(index, sub::SYNC_START).unwrap_or_default();
        let (now, is_operational) = (self.now, self.core.state == NmtState::Operational);
        let Some(parameters) = self.parameters(place) else { return };
        let was_valid = parameters.can_id.is_some();
        let has_other_time = parameters.event_time != event_time;
        parameters.can_id = can_id;
        parameters.allows_rtr = !cob_id.bit30();
        parameters.transmission = transmission;
        parameters.event_time = event_time;
        let number = parameters.number;
        if place.direction == PdoDirection::Receive {
            let rpdo = self.rpdos.iter_mut().find(|rpdo| rpdo.parameters.number == number);
            if let Some(rpdo) = rpdo.filter(|rpdo| rpdo.deadline.is_running()) {
                rpdo.deadline = Timer::after(now, event_time);
            }
            return;
        }
        let tpdo = self.tpdos.iter_mut().find(|tpdo| tpdo.parameters.number == number);
        let Some(tpdo) = tpdo else { return };
        tpdo.inhibit_time = Microseconds::from_inhibit_time(inhibit_time);
        tpdo.sync_start = sync_start;
        let begins = can_id.is_some() && !was_valid;
        if begins {
            tpdo.syncs = 0;
            tpdo.waits_for_start = sync_start > 0;
            tpdo.is_due = is_operational;
        }
        if begins || has_other_time {
            let runs = is_operational && can_id.is_some() && transmission.0 >= 254;
            tpdo.event = if runs { Timer::after(now, event_time) } else { Timer::OFF };
        }
    }

    /// The number of mapped entries has been written.
    pub(crate) fn load_mapping(&mut self, place: Place) {
        let slots = self.slots_of(place);
        let count = self.objects.value(place.mapping(), 0).unwrap_or_default();
        let mapped = self.map(place, slots, count);
        if let Some(parameters) = self.parameters(place) {
            parameters.slots = mapped.unwrap_or(Slots { count: 0, bits: 0, ..slots });
            parameters.is_mapping_invalid = mapped.is_err();
        }
    }

    /// A communication parameter is about to be written.
    pub(crate) fn check_communication(
        &self,
        place: Place,
        sub_index: SubIndex,
        data: &[u8],
    ) -> Result<(), AbortCode> {
        let old = self.cob_id_of(place);
        match sub_index.0 {
            sub::COB_ID => {
                let new = CobId(u32::from_bytes(data));
                self.check_cob_id(new)?;
                if old.is_valid() && new.is_valid() && (old.0 ^ new.0) & !CobId::BIT_30 != 0 {
                    return Err(AbortCode::INVALID_VALUE);
                }
                Ok(())
            }
            sub::TRANSMISSION_TYPE => {
                let is_reserved = TransmissionType(u8::from_bytes(data)).is_reserved(place.direction);
                if is_reserved { Err(AbortCode::INVALID_VALUE) } else { Ok(()) }
            }
            sub::INHIBIT_TIME if old.is_valid() => Err(AbortCode::DEVICE_STATE),
            sub::SYNC_START if old.is_valid() => Err(AbortCode::DEVICE_STATE),
            sub::SYNC_START if u8::from_bytes(data) > 240 => Err(AbortCode::INVALID_VALUE),
            _ => Ok(()),
        }
    }

    /// A mapping parameter is about to be written: the PDO must not be valid, an entry only while none counts.
    pub(crate) fn check_mapping(
        &mut self,
        place: Place,
        sub_index: SubIndex,
        data: &[u8],
    ) -> Result<(), AbortCode> {
        if self.cob_id_of(place).is_valid() {
            return Err(AbortCode::UNSUPPORTED_ACCESS);
        }
        let slots = self.slots_of(place);
        if sub_index.0 == 0 {
            return self.map(place, slots, u8::from_bytes(data)).map(|_| ());
        }
        if self.objects.value::<u8>(place.mapping(), 0).unwrap_or_default() > 0 {
            return Err(AbortCode::UNSUPPORTED_ACCESS);
        }
        match u32::from_bytes(data) {
            0 => Ok(()),
            entry => self.check_entry(place.direction, MappingEntry(entry)).map(|_| ()),
        }
    }

    /// The PDO whose communication or mapping parameter is at an index.
    pub(crate) fn pdo_at(index: Index) -> Option<(Place, bool)> {
        let communication = Place::of_communication(index).map(|place| (place, false));
        communication.or_else(|| Place::of_mapping(index).map(|place| (place, true)))
    }
}
