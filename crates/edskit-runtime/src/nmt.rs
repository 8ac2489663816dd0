//! NMT slave: states, commands, initialisation and boot-up (CiA 301 v4.2, 7.2.8 and 7.3.2).

use crate::Application;
use crate::access::is_communication;
use crate::commissioning::{Commissioning, SOURCE};
use crate::context::Context;
use crate::emcy::Emcy;
use crate::guarding::Guarding;
use crate::heartbeat::Producer;
use crate::heartbeat_consumer::HeartbeatConsumer;
use crate::{EmcyError, Frame, Record, Reset};
use edskit_types::{CanId, Index, NmtCommand, NmtState, NodeId};

/// What the device does when it has booted up (CiA 302-2).
const STARTUP: Index = Index(0x1F80);
/// 1F80h bit 0: the device is the NMT master. Where it is 0, no other bit counts, with the exception of whole values.
const IS_MASTER: u32 = 1;
/// 1F80h bit 2: the NMT master does not go to operational by itself.
const NO_SELF_START: u32 = 1 << 2;
/// 1F80h as a whole: a slave that goes to operational by itself.
const SLAVE_STARTS: u32 = 8;

impl<A: Application + ?Sized> Context<'_, A> {
    /// The first initialisation.
    pub(crate) fn power_on(&mut self) {
        self.node.core.has_started = true;
        let (Commissioning { node_id, bit_rate }, is_lost) =
            Commissioning::read(self.node.storage, &self.node.core.settings);
        self.node.core.pending_node_id = node_id;
        self.node.core.bit_rate = bit_rate;
        if let Some(bit_rate) = bit_rate {
            self.app.activate_bit_rate(bit_rate, 0);
        }
        self.initialise(Reset::Node);
        if is_lost {
            self.app.storage_failed(&mut self.node, Record::Lss);
            self.raise(EmcyError::LOST_PARAMETERS, SOURCE, [0; 5]);
        }
    }

    /// A frame with the identifier 000h.
    pub(crate) fn nmt_command(&mut self, frame: &Frame) {
        let (&[code, node_id], Some(own)) = (frame.data(), self.node.core.node_id) else { return };
        if node_id != 0 && node_id != own.get() {
            return;
        }
        match NmtCommand::from_code(code) {
            Some(NmtCommand::Start) => self.enter(NmtState::Operational),
            Some(NmtCommand::Stop) => self.enter(NmtState::Stopped),
            Some(NmtCommand::EnterPreOperational) => self.enter(NmtState::PreOperational),
            Some(NmtCommand::ResetNode) => self.initialise(Reset::Node),
            Some(NmtCommand::ResetCommunication) => self.initialise(Reset::Communication),
            None => {}
        }
    }

    /// Goes to another state; nothing happens where the node is in it or waits for a node-ID.
    pub(crate) fn enter(&mut self, to: NmtState) {
        let from = self.node.core.state;
        if from == to || [from, to].contains(&NmtState::Initialising) {
            return;
        }
        self.node.core.state = to;
        if to == NmtState::Stopped {
            self.end_transfers();
            // No message is taken any more that could be right.
            self.sync_length_found(false, 0);
        }
        if from == NmtState::Stopped {
            self.node.core.sync.restart(self.node.now);
        }
        if to == NmtState::Operational {
            self.start_pdos();
        } else if from == NmtState::Operational {
            self.stop_pdos();
        }
        self.app.state_changed(&mut self.node, from, to);
    }

    /// Resets the node or its communication, and boots up with the node-ID that is configured as soon as the device is
    /// ready.
    pub(crate) fn initialise(&mut self, reset: Reset) {
        let from = self.node.core.state;
        self.node.core.state = NmtState::Initialising;
        if from != NmtState::Initialising {
            self.app.state_changed(&mut self.node, from, NmtState::Initialising);
        }
        self.end_transfers();
        self.node.consumers.fill(HeartbeatConsumer::NEW);
        self.node.core.queue.clear();
        self.commission(reset);
        if reset == Reset::Node {
            self.node.core.node_id_of_reset = self.node.core.node_id;
        }
        let is_reset = move |index: Index| reset == Reset::Node || is_communication(index);
        self.node.objects.restore(self.node.core.node_id, is_reset);
        self.node.core.emcy = Emcy::new();
        // Errors are those of this operation, whatever a file or a record says.
        self.node.objects.set_value(Index::ERROR_REGISTER, 0, 0_u8);
        self.node.objects.set_value(Index::PREDEFINED_ERROR_FIELD, 0, 0_u8);
        self.node.core.lss.restart();
        self.load_parameters(is_reset);
        self.app.reset(&mut self.node, reset);
        self.boot_up();
    }

    /// Takes node-ID and bit rate as LSS or the device has configured them.
    fn commission(&mut self, reset: Reset) {
        let core = &self.node.core;
        let configured = Commissioning { node_id: core.pending_node_id, bit_rate: core.bit_rate };
        let new = self.app.commissioning(&mut self.node, configured, reset);
        self.node.core.pending_node_id = new.node_id;
        self.node.core.node_id = new.node_id;
        self.node.core.bit_rate = new.bit_rate;
        if let Some(bit_rate) = new.bit_rate.filter(|_| new.bit_rate != configured.bit_rate) {
            self.app.activate_bit_rate(bit_rate, 0);
        }
    }

    /// Boots up, unless the device is not ready for it or there is no node-ID.
    pub(crate) fn boot_up(&mut self) {
        self.node.core.is_held = !self.app.is_ready(&mut self.node);
        if self.node.core.is_held {
            return;
        }
        self.configure();
        let Some(node_id) = self.node.core.node_id else { return };
        self.node.core.queue.send(error_control(node_id), &[NmtState::Initialising.code()]);
        self.enter_pre_operational();
        let prescribed = self.starts_by_itself();
        if self.app.starts_by_itself(&mut self.node, prescribed) {
            self.enter(NmtState::Operational);
        }
    }

    fn enter_pre_operational(&mut self) {
        self.node.core.state = NmtState::PreOperational;
        let period = self.heartbeat_time();
        self.node.core.producer = Producer::started(self.node.now, period);
        self.app.state_changed(&mut self.node, NmtState::Initialising, NmtState::PreOperational);
    }

    /// Takes the configuration of every service from the dictionary.
    fn configure(&mut self) {
        self.node.core.guarding = Guarding::new();
        self.node.core.producer = Producer::OFF;
        self.configure_sync();
        self.configure_servers();
        self.configure_consumers();
        self.configure_pdos();
    }

    /// Whether the node goes to operational by itself: as 1F80h says, where there is one.
    fn starts_by_itself(&self) -> bool {
        match self.node.objects.value::<u32>(STARTUP, 0) {
            Some(startup) => startup == SLAVE_STARTS || startup & (IS_MASTER | NO_SELF_START) == IS_MASTER,
            None => self.node.core.settings.starts_by_itself,
        }
    }
}

/// The identifier of a node's boot-up, heartbeat and guarding message.
pub(crate) fn error_control(node_id: NodeId) -> CanId {
    // 700h and a node-ID always fit into eleven bits.
    CanId::standard(0x700 + u16::from(node_id.get())).unwrap_or(CanId::NMT)
}
