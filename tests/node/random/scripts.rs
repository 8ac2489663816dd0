//! Sequences of frames that single ones at random would hardly ever make.

use super::frame;
use edskit_runtime::{Crc, Entry, Frame};
use edskit_types::CanId;
use fastrand::Rng;
use std::collections::VecDeque;

/// What a client can write while the services run: index, sub-index and length.
const PARAMETERS: [(u16, u8, u8); 29] = [
    (0x1005, 0, 4),
    (0x1006, 0, 4),
    (0x1007, 0, 4),
    (0x100C, 0, 2),
    (0x100D, 0, 1),
    (0x1014, 0, 4),
    (0x1015, 0, 2),
    (0x1016, 1, 4),
    (0x1016, 2, 4),
    (0x1017, 0, 2),
    (0x1019, 0, 1),
    (0x1029, 1, 1),
    (0x1201, 1, 4),
    (0x1201, 2, 4),
    (0x1400, 1, 4),
    (0x1400, 2, 1),
    (0x1400, 5, 2),
    (0x1401, 1, 4),
    (0x1401, 2, 1),
    (0x1401, 5, 2),
    (0x1800, 1, 4),
    (0x1800, 2, 1),
    (0x1800, 3, 2),
    (0x1800, 5, 2),
    (0x1800, 6, 1),
    (0x1801, 1, 4),
    (0x1801, 2, 1),
    (0x1801, 3, 2),
    (0x1801, 5, 2),
];

/// One frame of a script.
pub(super) enum Step {
    Frame(Frame),
    /// Confirms the segments of a block upload that have come.
    Acknowledge {
        can_id: u16,
        block_size: u8,
    },
}

/// Writes scripts.
pub(super) struct Writer<'a> {
    pub(super) random: &'a mut Rng,
    pub(super) entries: &'a [Entry],
    pub(super) identity: &'a [[u8; 4]; 4],
    pub(super) script: &'a mut VecDeque<Step>,
}

impl Writer<'_> {
    /// A script in the place of the present one, for a node with this node-ID.
    pub(super) fn write(&mut self, own: u8) {
        self.script.clear();
        let sdo = 0x600 + u16::from(own);
        match self.random.u8(0..14) {
            10.. => self.parameters(sdo, own),
            0 => self.segmented_upload(sdo),
            1 => self.segmented_download(sdo),
            2 => self.block_upload(sdo),
            3 => self.block_download(sdo),
            4 | 5 => self.other_mapping(sdo, own),
            6 => self.monitoring(sdo),
            7 => self.selection(own),
            8 => self.fast_scan(own),
            _ => self.timers(sdo),
        }
    }

    fn push(&mut self, can_id: u16, data: [u8; 8]) {
        self.script.push_back(Step::Frame(frame(can_id, &data)));
    }

    /// A message that names any entry of the dictionary.
    fn begin(&mut self, sdo: u16, command: u8, argument: u32) {
        let entry = &self.entries[self.random.usize(..self.entries.len())];
        let ([low, high], [a, b, c, d]) = (entry.index.0.to_le_bytes(), argument.to_le_bytes());
        let sub_index = entry.sub_index.0;
        self.push(sdo, [command, low, high, sub_index, a, b, c, d]);
    }

    /// An expedited download of 1, 2 or 4 bytes.
    fn set(&mut self, sdo: u16, index: u16, sub_index: u8, bytes: u8, value: u32) {
        let ([low, high], [a, b, c, d]) = (index.to_le_bytes(), value.to_le_bytes());
        self.push(sdo, [0x23 | (4 - bytes) << 2, low, high, sub_index, a, b, c, d]);
    }

    fn segmented_upload(&mut self, sdo: u16) {
        self.begin(sdo, 0x40, 0);
        for number in 0..self.random.u8(1..40) {
            self.push(sdo, [0x60 | (number & 1) << 4, 0, 0, 0, 0, 0, 0, 0]);
        }
    }

    fn segmented_download(&mut self, sdo: u16) {
        let length = self.random.usize(1..60);
        self.begin(sdo, 0x21, length as u32);
        let value: Vec<u8> = (0..length).map(|_| self.random.u8(..)).collect();
        let count = length.div_ceil(7);
        for (number, segment) in value.chunks(7).enumerate() {
            let mut data = [0; 8];
            data[0] =
                (number as u8 & 1) << 4 | (7 - segment.len() as u8) << 1 | u8::from(number + 1 == count);
            data[1..=segment.len()].copy_from_slice(segment);
            self.push(sdo, data);
        }
    }

    fn block_upload(&mut self, sdo: u16) {
        let block_size = self.random.choice([1, 3, 20, 127]).unwrap_or(1);
        self.begin(sdo, 0xA4, block_size.into());
        self.push(sdo, [0xA3, 0, 0, 0, 0, 0, 0, 0]);
        for _ in 0..self.random.u8(1..12) {
            self.script.push_back(Step::Acknowledge { can_id: sdo, block_size });
        }
        self.push(sdo, [0xA1, 0, 0, 0, 0, 0, 0, 0]);
    }

    fn block_download(&mut self, sdo: u16) {
        let length = self.random.usize(1..300);
        self.begin(sdo, 0xC6, length as u32);
        let value: Vec<u8> = (0..length).map(|_| self.random.u8(..)).collect();
        let count = length.div_ceil(7);
        for (number, segment) in value.chunks(7).enumerate() {
            let mut data = [0; 8];
            data[0] = (number + 1) as u8 | u8::from(number + 1 == count) << 7;
            data[1..=segment.len()].copy_from_slice(segment);
            self.push(sdo, data);
        }
        let mut crc = Crc::new();
        crc.update(&value);
        let [low, high] = crc.value().to_le_bytes();
        let unused = (count * 7 - length) as u8;
        self.push(sdo, [0xC1 | unused << 2, low, high, 0, 0, 0, 0, 0]);
    }

    /// Gives a PDO another mapping in the order that CiA 301 prescribes.
    fn other_mapping(&mut self, sdo: u16, own: u8) {
        let number = self.random.u16(0..3);
        let (base, function) =
            self.random.choice([(0x1400, 0x200), (0x1800, 0x180)]).unwrap_or((0x1400, 0x200));
        let cob_id = u32::from(function + (number << 8) + u16::from(own));
        let (communication, mapping) = (base + number, base + 0x200 + number);
        self.set(sdo, communication, 1, 4, cob_id | 0x8000_0000);
        let transmission = self.random.choice([0, 1, 3, 240, 252, 253, 254, 255]).unwrap_or(255);
        self.set(sdo, communication, 2, 1, transmission);
        self.set(sdo, mapping, 0, 1, 0);
        let count = self.random.u8(0..4);
        for place in 1..=count {
            let entry = &self.entries[self.random.usize(..self.entries.len())];
            let bits = u32::from(entry.size.min(8)) * 8;
            let mapped = u32::from(entry.index.0) << 16 | u32::from(entry.sub_index.0) << 8 | bits;
            self.set(sdo, mapping, place, 4, mapped);
        }
        self.set(sdo, mapping, 0, 1, count.into());
        self.set(sdo, communication, 1, 4, cob_id);
    }

    /// Has another node monitored, lets it be heard once, and says what follows from its loss.
    fn monitoring(&mut self, sdo: u16) {
        let behaviour = self.random.u32(0..3);
        self.set(sdo, 0x1029, 1, 1, behaviour);
        let (node_id, time) = (self.random.u16(1..=127), self.random.u32(1..50));
        let place = self.random.u8(1..=2);
        self.set(sdo, 0x1016, place, 4, u32::from(node_id) << 16 | time);
        self.script.push_back(Step::Frame(frame(0x700 + node_id, &[5])));
    }

    /// Times of heartbeat, guarding, SYNC and PDOs.
    fn timers(&mut self, sdo: u16) {
        let time = self.random.u32(0..100);
        match self.random.u8(0..5) {
            0 => self.set(sdo, 0x1017, 0, 2, time),
            1 => {
                self.set(sdo, 0x1017, 0, 2, 0);
                self.set(sdo, 0x100C, 0, 2, time);
                self.set(sdo, 0x100D, 0, 1, 2);
                let own = CanId::standard(sdo + 0x100).expect("it has eleven bits");
                self.script.push_back(Step::Frame(Frame::remote(own, 1)));
            }
            2 => {
                self.set(sdo, 0x1006, 0, 4, time * 1000);
                self.set(sdo, 0x1005, 0, 4, 0x4000_0080);
            }
            3 => self.set(sdo, 0x1400, 5, 2, time),
            _ => {
                self.set(sdo, 0x1800, 5, 2, time);
                self.set(sdo, 0x1800, 3, 2, time * 10);
            }
        }
    }

    /// Parameters of every service, written while the services keep something: what waits for SYNC, a sample, a deadline.
    fn parameters(&mut self, sdo: u16, own: u8) {
        for _ in 0..self.random.u8(2..12) {
            if self.random.bool() {
                let step = self.something_to_keep(own);
                self.script.push_back(step);
            }
            let (index, sub_index, bytes) = self.random.choice(PARAMETERS).unwrap_or((0x1017, 0, 2));
            let value = match (index, sub_index) {
                (0x1005, _) => self.random.choice([0x80, 0x4000_0080, 0x90]).unwrap_or(0x80),
                (0x1014, _) => (0x80 + u32::from(own)) | self.bit_31(),
                (0x1016, _) => u32::from(self.random.u8(1..5)) << 16 | self.random.u32(0..40),
                (0x1019, _) => self.random.choice([0, 2, 10, 240, 250]).unwrap_or(0),
                (0x1029, _) => self.random.u32(0..4),
                (0x1006, _) => self.random.choice([0, 1000, 20_000]).unwrap_or(0),
                (0x1201, _) => (0x580 + 0x80 * u32::from(2 - sub_index) + 100) | self.bit_31(),
                (0x1400..=0x1BFF, 1) => {
                    let (base, number) =
                        if index < 0x1800 { (0x200, index - 0x1400) } else { (0x180, index - 0x1800) };
                    u32::from(base + (number << 8) + u16::from(own)) | self.bit_31()
                }
                (0x1400..=0x1BFF, 2) => self.random.choice([0, 1, 2, 252, 253, 254, 255]).unwrap_or(255),
                _ => self.random.choice([0, 1, 20, 200]).unwrap_or(0),
            };
            self.set(sdo, index, sub_index, bytes, value);
        }
    }

    /// Bit 31 of a COB-ID in one of two cases.
    fn bit_31(&mut self) -> u32 {
        u32::from(self.random.bool()) << 31
    }

    /// A frame after which a service keeps something.
    fn something_to_keep(&mut self, own: u8) -> Step {
        let (own, number) = (u16::from(own), self.random.u16(0..3) << 8);
        let heard = 0x700 + self.random.u16(1..5);
        Step::Frame(match self.random.u8(0..7) {
            0 => frame(0, &[1, 0]),
            1 => frame(0x200 + number + own, &[1, 2, 3, 4, 5, 6, 7, 8]),
            2 => frame(0x200 + number + own, &[1]),
            3 => frame(heard, &[5]),
            4 => Frame::remote(CanId::standard(0x180 + number + own).expect("it has eleven bits"), 8),
            5 => Frame::remote(CanId::standard(0x700 + own).expect("it has eleven bits"), 1),
            _ => frame(0x80, &[]),
        })
    }

    fn lss(&mut self, command: u8, number: [u8; 4], rest: [u8; 3]) {
        let ([a, b, c, d], [e, f, g]) = (number, rest);
        self.push(0x7E5, [command, a, b, c, d, e, f, g]);
    }

    /// Selects the node by its identity, and gives it a node-ID or takes it away.
    fn selection(&mut self, own: u8) {
        for (place, number) in (0x40..).zip(*self.identity) {
            self.lss(place, number, [0; 3]);
        }
        self.configure(own);
    }

    /// Finds the node as one without a node-ID, in as few questions as there can be: the right ones.
    fn fast_scan(&mut self, own: u8) {
        self.lss(0x51, [0; 4], [128, 0, 0]);
        for (place, number) in (0..).zip(*self.identity) {
            self.lss(0x51, number, [31, place, place]);
            self.lss(0x51, number, [0, place, (place + 1) & 3]);
        }
        self.configure(own);
    }

    fn configure(&mut self, own: u8) {
        let node_id = self.random.choice([own, 5, 6, 255]).unwrap_or(5);
        self.lss(0x11, [node_id, 0, 0, 0], [0; 3]);
        if self.random.bool() {
            self.lss(0x17, [0; 4], [0; 3]);
        }
        self.lss(0x04, [0; 4], [0; 3]);
        self.script.push_back(Step::Frame(frame(0, &[130, 0])));
    }
}
