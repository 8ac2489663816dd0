use super::*;
use crate::Received;
use crate::hub::testing::{self, extended, standard};
use crate::hub::{Answer, Dialect};
use edskit_runtime::{Frame, Instant};
use edskit_types::CanId;
use proptest::prelude::*;
use std::time::Duration;

const OK: Answer = Answer::Reply(b"\r");
const JOIN: Answer = Answer::Join(b"\r", Duration::ZERO);
const ERROR: Answer = Answer::Reply(b"\x07");

/// What the hub answers to pieces of a conversation.
fn answers(pieces: &[&[u8]]) -> Vec<Answer> {
    testing::answers::<Server>(pieces)
}

/// What follows from bytes on an open channel.
fn sent(bytes: &[u8]) -> Vec<Answer> {
    answers(&[b"O\r", bytes]).split_off(1)
}

fn told(frame: Frame) -> String {
    let mut out = Vec::new();
    Server::default().encoder()(&Received { time: Instant(7), frame }, &mut out);
    String::from_utf8(out).unwrap()
}

#[test]
fn opening_and_closing() {
    assert_eq!(answers(&[b"O\rC\rL\r"]), [JOIN, Answer::Leave, OK, JOIN]);
}

#[test]
fn settings_are_accepted_and_mean_nothing() {
    for accepted in ["\r", "S0\r", "S8\r", "S9\r", "s001C\r", "\n\r"] {
        assert_eq!(answers(&[accepted.as_bytes()]), [OK], "{accepted:?}");
    }
    let replies = [b"V1013\r".as_slice(), b"NA001\r", b"F00\r"].map(Answer::Reply);
    assert_eq!(answers(&[b"V\rN\rF\r"]), replies);
}

#[test]
fn what_is_not_understood_gets_a_bell() {
    for wrong in ["S\r", "SA\r", "s123\r", "s12345\r", "X\r", "Z1\r", "OO\r", "\u{e9}\r"] {
        assert_eq!(sent(wrong.as_bytes()), [ERROR], "{wrong:?}");
    }
}

#[test]
fn frames_and_their_answers() {
    let yes = [Answer::Reply(b"z\r"), Answer::Reply(b"Z\r")];
    let id = CanId::standard(0x701).unwrap();
    assert_eq!(sent(b"t60A311aB00\r"), [Answer::Frame(standard(0x60A, &[0x11, 0xAB, 0])), yes[0]]);
    assert_eq!(sent(b"t0800\r"), [Answer::Frame(standard(0x80, &[])), yes[0]]);
    assert_eq!(sent(b"T0000060A1FF\r"), [Answer::Frame(extended(0x60A, &[0xFF])), yes[1]]);
    assert_eq!(sent(b"r7011\r"), [Answer::Frame(Frame::remote(id, 1)), yes[0]]);
    let remote = Frame::remote(CanId::extended(0x1FFF_FFFF).unwrap(), 8);
    assert_eq!(sent(b"R1FFFFFFF8\r"), [Answer::Frame(remote), yes[1]]);
}

#[test]
fn a_time_stamp_behind_a_frame_is_ignored() {
    assert_eq!(sent(b"t1231AA0F3C\r")[0], Answer::Frame(standard(0x123, &[0xAA])));
    assert_eq!(sent(b"r12320F3C\r")[0], Answer::Frame(Frame::remote(CanId::standard(0x123).unwrap(), 2)));
}

#[test]
fn frames_that_are_none_get_a_bell() {
    for wrong in
        ["t", "t12", "t123", "t1239", "t123F", "t1231A", "t1231AG", "t8000", "T200000000", "r1239", "t+230"]
    {
        assert_eq!(sent(format!("{wrong}\r").as_bytes()), [ERROR], "{wrong}");
    }
    let endless = [b"t1231".as_slice(), &[b'A'; 10_000], b"\rt0800\r"].concat();
    assert_eq!(sent(&endless), [ERROR, Answer::Frame(standard(0x80, &[])), Answer::Reply(b"z\r")]);
}

#[test]
fn who_is_closed_or_only_listens_cannot_send() {
    assert_eq!(answers(&[b"t0800\r"]), [ERROR]);
    assert_eq!(answers(&[b"L\rt0800\r"]), [JOIN, ERROR]);
    assert_eq!(answers(&[b"O\rC\rt0800\r"]).last(), Some(&ERROR));
}

#[test]
fn a_bell_from_the_client_is_no_question() {
    assert_eq!(sent(b"\x07\x07"), []);
}

#[test]
fn frames_to_the_client() {
    assert_eq!(told(standard(0x60A, &[0x11, 0xAB])), "t60A211AB\r");
    assert_eq!(told(extended(0x60A, &[])), "T0000060A0\r");
    assert_eq!(told(Frame::remote(CanId::standard(0x701).unwrap(), 1)), "r7011\r");
    assert_eq!(told(Frame::remote(CanId::extended(0x701).unwrap(), 0)), "R000007010\r");
    assert!(Server::default().carries_remote_frames());
}

fn any_frame() -> impl Strategy<Value = Frame> {
    let data = proptest::collection::vec(any::<u8>(), 0..=8);
    (any::<bool>(), any::<bool>(), 0u32..0x2000_0000, data).prop_map(|(is_extended, is_remote, id, data)| {
        let id =
            if is_extended { CanId::extended(id) } else { CanId::standard((id & 0x7FF) as u16) }.unwrap();
        if is_remote { Frame::remote(id, data.len() as u8) } else { Frame::new(id, &data) }
    })
}

/// Bytes that look like lines more often than chance would have it.
fn noise() -> impl Strategy<Value = Vec<u8>> {
    let line =
        prop_oneof!["[tTrROLCSsVNFZ][0-9A-Fa-f]{0,40}", "t[0-9A-F]{3}[0-9][0-9A-F]{0,16}", "\\PC{0,3}"];
    let end = prop_oneof![Just("\r"), Just("\x07"), Just("\n"), Just("")];
    let lines = proptest::collection::vec((line, end), 0..20);
    let lines = lines
        .prop_map(|lines| lines.into_iter().map(|(line, end)| line + end).collect::<String>().into_bytes());
    prop_oneof![lines, proptest::collection::vec(any::<u8>(), 0..300)]
}

proptest! {
    #[test]
    fn any_bytes_in_any_pieces_give_the_same(bytes in noise(), cut in 0usize..400, other in 0usize..400) {
        let (first, second) = (cut.min(other).min(bytes.len()), cut.max(other).min(bytes.len()));
        let pieces = [&b"O\r"[..], &bytes[..first], &bytes[first..second], &bytes[second..]];
        prop_assert_eq!(answers(&pieces), answers(&[b"O\r", &bytes]));
        let single: Vec<&[u8]> = bytes.chunks(1).collect();
        prop_assert_eq!(answers(&single), answers(&[&bytes]));
    }

    #[test]
    fn every_frame_arrives_as_it_was(frame in any_frame()) {
        let line = told(frame);
        prop_assert_eq!(decode(line.trim_end().as_bytes()), Some(frame));
        prop_assert_eq!(sent(line.as_bytes())[0], Answer::Frame(frame));
    }
}
