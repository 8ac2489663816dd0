//! A server that sends anything.

use edskit_host::sdo::{SdoChannel, SdoMode, SdoOptions, Transfer};
use edskit_runtime::{Frame, Instant};
use edskit_types::{Index, NodeId, SubIndex};
use proptest::prelude::*;

const MOST_BYTES: usize = 500;

/// Frames of which many begin as answers do and name the place that was asked for.
fn answer() -> impl Strategy<Value = Vec<u8>> {
    let commands = vec![
        0x00, 0x10, 0x01, 0x11, 0x20, 0x30, 0x40, 0x41, 0x43, 0x60, 0x80, 0xA0, 0xA1, 0xA2, 0xA4, 0xC0, 0xC1,
        0xC2, 0xC6, 0xE0,
    ];
    let command = prop_oneof![proptest::sample::select(commands), any::<u8>(), 1..8_u8];
    let place = prop_oneof![Just([0x03, 0x20, 0x00]), any::<[u8; 3]>()];
    let rest = prop_oneof![Just([0; 4]), Just([0, 1, 0, 0]), any::<[u8; 4]>()];
    let whole =
        (command, place, rest).prop_map(|(command, place, rest)| [&[command][..], &place, &rest].concat());
    prop_oneof![9 => whole, 1 => proptest::collection::vec(any::<u8>(), 0..8)]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(600))]

    #[test]
    fn no_answers_make_a_transfer_panic_hang_or_grow(
        answers in proptest::collection::vec((answer(), any::<bool>()), 0..200),
        mode in 0..4_usize,
        length in proptest::option::of(0..600_usize),
        block_size in any::<u8>(),
    ) {
        let modes = [SdoMode::Automatic, SdoMode::Expedited, SdoMode::Segmented, SdoMode::Block];
        let options =
            SdoOptions { mode: modes[mode], block_size, most_bytes: MOST_BYTES, ..SdoOptions::default() };
        let channel = SdoChannel::of_node(NodeId::MIN);
        let (index, sub_index) = (Index(0x2003), SubIndex(0));
        let mut transfer = match length {
            None => Transfer::read(channel, index, sub_index, options, Instant(0)),
            Some(length) => {
                Transfer::write(channel, index, sub_index, &vec![1; length], options, Instant(0))
            }
        };
        for (answer, is_transmitting) in &answers {
            transfer.receive(Instant(1), &Frame::new(channel.response, answer));
            if *is_transmitting {
                let sent = std::iter::from_fn(|| transfer.transmit(Instant(1))).take(1_000).count();
                prop_assert!(sent <= 130, "{sent} frames after one answer");
            }
        }
        prop_assert!(transfer.has_ended() || transfer.next_deadline() <= Instant(1_000_001));
        // Where blocks were the client's choice, it asks once more.
        for end in [1_000_001, 2_000_001] {
            transfer.poll(Instant(end));
            prop_assert!(std::iter::from_fn(|| transfer.transmit(Instant(end))).count() <= 3);
        }
        transfer.poll(Instant(2_000_001));
        prop_assert!(transfer.has_ended());
        let result = transfer.result().expect("what has ended has a result");
        prop_assert!(result.is_err() || result.is_ok_and(|data| data.len() <= MOST_BYTES));
    }
}
