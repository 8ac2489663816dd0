//! How the gateway differs from CiA 301: the hooks of its node.

use super::super::governor::Governor;
use super::super::identification::Identification;
use super::super::monitoring::Monitoring;
use super::super::state::State;
use super::super::table::PdoTable;
use super::super::{Configuration, Pdo};
use super::Plant;
use super::side::Phase;
use crate::gateway::dictionary::canopen_gateway::{keys, objects as entries};
use edskit_runtime::{
    Application, EmcyError, Emergency, Entry, Key, Microseconds, Objects, Reset, Services, Storage,
};
use edskit_types::{AbortCode, Index, NmtState, PdoDirection};

impl<G: Governor, S: Storage> Application for Plant<G, S> {
    /// 1001h, 2000h and 2005h follow the errors at any time (5.1.1, 5.1.6; GW-OD-14, GW-OD-19).
    fn before_read(&mut self, node: &mut Services<'_>, entry: &Entry) -> Result<(), AbortCode> {
        let [errors @ .., engine_status] = entries::DIGITAL_OUTPUTS;
        match entry.key() {
            keys::ERROR_REGISTER => node.objects.set(entries::ERROR_REGISTER, self.error_register()),
            keys::CAN_OPEN_ERRORS => node.objects.set(entries::CAN_OPEN_ERRORS, self.gateway.can_open.0),
            keys::DIGITAL_OUTPUTS_ENGINE_STATUS => {
                node.objects.set(engine_status, self.governor.model.engine_status().into());
            }
            _ => {
                let mut words = errors.into_iter().zip(self.error_words());
                if let Some((handle, word)) = words.find(|(handle, _)| entry.is(*handle)) {
                    node.objects.set(handle, word);
                }
            }
        }
        Ok(())
    }

    /// Object, sub-index, length, and only then that everything is read-only (5.2, table 3; GW-SDO-03, GW-NOTE-22,
    /// GW-NOTE-24).
    fn check_write(
        &mut self,
        _: &Services<'_>,
        entry: &Entry,
        length: Option<usize>,
    ) -> Result<(), AbortCode> {
        let size = usize::from(entry.size);
        Err(match length {
            Some(length) if length > size => AbortCode::LENGTH_TOO_HIGH,
            Some(length) if length < size => AbortCode::LENGTH_TOO_LOW,
            _ => AbortCode::READ_ONLY,
        })
    }

    /// The entries that the initialisation has brought about (2, 5.1; GW-APP-04, GW-EDS-16, GW-NOTE-13).
    fn is_present(&mut self, node: &Services<'_>, entry: &Entry) -> bool {
        let Some(table) = &self.gateway.pdos else { return false };
        if entry.place_in(&entries::ANALOG_INPUTS).is_some() {
            let mut mapped = table.rpdos.iter().flat_map(|rpdo| rpdo.words()).map(|word| word.object);
            return mapped
                .any(|object| entry.key() == Key { index: object.index(), sub_index: object.sub_index() });
        }
        entry.sub_index.0 <= node.objects.value(entry.index, 0).unwrap_or_default()
    }

    fn state_changed(&mut self, _: &mut Services<'_>, _: NmtState, to: NmtState) {
        let is_operational = to == NmtState::Operational;
        self.governor.reception.is_operational = is_operational;
        if is_operational {
            self.governor.begin_operation(self.now);
            self.gateway.heartbeat = Monitoring::begun(self.now);
            self.clear_errors();
        }
        let state = State::ALL.into_iter().find(|state| state.nmt() == Some(to));
        if let Some(state) = state {
            self.events.push(super::Event::State(state));
        }
    }

    /// A reset by the NMT master is its command to initialise (3; GW-NMT-11, GW-NOTE-01).
    fn reset(&mut self, _: &mut Services<'_>, _: Reset) {
        if self.gateway.phase == Phase::Ready {
            self.enter_phase(Phase::Init);
        }
    }

    /// The dictionary is built when the governor has initialised the gateway; before that no object can be reached.
    fn is_ready(&mut self, node: &mut Services<'_>) -> bool {
        let Some(table) = self.gateway.pdos.as_ref().filter(|_| self.gateway.phase == Phase::Ready) else {
            return false;
        };
        build(&mut node.objects, table, self.parameters.effective(), self.gateway.identification());
        true
    }

    /// In main cycles of 16 ms (7.2.3; GW-TIMING-12); 1017h shows the parameter as it is set (GW-GAP-09).
    fn heartbeat_time(&mut self, _: Microseconds) -> Microseconds {
        let period = self.parameters.effective().heartbeat();
        Microseconds(period.map_or(0, |period| period.micros().into()))
    }

    /// The governor says when a TPDO is sent (2, table 1; GW-APP-03).
    fn sends_at_start(&mut self, _: u16) -> bool {
        false
    }

    fn rpdo_received(&mut self, node: &mut Services<'_>, number: u16) {
        let reception = &mut self.governor.reception;
        if number == 1 {
            let [switches, flags] = entries::DIGITAL_INPUTS;
            reception.switches = node.objects.get(switches);
            reception.flags = node.objects.get(flags);
        } else {
            let first = 4 * (usize::from(number).saturating_sub(2));
            let inputs = reception.channels.iter_mut().zip(entries::ANALOG_INPUTS);
            for (channel, input) in inputs.skip(first).take(4) {
                *channel = node.objects.get(input);
            }
        }
        if let Some(monitoring) = reception.monitoring.get_mut(usize::from(number).saturating_sub(1)) {
            monitoring.arrived(self.now);
        }
        self.gateway.rpdo = Some(number);
    }

    /// There are no EMCY messages (GW-OD-21), but the node says by one that its transmit buffer was full.
    fn emergency(&mut self, _: &mut Services<'_>, emergency: &mut Emergency) {
        self.gateway.has_overflown |= emergency.code == EmcyError::CAN_OVERRUN.code;
    }
}

impl<G: Governor, S: Storage> Plant<G, S> {
    /// 1001h: bit 0 for any error of the gateway, bit 4 for one of communication (GW-NOTE-36).
    fn error_register(&self) -> u8 {
        let generic =
            self.gateway.errors.present().next().is_some() || !self.gateway.eeprom_errors.is_empty();
        let communication = self.gateway.can_open.iter().any(|error| error.is_of_communication());
        u8::from(generic) | u8::from(communication) << 4
    }
}

/// Puts what follows from the initialisation into the dictionary (ch. 10).
fn build(
    objects: &mut Objects<'_>,
    table: &PdoTable,
    configuration: &Configuration,
    identification: Identification,
) {
    let [partner, monitoring, heartbeat] = configuration.heartbeat_parameters();
    let [consumer] = entries::CONSUMER_HEARTBEAT_TIME;
    objects.set(consumer, u32::from(partner) << 16 | u32::from(monitoring));
    objects.set(entries::PRODUCER_HEARTBEAT_TIME, heartbeat);
    objects.set(entries::IDENTITY_OBJECT_SERIAL_NUMBER, identification.serial());
    for pdo in table.iter() {
        let (communication, mapping) = indices(pdo);
        objects.set_value(communication, 1, pdo.cob_id().0);
        objects.set_value(mapping, 0, pdo.words().len() as u8);
        for (sub_index, word) in (1..).zip(pdo.words()) {
            objects.set_value(mapping, sub_index, word.object.0);
        }
    }
    let sizes = table.object_sizes();
    for (handle, size) in [
        (entries::DIGITAL_OUTPUTS_NUMBER_OF_ENTRIES, sizes.digital_outputs),
        (entries::UNSIGNED_ANALOG_OUTPUTS_NUMBER_OF_ENTRIES, sizes.unsigned_analog_outputs),
        (entries::SIGNED_ANALOG_OUTPUTS_NUMBER_OF_ENTRIES, sizes.signed_analog_outputs),
        (entries::DIGITAL_INPUTS_NUMBER_OF_ENTRIES, sizes.digital_inputs),
        (entries::ANALOG_INPUTS_NUMBER_OF_ENTRIES, sizes.analog_inputs),
    ] {
        objects.set(handle, size);
    }
}

/// Where the communication and the mapping parameter of a PDO are.
fn indices(pdo: &Pdo) -> (Index, Index) {
    let (communication, mapping) = match pdo.direction {
        PdoDirection::Receive => (Index::RPDO_COMMUNICATION, Index::RPDO_MAPPING),
        PdoDirection::Transmit => (Index::TPDO_COMMUNICATION, Index::TPDO_MAPPING),
    };
    let offset = u16::from(pdo.number) - 1;
    (Index(communication.0 + offset), Index(mapping.0 + offset))
}
