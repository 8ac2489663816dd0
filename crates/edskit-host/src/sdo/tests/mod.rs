mod fallback;
mod heard;
mod lengths;

use super::*;
use edskit_runtime::{Crc, Frame, Instant, Microseconds};
use edskit_types::{AbortCode, Index, NodeId, SubIndex};

const INDEX: Index = Index(0x2003);
const SUB_INDEX: SubIndex = SubIndex(1);

fn channel() -> SdoChannel {
    SdoChannel::of_node(NodeId::new(5).unwrap())
}

/// A transfer in the hands of a test that plays the server.
struct Bench {
    transfer: Transfer,
    now: Instant,
}

impl Bench {
    fn read(mode: SdoMode) -> Self {
        Self::read_with(SdoOptions { mode, ..SdoOptions::default() })
    }

    fn read_with(options: SdoOptions) -> Self {
        let now = Instant(1_000);
        Self { transfer: Transfer::read(channel(), INDEX, SUB_INDEX, options, now), now }
    }

    fn write(mode: SdoMode, data: &[u8]) -> Self {
        let (now, options) = (Instant(1_000), SdoOptions { mode, ..SdoOptions::default() });
        Self { transfer: Transfer::write(channel(), INDEX, SUB_INDEX, data, options, now), now }
    }

    /// What the client sends now.
    fn sent(&mut self) -> Vec<Vec<u8>> {
        let frames = std::iter::from_fn(|| self.transfer.transmit(self.now));
        frames.map(|frame| frame.data().to_vec()).collect()
    }

    /// So many frames that the client sends now.
    fn some_sent(&mut self, count: usize) -> Vec<Vec<u8>> {
        (0..count)
            .map(|_| self.transfer.transmit(self.now).expect("there is more to send").data().to_vec())
            .collect()
    }

    /// The server answers with these bytes and zeros, and the client sends what it wants.
    fn answer(&mut self, data: &[u8]) -> Vec<Vec<u8>> {
        let mut message = [0; 8];
        message[..data.len()].copy_from_slice(data);
        self.transfer.receive(self.now, &Frame::new(channel().response, &message));
        self.sent()
    }

    fn wait(&mut self, milliseconds: u32) -> Vec<Vec<u8>> {
        self.now = self.now + Microseconds::from_milliseconds(milliseconds);
        self.transfer.poll(self.now);
        self.sent()
    }

    fn result(&mut self) -> Result<SdoValue, SdoError> {
        self.transfer.result().expect("the transfer has ended")
    }

    fn error(&mut self) -> String {
        self.result().unwrap_err().to_string()
    }
}

fn abort(code: u32) -> Vec<u8> {
    let [a, b, c, d] = code.to_le_bytes();
    vec![0x80, 3, 0x20, 1, a, b, c, d]
}

#[test]
fn expedited() {
    let mut bench = Bench::read(SdoMode::Automatic);
    assert_eq!(bench.sent(), [[0x40, 3, 0x20, 1, 0, 0, 0, 0]]);
    assert!(bench.answer(&[0x4B, 3, 0x20, 1, 0x34, 0x12]).is_empty());
    assert_eq!(bench.result().unwrap(), [0x34, 0x12]);

    let mut bench = Bench::write(SdoMode::Automatic, &[1, 2, 3]);
    assert_eq!(bench.sent(), [[0x27, 3, 0x20, 1, 1, 2, 3, 0]]);
    assert!(bench.answer(&[0x60, 3, 0x20, 1]).is_empty());
    assert!(bench.result().unwrap().is_empty());
}

#[test]
fn segments() {
    let mut bench = Bench::read(SdoMode::Automatic);
    bench.sent();
    assert_eq!(bench.answer(&[0x41, 3, 0x20, 1, 9]), [[0x60, 0, 0, 0, 0, 0, 0, 0]]);
    assert_eq!(bench.answer(&[0x00, 1, 2, 3, 4, 5, 6, 7]), [[0x70, 0, 0, 0, 0, 0, 0, 0]]);
    assert!(bench.answer(&[0x1B, 8, 9]).is_empty());
    assert_eq!(bench.result().unwrap(), [1, 2, 3, 4, 5, 6, 7, 8, 9]);

    let mut bench = Bench::write(SdoMode::Segmented, &[]);
    assert_eq!(bench.sent(), [[0x21, 3, 0x20, 1, 0, 0, 0, 0]]);
    assert_eq!(bench.answer(&[0x60, 3, 0x20, 1]), [[0x0F, 0, 0, 0, 0, 0, 0, 0]]);
    bench.answer(&[0x20]);
    assert!(bench.result().unwrap().is_empty());
}

#[test]
fn lost_segments_of_a_block_come_again() {
    let value: Vec<u8> = (0..20).collect();
    let mut crc = Crc::new();
    crc.update(&value);
    let [low, high] = crc.value().to_le_bytes();

    let mut bench = Bench::read(SdoMode::Block);
    assert_eq!(bench.sent(), [[0xA4, 3, 0x20, 1, 127, 0, 0, 0]]);
    assert_eq!(bench.answer(&[0xC6, 3, 0x20, 1, 20]), [[0xA3, 0, 0, 0, 0, 0, 0, 0]]);
    assert!(bench.answer(&[1, 0, 1, 2, 3, 4, 5, 6]).is_empty());
    assert_eq!(bench.answer(&[0x83, 14, 15, 16, 17, 18, 19]), [[0xA2, 1, 127, 0, 0, 0, 0, 0]]);
    assert!(bench.answer(&[1, 7, 8, 9, 10, 11, 12, 13]).is_empty());
    assert_eq!(bench.answer(&[0x82, 14, 15, 16, 17, 18, 19]), [[0xA2, 2, 127, 0, 0, 0, 0, 0]]);
    assert_eq!(bench.answer(&[0xC5, low, high]), [[0xA1, 0, 0, 0, 0, 0, 0, 0]]);
    assert_eq!(bench.result().unwrap(), value);

    let mut bench = Bench::write(SdoMode::Block, &value);
    assert_eq!(bench.sent(), [[0xC6, 3, 0x20, 1, 20, 0, 0, 0]]);
    let segments = bench.answer(&[0xA4, 3, 0x20, 1, 2]);
    assert_eq!(segments, [[1, 0, 1, 2, 3, 4, 5, 6], [2, 7, 8, 9, 10, 11, 12, 13]]);
    let segments = bench.answer(&[0xA2, 1, 2]);
    assert_eq!(segments, [[1, 7, 8, 9, 10, 11, 12, 13], [0x82, 14, 15, 16, 17, 18, 19, 0]]);
    assert_eq!(bench.answer(&[0xA2, 2, 2]), [[0xC5, low, high, 0, 0, 0, 0, 0]]);
    bench.answer(&[0xA1]);
    assert!(bench.result().unwrap().is_empty());
}

/// A block of which `sent` segments have been handed to the bus.
fn begun_block(length: usize, sent: usize) -> Bench {
    let value: Vec<u8> = (0..length).map(|place| (place % 251) as u8).collect();
    let mut bench = Bench::write(SdoMode::Block, &value);
    bench.sent();
    let begun = Frame::new(channel().response, &[0xA4, 3, 0x20, 1, 127, 0, 0, 0]);
    bench.transfer.receive(bench.now, &begun);
    bench.some_sent(sent);
    bench
}

// U1 of the field reports: CANopenNode issue 426.
#[test]
fn a_block_may_be_confirmed_before_it_is_out() {
    // Segment 10 of 100 is lost, and the server says so after 12.
    let mut bench = begun_block(700, 12);
    let next = bench.answer(&[0xA2, 9, 127]);
    assert_eq!(next.len(), 91);
    assert_eq!(next[0], [1, 63, 64, 65, 66, 67, 68, 69]);
    assert_eq!(next[90][0], 0x80 | 91);
    assert_eq!(bench.answer(&[0xA2, 91, 127])[0][0], 0xC1);
    bench.answer(&[0xA1]);
    bench.result().unwrap();

    // None of them, all of them, and another size of the blocks to come.
    let mut bench = begun_block(700, 5);
    assert_eq!(bench.answer(&[0xA2, 0, 127])[0], [1, 0, 1, 2, 3, 4, 5, 6]);
    let mut bench = begun_block(700, 5);
    let next = bench.answer(&[0xA2, 5, 3]);
    assert_eq!(next.iter().map(|segment| segment[0]).collect::<Vec<_>>(), [1, 2, 3]);
    assert_eq!(next[0][1], 35);

    // A server that drops the tenth of every block: the same words, and each counts.
    let mut bench = begun_block(700, 12);
    for block in 1..=9_usize {
        bench.transfer.receive(bench.now, &Frame::new(channel().response, &[0xA2, 9, 127, 0, 0, 0, 0, 0]));
        let next = bench.some_sent(12);
        assert_eq!(next[0][1], ((block * 63) % 251) as u8, "{block}");
    }
}

#[test]
fn a_repeated_confirmation_does_not_skip_segments() {
    let mut bench = begun_block(700, 12);
    let early = Frame::new(channel().response, &[0xA2, 9, 127, 0, 0, 0, 0, 0]);
    bench.transfer.receive(bench.now, &early);
    bench.transfer.receive(bench.now, &early);
    assert_eq!(bench.some_sent(3)[2], [3, 77, 78, 79, 80, 81, 82, 83]);
    bench.transfer.receive(bench.now, &early);
    assert_eq!(bench.some_sent(1)[0][0], 4, "the block goes on");
    // Nor does one of more than was sent.
    bench.transfer.receive(bench.now, &Frame::new(channel().response, &[0xA2, 127, 127, 0, 0, 0, 0, 0]));
    assert_eq!(bench.some_sent(1)[0][0], 5);
}

// U8 of the field reports: canopen-stack issue 53.
#[test]
fn an_abort_with_reserved_bits_is_one_and_none_is_answered() {
    for command in 0x80..=0x9F_u8 {
        let refused = [command, 3, 0x20, 1, 2, 0, 1, 6];
        let benches = [
            Bench::read(SdoMode::Segmented),
            Bench::write(SdoMode::Segmented, &[1; 9]),
            Bench::read(SdoMode::Block),
            Bench::write(SdoMode::Block, &[1; 9]),
        ];
        for mut bench in benches {
            bench.sent();
            assert!(bench.answer(&refused).is_empty(), "{command:02X}h");
            assert!(matches!(bench.result(), Err(SdoError::Aborted(AbortCode::READ_ONLY))), "{command:02X}h");
        }
        let mut bench = Bench::read(SdoMode::Segmented);
        bench.sent();
        bench.transfer.receive(bench.now, &Frame::new(channel().response, &[0x41, 3, 0x20, 1, 9, 0, 0, 0]));
        bench.transfer.receive(bench.now, &Frame::new(channel().response, &refused));
        assert!(bench.sent().is_empty(), "what was to be asked next is not asked any more");
        bench.result().unwrap_err();
        let mut bench = begun_block(700, 12);
        assert!(bench.answer(&refused).is_empty());
        bench.result().unwrap_err();
    }
    // Within a block that is read, what has the next number is a segment.
    let mut bench = Bench::read(SdoMode::Block);
    bench.sent();
    bench.answer(&[0xC6, 3, 0x20, 1, 3]);
    assert_eq!(bench.answer(&[0x81, 3, 0x20, 1])[0][..2], [0xA2, 1]);
    let mut bench = Bench::read(SdoMode::Block);
    bench.sent();
    bench.answer(&[0xC6, 3, 0x20, 1, 3]);
    assert!(bench.answer(&abort(0x0800_0000)).is_empty());
    assert!(matches!(bench.result(), Err(SdoError::Aborted(AbortCode::GENERAL_ERROR))));
    let mut bench = Bench::read(SdoMode::Block);
    bench.sent();
    bench.answer(&[0xC6, 3, 0x20, 1, 21]);
    bench.answer(&[1]);
    assert!(bench.answer(&[0x9F, 3, 0x20, 1, 0, 0, 0, 8]).is_empty());
    assert!(matches!(bench.result(), Err(SdoError::Aborted(AbortCode::GENERAL_ERROR))));
    // Some servers leave the place out.
    let mut bench = Bench::read(SdoMode::Segmented);
    bench.sent();
    bench.answer(&[0x81, 0, 0, 0, 0, 0, 0, 8]);
    assert!(matches!(bench.result(), Err(SdoError::Aborted(AbortCode::GENERAL_ERROR))));
}

#[test]
fn what_answers_something_else_is_passed_over() {
    let mut bench = Bench::read(SdoMode::Automatic);
    bench.sent();
    let other_index = [0x43, 4, 0x20, 1, 9];
    let other_sub_index = [0x43, 3, 0x20, 2, 9];
    let other_service = [0x60, 3, 0x20, 1];
    let other_abort = [0x80, 4, 0x20, 1, 0, 0, 4, 5];
    let segment = [0x00, 1, 2, 3, 4, 5, 6, 7];
    for answer in [&other_index[..], &other_sub_index, &other_service, &other_abort, &segment] {
        assert!(bench.answer(answer).is_empty(), "{answer:02X?}");
    }
    bench.transfer.receive(bench.now, &Frame::new(channel().request, &[0x43, 3, 0x20, 1, 9, 0, 0, 0]));
    bench.transfer.receive(bench.now, &Frame::new(channel().response, &[0x43, 3, 0x20, 1, 9]));
    bench.transfer.receive(bench.now, &Frame::remote(channel().response, 8));
    assert!(!bench.transfer.has_ended());

    bench.answer(&[0x41, 3, 0x20, 1, 20]);
    assert!(bench.answer(&[0x41, 3, 0x20, 1, 20]).is_empty(), "a doubled answer");
    assert_eq!(bench.answer(&segment).len(), 1);
    assert!(bench.answer(&segment).is_empty(), "a doubled segment");
    assert_eq!(bench.answer(&[0x10, 8, 9, 10, 11, 12, 13, 14]).len(), 1);
    bench.answer(&[0x03, 15, 16, 17, 18, 19, 20]);
    assert_eq!(bench.result().unwrap(), (1..=20).collect::<Vec<u8>>());
}

#[test]
fn doubled_frames_of_blocks_are_passed_over() {
    let mut bench =
        Bench::read_with(SdoOptions { mode: SdoMode::Block, block_size: 2, ..SdoOptions::default() });
    bench.sent();
    for answer in [[0xC2, 3, 0x20, 1, 28, 0, 0, 0], [0xC2, 3, 0x20, 1, 28, 0, 0, 0]] {
        bench.answer(&answer);
    }
    let zeros = [[1, 0], [2, 0]];
    for (place, segment) in [zeros[0], zeros[0], zeros[1], zeros[1]].iter().enumerate() {
        assert_eq!(bench.answer(segment).len(), usize::from(place == 2), "{place}");
    }
    bench.answer(&[1]);
    assert_eq!(bench.answer(&[0x82]), [[0xA2, 2, 2, 0, 0, 0, 0, 0]]);
    assert!(bench.answer(&[0x82]).is_empty());
    assert_eq!(bench.answer(&[0xC1]), [[0xA1, 0, 0, 0, 0, 0, 0, 0]]);
    assert_eq!(bench.result().unwrap(), [0; 28]);

    // A last segment that is no abort, with the place in it, and one that is no reserved command.
    for (count, data) in [(2, [3, 0x20, 1, 0, 0, 0, 0]), (100, [7; 7])] {
        let mut bench = Bench::read(SdoMode::Block);
        bench.sent();
        bench.answer(&[0xC0, 3, 0x20, 1]);
        for number in 1..count {
            bench.answer(&[number]);
        }
        let last = [&[0x80 | count][..], &data].concat();
        assert_eq!(bench.answer(&last), [[0xA2, count, 127, 0, 0, 0, 0, 0]]);
        assert!(bench.answer(&last).is_empty() && !bench.transfer.has_ended(), "{count}");
        bench.answer(&[0xC1]);
        assert_eq!(bench.result().unwrap().len(), 7 * usize::from(count));
    }
}

#[test]
fn a_silent_server_is_told() {
    let mut bench = Bench::read(SdoMode::Automatic);
    bench.sent();
    assert_eq!(bench.transfer.next_deadline(), Instant(1_001_000));
    assert!(bench.wait(999).is_empty());
    assert_eq!(bench.wait(1), [abort(0x0504_0000)]);
    assert_eq!(bench.error(), "no answer in time");
    assert_eq!(bench.transfer.next_deadline(), Instant::NEVER);

    let mut bench = Bench::read(SdoMode::Automatic);
    bench.sent();
    bench.wait(500);
    bench.answer(&[0x60, 3, 0x20, 1]);
    bench.wait(500);
    assert_eq!(
        bench.error(),
        "no answer in time; the last message, 60 03 20 01 00 00 00 00, is not the answer to this request"
    );
}

#[test]
fn answers_against_the_protocol_end_the_transfer() {
    let begun = |answer: &[u8]| {
        let mut bench = Bench::read(SdoMode::Segmented);
        bench.sent();
        bench.answer(answer);
        bench
    };
    let mut bench = begun(&[0x41, 3, 0x20, 1, 9]);
    assert_eq!(bench.answer(&[0x10, 1, 2, 3, 4, 5, 6, 7]), [abort(0x0503_0000)]);
    assert_eq!(
        bench.error(),
        "the toggle bit of a segment is wrong (ended with 05030000h: toggle bit not alternated)"
    );
    assert_eq!(begun(&[0x41, 3, 0x20, 1, 9]).answer(&[0xE0]), [abort(0x0504_0001)]);
    assert_eq!(begun(&[0x41, 3, 0x20, 1, 9]).answer(&[0x0E]), [abort(0x0607_0010)]);
    assert_eq!(begun(&[0x41, 3, 0x20, 1, 9]).answer(&[0x01, 1]), [abort(0x0607_0013)]);
    assert_eq!(begun(&[0x41, 3, 0x20, 1, 2]).answer(&[0x03, 1]), [abort(0x0607_0012)]);
    let mut bench = Bench::read(SdoMode::Segmented);
    bench.sent();
    assert_eq!(bench.answer(&[0x41, 3, 0x20, 1, 1, 0, 0, 4]), [abort(0x0504_0005)]);

    let mut bench = Bench::write(SdoMode::Segmented, &[1; 9]);
    bench.sent();
    bench.answer(&[0x60, 3, 0x20, 1]);
    assert_eq!(bench.answer(&[0x30]), [abort(0x0503_0000)]);
    let mut bench = Bench::write(SdoMode::Block, &[1; 9]);
    bench.sent();
    assert_eq!(bench.answer(&[0xA4, 3, 0x20, 1, 0]), [abort(0x0504_0002)]);
    let mut bench = Bench::write(SdoMode::Block, &[1; 9]);
    bench.sent();
    bench.answer(&[0xA4, 3, 0x20, 1, 127]);
    assert_eq!(bench.answer(&[0xA2, 3, 127]), [abort(0x0504_0003)]);
    let mut bench = Bench::read(SdoMode::Block);
    bench.sent();
    bench.answer(&[0xC6, 3, 0x20, 1, 1]);
    bench.answer(&[0x81, 9]);
    assert_eq!(bench.answer(&[0xD9, 0, 0]), [abort(0x0504_0004)]);
}

#[test]
fn a_server_that_repeats_itself_is_given_up() {
    let mut bench = Bench::write(SdoMode::Block, &[1; 9]);
    bench.sent();
    bench.answer(&[0xA4, 3, 0x20, 1, 127]);
    let answers = (0..100).take_while(|_| bench.answer(&[0xA2, 0, 127]) != [abort(0x0504_0003)]).count();
    assert_eq!(answers, 8);
    let mut bench = Bench::read(SdoMode::Block);
    bench.sent();
    bench.answer(&[0xC6, 3, 0x20, 1, 9]);
    let answers = (0..100).take_while(|n| bench.answer(&[0x82, *n]) != [abort(0x0504_0003)]).count();
    assert_eq!(answers, 8);
}

#[test]
fn what_is_too_long_is_refused() {
    let limited = |mode| SdoOptions { mode, most_bytes: 10, ..SdoOptions::default() };
    let mut bench = Bench::read_with(limited(SdoMode::Segmented));
    bench.sent();
    bench.answer(&[0x40, 3, 0x20, 1]);
    bench.answer(&[0x00, 1, 2, 3, 4, 5, 6, 7]);
    assert_eq!(bench.answer(&[0x10, 1, 2, 3, 4, 5, 6, 7]), [abort(0x0504_0005)]);

    let block = |last: &[u8]| {
        let mut bench = Bench::read_with(limited(SdoMode::Block));
        bench.sent();
        bench.answer(&[0xC0, 3, 0x20, 1]);
        bench.answer(&[1]);
        bench.answer(&[0x82]);
        bench.answer(last);
        bench.result()
    };
    assert_eq!(block(&[0xD1]).unwrap(), [0; 10]);
    assert!(matches!(block(&[0xCD]), Err(SdoError::GivenUp { code: AbortCode::OUT_OF_MEMORY, .. })));
}

#[test]
fn a_forced_mode_has_to_suit() {
    for data in [&[][..], &[1; 5]] {
        let mut bench = Bench::write(SdoMode::Expedited, data);
        assert!(bench.sent().is_empty());
        assert!(matches!(bench.result(), Err(SdoError::NotExpedited)));
    }
    let mut bench = Bench::read(SdoMode::Expedited);
    bench.sent();
    assert_eq!(bench.answer(&[0x41, 3, 0x20, 1, 9]), [abort(0x0607_0012)]);
    assert!(matches!(bench.result(), Err(SdoError::NotExpedited)));
}
