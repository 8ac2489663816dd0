//! The rate, for people.

use crate::run::Run;
use std::collections::BTreeMap;
use std::io::{self, Write};

/// Prints how many defects of each group of rules were caught.
pub(crate) fn print(runs: &[Run]) {
    let mut groups: BTreeMap<&str, Row> = BTreeMap::new();
    let mut all = Row::default();
    for run in runs {
        groups.entry(&run.rule[..3]).or_default().add(run);
        all.add(run);
    }
    let mut text = "group  kinds  mutants  caught     rate\n".to_owned();
    for (group, row) in groups.iter().chain([(&"all", &all)]) {
        text += &format!(
            "{group:5}  {:5}  {:7}  {:6}  {:6.2} %\n",
            row.kinds,
            row.mutants,
            row.caught,
            100.0 * row.caught as f64 / row.mutants as f64,
        );
    }
    // Not `print!`: the test harness would keep it back.
    let _ = io::stderr().write_all(text.as_bytes());
}

#[derive(Default)]
struct Row {
    kinds: usize,
    mutants: usize,
    caught: usize,
}

impl Row {
    fn add(&mut self, run: &Run) {
        self.kinds += 1;
        self.mutants += run.mutants;
        self.caught += run.caught;
    }
}
