//! Every defect that is put into a clean file is found: by the rule that is meant for it, at its line, and with no
//! error besides.
//!
//! The kinds of defects are in `edskit_tests::seeded`; `docs/seeded-defects.md` compares what others notice.

mod documented;
mod rules;
mod run;
mod table;

use edskit_tests::seeded::{bases, defects};
use run::Run;

#[test]
fn every_base_is_clean_by_all_rules() {
    for base in bases() {
        let findings = run::findings_of_base(&base);
        assert!(findings.is_empty(), "{}: {findings:#?}", base.name);
    }
}

#[test]
fn every_defect_is_caught() {
    let (bases, defects) = (bases(), defects());
    let runs: Vec<Run> = defects.iter().map(|defect| run::run(defect, &bases)).collect();
    table::print(&runs);
    let failures: Vec<&str> = runs.iter().flat_map(|run| &run.failures).map(String::as_str).collect();
    assert!(
        failures.is_empty(),
        "{} mutants are not judged as they must be:\n{}",
        failures.len(),
        failures.join("\n")
    );
}

#[test]
fn every_kind_has_several_places() {
    let bases = bases();
    for defect in defects() {
        let places: usize = bases.iter().map(|base| defect.mutants(base).len()).sum();
        assert!(places > 1, "{}: {} has {places} places", defect.rule, defect.kind);
    }
}

#[test]
fn every_shipped_data_sheet_gets_most_kinds() {
    let shipped = edskit_tests::files(&edskit_tests::root().join("eds"), &["eds"]);
    let (bases, defects) = (bases(), defects());
    for file in shipped {
        let base = bases.iter().find(|base| base.name == file.name).expect("every shipped file is a base");
        let kinds = defects.iter().filter(|defect| !defect.mutants(base).is_empty()).count();
        assert!(kinds >= 150, "{}: only {kinds} kinds", base.name);
    }
}
