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

/// The findings on parameter files and scenarios, as JSON.
fn kinds() -> Vec<serde_json::Value> {
    let text = edskit(&["explain", "GWC", "--format", "json"]).stdout;
    serde_json::from_str(&text).expect("explain prints JSON")
}

/// A file for a block of an example: the first line of a parameter file is left out there.
fn run_example(language: &str, example: &str) -> String {
    let parameters = format!("device = \"heinzmann-canopen-gateway\"\n{example}");
    let (arguments, input): (&[&str], &str) = match language {
        "csv" => (&["config", "import", "-"], example),
        _ if example.starts_with("[[step]]") => {
            (&["run", "gateway", "--scenario", "-", "--simulate", "1"], example)
        }
        _ if example.starts_with("device") => (&["config", "check", "-"], example),
        _ => (&["config", "check", "-"], &parameters),
    };
    edskit_tests::edskit_with_input(arguments, input.as_bytes()).all()
}

#[test]
fn every_finding_on_parameters_is_explained() {
    let kinds = kinds();
    assert!(kinds.len() >= 32, "{}", kinds.len());
    let page = std::fs::read_to_string("../docs/gateway-parameters.md").unwrap();
    let listed = page.lines().filter(|line| line.starts_with("| GWC")).count();
    assert_eq!(kinds.len(), listed);
    for kind in &kinds {
        let text = |key: &str| kind[key].as_str().unwrap_or_default().to_owned();
        let (code, name) = (text("code"), text("name"));
        let by_code = edskit(&["explain", &code]);
        assert_eq!(by_code.exit, edskit::Exit::Clean, "{code}");
        assert!(by_code.stdout.starts_with(&format!("{code} {name} (")), "{}", by_code.stdout);
        assert_eq!(edskit(&["explain", &code.to_lowercase()]).stdout, by_code.stdout);
        // Some have the name of a rule of the linter too.
        assert!(edskit(&["explain", &name]).stdout.ends_with(&by_code.stdout), "{name}");
    }
    insta::assert_snapshot!("explain_kind", edskit(&["explain", "GWC011"]).all());
    let unknown = edskit(&["explain", "GWC0111"]);
    assert!(
        unknown.exit == edskit::Exit::Failed && unknown.stderr.contains("did you mean `GWC0"),
        "{}",
        unknown.stderr
    );
    assert_eq!(edskit(&["explain", "identifier-conflic"]).stderr.matches("`identifier-conflict`").count(), 1);
}

#[test]
fn the_examples_of_findings_on_parameters_are_right() {
    for kind in kinds() {
        let code = kind["code"].as_str().unwrap();
        let documentation = kind["documentation"].as_str().unwrap();
        let blocks: Vec<(&str, &str)> = documentation
            .split("```")
            .skip(1)
            .step_by(2)
            .map(|block| block.split_once('\n').expect("a block has a language"))
            .collect();
        let [(language, wrong), (_, right)] = blocks[..] else { panic!("{code} has two examples") };
        let answer = run_example(language, wrong);
        assert!(answer.contains(&format!("{code} ")), "{code}: {answer}");
        let answer = run_example(language, right);
        assert!(!answer.contains(code), "{code}: {answer}");
        for heading in ["## What it does", "## Why is this bad", "## Example", "## Use instead"] {
            assert!(documentation.contains(heading), "{code}: {heading}");
        }
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
