//! Devices that differ from CiA 301: what their [`Application`] and [`Settings`] change.

use super::device::{COB_ID, RO, RW, plain, with_values};
use super::{Bench, NODE, frame};
use crate::{Application, Entry, Flags, Instant, Microseconds, NoStorage, Services, Settings};
use edskit_types::{AbortCode, Index, NmtState, NodeId};
use std::boxed::Box;
use std::cell::Cell;
use std::rc::Rc;

/// A device that is ready when it is told so, and gives 2005h a value meanwhile.
struct Slow(Rc<Cell<bool>>);

impl Application for Slow {
    fn is_ready(&mut self, node: &mut Services<'_>) -> bool {
        node.objects.set_value(Index(0x2005), 0, 77_u16);
        self.0.get()
    }
}

fn settings() -> Settings {
    Settings { node_id: NodeId::new(NODE).ok(), ..Settings::default() }
}

#[test]
fn the_boot_up_waits_until_the_device_is_ready() {
    let ready = Rc::new(Cell::new(false));
    let mut bench = Bench::off(with_values().build(), settings(), Box::new(NoStorage));
    bench.app = Box::new(Slow(Rc::clone(&ready)));
    assert_eq!(bench.poll(), []);
    assert_eq!(
        (bench.node.state(), bench.node.next_deadline(bench.now)),
        (NmtState::Initialising, Instant::NEVER)
    );
    for (can_id, data) in [(0x605, &[0x40, 0, 0x20, 0, 0, 0, 0, 0][..]), (0, &[1, NODE]), (0, &[129, NODE])] {
        assert_eq!(bench.ask(can_id, data), [], "a silent node takes nothing");
    }
    ready.set(true);
    assert_eq!(bench.poll(), [frame(0x705, &[0])]);
    assert_eq!((bench.node.state(), bench.read(0x2005, 0)), (NmtState::PreOperational, Ok([77, 0].into())));
    // The same again for a reset by the master.
    ready.set(false);
    bench.nmt(1);
    assert_eq!(bench.nmt(130), []);
    assert_eq!(bench.node.state(), NmtState::Initialising);
    ready.set(true);
    assert_eq!(bench.poll(), [frame(0x705, &[0])]);
}

#[test]
fn the_device_leads_the_node_to_a_state() {
    let mut bench = Bench::new(plain().build());
    for state in [NmtState::Operational, NmtState::Stopped, NmtState::PreOperational] {
        bench.node.enter(bench.now, state, &mut *bench.app);
        assert_eq!(bench.node.state(), state);
    }
    bench.node.enter(bench.now, NmtState::Initialising, &mut *bench.app);
    assert_eq!(bench.node.state(), NmtState::PreOperational);
}

/// A device with a timer of 16 ms, whose TPDO 1 waits for its own cycle.
struct Coarse;

impl Application for Coarse {
    fn heartbeat_time(&mut self, configured: Microseconds) -> Microseconds {
        Microseconds(configured.0 / 16_000 * 16_000)
    }

    fn sends_at_start(&mut self, number: u16) -> bool {
        number != 1
    }

    fn check_write(
        &mut self,
        node: &Services<'_>,
        entry: &Entry,
        length: Option<usize>,
    ) -> Result<(), AbortCode> {
        if length.is_some_and(|length| length != usize::from(entry.size)) {
            return Err(AbortCode::LENGTH_MISMATCH);
        }
        node.objects.check_write(entry, length)
    }

    fn is_present(&mut self, _: &Services<'_>, entry: &Entry) -> bool {
        entry.index == Index(0x3000) && entry.sub_index.0 == 1
    }
}

fn coarse() -> Bench {
    let optional = RO.and(Flags::OPTIONAL);
    let device = with_values()
        .u16(0x3000, 1, optional, 1)
        .u16(0x3000, 2, optional, 2)
        .u16(0x3001, 0, optional, 3)
        .pdo(0x1800, 0x180, 0xFE, &[0x2000_0010])
        .pdo(0x1801, 0x280, 0xFE, &[0x2000_0010])
        .build();
    Bench::with(device, Box::new(NoStorage), Box::new(Coarse))
}

#[test]
fn timers_can_be_coarser() {
    let mut bench = coarse();
    bench.write(0x1017, 0, &100_u16.to_le_bytes()).unwrap();
    let times: std::vec::Vec<u64> = bench.pass(300).into_iter().map(|(time, _)| time).collect();
    assert_eq!(times, [96_000, 192_000, 288_000]);
}

#[test]
fn a_tpdo_can_wait_for_its_own_event() {
    let mut bench = coarse();
    assert_eq!(bench.nmt(1), [frame(0x285, &[0x34, 0x12])]);
    bench.node.services(bench.now).trigger(1);
    assert_eq!(bench.poll(), [frame(0x185, &[0x34, 0x12])]);
}

#[test]
fn writes_can_be_checked_in_another_order() {
    let mut bench = coarse();
    assert_eq!(bench.write(0x2005, 0, &[0]), Err(AbortCode::LENGTH_MISMATCH.0));
    assert_eq!(bench.write(0x2005, 0, &[0, 0]), Err(AbortCode::READ_ONLY.0));
    let announced = bench.sdo([0x21, 5, 0x20, 0, 4, 0, 0, 0]);
    assert_eq!(announced, Err(AbortCode::LENGTH_MISMATCH.0));
}

#[test]
fn an_absent_entry_of_a_present_object_is_an_absent_sub_index() {
    let mut bench = coarse();
    assert_eq!(bench.read(0x3000, 1), Ok([1, 0].into()));
    assert_eq!(bench.read(0x3000, 2), Err(AbortCode::SUB_INDEX_DOES_NOT_EXIST.0));
    assert_eq!(bench.read(0x3001, 0), Err(AbortCode::OBJECT_DOES_NOT_EXIST.0));
}

#[test]
fn lss_and_block_transfer_can_be_left_out() {
    let without = Settings { has_lss: false, has_block_transfer: false, ..settings() };
    let device = plain().u32(0x1014, 0, COB_ID, 0x80).u16(0x2000, 0, RW, 0).build();
    let mut bench = Bench::off(device, without, Box::new(NoStorage));
    bench.poll();
    assert_eq!(bench.ask(0x7E5, &[4, 1, 0, 0, 0, 0, 0, 0]), []);
    assert_eq!(bench.ask(0x7E5, &[94, 0, 0, 0, 0, 0, 0, 0]), []);
    for request in [[0xA0, 0, 0x20, 0, 1, 0, 0, 0], [0xC2, 0, 0x20, 0, 2, 0, 0, 0]] {
        assert_eq!(bench.sdo(request), Err(AbortCode::UNKNOWN_COMMAND.0));
    }
}

/// Rules without restricted identifiers.
static NOTHING_RESTRICTED: edskit_types::IdentifierRules<'static> =
    edskit_types::IdentifierRules { restricted: &[], reserved: &[], rpdos_may_share: false };

#[test]
fn a_device_has_identifiers_that_its_manual_allows() {
    let own = Settings { identifiers: &NOTHING_RESTRICTED, ..settings() };
    for (settings, answer) in [(settings(), Err(0x0609_0030)), (own, Ok(()))] {
        let mut bench =
            Bench::off(plain().pdo(0x1800, 0x185, 255, &[]).build(), settings, Box::new(NoStorage));
        bench.poll();
        bench.write(0x1800, 1, &0x8000_0003_u32.to_le_bytes()).unwrap();
        assert_eq!(bench.write(0x1800, 1, &3_u32.to_le_bytes()), answer);
    }
}
