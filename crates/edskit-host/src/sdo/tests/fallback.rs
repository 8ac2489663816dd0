//! W16 of the field reports: servers without blocks (canopen-python issue 559).

use super::*;

const VALUE: [u8; 300] = [7; 300];
/// "300 bytes", and what a client asks that wants them in segments.
const LONG: [u8; 6] = [0x41, 3, 0x20, 1, 44, 1];
const READ: [u8; 8] = [0x40, 3, 0x20, 1, 0, 0, 0, 0];
const WRITE: [u8; 8] = [0x21, 3, 0x20, 1, 44, 1, 0, 0];
const BROKEN_OFF: u32 = 0x0504_0001;

/// A read for which the client has just asked for blocks.
fn asked_to_read() -> Bench {
    let mut bench = Bench::read(SdoMode::Automatic);
    bench.sent();
    let requests = bench.answer(&LONG);
    assert_eq!(requests, [abort(0x0800_0000), vec![0xA4, 3, 0x20, 1, 127, 0, 0, 0]]);
    bench
}

fn asked_to_write() -> Bench {
    let mut bench = Bench::write(SdoMode::Automatic, &VALUE);
    assert_eq!(bench.sent(), [[0xC6, 3, 0x20, 1, 44, 1, 0, 0]]);
    bench
}

/// The server serves a transfer in segments to its end.
fn reads_in_segments(mut bench: Bench) {
    assert_eq!(bench.answer(&LONG), [[0x60, 0, 0, 0, 0, 0, 0, 0]]);
    for number in 0..42_u8 {
        let next = bench.answer(&[(number & 1) << 4, 7, 7, 7, 7, 7, 7, 7]);
        assert_eq!(next, [[0x60 | (!number & 1) << 4, 0, 0, 0, 0, 0, 0, 0]]);
    }
    assert!(bench.answer(&[0x03, 7, 7, 7, 7, 7, 7]).is_empty());
    assert_eq!(bench.result().unwrap(), VALUE);
}

fn writes_in_segments(mut bench: Bench) {
    let mut next = bench.answer(&[0x60, 3, 0x20, 1]);
    let mut count = 0;
    while let Some(segment) = next.pop() {
        count += 7 - usize::from(segment[0] >> 1 & 7);
        next = bench.answer(&[0x20 | segment[0] & 0x10]);
    }
    assert_eq!(count, VALUE.len());
    bench.result().unwrap();
}

#[test]
fn whatever_code_refuses_blocks() {
    let codes =
        [0x0504_0001, 0x0504_0000, 0x0504_0002, 0x0503_0000, 0x0601_0000, 0x0800_0000, 0x0800_0020, 0];
    for code in codes {
        let mut bench = asked_to_read();
        assert_eq!(bench.answer(&abort(code)), [READ], "{code:08X}h");
        reads_in_segments(bench);
        let mut bench = asked_to_write();
        assert_eq!(bench.answer(&abort(code)), [WRITE], "{code:08X}h");
        writes_in_segments(bench);
    }
    // That the entry can be read has been seen, so even this one means the blocks.
    let mut bench = asked_to_read();
    assert_eq!(bench.answer(&abort(0x0602_0000)), [READ]);
    reads_in_segments(bench);
    // Of what is written nothing was seen yet.
    for code in [0x0601_0002, 0x0602_0000, 0x0609_0011, 0x0609_0030] {
        let mut bench = asked_to_write();
        assert!(bench.answer(&abort(code)).is_empty());
        assert!(matches!(bench.result(), Err(SdoError::Aborted(AbortCode(end))) if end == code));
    }
}

#[test]
fn an_ordinary_answer_to_a_request_for_blocks() {
    for answer in [&LONG[..], &[0x40, 3, 0x20, 1], &[0x43, 3, 0x20, 1, 1, 2, 3, 4], &[0x60, 3, 0x20, 1]] {
        let mut bench = asked_to_read();
        assert_eq!(bench.answer(answer), [abort(BROKEN_OFF), READ.to_vec()], "{answer:02X?}");
        reads_in_segments(bench);
        let mut bench = asked_to_write();
        assert_eq!(bench.answer(answer), [abort(BROKEN_OFF), WRITE.to_vec()], "{answer:02X?}");
        writes_in_segments(bench);
    }
    // About another entry it is the answer to something else.
    let mut bench = asked_to_read();
    assert!(bench.answer(&[0x41, 4, 0x20, 1, 44, 1]).is_empty());
    assert_eq!(bench.answer(&[0xC6, 3, 0x20, 1, 44, 1]), [[0xA3, 0, 0, 0, 0, 0, 0, 0]]);
}

#[test]
fn a_first_answer_that_comes_twice_costs_the_blocks_and_nothing_else() {
    let mut bench = asked_to_read();
    bench.answer(&LONG);
    assert!(
        bench.answer(&[0xC6, 3, 0x20, 1, 44, 1]).is_empty(),
        "the answer to the request for blocks is late"
    );
    reads_in_segments(bench);
}

#[test]
fn silence_and_nonsense() {
    let mut bench = asked_to_read();
    assert!(bench.wait(999).is_empty());
    assert_eq!(bench.wait(1), [abort(0x0504_0000), READ.to_vec()]);
    reads_in_segments(bench);
    let mut bench = asked_to_write();
    assert_eq!(bench.wait(1000), [abort(0x0504_0000), WRITE.to_vec()]);
    writes_in_segments(bench);
    // If that is not answered either, it is over.
    let mut bench = asked_to_write();
    bench.wait(1000);
    assert!(bench.wait(999).is_empty());
    assert_eq!(bench.wait(1), [abort(0x0504_0000)]);
    assert_eq!(bench.error(), "no answer in time");
    // A reserved command, and blocks of no segments.
    let mut bench = asked_to_read();
    assert_eq!(bench.answer(&[0xE0]), [abort(BROKEN_OFF), READ.to_vec()]);
    reads_in_segments(bench);
    let mut bench = asked_to_write();
    assert_eq!(bench.answer(&[0xA4, 3, 0x20, 1, 0]), [abort(0x0504_0002), WRITE.to_vec()]);
    writes_in_segments(bench);
}

#[test]
fn a_server_that_begins_blocks_and_cannot_go_on() {
    let begun_to_read = || {
        let mut bench = asked_to_read();
        bench.answer(&[0xC6, 3, 0x20, 1, 44, 1]);
        bench
    };
    assert_eq!(begun_to_read().answer(&abort(BROKEN_OFF)), [READ]);
    assert_eq!(begun_to_read().wait(1000), [abort(0x0504_0000), READ.to_vec()]);
    // It goes on as if segments had been asked for.
    let mut bench = begun_to_read();
    assert!(bench.answer(&[0x00, 7, 7, 7, 7, 7, 7, 7]).is_empty());
    assert_eq!(bench.wait(1000), [abort(0x0504_0000), READ.to_vec()]);
    reads_in_segments(bench);
    // Its checksums are not those of CiA 301.
    let mut bench = begun_to_read();
    for number in 1..43 {
        bench.answer(&[number, 7, 7, 7, 7, 7, 7, 7]);
    }
    bench.answer(&[0x80 | 43, 7, 7, 7, 7, 7, 7]);
    assert_eq!(bench.answer(&[0xC5, 0, 0]), [abort(0x0504_0004), READ.to_vec()]);
    reads_in_segments(bench);

    let begun_to_write = || {
        let mut bench = asked_to_write();
        assert_eq!(bench.answer(&[0xA4, 3, 0x20, 1, 127]).len(), 43);
        bench
    };
    assert_eq!(begun_to_write().answer(&abort(BROKEN_OFF)), [WRITE]);
    assert_eq!(begun_to_write().wait(1000), [abort(0x0504_0000), WRITE.to_vec()]);
    assert_eq!(begun_to_write().answer(&[0xA2, 44, 127]), [abort(0x0504_0003), WRITE.to_vec()]);
    let mut bench = begun_to_write();
    bench.answer(&[0xA2, 43, 127]);
    assert_eq!(bench.answer(&abort(0x0504_0004)), [WRITE]);
    writes_in_segments(bench);
    // A server that has taken the blocks has something against the value, or is busy with it.
    for answer in [abort(0x0609_0030), abort(0x0800_0020)] {
        let mut bench = begun_to_write();
        bench.answer(&[0xA2, 43, 127]);
        assert!(bench.answer(&answer).is_empty());
        bench.result().unwrap_err();
    }
    let mut bench = begun_to_write();
    bench.answer(&[0xA2, 43, 127]);
    assert_eq!(bench.wait(1000), [abort(0x0504_0000)]);
}

#[test]
fn who_asks_for_blocks_gets_blocks_or_an_error() {
    let mut bench = Bench::read(SdoMode::Block);
    bench.sent();
    assert!(bench.answer(&LONG).is_empty());
    bench.wait(1000);
    assert_eq!(
        bench.error(),
        "no answer in time; the last message, 41 03 20 01 2C 01 00 00, is not the answer to this request"
    );
    let mut bench = Bench::read(SdoMode::Block);
    bench.sent();
    bench.answer(&abort(BROKEN_OFF));
    assert!(matches!(bench.result(), Err(SdoError::Aborted(AbortCode::UNKNOWN_COMMAND))));
}

#[test]
fn a_server_that_answers_aborts_with_aborts() {
    // The abort that the client sends is answered, and then the request behind it.
    let mut bench = asked_to_read();
    bench.answer(&LONG);
    assert!(bench.answer(&abort(BROKEN_OFF)).is_empty());
    reads_in_segments(bench);
    let mut bench = asked_to_write();
    bench.wait(1000);
    assert!(bench.answer(&abort(BROKEN_OFF)).is_empty());
    writes_in_segments(bench);
    // Where nothing else comes, it was the answer to the request; and it is not answered.
    let mut bench = asked_to_write();
    bench.wait(1000);
    bench.answer(&abort(0x0602_0000));
    assert!(bench.wait(1000).is_empty());
    assert!(matches!(bench.result(), Err(SdoError::Aborted(AbortCode::OBJECT_DOES_NOT_EXIST))));
    // A second one is.
    let mut bench = asked_to_write();
    bench.wait(1000);
    bench.answer(&abort(BROKEN_OFF));
    assert!(bench.answer(&abort(0x0602_0000)).is_empty());
    assert!(matches!(bench.result(), Err(SdoError::Aborted(AbortCode::OBJECT_DOES_NOT_EXIST))));
    // The answer to what the client has broken off may be on its way when it asks for segments.
    let mut bench = asked_to_write();
    assert_eq!(bench.answer(&abort(0x0800_0000)), [WRITE]);
    assert!(bench.answer(&abort(0x0601_0002)).is_empty());
    assert!(matches!(bench.result(), Err(SdoError::Aborted(AbortCode::READ_ONLY))));
}
