//! What holds for every rule: its metadata, and that its documentation is true.

use super::ALL;
use crate::testing::{Folder, findings_among, findings_in, lint};
use crate::{PEER_FINDINGS, Rule, find};
use edskit_model::Datasheet;
use std::collections::HashSet;

const HEADINGS: [&str; 5] = ["What it does", "Why is this bad", "Example", "Use instead", "References"];

#[test]
fn codes_and_names_are_unique_and_well_formed() {
    let mut seen = HashSet::new();
    for rule in ALL.iter() {
        assert!(seen.insert(rule.code) && seen.insert(rule.name), "{rule:?} is there twice");
        let digits = rule.code.strip_prefix(rule.group.prefix()).unwrap_or_default();
        assert!(digits.len() == 3 && digits.bytes().all(|byte| byte.is_ascii_digit()), "{rule:?}");
        assert!(rule.name.bytes().all(|byte| matches!(byte, b'a'..=b'z' | b'0'..=b'9' | b'-')), "{rule:?}");
        assert_eq!(find(rule.name).unwrap(), [*rule]);
        assert_eq!(rule.since, "0.1.0");
    }
    assert!(ALL.is_sorted_by_key(|rule| (rule.group, rule.code)));
}

#[test]
fn the_documentation_has_the_fixed_headings() {
    for rule in ALL.iter() {
        assert!(!rule.summary().is_empty() && !rule.summary().ends_with('.'), "{rule:?}: {}", rule.summary());
        let headings: Vec<String> =
            rule.docs().lines().filter_map(|line| Some(line.strip_prefix("## ")?.to_owned())).collect();
        assert_eq!(headings, HEADINGS, "{rule:?}");
        for heading in HEADINGS {
            assert!(rule.section(heading).is_some_and(|text| !text.is_empty()), "{rule:?}: {heading}");
        }
    }
}

#[test]
fn the_bad_example_gives_one_finding_and_the_good_one_none() {
    for rule in ALL.iter() {
        let found = findings_of_example(rule, "Example");
        assert_eq!(found.len(), 1, "{rule:?}: the example gives {found:?}");
        let found = findings_of_example(rule, "Use instead");
        assert!(found.is_empty(), "{rule:?}: the good example gives {found:?}");
    }
}

#[test]
fn a_fix_removes_its_finding_and_edits_are_in_order() {
    for rule in ALL.iter() {
        let (file_name, bad) = example(rule, "Example");
        for finding in lint(rule, &file_name, &Datasheet::parse(&bad)) {
            let Some(fix) = finding.fix else { continue };
            assert!(fix.edits.windows(2).all(|pair| pair[0].span.end <= pair[1].span.start), "{rule:?}");
            let found = findings_in(rule, &file_name, &fix.apply(&bad));
            assert!(found.is_empty(), "{rule:?}: after the fix there is still {found:?}");
        }
    }
}

#[test]
fn no_rule_panics_on_the_examples_of_the_others() {
    for rule in ALL.iter() {
        for heading in ["Example", "Use instead"] {
            let (file_name, text) = example(rule, heading);
            for end in 0..text.len() {
                for other in ALL.iter().step_by(7) {
                    lint(other, &file_name, &Datasheet::parse(&text[..end]));
                }
            }
        }
    }
}

/// What a rule finds in the example under a heading, among the files that the documentation shows with it.
fn findings_of_example(rule: &'static Rule, heading: &str) -> Vec<String> {
    let (file_name, text) = example(rule, heading);
    let folder = neighbours(rule, heading);
    if folder.is_empty() {
        return findings_in(rule, &file_name, &text);
    }
    let text = String::from_utf8(text).expect("examples with neighbours are UTF-8");
    findings_among(rule, &file_name, &text, &folder)
}

/// The fenced files behind the example: their fences say a file name too, as in `dcf drive.dcf`.
fn neighbours(rule: &Rule, heading: &str) -> Folder {
    let section = rule.section(heading).unwrap();
    let fences = section.split("```").skip(3).step_by(2);
    let mut folder = Folder::default();
    for fence in fences {
        let (info, text) = fence.split_once('\n').unwrap();
        let (_, name) =
            info.split_once(' ').unwrap_or_else(|| panic!("{rule:?}: a second example has no name"));
        folder = folder.with(name, text);
    }
    folder
}

/// The fenced example under a heading and a file name for it: the fence says `eds`, `dcf` or `cpj`, and `escaped`
/// where `\r`, `\x1A` and the like stand for bytes that cannot be shown.
fn example(rule: &Rule, heading: &str) -> (String, Vec<u8>) {
    let section = rule.section(heading).unwrap();
    let (_, fenced) =
        section.split_once("```").unwrap_or_else(|| panic!("{rule:?}: no example under {heading}"));
    let (language, rest) = fenced.split_once('\n').unwrap();
    let (text, _) =
        rest.split_once("```").unwrap_or_else(|| panic!("{rule:?}: the example under {heading} has no end"));
    let ending = language.split(' ').next().unwrap();
    assert!(["eds", "dcf", "cpj"].contains(&ending), "{rule:?}: the example is `{language}`");
    let bytes = if language.ends_with("escaped") { unescape(text) } else { text.as_bytes().to_vec() };
    (format!("example.{ending}"), bytes)
}

fn unescape(text: &str) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut rest = text.as_bytes();
    while let Some((&byte, after)) = rest.split_first() {
        let (byte, after) = match (byte, after) {
            (b'\\', [b'r', after @ ..]) => (b'\r', after),
            (b'\\', [b't', after @ ..]) => (b'\t', after),
            (b'\\', [b'x', high, low, after @ ..]) => {
                let digits = [*high, *low];
                let digits = std::str::from_utf8(&digits).unwrap();
                (u8::from_str_radix(digits, 16).unwrap(), after)
            }
            _ => (byte, after),
        };
        bytes.push(byte);
        rest = after;
    }
    bytes
}

#[test]
fn every_finding_of_another_tool_has_a_rule_or_a_reason_and_no_rule_names_one_that_is_not_listed() {
    let mut listed = HashSet::new();
    for finding in PEER_FINDINGS {
        let place = (finding.peer, finding.id);
        assert!(listed.insert(place), "{place:?} is listed twice");
        let is_covered = ALL.iter().any(|rule| rule.peers.contains(&place));
        assert_ne!(
            is_covered,
            finding.reason.is_some(),
            "{place:?} needs a rule, or a reason why there is none"
        );
    }
    for rule in ALL.iter() {
        for place in rule.peers {
            assert!(listed.contains(place), "{rule:?} names {place:?}, which is not listed");
        }
    }
}
