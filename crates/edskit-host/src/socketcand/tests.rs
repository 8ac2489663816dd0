use super::*;
use crate::Received;
use crate::client::Incoming;
use crate::hub::testing::{self, extended, standard};
use crate::hub::{Answer, Dialect};
use edskit_runtime::{Frame, Instant};
use proptest::prelude::*;
use std::time::Duration;

const HANDSHAKE: &[u8] = b"< open can0 >< rawmode >";

/// What the hub answers to pieces of a conversation.
fn answers(pieces: &[&[u8]]) -> Vec<Answer> {
    testing::answers::<Server>(pieces)
}

/// What a client sends in raw mode with these bytes.
fn sent(bytes: &[u8]) -> Vec<Answer> {
    answers(&[HANDSHAKE, bytes]).split_off(2)
}

/// What a client hears.
fn heard(bytes: &[u8]) -> Vec<Incoming> {
    let mut heard = Vec::new();
    Commands::default().feed(bytes, |words| heard.extend(decode(words)));
    heard
}

fn told(time: u64, frame: Frame) -> String {
    let mut out = Vec::new();
    Server::default().encoder()(&Received { time: Instant(time), frame }, &mut out);
    String::from_utf8(out).unwrap()
}

fn said(frame: Frame) -> String {
    let mut out = Vec::new();
    encode(&frame, &mut out);
    String::from_utf8(out).unwrap()
}

#[test]
fn the_handshake_ends_with_a_pause_before_the_first_frame() {
    assert_eq!(Server::default().greeting(), Some(&b"< hi >"[..]));
    assert_eq!(
        answers(&[b"< open can0 >", b"< rawmode >"]),
        [Answer::Reply(b"< ok >"), Answer::Join(b"< ok >", Duration::from_millis(20)),]
    );
}

#[test]
fn raw_mode_begins_once() {
    assert_eq!(sent(b"< rawmode >< open can0 >"), [Answer::Reply(b"< ok >")]);
}

#[test]
fn echo_is_answered_and_unknown_commands_are_not() {
    assert_eq!(sent(b"< echo >"), [Answer::Reply(b"< echo >")]);
    for unknown in
        ["< bcmmode >", "< >", "<>", "< fdsend 1 0 1 aa >", "< statistics 100 >", "< \u{ff} >", "ok > > >"]
    {
        assert_eq!(sent(unknown.as_bytes()), [], "{unknown}");
    }
}

#[test]
fn nothing_is_sent_before_raw_mode() {
    assert_eq!(answers(&[b"< send 123 0  >"]), []);
}

#[test]
fn frames_as_python_can_writes_them() {
    assert_eq!(sent(b"< send 60A 3 1 ab 0 >"), [Answer::Frame(standard(0x60A, &[1, 0xAB, 0]))]);
    assert_eq!(sent(b"< send 080 0  >"), [Answer::Frame(standard(0x80, &[]))]);
    assert_eq!(sent(b"< send 0000060A 1 ff >"), [Answer::Frame(extended(0x60A, &[0xFF]))]);
}

#[test]
fn sign_extended_numbers_are_masked() {
    let wide = b"< send ffffffff98abcdef 2 ffffffffffffff80 7f >";
    assert_eq!(sent(wide), [Answer::Frame(extended(0x18AB_CDEF, &[0x80, 0x7F]))]);
    let longest = format!("< send ffffffff98abcdef 8 {} >", ["ffffffffffffff80"; 8].join(" "));
    assert_eq!(sent(longest.as_bytes()), [Answer::Frame(extended(0x18AB_CDEF, &[0x80; 8]))]);
}

#[test]
fn frames_that_contradict_themselves_are_ignored() {
    for wrong in [
        // python-can's remote frame of length 1.
        "< send 701 1  >",
        "< send 701 2 1 >",
        "< send 701 1 1 2 >",
        "< send 701 9 1 2 3 4 5 6 7 8 9 >",
        "< send 800 0 >",
        "< send xyz 0 >",
        "< send 1 1 g >",
        "< send 1 >",
        "< send >",
        "< send 11111111111111111 0 >",
    ] {
        assert_eq!(sent(wrong.as_bytes()), [], "{wrong}");
    }
}

#[test]
fn a_command_that_is_too_long_is_skipped() {
    let mut bytes = b"< send ".to_vec();
    bytes.extend([b'1'; 100_000]);
    bytes.extend(b" >< send 1 0  >");
    assert_eq!(sent(&bytes), [Answer::Frame(standard(1, &[]))]);
}

#[test]
fn frames_to_the_client() {
    let time = 1_700_000_000_123_456;
    assert_eq!(told(time, standard(0x60A, &[0x11, 0x22, 0x33])), "< frame 60A 1700000000.123456 112233 >");
    assert_eq!(told(5, extended(0x60A, &[0xAB])), "< frame 0000060A 0.000005 AB >");
}

#[test]
fn both_blanks_stay_where_there_is_no_data() {
    assert_eq!(told(1_000_000, standard(0x80, &[])), "< frame 080 1.000000  >");
    assert_eq!(said(standard(0x80, &[])), "< send 080 0  >");
}

#[test]
fn remote_frames_are_not_for_clients() {
    assert!(!Server::default().carries_remote_frames());
}

#[test]
fn the_client_says_frames_as_python_can_does() {
    assert_eq!(said(standard(0x60A, &[1, 0xAB, 0])), "< send 60A 3 1 ab 0 >");
    assert_eq!(said(extended(0x60A, &[0xFF])), "< send 0000060A 1 ff >");
}

#[test]
fn the_client_hears_frames_and_error_frames() {
    let frame = Incoming::Frame(standard(0x60A, &[0x11, 0x22]));
    assert_eq!(heard(b"< frame 60A 1700000000.123456 1122 >"), [frame]);
    assert_eq!(heard(b"< frame 60A 1.5 11 22 >"), [frame]);
    assert_eq!(heard(b"< frame 080 1.000000  >"), [Incoming::Frame(standard(0x80, &[]))]);
    assert_eq!(heard(b"< error 004 1.5 >< error 20000040 1.5 >"), [4, 0x40].map(Incoming::ErrorFrame));
    assert_eq!(
        heard(b"< ok >< error >< frame 1 1.0 123 >< frame 1 1.0 112233445566778899 >< frame 999 1.0 >"),
        []
    );
}

fn any_frame() -> impl Strategy<Value = Frame> {
    let data = proptest::collection::vec(any::<u8>(), 0..=8);
    (any::<bool>(), 0u32..0x2000_0000, data).prop_map(|(is_extended, id, data)| {
        if is_extended { extended(id, &data) } else { standard((id & 0x7FF) as u16, &data) }
    })
}

/// Bytes that look like commands more often than chance would have it.
fn noise() -> impl Strategy<Value = Vec<u8>> {
    let word = prop_oneof![
        Just("<".to_owned()),
        Just(">".to_owned()),
        Just("send".to_owned()),
        Just("frame".to_owned()),
        Just("rawmode".to_owned()),
        Just("open".to_owned()),
        "[0-9a-f]{1,18}",
        "\\PC{0,3}"
    ];
    let words = proptest::collection::vec(word, 0..40).prop_map(|words| words.join(" ").into_bytes());
    prop_oneof![words, proptest::collection::vec(any::<u8>(), 0..300)]
}

proptest! {
    #[test]
    fn any_bytes_in_any_pieces_give_the_same(bytes in noise(), cuts in proptest::collection::vec(0usize..400, 0..8)) {
        let whole = answers(&[HANDSHAKE, &bytes]);
        let mut cuts: Vec<usize> = cuts.into_iter().map(|cut| cut.min(bytes.len())).collect();
        cuts.sort_unstable();
        let mut pieces = vec![HANDSHAKE];
        let mut start = 0;
        for cut in cuts {
            pieces.push(&bytes[start..cut]);
            start = cut;
        }
        pieces.push(&bytes[start..]);
        prop_assert_eq!(&answers(&pieces), &whole);
        heard(&bytes);
    }

    #[test]
    fn every_data_frame_arrives_as_it_was(frame in any_frame(), time: u64) {
        prop_assert_eq!(heard(told(time, frame).as_bytes()), [Incoming::Frame(frame)]);
        prop_assert_eq!(sent(said(frame).as_bytes()), [Answer::Frame(frame)]);
    }
}
