//! What `edskit.toml` says about the rules of a file, so that a build script holds a file to the same rules as `edskit lint`.
//!
//! Keys that are about the command line (`exclude`, `fail-on`, `baseline`) are none of a build's, and passed over.

use edskit_lint::{RuleSet, Severity, UnknownRule};
use globset::{GlobBuilder, GlobSet, GlobSetBuilder};
use serde::Deserialize;
use std::collections::BTreeMap;

/// The name of the file.
pub(crate) const FILE_NAME: &str = "edskit.toml";

#[derive(Deserialize, Default)]
#[serde(rename_all = "kebab-case", default)]
struct Table {
    /// Globs, relative to the folder of the file; only in an override.
    files: Vec<String>,
    select: Option<Vec<String>>,
    extend_select: Vec<String>,
    ignore: Vec<String>,
    severity: BTreeMap<String, Severity>,
    /// Profile files, relative to the folder of the file.
    profiles: Vec<String>,
    #[serde(rename = "override")]
    overrides: Vec<Table>,
}

/// The rules for one file.
#[derive(Debug)]
pub(crate) struct Rules {
    pub(crate) rules: RuleSet,
    /// Profile files, relative to the folder of the settings.
    pub(crate) profiles: Vec<String>,
}

/// The rules that a settings file gives to a file, whose path is seen from the folder of the settings, with `/` between its
/// parts.
pub(crate) fn rules_for(settings: &str, file: &str) -> Result<Rules, String> {
    let table: Table = toml::from_str(settings).map_err(|error| {
        let before = error.span().and_then(|span| settings.get(..span.start)).unwrap_or_default();
        let line = before.matches('\n').count() + 1;
        format!("{line}: {}", error.message().trim().replace('\n', ", "))
    })?;
    let mut rules = RuleSet::default();
    table.change(&mut rules).map_err(|error| format!("1: {error}"))?;
    for own in &table.overrides {
        if globs(&own.files)?.is_match(file) {
            own.change(&mut rules).map_err(|error| format!("1: {error}"))?;
        }
    }
    Ok(Rules { rules, profiles: table.profiles })
}

impl Table {
    fn change(&self, rules: &mut RuleSet) -> Result<(), UnknownRule> {
        if let Some(selected) = &self.select {
            *rules = rules.clone().without_any();
            selected.iter().try_for_each(|selector| rules.select(selector))?;
        }
        self.extend_select.iter().try_for_each(|selector| rules.select(selector))?;
        self.ignore.iter().try_for_each(|selector| rules.ignore(selector))?;
        self.severity.iter().try_for_each(|(selector, severity)| rules.set_severity(selector, *severity))
    }
}

fn globs(patterns: &[String]) -> Result<GlobSet, String> {
    let mut set = GlobSetBuilder::new();
    for pattern in patterns {
        let glob = GlobBuilder::new(pattern).literal_separator(true).build();
        set.add(glob.map_err(|error| format!("1: {error}"))?);
    }
    set.build().map_err(|error| format!("1: {error}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use edskit_lint::find;

    #[test]
    fn rules_and_severities_hold_as_in_lint() {
        let text = "ignore = ['VAL002']\nfail-on = 'error'\nexclude = ['x/**']\nprofiles = ['pumps.toml']\n\
            [severity]\nOBJ015 = 'error'\n[[override]]\nfiles = ['eds/**']\nselect = ['SYN']\n";
        let of = |file| rules_for(text, file).unwrap();
        let rule = |code| find(code).unwrap()[0];
        let elsewhere = of("Device.eds");
        assert!(!elsewhere.rules.is_enabled(rule("VAL002")) && elsewhere.rules.is_enabled(rule("OBJ015")));
        assert_eq!(elsewhere.rules.said_severity(rule("OBJ015")), Some(Severity::Error));
        assert_eq!(elsewhere.profiles, ["pumps.toml"]);
        let inside = of("eds/Device.eds");
        assert!(!inside.rules.is_enabled(rule("OBJ015")) && inside.rules.is_enabled(rule("SYN012")));
    }

    #[test]
    fn what_is_wrong_is_named() {
        assert_eq!(rules_for("ignore = ['VAL999']\n", "a").unwrap_err(), "1: there is no rule `VAL999`");
        assert!(rules_for("\nignore = 5\n", "a").unwrap_err().starts_with("2: invalid type"));
        assert!(
            rules_for("[[override]]\nfiles = ['[']\n", "a").unwrap_err().starts_with("1: error parsing glob")
        );
    }
}
