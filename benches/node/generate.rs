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

/// An EDS with so many UNSIGNED32: some of the communication profile, one half of the others from 2000h on, and one half
/// from 6000h on.
pub(crate) fn device_of(objects: u16) -> String {
    let communication = [0x1000, 0x1001, 0x1005, 0x1006, 0x1014, 0x1017];
    let others = objects - communication.len() as u16;
    let manufacturer = 0x2000..0x2000 + others / 2;
    let profile = 0x6000..0x6000 + others - others / 2;
    let section = |(number, index): (usize, u16)| {
        format!(
            "[{index:X}]\nParameterName=Parameter {number}\nObjectType=0x7\nDataType=0x0007\nAccessType=rw\n\
             DefaultValue={number}\nLowLimit=0\nPDOMapping=0\n"
        )
    };
    communication.into_iter().chain(manufacturer).chain(profile).enumerate().map(section).collect()
}
