//! Values whose size the dictionary does not fix, and transfers of them that end before their time.

use super::device::{RW, with_values};
use super::{Bench, frame};
use crate::{Application, Crc, Entry, Flags, NoStorage, Services};
use edskit_types::{AbortCode, DataType};
use std::boxed::Box;
use std::cell::RefCell;
use std::rc::Rc;
use std::vec;
use std::vec::Vec;

/// A file that can be written and read; notes at which bytes it is read, and how far broken transfers got.
#[derive(Default)]
struct File {
    content: Vec<u8>,
    reads: Vec<u32>,
    broken: Vec<u32>,
}

struct Shelf(Rc<RefCell<File>>);

impl Application for Shelf {
    fn domain_length(&mut self, _: &mut Services<'_>, _: &Entry) -> Result<Option<u32>, AbortCode> {
        Ok(Some(self.0.borrow().content.len() as u32))
    }

    fn read_domain(
        &mut self,
        _: &mut Services<'_>,
        _: &Entry,
        offset: u32,
        buffer: &mut [u8],
    ) -> Result<usize, AbortCode> {
        let mut file = self.0.borrow_mut();
        file.reads.push(offset);
        let rest = &file.content[offset as usize..];
        let count = rest.len().min(buffer.len());
        buffer[..count].copy_from_slice(&rest[..count]);
        Ok(count)
    }

    fn write_domain(
        &mut self,
        _: &mut Services<'_>,
        _: &Entry,
        offset: u32,
        data: &[u8],
        _: bool,
    ) -> Result<(), AbortCode> {
        let content = &mut self.0.borrow_mut().content;
        content.truncate(offset as usize);
        content.extend_from_slice(data);
        Ok(())
    }

    fn domain_broken_off(&mut self, _: &mut Services<'_>, entry: &Entry, offset: u32) {
        assert_eq!(entry.data_type, DataType::Domain);
        self.0.borrow_mut().broken.push(offset);
    }
}

fn bench() -> (Bench, Rc<RefCell<File>>) {
    let file = Rc::new(RefCell::new(File::default()));
    let device = with_values()
        .u8(0x1201, 0, Flags::READ, 2)
        .u32(0x1201, 1, RW, 0x640)
        .u32(0x1201, 2, RW, 0x5C0)
        .add(0x2020, 0, DataType::OctetString, RW, "old");
    let bench = Bench::with(device.build(), Box::new(NoStorage), Box::new(Shelf(file.clone())));
    (bench, file)
}

// W12

#[test]
fn four_bytes_count_where_neither_side_says_how_many() {
    let (mut bench, file) = bench();
    file.borrow_mut().content = vec![9; 20];
    for command in [0x22, 0x26, 0x2E] {
        bench.sdo([command, 6, 0x20, 0, 0x41, 0x42, 0x43, 0x44]).unwrap();
        assert_eq!(file.borrow().content, b"ABCD");
    }
    for (index, text) in [(3, b"ABCD"), (0x20, b"WXYZ")] {
        let [a, b, c, d] = *text;
        bench.sdo([0x22, index, 0x20, 0, a, b, c, d]).unwrap();
        assert_eq!(bench.read(0x2000 + u16::from(index), 0), Ok(text.to_vec()));
    }
    // A number has the size of its type, and one of eight bytes cannot come so.
    bench.sdo([0x22, 0, 0x20, 0, 5, 6, 7, 8]).unwrap();
    assert_eq!(bench.read(0x2000, 0), Ok([5, 6].into()));
    bench.sdo([0x22, 7, 0x20, 0, 5, 6, 7, 8]).unwrap();
    assert_eq!(bench.read(0x2007, 0), Ok([5, 6, 7].into()));
    assert_eq!(bench.sdo([0x22, 9, 0x20, 0, 5, 6, 7, 8]), Err(0x0607_0013));
    assert_eq!(bench.read(0x2009, 0), Ok([1, 2, 3, 4, 5, 6, 7, 8].into()));
    assert_eq!(file.borrow().broken, []);
}

// U5

#[cfg(all(feature = "block-transfer", feature = "further-sdo-servers"))]
#[test]
fn the_application_is_told_of_a_broken_download_once() {
    type End = fn(&mut Bench);
    let ends: [(&str, End); 9] = [
        ("abort of the client", |bench| drop(bench.ask(0x605, &[0x80, 6, 0x20, 0, 0, 0, 0, 8]))),
        ("abort with reserved bits", |bench| drop(bench.ask(0x605, &[0x9F, 6, 0x20, 0, 0, 0, 0, 8]))),
        ("silence", |bench| drop(bench.pass(1500))),
        ("toggle bit", |bench| assert!(bench.sdo([0, 1, 2, 3, 4, 5, 6, 7]).is_err())),
        ("another request", |bench| drop(bench.read(0x1000, 0))),
        ("stopped", |bench| drop(bench.nmt(2))),
        ("reset", |bench| drop(bench.nmt(129))),
        ("reset of the communication", |bench| drop(bench.nmt(130))),
        ("length", |bench| assert!(bench.sdo([0x11, 1, 2, 3, 4, 5, 6, 7]).is_err())),
    ];
    for (name, end) in ends {
        let (mut bench, file) = bench();
        bench.sdo([0x21, 6, 0x20, 0, 20, 0, 0, 0]).unwrap();
        bench.sdo([0, 1, 2, 3, 4, 5, 6, 7]).unwrap();
        end(&mut bench);
        let broken = file.borrow().broken.clone();
        assert!(matches!(broken[..], [7 | 14]), "{name}: {broken:?}");
        bench.nmt(128);
        assert!(bench.read(0x1000, 0).is_ok());
    }
    // In blocks, by a wrong checksum.
    let (mut bench, file) = bench();
    bench.sdo([0xC6, 6, 0x20, 0, 10, 0, 0, 0]).unwrap();
    bench.ask(0x605, &[1, 1, 2, 3, 4, 5, 6, 7]);
    bench.ask(0x605, &[0x82, 8, 9, 10, 0, 0, 0, 0]);
    assert_eq!(bench.sdo([0xC1 | 4 << 2, 0xAA, 0xAA, 0, 0, 0, 0, 0]), Err(0x0504_0004));
    assert_eq!(file.borrow().broken, [10]);
    // The second server with other identifiers.
    bench.ask(0x640, &[0x21, 6, 0x20, 0, 20, 0, 0, 0]);
    bench.write(0x1201, 1, &[0x40, 6, 0, 0x80]).unwrap();
    assert_eq!(file.borrow().broken, [10, 0]);
    // Uploads, other values and complete transfers are none.
    bench.write(0x2006, 0, &[1; 30]).unwrap();
    bench.sdo([0x40, 6, 0x20, 0, 0, 0, 0, 0]).unwrap();
    bench.ask(0x605, &[0x80, 0, 0, 0, 0, 0, 0, 0]);
    bench.sdo([0x21, 3, 0x20, 0, 20, 0, 0, 0]).unwrap();
    bench.ask(0x605, &[0x80, 0, 0, 0, 0, 0, 0, 0]);
    assert_eq!(file.borrow().broken, [10, 0]);
}

// U8

#[cfg(feature = "block-transfer")]
#[test]
fn no_abort_is_answered() {
    for low_bits in 0..=0x1F {
        let (mut bench, _) = bench();
        let abort = [0x80 | low_bits, 3, 0x20, 0, 0, 0, 0, 8];
        assert_eq!(bench.ask(0x605, &abort), [], "without a transfer");
        bench.sdo([0x40, 3, 0x20, 0, 0, 0, 0, 0]).unwrap();
        assert_eq!(bench.ask(0x605, &abort), []);
        assert_eq!(bench.sdo([0x60, 0, 0, 0, 0, 0, 0, 0]), Err(0x0504_0001), "the transfer has ended");
        // A segment of a block has its number there.
        bench.sdo([0xC2, 3, 0x20, 0, 7, 0, 0, 0]).unwrap();
        let answers = bench.ask(0x605, &abort);
        let expected = match low_bits {
            0 => None,
            1 => Some([0xA2, 1, 127, 0, 0, 0, 0, 0]),
            _ => Some([0xA2, 0, 127, 0, 0, 0, 0, 0]),
        };
        assert_eq!(answers, expected.map(|data| frame(0x585, &data)).as_slice());
    }
}

#[cfg(feature = "block-transfer")]
#[test]
fn a_block_upload_reads_each_segment_once() {
    let (mut bench, file) = bench();
    let content: Vec<u8> = (0..100).collect();
    file.borrow_mut().content = content.clone();
    bench.sdo([0xA4, 6, 0x20, 0, 5, 0, 0, 0]).unwrap();
    let mut sent = bench.ask(0x605, &[0xA3, 0, 0, 0, 0, 0, 0, 0]);
    let mut blocks = 1;
    while sent[0].data()[0] & 0xE0 != 0xC0 {
        let count = sent.len() as u8;
        sent = bench.ask(0x605, &[0xA2, count, 5, 0, 0, 0, 0, 0]);
        blocks += 1;
    }
    assert_eq!(blocks, 4);
    let reads: Vec<u32> = (0..15).map(|segment| segment * 7).collect();
    assert_eq!(file.borrow().reads, reads);
    let mut crc = Crc::new();
    crc.update(&content);
    assert_eq!(sent[0].data()[1..3], crc.value().to_le_bytes());
}
