//! A large device costs less than a second.

use edskit_codegen::{Naming, generate};
use edskit_lint::{Linter, RuleSet};
use std::fmt::Write;
use std::time::{Duration, Instant};

#[test]
fn ten_thousand_objects_take_less_than_a_second() {
    let mut eds = String::new();
    for index in 0..10_000 {
        let index = 0x2000 + index;
        let name = format!("Parameter {index} of the device");
        write!(
            eds,
            "[{index:X}]\nParameterName={name}\nObjectType=0x7\nDataType=0x0007\nAccessType=rw\nDefaultValue={index}\n\
             LowLimit=1\nPDOMapping=0\n"
        )
        .expect("a string can be written to");
    }
    let linter = Linter::new(RuleSet::none());
    let start = Instant::now();
    let generated =
        generate(eds.as_bytes(), None, &Naming::of("Large.eds"), &linter).expect("it can be generated");
    let time = start.elapsed();
    assert_eq!(generated.layout.entries.len(), 10_000);
    assert!(time < Duration::from_secs(1), "{time:?}");
}
