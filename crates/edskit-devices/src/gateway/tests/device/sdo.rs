use super::*;

// GW-SDO-02, GW-SDO-03, GW-NOTE-22, GW-OD-24
#[test]
fn a_download_is_always_refused_in_the_order_of_table_3() {
    let mut bench = Bench::new(&[]);
    for (request, code) in [
        ([0x23, 0x08, 0x10, 0, 1, 2, 3, 4], 0x0602_0000_u32),
        ([0x23, 0x18, 0x10, 9, 1, 2, 3, 4], 0x0609_0011),
        ([0x23, 0x17, 0x10, 0, 1, 2, 3, 4], 0x0607_0012),
        ([0x27, 0x17, 0x10, 0, 1, 2, 3, 0], 0x0607_0012),
        ([0x2F, 0x17, 0x10, 0, 1, 0, 0, 0], 0x0607_0013),
        ([0x2B, 0x17, 0x10, 0, 1, 2, 0, 0], 0x0601_0002),
        ([0x23, 0x00, 0x10, 0, 1, 2, 3, 4], 0x0601_0002),
        ([0x2F, 0x01, 0x10, 0, 1, 0, 0, 0], 0x0601_0002),
    ] {
        assert_eq!(bench.abort(request), code, "{request:02X?}");
    }
}

// GW-NOTE-24
#[test]
fn the_announced_length_counts_too() {
    let mut bench = Bench::new(&[]);
    for (request, code) in [
        ([0x21, 0x17, 0x10, 0, 3, 0, 0, 0], 0x0607_0012_u32),
        ([0x21, 0x17, 0x10, 0, 1, 0, 0, 0], 0x0607_0013),
        ([0x21, 0x17, 0x10, 0, 2, 0, 0, 0], 0x0601_0002),
        ([0x20, 0x17, 0x10, 0, 0, 0, 0, 0], 0x0601_0002),
        ([0x22, 0x17, 0x10, 0, 1, 2, 3, 4], 0x0601_0002),
    ] {
        assert_eq!(bench.abort(request), code, "{request:02X?}");
    }
}

// GW-SDO-05, GW-SDO-11
#[test]
fn an_upload_is_expedited_or_refused() {
    let mut bench = Bench::new(&gateway(&[(427, 33), (429, 500)]));
    assert_eq!(bench.sdo([0x40, 0x17, 0x10, 0, 0, 0, 0, 0]), Some([0x4B, 0x17, 0x10, 0, 0xF4, 1, 0, 0]));
    assert_eq!(bench.sdo([0x40, 0x01, 0x10, 0, 0, 0, 0, 0]), Some([0x4F, 0x01, 0x10, 0, 0, 0, 0, 0]));
    assert_eq!(bench.sdo([0x40, 0x18, 0x10, 1, 0, 0, 0, 0]), Some([0x43, 0x18, 0x10, 1, 0x61, 1, 0, 0]));
    assert_eq!(bench.abort([0x40, 0x08, 0x10, 0, 0, 0, 0, 0]), 0x0602_0000);
    assert_eq!(bench.abort([0x40, 0x17, 0x10, 1, 0, 0, 0, 0]), 0x0609_0011);
    assert_eq!(bench.ask(0x601, &[0x40, 0x17, 0x10, 0, 0, 0, 0, 0]), [], "that is another node");
}

// GW-SDO-01, GW-SDO-04, GW-SDO-06, GW-SDO-08, GW-SDO-09, GW-NOTE-23
#[test]
fn other_services_are_unknown() {
    let mut bench = Bench::new(&[]);
    for ccs in [0_u8, 3, 5, 6, 7] {
        for rest in 0..0x20 {
            let request = [ccs << 5 | rest, 0x17, 0x10, 0, 0, 0, 0, 0];
            assert_eq!(bench.abort(request), 0x0504_0001, "{:02X}h", request[0]);
        }
    }
}

// GW-SDO-07
#[test]
fn an_abort_is_not_answered() {
    let mut bench = Bench::new(&[]);
    assert_eq!(bench.sdo([0x80, 0x17, 0x10, 0, 0, 0, 0, 0]), None);
    assert_eq!(bench.read(0x1017, 0), Ok(0));
}

// GW-SDO-10, GW-SDO-02
#[test]
fn only_six_abort_codes_ever() {
    let known = [0x0504_0001, 0x0601_0002, 0x0602_0000, 0x0607_0012, 0x0607_0013, 0x0609_0011];
    let mut seen = std::collections::BTreeSet::new();
    let mut bench = Bench::new(&governor(&[(14401, 1)]));
    for command in 0..=255_u8 {
        for (index, sub_index) in
            [(0x1000_u16, 0), (0x1017, 0), (0x1017, 1), (0x1018, 2), (0x1008, 0), (0x2000, 1)]
        {
            let [low, high] = index.to_le_bytes();
            for length in [0, 1, 2, 4, 5, 0xFF] {
                let answer = bench.sdo([command, low, high, sub_index, length, 0, 0, 0]);
                if let Some([0x80, .., a, b, c, d]) = answer {
                    seen.insert(u32::from_le_bytes([a, b, c, d]));
                }
            }
        }
    }
    assert_eq!(seen.into_iter().collect::<Vec<_>>(), known);
}
