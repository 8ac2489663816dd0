//! What the services of a node share while they work on one frame or one point in time.

use crate::emcy::Emcy;
use crate::guarding::Guarding;
use crate::heartbeat::Producer;
use crate::heartbeat_consumer::HeartbeatConsumer;
use crate::lss::Lss;
use crate::pdo::Rpdo;
use crate::queue::Queue;
use crate::services::{Requests, Services};
use crate::sync::Sync;
use crate::{Application, BusState, Frame, Instant, Microseconds, Settings};
use edskit_types::{Bitrate, CanId, NmtState, NodeId};

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
    /// The bit rate that is stored, or was configured last; `None` where that is up to the device.
    pub(crate) bit_rate: Option<Bitrate>,
    pub(crate) state: NmtState,
    /// Whether the first initialisation is done.
    pub(crate) has_started: bool,
    /// Whether the device holds the boot-up back.
    pub(crate) is_held: bool,
    pub(crate) queue: Queue,
    /// Whether frames were being lost when that was looked at last.
    pub(crate) has_overrun: bool,
    /// What the CAN controller tells of the bus.
    pub(crate) bus_state: BusState,
    /// The TPDO for which the queue had no room, counted from 0: it is the next one.
    pub(crate) next_tpdo: u16,
    /// What the device has asked for within a call.
    pub(crate) requests: Requests,
    /// How long the answer to the present request is held back.
    pub(crate) answer_delay: Microseconds,
    /// How many values of RPDOs were refused.
    pub(crate) refused_values: u32,
    pub(crate) emcy: Emcy,
    pub(crate) producer: Producer,
    pub(crate) guarding: Guarding,
    pub(crate) sync: Sync,
    pub(crate) lss: Lss,
}

/// One call of the node: what the device is given with each of its calls, and the device.
pub(crate) struct Context<'a, A: ?Sized> {
    pub(crate) node: Services<'a>,
    pub(crate) app: &'a mut A,
}

impl<A: Application + ?Sized> Context<'_, A> {
    /// Takes a frame from the bus.
    pub(crate) fn receive(&mut self, frame: &Frame) {
        let can_id = frame.can_id();
        if can_id.is_extended() {
            // No service of CiA 301 uses 29 bits here: COB-IDs with the frame bit are refused.
            return;
        }
        match can_id.raw() {
            0x7E5 if Lss::exists(&self.node.core.settings) => self.lss_request(frame),
            // Without a node-ID there is nothing but LSS.
            _ if self.node.core.node_id.is_none() => {}
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
        if self.node.core.sync.is(can_id) {
            self.sync_received(frame);
        } else if let Some(number) = self.node.servers.iter().position(|server| server.takes(can_id)) {
            self.sdo_request(number, frame);
        } else if !self.rpdo_received(can_id, frame) && self.is_time(can_id) {
            self.time_received(frame);
        }
    }

    /// Does what is due.
    pub(crate) fn poll(&mut self) {
        if !self.node.core.has_started {
            self.power_on();
        } else if self.node.core.is_held {
            self.boot_up();
        }
        if self.node.core.is_held {
            return;
        }
        self.do_requests();
        if self.node.core.queue.take_overflow() {
            self.overrun_found(true);
        } else if self.node.core.has_overrun && self.node.core.queue.room() > 0 {
            self.overrun_found(false);
        }
        self.poll_heartbeat();
        self.poll_consumers();
        self.poll_guarding();
        self.poll_sync();
        self.poll_servers();
        self.poll_rpdos();
        self.poll_tpdos();
        self.node.send_emergencies();
    }

    /// Whether frames are being lost.
    fn overrun_found(&mut self, is_present: bool) {
        let was_present = core::mem::replace(&mut self.node.core.has_overrun, is_present);
        self.found(crate::EmcyError::CAN_OVERRUN, was_present, is_present, [0; 5]);
    }

    /// When there will be something to do.
    pub(crate) fn next_deadline(&self) -> Instant {
        if !self.node.core.has_started || self.node.core.requests.is_some() && !self.node.core.is_held {
            return self.node.now;
        }
        if self.node.core.is_held {
            return Instant::NEVER;
        }
        let has_room = self.node.core.queue.room() > 0;
        // What only the queue holds back is due when it has room.
        let with_room =
            |deadline: Instant| if has_room || deadline > self.node.now { deadline } else { Instant::NEVER };
        let services = [
            with_room(self.node.core.producer.deadline()),
            self.node.core.guarding.deadline(),
            with_room(self.node.core.sync.deadline()),
            self.node.emcy_deadline(),
        ];
        let consumers = self.node.consumers.iter().map(HeartbeatConsumer::deadline);
        let servers = self.node.servers.iter().map(|server| server.deadline(has_room));
        let rpdos = self.node.rpdos.iter().map(Rpdo::deadline);
        let tpdos = self.node.tpdos.iter().map(|tpdo| tpdo.deadline(self.node.now, has_room));
        let all = services.into_iter().chain(consumers).chain(servers).chain(rpdos).chain(tpdos);
        all.min().unwrap_or(Instant::NEVER).max(self.node.now)
    }
}
