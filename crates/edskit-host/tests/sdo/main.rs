//! The SDO client against the SDO server of `edskit-runtime`, over a bus in virtual time, and against nonsense.

mod hostile;
mod lossy;
mod node;
mod servers;

use edskit_host::sdo::{SdoClient, SdoError, SdoMode};
use edskit_types::{AbortCode, Index, NodeId, SubIndex};
use node::{Served, TEXT_CAPACITY};
use proptest::prelude::*;

/// A DOMAIN, a text that can change, and a number that cannot.
const DOMAIN: Index = Index(0x2000);
const TEXT: Index = Index(0x2001);
const CONSTANT: Index = Index(0x2002);
const NUMBER: Index = Index(0x2003);

const ALL: [SdoMode; 3] = [SdoMode::Automatic, SdoMode::Segmented, SdoMode::Block];

fn client() -> SdoClient {
    SdoClient::new(NodeId::MIN)
}

fn bytes(length: usize) -> Vec<u8> {
    (0..length).map(|place| (place * 31 % 251) as u8).collect()
}

fn goes_through(index: Index, length: usize) {
    let mut bus = Served::new();
    let value = bytes(length);
    for (place, writing) in ALL.into_iter().enumerate() {
        let reading = ALL[(place + length) % ALL.len()];
        let what = format!("{length} bytes, {writing:?} and {reading:?}");
        client().mode(writing).write(&mut bus, index, SubIndex(0), &value).expect(&what);
        let read = client().mode(reading).read(&mut bus, index, SubIndex(0)).expect(&what);
        assert!(read == value, "{what}");
    }
}

#[test]
fn lengths_around_every_border_go_through() {
    let borders = [0, 1, 4, 5, 7, 8, 14, 256, 257, 889, 890, 1778, 1779, 2000];
    for length in borders {
        goes_through(DOMAIN, length);
        goes_through(TEXT, length.min(TEXT_CAPACITY));
    }
}

#[test]
fn expedited_transfers_have_up_to_four_bytes() {
    let mut bus = Served::new();
    let expedited = client().mode(SdoMode::Expedited);
    for length in 1..=4 {
        expedited.write(&mut bus, DOMAIN, SubIndex(0), &bytes(length)).unwrap();
        assert_eq!(expedited.read(&mut bus, DOMAIN, SubIndex(0)).unwrap(), bytes(length));
    }
    let error = expedited.write(&mut bus, DOMAIN, SubIndex(0), &bytes(5)).unwrap_err();
    assert!(matches!(error, SdoError::NotExpedited));
}

#[test]
fn the_server_says_why_not() {
    let mut bus = Served::new();
    for mode in ALL {
        let code = |result: Result<(), SdoError>| match result {
            Err(SdoError::Aborted(code)) => code,
            other => panic!("{mode:?}: {other:?}"),
        };
        let client = client().mode(mode);
        let missing = client.read(&mut bus, Index(0x5000), SubIndex(0)).map(|_| ());
        assert_eq!(code(missing), AbortCode::OBJECT_DOES_NOT_EXIST);
        let constant = client.write(&mut bus, CONSTANT, SubIndex(0), &[1, 2, 3, 4]);
        assert_eq!(code(constant), AbortCode::READ_ONLY);
        let too_long = client.write(&mut bus, NUMBER, SubIndex(0), &bytes(300));
        assert_eq!(code(too_long), AbortCode::LENGTH_TOO_HIGH);
    }
    assert_eq!(client().read(&mut bus, CONSTANT, SubIndex(0)).unwrap(), [0x44, 0x33, 0x22, 0x11]);
}

#[test]
fn a_node_that_is_away_is_waited_for_one_second() {
    let mut bus = Served::new();
    let other = SdoClient::new(NodeId::new(9).unwrap());
    let error = other.read(&mut bus, DOMAIN, SubIndex(0)).unwrap_err();
    let SdoError::TimedOut { heard } = error else { panic!("{error}") };
    assert!(heard.answers == 0 && heard.untaken.is_none() && !heard.is_there, "{heard:?}");
    assert!(heard.has_others, "the node that is there has booted up");
    let waited = bus.milliseconds();
    assert!((1_000..1_010).contains(&waited), "{waited}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn any_length_goes_through(length in 0..=TEXT_CAPACITY, is_text in any::<bool>()) {
        goes_through(if is_text { TEXT } else { DOMAIN }, length);
    }
}
