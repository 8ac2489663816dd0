use super::device::plain;
use super::storage::Memory;
use super::{Bench, frame};
use crate::{Application, Commissioning, NoStorage, Record, Settings};
use edskit_types::{BitRates, Bitrate, NodeId};
use std::boxed::Box;
use std::cell::Cell;
use std::rc::Rc;
use std::vec::Vec;

const IDENTITY: [u32; 4] = [0x360, 0x11, 0x0001_0002, 0x99];

fn request(bench: &mut Bench, data: &[u8]) -> Option<Vec<u8>> {
    let mut request = [0; 8];
    request[..data.len()].copy_from_slice(data);
    let sent = bench.ask(0x7E5, &request);
    sent.iter().find(|frame| frame.can_id().raw() == 0x7E4).map(|frame| frame.data().to_vec())
}

fn with_number(bench: &mut Bench, code: u8, number: u32) -> Option<Vec<u8>> {
    let [a, b, c, d] = number.to_le_bytes();
    request(bench, &[code, a, b, c, d])
}

fn configured() -> Bench {
    Bench::new(plain().build())
}

fn unconfigured(storage: Box<dyn crate::Storage>) -> Bench {
    let mut bench = Bench::off(plain().build(), Settings { node_id: None, ..Settings::default() }, storage);
    assert!(bench.poll().is_empty(), "without a node-ID there is no boot-up");
    bench
}

#[test]
fn inquiries_need_the_configuration_state() {
    let mut bench = configured();
    assert_eq!(request(&mut bench, &[0x5E]), None);
    assert_eq!(request(&mut bench, &[4, 1]), None);
    for (code, number) in (0x5A..).zip(IDENTITY) {
        let [a, b, c, d] = number.to_le_bytes();
        assert_eq!(request(&mut bench, &[code]), Some([code, a, b, c, d, 0, 0, 0].into()));
    }
    assert_eq!(request(&mut bench, &[0x5E]), Some([0x5E, 5, 0, 0, 0, 0, 0, 0].into()));
    assert_eq!(request(&mut bench, &[0x99]), None);
    assert!(bench.ask(0x7E5, &[0x5E]).is_empty(), "eight bytes, or none of it");
    request(&mut bench, &[4, 0]);
    assert_eq!(request(&mut bench, &[0x5E]), None);
}

#[test]
fn a_new_node_id_counts_from_the_next_reset_on() {
    let mut bench = configured();
    request(&mut bench, &[4, 1]);
    for (node_id, error) in [(0, 1), (128, 1), (254, 1), (255, 0), (0x55, 0)] {
        assert_eq!(request(&mut bench, &[0x11, node_id]), Some([0x11, error, 0, 0, 0, 0, 0, 0].into()));
    }
    request(&mut bench, &[4, 0]);
    assert_eq!(bench.node.node_id(), NodeId::new(5).ok());
    assert_eq!(bench.nmt(130), [frame(0x755, &[0])]);
}

#[test]
fn a_reset_leads_back_to_the_state_waiting() {
    let mut bench = configured();
    request(&mut bench, &[4, 1]);
    assert!(request(&mut bench, &[0x5E]).is_some());
    bench.nmt(130);
    assert_eq!(request(&mut bench, &[0x5E]), None);
}

#[test]
fn selection_by_identity() {
    let mut bench = configured();
    for wrong in 0..4 {
        for (place, number) in IDENTITY.into_iter().enumerate() {
            let number = if place == wrong { number ^ 1 } else { number };
            assert_eq!(with_number(&mut bench, 0x40 + place as u8, number), None);
        }
        assert_eq!(request(&mut bench, &[0x5E]), None);
    }
    let answers: Vec<bool> = (0x40..)
        .zip(IDENTITY)
        .map(|(code, number)| with_number(&mut bench, code, number).is_some())
        .collect();
    assert_eq!(answers, [false, false, false, true]);
    assert!(request(&mut bench, &[0x5E]).is_some());
}

#[test]
fn identification_within_bounds() {
    let mut bench = configured();
    let [vendor, product, revision, serial] = IDENTITY;
    for (low, high, is_in) in
        [(serial - 1, serial + 1, true), (serial, serial, true), (serial + 1, serial + 2, false)]
    {
        let numbers = [vendor, product, revision, revision, low, high];
        let answers: Vec<_> = (0x46..)
            .zip(numbers)
            .filter_map(|(code, number)| with_number(&mut bench, code, number))
            .collect();
        assert_eq!(answers.len(), usize::from(is_in));
    }
    assert_eq!(request(&mut bench, &[0x4C]), None, "it has a node-ID");
    assert_eq!(request(&mut bench, &[0x51, 0, 0, 0, 0, 128]), None);
}

#[test]
fn fast_scan_finds_the_identity_and_boots() {
    let mut bench = unconfigured(Box::new(NoStorage));
    assert_eq!(request(&mut bench, &[0x4C]), Some([0x50, 0, 0, 0, 0, 0, 0, 0].into()));
    let scan = |bench: &mut Bench, number: u32, bit: u8, place: u8, next: u8| {
        let [a, b, c, d] = number.to_le_bytes();
        request(bench, &[0x51, a, b, c, d, bit, place, next]).is_some()
    };
    assert!(scan(&mut bench, 0, 128, 0, 0));
    let mut found = Vec::new();
    for place in 0..4 {
        let mut number = 0;
        for bit in (0..32).rev() {
            if !scan(&mut bench, number, bit, place, place) {
                number |= 1 << bit;
            }
        }
        assert!(scan(&mut bench, number, 0, place, (place + 1) % 4));
        found.push(number);
    }
    assert_eq!(found, IDENTITY);
    assert_eq!(request(&mut bench, &[0x5E]), Some([0x5E, 255, 0, 0, 0, 0, 0, 0].into()));
    request(&mut bench, &[0x11, 9]);
    assert_eq!(bench.ask(0x7E5, &[4, 0, 0, 0, 0, 0, 0, 0]), [frame(0x709, &[0])]);
}

#[test]
fn what_is_stored_counts_after_power_on() {
    let memory = Memory::default();
    let mut bench = unconfigured(Box::new(memory.clone()));
    request(&mut bench, &[4, 1]);
    request(&mut bench, &[0x11, 0x42]);
    assert_eq!(request(&mut bench, &[0x17]), Some([0x17, 0, 0, 0, 0, 0, 0, 0].into()));
    let mut again = Bench::off(plain().build(), Settings::default(), Box::new(memory));
    assert_eq!(again.poll(), [frame(0x742, &[0])]);
    let mut without = configured();
    request(&mut without, &[4, 1]);
    assert_eq!(request(&mut without, &[0x17]), Some([0x17, 2, 0, 0, 0, 0, 0, 0].into()));
}

/// Notes the bit rate that it is told.
struct Radio(Rc<Cell<Option<(Bitrate, u16)>>>);

impl Application for Radio {
    fn activate_bit_rate(&mut self, bit_rate: Bitrate, delay: u16) {
        self.0.set(Some((bit_rate, delay)));
    }
}

#[test]
fn bit_timing() {
    let noted = Rc::new(Cell::new(None));
    let mut bench = Bench::with(plain().build(), Box::new(NoStorage), Box::new(Radio(noted.clone())));
    request(&mut bench, &[4, 1]);
    for (table, number, error) in [(0, 4, 0), (0, 5, 1), (0, 200, 1), (77, 0, 1)] {
        assert_eq!(request(&mut bench, &[0x13, table, number]).unwrap()[1], error);
    }
    assert_eq!(request(&mut bench, &[0x15, 0xE8, 3]), None);
    assert_eq!(noted.get(), Some((Bitrate::Kbit125, 1000)));
}

// W14

#[test]
fn node_id_and_bit_rate_are_stored_and_come_back_together() {
    let memory = Memory::default();
    let settings = Settings { node_id: NodeId::new(5).ok(), ..Settings::DEFAULT };
    let power_on = |memory: &Memory| {
        let noted = Rc::new(Cell::new(None));
        let mut bench = Bench::off(plain().build(), settings, Box::new(memory.clone()));
        bench.app = Box::new(Radio(noted.clone()));
        let boot_up = bench.poll()[0].can_id().raw() - 0x700;
        let commissioning = Commissioning::stored(&mut memory.clone(), &settings);
        assert_eq!(commissioning.node_id.map(NodeId::get), Some(boot_up as u8));
        assert_eq!(
            commissioning.bit_rate,
            noted.get().map(|(bit_rate, delay)| {
                assert_eq!(delay, 0);
                bit_rate
            })
        );
        request(&mut bench, &[4, 1]);
        (bench, boot_up, commissioning.bit_rate)
    };
    let (mut bench, node_id, bit_rate) = power_on(&memory);
    assert_eq!((node_id, bit_rate), (5, None));
    request(&mut bench, &[0x13, 0, 3]);
    request(&mut bench, &[0x11, 9]);
    request(&mut bench, &[0x17]);
    let (mut bench, node_id, bit_rate) = power_on(&memory);
    assert_eq!((node_id, bit_rate), (9, Some(Bitrate::Kbit250)));
    request(&mut bench, &[0x11, 10]);
    request(&mut bench, &[0x17]);
    let (mut bench, node_id, bit_rate) = power_on(&memory);
    assert_eq!((node_id, bit_rate), (10, Some(Bitrate::Kbit250)));
    // What is configured and not stored is lost, either half.
    request(&mut bench, &[0x13, 0, 0]);
    request(&mut bench, &[0x11, 11]);
    let (mut bench, node_id, bit_rate) = power_on(&memory);
    assert_eq!((node_id, bit_rate), (10, Some(Bitrate::Kbit250)));
    request(&mut bench, &[0x13, 0, 4]);
    request(&mut bench, &[0x17]);
    let (_, node_id, bit_rate) = power_on(&memory);
    assert_eq!((node_id, bit_rate), (10, Some(Bitrate::Kbit125)));

    // The rules of the device hold for what is stored.
    let others = Settings { bit_rates: BitRates::NONE.and(Bitrate::Kbit500), ..settings };
    let commissioning = Commissioning::stored(&mut memory.clone(), &others);
    assert_eq!((commissioning.node_id, commissioning.bit_rate), (NodeId::new(10).ok(), None));
    let without = Settings { has_lss: false, ..settings };
    let commissioning = Commissioning::stored(&mut memory.clone(), &without);
    assert_eq!((commissioning.node_id, commissioning.bit_rate), (NodeId::new(5).ok(), None));
}

#[test]
fn a_torn_record_is_told() {
    let memory = Memory::default();
    let mut bench = Bench::off(with_emcy(), Settings::default(), Box::new(memory.clone()));
    bench.poll();
    request(&mut bench, &[4, 1]);
    request(&mut bench, &[0x11, 9]);
    request(&mut bench, &[0x17]);
    for place in 0..6 {
        memory.flip(Record::Lss, place);
        let mut bench = Bench::off(with_emcy(), Settings::default(), Box::new(memory.clone()));
        assert_eq!(bench.poll(), [frame(0x701, &[0]), frame(0x81, &[0, 0x63, 1, 0, 0, 0, 0, 0])]);
        memory.flip(Record::Lss, place);
    }
}

fn with_emcy() -> super::Device {
    plain().u32(0x1014, 0, super::device::COB_ID, 0x80).build()
}

#[test]
fn only_bit_rates_of_the_device_can_be_configured() {
    let bit_rates = BitRates::NONE.and(Bitrate::Kbit500).and(Bitrate::Kbit20);
    let settings = Settings { bit_rates, ..Settings::DEFAULT };
    let mut bench = Bench::off(plain().build(), settings, Box::new(NoStorage));
    bench.poll();
    request(&mut bench, &[4, 1]);
    let accepted: Vec<u8> =
        (0..=9).filter(|number| request(&mut bench, &[0x13, 0, *number]).unwrap()[1] == 0).collect();
    assert_eq!(accepted, [2, 7]);
}
