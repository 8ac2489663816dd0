//! A node that runs allocates nothing, whatever it does.
//!
//! The node is used as firmware uses it; every call of it is counted by itself, so that the client at the other end may
//! allocate.

use edskit_codegen::{LoadedDictionary, parse};
use edskit_host::sdo::{SdoChannel, SdoError, SdoMode, SdoOptions, Transfer};
use edskit_runtime::{
    Application, EmcyError, Entry, Frame, Instant, Microseconds, Node, Record, Services, Settings, Storage,
    StorageError,
};
use edskit_tests::allocation::{self, Counting};
use edskit_types::{AbortCode, CanId, Index, NmtState, NodeId, SubIndex};

#[global_allocator]
static ALLOCATOR: Counting = Counting;

const NODE_ID: u8 = 5;

#[test]
fn a_node_allocates_nothing_in_any_service() {
    let path = edskit_tests::root().join("tests/fixtures/nodes/Everything.eds");
    let layout = parse(&edskit_tests::read(&path), None).expect("the file can be laid out");
    let settings = Settings { node_id: NodeId::new(NODE_ID).ok(), ..Settings::default() };
    let node = Node::new(LoadedDictionary::new(&layout), settings, FixedStorage::default());
    let mut watched = Watched { node, device: FixedDevice([0; 1000], 0), now: Instant(0), allocations: 0 };

    assert_eq!(watched.pass(0), [frame(0x705, &[0])]);
    read_and_write(&mut watched);
    pdos(&mut watched);
    error_control(&mut watched);
    store_and_restore(&mut watched);
    lss(&mut watched);
    assert_eq!(watched.allocations, 0);
}

fn read_and_write(watched: &mut Watched<'_>) {
    let text: Vec<u8> = (0..200).map(|place| b'a' + place % 26).collect();
    for mode in [SdoMode::Segmented, SdoMode::Block] {
        assert_eq!(watched.read(0x1000, 0, mode).expect("the device type can be read"), [0; 4]);
        watched.write(0x2002, 0, &text, mode).expect("the text can be written");
        assert_eq!(watched.read(0x2002, 0, mode).expect("the text can be read"), text);
        let file: Vec<u8> = (0..1000_u16).map(|place| place as u8).collect();
        watched.write(0x2008, 0, &file, mode).expect("the file can be written");
        assert_eq!(watched.read(0x2008, 0, mode).expect("the file can be read"), file);
    }
    let refused = watched.write(0x2005, 0, &1000_i16.to_le_bytes(), SdoMode::Expedited);
    assert!(matches!(refused, Err(SdoError::Aborted(AbortCode::VALUE_TOO_HIGH))), "{refused:?}");
    // A client that falls silent.
    watched.receive(&frame(0x605, &[0x21, 2, 0x20, 0, 20, 0, 0, 0]));
    assert_eq!(watched.pass(1000), [frame(0x585, &[0x80, 2, 0x20, 0, 0, 0, 4, 5])]);
}

fn pdos(watched: &mut Watched<'_>) {
    watched.set(0x1801, 1, 0x8000_0285_u32);
    watched.set(0x1A01, 0, 0_u8);
    watched.set(0x1A01, 1, 0x2001_0318_u32);
    watched.set(0x1A01, 2, 0x2001_0120_u32);
    watched.set(0x1A01, 0, 2_u8);
    watched.set(0x1801, 1, 0x285_u32);
    watched.receive(&frame(0, &[1, NODE_ID]));
    assert_eq!(watched.node.state(), NmtState::Operational);
    watched.receive(&frame(0x205, &[1, 2, 3, 4, 0xCD, 0xAB, 0, 0]));
    assert!(
        watched
            .receive(&frame(0x80, &[]))
            .contains(&frame(0x285, &[0xFB, 0xFF, 0xFF, 0x78, 0x56, 0x34, 0x12]))
    );
    let sent = watched.pass(100);
    assert!(sent.iter().any(|frame| frame.can_id().raw() == 0x185), "the event timer runs");
    let requested = watched.receive(&Frame::remote(can_id(0x385), 8));
    assert!(requested.iter().any(|frame| frame.can_id().raw() == 0x385), "{requested:?}");
    watched.receive(&frame(0x100, &[0; 6]));
    // Shorter than its mapping.
    let told = watched.receive(&frame(0x205, &[1]));
    assert!(told.iter().any(|frame| frame.can_id().raw() == 0x85), "{told:?}");
}

fn error_control(watched: &mut Watched<'_>) {
    watched.receive(&Frame::remote(can_id(0x705), 1));
    watched.set(0x1016, 1, 0x0007_0010_u32);
    watched.receive(&frame(0x707, &[5]));
    watched.set(0x1017, 0, 10_u16);
    let sent = watched.pass(50);
    assert!(sent.contains(&frame(0x705, &[127])), "the node has left operational: {sent:?}");
    assert!(sent.iter().any(|frame| frame.data().starts_with(&[0x30, 0x81])), "{sent:?}");
    let error = EmcyError { code: 0x4200, register: 8 };
    watched.counted(|node, _, now| node.services(now).raise(error, 1, [0; 5]));
    watched.counted(|node, _, now| node.services(now).clear(error, 1));
    let told = watched.pass(0).into_iter().filter(|frame| frame.can_id().raw() == 0x85).count();
    assert_eq!(told, 2);
}

fn store_and_restore(watched: &mut Watched<'_>) {
    let heartbeat =
        |watched: &mut Watched<'_>| watched.read(0x1017, 0, SdoMode::Expedited).expect("it can be read");
    watched.write(0x1010, 1, b"save", SdoMode::Expedited).expect("the parameters can be saved");
    watched.receive(&frame(0, &[129, NODE_ID]));
    assert_eq!(heartbeat(watched), 10_u16.to_le_bytes());
    watched.write(0x1011, 1, b"load", SdoMode::Expedited).expect("the parameters can be restored");
    watched.receive(&frame(0, &[130, NODE_ID]));
    assert_eq!(heartbeat(watched), [0, 0]);
}

fn lss(watched: &mut Watched<'_>) {
    let mut lss = |data: [u8; 8]| watched.receive(&frame(0x7E5, &data));
    for (place, number) in [1_u8, 3, 0, 42].into_iter().enumerate() {
        let revision = u8::from(place == 2);
        lss([0x40 + place as u8, number, 0, revision, 0, 0, 0, 0]);
    }
    assert_eq!(lss([0x5E, 0, 0, 0, 0, 0, 0, 0]), [frame(0x7E4, &[0x5E, NODE_ID, 0, 0, 0, 0, 0, 0])]);
    lss([0x13, 0, 2, 0, 0, 0, 0, 0]);
    lss([0x11, 255, 0, 0, 0, 0, 0, 0]);
    assert_eq!(lss([0x17, 0, 0, 0, 0, 0, 0, 0]), [frame(0x7E4, &[0x17, 0, 0, 0, 0, 0, 0, 0])]);
    lss([0x04, 0, 0, 0, 0, 0, 0, 0]);
    watched.receive(&frame(0, &[130, NODE_ID]));
    assert_eq!(watched.node.node_id(), None);
    let found = frame(0x7E4, &[0x4F, 0, 0, 0, 0, 0, 0, 0]);
    assert_eq!(watched.receive(&frame(0x7E5, &[0x51, 0, 0, 0, 0, 128, 0, 0])), [found]);
}

/// A node whose calls are counted.
struct Watched<'a> {
    node: Node<LoadedDictionary<'a>, FixedStorage>,
    device: FixedDevice,
    now: Instant,
    allocations: usize,
}

impl<'a> Watched<'a> {
    fn counted<T>(
        &mut self,
        act: impl FnOnce(&mut Node<LoadedDictionary<'a>, FixedStorage>, &mut FixedDevice, Instant) -> T,
    ) -> T {
        allocation::begin();
        let result = act(&mut self.node, &mut self.device, self.now);
        self.allocations += allocation::counted().allocations;
        result
    }

    /// Hands a frame to the node; what it sends then.
    fn receive(&mut self, frame: &Frame) -> Vec<Frame> {
        self.counted(|node, device, now| node.receive(now, frame, device));
        self.pass(0)
    }

    /// Lets milliseconds pass; what the node sends meanwhile.
    fn pass(&mut self, milliseconds: u32) -> Vec<Frame> {
        let end = self.now + Microseconds::from_milliseconds(milliseconds);
        let mut sent = Vec::new();
        loop {
            self.counted(|node, device, now| node.poll(now, device));
            while let Some(frame) = self.counted(|node, _, _| node.transmit()) {
                sent.push(frame);
            }
            let next = self.counted(|node, _, now| node.next_deadline(now));
            if next > end {
                self.now = end;
                return sent;
            }
            self.now = next;
        }
    }

    fn transfer(&mut self, mut transfer: Transfer) -> Result<Vec<u8>, SdoError> {
        loop {
            while let Some(frame) = transfer.transmit(self.now) {
                let answers = self.receive(&frame);
                answers.iter().for_each(|answer| transfer.receive(self.now, answer));
            }
            if let Some(result) = transfer.result() {
                return result.map(|value| value.bytes);
            }
            let answers = self.pass(1);
            answers.iter().for_each(|answer| transfer.receive(self.now, answer));
            transfer.poll(self.now);
        }
    }

    fn read(&mut self, index: u16, sub_index: u8, mode: SdoMode) -> Result<Vec<u8>, SdoError> {
        let options = SdoOptions { mode, ..SdoOptions::default() };
        self.transfer(Transfer::read(channel(), Index(index), SubIndex(sub_index), options, self.now))
    }

    fn write(&mut self, index: u16, sub_index: u8, data: &[u8], mode: SdoMode) -> Result<(), SdoError> {
        let options = SdoOptions { mode, ..SdoOptions::default() };
        self.transfer(Transfer::write(channel(), Index(index), SubIndex(sub_index), data, options, self.now))
            .map(drop)
    }

    /// Writes a number that is accepted.
    fn set<T: edskit_runtime::Value>(&mut self, index: u16, sub_index: u8, value: T) {
        let mut bytes = [0; 8];
        value.to_bytes(&mut bytes);
        let bytes = &bytes[..size_of::<T>()];
        self.write(index, sub_index, bytes, SdoMode::Expedited).expect("the value is accepted");
    }
}

/// One file of at most so many bytes, and how many it has.
struct FixedDevice([u8; 1000], usize);

impl Application for FixedDevice {
    fn domain_length(&mut self, _: &mut Services<'_>, _: &Entry) -> Result<Option<u32>, AbortCode> {
        Ok(Some(self.1 as u32))
    }

    fn read_domain(
        &mut self,
        _: &mut Services<'_>,
        _: &Entry,
        offset: u32,
        buffer: &mut [u8],
    ) -> Result<usize, AbortCode> {
        let rest = &self.0[offset as usize..self.1];
        let count = rest.len().min(buffer.len());
        buffer[..count].copy_from_slice(&rest[..count]);
        Ok(count)
    }

    fn write_domain(
        &mut self,
        _: &mut Services<'_>,
        _: &Entry,
        offset: u32,
        data: &[u8],
        _: bool,
    ) -> Result<(), AbortCode> {
        let (start, end) = (offset as usize, offset as usize + data.len());
        self.0.get_mut(start..end).ok_or(AbortCode::OUT_OF_MEMORY)?.copy_from_slice(data);
        self.1 = end;
        Ok(())
    }
}

/// Room for a few records, as in a flash.
struct FixedStorage {
    records: [(Option<Record>, Bytes); 4],
    begun: Bytes,
}

#[derive(Clone, Copy)]
struct Bytes {
    bytes: [u8; 2000],
    length: usize,
}

impl Bytes {
    const NONE: Self = Self { bytes: [0; 2000], length: 0 };
}

impl Default for FixedStorage {
    fn default() -> Self {
        Self { records: [(None, Bytes::NONE); 4], begun: Bytes::NONE }
    }
}

impl Storage for FixedStorage {
    fn read(&mut self, record: Record, offset: u32, buffer: &mut [u8]) -> Result<usize, StorageError> {
        let Some((_, stored)) = self.records.iter().find(|(kept, _)| *kept == Some(record)) else {
            return Ok(0);
        };
        let rest = stored.bytes[..stored.length].get(offset as usize..).unwrap_or_default();
        let count = rest.len().min(buffer.len());
        buffer[..count].copy_from_slice(&rest[..count]);
        Ok(count)
    }

    fn begin(&mut self, _: Record) -> Result<(), StorageError> {
        self.begun = Bytes::NONE;
        Ok(())
    }

    fn write(&mut self, _: Record, data: &[u8]) -> Result<(), StorageError> {
        let Bytes { bytes, length } = &mut self.begun;
        bytes.get_mut(*length..*length + data.len()).ok_or(StorageError)?.copy_from_slice(data);
        *length += data.len();
        Ok(())
    }

    fn commit(&mut self, record: Record) -> Result<(), StorageError> {
        self.erase(record)?;
        let free = self.records.iter_mut().find(|(kept, _)| kept.is_none()).ok_or(StorageError)?;
        *free = (Some(record), self.begun);
        Ok(())
    }

    fn erase(&mut self, record: Record) -> Result<(), StorageError> {
        self.records.iter_mut().filter(|(kept, _)| *kept == Some(record)).for_each(|(kept, _)| *kept = None);
        Ok(())
    }
}

fn channel() -> SdoChannel {
    SdoChannel::of_node(NodeId::new(NODE_ID).expect("it is a node-ID"))
}

fn can_id(raw: u16) -> CanId {
    CanId::standard(raw).expect("it has eleven bits")
}

fn frame(raw: u16, data: &[u8]) -> Frame {
    Frame::new(can_id(raw), data)
}
