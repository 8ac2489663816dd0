//! The report on real files says what is found today.

use edskit_tests::field_report::field_report;
use edskit_tests::{corpus, read, root};

#[test]
fn the_report_on_real_files_is_not_stale() {
    let Some(corpus) = corpus("the report on real files") else { return };
    let [page, judgements] = ["docs/field-report.md", "docs/field-report.toml"]
        .map(|path| String::from_utf8(read(&root().join(path))).expect("documents are UTF-8"));
    let expected = field_report(&corpus, &judgements).unwrap_or_else(|problems| panic!("{problems}"));
    assert!(page == expected, "docs/field-report.md is stale: run `cargo xtask field-report`");
}
