use super::device::{RW, with_values};
use super::{Bench, frame};
use crate::{Application, Entry, Flags, Services};
use edskit_types::{AbortCode, Index, SubIndex};
use std::boxed::Box;
use std::vec::Vec;

#[test]
fn values_of_every_length() {
    let mut bench = Bench::new(with_values().build());
    assert_eq!(bench.read(0x1000, 0), Ok([0x91, 1, 1, 0].into()));
    assert_eq!(bench.read(0x2007, 0), Ok([1, 2, 3].into()));
    assert_eq!(bench.read(0x2009, 0), Ok([1, 2, 3, 4, 5, 6, 7, 8].into()));
    assert_eq!(bench.read(0x1008, 0), Ok(b"A device of many words".to_vec()));
    for text in [&b"shorter"[..], b"exactly fourteen.."[..14].as_ref(), &[b'x'; 200], b""] {
        assert_eq!((bench.write(0x2003, 0, text), bench.read(0x2003, 0)), (Ok(()), Ok(text.to_vec())));
    }
    assert_eq!(bench.write(0x2003, 0, &[b'x'; 201]), Err(0x0607_0012));
}

#[test]
fn rights_lengths_and_limits() {
    let mut bench = Bench::new(with_values().build());
    assert_eq!(bench.write(0x1000, 0, &[0; 4]), Err(0x0601_0002));
    assert_eq!(bench.read(0x2004, 0), Err(0x0601_0001));
    assert_eq!(bench.read(0x1000, 1), Err(0x0609_0011));
    assert_eq!(bench.read(0x5FFF, 0), Err(0x0602_0000));
    assert_eq!(bench.write(0x2000, 0, &[1, 2, 3]), Err(0x0607_0012));
    assert_eq!(bench.write(0x2000, 0, &[1]), Err(0x0607_0013));
    assert_eq!(bench.write(0x2001, 0, &[11]), Err(0x0609_0031));
    assert_eq!(bench.write(0x2001, 0, &[0xF5]), Err(0x0609_0032));
    assert_eq!((bench.write(0x2001, 0, &[0xF6]), bench.read(0x2001, 0)), (Ok(()), Ok([0xF6].into())));
    assert_eq!(bench.write(0x2008, 0, &[2]), Err(0x0609_0030));
}

#[test]
fn an_expedited_download_may_leave_its_length_open() {
    let mut bench = Bench::new(with_values().build());
    assert!(bench.sdo([0x22, 0, 0x20, 0, 0xCD, 0xAB, 0, 0]).is_ok());
    assert_eq!(bench.read(0x2000, 0), Ok([0xCD, 0xAB].into()));
}

#[test]
fn a_segmented_download_of_a_small_value() {
    let mut bench = Bench::new(with_values().build());
    bench.sdo([0x20, 0, 0x20, 0, 0, 0, 0, 0]).unwrap();
    bench.sdo([0x0B, 7, 8, 0, 0, 0, 0, 0]).unwrap();
    assert_eq!(bench.read(0x2000, 0), Ok([7, 8].into()));
    assert_eq!(bench.sdo([0x21, 0, 0x20, 0, 16, 0, 0, 0]), Err(0x0607_0012), "too many are announced");
    bench.sdo([0x21, 0, 0x20, 0, 2, 0, 0, 0]).unwrap();
    assert_eq!(bench.sdo([0x0D, 9, 0, 0, 0, 0, 0, 0]), Err(0x0607_0013), "fewer come than announced");
    assert_eq!(bench.read(0x2000, 0), Ok([7, 8].into()));
}

#[test]
fn toggle_bits_alternate() {
    let mut bench = Bench::new(with_values().build());
    bench.sdo([0x40, 8, 0x10, 0, 0, 0, 0, 0]).unwrap();
    assert_eq!(bench.sdo([0x70, 0, 0, 0, 0, 0, 0, 0]), Err(0x0503_0000));
    bench.sdo([0x21, 3, 0x20, 0, 9, 0, 0, 0]).unwrap();
    assert_eq!(bench.sdo([0x10, 0, 0, 0, 0, 0, 0, 0]), Err(0x0503_0000));
    assert_eq!(bench.read(0x2003, 0), Ok(b"a text that can change".to_vec()));
}

#[test]
fn what_is_no_request_of_a_transfer() {
    let mut bench = Bench::new(with_values().build());
    for command in [0x60, 0x00, 0xE0, 0x80 | 0x20 | 1, 0xC1] {
        assert_eq!(bench.sdo([command, 0, 0x10, 0, 0, 0, 0, 0]), Err(0x0504_0001), "{command:02X}");
    }
    assert!(bench.ask(0x605, &[0x80, 0, 0, 0, 0, 0, 0, 8]).is_empty(), "an abort is not answered");
    for length in 0..8 {
        assert!(bench.ask(0x605, &[0x40, 0, 0x10, 0, 0, 0, 0][..length.min(7)]).is_empty());
    }
    assert!(bench.ask(0x606, &[0x40, 0, 0x10, 0, 0, 0, 0, 0]).is_empty());
}

#[test]
fn a_new_request_ends_a_running_transfer() {
    let mut bench = Bench::new(with_values().build());
    bench.sdo([0x40, 8, 0x10, 0, 0, 0, 0, 0]).unwrap();
    assert_eq!(bench.read(0x1000, 0), Ok([0x91, 1, 1, 0].into()));
    assert_eq!(bench.sdo([0x60, 0, 0, 0, 0, 0, 0, 0]), Err(0x0504_0001));
}

#[test]
fn a_silent_client_is_told_after_a_second() {
    let mut bench = Bench::new(with_values().build());
    bench.sdo([0x21, 3, 0x20, 0, 9, 0, 0, 0]).unwrap();
    assert_eq!(bench.pass(1500), [(1_000_000, frame(0x585, &[0x80, 3, 0x20, 0, 0, 0, 4, 5]))]);
    assert_eq!(bench.read(0x1000, 0), Ok([0x91, 1, 1, 0].into()));
}

#[test]
fn stopped_means_no_sdo() {
    let mut bench = Bench::new(with_values().build());
    bench.nmt(2);
    assert!(bench.ask(0x605, &[0x40, 0, 0x10, 0, 0, 0, 0, 0]).is_empty());
}

#[cfg(feature = "further-sdo-servers")]
#[test]
fn a_second_server_has_its_own_identifiers() {
    let off = 0x8000_0000;
    let device = with_values().u8(0x1201, 0, Flags::READ, 2).u32(0x1201, 1, RW, off).u32(0x1201, 2, RW, off);
    let mut bench = Bench::new(device.build());
    assert_eq!(bench.write(0x1201, 1, &[1, 7, 0, 0]), Err(0x0609_0030), "701h is a heartbeat");
    bench.write(0x1201, 1, &[0x45, 6, 0, 0]).unwrap();
    bench.write(0x1201, 2, &[0xC5, 5, 0, 0]).unwrap();
    let answer = bench.ask(0x645, &[0x40, 0, 0x10, 0, 0, 0, 0, 0]);
    assert_eq!(answer, [frame(0x5C5, &[0x43, 0, 0x10, 0, 0x91, 1, 1, 0])]);
    assert_eq!(bench.write(0x1201, 2, &[0xC6, 5, 0, 0]), Err(0x0609_0030), "a valid one cannot change");
    bench.write(0x1201, 2, &[0xC5, 5, 0, 0x80]).unwrap();
    assert!(bench.ask(0x645, &[0x40, 0, 0x10, 0, 0, 0, 0, 0]).is_empty());
}

/// A device that refuses, hides, and has a DOMAIN.
struct Particular(Vec<u8>);

impl Application for Particular {
    fn before_write(&mut self, _: &mut Services<'_>, entry: &Entry, data: &[u8]) -> Result<(), AbortCode> {
        if entry.index == Index(0x2000) && data == [0, 0] { Err(AbortCode::LOCAL_CONTROL) } else { Ok(()) }
    }

    fn is_present(&mut self, _: &Services<'_>, _: &Entry) -> bool {
        false
    }

    fn abort_code(&mut self, code: AbortCode, index: Index, _: SubIndex) -> AbortCode {
        if index == Index(0x1000) { AbortCode::UNSUPPORTED_ACCESS } else { code }
    }

    fn domain_length(&mut self, _: &mut Services<'_>, _: &Entry) -> Result<Option<u32>, AbortCode> {
        Ok(None)
    }

    fn read_domain(
        &mut self,
        _: &mut Services<'_>,
        _: &Entry,
        offset: u32,
        buffer: &mut [u8],
    ) -> Result<usize, AbortCode> {
        let rest = &self.0[offset as usize..];
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
        self.0.truncate(offset as usize);
        self.0.extend_from_slice(data);
        Ok(())
    }
}

fn particular() -> Bench {
    let device = with_values().u8(0x2010, 0, RW.and(Flags::OPTIONAL), 0).build();
    Bench::with(device, Box::new(crate::NoStorage), Box::new(Particular(Vec::new())))
}

#[test]
fn an_application_has_the_last_word() {
    let mut bench = particular();
    assert_eq!(bench.write(0x2000, 0, &[0, 0]), Err(0x0800_0021));
    assert_eq!(bench.read(0x2010, 0), Err(0x0602_0000));
    assert_eq!(bench.write(0x1000, 0, &[0; 4]), Err(0x0601_0000));
}

#[test]
fn a_domain_is_the_applications() {
    let mut bench = particular();
    for length in [0, 1, 6, 7, 8, 14, 300] {
        let data: Vec<u8> = (0..length).map(|number| number as u8).collect();
        bench.write(0x2006, 0, &data).unwrap();
        assert_eq!(bench.read(0x2006, 0), Ok(data), "{length}");
    }
    assert_eq!(Bench::new(with_values().build()).read(0x2006, 0), Err(0x0800_0024));
}
