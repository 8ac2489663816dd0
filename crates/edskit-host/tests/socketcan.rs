//! The adapter for interfaces of the kernel, on `vcan0`. Where there is no such interface, it says so and tests nothing.
#![cfg(all(feature = "socketcan", target_os = "linux"))]

use edskit_host::{Bus, BusError, SocketCan, open, system_now};
use edskit_runtime::{Frame, Microseconds};
use edskit_types::CanId;
use std::io::{self, Write};

fn pair() -> Option<(SocketCan, SocketCan)> {
    match (SocketCan::open("vcan0"), SocketCan::open("vcan0")) {
        (Ok(a), Ok(b)) => Some((a, b)),
        (Err(error), _) | (_, Err(error)) => {
            let _ = writeln!(io::stderr(), "left out: {error}");
            None
        }
    }
}

#[test]
fn frames_of_all_kinds_go_both_ways() {
    let Some((mut a, mut b)) = pair() else { return };
    let standard = CanId::standard(0x7FF).unwrap();
    let extended = CanId::extended(0x1ABC_DEF0).unwrap();
    for frame in [
        Frame::new(standard, &[]),
        Frame::new(standard, &[0xFF; 8]),
        Frame::new(extended, &[1, 2, 3]),
        Frame::remote(standard, 1),
        Frame::remote(extended, 8),
    ] {
        let before = system_now();
        a.send(&frame).unwrap();
        b.wait(before + Microseconds::from_milliseconds(5_000)).unwrap();
        let received = b.receive().unwrap().expect("the frame has arrived");
        assert_eq!(received.frame, frame);
        assert!(received.time >= before);
        assert_eq!(a.receive().unwrap(), None);
        assert_eq!(b.receive().unwrap(), None);
        std::mem::swap(&mut a, &mut b);
    }
}

#[test]
fn waiting_ends_at_the_deadline() {
    let Some((mut a, _)) = pair() else { return };
    for length in [Microseconds(300), Microseconds(3_500)] {
        let deadline = a.now() + length;
        a.wait(deadline).unwrap();
        assert!(a.now() >= deadline);
    }
    assert_eq!(a.receive().unwrap(), None);
}

#[test]
fn an_interface_that_is_not_there_is_named() {
    let Err(error) = open(&"socketcan:nothing7".parse().unwrap()) else {
        panic!("there is no such interface")
    };
    assert!(matches!(error, BusError::Interface { .. }));
    assert!(error.to_string().starts_with("SocketCAN interface nothing7: "), "{error}");
}
