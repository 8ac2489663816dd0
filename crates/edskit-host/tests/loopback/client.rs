//! Clients against the hub, and against others that answer wrongly or not at all.

use crate::tool::{frame, hub, next, patience, until};
use edskit_host::{Bus, BusError, Client, Event, Hub, HubOptions, SendError, open};
use edskit_runtime::Frame;
use edskit_types::CanId;
use std::io::{Read, Write};
use std::net::TcpListener;
use std::thread;
use std::time::Duration;

fn clients(hub: &Hub) -> (Client, Client) {
    let socketcand = hub.socketcand_address().expect("the hub listens").port();
    let slcan = hub.slcan_address().expect("the hub listens").port();
    (
        Client::socketcand("127.0.0.1", socketcand, "can0").expect("the hub speaks socketcand"),
        Client::slcan("localhost", slcan).expect("the hub speaks SLCAN"),
    )
}

/// Somebody who says something to the first who comes, and what that one said.
fn stranger(words: &'static [u8]) -> u16 {
    let listener = TcpListener::bind("127.0.0.1:0").expect("there are free ports");
    let port = listener.local_addr().expect("it is bound").port();
    thread::spawn(move || {
        let (mut stream, _) = listener.accept().expect("the client comes");
        stream.write_all(words).expect("the client is there");
        // Until the client hangs up.
        let _ = stream.read_to_end(&mut Vec::new());
    });
    port
}

fn mistake(result: Result<Client, BusError>) -> String {
    match result {
        Ok(_) => panic!("that should not have worked"),
        Err(error) => error.to_string(),
    }
}

#[test]
fn frames_of_all_kinds_go_both_ways() {
    let hub = hub();
    let (mut socketcand, mut slcan) = clients(&hub);
    let extended = |data: &[u8]| Frame::new(CanId::extended(0x1ABC_DEF0).unwrap(), data);
    let frames = [frame(0, &[]), frame(0x7FF, &[0xFF; 8]), extended(&[]), extended(&[1, 2, 3])];
    for frame in frames {
        socketcand.send(&frame).unwrap();
        assert_eq!(next(&mut slcan), frame);
        slcan.send(&frame).unwrap();
        assert_eq!(next(&mut socketcand), frame);
    }
    let mut device = hub.attach();
    let remote = Frame::remote(CanId::standard(0x705).unwrap(), 1);
    slcan.send(&remote).unwrap();
    assert_eq!(next(&mut device), remote);
    assert!(matches!(socketcand.send(&remote), Err(SendError::RemoteFrame)));
}

#[test]
fn who_is_connected_misses_no_frame() {
    let hub = hub();
    let mut device = hub.attach();
    for number in 0..30 {
        let (mut socketcand, mut slcan) = clients(&hub);
        device.send(&frame(7, &[number])).unwrap();
        assert_eq!((next(&mut socketcand), next(&mut slcan)), (frame(7, &[number]), frame(7, &[number])));
    }
}

#[test]
fn a_lost_connection_is_said_once_and_made_again() {
    let first = hub();
    let options = HubOptions { socketcand: first.socketcand_address(), slcan: first.slcan_address() };
    let (socketcand, slcan) = clients(&first);
    drop(first);
    let mut both = [socketcand, slcan];
    for client in &mut both {
        until("sending is refused", || matches!(client.send(&frame(1, &[])), Err(SendError::Disconnected)));
    }
    // Longer than the first attempts, none of which is said.
    thread::sleep(Duration::from_millis(400));
    let second = Hub::start(&options).unwrap();
    let mut device = second.attach();
    for client in &mut both {
        until("sending works", || client.send(&frame(2, &[])).is_ok());
        assert_eq!(next(&mut device), frame(2, &[]));
    }
    for client in &mut both {
        device.send(&frame(3, &[])).unwrap();
        while next(client) != frame(3, &[]) {}
        let lost = client.event();
        assert!(matches!(&lost, Some(Event::Disconnected { peer, .. }) if peer.contains(':')), "{lost:?}");
        assert!(matches!(client.event(), Some(Event::Connected { .. })));
        assert_eq!(client.event(), None);
    }
}

#[test]
fn what_was_taken_is_sent_before_the_client_goes() {
    let hub = hub();
    for _ in 0..20 {
        let mut device = hub.attach();
        let (mut socketcand, mut slcan) = clients(&hub);
        for number in 0..1_000_u16 {
            socketcand.send(&frame(number, &[1])).unwrap();
        }
        drop(socketcand);
        for number in 0..1_000_u16 {
            slcan.send(&frame(number, &[2])).unwrap();
        }
        drop(slcan);
        for byte in [1, 2] {
            for number in 0..1_000_u16 {
                assert_eq!(next(&mut device), frame(number, &[byte]));
            }
        }
    }
}

#[test]
fn frames_may_come_right_behind_the_handshake() {
    let port = stranger(b"< hi >< ok >< ok >< frame 123 1.0 AB >< error 004 1.5 >< frame 123 2.0  >");
    let mut client = Client::socketcand("127.0.0.1", port, "can0").unwrap();
    assert_eq!(next(&mut client), frame(0x123, &[0xAB]));
    assert_eq!(next(&mut client), frame(0x123, &[]));
    assert_eq!(client.event(), Some(Event::ErrorFrame(4)));
    let mut client = Client::slcan("127.0.0.1", stranger(b"t1230\r\x07\rt1231AB\r")).unwrap();
    assert_eq!(next(&mut client), frame(0x123, &[0xAB]));
}

#[test]
fn a_side_that_does_not_read_is_given_up_and_memory_is_bounded() {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = listener.local_addr().unwrap().port();
    let lazy = thread::spawn(move || {
        let (mut stream, _) = listener.accept().unwrap();
        stream.write_all(b"\r\r").unwrap();
        stream
    });
    let mut client = Client::slcan("127.0.0.1", port).unwrap();
    let stream = lazy.join().unwrap();
    let (mut taken, mut refused) = (0_u32, 0_u32);
    until("the connection is given up", || {
        loop {
            match client.send(&frame(1, &[0; 8])) {
                Ok(()) => taken += 1,
                Err(SendError::Full) => {
                    refused += 1;
                    return false;
                }
                Err(SendError::Disconnected) => return true,
                Err(error) => panic!("{error}"),
            }
            assert!(taken < 10_000_000, "somewhere frames are kept without end");
        }
    });
    assert!(refused > 0);
    client.wait(patience()).unwrap();
    assert_eq!(client.receive().unwrap(), None);
    let event = client.event().map(|event| event.to_string()).unwrap_or_default();
    let expected = format!(
        "connection to 127.0.0.1:{port} lost (the other side has not taken what was sent for 5 s), trying again"
    );
    assert_eq!(event, expected);
    drop(stream);
}

#[test]
fn who_is_there_but_speaks_something_else_is_named() {
    let socketcand = |words| mistake(Client::socketcand("127.0.0.1", stranger(words), "can0"));
    let text = socketcand(b"SSH-2.0-x\r\n>");
    assert!(text.contains("takes the connection, but does not speak socketcand: expected < hi >"), "{text}");
    assert!(text.ends_with("got `SSH-2.0-x\\r\\n>`"), "{text}");
    let text = socketcand(b"< hi >< error could not open bus >");
    assert!(text.ends_with("refuses to open the channel: could not open bus"), "{text}");
    let text = mistake(Client::slcan("127.0.0.1", stranger(b"\x07\x07")));
    assert!(
        text.ends_with("refuses to open the channel: its answer to `O` is the error character"),
        "{text}"
    );
    // A hub's socketcand port says only its greeting to an SLCAN client.
    let hub = hub();
    let text = mistake(Client::slcan("127.0.0.1", hub.socketcand_address().unwrap().port()));
    assert!(text.contains("does not speak SLCAN: expected an answer to `C`, got `< hi >`"), "{text}");
}

#[test]
fn broken_addresses_say_what_is_wrong() {
    let port = TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port();
    let open =
        |text: &str| open(&text.parse().unwrap()).err().map(|error| error.to_string()).unwrap_or_default();
    let text = open(&format!("slcan:127.0.0.1:{port}"));
    assert!(text.starts_with(&format!("cannot connect to 127.0.0.1:{port}: ")), "{text}");
    assert!(text.ends_with("nothing listens there, is the hub running?"), "{text}");
    let text = open("socketcand:no such host:29536");
    assert!(text.starts_with("no address is known for the host of no such host:29536"), "{text}");
}

#[test]
fn an_address_opens_a_bus() {
    let hub = hub();
    let mut device = hub.attach();
    let mut bus = open(&format!("slcan:{}", hub.slcan_address().unwrap()).parse().unwrap()).unwrap();
    bus.send(&frame(5, &[5])).unwrap();
    assert_eq!(next(&mut device), frame(5, &[5]));
    device.send(&frame(6, &[])).unwrap();
    assert_eq!(next(&mut bus), frame(6, &[]));
}
