//! Every rule runs over any bytes; its findings lie in the file, and its fixes can be made.
#![no_main]

use edskit_lint::{FileKind, Linter, RuleSet};
use edskit_model::Datasheet;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|input: &[u8]| {
    // The last byte says which kind of file it is, so that any file will do as a seed.
    let Some((kind, bytes)) = input.split_last() else { return };
    let name = ["device.eds", "device.dcf", "nodelist.cpj"][usize::from(kind % 3)];
    let sheet = Datasheet::parse(bytes);
    let findings = Linter::new(RuleSet::all()).lint(&sheet, FileKind::of(name), Some(name));
    assert!(findings.is_sorted_by_key(|finding| finding.span().start));
    for finding in &findings {
        for label in &finding.labels {
            assert!(
                label.span.start <= label.span.end && label.span.end as usize <= bytes.len(),
                "{finding:?}"
            );
        }
        if let Some(fix) = &finding.fix {
            assert!(fix.edits.is_sorted_by(|a, b| a.span.end <= b.span.start), "{finding:?}");
            assert_ne!(fix.apply(bytes), bytes, "{finding:?}");
        }
    }
});
