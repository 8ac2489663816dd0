use super::Bench;
use super::device::with_values;
use crate::Frame;
use crate::crc::Crc;
use std::vec;
use std::vec::Vec;

fn bench() -> Bench {
    Bench::new(with_values().build())
}

fn crc(data: &[u8]) -> u16 {
    let mut crc = Crc::new();
    crc.update(data);
    crc.value()
}

/// A block download; `lost` is a segment of the first block that does not arrive.
fn download(bench: &mut Bench, index: u16, data: &[u8], lost: Option<u8>, checksum: u16) -> Result<(), u32> {
    let [low, high] = index.to_le_bytes();
    let [a, b, c, d] = (data.len() as u32).to_le_bytes();
    let answer = bench.sdo([0xC6, low, high, 0, a, b, c, d])?;
    assert_eq!((answer[0], answer[4]), (0xA4, 127));
    let (mut done, mut lost) = (0, lost);
    while done < data.len() {
        let block: Vec<&[u8]> = data[done..].chunks(7).take(127).collect();
        let is_end = done + block.iter().map(|chunk| chunk.len()).sum::<usize>() == data.len();
        let mut answers = Vec::new();
        for (place, chunk) in block.iter().enumerate() {
            let sequence = place as u8 + 1;
            if lost == Some(sequence) {
                continue;
            }
            let is_last = is_end && place + 1 == block.len();
            let mut segment = [0; 8];
            segment[0] = sequence | u8::from(is_last) << 7;
            segment[1..=chunk.len()].copy_from_slice(chunk);
            answers.extend(bench.ask(0x605, &segment));
        }
        let [answer] = &answers[..] else { panic!("{answers:?}") };
        if let &[0x80, _, _, _, a, b, c, d] = answer.data() {
            return Err(u32::from_le_bytes([a, b, c, d]));
        }
        let expected = lost.take().map_or(block.len() as u8, |lost| lost - 1);
        assert_eq!(answer.data()[..3], [0xA2, expected, 127]);
        done += usize::from(expected) * 7;
    }
    let unused = (7 - data.len() % 7) % 7;
    let [low, high] = checksum.to_le_bytes();
    let answer = bench.sdo([0xC1 | (unused as u8) << 2, low, high, 0, 0, 0, 0, 0])?;
    assert_eq!(answer[0], 0xA1);
    Ok(())
}

/// A block upload with blocks of this size; of the first block only `acknowledged` segments count.
fn upload(bench: &mut Bench, index: u16, size: u8, mut acknowledged: Option<u8>) -> Vec<u8> {
    let [low, high] = index.to_le_bytes();
    let answer = bench.sdo([0xA4, low, high, 0, size, 0, 0, 0]).unwrap();
    assert_eq!(answer[0], 0xC6);
    let length = u32::from_le_bytes(answer[4..8].try_into().unwrap()) as usize;
    let mut data = Vec::new();
    let mut sent = bench.ask(0x605, &[0xA3, 0, 0, 0, 0, 0, 0, 0]);
    loop {
        // A block that is longer than the queue follows as the queue empties.
        sent.extend(bench.pass(0).into_iter().map(|(_, frame)| frame));
        let is_end = sent.last().unwrap().data()[0] & 0x80 != 0;
        for (place, segment) in sent.iter().enumerate() {
            assert_eq!(usize::from(segment.data()[0] & 0x7F), place + 1);
        }
        let count = acknowledged.take().unwrap_or(sent.len() as u8);
        let counted = &sent[..usize::from(count)];
        data.extend(counted.iter().flat_map(|segment| segment.data()[1..].to_vec()));
        let is_all = is_end && counted.len() == sent.len();
        sent = bench.ask(0x605, &[0xA2, count, size, 0, 0, 0, 0, 0]);
        if is_all {
            break;
        }
    }
    let end = sent[0].data();
    assert_eq!(end[0] & 0xE3, 0xC1);
    data.truncate(data.len() - usize::from(end[0] >> 2 & 7));
    assert_eq!((data.len(), u16::from_le_bytes([end[1], end[2]])), (length, crc(&data)));
    assert!(bench.ask(0x605, &[0xA1, 0, 0, 0, 0, 0, 0, 0]).is_empty());
    data
}

#[test]
fn whole_values_both_ways() {
    let mut bench = bench();
    for length in [1, 6, 7, 8, 99, 200] {
        let data: Vec<u8> = (0..length).map(|number| number as u8).collect();
        download(&mut bench, 0x2003, &data, None, crc(&data)).unwrap();
        for size in [1, 3, 20, 127] {
            assert_eq!(upload(&mut bench, 0x2003, size, None), data, "{length} bytes, blocks of {size}");
        }
    }
    assert_eq!(upload(&mut bench, 0x1000, 20, None), [0x91, 1, 1, 0]);
    download(&mut bench, 0x2000, &[5, 6], None, crc(&[5, 6])).unwrap();
    assert_eq!(bench.read(0x2000, 0), Ok([5, 6].into()));
}

#[test]
fn what_is_lost_comes_again() {
    let mut bench = bench();
    let data = vec![0xA7; 60];
    for lost in [1, 2, 8] {
        download(&mut bench, 0x2003, &data, Some(lost), crc(&data)).unwrap();
        assert_eq!(bench.read(0x2003, 0), Ok(data.clone()));
    }
    for acknowledged in [0, 1, 4] {
        assert_eq!(upload(&mut bench, 0x2003, 5, Some(acknowledged)), data);
    }
}

#[test]
fn a_wrong_checksum_keeps_the_value() {
    let mut bench = bench();
    let before = bench.read(0x2003, 0);
    assert_eq!(download(&mut bench, 0x2003, &[1; 30], None, crc(&[1; 30]) ^ 1), Err(0x0504_0004));
    assert_eq!(bench.read(0x2003, 0), before);
    assert_eq!(download(&mut bench, 0x2003, &[1; 201], None, 0), Err(0x0607_0012));
    assert_eq!(download(&mut bench, 0x1000, &[1; 4], None, 0), Err(0x0601_0002));
}

#[test]
fn impossible_numbers_end_the_transfer() {
    let mut bench = bench();
    for size in [0, 128] {
        assert_eq!(bench.sdo([0xA4, 0, 0x10, 0, size, 0, 0, 0]), Err(0x0504_0002));
    }
    bench.sdo([0xA4, 0, 0x10, 0, 20, 0, 0, 0]).unwrap();
    bench.ask(0x605, &[0xA3, 0, 0, 0, 0, 0, 0, 0]);
    assert_eq!(bench.sdo([0xA2, 0x80, 20, 0, 0, 0, 0, 0]), Err(0x0504_0003));
    bench.sdo([0xC6, 3, 0x20, 0, 30, 0, 0, 0]).unwrap();
    assert_eq!(bench.sdo([0x00, 1, 2, 3, 4, 5, 6, 7]), Err(0x0504_0003));
    assert_eq!(bench.read(0x1000, 0), Ok([0x91, 1, 1, 0].into()));
}

#[test]
fn short_values_may_come_without_blocks() {
    let mut bench = bench();
    assert_eq!(bench.sdo([0xA4, 0, 0x10, 0, 20, 100, 0, 0]).unwrap()[0], 0x43);
    assert_eq!(bench.sdo([0xA4, 8, 0x10, 0, 20, 100, 0, 0]).unwrap()[0], 0x41);
    assert_eq!(bench.sdo([0xA4, 8, 0x10, 0, 20, 10, 0, 0]).unwrap()[0], 0xC6);
}

#[test]
fn a_client_that_stops_is_told() {
    let mut bench = bench();
    bench.sdo([0xC6, 3, 0x20, 0, 30, 0, 0, 0]).unwrap();
    bench.ask(0x605, &[1, 0, 0, 0, 0, 0, 0, 0]);
    let sent: Vec<Frame> = bench.pass(1200).into_iter().map(|(_, frame)| frame).collect();
    assert_eq!(sent[0].data(), [0x80, 3, 0x20, 0, 0, 0, 4, 5]);
}
