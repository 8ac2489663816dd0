//! `edskit.toml`: which rules run where. It is found upwards from each file.

use crate::files::another_own_file;
use crate::profiles::{self, Unusable};
use edskit_lint::{Profile, RuleSet, Severity, UnknownRule};
use edskit_model::own_file::OwnFile;
use globset::{GlobBuilder, GlobSet, GlobSetBuilder};
use serde::Deserialize;
use std::collections::{BTreeMap, HashMap};
use std::fmt;
use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf, absolute};
use std::sync::Arc;
use toml::Spanned;

/// The name of the file.
pub(crate) const FILE_NAME: &str = "edskit.toml";

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
    /// How bad the findings of a rule are.
    #[serde(default)]
    severity: BTreeMap<Spanned<String>, Severity>,
    /// Other rules for some files; not in an override.
    #[serde(default, rename = "override")]
    overrides: Vec<Spanned<Table>>,
}

/// What one `edskit.toml` says.
#[derive(Debug)]
pub(crate) struct Settings {
    folder: PathBuf,
    rules: RuleSet,
    profiles: Arc<[Profile]>,
    overrides: Vec<(GlobSet, Table)>,
}

impl Settings {
    /// What holds without a file.
    pub(crate) fn none() -> Self {
        Self {
            folder: PathBuf::new(),
            rules: RuleSet::default(),
            profiles: Arc::default(),
            overrides: Vec::new(),
        }
    }

    /// Reads and checks a file.
    pub(crate) fn read(path: &Path) -> Result<Self, SettingsError> {
        let plain = |message: String| SettingsError { path: path.to_path_buf(), place: None, message };
        let text = fs::read_to_string(path).map_err(|error| plain(error.to_string()))?;
        if let Some(reason) = another_own_file(text.as_bytes(), OwnFile::Settings) {
            return Err(plain(reason));
        }
        let at = |span: Range<usize>, message: String| SettingsError {
            path: path.to_path_buf(),
            place: Some(line_and_column(&text, span.start)),
            message,
        };
        let table: Table = toml::from_str(&text)
            .map_err(|error| at(error.span().unwrap_or(0..0), error.message().to_owned()))?;
        if let Some(files) = &table.files {
            return Err(at(files.span(), "`files` belongs into an `[[override]]`".to_owned()));
        }
        let unknown = |(span, error): (Range<usize>, UnknownRule)| at(span, error.to_string());
        let mut rules = RuleSet::default();
        table.change(&mut rules).map_err(unknown)?;
        let listed = table.profiles.map(Spanned::into_inner).unwrap_or_default();
        let mut overrides = Vec::new();
        for wrapped in table.overrides {
            let span = wrapped.span();
            let table = wrapped.into_inner();
            if !table.overrides.is_empty() {
                return Err(at(span, "an `[[override]]` cannot hold another".to_owned()));
            }
            if let Some(profiles) = &table.profiles {
                let message = "profiles hold for all files: write `profiles` before the first table";
                return Err(at(profiles.span(), message.to_owned()));
            }
            let Some(files) = &table.files else {
                return Err(at(span, "an `[[override]]` needs `files`, a list of globs".to_owned()));
            };
            let globs = globs(files.get_ref()).map_err(|(span, message)| at(span, message))?;
            table.change(&mut RuleSet::default()).map_err(unknown)?;
            overrides.push((globs, table));
        }
        let folder =
            absolute(path).ok().and_then(|path| path.parent().map(Path::to_path_buf)).unwrap_or_default();
        let mut profiles = Vec::new();
        for name in listed {
            let read = profiles::read(&folder.join(name.get_ref()));
            profiles.push(read.map_err(|error| SettingsError::profile(error, at, name.span()))?);
        }
        Ok(Self { folder, rules, profiles: profiles.into(), overrides })
    }

    /// The profiles that devices are held to besides those of CiA.
    pub(crate) fn profiles(&self) -> &Arc<[Profile]> {
        &self.profiles
    }

    /// The rules for one file.
    pub(crate) fn rules_for(&self, file: &Path) -> RuleSet {
        let mut rules = self.rules.clone();
        if self.overrides.is_empty() {
            return rules;
        }
        let whole = absolute(file).unwrap_or_else(|_| file.to_path_buf());
        let relative = whole.strip_prefix(&self.folder).unwrap_or(&whole);
        for (_, table) in self.overrides.iter().filter(|(globs, _)| globs.is_match(relative)) {
            // Every selector was tried when the file was read.
            let tried = table.change(&mut rules);
            debug_assert!(tried.is_ok());
        }
        rules
    }
}

impl Table {
    /// Changes `rules` as the table says; the error names the place of a selector that names no rule.
    fn change(&self, rules: &mut RuleSet) -> Result<(), (Range<usize>, UnknownRule)> {
        let placed = |selector: &Spanned<String>| {
            let span = selector.span();
            move |error| (span, error)
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

fn globs(patterns: &[Spanned<String>]) -> Result<GlobSet, (Range<usize>, String)> {
    let mut set = GlobSetBuilder::new();
    for pattern in patterns {
        let glob = GlobBuilder::new(pattern.get_ref()).literal_separator(true).build();
        set.add(glob.map_err(|error| (pattern.span(), error.to_string()))?);
    }
    set.build().map_err(|error| (0..0, error.to_string()))
}

/// Finds and reads the settings of files, each file once.
#[derive(Default)]
pub(crate) struct Finder {
    /// For each folder that was looked at the settings that hold in it.
    folders: HashMap<PathBuf, Option<Arc<Settings>>>,
}

impl Finder {
    /// The settings that hold for files in `folder`: those of the nearest `edskit.toml` upwards.
    pub(crate) fn find(&mut self, folder: &Path) -> Result<Option<Arc<Settings>>, SettingsError> {
        let folder = absolute(folder).unwrap_or_else(|_| folder.to_path_buf());
        if let Some(known) = self.folders.get(&folder) {
            return Ok(known.clone());
        }
        let candidate = folder.join(FILE_NAME);
        let found = if candidate.is_file() {
            Some(Arc::new(Settings::read(&candidate)?))
        } else {
            folder.parent().map_or(Ok(None), |parent| self.find(parent))?
        };
        self.folders.insert(folder, found.clone());
        Ok(found)
    }
}

/// What is wrong with a settings file.
#[derive(Debug)]
pub(crate) struct SettingsError {
    path: PathBuf,
    /// Line and column, from 1.
    place: Option<(usize, usize)>,
    message: String,
}

impl SettingsError {
    /// A profile that is not there is a mistake of the settings; a mistake in the profile is one of its own.
    fn profile(
        error: Unusable,
        at: impl Fn(Range<usize>, String) -> SettingsError,
        span: Range<usize>,
    ) -> SettingsError {
        match error {
            Unusable::Unreadable(..) | Unusable::Another(..) => at(span, error.to_string()),
            Unusable::Wrong(path, error) => {
                Self { path, place: Some((error.line, error.column)), message: error.message }
            }
        }
    }
}

impl fmt::Display for SettingsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.path.display())?;
        if let Some((line, column)) = self.place {
            write!(f, ":{line}:{column}")?;
        }
        write!(f, ": {}", self.message)
    }
}

fn line_and_column(text: &str, offset: usize) -> (usize, usize) {
    let before = text.get(..offset).unwrap_or_default();
    let line_start = before.rfind('\n').map_or(0, |position| position + 1);
    (before.matches('\n').count() + 1, before[line_start..].chars().count() + 1)
}
