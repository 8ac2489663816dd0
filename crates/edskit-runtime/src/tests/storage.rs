use super::device::{RW, with_values};
use super::{Bench, frame};
use crate::{NoApplication, NoStorage, Record, Storage, StorageError, StorageGroup};
use std::boxed::Box;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;
use std::vec::Vec;

/// Memory that outlives the node.
#[derive(Clone, Default)]
pub(super) struct Memory(Rc<RefCell<Cells>>);

#[derive(Default)]
struct Cells {
    records: BTreeMap<Record, Vec<u8>>,
    begun: Vec<u8>,
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
        .u32(0x1014, 0, super::device::COB_ID, 0x80)
        .add(
            0x2020,
            0,
            edskit_types::DataType::VisibleString,
            RW.stored_in(StorageGroup::MANUFACTURER),
            "text",
        )
        .build();
    Bench::with_storage(device, Box::new(storage))
}

impl Bench {
    /// A node whose boot-up may be followed by an emergency.
    fn with_storage(device: super::Device, storage: Box<dyn Storage>) -> Self {
        let settings = crate::Settings { node_id: edskit_types::NodeId::new(5).ok(), ..Default::default() };
        let mut bench = Self::off(device, settings, storage);
        bench.app = Box::new(NoApplication);
        bench
    }
}

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
