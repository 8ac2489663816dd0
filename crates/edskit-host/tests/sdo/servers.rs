//! Servers that differ from that of `edskit-runtime`, over a bus in virtual time.

use crate::{ALL, DOMAIN, bytes, client};
use edskit_host::sdo::{SdoChannel, SdoError, SdoMode};
use edskit_host::{Bus, BusError, Participant, Received, SendError, VirtualBus};
use edskit_runtime::{Crc, Frame, Instant};
use edskit_types::{AbortCode, Bitrate, NodeId, SubIndex};

/// A participant's view of a bus on which a server answers each request with these messages.
struct Scripted<S> {
    bus: VirtualBus,
    tool: Participant,
    line: Participant,
    server: S,
    /// Every request, as it went over the bus.
    requests: Vec<[u8; 8]>,
}

impl<S: FnMut([u8; 8]) -> Vec<[u8; 8]>> Scripted<S> {
    fn new(server: S) -> Self {
        let bus = VirtualBus::new(Bitrate::Kbit1000);
        Self { tool: bus.attach(), line: bus.attach(), bus, server, requests: Vec::new() }
    }

    fn milliseconds(&self) -> u64 {
        self.bus.now().0 / 1_000
    }
}

impl<S: FnMut([u8; 8]) -> Vec<[u8; 8]>> Bus for Scripted<S> {
    fn now(&self) -> Instant {
        self.bus.now()
    }

    fn receive(&mut self) -> Result<Option<Received>, BusError> {
        self.tool.receive()
    }

    /// As a controller with a short queue, so that a block is not out at once.
    fn send(&mut self, frame: &Frame) -> Result<(), SendError> {
        if self.bus.next_event() != Instant::NEVER {
            return Err(SendError::Full);
        }
        self.tool.send(frame)
    }

    fn wait(&mut self, deadline: Instant) -> Result<(), BusError> {
        self.bus.step(deadline);
        let channel = SdoChannel::of_node(NodeId::MIN);
        while let Some(received) = self.line.receive()? {
            let request = <[u8; 8]>::try_from(received.frame.data()).expect("a client sends SDO messages");
            self.requests.push(request);
            for answer in (self.server)(request) {
                self.line.send(&Frame::new(channel.response, &answer)).expect("the bus has room");
            }
        }
        Ok(())
    }
}

/// A server of one value in expedited transfer and in segments, which treats requests for blocks as `blocks` says.
fn without_blocks(
    value: &mut Vec<u8>,
    mut blocks: impl FnMut([u8; 8]) -> Option<[u8; 8]>,
) -> impl FnMut([u8; 8]) -> Vec<[u8; 8]> {
    let mut place = 0;
    move |request| {
        let [command, a, b, c, ..] = request;
        let answer = |command: u8, data: u32| {
            let [d, e, f, g] = data.to_le_bytes();
            Some([command, a, b, c, d, e, f, g])
        };
        let answer = match command >> 5 {
            0 => {
                value.extend_from_slice(&request[1..8 - usize::from(command >> 1 & 7)]);
                Some([0x20 | command & 0x10, 0, 0, 0, 0, 0, 0, 0])
            }
            1 => {
                value.clear();
                answer(0x60, 0)
            }
            2 => {
                place = 0;
                answer(0x41, value.len() as u32)
            }
            3 => {
                let rest = &value[place..];
                let length = rest.len().min(7);
                let mut message = [0; 8];
                message[1..=length].copy_from_slice(&rest[..length]);
                message[0] = command & 0x10 | (7 - length as u8) << 1 | u8::from(length == rest.len());
                place += length;
                Some(message)
            }
            4 => None,
            _ => {
                place = 0;
                blocks(request)
            }
        };
        answer.into_iter().collect()
    }
}

#[test]
fn values_of_any_length_reach_servers_without_blocks() {
    type Blocks = fn([u8; 8]) -> Option<[u8; 8]>;
    let aborted: Blocks = |[_, a, b, c, ..]| Some([0x80, a, b, c, 1, 0, 4, 5]);
    let aborted_without_place: Blocks = |_| Some([0x80, 0, 0, 0, 1, 0, 4, 5]);
    let aborted_with_bits: Blocks = |[_, a, b, c, ..]| Some([0x9F, a, b, c, 0, 0, 0, 8]);
    let silent: Blocks = |_| None;
    // What canopen-python's LocalNode does, and its like for a download.
    let ordinary: Blocks = |[command, a, b, c, ..]| match command >> 5 {
        5 => Some([0x41, a, b, c, 0xE8, 3, 0, 0]),
        _ => Some([0x60, a, b, c, 0, 0, 0, 0]),
    };
    let reserved: Blocks = |_| Some([0xFF; 8]);
    for (kind, blocks) in [aborted, aborted_without_place, aborted_with_bits, silent, ordinary, reserved]
        .into_iter()
        .enumerate()
    {
        for length in [257, 889, 1000] {
            let (value, mut stored) = (bytes(length), Vec::new());
            let mut bus = Scripted::new(without_blocks(&mut stored, blocks));
            client().write(&mut bus, DOMAIN, SubIndex(0), &value).unwrap_or_else(|error| {
                panic!("server {kind}, {length} bytes: {error}");
            });
            let read = client().read(&mut bus, DOMAIN, SubIndex(0)).unwrap();
            assert_eq!(read, value, "server {kind}");
            let waited = if kind == 3 { 2_000 } else { 0 };
            let took = bus.milliseconds();
            assert!((waited..waited + 300).contains(&took), "server {kind}, {length} bytes: {took} ms");
        }
    }
}

#[test]
fn who_wants_blocks_is_told_that_there_are_none() {
    let mut stored = bytes(300);
    let mut bus =
        Scripted::new(without_blocks(&mut stored, |[_, a, b, c, ..]| Some([0x80, a, b, c, 1, 0, 4, 5])));
    let error = client().mode(SdoMode::Block).read(&mut bus, DOMAIN, SubIndex(0)).unwrap_err();
    assert!(matches!(error, SdoError::Aborted(AbortCode::UNKNOWN_COMMAND)));
    let error = client().mode(SdoMode::Block).write(&mut bus, DOMAIN, SubIndex(0), &[1]).unwrap_err();
    assert!(matches!(error, SdoError::Aborted(AbortCode::UNKNOWN_COMMAND)));
}

/// A server that takes blocks, loses segments, and says so as soon as it sees the next one, as CANopenNode does.
fn losing(lost: impl Fn(usize) -> bool, taken: &mut Vec<u8>) -> impl FnMut([u8; 8]) -> Vec<[u8; 8]> {
    let (mut is_in_block, mut sequence, mut count) = (false, 0, 0);
    move |request| {
        let [command, a, b, c, ..] = request;
        if !is_in_block && command & 0xE1 == 0xC0 {
            (is_in_block, sequence) = (true, 0);
            return vec![[0xA4, a, b, c, 127, 0, 0, 0]];
        }
        if !is_in_block {
            let unused = usize::from(command >> 2 & 7);
            taken.truncate(taken.len() - unused);
            let mut crc = Crc::new();
            crc.update(taken);
            assert_eq!(request[1..3], crc.value().to_le_bytes(), "the checksum of the client");
            return vec![[0xA1, 0, 0, 0, 0, 0, 0, 0]];
        }
        let (number, is_last) = (command & 0x7F, command & 0x80 != 0);
        count += 1;
        if lost(count) {
            return Vec::new();
        }
        let is_next = number == sequence + 1;
        if is_next {
            taken.extend_from_slice(&request[1..]);
            sequence = number;
        }
        // What was on its way when the server spoke up belongs to no block.
        if is_next && !is_last && number < 127 || !is_next && sequence == 0 {
            return Vec::new();
        }
        is_in_block = !(is_next && is_last);
        vec![[0xA2, std::mem::take(&mut sequence), 127, 0, 0, 0, 0, 0]]
    }
}

// U1 of the field reports: CANopenNode issue 426.
#[test]
fn a_server_may_confirm_a_block_before_it_is_out() {
    let value = bytes(700);
    let mut taken = Vec::new();
    let mut bus = Scripted::new(losing(|count| count == 10, &mut taken));
    client().write(&mut bus, DOMAIN, SubIndex(0), &value).unwrap();
    let segments: Vec<u8> =
        bus.requests[1..bus.requests.len() - 1].iter().map(|request| request[0]).collect();
    let stopped = segments.iter().skip(1).position(|number| *number == 1).expect("a second block") + 1;
    assert!((11..=13).contains(&stopped), "{stopped} segments before the client stops");
    assert_eq!(segments.len(), stopped + 91, "and it goes on with the tenth");
    drop(bus);
    assert_eq!(taken, value);

    let mut taken = Vec::new();
    let value = bytes(3_000);
    let mut bus = Scripted::new(losing(|count| count % 13 == 0, &mut taken));
    client().mode(SdoMode::Block).write(&mut bus, DOMAIN, SubIndex(0), &value).unwrap();
    drop(bus);
    assert_eq!(taken, value);
}

#[test]
fn a_length_that_is_not_said_comes_through() {
    for mode in [ALL[0], ALL[1]] {
        let mut bus = Scripted::new(|[_, a, b, c, ..]: [u8; 8]| vec![[0x42, a, b, c, 0x2C, 1, 0, 0]]);
        let value = client().mode(mode).read(&mut bus, DOMAIN, SubIndex(0)).unwrap();
        assert_eq!(value, [0x2C, 1, 0, 0]);
        assert!(!value.is_length_said());
    }
}
