//! What the tests of the device share.

use super::{Configuration, Engine, Event, Gateway, Owner, Parameter};
use edskit_runtime::{Device, Frame, Instant, Microseconds, Record, Storage, StorageError};
use edskit_types::CanId;
use std::cell::RefCell;
use std::rc::Rc;
use std::vec::Vec;

/// Memory for one record, whose content can be seen from outside.
#[derive(Clone, Debug, Default)]
pub(super) struct OneRecord {
    kept: Rc<RefCell<Vec<u8>>>,
    begun: Vec<u8>,
}

impl Storage for OneRecord {
    fn read(&mut self, _: Record, offset: u32, buffer: &mut [u8]) -> Result<usize, StorageError> {
        let kept = self.kept.borrow();
        let rest = kept.get(offset as usize..).unwrap_or_default();
        let count = rest.len().min(buffer.len());
        buffer[..count].copy_from_slice(&rest[..count]);
        Ok(count)
    }

    fn begin(&mut self, _: Record) -> Result<(), StorageError> {
        self.begun.clear();
        Ok(())
    }

    fn write(&mut self, _: Record, data: &[u8]) -> Result<(), StorageError> {
        self.begun.extend_from_slice(data);
        Ok(())
    }

    fn commit(&mut self, _: Record) -> Result<(), StorageError> {
        *self.kept.borrow_mut() = core::mem::take(&mut self.begun);
        Ok(())
    }

    fn erase(&mut self, _: Record) -> Result<(), StorageError> {
        self.kept.borrow_mut().clear();
        Ok(())
    }
}

/// A configuration with these parameters set.
pub(super) fn configuration(settings: &[(Owner, u16, i32)]) -> Configuration {
    let mut configuration = Configuration::new();
    for &(owner, number, value) in settings {
        let parameter =
            Parameter::find(owner, number).unwrap_or_else(|| panic!("{owner:?} has no P{number}"));
        configuration.set(parameter, value).unwrap();
    }
    configuration
}

/// A gateway with its clock.
pub(super) struct Bench {
    pub(super) gateway: Gateway<Engine, OneRecord>,
    pub(super) now: Instant,
}

impl Bench {
    /// A gateway that has just got its supply.
    pub(super) fn off(settings: &[(Owner, u16, i32)]) -> Self {
        let gateway = Gateway::new(configuration(settings), Engine::new(), OneRecord::default());
        let mut bench = Self { gateway, now: Instant(0) };
        assert_eq!(bench.poll(), []);
        bench
    }

    /// A gateway in pre-operational, its boot-up message taken.
    pub(super) fn new(settings: &[(Owner, u16, i32)]) -> Self {
        let mut bench = Self::off(settings);
        let node_id = bench.gateway.parameters().node_id().get();
        let sent = bench.pass(231_250);
        assert_eq!(sent, [(231_250, frame(0x700 + u16::from(node_id), &[0]))]);
        bench.events();
        bench
    }

    /// A gateway in operational, in whose present main cycle of the governor nothing is sent any more.
    pub(super) fn started(settings: &[(Owner, u16, i32)]) -> Self {
        let mut bench = Self::new(settings);
        assert_eq!(bench.nmt(1), []);
        bench.events();
        bench
    }

    fn poll(&mut self) -> Vec<Frame> {
        self.gateway.poll(self.now);
        self.sent()
    }

    pub(super) fn sent(&mut self) -> Vec<Frame> {
        core::iter::from_fn(|| self.gateway.transmit()).collect()
    }

    /// Hands a frame to the gateway, and takes what it answers at once.
    pub(super) fn ask(&mut self, can_id: u16, data: &[u8]) -> Vec<Frame> {
        self.hand(&frame(can_id, data))
    }

    pub(super) fn hand(&mut self, frame: &Frame) -> Vec<Frame> {
        self.gateway.receive(self.now, frame);
        self.poll()
    }

    /// A command of the NMT master to all nodes.
    pub(super) fn nmt(&mut self, command: u8) -> Vec<Frame> {
        self.ask(0, &[command, 0])
    }

    /// Lets so many microseconds pass; what was sent, with its time since the start of the call.
    pub(super) fn pass(&mut self, microseconds: u64) -> Vec<(u64, Frame)> {
        let (start, mut sent) = (self.now, Vec::new());
        let end = start + Microseconds(microseconds);
        loop {
            let next = self.gateway.next_deadline(self.now);
            if next > end {
                break;
            }
            self.now = next;
            sent.extend(self.poll().into_iter().map(|frame| (self.now.since(start).0, frame)));
        }
        self.now = end;
        sent
    }

    /// When frames with this CAN-ID were sent while time passed.
    pub(super) fn times_of(&mut self, can_id: u16, microseconds: u64) -> Vec<u64> {
        let sent = self.pass(microseconds);
        sent.into_iter()
            .filter(|(_, frame)| frame.can_id().raw() == can_id.into())
            .map(|(time, _)| time)
            .collect()
    }

    /// What has happened since the last call.
    pub(super) fn events(&mut self) -> Vec<Event> {
        core::iter::from_fn(|| self.gateway.take_event()).collect()
    }

    /// One SDO request to the node-ID that is in effect; the answer, or `None` where there is none.
    pub(super) fn sdo(&mut self, request: [u8; 8]) -> Option<[u8; 8]> {
        let node_id = u16::from(self.gateway.effective_parameters().node_id().get());
        let sent = self.ask(0x600 + node_id, &request);
        let answers: Vec<_> =
            sent.iter().filter(|frame| frame.can_id().raw() == u32::from(0x580 + node_id)).collect();
        assert!(answers.len() <= 1, "{answers:?}");
        answers.first().map(|answer| answer.data().try_into().unwrap())
    }

    /// The value of an entry, or the abort code.
    pub(super) fn read(&mut self, index: u16, sub_index: u8) -> Result<u32, u32> {
        let [low, high] = index.to_le_bytes();
        let answer = self.sdo([0x40, low, high, sub_index, 0, 0, 0, 0]).expect("SDO is answered");
        assert_eq!(answer[1..4], [low, high, sub_index]);
        let number = u32::from_le_bytes(answer[4..].try_into().unwrap());
        if answer[0] == 0x80 { Err(number) } else { Ok(number) }
    }

    /// The abort code of a request that must be refused.
    pub(super) fn abort(&mut self, request: [u8; 8]) -> u32 {
        let answer = self.sdo(request).expect("SDO is answered");
        assert_eq!(answer[0], 0x80, "{request:02X?} is answered by {answer:02X?}");
        u32::from_le_bytes(answer[4..].try_into().unwrap())
    }
}

pub(super) fn frame(can_id: u16, data: &[u8]) -> Frame {
    Frame::new(CanId::standard(can_id).unwrap(), data)
}
