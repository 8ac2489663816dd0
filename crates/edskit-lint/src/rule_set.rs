//! Which rules run, and how bad their findings are.

use crate::rules::ALL;
use crate::{Finding, Rule, Severity};
use core::fmt;

/// The rules of a run.
#[derive(Clone, Debug)]
pub struct RuleSet {
    /// One for each rule of [`ALL`], in its order.
    states: Vec<State>,
}

#[derive(Clone, Copy, Debug)]
struct State {
    enabled: bool,
    severity: Option<Severity>,
}

impl Default for RuleSet {
    /// The rules that are on where nobody says anything.
    fn default() -> Self {
        let state = |rule: &&'static Rule| State { enabled: rule.enabled, severity: None };
        Self { states: ALL.iter().map(state).collect() }
    }
}

impl RuleSet {
    /// No rule at all.
    pub fn none() -> Self {
        Self { states: vec![State { enabled: false, severity: None }; ALL.len()] }
    }

    /// Every rule.
    pub fn all() -> Self {
        Self { states: vec![State { enabled: true, severity: None }; ALL.len()] }
    }

    /// Just these rules.
    pub fn only(rules: &[&'static Rule]) -> Self {
        let state = |rule: &&'static Rule| State { enabled: rules.contains(rule), severity: None };
        Self { states: ALL.iter().map(state).collect() }
    }

    /// The same severities with every rule off.
    pub fn without_any(mut self) -> Self {
        self.states.iter_mut().for_each(|state| state.enabled = false);
        self
    }

    /// Switches on what `selector` names.
    ///
    /// # Errors
    /// [`UnknownRule`] where it names nothing.
    pub fn select(&mut self, selector: &str) -> Result<(), UnknownRule> {
        self.change(selector, |state| state.enabled = true)
    }

    /// Switches off what `selector` names.
    ///
    /// # Errors
    /// [`UnknownRule`] where it names nothing.
    pub fn ignore(&mut self, selector: &str) -> Result<(), UnknownRule> {
        self.change(selector, |state| state.enabled = false)
    }

    /// Sets how bad the findings of what `selector` names are, whatever the rules say.
    ///
    /// # Errors
    /// [`UnknownRule`] where it names nothing.
    pub fn set_severity(&mut self, selector: &str, severity: Severity) -> Result<(), UnknownRule> {
        self.change(selector, |state| state.severity = Some(severity))
    }

    /// The rules that run.
    pub fn enabled(&self) -> impl Iterator<Item = &'static Rule> + '_ {
        ALL.iter().zip(&self.states).filter(|(_, state)| state.enabled).map(|(rule, _)| *rule)
    }

    /// Whether a rule runs.
    pub fn is_enabled(&self, rule: &Rule) -> bool {
        self.enabled().any(|enabled| enabled == rule)
    }

    /// How bad somebody has said the findings of a rule are; `None` where the rule itself says it.
    pub fn said_severity(&self, rule: &Rule) -> Option<Severity> {
        let position = ALL.iter().position(|known| **known == *rule)?;
        self.states[position].severity
    }

    pub(crate) fn apply_severities(&self, findings: &mut [Finding]) {
        if self.states.iter().all(|state| state.severity.is_none()) {
            return;
        }
        for finding in findings {
            let position = ALL.iter().position(|rule| *rule == finding.rule);
            if let Some(severity) = position.and_then(|position| self.states[position].severity) {
                finding.severity = severity;
            }
        }
    }

    fn change(&mut self, selector: &str, mut change: impl FnMut(&mut State)) -> Result<(), UnknownRule> {
        let mut found = false;
        for rule in find(selector)? {
            if let Some(position) = ALL.iter().position(|known| *known == rule) {
                change(&mut self.states[position]);
                found = true;
            }
        }
        debug_assert!(found, "find gives at least one rule");
        Ok(())
    }
}

/// The rules that a code (`SYN013`), a prefix of codes (`SYN`, `SYN01`), a name (`duplicate-section`) or `ALL` names.
///
/// # Errors
/// [`UnknownRule`] where there is none.
pub fn find(selector: &str) -> Result<Vec<&'static Rule>, UnknownRule> {
    let wanted = selector.trim();
    let code = wanted.to_ascii_uppercase();
    let named = |rule: &&&'static Rule| {
        code == "ALL"
            || (!code.is_empty() && rule.code.starts_with(&code))
            || rule.name.eq_ignore_ascii_case(wanted)
    };
    let rules: Vec<&'static Rule> = ALL.iter().filter(named).copied().collect();
    if rules.is_empty() {
        Err(UnknownRule { selector: wanted.to_owned(), nearest: nearest(wanted) })
    } else {
        Ok(rules)
    }
}

/// A selector that names no rule.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct UnknownRule {
    /// What was asked for.
    pub selector: String,
    /// The code or name that looks most like it.
    pub nearest: Option<&'static str>,
}

impl fmt::Display for UnknownRule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "there is no rule `{}`", self.selector)?;
        match self.nearest {
            Some(nearest) => write!(f, "; did you mean `{nearest}`?"),
            None => Ok(()),
        }
    }
}

impl core::error::Error for UnknownRule {}

fn nearest(selector: &str) -> Option<&'static str> {
    let lower = selector.to_ascii_lowercase();
    let names = ALL.iter().flat_map(|rule| [rule.code, rule.name]);
    edskit_model::nearest(&lower, names)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn selectors_are_codes_prefixes_and_names() {
        assert_eq!(find("SYN013").unwrap()[0].name, "duplicate-section");
        assert_eq!(find("duplicate-section").unwrap()[0].code, "SYN013");
        assert!(find("syn").unwrap().iter().all(|rule| rule.code.starts_with("SYN")));
        assert_eq!(find("ALL").unwrap().len(), ALL.len());
    }

    #[test]
    fn unknown_rules_get_a_suggestion() {
        let error = find("duplicate-sektion").unwrap_err();
        assert_eq!(
            error.to_string(),
            "there is no rule `duplicate-sektion`; did you mean `duplicate-section`?"
        );
        assert_eq!(find("").unwrap_err().nearest, None);
        assert_eq!(
            find("completely different").unwrap_err().to_string(),
            "there is no rule `completely different`"
        );
    }

    #[test]
    fn severities_can_be_set() {
        let mut rules = RuleSet::none();
        rules.select("SYN013").unwrap();
        rules.set_severity("SYN", Severity::Info).unwrap();
        let sheet = edskit_model::Datasheet::parse(b"[1000]\n[1000]\n");
        let findings = crate::Linter::new(rules).lint(&sheet, crate::FileKind::Eds, None);
        assert_eq!(findings.iter().map(|finding| finding.severity).collect::<Vec<_>>(), [Severity::Info]);
    }
}
