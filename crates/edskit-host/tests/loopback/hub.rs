//! The hub over loopback, with tools that speak by hand.

use crate::tool::{Tool, frame, hub, next, until};
use edskit_host::{Bus, BusError, Event, Hub, HubOptions};
use edskit_runtime::Frame;
use edskit_types::CanId;
use std::io::Read;
use std::net::TcpStream;
use std::thread;
use std::time::{Duration, Instant};

/// `< frame 60A 1700000000.123456 112233 >` without the time.
fn without_time(text: &str) -> String {
    let words: Vec<&str> = text.split(' ').collect();
    let (seconds, rest) = words[3].split_once('.').expect("a time has a point");
    assert!(seconds.len() >= 10 && rest.len() == 6, "{text}");
    [&words[..3], &words[4..]].concat().join(" ")
}

#[test]
fn every_frame_reaches_all_but_its_sender() {
    let hub = hub();
    let mut device = hub.attach();
    let mut first = Tool::socketcand(hub.socketcand_address());
    let mut second = Tool::socketcand(hub.socketcand_address());
    let mut third = Tool::slcan(hub.slcan_address());

    first.say("< send 60A 2 1 ff >");
    assert_eq!(next(&mut device), frame(0x60A, &[1, 0xFF]));
    assert_eq!(without_time(&second.hear(">")), "< frame 60A 01FF >");
    assert_eq!(third.hear("\r"), "t60A201FF\r");

    third.say("T0000060A0\r");
    assert_eq!(third.hear("\r"), "Z\r");
    assert_eq!(next(&mut device), Frame::new(CanId::extended(0x60A).unwrap(), &[]));
    assert_eq!(without_time(&first.hear(">")), "< frame 0000060A  >");
    assert_eq!(without_time(&second.hear(">")), "< frame 0000060A  >");

    device.send(&frame(0x58A, &[7])).unwrap();
    assert_eq!(without_time(&first.hear(">")), "< frame 58A 07 >");
    assert_eq!(without_time(&second.hear(">")), "< frame 58A 07 >");
    assert_eq!(third.hear("\r"), "t58A107\r");
    assert_eq!(device.receive().unwrap(), None);
    assert_eq!(hub.clients(), 3);
}

#[test]
fn frames_do_not_follow_the_handshake_in_the_same_segment() {
    let hub = hub();
    let mut device = hub.attach();
    let mut tool = Tool::new(hub.socketcand_address());
    assert_eq!(tool.read_once(), "< hi >");
    tool.say("< open can0 >");
    assert_eq!(tool.read_once(), "< ok >");
    // The device sends all the time.
    let sender = thread::spawn(move || {
        for _ in 0..2_000 {
            device.send(&frame(0x705, &[5])).unwrap();
            thread::sleep(Duration::from_micros(20));
        }
    });
    let start = Instant::now();
    tool.say("< rawmode >");
    assert_eq!(tool.hear(">"), "< ok >");
    assert!(tool.hear(">").starts_with("< frame 705 "));
    assert!(start.elapsed() >= Duration::from_millis(20), "{:?}", start.elapsed());
    sender.join().unwrap();
}

#[test]
fn remote_frames_go_over_slcan_but_not_over_socketcand() {
    let hub = hub();
    let mut device = hub.attach();
    let mut plain = Tool::socketcand(hub.socketcand_address());
    let mut tool = Tool::slcan(hub.slcan_address());
    let guard = Frame::remote(CanId::standard(0x705).unwrap(), 1);
    tool.say("r7051\r");
    assert_eq!(tool.hear("\r"), "z\r");
    assert_eq!(next(&mut device), guard);
    device.send(&guard).unwrap();
    device.send(&frame(0x705, &[0x85])).unwrap();
    assert_eq!(tool.hear("\r"), "r7051\r");
    assert_eq!(without_time(&plain.hear(">")), "< frame 705 85 >");
}

#[test]
fn nonsense_is_survived_and_never_answered_with_an_error() {
    let hub = hub();
    let mut device = hub.attach();
    let mut tool = Tool::socketcand(hub.socketcand_address());
    tool.say("\u{0} > < bogus > < send 1 9 1 > < send 1 < send zz 1 1 > < error 004 1.5 > < echo >");
    assert_eq!(tool.read_once(), "< echo >");
    tool.say("< send 7");
    tool.say("FF 1 ");
    tool.say("9 >");
    assert_eq!(next(&mut device), frame(0x7FF, &[9]));
}

#[test]
fn a_closed_slcan_channel_hears_nothing() {
    let hub = hub();
    let mut device = hub.attach();
    let mut tool = Tool::slcan(hub.slcan_address());
    tool.say("C\r");
    assert_eq!(tool.hear("\r"), "\r");
    device.send(&frame(1, &[])).unwrap();
    tool.say("V\r");
    assert_eq!(tool.hear("\r"), "V1013\r");
    tool.say("t0010\r");
    assert_eq!(tool.hear("\x07"), "\x07");
}

#[test]
fn who_does_not_read_loses_frames_and_stops_nobody() {
    let hub = hub();
    let (mut device, mut other) = (hub.attach(), hub.attach());
    let mut lazy = Tool::slcan(hub.slcan_address());
    let mut count = 0_u64;
    while hub.frames_lost() == 0 {
        device.send(&frame(0x181, &count.to_le_bytes())).unwrap();
        assert_eq!(next(&mut other), frame(0x181, &count.to_le_bytes()));
        count += 1;
        assert!(count < 10_000_000, "somewhere frames are kept without end");
    }
    // The oldest went, so what comes at the end is the newest.
    device.send(&frame(0x701, &[5])).unwrap();
    assert!(lazy.hear("t701105\r").len() > 100_000);
}

#[test]
fn a_participant_that_does_not_take_its_frames_hears_how_many_went() {
    let hub = hub();
    let (mut device, mut lazy) = (hub.attach(), hub.attach());
    for number in 0..40_000_u32 {
        device.send(&frame(0x181, &number.to_le_bytes())).unwrap();
    }
    assert_eq!(next(&mut lazy), frame(0x181, &7_232_u32.to_le_bytes()));
    assert_eq!(lazy.event(), Some(Event::FramesLost(7_232)));
    assert_eq!(lazy.event(), None);
    assert_eq!(hub.frames_lost(), 7_232);
}

#[test]
fn a_burst_arrives_whole_and_in_order() {
    let hub = hub();
    let mut device = hub.attach();
    let mut tool = Tool::socketcand(hub.socketcand_address());
    let sender = thread::spawn(move || {
        for number in 0..20_000_u32 {
            let [a, b, c, d] = number.to_le_bytes();
            tool.say(&format!("< send 181 4 {a:x} {b:x} {c:x} {d:x} >"));
        }
        tool
    });
    for number in 0..20_000_u32 {
        assert_eq!(next(&mut device), frame(0x181, &number.to_le_bytes()));
    }
    sender.join().unwrap();
}

#[test]
fn who_is_one_too_many_is_closed_at_once() {
    let hub = hub();
    let mut tools: Vec<Tool> = (0..64).map(|_| Tool::slcan(hub.slcan_address())).collect();
    let mut late = TcpStream::connect(hub.socketcand_address().unwrap()).unwrap();
    assert_eq!(late.read(&mut [0; 9]).unwrap_or(0), 0);
    tools.pop();
    until("a client leaves", || hub.clients() == 63);
    Tool::socketcand(hub.socketcand_address());
}

#[test]
fn a_client_that_leaves_is_off_the_bus() {
    let hub = hub();
    let tool = Tool::slcan(hub.slcan_address());
    assert_eq!(hub.clients(), 1);
    drop(tool);
    until("the client is gone", || hub.clients() == 0);
}

#[test]
fn dropping_the_hub_closes_connections_and_frees_the_ports() {
    let hub = hub();
    let options = HubOptions { socketcand: hub.socketcand_address(), slcan: hub.slcan_address() };
    let mut device = hub.attach();
    let tool = Tool::socketcand(hub.socketcand_address());
    let lazy = Tool::slcan(hub.slcan_address());
    for _ in 0..60_000 {
        device.send(&frame(0x181, &[0; 8])).unwrap();
    }
    drop(hub);
    tool.hear_the_end();
    lazy.hear_the_end();
    assert!(TcpStream::connect(options.socketcand.unwrap()).is_err());
    let again = Hub::start(&options).unwrap();
    assert_eq!(again.slcan_address(), options.slcan);
    // The handle has outlived its hub.
    device.send(&frame(1, &[])).unwrap();
    device.wait(edskit_runtime::Instant(0)).unwrap();
    assert_eq!(device.receive().unwrap(), None);
}

#[test]
fn a_port_that_is_taken_is_named() {
    let hub = hub();
    let options = HubOptions { socketcand: None, slcan: hub.slcan_address() };
    let Err(error) = Hub::start(&options) else { panic!("two hubs on one port") };
    assert!(matches!(error, BusError::Listen { protocol: "SLCAN", .. }));
    let text = error.to_string();
    assert!(
        text.starts_with("cannot listen on 127.0.0.1:")
            && text.contains("perhaps a hub or a device runs there"),
        "{text}"
    );
}

#[test]
fn only_loopback_unless_told_otherwise() {
    let options = HubOptions::default();
    let addresses = [options.socketcand.unwrap(), options.slcan.unwrap()];
    assert!(addresses.iter().all(|address| address.ip().is_loopback()));
    assert_eq!(addresses.map(|address| address.port()), [29536, 29537]);
}
