//! Values that the device is given at start: a serial number from one-time memory.

use super::device::{RO, RW, with_values};
use super::storage::Memory;
use super::{Bench, frame};
use crate::{Application, Flags, Key, Reset, Services, Storage, StorageGroup};
use edskit_types::{Index, SubIndex};
use std::boxed::Box;
use std::cell::RefCell;
use std::rc::Rc;
use std::vec::Vec;

const SERIAL_NUMBER: Key = Key::new(0x1018, 4);
const DEVICE_NAME: Key = Key::new(0x1008, 0);
const GIVEN: Flags = RO.and(Flags::GIVEN);

/// A device with a name and a serial number, whose flags are these, that can store everything.
fn bench(flags: Flags, storage: impl Storage + 'static) -> Bench {
    let device = with_values()
        .rights(0x1008, 0, flags)
        .rights(0x1018, 4, flags)
        .u32(0x1010, 1, RW, 1)
        .u32(0x1011, 1, RW, 1)
        .build();
    Bench::with_storage(device, Box::new(storage))
}

fn give(bench: &mut Bench) {
    let mut objects = bench.node.objects();
    assert_eq!(objects.store_by_key(SERIAL_NUMBER, &4711_u32.to_le_bytes()), Ok(()));
    assert_eq!(objects.store_by_key(DEVICE_NAME, b"Pump"), Ok(()));
}

#[track_caller]
fn assert_given(bench: &mut Bench) {
    assert_eq!(bench.read(0x1018, 4), Ok(4711_u32.to_le_bytes().into()));
    assert_eq!(bench.read(0x1008, 0), Ok(b"Pump".into()));
}

#[cfg(feature = "storage")]
#[test]
fn what_is_given_outlives_everything_but_power_off() {
    for is_given_before in [true, false] {
        let mut bench = self::bench(GIVEN, Memory::default());
        if is_given_before {
            give(&mut bench);
        }
        bench.poll();
        if !is_given_before {
            give(&mut bench);
        }
        assert_given(&mut bench);
        bench.nmt(129);
        assert_given(&mut bench);
        bench.nmt(130);
        assert_given(&mut bench);
        bench.write(0x1010, 1, b"save").unwrap();
        bench.nmt(129);
        assert_given(&mut bench);
        bench.write(0x1011, 1, b"load").unwrap();
        bench.nmt(129);
        assert_given(&mut bench);
        bench.node.reset(bench.now, Reset::Node, &mut crate::NoApplication);
        bench.poll();
        assert_given(&mut bench);
        assert_eq!(bench.write(0x1018, 4, &[0; 4]), Err(0x0601_0002));
        assert_eq!(bench.write(0x1008, 0, b"x"), Err(0x0601_0002));
        assert_given(&mut bench);
    }
}

#[cfg(feature = "lss")]
#[test]
fn lss_knows_the_node_by_what_is_given() {
    let mut bench = self::bench(GIVEN, Memory::default());
    give(&mut bench);
    bench.poll();
    let mut select = |serial: u16| {
        let [low, high] = serial.to_le_bytes();
        let parts = [[0x40, 0x60, 3, 0], [0x41, 0x11, 0, 0], [0x42, 2, 0, 1], [0x43, low, high, 0]];
        parts.map(|[command, a, b, c]| bench.ask(0x7E5, &[command, a, b, c, 0, 0, 0, 0])).concat()
    };
    assert_eq!(select(0), []);
    assert_eq!(select(4711), [frame(0x7E4, &[0x44, 0, 0, 0, 0, 0, 0, 0])]);
}

/// An application that notes which stored values have no place any more.
struct Dropped(Rc<RefCell<Vec<(Index, SubIndex)>>>);

impl Application for Dropped {
    fn stored_value_dropped(&mut self, _: &mut Services<'_>, index: Index, sub_index: SubIndex) {
        self.0.borrow_mut().push((index, sub_index));
    }
}

/// An older firmware had the value among the parameters.
#[cfg(feature = "storage")]
#[test]
fn what_an_older_firmware_has_stored_does_not_come_back() {
    let memory = Memory::default();
    let mut old = self::bench(RO.stored_in(StorageGroup::COMMUNICATION), memory.clone());
    old.poll();
    old.node.objects().set_value(SERIAL_NUMBER.index, 4, 1_u32);
    old.write(0x1010, 1, b"save").unwrap();
    let dropped = Rc::default();
    let mut new = self::bench(GIVEN, memory);
    new.app = Box::new(Dropped(Rc::clone(&dropped)));
    give(&mut new);
    new.poll();
    assert_given(&mut new);
    let keys = [DEVICE_NAME, SERIAL_NUMBER].map(|key| (key.index, key.sub_index));
    assert_eq!(*dropped.borrow(), keys);
}
