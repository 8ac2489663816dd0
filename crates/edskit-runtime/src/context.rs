//! What the services of a node share while they work on one frame or one point in time.

use crate::emcy::Emcy;
use crate::guarding::Guarding;
use crate::heartbeat::{HeartbeatConsumer, Producer};
use crate::lss::Lss;
use crate::pdo::{Mapped, Rpdo, Tpdo};
use crate::queue::Queue;
use crate::sdo::SdoServer;
use crate::sync::Sync;
use crate::{Application, Frame, Instant, Objects, Settings, Storage};
use edskit_types::{AbortCode, CanId, CobId, Index, NmtState, NodeId};

/// The state of a node besides its dictionary.
#[derive(Debug)]
pub(crate) struct Core {
    pub(crate) settings: Settings,
    /// The node-ID in use; `None` before the first one is configured.
    pub(crate) node_id: Option<NodeId>,
    /// The node-ID from the next reset on.
    pub(crate) pending_node_id: Option<NodeId>,
    /// The node-ID in use at the last reset of the node: it is in the values from 2000h on that follow the node-ID.
    pub(crate) node_id_of_reset: Option<NodeId>,
    pub(crate) state: NmtState,
    /// Whether the first initialisation is done.
    pub(crate) has_started: bool,
    /// Whether the device holds the boot-up back.
    pub(crate) is_held: bool,
    pub(crate) queue: Queue,
    /// Whether frames were being lost when that was looked at last.
    pub(crate) has_overrun: bool,
    /// The TPDO for which the queue had no room, counted from 0: it is the next one.
    pub(crate) next_tpdo: u16,
    /// How many values of RPDOs were refused.
    pub(crate) refused_values: u32,
    pub(crate) emcy: Emcy,
    pub(crate) producer: Producer,
    pub(crate) guarding: Guarding,
    pub(crate) sync: Sync,
    pub(crate) lss: Lss,
}

/// One call of the node: the time, the dictionary, the state, and those who are asked.
pub(crate) struct Context<'a> {
    pub(crate) now: Instant,
    pub(crate) objects: Objects<'a>,
    pub(crate) rpdos: &'a mut [Rpdo],
    pub(crate) tpdos: &'a mut [Tpdo],
    pub(crate) mapped: &'a mut [Mapped],
    pub(crate) servers: &'a mut [SdoServer],
    pub(crate) consumers: &'a mut [HeartbeatConsumer],
    pub(crate) buffers: &'a mut [u8],
    pub(crate) core: &'a mut Core,
    pub(crate) app: &'a mut dyn Application,
    pub(crate) storage: &'a mut dyn Storage,
}

impl Context<'_> {
    /// Takes a frame from the bus.
    pub(crate) fn receive(&mut self, frame: &Frame) {
        let can_id = frame.can_id();
        if can_id.is_extended() {
            // No service of CiA 301 uses 29 bits here: COB-IDs with the frame bit are refused.
            return;
        }
        match can_id.raw() {
            0x7E5 if self.core.settings.has_lss => self.lss_request(frame),
            // Without a node-ID there is nothing but LSS.
            _ if self.core.node_id.is_none() => {}
            0 => self.nmt_command(frame),
            0x701..=0x77F if frame.is_remote() => self.guarding_request(can_id),
            0x701..=0x77F => self.heartbeat_received(can_id, frame),
            _ => self.receive_configured(can_id, frame),
        }
    }

    /// A frame whose identifier the dictionary configures.
    fn receive_configured(&mut self, can_id: CanId, frame: &Frame) {
        if frame.is_remote() {
            self.tpdo_requested(can_id);
            return;
        }
        if self.core.sync.is(can_id) {
            self.sync_received(frame);
        } else if let Some(number) = self.servers.iter().position(|server| server.takes(can_id)) {
            self.sdo_request(number, frame);
        } else if !self.rpdo_received(can_id, frame) && self.is_time(can_id) {
            self.time_received(frame);
        }
    }

    /// Does what is due.
    pub(crate) fn poll(&mut self) {
        if !self.core.has_started {
            self.power_on();
        } else if self.core.is_held {
            self.boot_up();
        }
        if self.core.is_held {
            return;
        }
        if self.core.queue.take_overflow() {
            self.overrun_found(true);
        } else if self.core.has_overrun && self.core.queue.room() > 0 {
            self.overrun_found(false);
        }
        self.poll_heartbeat();
        self.poll_consumers();
        self.poll_guarding();
        self.poll_sync();
        self.poll_servers();
        self.poll_rpdos();
        self.poll_tpdos();
        self.send_emergencies();
    }

    /// Whether frames are being lost.
    fn overrun_found(&mut self, is_present: bool) {
        let was_present = core::mem::replace(&mut self.core.has_overrun, is_present);
        self.found(crate::EmcyError::CAN_OVERRUN, was_present, is_present, [0; 5]);
    }

    /// When there will be something to do.
    pub(crate) fn next_deadline(&self) -> Instant {
        if !self.core.has_started {
            return self.now;
        }
        if self.core.is_held {
            return Instant::NEVER;
        }
        let has_room = self.core.queue.room() > 0;
        // What only the queue holds back is due when it has room.
        let with_room =
            |deadline: Instant| if has_room || deadline > self.now { deadline } else { Instant::NEVER };
        let services = [
            with_room(self.core.producer.deadline()),
            self.core.guarding.deadline(),
            with_room(self.core.sync.deadline()),
            self.emcy_deadline(),
        ];
        let consumers = self.consumers.iter().map(HeartbeatConsumer::deadline);
        let servers = self.servers.iter().map(|server| server.deadline(has_room));
        let rpdos = self.rpdos.iter().map(Rpdo::deadline);
        let tpdos = self.tpdos.iter().map(|tpdo| tpdo.deadline(self.now, has_room));
        let all = services.into_iter().chain(consumers).chain(servers).chain(rpdos).chain(tpdos);
        all.min().unwrap_or(Instant::NEVER).max(self.now)
    }

    /// Whether the node is in a state in which SDO, SYNC, EMCY and TIME work.
    pub(crate) fn is_communicating(&self) -> bool {
        matches!(self.core.state, NmtState::PreOperational | NmtState::Operational)
    }

    /// What holds for every COB-ID: 29-bit identifiers are not supported, and what CiA 301, or the device in its place,
    /// restricts cannot be used by a valid one.
    pub(crate) fn check_cob_id(&self, cob_id: CobId) -> Result<(), AbortCode> {
        if self.core.settings.identifiers.fault(cob_id).is_some() {
            return Err(AbortCode::INVALID_VALUE);
        }
        Ok(())
    }

    /// The identifier in an entry whose bit 31 says that the service does not exist; `None` where it says so, and where the
    /// value is one that a client could not write.
    #[inline(never)]
    pub(crate) fn valid_can_id(&self, index: Index, sub_index: u8) -> Option<CanId> {
        let cob_id = self.objects.value(index, sub_index).map(CobId)?;
        (cob_id.is_valid() && self.check_cob_id(cob_id).is_ok()).then(|| cob_id.can_id())
    }
}
