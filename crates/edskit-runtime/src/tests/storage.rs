use super::device::{COB_ID, RW, with_values};
use super::{Bench, frame};
use crate::{Application, NoApplication, NoStorage, Record, Services, Storage, StorageError, StorageGroup};
use edskit_types::{DataType, Index, SubIndex};
use std::boxed::Box;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;
use std::vec;
use std::vec::Vec;

/// Memory that outlives the node.
#[derive(Clone, Default)]
pub(super) struct Memory(Rc<RefCell<Cells>>);

#[derive(Default)]
struct Cells {
    records: BTreeMap<Record, Vec<u8>>,
    begun: Vec<u8>,
}

impl Memory {
    /// Turns a bit of a record over.
    pub(super) fn flip(&self, record: Record, place: usize) {
        self.0.borrow_mut().records.get_mut(&record).unwrap()[place] ^= 0x10;
    }
}

impl Storage for Memory {
    fn read(&mut self, record: Record, offset: u32, buffer: &mut [u8]) -> Result<usize, StorageError> {
        let cells = self.0.borrow();
        let Some(rest) = cells.records.get(&record).and_then(|bytes| bytes.get(offset as usize..)) else {
            return Ok(0);
        };
        // Small pieces, as a memory on a slow bus would give them.
        let count = rest.len().min(buffer.len()).min(3);
        buffer[..count].copy_from_slice(&rest[..count]);
        Ok(count)
    }

    fn begin(&mut self, _: Record) -> Result<(), StorageError> {
        self.0.borrow_mut().begun.clear();
        Ok(())
    }

    fn write(&mut self, _: Record, data: &[u8]) -> Result<(), StorageError> {
        self.0.borrow_mut().begun.extend_from_slice(data);
        Ok(())
    }

    fn commit(&mut self, record: Record) -> Result<(), StorageError> {
        let mut cells = self.0.borrow_mut();
        let begun = cells.begun.clone();
        cells.records.insert(record, begun);
        Ok(())
    }

    fn erase(&mut self, record: Record) -> Result<(), StorageError> {
        self.0.borrow_mut().records.remove(&record);
        Ok(())
    }
}

fn bench(storage: impl Storage + 'static) -> Bench {
    let device = with_values()
        .u8(0x1010, 0, crate::Flags::READ, 4)
        .u32(0x1010, 1, RW, 1)
        .u32(0x1010, 2, RW, 1)
        .u32(0x1010, 4, RW, 1)
        .u32(0x1011, 1, RW, 1)
        .u32(0x1014, 0, COB_ID, 0x80)
        .add(0x2020, 0, DataType::VisibleString, RW.stored_in(StorageGroup::MANUFACTURER), "text")
        .build();
    Bench::with_storage(device, Box::new(storage))
}

impl Bench {
    /// A node whose boot-up may be followed by an emergency.
    pub(super) fn with_storage(device: super::Device, storage: Box<dyn Storage>) -> Self {
        let settings = crate::Settings { node_id: edskit_types::NodeId::new(5).ok(), ..Default::default() };
        let mut bench = Self::off(device, settings, storage);
        bench.app = Box::new(NoApplication);
        bench
    }
}

#[cfg(feature = "storage")]
#[test]
fn what_is_saved_survives_power_off() {
    let memory = Memory::default();
    let mut bench = self::bench(memory.clone());
    bench.poll();
    bench.write(0x1017, 0, &[0xD2, 4]).unwrap();
    bench.write(0x2000, 0, &[7, 7]).unwrap();
    bench.write(0x2020, 0, b"another text").unwrap();
    bench.write(0x2001, 0, &[3]).unwrap();
    assert_eq!(bench.write(0x1010, 1, b"now!"), Err(0x0800_0020));
    bench.write(0x1010, 1, b"save").unwrap();
    let mut again = self::bench(memory.clone());
    assert_eq!(again.poll(), [frame(0x705, &[0])]);
    assert_eq!(again.read(0x1017, 0), Ok([0xD2, 4].into()));
    assert_eq!(again.read(0x2000, 0), Ok([7, 7].into()));
    assert_eq!(again.read(0x2020, 0), Ok(b"another text".to_vec()));
    assert_eq!(again.read(0x2001, 0), Ok([7].into()), "it is in no group");
    again.write(0x1011, 1, b"load").unwrap();
    assert_eq!(again.read(0x2000, 0), Ok([7, 7].into()), "the values change with the next reset");
    again.nmt(129);
    assert_eq!((again.read(0x2000, 0), again.read(0x1017, 0)), (Ok([0x34, 0x12].into()), Ok([0, 0].into())));
}

#[cfg(feature = "storage")]
#[test]
fn groups_are_saved_one_by_one() {
    let memory = Memory::default();
    let mut bench = self::bench(memory.clone());
    bench.poll();
    bench.write(0x1017, 0, &[0xD2, 4]).unwrap();
    bench.write(0x2000, 0, &[7, 7]).unwrap();
    bench.write(0x1010, 4, b"save").unwrap();
    bench.nmt(129);
    assert_eq!((bench.read(0x2000, 0), bench.read(0x1017, 0)), (Ok([7, 7].into()), Ok([0, 0].into())));
}

#[cfg(feature = "storage")]
#[test]
fn every_torn_record_is_noticed() {
    let memory = Memory::default();
    let mut bench = self::bench(memory.clone());
    bench.poll();
    bench.write(0x2000, 0, &[7, 7]).unwrap();
    bench.write(0x1010, 4, b"save").unwrap();
    let record = Record::Values(StorageGroup::MANUFACTURER);
    let whole = memory.0.borrow().records[&record].clone();
    let torn = (1..whole.len()).map(|length| whole[..length].to_vec());
    let flipped = (0..whole.len()).map(|place| {
        let mut bytes = whole.clone();
        bytes[place] ^= 0x10;
        bytes
    });
    for bytes in torn.chain(flipped) {
        memory.0.borrow_mut().records.insert(record, bytes);
        let mut again = self::bench(memory.clone());
        let sent = again.poll();
        assert_eq!(sent[1], frame(0x85, &[0, 0x63, 1, 4, 0, 0, 0, 0]), "it says so");
        assert_eq!(again.read(0x2000, 0), Ok([0x34, 0x12].into()));
    }
}

#[test]
fn without_memory_saving_fails() {
    let mut bench = self::bench(NoStorage);
    bench.poll();
    assert_eq!(bench.write(0x1010, 1, b"save"), Err(0x0606_0000));
}

/// A revision of a device: its entries from 2000h on, and the group of one of them.
fn revision(
    size: DataType,
    has_second: bool,
    limits: Option<(i64, i64)>,
    group: StorageGroup,
) -> super::Device {
    let mut device = super::device::plain()
        .u32(0x1010, 1, RW, 1)
        .u32(0x1011, 1, RW, 1)
        .u32(0x1014, 0, COB_ID.stored_in(StorageGroup::COMMUNICATION), 0x80)
        .add(0x2000, 0, size, RW.stored_in(group), vec![1; usize::from(size.bits().unwrap() / 8)])
        .u16(0x2002, 0, RW.stored_in(StorageGroup::MANUFACTURER), 5);
    if let Some((low, high)) = limits {
        device = device.limited(low, high);
    }
    if has_second {
        device = device.u8(0x2001, 0, RW.stored_in(StorageGroup::MANUFACTURER), 3);
    }
    device.build()
}

/// Notes what is dropped.
struct Dropped(Rc<RefCell<Vec<u16>>>);

impl Application for Dropped {
    fn stored_value_dropped(&mut self, _: &mut Services<'_>, index: Index, _: SubIndex) {
        self.0.borrow_mut().push(index.0);
    }
}

#[cfg(feature = "storage")]
#[test]
fn stored_values_survive_an_update_one_by_one() {
    let memory = Memory::default();
    let manufacturer = StorageGroup::MANUFACTURER;
    let power_on = |device: super::Device| {
        let dropped = Rc::new(RefCell::new(Vec::new()));
        let mut bench = Bench::with_storage(device, Box::new(memory.clone()));
        bench.app = Box::new(Dropped(dropped.clone()));
        let sent = bench.poll();
        let errors: Vec<Vec<u8>> = sent[1..].iter().map(|frame| frame.data().to_vec()).collect();
        let dropped = dropped.borrow().clone();
        (bench, errors, dropped)
    };
    let (mut bench, _, _) = power_on(revision(DataType::Unsigned16, true, None, manufacturer));
    bench.write(0x2000, 0, &[7, 7]).unwrap();
    bench.write(0x2001, 0, &[8]).unwrap();
    bench.write(0x2002, 0, &[9, 0]).unwrap();
    bench.write(0x1017, 0, &[100, 0]).unwrap();
    bench.write(0x1010, 1, b"save").unwrap();
    let lost = |index: u8| vec![0, 0x63, 1, 4, index, 0x20, 0, 0];

    let (mut bench, errors, dropped) = power_on(revision(DataType::Unsigned16, false, None, manufacturer));
    assert_eq!(
        (&errors[..], &dropped[..]),
        (&[][..], &[0x2001][..]),
        "an entry is gone, and nothing is lost"
    );
    assert_eq!((bench.read(0x2000, 0), bench.read(0x2002, 0)), (Ok([7, 7].into()), Ok([9, 0].into())));
    assert_eq!(bench.read(0x1017, 0), Ok([100, 0].into()));

    let (mut bench, errors, dropped) = power_on(revision(DataType::Unsigned32, true, None, manufacturer));
    assert_eq!((&errors[..], &dropped[..]), (&[lost(0)][..], &[0x2000][..]), "another size");
    assert_eq!((bench.read(0x2000, 0), bench.read(0x2001, 0)), (Ok([1; 4].into()), Ok([8].into())));
    // Whoever stores or restores has no lost parameters any more.
    assert_eq!(bench.read(0x1001, 0), Ok([1].into()));
    let restored = memory.clone();
    let kept = restored.0.borrow().records.clone();
    bench.write(0x1011, 1, b"load").unwrap();
    assert_eq!(bench.read(0x1001, 0), Ok([0].into()));
    restored.0.borrow_mut().records = kept;

    let limits = Some((0, 8));
    let (mut bench, errors, dropped) = power_on(revision(DataType::Unsigned16, true, limits, manufacturer));
    assert_eq!((&errors[..], &dropped[..]), (&[lost(2)][..], &[0x2002][..]), "beyond the new limits");
    assert_eq!(bench.read(0x2002, 0), Ok([5, 0].into()));

    let moved = revision(DataType::Unsigned16, true, None, StorageGroup(9));
    let (mut bench, errors, dropped) = power_on(moved);
    assert_eq!((&errors[..], &dropped[..]), (&[][..], &[][..]), "another group");
    assert_eq!((bench.read(0x2000, 0), bench.read(0x2001, 0)), (Ok([7, 7].into()), Ok([8].into())));
    bench.write(0x2000, 0, &[6, 6]).unwrap();
    bench.write(0x1010, 1, b"save").unwrap();
    let (mut bench, ..) = power_on(revision(DataType::Unsigned16, true, None, StorageGroup(9)));
    assert_eq!(bench.read(0x2000, 0), Ok([6, 6].into()));
}

#[cfg(feature = "storage")]
#[test]
fn a_stored_value_that_no_client_could_write_is_left() {
    let device = |cob_id: u32| {
        super::device::plain()
            .u32(0x1010, 1, RW, 1)
            .u32(0x1014, 0, COB_ID.stored_in(StorageGroup::COMMUNICATION), cob_id)
            .u8(0x1029, 1, RW.stored_in(StorageGroup::COMMUNICATION), 0)
            .build()
    };
    let memory = Memory::default();
    let mut bench = Bench::with_storage(device(0x80), Box::new(memory.clone()));
    bench.poll();
    bench.node.objects().set_value(Index(0x1029), 1, 5_u8);
    bench.node.objects().set_value(Index(0x1014), 0, 0x601_u32);
    bench.write(0x1010, 1, b"save").unwrap();
    let mut bench = Bench::with_storage(device(0x80), Box::new(memory));
    assert_eq!(bench.poll()[1], frame(0x85, &[0, 0x63, 1, 2, 0x14, 0x10, 0, 0]));
    assert_eq!(bench.read(0x1014, 0), Ok([0x85, 0, 0, 0].into()));
    assert_eq!(bench.read(0x1029, 1), Ok([0].into()));
}

// U2

#[cfg(all(feature = "lss", feature = "storage"))]
#[test]
fn what_follows_the_node_id_is_stored_so() {
    let memory = Memory::default();
    let device = || {
        super::device::plain()
            .u32(0x1010, 1, RW, 1)
            .u32(0x1014, 0, COB_ID.stored_in(StorageGroup::COMMUNICATION), 0x80)
            .u32(0x1400, 1, COB_ID.stored_in(StorageGroup::COMMUNICATION), 0x200)
            .u8(0x2000, 0, COB_ID.stored_in(StorageGroup::MANUFACTURER), 0x10)
            .u16(0x2001, 0, COB_ID.stored_in(StorageGroup::MANUFACTURER), 0xFFFF)
            .build()
    };
    let mut bench = Bench::with_storage(device(), Box::new(memory.clone()));
    bench.poll();
    assert_eq!(bench.read(0x2001, 0), Ok([4, 0].into()), "it wraps round");
    bench.write(0x1400, 1, &[0x33, 2, 0, 0x80]).unwrap();
    bench.write(0x1400, 1, &[0x33, 2, 0, 0]).unwrap();
    // From 2000h on the values have the node-ID of the last reset of the node.
    bench.ask(0x7E5, &[4, 1, 0, 0, 0, 0, 0, 0]);
    bench.ask(0x7E5, &[0x11, 9, 0, 0, 0, 0, 0, 0]);
    bench.ask(0x7E5, &[0x17, 0, 0, 0, 0, 0, 0, 0]);
    for reset in [None, Some(130), Some(129)] {
        let node_id = if reset.is_none() { 5_u8 } else { 9 };
        if let Some(command) = reset {
            bench.ask(0, &[command, 0]);
        }
        let [a, b, c, d] = *b"save";
        bench.ask(0x600 + u16::from(node_id), &[0x23, 0x10, 0x10, 1, a, b, c, d]);
        let mut again = Bench::with_storage(device(), Box::new(memory.clone()));
        assert_eq!(again.poll(), [frame(0x709, &[0])]);
        let value = |bench: &mut Bench, index| {
            bench.node.objects().value::<u32>(Index(index), u8::from(index == 0x1400))
        };
        assert_eq!(value(&mut again, 0x1014), Some(0x89), "{reset:?}");
        assert_eq!(value(&mut again, 0x1400), Some(0x233), "a client has set it");
        assert_eq!((value(&mut again, 0x2000), value(&mut again, 0x2001)), (Some(0x19), Some(8)));
    }
}

#[cfg(all(feature = "lss", feature = "storage"))]
#[test]
fn what_follows_the_node_id_is_right_without_one() {
    let device = || {
        super::device::plain()
            .u32(0x1010, 1, RW, 1)
            .u32(0x1014, 0, COB_ID.stored_in(StorageGroup::COMMUNICATION), 0x80)
            .u32(0x1800, 1, COB_ID.stored_in(StorageGroup::COMMUNICATION), 0x180)
            .build()
    };
    let memory = Memory::default();
    let mut bench = Bench::with_storage(device(), Box::new(memory.clone()));
    bench.poll();
    bench.write(0x1010, 1, b"save").unwrap();
    let settings = crate::Settings { node_id: None, ..Default::default() };
    let mut bench = Bench::off(device(), settings, Box::new(memory));
    assert_eq!(bench.poll(), []);
    for request in [[4, 1], [0x11, 7], [4, 0]] {
        let [command, argument] = request;
        bench.ask(0x7E5, &[command, argument, 0, 0, 0, 0, 0, 0]);
    }
    assert_eq!(bench.node.objects().value(Index(0x1800), 1), Some(0x187_u32));
    assert_eq!(bench.node.objects().value(Index::ERROR_REGISTER, 0), Some(0_u8), "nothing is lost");
}
