//! An SDO client that does as little as possible.

use crate::device::{BYTES, Device, NODE_ID, NUMBER};

const SEGMENT: usize = 7;
const MOST_SEGMENTS: u8 = 127;
/// In the first byte of a block's segment: it is the last one of all.
const LAST_SEGMENT: u8 = 0x80;

/// A request that names a value.
fn about(command: u8, index: u16, data: [u8; 4]) -> [u8; 8] {
    let [low, high] = index.to_le_bytes();
    let [a, b, c, d] = data;
    [command, low, high, 0, a, b, c, d]
}

fn send<D: Device>(device: &mut D, request: &[u8; 8]) {
    device.receive(0x600 + NODE_ID, request);
    device.poll();
}

/// The one frame that a request leads to.
fn ask<D: Device>(device: &mut D, request: &[u8; 8]) -> [u8; 8] {
    send(device, request);
    let frame = device.transmit().expect("there is an answer");
    let answer = D::data(&frame).try_into().expect("an SDO has eight bytes");
    assert!(device.transmit().is_none());
    answer
}

/// Reads the number.
pub(crate) fn upload<D: Device>(device: &mut D) -> u32 {
    let [command, _, _, _, data @ ..] = ask(device, &about(0x40, NUMBER, [0; 4]));
    assert_eq!(command, 0x43);
    u32::from_le_bytes(data)
}

/// Writes the number.
pub(crate) fn download<D: Device>(device: &mut D, value: u32) {
    let [command, ..] = ask(device, &about(0x23, NUMBER, value.to_le_bytes()));
    assert_eq!(command, 0x60);
}

/// Reads the bytes segment by segment.
pub(crate) fn upload_segmented<D: Device>(device: &mut D, into: &mut Vec<u8>) {
    into.clear();
    let [command, ..] = ask(device, &about(0x40, BYTES, [0; 4]));
    // Bit 0, whether the length is told, is up to the server.
    assert_eq!(command | 1, 0x41);
    let mut toggle = 0;
    loop {
        let [command, data @ ..] = ask(device, &[0x60 | toggle, 0, 0, 0, 0, 0, 0, 0]);
        assert_eq!(command & 0xF0, toggle);
        let length = SEGMENT - usize::from(command >> 1 & 7);
        into.extend_from_slice(&data[..length]);
        if command & 1 == 1 {
            return;
        }
        toggle ^= 0x10;
    }
}

/// Reads the bytes in blocks of 127 segments, with a checksum, which is not compared.
pub(crate) fn upload_block<D: Device>(device: &mut D, into: &mut Vec<u8>) {
    into.clear();
    let [command, ..] = ask(device, &about(0xA4, BYTES, [MOST_SEGMENTS, 0, 0, 0]));
    assert_eq!(command & 0xFC, 0xC4);
    let mut request = [0xA3, 0, 0, 0, 0, 0, 0, 0];
    let mut is_last = false;
    while !is_last {
        send(device, &request);
        let mut sequence = 0;
        while !is_last && sequence < MOST_SEGMENTS {
            match device.transmit() {
                Some(frame) => {
                    let [head, data @ ..]: [u8; 8] =
                        D::data(&frame).try_into().expect("a segment has eight bytes");
                    sequence += 1;
                    assert_eq!(head & !LAST_SEGMENT, sequence);
                    is_last = head & LAST_SEGMENT != 0;
                    into.extend_from_slice(&data);
                }
                None => device.poll(),
            }
        }
        request = [0xA2, sequence, MOST_SEGMENTS, 0, 0, 0, 0, 0];
    }
    let [command, ..] = ask(device, &request);
    assert_eq!(command & 0xE3, 0xC1);
    into.truncate(into.len() - usize::from(command >> 2 & 7));
    send(device, &[0xA1, 0, 0, 0, 0, 0, 0, 0]);
    // zencan takes the end of the transfer for an unknown request, and answers with an abort.
    while device.transmit().is_some() {}
}
