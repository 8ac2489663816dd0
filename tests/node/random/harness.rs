//! A node on an imagined bus, and what must hold with every frame.

use super::frame;
use super::frames::Frames;
use super::identifiers;
use super::nmt::Nmt;
use edskit_codegen::{Layout, LoadedDictionary};
use edskit_host::{DeviceEvent, MemoryDevice, MemoryStorage};
use edskit_runtime::{Frame, Instant, Node, Settings};
use edskit_types::{CanId, CobId, Index, NmtState, NodeId, SubIndex};
use fastrand::Rng;
use std::iter;

/// The node-ID at power-on, and the one that LSS gives at the end.
const NODE_ID: u8 = 5;
/// The most frames that wait in a node.
const CAPACITY: usize = 16;
/// How often a node is polled at most between two frames: a late poll must not harm it either.
const MOST_POLLS: usize = 8;
const LSS_REQUEST: u16 = 0x7E5;
/// The bits of a request that name the service.
const SERVICE: u8 = 0xE0;
/// The service whose requests are answered with several frames.
const BLOCK_UPLOAD: u8 = 0xA0;

pub(super) struct Harness<'a> {
    node: Node<LoadedDictionary<'a>, &'a mut MemoryStorage>,
    device: MemoryDevice,
    now: Instant,
    nmt: Nmt,
    frames: Frames<'a>,
    random: Rng,
    /// For how many more frames nobody takes what the node sends.
    stall: u8,
    /// What may be sent by a frame that waits already.
    allowed: Vec<CanId>,
    /// Whether the last request was one of a block upload, whose segments come with the polls.
    has_block_upload: bool,
    /// Whether a response may wait for room that was asked for while nobody took what the node sends.
    has_late_response: bool,
    /// Whether the queue was emptied since anything was put into it.
    is_drained: bool,
    device_type: Vec<u8>,
    /// The error register that the last EMCY message had, whether or not it was sent.
    told_register: u8,
    reached: Reached,
}

/// How often something was reached: frames that get nowhere would show nothing.
#[derive(Clone, Copy, Default, Debug)]
pub(super) struct Reached {
    frames_without_node_id: u32,
    frames_in_pre_operational: u32,
    frames_in_operational: u32,
    frames_in_stopped: u32,
    lost_heartbeats: u32,
    sdo_answers: u32,
    sdo_aborts: u32,
    block_segments: u32,
    pdos: u32,
    lss_answers: u32,
}

impl Reached {
    /// Whether every count is more than a handful.
    pub(super) fn is_far(self) -> bool {
        let states = [
            self.frames_without_node_id,
            self.frames_in_pre_operational,
            self.frames_in_operational,
            self.frames_in_stopped,
        ];
        let others = [
            self.lost_heartbeats,
            self.sdo_answers,
            self.sdo_aborts,
            self.block_segments,
            self.pdos,
            self.lss_answers,
        ];
        states.iter().all(|count| *count > 1000) && others.iter().all(|count| *count > 20)
    }
}

impl<'a> Harness<'a> {
    /// A node without power, over what an earlier one has stored.
    pub(super) fn new(layout: &'a Layout, storage: &'a mut MemoryStorage, seed: u64) -> Self {
        let value = |index: Index, sub_index: u8| {
            let position = layout.table().find(index, SubIndex(sub_index)).expect("the file has the entry");
            layout.default_of(&layout.entries[usize::from(position.0)]).to_vec()
        };
        let identity = [1, 2, 3, 4].map(|sub_index| {
            value(Index::IDENTITY, sub_index).try_into().expect("the identity has four numbers of 32 bits")
        });
        let settings = Settings { node_id: NodeId::new(NODE_ID).ok(), ..layout.settings };
        Self {
            node: Node::new(LoadedDictionary::new(layout), settings, storage),
            device: MemoryDevice::default(),
            now: Instant(0),
            nmt: Nmt::new(None, identity[3]),
            frames: Frames::new(layout, identity, seed),
            random: Rng::with_seed(!seed),
            stall: 0,
            allowed: Vec::new(),
            has_block_upload: false,
            has_late_response: false,
            is_drained: true,
            device_type: value(Index::DEVICE_TYPE, 0),
            told_register: 0,
            reached: Reached::default(),
        }
    }

    /// The first poll: the node takes its node-ID, which LSS may have stored, and boots up where it has one.
    pub(super) fn power_on(&mut self) -> Result<(), String> {
        self.node.poll(self.now, &mut self.device);
        self.nmt = Nmt::new(self.node.node_id().map(NodeId::get), self.nmt.serial_number);
        self.allow(self.nmt.state);
        self.take_sent()?;
        self.check_state()
    }

    /// What the frames have led to.
    pub(super) fn reached(&self) -> Reached {
        self.reached
    }

    /// A frame, and some time.
    pub(super) fn step(&mut self) -> Result<(), String> {
        let reached = &mut self.reached;
        *match self.nmt.state {
            NmtState::Initialising => &mut reached.frames_without_node_id,
            NmtState::PreOperational => &mut reached.frames_in_pre_operational,
            NmtState::Operational => &mut reached.frames_in_operational,
            NmtState::Stopped => &mut reached.frames_in_stopped,
        } += 1;
        let frame = self.frames.next(self.nmt.node_id);
        if self.stall == 0 && self.random.u8(..) == 0 {
            self.stall = self.random.u8(1..60);
        }
        // What LSS answers has to be known at once.
        if frame.can_id().raw() == u32::from(LSS_REQUEST) {
            self.stall = 0;
        }
        self.receive(&frame)?;
        self.stall = self.stall.saturating_sub(1);
        let pause = match self.random.u8(0..100) {
            0 => self.random.u64(..3_000_000),
            1..10 => self.random.u64(..20_000),
            _ => self.random.u64(..500),
        };
        self.pass(pause)
    }

    /// Hands a frame to the node.
    fn receive(&mut self, frame: &Frame) -> Result<(), String> {
        if self.stall == 0 {
            self.take_sent()?;
        }
        let before = (self.nmt.state, self.nmt.node_id);
        self.allow(before.0);
        let sdo = self.sdo_of(frame);
        self.node.receive(self.now, frame, &mut self.device);
        if self.stall > 0 {
            // The answer may be lost, so only what needs none is known.
            self.nmt.received(frame, &[])?;
            self.has_block_upload |= sdo.is_some();
            self.has_late_response |= sdo.is_some();
            self.is_drained = false;
        } else {
            let sent = self.sent()?;
            self.nmt.received(frame, &sent)?;
            self.allow(self.nmt.state);
            self.check_identifiers(&sent)?;
            self.check_answer(frame, sdo, before.1, &sent)?;
        }
        self.allow(self.nmt.state);
        // Only poll() can find a heartbeat missing.
        if self.lost_heartbeats() {
            return Err(format!("{frame:?} is taken for a missing heartbeat"));
        }
        self.check_state()
    }

    /// Lets microseconds pass.
    fn pass(&mut self, pause: u64) -> Result<(), String> {
        let end = Instant(self.now.0 + pause);
        for _ in 0..MOST_POLLS {
            let next = self.node.next_deadline(self.now);
            if next < self.now {
                return Err(format!("at {:?} the next deadline is {next:?}", self.now));
            }
            if next > end {
                break;
            }
            self.now = next;
            self.poll()?;
        }
        self.now = end;
        self.poll()
    }

    fn poll(&mut self) -> Result<(), String> {
        let behaviour = self.node.objects().value(Index(0x1029), 1).unwrap_or(0);
        self.allow(self.nmt.state);
        self.node.poll(self.now, &mut self.device);
        if self.lost_heartbeats() {
            self.reached.lost_heartbeats += 1;
            self.nmt.lost_heartbeat(behaviour);
        }
        if self.stall == 0 {
            let sent = self.sent()?;
            self.check_identifiers(&sent)?;
            let responses = self.responses(&sent, self.nmt.node_id);
            let is_time_out = |frame: &&Frame| matches!(frame.data(), [0x80, _, _, _, 0, 0, 4, 5]);
            let may_be_late = self.has_late_response;
            // With a poll of an empty queue every response is out.
            self.has_late_response &= !self.is_drained;
            self.is_drained = true;
            if !self.has_block_upload && !may_be_late && !responses.iter().all(is_time_out) {
                return Err(format!("nobody has asked for {responses:?}"));
            }
        }
        self.check_state()
    }

    /// Takes what waits, where it is not known which frame it answers.
    fn take_sent(&mut self) -> Result<(), String> {
        let sent = self.sent()?;
        self.check_identifiers(&sent)?;
        self.allowed.clear();
        Ok(())
    }

    fn sent(&mut self) -> Result<Vec<Frame>, String> {
        let sent: Vec<Frame> = iter::from_fn(|| self.node.transmit()).take(CAPACITY + 1).collect();
        if sent.len() > CAPACITY {
            return Err(format!("more than {CAPACITY} frames wait"));
        }
        sent.iter().for_each(|frame| {
            self.frames.heard(frame);
            self.count(frame);
        });
        Ok(sent)
    }

    fn count(&mut self, frame: &Frame) {
        let reached = &mut self.reached;
        match (frame.can_id().raw(), frame.data()) {
            (0x7E4, _) => reached.lss_answers += 1,
            (0x581..=0x5FF, [0x80, ..]) => reached.sdo_aborts += 1,
            (0x581..=0x5FF, _) if self.has_block_upload => reached.block_segments += 1,
            (0x581..=0x5FF, _) => reached.sdo_answers += 1,
            (0x181..=0x57F, _) => reached.pdos += 1,
            _ => {}
        }
    }

    /// From now on the node may send what its dictionary names in this state.
    fn allow(&mut self, state: NmtState) {
        let node_id = self.node.node_id().map(NodeId::get);
        for can_id in identifiers::of(node_id, state, &self.node.objects()) {
            if !self.allowed.contains(&can_id) {
                self.allowed.push(can_id);
            }
        }
    }

    fn check_identifiers(&mut self, sent: &[Frame]) -> Result<(), String> {
        let is_foreign = |frame: &&Frame| frame.is_remote() || !self.allowed.contains(&frame.can_id());
        match sent.iter().find(is_foreign) {
            Some(frame) => {
                Err(format!("{frame:?} is sent in {} (allowed: {:?})", self.nmt.state, self.allowed))
            }
            None => Ok(()),
        }
    }

    fn check_state(&mut self) -> Result<(), String> {
        self.check_parameters()?;
        let (state, node_id) = (self.node.state(), self.node.node_id().map(NodeId::get));
        let expected = (self.nmt.state, self.nmt.node_id);
        if (state, node_id) == expected {
            return Ok(());
        }
        Err(format!("the node is in {state} with node-ID {node_id:?} instead of {expected:?}"))
    }

    /// What the error register shows was told last, and no value is there that a client could not write.
    fn check_parameters(&mut self) -> Result<(), String> {
        let register: u8 = self.node.objects().value(Index::ERROR_REGISTER, 0).unwrap_or(0);
        if register != self.told_register {
            return Err(format!("1001h is {register:02X}h, and {:02X}h was told last", self.told_register));
        }
        // This looks at the whole dictionary, so not with every frame.
        if self.random.u8(..) > 0 {
            return Ok(());
        }
        let mut refused = Vec::new();
        self.node.refused(&mut self.device, &mut |entry, code| refused.push((*entry, code)));
        if refused.is_empty() { Ok(()) } else { Err(format!("a client could not write {refused:?}")) }
    }

    /// Whether a heartbeat or the guarding was found missing since the last call.
    fn lost_heartbeats(&mut self) -> bool {
        let mut is_lost = false;
        for event in self.device.take_events() {
            match event {
                DeviceEvent::State(NmtState::Initialising) => self.told_register = 0,
                DeviceEvent::Emergency(emergency) => {
                    self.told_register = emergency.register;
                    is_lost |= emergency.code == 0x8130;
                }
                _ => {}
            }
        }
        is_lost
    }

    /// The request, where the frame is one for the default SDO server and the node is in a state to take it.
    fn sdo_of(&self, frame: &Frame) -> Option<[u8; 8]> {
        let own = self.nmt.node_id?;
        let is_communicating = matches!(self.nmt.state, NmtState::PreOperational | NmtState::Operational);
        let is_request = Some(frame.can_id()) == CanId::standard(0x600 + u16::from(own));
        frame.data().try_into().ok().filter(|_| is_communicating && is_request)
    }

    /// What the default SDO server has sent.
    fn responses<'f>(&mut self, sent: &'f [Frame], node_id: Option<u8>) -> Vec<&'f Frame> {
        let response = node_id.and_then(|own| CanId::standard(0x580 + u16::from(own)));
        let shared = self.node.objects().value(Index(0x1201), 2).map(|cob_id| CobId(cob_id).can_id());
        // Where another server answers with the same identifier, nobody can tell them apart.
        let is_response = |frame: &&Frame| Some(frame.can_id()) == response && shared != response;
        sent.iter().filter(is_response).collect()
    }

    fn check_answer(
        &mut self,
        frame: &Frame,
        sdo: Option<[u8; 8]>,
        own: Option<u8>,
        sent: &[Frame],
    ) -> Result<(), String> {
        let responses = self.responses(sent, own);
        let Some(request) = sdo else {
            return if responses.is_empty() {
                Ok(())
            } else {
                Err(format!("{frame:?} is answered by {responses:?}"))
            };
        };
        let [command, ..] = request;
        let asks_for_blocks = command & SERVICE == BLOCK_UPLOAD;
        self.has_block_upload = asks_for_blocks;
        if responses.len() > 1 && !asks_for_blocks {
            return Err(format!("{frame:?} is answered by {responses:?}"));
        }
        let is_device_type = |data: &[u8]| data[..4] == [0x43, 0, 0x10, 0];
        match (request, &responses[..]) {
            ([0x40, 0, 0x10, 0, ..], [answer])
                if is_device_type(answer.data()) && answer.data()[4..] != self.device_type =>
            {
                Err(format!("the device type is {answer:?}"))
            }
            _ => Ok(()),
        }
    }

    /// Brings the node back as a master would: it resets the communication, gives a node-ID where there is none, and asks
    /// for the device type.
    pub(super) fn come_back(&mut self) -> Result<(), String> {
        self.stall = 0;
        self.receive(&frame(0, &[130, 0]))?;
        if self.nmt.node_id.is_none() {
            let lss = [[0x04, 1], [0x11, NODE_ID], [0x04, 0]];
            for [command, argument] in lss {
                self.receive(&frame(LSS_REQUEST, &[command, argument, 0, 0, 0, 0, 0, 0]))?;
            }
        }
        self.pass(0)?;
        let own = self.nmt.node_id.ok_or("the node has no node-ID")?;
        let request = frame(0x600 + u16::from(own), &[0x40, 0, 0x10, 0, 0, 0, 0, 0]);
        self.node.receive(self.now, &request, &mut self.device);
        let answer = [&[0x43, 0, 0x10, 0], &self.device_type[..]].concat();
        let sent = self.sent()?;
        if sent.contains(&frame(0x580 + u16::from(own), &answer)) {
            return Ok(());
        }
        Err(format!("after all, the device type is asked for and {sent:?} is sent"))
    }
}
