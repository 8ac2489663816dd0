//! Real files become code that compiles.

use crate::checks::complaints;
use crate::compiler::{Packages, stderr};
use edskit_codegen::{Naming, generate, parse, render};
use edskit_lint::{Linter, RuleSet, Severity};
use std::collections::BTreeSet;

/// How many packages the code is divided into: the compiler works on one at a time per core.
const PACKAGES: usize = 4;

/// Every file of the corpus, whatever the linter says about it; what the linter accepts is generated. Mappings that cannot be are refused by the compiler, and
/// exactly those.
#[test]
fn corpus_generates() {
    let Some(corpus) = edskit_tests::corpus("generating code for the corpus") else { return };
    let mut good: Vec<String> = Vec::new();
    let mut bad = Vec::new();
    let mut refused = BTreeSet::new();
    let mut accepted = 0;
    let linter = Linter::new(RuleSet::default());
    for (number, file) in corpus.iter().enumerate() {
        let name = format!("file_{number}.eds");
        let layout = match parse(&file.bytes, None) {
            Ok(layout) => layout,
            Err(problems) => panic!("{}: {}", file.name, problems[0].line(&name, "")),
        };
        let code = render(&layout, &Naming::of(&name));
        // What a PDO carries that does not exist at power-on is a warning, and nothing for the compiler.
        let problems: Vec<_> = layout
            .mapping_problems()
            .into_iter()
            .filter(|problem| problem.severity == Severity::Error)
            .collect();
        match generate(&file.bytes, None, &Naming::of(&file.name), &linter) {
            Ok(_) => accepted += 1,
            Err(errors) if errors.iter().all(|error| error.code != "GEN") => {}
            // The linter only warns of what some device could do, and this dictionary cannot.
            Err(errors) => assert_eq!(errors, problems, "{}", file.name),
        }
        if problems.is_empty() {
            good.push(code);
        } else {
            refused.extend(problems.iter().map(|problem| format!("{name}:{}", problem.position)));
            bad.push(code);
        }
    }
    assert!(accepted > 0, "the linter accepts some files");
    let mut packages = Packages::new("corpus");
    // The longest first, each to the package that has least, so that all take the same time.
    good.sort_by_key(|code| core::cmp::Reverse(code.len()));
    let mut parts = vec![Vec::new(); PACKAGES];
    for code in &good {
        let shortest =
            parts.iter_mut().min_by_key(|part| part.iter().map(|code: &&str| code.len()).sum::<usize>());
        shortest.expect("there are packages").push(code.as_str());
    }
    for (number, part) in parts.into_iter().enumerate() {
        packages.add_library(&format!("part-{number}"), part);
    }
    packages.all("check");
    if !bad.is_empty() {
        packages.add_library("refused", bad.iter().map(String::as_str));
        let output = packages.cargo(&["check", "-p", "refused"]);
        assert_eq!(complaints(&stderr(&output)), refused);
    }
}
