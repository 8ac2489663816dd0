//! A whole node on an imagined bus.

mod device;
mod device_hooks;
mod domains;
mod emergencies;
mod error_changes;
mod error_control;
#[cfg(not(feature = "default"))]
mod features;
mod given;
mod hooks;
mod hostile;
#[cfg(feature = "lss")]
mod lss;
mod nmt;
mod pdo;
mod pdo_changes;
mod room;
mod sdo;
#[cfg(feature = "block-transfer")]
mod sdo_block;
mod storage;
mod sync;

use crate::{Application, Frame, Instant, Microseconds, NoApplication, Node, Settings, Storage};
use device::Device;
use edskit_types::{CanId, NodeId};
use std::boxed::Box;
use std::vec::Vec;

/// The node-ID of all tests.
const NODE: u8 = 5;

/// A node with its clock, its application and what it has sent.
struct Bench {
    node: Node<Device, &'static mut dyn Storage>,
    app: Box<dyn Application>,
    now: Instant,
}

impl Bench {
    /// A node in pre-operational, its boot-up message taken.
    fn new(device: Device) -> Self {
        Self::with(device, Box::new(crate::NoStorage), Box::new(NoApplication))
    }

    fn with(device: Device, storage: Box<dyn Storage>, app: Box<dyn Application>) -> Self {
        let mut bench =
            Self::off(device, Settings { node_id: NodeId::new(NODE).ok(), ..Settings::default() }, storage);
        bench.app = app;
        assert_eq!(bench.poll(), [frame(0x705, &[0])]);
        bench
    }

    /// A node that is not powered on.
    fn off(device: Device, settings: Settings, storage: Box<dyn Storage>) -> Self {
        Self {
            node: Node::new(device, settings, Box::leak(storage)),
            app: Box::new(NoApplication),
            now: Instant(1_000_000),
        }
    }

    /// Polls, and takes what is sent.
    fn poll(&mut self) -> Vec<Frame> {
        self.node.poll(self.now, &mut *self.app);
        self.sent()
    }

    fn sent(&mut self) -> Vec<Frame> {
        core::iter::from_fn(|| self.node.transmit()).collect()
    }

    /// Hands a frame to the node, and takes what it answers at once.
    fn receive(&mut self, frame: Frame) -> Vec<Frame> {
        self.node.receive(self.now, &frame, &mut *self.app);
        self.poll()
    }

    /// The same for a frame with these data.
    fn ask(&mut self, can_id: u16, data: &[u8]) -> Vec<Frame> {
        self.receive(frame(can_id, data))
    }

    /// Lets time pass, polling whenever the node wants it; what was sent, with its time since the start of the call.
    fn pass(&mut self, milliseconds: u32) -> Vec<(u64, Frame)> {
        let (start, mut sent) = (self.now, Vec::new());
        let end = start + Microseconds::from_milliseconds(milliseconds);
        loop {
            let next = self.node.next_deadline(self.now);
            if next > end {
                break;
            }
            self.now = self.now.max(next);
            sent.extend(self.poll().into_iter().map(|frame| (self.now.since(start).0, frame)));
        }
        self.now = end;
        sent
    }

    fn nmt(&mut self, command: u8) -> Vec<Frame> {
        self.ask(0, &[command, NODE])
    }

    /// An expedited or segmented upload.
    fn read(&mut self, index: u16, sub_index: u8) -> Result<Vec<u8>, u32> {
        let [low, high] = index.to_le_bytes();
        let answer = self.sdo([0x40, low, high, sub_index, 0, 0, 0, 0])?;
        assert_eq!(answer[1..4], [low, high, sub_index]);
        if answer[0] & 2 != 0 {
            return Ok(answer[4..8 - usize::from(answer[0] >> 2 & 3)].to_vec());
        }
        let announced = u32::from_le_bytes(answer[4..8].try_into().unwrap());
        let mut value = Vec::new();
        let mut toggle = 0;
        loop {
            let segment = self.sdo([0x60 | toggle, 0, 0, 0, 0, 0, 0, 0])?;
            assert_eq!(segment[0] & 0xF0, toggle);
            value.extend_from_slice(&segment[1..8 - usize::from(segment[0] >> 1 & 7)]);
            toggle ^= 0x10;
            if segment[0] & 1 != 0 {
                assert!(answer[0] & 1 == 0 || announced as usize == value.len());
                return Ok(value);
            }
        }
    }

    /// An expedited download, a segmented one where the value is longer.
    fn write(&mut self, index: u16, sub_index: u8, value: &[u8]) -> Result<(), u32> {
        let [low, high] = index.to_le_bytes();
        if let 1..=4 = value.len() {
            let mut request = [0x23 | (4 - value.len() as u8) << 2, low, high, sub_index, 0, 0, 0, 0];
            request[4..4 + value.len()].copy_from_slice(value);
            assert_eq!(self.sdo(request)?, [0x60, low, high, sub_index, 0, 0, 0, 0]);
            return Ok(());
        }
        let [a, b, c, d] = (value.len() as u32).to_le_bytes();
        self.sdo([0x21, low, high, sub_index, a, b, c, d])?;
        let mut toggle = 0;
        let count = value.chunks(7).count().max(1);
        for (number, chunk) in value.chunks(7).chain((value.is_empty()).then_some(&[][..])).enumerate() {
            let mut request =
                [toggle | (7 - chunk.len() as u8) << 1 | u8::from(number + 1 == count), 0, 0, 0, 0, 0, 0, 0];
            request[1..=chunk.len()].copy_from_slice(chunk);
            assert_eq!(self.sdo(request)?[0], 0x20 | toggle);
            toggle ^= 0x10;
        }
        Ok(())
    }

    /// One SDO request with its answer, or the abort code.
    fn sdo(&mut self, request: [u8; 8]) -> Result<[u8; 8], u32> {
        let sent = self.ask(0x605, &request);
        let answers: Vec<&Frame> = sent.iter().filter(|frame| frame.can_id().raw() == 0x585).collect();
        let [answer] = answers[..] else { panic!("{request:02X?} is answered by {sent:?}") };
        let answer: [u8; 8] = answer.data().try_into().unwrap();
        if answer[0] == 0x80 {
            return Err(u32::from_le_bytes(answer[4..8].try_into().unwrap()));
        }
        Ok(answer)
    }
}

fn frame(can_id: u16, data: &[u8]) -> Frame {
    Frame::new(CanId::standard(can_id).unwrap(), data)
}
