use super::*;
use edskit_host::sdo::SdoValue;
use edskit_types::NodeId;

fn bytes(data_type: DataType, text: &str) -> Vec<u8> {
    bytes_of(data_type, text, NodeId::new(5).unwrap()).unwrap()
}

fn error(data_type: DataType, text: &str) -> String {
    bytes_of(data_type, text, NodeId::MIN).unwrap_err()
}

#[test]
fn what_is_written_is_read_back() {
    let cases = [
        (DataType::Boolean, "true", "1 (true)"),
        (DataType::Unsigned8, "0xFF", "255 (FFh)"),
        (DataType::Unsigned32, "$NODEID+0x180", "389 (00000185h)"),
        (DataType::Unsigned40, "1", "1 (0000000001h)"),
        (DataType::Unsigned64, "18446744073709551615", "18446744073709551615 (FFFFFFFFFFFFFFFFh)"),
        (DataType::Integer8, "-100", "-100 (-64h)"),
        (DataType::Integer24, "0x7FFFFF", "8388607 (7FFFFFh)"),
        (DataType::Integer64, "-9223372036854775808", "-9223372036854775808 (-8000000000000000h)"),
        (DataType::Real32, "0.1", "0.1"),
        (DataType::Real64, "-1.5e3", "-1500"),
        (DataType::VisibleString, " a\u{1b}b", "\" a\u{241b}b\""),
        (DataType::UnicodeString, "gr\u{fc}n", "\"gr\u{fc}n\""),
        (DataType::OctetString, "0x0a 0B", "0A 0B"),
        (DataType::Domain, "", ""),
        (DataType::TimeOfDay, "2026-11-22 07:30", "2026-11-22 07:30:00.000"),
        (DataType::TimeOfDay, "0x000100000002", "1984-01-02 00:00:00.002"),
        (DataType::TimeDifference, "0x000100000002", "1 day and 2 ms"),
    ];
    for (data_type, written, shown) in cases {
        assert_eq!(text(data_type, &bytes(data_type, written)), shown);
    }
}

#[test]
fn mistakes_say_what_is_expected() {
    assert_eq!(error(DataType::Unsigned8, "256"), "`256` is no UNSIGNED8: 256 is not in 0..255");
    assert_eq!(error(DataType::Integer16, "abc"), "`abc` is no INTEGER16: `a` is not a digit");
    assert_eq!(error(DataType::Real32, "1,5"), "`1,5` is no REAL32: this is not a real number");
    assert_eq!(error(DataType::OctetString, "0A1"), {
        "`0A1` is no row of bytes: every octet needs two hexadecimal digits"
    });
    assert_eq!(
        error(DataType::TimeOfDay, "2026-02-30"),
        "`2026-02-30` is no TIME_OF_DAY: expected a date from 1984-01-01 to 2163-06-06 as in 2026-11-22 07:30:00.000"
    );
}

#[test]
fn other_lengths_are_shown_as_they_are() {
    assert_eq!(text(DataType::Unsigned32, &[1, 2]), "01 02 (2 bytes, but UNSIGNED32 has 4)");
    assert_eq!(text(DataType::Boolean, &[2]), "02 (neither 0 nor 1)");
    assert_eq!(untyped(&[]), "(no bytes)");
    assert_eq!(untyped(&[0xE8, 3]), "E8 03 (1000)");
    assert_eq!(untyped(&[1, 2, 3]), "01 02 03");
}

#[test]
fn what_a_server_leaves_unsaid_the_type_says() {
    let shown =
        |data_type, bytes: &[u8], unsure| said(data_type, &SdoValue { bytes: bytes.to_vec(), unsure });
    let expedited = |data_type| shown(data_type, &[0x2C, 1, 0, 0], 3);
    assert_eq!(expedited(Some(DataType::Unsigned16)), "300 (012Ch)");
    assert_eq!(expedited(Some(DataType::Integer24)), "300 (00012Ch)");
    assert_eq!(expedited(Some(DataType::Unsigned32)), "300 (0000012Ch)");
    assert_eq!(expedited(Some(DataType::Unsigned8)), "44 (2Ch)");
    assert_eq!(expedited(Some(DataType::OctetString)), "2C 01 00 00 (the length is not said)");
    assert_eq!(expedited(None), "2C 01 00 00 (300) (the length is not said)");
    assert_eq!(shown(Some(DataType::Boolean), &[1, 0, 0, 0], 3), "1 (true)");
    assert_eq!(shown(Some(DataType::VisibleString), b"AB\0\0", 3), "\"AB\"");
    assert_eq!(shown(Some(DataType::TimeDifference), &[2, 0, 0, 0, 1, 0, 0], 6), "1 day and 2 ms");
    // Where it is said and wrong, or cannot be that of the type.
    assert_eq!(
        shown(Some(DataType::Unsigned16), &[0x2C, 1, 0, 0], 0),
        "2C 01 00 00 (4 bytes, but UNSIGNED16 has 2)"
    );
    assert_eq!(
        expedited(Some(DataType::Unsigned64)),
        "2C 01 00 00 (4 bytes, but UNSIGNED64 has 8) (the length is not said)"
    );
}

#[test]
fn programs_get_numbers() {
    assert_eq!(json(DataType::Integer16, &[0x9C, 0xFF]), -100);
    assert_eq!(json(DataType::Unsigned64, &[0xFF; 8]), u64::MAX);
    assert_eq!(json(DataType::Real32, &0.1_f32.to_le_bytes()), 0.1);
    assert_eq!(json(DataType::Real32, &f32::NAN.to_le_bytes()), "NaN");
    assert_eq!(json(DataType::Domain, &[1, 0xAB]), "01AB");
    assert_eq!(json(DataType::VisibleString, b"ab\0\0"), "ab");
}

#[test]
fn types_have_short_names_and_those_of_the_standard() {
    assert_eq!("u16".parse(), Ok(ValueType(DataType::Unsigned16)));
    assert_eq!("unsigned16".parse(), Ok(ValueType(DataType::Unsigned16)));
    assert_eq!("VISIBLE_STRING".parse(), Ok(ValueType(DataType::VisibleString)));
    assert!("float".parse::<ValueType>().is_err());
}
