//! The canonical form of any bytes means the same, and formatting it again changes nothing.
#![no_main]

use edskit_model::{Datasheet, format, same_meaning};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let before = Datasheet::parse(bytes);
    let once = format(&before);
    let after = Datasheet::parse(&once);
    if let Err(difference) = same_meaning(&before, &after) {
        panic!("{difference}");
    }
    assert_eq!(format(&after), once, "a second run changes something");
});
