//! Frames at random, weighted so that they reach far into a node.

use super::frame;
use super::scripts::{Step, Writer};
use edskit_codegen::Layout;
use edskit_runtime::{Entry, Frame};
use edskit_types::CanId;
use fastrand::Rng;
use std::collections::VecDeque;

/// The first bytes of SDO requests, right and wrong ones.
const COMMANDS: [u8; 24] = [
    0x00, 0x01, 0x0D, 0x10, 0x11, 0x1D, 0x20, 0x21, 0x22, 0x23, 0x27, 0x2B, 0x2F, 0x40, 0x60, 0x70, 0x80,
    0xA0, 0xA1, 0xA2, 0xA3, 0xC0, 0xC1, 0xC6,
];

/// Numbers that mean something in one object or another: counts, times, COB-IDs, mappings, signatures.
const NUMBERS: [u32; 20] = [
    0,
    1,
    2,
    3,
    8,
    64,
    100,
    240,
    252,
    255,
    0x80,
    0x4000_0080,
    0x8000_0080,
    0x205,
    0x8000_0205,
    0xC000_0185,
    0x2000_0120,
    0x0007_0020,
    0x6576_6173,
    0x6461_6F6C,
];

/// The source of frames.
pub(super) struct Frames<'a> {
    random: Rng,
    entries: &'a [Entry],
    identity: [[u8; 4]; 4],
    script: VecDeque<Step>,
    /// The first byte of the last SDO response, which in a block is a sequence number.
    last_response: u8,
}

impl<'a> Frames<'a> {
    pub(super) fn new(layout: &'a Layout, identity: [[u8; 4]; 4], seed: u64) -> Self {
        let random = Rng::with_seed(seed);
        Self { random, entries: &layout.entries, identity, script: VecDeque::new(), last_response: 0 }
    }

    /// The node has sent a frame.
    pub(super) fn heard(&mut self, frame: &Frame) {
        if let (0x581..=0x5FF, [first, ..]) = (frame.can_id().raw(), frame.data()) {
            self.last_response = *first;
        }
    }

    /// The next frame for a node with this node-ID.
    pub(super) fn next(&mut self, node_id: Option<u8>) -> Frame {
        // A script is broken into now and then, as by another master.
        if self.random.u8(..) >= 24
            && let Some(step) = self.script.pop_front()
        {
            return match step {
                Step::Frame(frame) => frame,
                Step::Acknowledge { can_id, block_size } => {
                    frame(can_id, &[0xA2, self.last_response & 0x7F, block_size, 0, 0, 0, 0, 0])
                }
            };
        }
        let own = node_id.unwrap_or(5);
        match self.random.u8(0..100) {
            _ if node_id.is_none() && self.random.bool() => self.lss(own),
            0..25 => self.sdo_request(own),
            25..35 => {
                self.begin_script(own);
                self.sdo_request(own)
            }
            35..38 => self.nmt(own),
            38..44 => self.lss(own),
            44..58 => self.pdo(own),
            58..66 => self.broadcast(),
            66..70 => {
                let node_id = self.random.u16(1..=127);
                let state = self.random.choice([0, 4, 5, 127, 133, 255]).unwrap_or(0);
                self.of_some_length(0x700 + node_id, &[state, 0, 0, 0, 0, 0, 0, 0], 1)
            }
            70..78 => self.remote(own),
            78..85 => self.extended(),
            _ => {
                let can_id = self.random.u16(0..=0x7FF);
                let data = self.bytes();
                let length = self.random.usize(0..=8);
                frame(can_id, &data[..length])
            }
        }
    }

    fn begin_script(&mut self, own: u8) {
        let Self { random, entries, identity, script, .. } = self;
        Writer { random, entries, identity, script }.write(own);
    }

    fn sdo_request(&mut self, own: u8) -> Frame {
        let entry = &self.entries[self.random.usize(..self.entries.len())];
        let (mut index, mut sub_index) = (entry.index.0, entry.sub_index.0);
        match self.random.u8(0..20) {
            0 => index = self.random.u16(..),
            1 => sub_index = self.random.u8(..),
            _ => {}
        }
        let command = match self.random.u8(0..10) {
            0 => self.random.u8(..),
            1 => self.random.u8(..128),
            _ => self.random.choice(COMMANDS).unwrap_or(0),
        };
        let number = match self.random.u8(0..4) {
            0 => self.random.u32(..),
            _ => self.random.choice(NUMBERS).unwrap_or(0),
        };
        let ([low, high], [a, b, c, d]) = (index.to_le_bytes(), number.to_le_bytes());
        self.of_some_length(0x600 + u16::from(own), &[command, low, high, sub_index, a, b, c, d], 8)
    }

    fn nmt(&mut self, own: u8) -> Frame {
        // A running node reaches further than one that is stopped or booting.
        let command = match self.random.u8(0..20) {
            0 => 129,
            1 => 130,
            2 => 2,
            3 => 128,
            4 => self.random.u8(..),
            _ => 1,
        };
        let addressee = match self.random.u8(0..10) {
            0..4 => 0,
            4..9 => own,
            _ => self.random.u8(..),
        };
        self.of_some_length(0, &[command, addressee, 0, 0, 0, 0, 0, 0], 2)
    }

    fn lss(&mut self, own: u8) -> Frame {
        let mut data = self.bytes();
        data[0] = match self.random.u8(0..12) {
            0..3 => 0x04,
            3..5 => 0x11,
            5..8 => 0x51,
            8 => self.random.u8(0x40..=0x4C),
            9 => self.random.u8(0x5A..=0x5E),
            10 => self.random.choice([0x13, 0x15, 0x17]).unwrap_or(0),
            _ => data[0],
        };
        match data[0] {
            0x04 => data[1] &= 1,
            0x11 => data[1] = self.random.choice([own, 5, 6, 127, 0, 128, 255]).unwrap_or(5),
            0x51 => data[5] = self.random.choice([128, 31, 1, 0]).unwrap_or(128),
            _ => {}
        }
        if self.random.bool() {
            data[1..5].copy_from_slice(&self.identity[self.random.usize(..4)]);
        }
        self.of_some_length(0x7E5, &data, 8)
    }

    /// A frame with an identifier of the pre-defined PDOs, of this node or of others.
    fn pdo(&mut self, own: u8) -> Frame {
        let function = self.random.u16(3..=10) << 7;
        let node_id = if self.random.u8(..) < 200 { own } else { self.random.u8(1..=127) };
        let data = self.bytes();
        self.of_some_length(function + u16::from(node_id), &data, 8)
    }

    /// SYNC and TIME.
    fn broadcast(&mut self) -> Frame {
        let data = self.bytes();
        match self.random.u8(0..8) {
            0 => self.of_some_length(0x100, &data, 6),
            1 => self.of_some_length(0x80, &data, 1),
            _ => self.of_some_length(0x80, &data, 0),
        }
    }

    fn remote(&mut self, own: u8) -> Frame {
        let own = u16::from(own);
        let can_id = match self.random.u8(0..4) {
            0 => 0x700 + own,
            1 => 0x180 + (self.random.u16(0..4) << 8) + own,
            2 => self.random.choice([0, 0x80, 0x600 + own, 0x7E5]).unwrap_or(0),
            _ => self.random.u16(0..=0x7FF),
        };
        Frame::remote(CanId::standard(can_id).expect("it has eleven bits"), self.random.u8(0..=8))
    }

    /// With the low bits of an identifier that would matter with eleven bits.
    fn extended(&mut self) -> Frame {
        let can_id =
            if self.random.bool() { self.random.u32(..=0x7FF) } else { self.random.u32(..=0x1FFF_FFFF) };
        let can_id = CanId::extended(can_id).expect("it has 29 bits");
        let data = self.bytes();
        let length = self.random.usize(0..=8);
        if self.random.bool() {
            Frame::new(can_id, &data[..length])
        } else {
            Frame::remote(can_id, length as u8)
        }
    }

    /// Mostly of the right length.
    fn of_some_length(&mut self, can_id: u16, data: &[u8; 8], right: usize) -> Frame {
        let length = if self.random.u8(..) < 12 { self.random.usize(0..=8) } else { right };
        frame(can_id, &data[..length])
    }

    fn bytes(&mut self) -> [u8; 8] {
        self.random.u64(..).to_le_bytes()
    }
}
