//! No rule without a defect.

use edskit_lint::find;
use edskit_tests::seeded::defects;
use std::collections::BTreeSet;

/// Rules that no defect belongs to, each with the reason.
const WITHOUT_DEFECT: &[(&str, &str)] = &[];

#[test]
fn every_rule_has_a_defect_or_a_reason() {
    let seeded: BTreeSet<&str> = defects().iter().map(|defect| defect.rule).collect();
    let excused: BTreeSet<&str> = WITHOUT_DEFECT.iter().map(|(rule, _)| *rule).collect();
    let all = find("ALL").expect("there are rules");
    let missing: Vec<&str> = all
        .iter()
        .map(|rule| rule.code)
        .filter(|code| !seeded.contains(code) && !excused.contains(code))
        .collect();
    assert!(missing.is_empty(), "rules without a defect: {missing:?}");
    let both: Vec<_> = seeded.intersection(&excused).collect();
    assert!(both.is_empty(), "these have a defect by now: {both:?}");
}
