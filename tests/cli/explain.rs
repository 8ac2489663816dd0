//! `edskit explain`.

use edskit_tests::edskit;

#[test]
fn one_rule() {
    insta::assert_snapshot!("explain_rule", edskit(&["explain", "SYN013"]).all());
    assert_eq!(edskit(&["explain", "duplicate-section"]).stdout, edskit(&["explain", "SYN013"]).stdout);
}

#[test]
fn a_prefix_names_all_its_rules() {
    let text = edskit(&["explain", "FIL"]).stdout;
    assert!(text.contains("FIL001 ") && text.contains("FIL010 ") && !text.contains("SYN001"));
}

#[test]
fn json_has_every_rule() {
    let rules: serde_json::Value =
        serde_json::from_str(&edskit(&["explain", "--all", "--format", "json"]).stdout).unwrap();
    let rules = rules.as_array().unwrap();
    assert!(rules.len() > 90);
    for rule in rules {
        for key in ["code", "name", "group", "severity", "since", "summary", "documentation"] {
            assert!(rule[key].as_str().is_some_and(|text| !text.is_empty()), "{rule}: {key}");
        }
        assert!(rule["enabled"].is_boolean());
    }
}

#[test]
fn the_generated_pages_are_current() {
    for (path, format) in [("rules.md", "markdown"), ("cross-reference.md", "cross-reference")] {
        let page = edskit(&["explain", "--all", "--format", format]).stdout;
        let written = std::fs::read_to_string(format!("../docs/{path}")).unwrap();
        assert!(page == written, "docs/{path} is stale; `cargo xtask docs` writes it again");
    }
}
