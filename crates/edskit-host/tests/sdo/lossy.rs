//! A bus that loses, doubles and delays frames.

use crate::node::Served;
use crate::{ALL, DOMAIN, TEXT, bytes, client};
use edskit_host::sdo::SdoError;
use edskit_host::{Bus, Delay, Duplication, Loss};
use edskit_runtime::Microseconds;
use edskit_types::SubIndex;

#[test]
fn every_transfer_ends_and_no_wrong_value_counts_as_right() {
    let (mut done, mut failed) = (0, 0);
    for seed in 0..40 {
        let mut clean = Served::new();
        let value = bytes(30 + 12 * seed as usize);
        client().write(&mut clean, TEXT, SubIndex(0), &value).unwrap();
        let bus = Duplication::new(Loss::new(clean, 0.05, seed), 0.05, seed + 1);
        let mut bus = Delay::new(bus, Microseconds(0), Microseconds::from_milliseconds(50), seed + 2);
        for mode in ALL {
            let client = client().mode(mode);
            let start = bus.now();
            match client.read(&mut bus, TEXT, SubIndex(0)) {
                Ok(read) => {
                    assert!(read == value, "{mode:?} with seed {seed}");
                    done += 1;
                }
                Err(SdoError::Aborted(_) | SdoError::TimedOut { .. } | SdoError::GivenUp { .. }) => {
                    failed += 1
                }
                Err(error) => panic!("{mode:?} with seed {seed}: {error}"),
            }
            match client.write(&mut bus, DOMAIN, SubIndex(0), &value) {
                Ok(()) => done += 1,
                Err(SdoError::Aborted(_) | SdoError::TimedOut { .. } | SdoError::GivenUp { .. }) => {
                    failed += 1
                }
                Err(error) => panic!("{mode:?} with seed {seed}: {error}"),
            }
            let seconds = bus.now().since(start).0 / 1_000_000;
            assert!(seconds < 60, "{mode:?} with seed {seed} took {seconds} s");
        }
    }
    assert!(done > 0 && failed > 0, "{done} done, {failed} failed");
}
