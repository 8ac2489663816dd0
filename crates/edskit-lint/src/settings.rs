//! What `edskit.toml` says: which rules run where. The command line and build scripts find the file, each in its way.

use crate::{RuleSet, Severity, UnknownRule};
use core::fmt;
use core::ops::Range;
use edskit_model::nearest;
use edskit_model::own_file::OwnFile;
use globset::{GlobBuilder, GlobSet, GlobSetBuilder};
use serde::Deserialize;
use std::collections::BTreeMap;
use toml::Spanned;

/// The name of the file.
pub const FILE_NAME: &str = "edskit.toml";

/// The keys of a table, for those who mistype one.
const KEYS: [&str; 10] = [
    "files",
    "select",
    "extend-select",
    "ignore",
    "profiles",
    "exclude",
    "fail-on",
    "baseline",
    "severity",
    "override",
];

/// One table of the file: the whole of it, or one `[[override]]`.
#[derive(Deserialize, Debug, Default)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct Table {
    /// Globs, relative to the folder of the file; only in an override.
    files: Option<Spanned<Vec<Spanned<String>>>>,
    /// Run only these rules.
    select: Option<Vec<Spanned<String>>>,
    /// Run these rules too.
    #[serde(default)]
    extend_select: Vec<Spanned<String>>,
    /// Do not run these rules.
    #[serde(default)]
    ignore: Vec<Spanned<String>>,
    /// Profile files, relative to the folder of the file; not in an override.
    profiles: Option<Spanned<Vec<Spanned<String>>>>,
    /// Files that are left alone: globs, relative to the folder of the file; not in an override.
    exclude: Option<Spanned<Vec<Spanned<String>>>>,
    /// From which severity on findings make the command fail; not in an override.
    fail_on: Option<Spanned<Severity>>,
    /// The findings that are known, in a file beside this one; not in an override.
    baseline: Option<Spanned<String>>,
    /// How bad the findings of a rule are.
    #[serde(default)]
    severity: BTreeMap<Spanned<String>, Severity>,
    /// Other rules for some files; not in an override.
    #[serde(default, rename = "override")]
    overrides: Vec<Spanned<Table>>,
}

/// What one `edskit.toml` says.
#[derive(Debug, Default)]
pub struct Settings {
    rules: RuleSet,
    profiles: Vec<ProfilePath>,
    exclude: GlobSet,
    fail_on: Option<Severity>,
    baseline: Option<String>,
    overrides: Vec<(GlobSet, Table)>,
}

/// A profile file that the settings name.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ProfilePath {
    /// The path as it is written, relative to the folder of the settings.
    pub path: String,
    /// The line where it stands, from 1.
    pub line: usize,
    /// The column where it stands, in characters from 1.
    pub column: usize,
}

/// What is wrong with a settings file, and where.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct SettingsError {
    /// The line and the column, in characters, from 1; `None` where the whole file is another one.
    pub place: Option<(usize, usize)>,
    /// What is wrong.
    pub message: String,
}

/// `12:7: what is wrong`.
impl fmt::Display for SettingsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some((line, column)) = self.place {
            write!(f, "{line}:{column}: ")?;
        }
        f.write_str(&self.message)
    }
}

impl core::error::Error for SettingsError {}

impl Settings {
    /// Reads and checks a file.
    ///
    /// ```
    /// use edskit_lint::Settings;
    /// let error = Settings::parse("\nignroe = ['SYN']\n").unwrap_err();
    /// assert_eq!(error.to_string(), "2:1: unknown key `ignroe`; did you mean `ignore`?");
    /// ```
    ///
    /// # Errors
    /// What is wrong, and where.
    pub fn parse(text: &str) -> Result<Self, SettingsError> {
        if let Some(message) = OwnFile::of(text).and_then(|own| own.instead_of(OwnFile::Settings)) {
            return Err(SettingsError { place: None, message });
        }
        read(text).map_err(|(span, message)| SettingsError {
            place: Some(line_and_column(text, span.start)),
            message,
        })
    }

    /// The profiles that devices are held to besides those of CiA.
    pub fn profiles(&self) -> &[ProfilePath] {
        &self.profiles
    }

    /// From which severity on findings make the command fail, where the file says it.
    pub fn fail_on(&self) -> Option<Severity> {
        self.fail_on
    }

    /// The path of the baseline from the folder of the settings, where the file names one.
    pub fn baseline(&self) -> Option<&str> {
        self.baseline.as_deref()
    }

    /// Whether any file is left alone.
    pub fn excludes_any(&self) -> bool {
        !self.exclude.is_empty()
    }

    /// Whether a file is left alone. Its path is seen from the folder of the settings, with `/` between its parts.
    pub fn excludes(&self, file: &str) -> bool {
        self.exclude.is_match(file)
    }

    /// Whether all files have the same rules.
    pub fn has_overrides(&self) -> bool {
        !self.overrides.is_empty()
    }

    /// The rules for one file. Its path is seen from the folder of the settings, with `/` between its parts.
    pub fn rules_for(&self, file: &str) -> RuleSet {
        let mut rules = self.rules.clone();
        for (_, table) in self.overrides.iter().filter(|(globs, _)| globs.is_match(file)) {
            // Every selector was tried when the file was read.
            let tried = table.change(&mut rules);
            debug_assert!(tried.is_ok());
        }
        rules
    }
}

/// What is wrong, and at which bytes.
type Complaint = (Range<usize>, String);

fn read(text: &str) -> Result<Settings, Complaint> {
    let table: Table = toml::from_str(text)
        .map_err(|error| (error.span().unwrap_or_default(), what_is_wrong(error.message())))?;
    if let Some(files) = &table.files {
        return Err((files.span(), "`files` belongs into an `[[override]]`".to_owned()));
    }
    let mut rules = RuleSet::default();
    table.change(&mut rules)?;
    let mut overrides = Vec::new();
    for wrapped in table.overrides {
        let span = wrapped.span();
        let table = wrapped.into_inner();
        if !table.overrides.is_empty() {
            return Err((span, "an `[[override]]` cannot hold another".to_owned()));
        }
        if let Some((key, place)) = table.for_all_files() {
            return Err((place, format!("`{key}` holds for all files: write it before the first table")));
        }
        let Some(files) = &table.files else {
            return Err((span, "an `[[override]]` needs `files`, a list of globs".to_owned()));
        };
        let globs = globs(files.get_ref())?;
        table.change(&mut RuleSet::default())?;
        overrides.push((globs, table));
    }
    let exclude = globs(&table.exclude.map(Spanned::into_inner).unwrap_or_default())?;
    let profiles = table.profiles.map(Spanned::into_inner).unwrap_or_default();
    let profiles = profiles.into_iter().map(|path| {
        let (line, column) = line_and_column(text, path.span().start);
        ProfilePath { path: path.into_inner(), line, column }
    });
    Ok(Settings {
        rules,
        profiles: profiles.collect(),
        exclude,
        fail_on: table.fail_on.map(Spanned::into_inner),
        baseline: table.baseline.map(Spanned::into_inner),
        overrides,
    })
}

/// The message of the reader of TOML in one line, with the key that was meant where one is unknown.
fn what_is_wrong(message: &str) -> String {
    let unknown = message.strip_prefix("unknown field `").and_then(|rest| rest.split_once('`'));
    match unknown.map(|(key, _)| (key, nearest(key, KEYS))) {
        Some((key, Some(meant))) => format!("unknown key `{key}`; did you mean `{meant}`?"),
        Some((key, None)) => format!("unknown key `{key}`; there are `{}`", KEYS.join("`, `")),
        None => message.trim().replace('\n', ", "),
    }
}

impl Table {
    /// A key that holds for all files and has no place in an override, if there is one.
    fn for_all_files(&self) -> Option<(&'static str, Range<usize>)> {
        let profiles = self.profiles.as_ref().map(|profiles| ("profiles", profiles.span()));
        let exclude = self.exclude.as_ref().map(|exclude| ("exclude", exclude.span()));
        let fail_on = self.fail_on.as_ref().map(|fail_on| ("fail-on", fail_on.span()));
        let baseline = self.baseline.as_ref().map(|baseline| ("baseline", baseline.span()));
        profiles.or(exclude).or(fail_on).or(baseline)
    }

    /// Changes `rules` as the table says; the error names the place of a selector that names no rule.
    fn change(&self, rules: &mut RuleSet) -> Result<(), Complaint> {
        let placed = |selector: &Spanned<String>| {
            let span = selector.span();
            move |error: UnknownRule| (span, error.to_string())
        };
        if let Some(selected) = &self.select {
            *rules = rules.clone().without_any();
            for selector in selected {
                rules.select(selector.get_ref()).map_err(placed(selector))?;
            }
        }
        for selector in &self.extend_select {
            rules.select(selector.get_ref()).map_err(placed(selector))?;
        }
        for selector in &self.ignore {
            rules.ignore(selector.get_ref()).map_err(placed(selector))?;
        }
        for (selector, severity) in &self.severity {
            rules.set_severity(selector.get_ref(), *severity).map_err(placed(selector))?;
        }
        Ok(())
    }
}

fn globs(patterns: &[Spanned<String>]) -> Result<GlobSet, Complaint> {
    let mut set = GlobSetBuilder::new();
    for pattern in patterns {
        let glob = GlobBuilder::new(pattern.get_ref()).literal_separator(true).build();
        set.add(glob.map_err(|error| (pattern.span(), error.to_string()))?);
    }
    let place = patterns.first().map(Spanned::span).unwrap_or_default();
    set.build().map_err(|error| (place, error.to_string()))
}

/// Line and column, in characters, of an offset in a text, both from 1.
pub(crate) fn line_and_column(text: &str, offset: usize) -> (usize, usize) {
    let before = text.get(..offset).unwrap_or(text);
    let line_start = before.rfind('\n').map_or(0, |position| position + 1);
    (before.matches('\n').count() + 1, before[line_start..].chars().count() + 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::find;

    #[test]
    fn rules_and_severities_hold_for_the_files_they_are_said_of() {
        let text = "ignore = ['VAL002']\nfail-on = 'error'\nexclude = ['x/**']\nprofiles = ['pumps.toml']\n\
            baseline = 'old.json'\n[severity]\nOBJ015 = 'error'\n[[override]]\nfiles = ['eds/**']\nselect = ['SYN']\n";
        let settings = Settings::parse(text).unwrap();
        let rule = |code| find(code).unwrap()[0];
        let elsewhere = settings.rules_for("Device.eds");
        assert!(!elsewhere.is_enabled(rule("VAL002")) && elsewhere.is_enabled(rule("OBJ015")));
        assert_eq!(elsewhere.said_severity(rule("OBJ015")), Some(Severity::Error));
        let inside = settings.rules_for("eds/Device.eds");
        assert!(!inside.is_enabled(rule("OBJ015")) && inside.is_enabled(rule("SYN012")));
        assert_eq!(settings.profiles(), [ProfilePath { path: "pumps.toml".to_owned(), line: 4, column: 13 }]);
        assert_eq!((settings.fail_on(), settings.baseline()), (Some(Severity::Error), Some("old.json")));
        assert!(settings.excludes("x/y/z.eds") && !settings.excludes("y/x/z.eds"));
    }

    #[test]
    fn what_is_wrong_has_a_place() {
        for (text, told) in [
            ("ignore = ['VAL999']\n", "1:11: there is no rule `VAL999`"),
            ("\nselect = ['SYN']\nignroe = []\n", "3:1: unknown key `ignroe`; did you mean `ignore`?"),
            (
                "[[override]]\nfiles = ['a']\nseverty = {}\n",
                "3:1: unknown key `severty`; did you mean `severity`?",
            ),
            (
                "[[override]]\nfiles = ['a', 'b[']\n",
                "2:15: error parsing glob 'b[': unclosed character class",
            ),
            ("exclude = [\n  '[',\n]\n", "2:3: error parsing glob '[': unclosed character class"),
            ("[gateway]\n427 = 5\n", "this is a parameter file of edskit: "),
        ] {
            let error = Settings::parse(text).unwrap_err().to_string();
            assert!(error.starts_with(told), "{error}");
        }
        let all = Settings::parse("colour = 'blue'\n").unwrap_err().message;
        assert!(all.starts_with("unknown key `colour`; there are `files`, `select`"), "{all}");
        assert!(Settings::parse("\nignore = 5\n").unwrap_err().to_string().starts_with("2:10: invalid type"));
        assert!(!Settings::parse("select = [\n").unwrap_err().message.contains('\n'));
    }

    #[test]
    fn every_key_is_known_by_its_name() {
        for key in KEYS {
            let error = toml::from_str::<Table>(&format!("{key} = 1.5\n")).unwrap_err();
            assert!(!error.message().contains("unknown field"), "{key}: {error}");
        }
        let error = toml::from_str::<Table>("x = 1\n").unwrap_err();
        assert_eq!(error.message().matches('`').count() / 2, KEYS.len() + 1, "{error}");
    }
}
