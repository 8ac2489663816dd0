//! LSS slave: layer setting services (CiA 305 v2.2).

use crate::Application;
use crate::commissioning::SOURCE;
use crate::context::Context;
use crate::records::{Record, StorageError};
use crate::{Commissioning, EmcyError, Frame, LssAnswer, LssRequest, MOST_DATA, Reset, Settings};
use edskit_types::{Bitrate, CanId, Index, NodeId};

/// The identifier of answers, 7E4h.
const RESPONSE: u16 = 0x7E4;
/// The node-ID that means: none.
const UNCONFIGURED: u8 = 255;

/// Command specifiers.
mod command {
    pub(super) const SWITCH_GLOBAL: u8 = 0x04;
    pub(super) const CONFIGURE_NODE_ID: u8 = 0x11;
    pub(super) const CONFIGURE_BIT_TIMING: u8 = 0x13;
    pub(super) const ACTIVATE_BIT_TIMING: u8 = 0x15;
    pub(super) const STORE: u8 = 0x17;
    pub(super) const SWITCH_SELECTIVE_FIRST: u8 = 0x40;
    pub(super) const SWITCH_SELECTIVE_LAST: u8 = 0x43;
    pub(super) const SWITCH_SELECTIVE_ANSWER: u8 = 0x44;
    pub(super) const IDENTIFY_FIRST: u8 = 0x46;
    pub(super) const IDENTIFY_LAST: u8 = 0x4B;
    pub(super) const IDENTIFY_NON_CONFIGURED: u8 = 0x4C;
    pub(super) const IDENTIFY_ANSWER: u8 = 0x4F;
    pub(super) const NON_CONFIGURED_ANSWER: u8 = 0x50;
    pub(super) const FAST_SCAN: u8 = 0x51;
    pub(super) const INQUIRE_FIRST: u8 = 0x5A;
    pub(super) const INQUIRE_LAST: u8 = 0x5D;
    pub(super) const INQUIRE_NODE_ID: u8 = 0x5E;
}

#[derive(Debug)]
pub(crate) struct Lss {
    is_in_configuration: bool,
    /// How many numbers of the identity have matched in a row while being selected.
    selected: u8,
    /// The same for identification, whose six requests bound revision and serial number.
    identified: u8,
    /// Which number of the identity a fast scan looks at.
    scanned: u8,
}

impl Lss {
    pub(crate) const fn new() -> Self {
        Self { is_in_configuration: false, selected: 0, identified: 0, scanned: 0 }
    }

    /// Whether the node is an LSS slave.
    #[inline]
    pub(crate) fn exists(settings: &Settings) -> bool {
        settings.has_lss
    }

    /// Back to the state waiting, to which the initial state leads (CiA 305, slave FSA).
    pub(crate) fn restart(&mut self) {
        *self = Self::new();
    }

    pub(crate) fn is_in_configuration(&self) -> bool {
        self.is_in_configuration
    }
}

impl<A: Application + ?Sized> Context<'_, A> {
    /// A frame with the identifier 7E5h.
    pub(crate) fn lss_request(&mut self, frame: &Frame) {
        let Some(request) = frame.eight() else { return };
        let [code, b1, b2, b3, b4, b5, b6, b7] = request;
        let number = u32::from_le_bytes([b1, b2, b3, b4]);
        match code {
            command::SWITCH_GLOBAL => self.switch_global(b1),
            command::SWITCH_SELECTIVE_FIRST..=command::SWITCH_SELECTIVE_LAST => {
                self.switch_selective(code - command::SWITCH_SELECTIVE_FIRST, number);
            }
            command::IDENTIFY_FIRST..=command::IDENTIFY_LAST => {
                self.identify(code - command::IDENTIFY_FIRST, number);
            }
            command::IDENTIFY_NON_CONFIGURED if self.node.core.pending_node_id.is_none() => {
                self.answer([command::NON_CONFIGURED_ANSWER, 0, 0, 0, 0, 0, 0, 0]);
            }
            command::FAST_SCAN => self.fast_scan(number, b5, b6, b7),
            _ if self.node.core.lss.is_in_configuration => self.configure_by_lss(code, b1, b2),
            _ => {}
        }
    }

    /// The services of the configuration state.
    fn configure_by_lss(&mut self, code: u8, b1: u8, b2: u8) {
        match code {
            command::CONFIGURE_NODE_ID => {
                let node_id = NodeId::new(b1).ok();
                if node_id.is_none() && b1 != UNCONFIGURED {
                    return self.answer([code, 1, 0, 0, 0, 0, 0, 0]);
                }
                let error = match self.app.lss(&mut self.node, LssRequest::NodeId(node_id)) {
                    LssAnswer::Refused(error) => error,
                    LssAnswer::Done => 0,
                    LssAnswer::ByNode => {
                        self.node.core.pending_node_id = node_id;
                        0
                    }
                };
                self.answer([code, error, 0, 0, 0, 0, 0, 0]);
            }
            command::CONFIGURE_BIT_TIMING => {
                let error = match self.app.lss(&mut self.node, LssRequest::BitRate { table: b1, index: b2 }) {
                    LssAnswer::Refused(error) => error,
                    LssAnswer::Done => 0,
                    LssAnswer::ByNode => {
                        let bit_rates = self.node.core.settings.bit_rates;
                        let bit_rate = Bitrate::from_lss_index(b2);
                        let supported = bit_rate.filter(|bit_rate| b1 == 0 && bit_rates.has(*bit_rate));
                        if supported.is_some() {
                            self.node.core.bit_rate = supported;
                        }
                        u8::from(supported.is_none())
                    }
                };
                self.answer([code, error, 0, 0, 0, 0, 0, 0]);
            }
            command::ACTIVATE_BIT_TIMING => {
                let delay = u16::from_le_bytes([b1, b2]);
                let answer = self.app.lss(&mut self.node, LssRequest::ActivateBitRate(delay));
                if let (LssAnswer::ByNode, Some(bit_rate)) = (answer, self.node.core.bit_rate) {
                    self.app.activate_bit_rate(bit_rate, delay);
                }
            }
            command::STORE => {
                let core = &self.node.core;
                let present = Commissioning { node_id: core.pending_node_id, bit_rate: core.bit_rate };
                let error = match self.app.lss(&mut self.node, LssRequest::Store(present)) {
                    LssAnswer::Refused(error) => error,
                    LssAnswer::Done => 0,
                    LssAnswer::ByNode if self.store_lss().is_ok() => 0,
                    LssAnswer::ByNode => {
                        self.app.storage_failed(&mut self.node, Record::Lss);
                        2
                    }
                };
                self.answer([code, error, 0, 0, 0, 0, 0, 0]);
            }
            command::INQUIRE_FIRST..=command::INQUIRE_LAST => {
                let [a, b, c, d] = self.identity(code - command::INQUIRE_FIRST).to_le_bytes();
                self.answer([code, a, b, c, d, 0, 0, 0]);
            }
            command::INQUIRE_NODE_ID => {
                let node_id = self.node.core.pending_node_id.map_or(UNCONFIGURED, NodeId::get);
                self.answer([code, node_id, 0, 0, 0, 0, 0, 0]);
            }
            _ => {}
        }
    }

    fn answer(&mut self, data: [u8; MOST_DATA]) {
        if let Some(can_id) = CanId::standard(RESPONSE) {
            self.node.core.queue.send(can_id, &data);
        }
    }

    /// A number of the identity 1018h: 0 the vendor-ID, 1 the product code, 2 the revision number, 3 the serial number.
    #[inline(never)]
    fn identity(&self, number: u8) -> u32 {
        self.node.objects.value(Index::IDENTITY, number.saturating_add(1)).unwrap_or_default()
    }

    fn switch_global(&mut self, mode: u8) {
        match mode {
            0 => self.leave_configuration(),
            1 => self.enter_configuration(),
            _ => {}
        }
    }

    /// The configuration state is entered, unless the device refuses.
    fn enter_configuration(&mut self) {
        let answer = self.app.lss(&mut self.node, LssRequest::Configuration);
        self.node.core.lss.is_in_configuration = !matches!(answer, LssAnswer::Refused(_));
    }

    /// A node without a node-ID that has got one boots up now.
    fn leave_configuration(&mut self) {
        self.node.core.lss.is_in_configuration = false;
        if self.node.core.node_id.is_none() && self.node.core.pending_node_id.is_some() {
            self.initialise(Reset::Communication);
        }
    }

    fn switch_selective(&mut self, place: u8, number: u32) {
        if self.node.core.lss.is_in_configuration {
            return;
        }
        if place == 0 {
            self.node.core.lss.selected = 0;
        }
        if self.node.core.lss.selected != place || self.identity(place) != number {
            self.node.core.lss.selected = 0;
            return;
        }
        self.node.core.lss.selected += 1;
        if place == 3 {
            self.node.core.lss.selected = 0;
            self.enter_configuration();
            if !self.node.core.lss.is_in_configuration {
                return;
            }
            self.answer([command::SWITCH_SELECTIVE_ANSWER, 0, 0, 0, 0, 0, 0, 0]);
        }
    }

    /// Vendor-ID, product code, lowest and highest revision number, lowest and highest serial number.
    fn identify(&mut self, place: u8, number: u32) {
        if place == 0 {
            self.node.core.lss.identified = 0;
        }
        let is_match = match place {
            0 | 1 => self.identity(place) == number,
            2 => self.identity(2) >= number,
            3 => self.identity(2) <= number,
            4 => self.identity(3) >= number,
            _ => self.identity(3) <= number,
        };
        if self.node.core.lss.identified != place || !is_match {
            self.node.core.lss.identified = 0;
            return;
        }
        self.node.core.lss.identified += 1;
        if place == 5 {
            self.node.core.lss.identified = 0;
            self.answer([command::IDENTIFY_ANSWER, 0, 0, 0, 0, 0, 0, 0]);
        }
    }

    /// Fast scan: all nodes without node-ID whose number agrees with `number` down to bit `bit` answer; `next` is the
    /// number to be looked at from then on. Bit 128 begins the scan.
    fn fast_scan(&mut self, number: u32, bit: u8, place: u8, next: u8) {
        if self.node.core.pending_node_id.is_some() || self.node.core.lss.is_in_configuration {
            return;
        }
        let agrees = match bit {
            128 => {
                self.node.core.lss.scanned = 0;
                true
            }
            0..=31 if place == self.node.core.lss.scanned && place <= 3 => {
                (self.identity(place) ^ number) >> bit == 0
            }
            _ => false,
        };
        if !agrees {
            return;
        }
        if bit == 0 {
            self.node.core.lss.scanned = next;
            if place == 3 && next == 0 {
                self.enter_configuration();
            }
        }
        self.answer([command::IDENTIFY_ANSWER, 0, 0, 0, 0, 0, 0, 0]);
    }

    /// Stores node-ID and bit rate, the one that was configured last or is stored already.
    fn store_lss(&mut self) -> Result<(), StorageError> {
        let node_id = self.node.core.pending_node_id.map_or(UNCONFIGURED, NodeId::get);
        let rate = self.node.core.bit_rate.map_or(0, Bitrate::kbit_per_s).to_le_bytes();
        let [low, high] = rate;
        self.node.storage.begin(Record::Lss)?;
        // The complement tells a torn record from a right one.
        self.node.storage.write(Record::Lss, &[node_id, !node_id, low, high, !low, !high])?;
        self.node.storage.commit(Record::Lss)?;
        self.clear(EmcyError::LOST_PARAMETERS, SOURCE);
        Ok(())
    }
}
