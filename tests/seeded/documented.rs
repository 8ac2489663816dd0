//! The page of the comparison has every kind of defect, and no other.

use edskit_tests::root;
use edskit_tests::seeded::defects;
use std::collections::BTreeSet;
use std::fs;

#[test]
fn the_page_has_every_kind() {
    let path = root().join("docs/seeded-defects.md");
    let page = fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let documented: BTreeSet<(String, String)> = page.lines().filter_map(row).collect();
    let defects = defects();
    let seeded: BTreeSet<(String, String)> =
        defects.iter().map(|defect| (defect.rule.to_owned(), defect.kind.to_owned())).collect();
    assert_eq!(seeded.len(), defects.len(), "two kinds of one rule have the same words");
    let missing: Vec<_> = seeded.difference(&documented).collect();
    let gone: Vec<_> = documented.difference(&seeded).collect();
    assert!(
        missing.is_empty() && gone.is_empty(),
        "docs/seeded-defects.md is stale, run tests/seeded/compare: it lacks {missing:?}, and these are gone: {gone:?}"
    );
}

/// Rule and kind of a row of the table.
fn row(line: &str) -> Option<(String, String)> {
    let mut cells = line.strip_prefix("| ")?.split(" | ");
    let (rule, kind) = (cells.next()?, cells.next()?);
    let is_rule = rule.len() == 6 && rule.ends_with(|last: char| last.is_ascii_digit());
    is_rule.then(|| (rule.to_owned(), kind.to_owned()))
}
