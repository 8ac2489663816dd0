use super::device::{Builder, COB_ID, RW, plain};
use super::{Bench, frame};
use crate::{Application, Services, TimeOfDay};
use std::boxed::Box;
use std::cell::Cell;
use std::rc::Rc;
use std::vec::Vec;

fn device() -> Builder {
    plain()
        .u32(0x1005, 0, RW, 0x80)
        .u32(0x1006, 0, RW, 0)
        .u32(0x1012, 0, RW, 0x100)
        .u32(0x1014, 0, COB_ID, 0x80)
        .u8(0x1019, 0, RW, 0)
}

fn produce(bench: &mut Bench, overflow: u8) {
    bench.write(0x1019, 0, &[overflow]).unwrap();
    bench.write(0x1006, 0, &100_000_u32.to_le_bytes()).unwrap();
    bench.write(0x1005, 0, &[0x80, 0, 0, 0x40]).unwrap();
}

#[cfg(feature = "sync")]
#[test]
fn the_producer_keeps_its_period_and_counts() {
    let mut bench = Bench::new(device().build());
    produce(&mut bench, 3);
    let sent = bench.pass(450);
    let expected: Vec<_> =
        [1, 2, 3, 1].iter().zip(1..).map(|(count, time)| (time * 100_000, frame(0x80, &[*count]))).collect();
    assert_eq!(sent, expected);
    bench.nmt(2);
    assert!(bench.pass(500).is_empty(), "not in stopped");
    bench.nmt(128);
    assert_eq!(bench.pass(200).first().map(|(_, frame)| frame.data().to_vec()), Some([1].into()));
}

#[cfg(feature = "sync")]
#[test]
fn without_an_overflow_value_there_is_no_counter() {
    let mut bench = Bench::new(device().build());
    produce(&mut bench, 0);
    assert_eq!(bench.pass(150), [(100_000, frame(0x80, &[]))]);
}

#[cfg(feature = "sync")]
#[test]
fn what_may_be_written_when() {
    let mut bench = Bench::new(device().build());
    for value in [1, 241] {
        assert_eq!(bench.write(0x1019, 0, &[value]), Err(0x0609_0030));
    }
    produce(&mut bench, 0);
    assert_eq!(bench.write(0x1019, 0, &[5]), Err(0x0800_0022));
    assert_eq!(bench.write(0x1005, 0, &[0x81, 0, 0, 0x40]), Err(0x0609_0030));
    assert_eq!(bench.write(0x1005, 0, &[0x80, 0, 0, 0]), Ok(()));
    assert_eq!(bench.write(0x1005, 0, &[0xA5, 0, 0, 0]), Ok(()));
    assert_eq!(bench.write(0x1005, 0, &[0, 0, 0, 0]), Err(0x0609_0030));
}

#[cfg(feature = "sync")]
#[test]
fn a_wrong_length_is_an_error() {
    let mut bench = Bench::new(device().build());
    assert_eq!(bench.ask(0x80, &[1]), [frame(0x85, &[0x40, 0x82, 0x11, 1, 0, 0, 0, 0])]);
    assert_eq!(bench.ask(0x80, &[]), [frame(0x85, &[0; 8])]);
}

/// Notes the time that it is told.
struct Clock(Rc<Cell<Option<TimeOfDay>>>);

impl Application for Clock {
    fn time_received(&mut self, _: &mut Services<'_>, time: TimeOfDay) {
        self.0.set(Some(time));
    }
}

#[cfg(feature = "time")]
#[test]
fn time_of_day() {
    let noted = Rc::new(Cell::new(None));
    let storage = Box::new(crate::NoStorage);
    let mut bench = Bench::with(device().build(), storage, Box::new(Clock(noted.clone())));
    let noon = [0x00, 0x2E, 0x93, 0xF2, 0x98, 0x3A];
    bench.ask(0x100, &noon);
    assert_eq!(noted.get(), None, "bit 31 says whether the message is taken");
    bench.write(0x1012, 0, &[0, 1, 0, 0x80]).unwrap();
    for short in [&[][..], &[1, 2, 3]] {
        bench.ask(0x100, short);
    }
    assert_eq!(noted.get(), None);
    bench.ask(0x100, &noon);
    assert_eq!(noted.get(), Some(TimeOfDay { milliseconds: 43_200_000, days: 15_000 }));
    assert_eq!(bench.write(0x1012, 0, &[0, 1, 0, 0x40]), Err(0x0609_0030), "the node produces no time");
}
