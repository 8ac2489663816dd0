use super::*;
use proptest::prelude::*;

fn parse(data_type: DataType, text: &str) -> Value<'_> {
    Value::parse(data_type, text.as_bytes()).unwrap()
}

fn error(data_type: DataType, text: &str) -> ValueErrorKind {
    Value::parse(data_type, text.as_bytes()).unwrap_err().kind
}

#[test]
fn integers_are_checked_against_their_type() {
    let integer = |data_type, text| parse(data_type, text).integer(data_type, None);
    assert_eq!(integer(DataType::Unsigned8, "255"), Ok(255));
    assert_eq!(integer(DataType::Unsigned8, "300"), Err(EvaluationError::OutOfRange(300)));
    assert_eq!(integer(DataType::Unsigned8, "-1"), Err(EvaluationError::OutOfRange(-1)));
    assert_eq!(integer(DataType::Integer16, "0xFF9C"), Ok(-100));
    assert_eq!(integer(DataType::Integer16, "-0x80"), Ok(-128));
    assert_eq!(integer(DataType::Integer24, "0x800000"), Ok(-8_388_608));
    assert_eq!(integer(DataType::Unsigned64, "0xFFFFFFFFFFFFFFFF"), Ok(i128::from(u64::MAX)));
}

#[test]
fn formulas_stay_symbolic_until_a_node_id_is_given() {
    let value = parse(DataType::Unsigned8, "$NODEID+0xF0");
    assert_eq!(value.integer(DataType::Unsigned8, None), Err(EvaluationError::NodeIdNeeded));
    assert_eq!(value.integer(DataType::Unsigned8, NodeId::new(2).ok()), Ok(0xF2));
    assert_eq!(
        value.integer(DataType::Unsigned8, NodeId::new(127).ok()),
        Err(EvaluationError::OutOfRange(0x16F))
    );
}

#[test]
fn booleans_are_0_or_1() {
    assert_eq!(parse(DataType::Boolean, "0x1"), Value::Boolean(true));
    assert_eq!(error(DataType::Boolean, "2"), ValueErrorKind::NotBoolean);
    assert_eq!(error(DataType::Boolean, "true"), ValueErrorKind::Number(NumberErrorKind::Digit(b't')));
}

#[test]
fn reals_are_decimal_or_bits() {
    assert_eq!(parse(DataType::Real32, "-1.5e3"), Value::Real(-1500.0));
    assert_eq!(parse(DataType::Real32, "0x3F800000").real(DataType::Real32), Some(1.0));
    assert_eq!(parse(DataType::Real64, "0x3FF0000000000000").real(DataType::Real64), Some(1.0));
    assert_eq!(error(DataType::Real32, "0x3FF0000000000000"), ValueErrorKind::NotReal);
    assert_eq!(error(DataType::Real32, "1,5"), ValueErrorKind::NotReal);
    assert_eq!(error(DataType::Real32, "$NODEID+1"), ValueErrorKind::NotReal);
}

#[test]
fn octets_are_pairs_of_digits() {
    let Value::Octets(digits) = parse(DataType::OctetString, "00fF1a") else { panic!("octets") };
    assert_eq!(octets(digits).collect::<Vec<_>>(), [0x00, 0xFF, 0x1A]);
    assert_eq!(error(DataType::OctetString, "0A1"), ValueErrorKind::OddDigits);
    assert_eq!(error(DataType::Domain, "0x1A"), ValueErrorKind::NotHex(b'x'));
}

#[test]
fn times_are_48_bits() {
    let time = Value::Time { days: 1, milliseconds: 2 };
    assert_eq!(parse(DataType::TimeOfDay, "0x000100000002"), time);
    assert_eq!(parse(DataType::TimeDifference, "020000000100"), time);
    assert_eq!(error(DataType::TimeOfDay, "0x1000000000000"), ValueErrorKind::NotTime);
    let noon = Value::Time { days: 365, milliseconds: 43_200_000 };
    assert_eq!(parse(DataType::TimeOfDay, "365 43200000"), noon);
    assert_eq!(parse(DataType::TimeDifference, "0x16D \t 0x2932E00"), noon);
    let most = Value::Time { days: 65535, milliseconds: 268_435_455 };
    assert_eq!(parse(DataType::TimeDifference, "65535 268435455"), most);
    for wrong in ["65536 0", "0 268435456", "-1 0", "1 2 3", "12:30 0", "1 day"] {
        assert_eq!(error(DataType::TimeOfDay, wrong), ValueErrorKind::NotTime, "{wrong}");
    }
}

#[test]
fn types_beyond_cia_301_take_numbers_and_bits() {
    assert!(matches!(Value::parse_untyped(b"0x10"), Ok(Value::Integer(_))));
    assert!(matches!(Value::parse_untyped(b"0101101"), Ok(Value::Integer(_))));
    assert!(matches!(Value::parse_untyped(b"01011010"), Ok(Value::Bits(_))));
    assert_eq!(Value::parse_untyped(b"hello").unwrap_err().kind, ValueErrorKind::UnknownType);
}

proptest! {
    #[test]
    fn no_text_of_no_type_panics(text in "[$NODEID0-9a-fxX+ .,-]{0,30}", position in 0..DataType::ALL.len()) {
        let data_type = DataType::ALL[position];
        if let Ok(value) = Value::parse(data_type, text.as_bytes()) {
            let _ = value.integer(data_type, NodeId::new(127).ok());
            let _ = value.real(data_type);
        }
    }
}
