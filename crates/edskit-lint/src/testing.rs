//! Helpers of the rules' own tests.

use crate::{FileKind, Finding, Linter, Neighbours, Rule, RuleSet};
use edskit_model::Datasheet;
use std::collections::HashMap;
use std::rc::Rc;

/// What one rule finds in an EDS, one text for each finding: `line:column severity: message`.
pub(crate) fn findings(rule: &'static Rule, text: &str) -> Vec<String> {
    findings_in(rule, "test.eds", text.as_bytes())
}

/// The same for any bytes and a file name that says which kind of file it is.
pub(crate) fn findings_in(rule: &'static Rule, file_name: &str, bytes: &[u8]) -> Vec<String> {
    let sheet = Datasheet::parse(bytes);
    lint(rule, file_name, &sheet).iter().map(|finding| shown(&sheet, finding)).collect()
}

/// The text after the fix of every finding, made one after the other; findings without a fix stay.
pub(crate) fn fixed(rule: &'static Rule, text: &str) -> String {
    let bytes = fixed_in(rule, "test.eds", text.as_bytes());
    String::from_utf8(bytes).expect("fixes of UTF-8 give UTF-8")
}

/// The same for any bytes and a file name that says which kind of file it is.
pub(crate) fn fixed_in(rule: &'static Rule, file_name: &str, bytes: &[u8]) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    for _ in 0..100 {
        let sheet = Datasheet::parse(&bytes);
        let Some(fix) = lint(rule, file_name, &sheet).into_iter().find_map(|finding| finding.fix) else {
            return bytes;
        };
        let after = fix.apply(&bytes);
        assert_ne!(after, bytes, "{}: a fix must change the file", rule.code);
        bytes = after;
    }
    panic!("{}: the fixes do not converge", rule.code);
}

pub(crate) fn lint(rule: &'static Rule, file_name: &str, sheet: &Datasheet) -> Vec<Finding> {
    Linter::new(RuleSet::only(&[rule])).lint(sheet, FileKind::of(file_name), Some(file_name))
}

/// Files beside the one that is linted, by their relative names.
#[derive(Default)]
pub(crate) struct Folder(HashMap<String, Rc<Datasheet>>);

impl Folder {
    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The folder with one file more.
    pub(crate) fn with(mut self, name: &str, text: &str) -> Self {
        self.0.insert(name.to_owned(), Rc::new(Datasheet::parse(text.as_bytes())));
        self
    }
}

impl Neighbours for Folder {
    fn exists(&self, relative: &str) -> Option<bool> {
        Some(self.0.contains_key(relative))
    }

    fn sheet(&self, relative: &str) -> Option<Rc<Datasheet>> {
        self.0.get(relative).cloned()
    }
}

/// What one rule finds in a file among others.
pub(crate) fn findings_among(
    rule: &'static Rule,
    file_name: &str,
    text: &str,
    folder: &Folder,
) -> Vec<String> {
    let sheet = Datasheet::parse(text.as_bytes());
    let linter = Linter::new(RuleSet::only(&[rule]));
    let findings = linter.lint_among(&sheet, FileKind::of(file_name), Some(file_name), folder);
    findings.iter().map(|finding| shown(&sheet, finding)).collect()
}

fn shown(sheet: &Datasheet, finding: &Finding) -> String {
    let place = sheet.document().position(finding.span().start);
    format!("{place} {}: {}", finding.severity, finding.message)
}
