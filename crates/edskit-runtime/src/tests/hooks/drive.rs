//! A drive whose parameters stand behind sub-indices that are sets, with PDOs, errors and abilities of its own.

use crate::tests::device::{RW, with_values};
use crate::tests::{Bench, NODE, frame};
use crate::{
    Application, BusState, EmcyError, Emergency, Entry, Flags, NoStorage, NotSent, PdoPolicy, Remapping,
    Services, Settings,
};
use edskit_types::{
    AbortCode, CanId, DataType, Index, NmtState, NodeId, PdoDirection, SubIndex, Transmission,
    TransmissionType,
};
use std::boxed::Box;
use std::vec;
use std::vec::Vec;

const TPDO: u16 = 0x1800;
const RPDO: u16 = 0x1400;
/// The abort code of the manual for sets that hold different values.
const SETS_DIFFER: AbortCode = AbortCode(0x0800_0099);
const FAULT: EmcyError = EmcyError { code: 0x2310, register: 2 };

/// Parameters from 2300h on, in eight sets: each bit of the sub-index names one.
#[derive(Default)]
struct Drive {
    parameters: [[u16; 8]; 16],
}

impl Drive {
    fn sets(&mut self, entry: &Entry) -> impl Iterator<Item = &mut u16> {
        let bits = entry.sub_index.0;
        let parameter = &mut self.parameters[usize::from(entry.index.0 - 0x2300)];
        parameter.iter_mut().enumerate().filter(move |(set, _)| bits >> set & 1 == 1).map(|(_, value)| value)
    }
}

impl Application for Drive {
    fn find(
        &mut self,
        _: &mut Services<'_>,
        index: Index,
        sub_index: SubIndex,
        absence: AbortCode,
    ) -> Result<Entry, AbortCode> {
        let flags = Flags::READ.and(Flags::WRITE).and(Flags::RPDO).and(Flags::TPDO);
        match (index.0, sub_index.0) {
            (0x2300..=0x230F, 0) => Err(AbortCode::SUB_INDEX_DOES_NOT_EXIST),
            (0x2300..=0x230F, _) => Ok(Entry::of_device(index, sub_index, DataType::Unsigned16, flags, 2)),
            // One that takes longer than four bytes.
            (0x2400, 0) => Ok(Entry::of_device(index, sub_index, DataType::VisibleString, flags, 8)),
            _ => Err(absence),
        }
    }

    fn read_value(
        &mut self,
        _: &mut Services<'_>,
        entry: &Entry,
        buffer: &mut [u8],
    ) -> Result<usize, AbortCode> {
        if entry.index.0 == 0x2400 {
            buffer[..8].copy_from_slice(b"operator");
            return Ok(8);
        }
        let mut values = self.sets(entry).map(|value| *value);
        let first = values.next().unwrap();
        if values.any(|value| value != first) {
            return Err(SETS_DIFFER);
        }
        buffer[..2].copy_from_slice(&first.to_le_bytes());
        Ok(2)
    }

    fn write_value(&mut self, _: &mut Services<'_>, entry: &Entry, data: &[u8]) -> Result<(), AbortCode> {
        let value = u16::from_le_bytes(data.try_into().unwrap());
        if value == 0xFFFF {
            return Err(AbortCode::VALUE_TOO_HIGH);
        }
        self.sets(entry).for_each(|set| *set = value);
        Ok(())
    }

    /// Of a COB-ID only bit 31 counts.
    fn adapt(&mut self, node: &Services<'_>, entry: &Entry, data: &mut [u8]) {
        if let (0x1400 | 0x1800, 1, [low @ .., high]) = (entry.index.0, entry.sub_index.0, data) {
            let present: u32 = node.objects.value(entry.index, 1).unwrap();
            let [present @ .., top] = present.to_le_bytes();
            low.copy_from_slice(&present);
            *high = *high & 0x80 | top & 0x7F;
        }
    }

    /// Type 0 is sent with every SYNC message, 252 is 253.
    fn transmission(&mut self, direction: PdoDirection, transmission: TransmissionType) -> Transmission {
        match (direction, transmission.0) {
            (PdoDirection::Transmit, 0) => Transmission::SynchronousCyclic(1),
            (PdoDirection::Transmit, 252) => Transmission::RtrEvent,
            _ => transmission.meaning(direction),
        }
    }

    /// The history is read as zeros beyond its end.
    fn check_read(&mut self, node: &Services<'_>, entry: &Entry) -> Result<(), AbortCode> {
        node.objects.check_read(entry)
    }

    fn before_read(&mut self, node: &mut Services<'_>, entry: &Entry) -> Result<(), AbortCode> {
        let count: u8 = node.objects.value(Index::PREDEFINED_ERROR_FIELD, 0).unwrap();
        if entry.index == Index::PREDEFINED_ERROR_FIELD && entry.sub_index.0 > count {
            node.objects.set_value(entry.index, entry.sub_index.0, 0_u32);
        }
        Ok(())
    }

    /// 5FE5h puts PDO 1 where it was delivered; 5FE6h tells a fault, 5FE7h that another one has followed it.
    fn after_write(&mut self, node: &mut Services<'_>, entry: &Entry) {
        match entry.index.0 {
            0x5FE5 => {
                node.objects.set_value(Index(TPDO), 1, 0x4000_01A5_u32);
                node.objects.set_value(Index(TPDO + 0x200), 0, 1_u8);
                node.objects.set_value(Index(TPDO + 0x200), 1, 0x2000_0010_u32);
                for index in [TPDO, TPDO + 0x200] {
                    node.update(node.objects.table().find(Index(index), SubIndex(0)).unwrap());
                }
            }
            0x5FE6 => node.send_emergency(Emergency { code: 0x2310, register: 3, info: [9; 5] }),
            0x5FE7 => {
                node.raise(FAULT, 1, [1, 2, 0, 0, 0]);
                node.react(2);
            }
            _ => {}
        }
    }

    /// Error register and messages follow the drive alone.
    fn counts(&mut self, error: EmcyError) -> bool {
        error == EmcyError::PDO_LENGTH
    }

    fn emergency(&mut self, _: &mut Services<'_>, emergency: &mut Emergency) {
        emergency.info[4] = 0xEE;
    }

    /// A lost bus stops the drive whatever 1029h says; a lost master does nothing.
    fn reaction(&mut self, _: &mut Services<'_>, error: EmcyError, _: Option<NmtState>) -> Option<NmtState> {
        (error == EmcyError::BUS_OFF).then_some(NmtState::Stopped)
    }
}

fn bench() -> Bench {
    let device = with_values()
        .u8(0x1003, 0, RW, 0)
        .u32(0x1003, 1, RW, 0)
        .u16(0x100C, 0, RW, 100)
        .u8(0x100D, 0, RW, 2)
        .u8(0x1029, 0, RW, 2)
        .u8(0x1029, 1, RW, 0)
        .u8(0x1029, 2, RW, 2)
        .u8(0x5FE5, 0, RW, 0)
        .u8(0x5FE6, 0, RW, 0)
        .u8(0x5FE7, 0, RW, 0)
        .pdo(TPDO, 0x180, 0, &[0x2300_0110, 0x2000_0010])
        .pdo(RPDO, 0x200, 255, &[0x2301_0310])
        .build();
    let settings = Settings {
        node_id: NodeId::new(NODE).ok(),
        sync: CanId::standard(0x80),
        sends_emergencies: true,
        has_segmented_transfer: false,
        pdos: PdoPolicy {
            remapping: Remapping::Invalidates,
            times_change_live: true,
            answers_requests: true,
        },
        ..Settings::DEFAULT
    };
    let mut bench = Bench::off(device, settings, Box::new(NoStorage));
    bench.app = Box::new(Drive::default());
    assert_eq!(bench.poll(), [frame(0x705, &[0])]);
    bench
}

fn sync(bench: &mut Bench) -> Vec<Vec<u8>> {
    bench.ask(0x80, &[]).iter().map(|frame| frame.data().to_vec()).collect()
}

#[test]
fn a_sub_index_is_a_set_of_bits() {
    let mut bench = bench();
    bench.write(0x2304, 0xFF, &[7, 0]).unwrap();
    bench.write(0x2304, 0x10, &[9, 0]).unwrap();
    assert_eq!(bench.read(0x2304, 0x0F), Ok(vec![7, 0]));
    assert_eq!(bench.read(0x2304, 0x10), Ok(vec![9, 0]));
    assert_eq!(bench.read(0x2304, 0x11), Err(SETS_DIFFER.0));
    assert_eq!(bench.write(0x2304, 1, &[0xFF, 0xFF]), Err(AbortCode::VALUE_TOO_HIGH.0));
    assert_eq!(bench.write(0x2304, 1, &[7]), Err(AbortCode::LENGTH_TOO_LOW.0));
    assert_eq!(bench.write(0x2304, 1, &[7, 0, 0]), Err(AbortCode::LENGTH_TOO_HIGH.0));
    assert_eq!(bench.read(0x2304, 0), Err(AbortCode::SUB_INDEX_DOES_NOT_EXIST.0));
    assert_eq!(bench.read(0x2310, 1), Err(AbortCode::OBJECT_DOES_NOT_EXIST.0));
}

#[cfg(feature = "sync")]
#[test]
fn values_of_the_device_are_mapped() {
    let mut bench = bench();
    bench.write(0x2300, 1, &[0xAB, 0xCD]).unwrap();
    bench.nmt(1);
    assert_eq!(sync(&mut bench), [[0xAB, 0xCD, 0x34, 0x12]]);
    bench.ask(0x205, &[5, 6]);
    assert_eq!([bench.read(0x2301, 1), bench.read(0x2301, 2)], [Ok(vec![5, 6]), Ok(vec![5, 6])]);
    assert_eq!(bench.read(0x2301, 4), Ok(vec![0, 0]));
    bench.ask(0x205, &[0xFF, 0xFF]);
    assert_eq!(bench.node.refused_rpdo_values(), 1);
    assert_eq!(bench.read(0x2301, 1), Ok(vec![5, 6]));
    // A value that cannot be read at the moment is sent as 0.
    bench.write(TPDO + 0x200, 1, &[0x10, 3, 0, 0x23]).unwrap();
    bench.write(TPDO, 1, &[0; 4]).unwrap();
    assert_eq!(sync(&mut bench), [[0, 0, 0x34, 0x12]]);
}

#[test]
fn there_are_expedited_transfers_only() {
    let mut bench = bench();
    assert_eq!(bench.read(0x2400, 0), Err(AbortCode::UNKNOWN_COMMAND.0));
    assert_eq!(bench.write(0x2400, 0, b"operator"), Err(AbortCode::UNKNOWN_COMMAND.0));
    assert_eq!(bench.sdo([0x61, 0, 0, 0, 0, 0, 0, 0]), Err(AbortCode::UNKNOWN_COMMAND.0));
}

#[cfg(feature = "sync")]
#[test]
fn a_pdo_is_remapped_while_it_is_valid() {
    let mut bench = bench();
    bench.nmt(1);
    assert_eq!(sync(&mut bench).len(), 1);
    // An entry that cannot be carried is taken, and switches the PDO off.
    bench.write(TPDO + 0x200, 2, &[0x10, 0, 0, 0x70]).unwrap();
    assert_eq!(bench.read(TPDO, 1), Ok(vec![0x85, 1, 0, 0x80]));
    assert_eq!(bench.node.why_not_sent(bench.now, 1), NotSent::Disabled);
    assert_eq!(sync(&mut bench).len(), 0);
    // It is found when the PDO is made valid.
    assert_eq!(bench.write(TPDO, 1, &[0; 4]), Err(AbortCode::OBJECT_DOES_NOT_EXIST.0));
    bench.write(TPDO + 0x200, 2, &[0x40, 0, 0x0A, 0x20]).unwrap();
    assert_eq!(bench.write(TPDO, 1, &[0; 4]), Err(AbortCode::PDO_LENGTH_EXCEEDED.0));
    bench.write(TPDO + 0x200, 2, &[0x10, 2, 0, 0x23]).unwrap();
    // Of the COB-ID only bit 31 counts.
    bench.write(TPDO, 1, &[0xFF, 0xFF, 0xFF, 0x7F]).unwrap();
    assert_eq!(bench.read(TPDO, 1), Ok(vec![0x85, 1, 0, 0]));
    assert_eq!(sync(&mut bench), [[0, 0, 0, 0]]);
    assert_eq!(bench.write(TPDO + 0x200, 0, &[9]), Err(AbortCode::PDO_LENGTH_EXCEEDED.0));
    bench.write(TPDO, 3, &[10, 0]).unwrap();
}

#[cfg(feature = "sync")]
#[test]
fn the_device_changes_its_pdos_itself() {
    let mut bench = bench();
    bench.nmt(1);
    bench.write(0x5FE5, 0, &[1]).unwrap();
    let sent = bench.ask(0x80, &[]);
    assert_eq!(sent, [frame(0x1A5, &[0x34, 0x12])]);
}

#[cfg(all(feature = "rtr", feature = "sync"))]
#[test]
fn transmission_types_mean_what_the_manual_says() {
    let mut bench = bench();
    bench.nmt(1);
    assert_eq!([sync(&mut bench).len(), sync(&mut bench).len()], [1, 1], "type 0 needs no event");
    bench.write(TPDO, 2, &[252]).unwrap();
    let request = crate::Frame::remote(CanId::standard(0x185).unwrap(), 4);
    assert_eq!(bench.receive(request).len(), 1, "no SYNC message has to come before");
}

#[test]
fn errors_are_those_of_the_drive() {
    let mut bench = bench();
    let request = crate::Frame::remote(CanId::standard(0x705).unwrap(), 1);
    bench.nmt(1);
    bench.receive(request);
    let sent: Vec<_> = bench.pass(1000).into_iter().map(|(_, frame)| frame).collect();
    assert_eq!(sent, [], "a lost master is no error, and changes no state");
    assert_eq!(bench.node.state(), NmtState::Operational);
    // An error that counts gets what the device adds.
    assert_eq!(bench.ask(0x205, &[1]), [frame(0x85, &[0x10, 0x82, 0x11, 1, 0, 1, 0, 0xEE])]);
    // A message of its own changes neither register nor history.
    bench.write(0x1003, 0, &[0]).unwrap();
    let sent = bench.ask(0x605, &[0x2F, 0xE6, 0x5F, 0, 1, 0, 0, 0]);
    assert!(sent.contains(&frame(0x85, &[0x10, 0x23, 3, 9, 9, 9, 9, 9])), "{sent:?}");
    assert_eq!(bench.read(0x1003, 1), Ok(vec![0; 4]));
    assert_eq!(bench.read(0x1003, 0), Ok(vec![0]));
    // One that it raises is in both, and 1029h:02 says what follows.
    let sent = bench.ask(0x605, &[0x2F, 0xE7, 0x5F, 0, 1, 0, 0, 0]);
    assert!(sent.contains(&frame(0x85, &[0x10, 0x23, 0x13, 1, 2, 0, 0, 0])), "{sent:?}");
    assert_eq!(bench.node.state(), NmtState::Stopped);
    bench.nmt(1);
    assert_eq!(bench.read(0x1003, 1), Ok(vec![0x10, 0x23, 1, 2]));
}

#[test]
fn a_bus_that_is_off_is_a_reason_to_stop() {
    let mut bench = bench();
    bench.nmt(1);
    bench.node.bus_state(bench.now, BusState::Off, &mut *bench.app);
    assert_eq!((bench.node.state(), bench.node.leds().error), (NmtState::Stopped, crate::Pattern::On));
}

#[test]
fn the_cob_id_follows_the_node_id_where_there_is_no_object() {
    let table_has =
        |bench: &mut Bench, index| bench.node.objects().table().find(Index(index), SubIndex(0)).is_ok();
    let mut bench = bench();
    assert_eq!([table_has(&mut bench, 0x1014), table_has(&mut bench, 0x1005)], [false; 2]);
    bench.node.services(bench.now).raise(FAULT, 0, [0; 5]);
    assert_eq!(bench.poll(), [frame(0x85, &[0x10, 0x23, 3, 0, 0, 0, 0, 0])]);
}
