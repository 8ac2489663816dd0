//! W13 of the field reports: lengths that the protocol leaves unsaid, in both directions.

use super::*;

#[test]
fn the_type_says_what_a_message_does_not() {
    let frames = [
        // Read in one message; node 9 has no file.
        "605h 40 17 10 00 00 00 00 00",
        "585h 42 17 10 00 2C 01 00 00",
        "609h 40 17 10 00 00 00 00 00",
        "589h 42 17 10 00 2C 01 00 00",
        "605h 40 00 20 00 00 00 00 00",
        "585h 42 00 20 00 01 FF FF FF",
        "605h 40 03 20 00 00 00 00 00",
        "585h 42 03 20 00 41 42 00 00",
        // Said and wrong.
        "605h 40 17 10 00 00 00 00 00",
        "585h 43 17 10 00 2C 01 00 00",
        // Written in one message.
        "605h 22 17 10 00 F4 01 00 00",
        "585h 60 17 10 00 00 00 00 00",
        // In segments: nobody says it, the first message says it, the last segment says it.
        "605h 40 02 20 00 00 00 00 00",
        "585h 40 02 20 00 00 00 00 00",
        "605h 60 00 00 00 00 00 00 00",
        "585h 01 00 00 C0 3F 00 00 00",
        "609h 40 02 20 00 00 00 00 00",
        "589h 41 02 20 00 04 00 00 00",
        "609h 60 00 00 00 00 00 00 00",
        "589h 01 00 00 C0 3F 00 00 00",
        "609h 40 02 20 00 00 00 00 00",
        "589h 40 02 20 00 00 00 00 00",
        "609h 60 00 00 00 00 00 00 00",
        "589h 07 00 00 C0 3F 00 00 00",
        "609h 20 02 20 00 00 00 00 00",
        "589h 60 02 20 00 00 00 00 00",
        "609h 01 00 00 C0 3F 00 00 00",
        "589h 20 00 00 00 00 00 00 00",
        "605h 20 02 20 00 00 00 00 00",
        "585h 60 02 20 00 00 00 00 00",
        "605h 01 00 00 C0 3F 00 00 00",
        "585h 20 00 00 00 00 00 00 00",
        // In blocks the end says it.
        "609h A0 02 20 00 7F 00 00 00",
        "589h C0 02 20 00 00 00 00 00",
        "609h A3 00 00 00 00 00 00 00",
        "589h 81 00 00 C0 3F 00 00 00",
        "609h A2 01 7F 00 00 00 00 00",
        "589h CD 00 00 00 00 00 00 00",
        "609h A1 00 00 00 00 00 00 00",
    ];
    insta::assert_snapshot!(Screen::new().all(&frames));
}

// U8 of the field reports.
#[test]
fn an_abort_may_have_reserved_bits() {
    let frames = [
        "605h 40 17 10 00 00 00 00 00",
        "585h 9F 17 10 00 00 00 02 06",
        "605h 81 17 10 00 00 00 04 05",
        "605h C6 03 20 00 0E 00 00 00",
        "585h A4 03 20 00 7F 00 00 00",
        "605h 01 65 6E 67 69 6E 65 20",
        "605h 9F 03 20 00 00 00 04 05",
        "585h 4B 17 10 00 E8 03 00 00",
    ];
    insta::assert_snapshot!(Screen::new().all(&frames));
}

#[test]
fn json_says_whether_the_length_was_said() {
    let mut screen = Screen::new();
    let mut json = |text: &str| {
        let frame = parse(text);
        let report = Report { time: 1, frame: &frame, message: screen.decoder.decode(&frame) };
        serde_json::to_value(&report).unwrap()
    };
    let unsaid = json("585h 42 17 10 00 2C 01 00 00");
    assert_eq!((&unsaid["value"], &unsaid["bytes"]), (&300.into(), &"2C01".into()));
    assert_eq!(unsaid["length_said"], false);
    let said = json("585h 4B 17 10 00 2C 01 00 00");
    assert_eq!((&said["value"], &said["length_said"]), (&300.into(), &true.into()));
    assert!(json("605h 40 17 10 00 00 00 00 00").get("length_said").is_none());
}
