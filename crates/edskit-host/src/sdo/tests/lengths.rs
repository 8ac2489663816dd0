//! W13 of the field reports: lengths that the protocol leaves unsaid (canopen-python issue 395, ros_canopen issue 317).

use super::*;
use edskit_types::DataType;

/// What comes of these answers to a read in segments.
fn read(answers: &[&[u8]]) -> Result<SdoValue, SdoError> {
    let mut bench = Bench::read(SdoMode::Automatic);
    bench.sent();
    for answer in answers {
        bench.answer(answer);
    }
    bench.result()
}

#[test]
fn expedited() {
    let unsaid = read(&[&[0x42, 3, 0x20, 1, 0x2C, 1]]).unwrap();
    assert_eq!(unsaid, SdoValue { bytes: vec![0x2C, 1, 0, 0], unsure: 3 });
    assert_eq!(unsaid.of_type(DataType::Unsigned16), [0x2C, 1]);
    assert_eq!(unsaid.of_type(DataType::Boolean), [0x2C]);
    assert_eq!(unsaid.of_type(DataType::Unsigned64), [0x2C, 1, 0, 0], "and it has eight");
    // Where the length is not said, the bits for it have no meaning.
    assert_eq!(read(&[&[0x4E, 3, 0x20, 1, 0x2C, 1]]).unwrap(), unsaid);
    let said = read(&[&[0x43, 3, 0x20, 1, 0x2C, 1]]).unwrap();
    assert_eq!(said, SdoValue::new(vec![0x2C, 1, 0, 0]));
    assert_eq!(said.of_type(DataType::Unsigned16), [0x2C, 1, 0, 0], "the server's fault stays visible");
}

#[test]
fn segments() {
    let first = [0x00, 1, 2, 3, 4, 5, 6, 7];
    // Neither the whole nor the last segment.
    let unsaid = read(&[&[0x40, 3, 0x20, 1], &first, &[0x11, 8, 0, 0, 0, 0, 0, 0]]).unwrap();
    assert_eq!((unsaid.len(), unsaid.unsure), (14, 6));
    assert_eq!(unsaid.of_type(DataType::Unsigned64), [1, 2, 3, 4, 5, 6, 7, 8]);
    assert_eq!(unsaid.of_type(DataType::VisibleString), [1, 2, 3, 4, 5, 6, 7, 8]);
    assert_eq!(unsaid.of_type(DataType::Domain).len(), 14);
    // One of both.
    let last_says = read(&[&[0x40, 3, 0x20, 1], &first, &[0x1D, 8]]).unwrap();
    assert_eq!(last_says, SdoValue::new(vec![1, 2, 3, 4, 5, 6, 7, 8]));
    let first_says = read(&[&[0x41, 3, 0x20, 1, 8], &first, &[0x11, 8, 0, 0, 0, 0, 0, 0]]).unwrap();
    assert_eq!(first_says, last_says);
    let exact = read(&[&[0x41, 3, 0x20, 1, 7], &[0x01, 1, 2, 3, 4, 5, 6, 7]]).unwrap();
    assert_eq!(exact, SdoValue::new(vec![1, 2, 3, 4, 5, 6, 7]));
    // A number in one segment.
    let number = read(&[&[0x40, 3, 0x20, 1], &[0x01, 0x2C, 1, 0xFF, 0xFF, 0, 0, 0]]).unwrap();
    assert_eq!(number.of_type(DataType::Unsigned16), [0x2C, 1]);
    // Eight bytes fewer than came cannot be what the first answer meant.
    let wrong = read(&[&[0x41, 3, 0x20, 1, 7], &first, &[0x11, 8, 0, 0, 0, 0, 0, 0]]);
    assert!(matches!(wrong, Err(SdoError::GivenUp { code: AbortCode::LENGTH_TOO_HIGH, .. })));
}

#[test]
fn blocks_say_it_at_their_end() {
    let mut crc = Crc::new();
    crc.update(&[1, 2, 3]);
    let [low, high] = crc.value().to_le_bytes();
    let mut bench = Bench::read(SdoMode::Block);
    bench.sent();
    for answer in [&[0xC4, 3, 0x20, 1][..], &[0x81, 1, 2, 3], &[0xD1, low, high]] {
        bench.answer(answer);
    }
    assert_eq!(bench.result().unwrap(), SdoValue::new(vec![1, 2, 3]));
}

#[test]
fn the_limit_holds_for_the_value_and_not_for_its_filling() {
    let mut bench =
        Bench::read_with(SdoOptions { mode: SdoMode::Segmented, most_bytes: 10, ..SdoOptions::default() });
    bench.sent();
    for answer in [&[0x41, 3, 0x20, 1, 10][..], &[0x00, 1], &[0x11, 2]] {
        bench.answer(answer);
    }
    assert_eq!(bench.result().unwrap().len(), 10);
}
