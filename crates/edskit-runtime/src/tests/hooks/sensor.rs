//! A sensor with node-ID, bit rate and storage in objects of its own, and LSS with conditions.

use crate::tests::device::{RW, plain};
use crate::tests::storage::Memory;
use crate::tests::{Bench, NODE, frame};
use crate::{
    Application, BusState, Commissioning, EmcyError, Entry, LssAnswer, LssRequest, Microseconds, Pattern,
    Record, Reset, Services, Settings, Storage, StorageError, StorageGroup,
};
use edskit_types::{AbortCode, Bitrate, Index, NmtState, NodeId};
use std::boxed::Box;
use std::cell::RefCell;
use std::rc::Rc;
use std::vec;
use std::vec::Vec;

/// The record with node-ID and bit rate.
const BUS: u8 = 1;
const SAVE: [u8; 4] = *b"save";
const STORE_FAILED: EmcyError = EmcyError { code: 0xFF20, register: 0x80 };

/// What the sensor tells its test.
#[derive(Default)]
struct Told {
    bit_rates: Vec<(Bitrate, u16)>,
    failed: Vec<Record>,
    lss: Vec<LssRequest>,
}

/// 2101h node-ID and 2100h bit rate count from the next reset on after 2105h was written with "save".
struct Sensor(Rc<RefCell<Told>>);

impl Application for Sensor {
    fn commissioning(
        &mut self,
        node: &mut Services<'_>,
        configured: Commissioning,
        _: Reset,
    ) -> Commissioning {
        let mut kept = [0; 2];
        match node.kept(BUS, &mut kept) {
            Ok(Some(&[node_id, kilobits])) => Commissioning {
                node_id: NodeId::new(node_id).ok(),
                bit_rate: Bitrate::from_kbit_per_s(kilobits.into()),
            },
            _ => configured,
        }
    }

    fn after_write(&mut self, node: &mut Services<'_>, entry: &Entry) {
        if entry.index.0 == 0x2105 {
            let number = |index| node.objects.value::<u8>(Index(index), 0).unwrap();
            let kept = [number(0x2101), number(0x2100)];
            if node.keep(BUS, &kept).is_err() {
                node.raise(STORE_FAILED, 0, [0; 5]);
            }
            node.answer_after(Microseconds(20_000));
        }
    }

    fn activate_bit_rate(&mut self, bit_rate: Bitrate, delay: u16) {
        self.0.borrow_mut().bit_rates.push((bit_rate, delay));
    }

    /// LSS works while the node is stopped or pre-operational; node-ID 255 is refused; the device stores, and knows a
    /// table of bit rates of its own.
    fn lss(&mut self, node: &mut Services<'_>, request: LssRequest) -> LssAnswer {
        self.0.borrow_mut().lss.push(request);
        match request {
            LssRequest::Configuration if node.state() == NmtState::Operational => LssAnswer::Refused(0),
            LssRequest::NodeId(None) => LssAnswer::Refused(1),
            LssRequest::BitRate { table: 128, index: 5 } => LssAnswer::Done,
            LssRequest::Store(Commissioning { node_id: Some(node_id), .. }) => {
                match node.keep(BUS, &[node_id.get(), 125]) {
                    Ok(()) => LssAnswer::Done,
                    Err(StorageError) => LssAnswer::Refused(2),
                }
            }
            _ => LssAnswer::ByNode,
        }
    }

    fn starts_by_itself(&mut self, node: &mut Services<'_>, prescribed: bool) -> bool {
        prescribed || node.objects.value::<u8>(Index(0x2330), 0) == Some(1)
    }

    /// Sub-index 01h saves the communication parameters only, 02h is refused, and nothing else is the node's.
    fn storage_command(&mut self, node: &mut Services<'_>, entry: &Entry) -> Result<bool, AbortCode> {
        if entry.index == Index::RESTORE_PARAMETERS {
            return Ok(true);
        }
        if entry.sub_index.0 != 1 {
            return Err(AbortCode::UNSUPPORTED_ACCESS);
        }
        node.save(StorageGroup::COMMUNICATION).map_err(|StorageError| AbortCode::HARDWARE_ERROR)?;
        Ok(false)
    }

    fn storage_failed(&mut self, node: &mut Services<'_>, record: Record) {
        self.0.borrow_mut().failed.push(record);
        node.raise(STORE_FAILED, 1, [0; 5]);
    }
}

fn sensor(storage: impl Storage + 'static, starts: u8) -> (Bench, Rc<RefCell<Told>>) {
    let device = plain()
        .u32(0x1010, 1, RW, 1)
        .u32(0x1010, 2, RW, 1)
        .u32(0x1011, 1, RW, 1)
        .u32(0x1014, 0, crate::tests::device::COB_ID, 0x80)
        .u8(0x2100, 0, RW, 125)
        .u8(0x2101, 0, RW, NODE)
        .u16(0x2102, 0, RW.stored_in(StorageGroup::COMMUNICATION), 1)
        .u16(0x2103, 0, RW.stored_in(StorageGroup::MANUFACTURER), 1)
        .u32(0x2105, 0, RW, 0)
        .u8(0x2330, 0, RW, starts)
        .build();
    let told = Rc::new(RefCell::new(Told::default()));
    let settings = Settings { node_id: NodeId::new(NODE).ok(), ..Settings::DEFAULT };
    let mut bench = Bench::off(device, settings, Box::new(storage));
    bench.app = Box::new(Sensor(told.clone()));
    (bench, told)
}

fn request(bench: &mut Bench, data: &[u8]) -> Option<u8> {
    let mut request = [0; 8];
    request[..data.len()].copy_from_slice(data);
    let sent = bench.ask(0x7E5, &request);
    sent.iter().find(|frame| frame.can_id().raw() == 0x7E4).map(|frame| frame.data()[1])
}

#[test]
fn the_bus_parameters_are_objects_of_the_device() {
    let memory = Memory::default();
    let (mut bench, told) = sensor(memory.clone(), 0);
    assert_eq!(bench.poll(), [frame(0x705, &[0])]);
    bench.write(0x2101, 0, &[9]).unwrap();
    bench.write(0x2100, 0, &[50]).unwrap();
    assert_eq!(bench.nmt(130), [frame(0x705, &[0])], "nothing has been saved");
    bench.write(0x2101, 0, &[9]).unwrap();
    bench.write(0x2100, 0, &[50]).unwrap();
    // The confirmation comes when the memory has taken it, and a request meanwhile is not heard.
    let [a, b, c, d] = SAVE;
    assert_eq!(bench.ask(0x605, &[0x23, 5, 0x21, 0, a, b, c, d]), []);
    assert_eq!(bench.ask(0x605, &[0x40, 0, 0x10, 0, 0, 0, 0, 0]), []);
    assert_eq!(bench.pass(100), [(20_000, frame(0x585, &[0x60, 5, 0x21, 0, 0, 0, 0, 0]))]);
    assert!(told.borrow().bit_rates.is_empty());
    assert_eq!(bench.nmt(130), [frame(0x709, &[0])]);
    assert_eq!(told.borrow().bit_rates, [(Bitrate::Kbit50, 0)]);
    let (mut again, told) = sensor(memory, 0);
    assert_eq!(again.poll(), [frame(0x709, &[0])]);
    assert_eq!(told.borrow().bit_rates, [(Bitrate::Kbit50, 0)]);
}

#[test]
fn a_torn_record_of_the_device_is_noticed() {
    let mut memory = Memory::default();
    let (mut bench, _) = sensor(memory.clone(), 0);
    bench.poll();
    let mut node = bench.node.services(bench.now);
    assert_eq!(node.kept(7, &mut [0; 4]), Ok(None));
    node.keep(7, b"abc").unwrap();
    assert_eq!(node.kept(7, &mut [0; 4]), Ok(Some(&b"abc"[..])));
    assert_eq!(node.kept(7, &mut [0; 2]), Err(StorageError), "there is no room for it");
    node.keep(7, b"").unwrap();
    assert_eq!(node.kept(7, &mut [0; 4]), Ok(Some(&[][..])));
    node.keep(7, b"abc").unwrap();
    memory.flip(Record::Device(7), 3);
    assert_eq!(node.kept(7, &mut [0; 4]), Err(StorageError));
    memory.erase(Record::Device(7)).unwrap();
    assert_eq!(node.kept(7, &mut [0; 4]), Ok(None));
}

#[cfg(feature = "lss")]
#[test]
fn lss_has_conditions() {
    let (mut bench, told) = sensor(Memory::default(), 0);
    bench.poll();
    bench.nmt(1);
    request(&mut bench, &[4, 1]);
    assert_eq!(request(&mut bench, &[0x5E]), None, "operational: it is not in configuration");
    bench.nmt(2);
    request(&mut bench, &[4, 1]);
    assert_eq!(request(&mut bench, &[0x5E]), Some(NODE));
    assert_eq!(request(&mut bench, &[0x11, 255]), Some(1));
    assert_eq!(request(&mut bench, &[0x11, 0]), Some(1), "the device is not asked for what cannot be");
    assert_eq!(request(&mut bench, &[0x13, 128, 5]), Some(0), "a table of its own");
    assert_eq!(request(&mut bench, &[0x13, 128, 6]), Some(1));
    assert_eq!(request(&mut bench, &[0x11, 12]), Some(0));
    assert_eq!(request(&mut bench, &[0x17]), Some(0));
    let stored = Commissioning { node_id: NodeId::new(12).ok(), bit_rate: None };
    assert_eq!(told.borrow().lss.last(), Some(&LssRequest::Store(stored)));
    request(&mut bench, &[4, 0]);
    assert_eq!(bench.nmt(129), [frame(0x70C, &[0])]);
}

#[test]
fn it_starts_by_itself_where_its_object_says_so() {
    for (starts, state) in [(0, NmtState::PreOperational), (1, NmtState::Operational)] {
        let (mut bench, _) = sensor(Memory::default(), starts);
        bench.poll();
        assert_eq!(bench.node.state(), state);
    }
}

#[cfg(feature = "storage")]
#[test]
fn storing_is_the_devices_own() {
    let memory = Memory::default();
    let (mut bench, _) = sensor(memory.clone(), 0);
    bench.poll();
    bench.write(0x2102, 0, &[7, 0]).unwrap();
    bench.write(0x2103, 0, &[7, 0]).unwrap();
    bench.write(0x1010, 1, &SAVE).unwrap();
    assert_eq!(bench.write(0x1010, 2, &SAVE), Err(AbortCode::UNSUPPORTED_ACCESS.0));
    assert_eq!(bench.write(0x1010, 1, b"SAVE"), Err(AbortCode::CANNOT_TRANSFER.0));
    let (mut again, _) = sensor(memory, 0);
    again.poll();
    assert_eq!([again.read(0x2102, 0), again.read(0x2103, 0)], [Ok(vec![7, 0]), Ok(vec![1, 0])]);
    again.write(0x1011, 1, b"load").unwrap();
    again.nmt(129);
    assert_eq!(again.read(0x2102, 0), Ok(vec![1, 0]));
}

#[cfg(feature = "storage")]
#[test]
fn failures_of_the_memory_are_told() {
    let (mut bench, told) = sensor(crate::NoStorage, 0);
    bench.poll();
    assert_eq!(bench.write(0x1010, 1, &SAVE), Err(AbortCode::HARDWARE_ERROR.0));
    let torn = Memory::default();
    let (mut bench, _) = sensor(torn.clone(), 0);
    bench.poll();
    bench.write(0x1010, 1, &SAVE).unwrap();
    torn.flip(Record::Values(StorageGroup::COMMUNICATION), 14);
    let (mut again, told_again) = sensor(torn, 0);
    let sent = again.poll();
    assert_eq!(told_again.borrow().failed.last(), Some(&Record::Values(StorageGroup::COMMUNICATION)));
    assert!(sent.contains(&frame(0x85, &[0x20, 0xFF, 0x81, 0, 0, 0, 0, 0])), "{sent:?}");
    assert!(told.borrow().failed.is_empty(), "the device has stored itself");
}

#[test]
fn the_bus_is_seen_by_the_node() {
    let (mut bench, _) = sensor(Memory::default(), 1);
    bench.poll();
    let at = |bench: &mut Bench, state| {
        bench.node.bus_state(bench.now, state, &mut *bench.app);
        let codes = bench.sent().iter().map(|frame| frame.data()[..2].to_vec()).collect::<Vec<_>>();
        (codes, bench.node.leds().error, bench.node.state())
    };
    let operational = NmtState::Operational;
    assert_eq!(at(&mut bench, BusState::Warning), (vec![], Pattern::SingleFlash, operational));
    let passive = at(&mut bench, BusState::Passive);
    assert_eq!(passive, (vec![vec![0x20, 0x81]], Pattern::SingleFlash, operational));
    // 1029h is missing, so the default counts.
    let off = at(&mut bench, BusState::Off);
    assert_eq!(off, (vec![vec![0, 0]], Pattern::On, NmtState::PreOperational));
    assert_eq!(at(&mut bench, BusState::Off).0, Vec::<Vec<u8>>::new());
    let back = at(&mut bench, BusState::Active);
    assert_eq!(back.0, [[0x40, 0x81], [0, 0]]);
    assert_eq!(back.1, Pattern::Off);
}
