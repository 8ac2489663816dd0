//! U9 of the field reports, and what else a client hears while it waits.

use super::*;
use edskit_types::CanId;

fn heard(frames: &[Frame]) -> (Heard, String) {
    let mut bench = Bench::read(SdoMode::Automatic);
    bench.sent();
    for frame in frames {
        bench.transfer.receive(bench.now, frame);
    }
    bench.wait(1000);
    match bench.result() {
        Err(SdoError::TimedOut { heard }) => (heard, SdoError::TimedOut { heard }.to_string()),
        other => panic!("{other:?}"),
    }
}

fn frame(can_id: u16, data: &[u8]) -> Frame {
    Frame::new(CanId::standard(can_id).unwrap(), data)
}

#[test]
fn what_is_no_sdo_message_is_said() {
    let short = frame(0x585, &[0x4F, 3, 0x20, 1, 5]);
    let (found, text) = heard(&[short]);
    assert_eq!(found, Heard { untaken: Some(short), ..Heard::default() });
    assert_eq!(
        text,
        "no answer in time; what came instead, 4F 03 20 01 05, has 5 bytes, and an SDO message has 8"
    );
    let (_, text) = heard(&[frame(0x585, &[0x80])]);
    assert_eq!(text, "no answer in time; what came instead, 80, has 1 byte, and an SDO message has 8");
    let (_, text) = heard(&[frame(0x585, &[])]);
    assert_eq!(
        text,
        "no answer in time; what came instead is a frame without data, and an SDO message has 8 bytes"
    );
    let (_, text) = heard(&[Frame::remote(channel().response, 8)]);
    assert_eq!(text, "no answer in time; what came instead is a remote frame");
}

#[test]
fn signs_of_the_node_and_of_others() {
    assert_eq!(heard(&[]).0, Heard::default());
    let (found, _) = heard(&[frame(0x705, &[4]), frame(0x185, &[1])]);
    assert_eq!(found, Heard { state: Some(4), is_there: true, ..Heard::default() });
    let (found, _) = heard(&[frame(0x705, &[0x85])]);
    assert_eq!(found.state, Some(5), "guarding has a toggle bit");
    let (found, _) = heard(&[frame(0x705, &[0]), frame(0x705, &[0x7F])]);
    assert!(found.has_booted_up && found.state == Some(0x7F));
    let (found, _) = heard(&[frame(0x085, &[0; 8])]);
    assert!(found.is_there && found.state.is_none());
    for other in [frame(0x706, &[5]), frame(0x080, &[]), frame(0x586, &[0; 8]), frame(0x205, &[1])] {
        assert_eq!(heard(&[other]).0, Heard { has_others: true, ..Heard::default() });
    }
    let asked = Frame::remote(CanId::standard(0x705).unwrap(), 1);
    assert_eq!(heard(&[asked]).0, Heard { has_others: true, ..Heard::default() });
    let request = frame(0x605, &[0x40, 0, 0x10, 0, 0, 0, 0, 0]);
    assert_eq!(heard(&[request]).0, Heard { other_client: Some(request), ..Heard::default() });
}

#[test]
fn a_server_that_falls_silent_has_answered() {
    let mut bench = Bench::read(SdoMode::Automatic);
    bench.sent();
    bench.answer(&[0x41, 3, 0x20, 1, 20]);
    bench.answer(&[0x00, 1, 2, 3, 4, 5, 6, 7]);
    bench.wait(1000);
    assert!(matches!(bench.result(), Err(SdoError::TimedOut { heard: Heard { answers: 2, .. } })));
}

#[test]
fn only_a_default_channel_names_its_node() {
    assert_eq!(channel().node(), NodeId::new(5).ok());
    let other = SdoChannel { request: CanId::standard(0x640).unwrap(), ..channel() };
    assert_eq!(other.node(), None);
}
