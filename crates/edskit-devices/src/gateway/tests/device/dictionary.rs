use super::*;

const NO_OBJECT: Result<u32, u32> = Err(0x0602_0000);
const NO_SUB_INDEX: Result<u32, u32> = Err(0x0609_0011);

/// Which sub-indices of an object can be read.
fn present(bench: &mut Bench, index: u16) -> Vec<u8> {
    (0..=64).filter(|sub_index| bench.read(index, *sub_index).is_ok()).collect()
}

/// Everything that can be active is.
fn everything() -> Vec<(Owner, u16, i32)> {
    let assignments = (16400..=16451).map(|number| (number, if number % 2 == 0 { 2000 } else { 2908 }));
    let cycles = (16460..=16472).map(|number| (number, 1000));
    let inputs = (0..12).flat_map(|nth| [(900 + nth, i32::from(nth) + 1), (4900 + nth, 3)]);
    let others = [(14401, 1), (14402, 1), (827, 1), (4827, 3)];
    let of_governor: Vec<_> = assignments.chain(cycles).chain(inputs).chain(others).collect();
    let of_gateway: Vec<_> =
        (16404..=16415).map(|number| (number, 0x190 + i32::from(number - 16404))).collect();
    both(&of_gateway, &of_governor)
}

// GW-OD-01, GW-OD-02, GW-OD-03, GW-OD-04, GW-OD-05, GW-OD-06, GW-EDS-01, GW-EDS-24, GW-GAP-04, GW-APP-41, GW-GAP-13
#[test]
fn the_objects_of_the_communication_profile() {
    let mut bench = Bench::new(&[]);
    let values = [
        (0x1000, 0, Ok(0)),
        (0x1001, 0, Ok(0)),
        (0x1018, 0, Ok(4)),
        (0x1018, 1, Ok(0x161)),
        (0x1018, 2, Ok(0x1B59)),
        // As RevisionNumber of the data sheet, and not the version of the software.
        (0x1018, 3, Ok(0)),
        (0x1018, 4, Ok(2611 * 100_000 + 1)),
        (0x1018, 5, NO_SUB_INDEX),
        (0x1016, 0, Ok(1)),
        (0x1016, 1, Ok(0)),
        (0x1017, 0, Ok(0)),
        (0x1200, 0, Ok(2)),
        (0x1200, 1, Ok(0x601)),
        (0x1200, 2, Ok(0x581)),
        (0x1200, 3, NO_SUB_INDEX),
    ];
    for (index, sub_index, value) in values {
        assert_eq!(bench.read(index, sub_index), value, "{index:X}h sub {sub_index}");
    }
    assert_eq!(
        [3842, 3844, 3845].map(|number| bench.gateway.measured(number)),
        [Some(1), Some(2611), Some(1)]
    );
}

// GW-OD-07, GW-OD-08, GW-OD-10, GW-OD-11, GW-NOTE-18, GW-GAP-05, GW-GAP-06
#[test]
fn inactive_pdos_are_as_in_the_data_sheet() {
    let mut bench = Bench::new(&gateway(&[(427, 5), (16404, 0x190)]));
    let rpdos = [0x200, 0x300, 0x400, 0x500].map(|base| 0x8000_0000 + base + 5);
    let predefined = [0x180, 0x280, 0x380, 0x480].map(|base| 0x8000_0000 + base + 5);
    let tpdos = predefined.into_iter().chain([0x8000_0005; 12]);
    let communication = (0x1400..).zip(rpdos).chain((0x1800..).zip(tpdos));
    for (index, cob_id) in communication {
        let values: Vec<_> = (0..=6).map(|sub_index| bench.read(index, sub_index)).collect();
        let expected = [Ok(5), Ok(cob_id), Ok(0xFE), Ok(0), Ok(0), Ok(0), NO_SUB_INDEX];
        assert_eq!(values, expected, "{index:X}h");
        assert_eq!((bench.read(index + 0x200, 0), bench.read(index + 0x200, 1)), (Ok(0), NO_SUB_INDEX));
    }
}

// GW-CFG-12, GW-CFG-13, GW-CFG-14, GW-GAP-08
#[test]
fn active_pdos_show_their_identifier() {
    let mut bench = Bench::new(&everything());
    let cob_ids: Vec<_> =
        [0x1400, 0x1403, 0x1800, 0x1803, 0x1804, 0x180F].map(|index| bench.read(index, 1).unwrap()).into();
    assert_eq!(cob_ids, [0x201, 0x501, 0x181, 0x481, 0x190, 0x19B]);
    let free = [(16404, 0x282), (16407, 0x382), (16411, 0x003), (16415, 0x57F)];
    let mut bench = Bench::new(&[everything(), gateway(&free)].concat());
    let cob_ids = [0x1804, 0x1807, 0x180B, 0x180F].map(|index| bench.read(index, 1).unwrap());
    assert_eq!(cob_ids, [0x282, 0x382, 0x003, 0x57F]);
}

// GW-PDO-13, GW-PDO-17, GW-PDO-18, GW-OD-09, GW-OD-12, GW-EDS-03, GW-EDS-08
#[test]
fn mappings_follow_the_initialisation() {
    let mut bench = Bench::new(&everything());
    let mut mapping = |index| -> Vec<u32> {
        let count = bench.read(index, 0).unwrap() as u8;
        assert_eq!(bench.read(index, count + 1), NO_SUB_INDEX);
        (1..=count).map(|sub_index| bench.read(index, sub_index).unwrap()).collect()
    };
    assert_eq!(mapping(0x1A00), [0x2000_0110, 0x2000_0210, 0x2000_0310, 0x2000_0410]);
    assert_eq!(mapping(0x1A01), [0x2000_0510, 0x2000_0610]);
    assert_eq!(mapping(0x1A02), [0x2000_0710]);
    assert_eq!(mapping(0x1A03), [0x2001_0110, 0x2002_0110, 0x2001_0210, 0x2002_0210]);
    assert_eq!(mapping(0x1A0F), [0x2001_1910, 0x2002_1910, 0x2001_1A10, 0x2002_1A10]);
    assert_eq!(mapping(0x1600), [0x2003_0110, 0x0006_0010, 0x2003_0210]);
    assert_eq!(mapping(0x1603), [0x2004_0910, 0x2004_0A10, 0x2004_0B10, 0x2004_0C10]);
    let mut bench = Bench::new(&governor(&[(827, 1), (4827, 3)]));
    assert_eq!((bench.read(0x1600, 0), bench.read(0x1600, 1)), (Ok(1), Ok(0x2003_0110)));
    let mut bench = Bench::new(&governor(&[(900, 7), (4900, 3)]));
    let mapping: Vec<_> = (1..=3).map(|sub_index| bench.read(0x1602, sub_index)).collect();
    assert_eq!(mapping, [Ok(0x0006_0010), Ok(0x0006_0010), Ok(0x2004_0710)], "dummies keep the places");
}

// GW-OD-13, GW-OD-15, GW-OD-16, GW-OD-17, GW-OD-18, GW-OD-19, GW-GAP-01
#[test]
fn the_data_objects_grow_with_the_initialisation() {
    let mut bench = Bench::new(&[]);
    let sizes = |bench: &mut Bench| {
        [0x2000, 0x2001, 0x2002, 0x2003, 0x2004].map(|index| present(bench, index).last().copied().unwrap())
    };
    assert_eq!(sizes(&mut bench), [6, 0, 0, 0, 0]);
    assert_eq!((bench.read(0x2000, 7), bench.read(0x2005, 0)), (NO_SUB_INDEX, Ok(0)));
    let mut bench = Bench::new(&everything());
    assert_eq!(sizes(&mut bench), [7, 26, 26, 2, 12]);
    for index in 0x2000..=0x2004 {
        let sub_indices = present(&mut bench, index);
        assert_eq!(bench.read(index, 0), Ok(u32::from(*sub_indices.last().unwrap())));
        assert!((0..).zip(&sub_indices).all(|(nth, sub_index)| nth == *sub_index));
    }
}

// GW-NOTE-13
#[test]
fn the_sub_index_of_a_sensor_is_its_channel() {
    let mut bench = Bench::new(&governor(&[(900, 3), (4900, 3), (901, 7), (4901, 3)]));
    assert_eq!(present(&mut bench, 0x2004), [0, 3, 7]);
    assert_eq!((bench.read(0x2004, 0), bench.read(0x2004, 5)), (Ok(7), NO_SUB_INDEX));
}

// GW-OD-14, GW-NOTE-04, GW-NOTE-05, GW-PDO-02
#[test]
fn errors_can_always_be_read_and_the_status_where_it_is_sent() {
    let mut bench = Bench::new(&[]);
    for number in [3000, 3017, 3047, 3063] {
        bench.gateway.governor_mut().set_error(number, true);
    }
    let now = bench.now;
    bench.gateway.set_supply(now, 7_499);
    let words: Vec<_> = (1..=6).map(|sub_index| bench.read(0x2000, sub_index).unwrap()).collect();
    assert_eq!(words, [1, 1 << 1, 1 << 15, 1 << 15, 0, 1 << 5], "before TPDO 1 or 2 is selected");
    let mut bench = Bench::new(&governor(&[(14402, 1)]));
    bench.gateway.governor_mut().set_running(false);
    let status = bench.read(0x2000, 7).unwrap();
    assert!(status & 1 << 3 != 0 && status < 256, "8 bits in a word of 16");
}

// GW-OD-21, GW-OD-22, GW-STORE-01, GW-EDS-16
#[test]
fn nothing_else_exists() {
    let mut bench = Bench::new(&everything());
    let mut exists = Vec::new();
    for index in (0x1000..0x2100).chain([0, 2, 6, 0x5FFF, 0x6000, 0xFFFF]) {
        match bench.read(index, 0) {
            Ok(_) => exists.push(index),
            other => assert_eq!(other, NO_OBJECT, "{index:X}h"),
        }
    }
    let expected = [0x1000, 0x1001, 0x1016, 0x1017, 0x1018, 0x1200]
        .into_iter()
        .chain(0x1400..=0x1403)
        .chain(0x1600..=0x1603)
        .chain(0x1800..=0x180F)
        .chain(0x1A00..=0x1A0F)
        .chain(0x2000..=0x2005);
    assert_eq!(exists, expected.collect::<Vec<_>>());
    assert_eq!(exists.len(), 3 + 43 + 6);
}

// GW-OD-23, GW-SDO-01
#[test]
fn everything_fits_an_expedited_answer() {
    let mut bench = Bench::new(&everything());
    for index in 0x1000..0x2100_u16 {
        for sub_index in 0..=64 {
            let [low, high] = index.to_le_bytes();
            let answer = bench.sdo([0x40, low, high, sub_index, 0, 0, 0, 0]).unwrap();
            assert!(answer[0] == 0x80 || answer[0] & 0xE3 == 0x43, "{index:X}h: {answer:02X?}");
        }
    }
}

// GW-GAP-09, GW-HB-08
#[test]
fn heartbeat_objects_show_the_parameters() {
    let mut bench = Bench::new(&gateway(&[(428, 127), (429, 1000), (430, 100)]));
    assert_eq!((bench.read(0x1017, 0), bench.read(0x1016, 1)), (Ok(1000), Ok(0x007F_0064)));
}
