//! From the text of a large EDS to the code of its dictionary.

use criterion::Criterion;
use edskit_codegen::{Naming, generate};
use edskit_lint::{Linter, RuleSet};

/// How many objects the device has.
const OBJECTS: u16 = 10_000;

pub(crate) fn benches(criterion: &mut Criterion) {
    let eds = device_of(OBJECTS);
    let naming = Naming::of("Large.eds");
    // The file describes nothing but its objects, so the linter has to be left out.
    let linter = Linter::new(RuleSet::none());
    let code = || generate(eds.as_bytes(), None, &naming, &linter).expect("it can be generated").code;
    assert!(code().contains("PARAMETER_9999"));

    let mut group = crate::group(criterion, "generate 10,000 objects");
    group.sample_size(10);
    group.bench_function("edskit", |bencher| bencher.iter(code));
    group.finish();
}

/// An EDS with so many UNSIGNED32 from 2000h on.
pub(crate) fn device_of(objects: u16) -> String {
    let section = |number: u16| {
        let index = 0x2000 + number;
        format!(
            "[{index:X}]\nParameterName=Parameter {number}\nObjectType=0x7\nDataType=0x0007\nAccessType=rw\n\
             DefaultValue={number}\nLowLimit=1\nPDOMapping=0\n"
        )
    };
    (0..objects).map(section).collect()
}
