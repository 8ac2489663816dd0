//! `edskit.toml`: which rules run where. It is found upwards from each file.

use crate::files::another_own_file;
use crate::paths;
use crate::profiles::{self, Unusable};
use edskit_lint::{Profile, RuleSet, Severity, UnknownRule};
use edskit_model::own_file::OwnFile;
use globset::{GlobBuilder, GlobSet, GlobSetBuilder};
use serde::Deserialize;
use std::collections::{BTreeMap, HashMap};
use std::fmt;
use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use toml::Spanned;

/// The name of the file.
pub(crate) const FILE_NAME: &str = "edskit.toml";

/// What is said of a file that was named and is left out.
pub(crate) const EXCLUDED: &str = "left out, because `exclude` of edskit.toml names it";

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
#[derive(Debug)]
pub(crate) struct Settings {
    folder: PathBuf,
    rules: RuleSet,
    profiles: Arc<[Profile]>,
    exclude: GlobSet,
    fail_on: Option<Severity>,
    baseline: Option<PathBuf>,
    overrides: Vec<(GlobSet, Table)>,
}

impl Settings {
    /// What holds without a file.
    pub(crate) fn none() -> Self {
        Self {
            folder: PathBuf::new(),
            rules: RuleSet::default(),
            profiles: Arc::default(),
            exclude: GlobSet::empty(),
            fail_on: None,
            baseline: None,
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
            if let Some((key, place)) = table.for_all_files() {
                let message = format!("`{key}` holds for all files: write it before the first table");
                return Err(at(place, message));
            }
            let Some(files) = &table.files else {
                return Err(at(span, "an `[[override]]` needs `files`, a list of globs".to_owned()));
            };
            let globs = globs(files.get_ref()).map_err(|(span, message)| at(span, message))?;
            table.change(&mut RuleSet::default()).map_err(unknown)?;
            overrides.push((globs, table));
        }
        let exclude = table.exclude.map(Spanned::into_inner).unwrap_or_default();
        let exclude = globs(&exclude).map_err(|(span, message)| at(span, message))?;
        let fail_on = table.fail_on.map(Spanned::into_inner);
        let folder = paths::folder(path.parent().unwrap_or(Path::new("")));
        let baseline = table.baseline.map(|baseline| folder.join(baseline.into_inner()));
        let mut profiles = Vec::new();
        for name in listed {
            let read = profiles::read(&folder.join(name.get_ref()));
            profiles.push(read.map_err(|error| SettingsError::profile(error, at, name.span()))?);
        }
        Ok(Self { folder, rules, profiles: profiles.into(), exclude, fail_on, baseline, overrides })
    }

    /// The profiles that devices are held to besides those of CiA.
    pub(crate) fn profiles(&self) -> &Arc<[Profile]> {
        &self.profiles
    }

    /// From which severity on findings make the command fail, where the file says it.
    pub(crate) fn fail_on(&self) -> Option<Severity> {
        self.fail_on
    }

    /// The baseline, where the file names one.
    pub(crate) fn baseline(&self) -> Option<&Path> {
        self.baseline.as_deref()
    }

    /// Whether a file is left alone.
    pub(crate) fn excludes(&self, file: &Path) -> bool {
        !self.exclude.is_empty() && self.exclude.is_match(self.relative(file))
    }

    /// A file as the globs see it: from the folder of the settings.
    fn relative(&self, file: &Path) -> PathBuf {
        paths::relative(&self.folder, &paths::whole(file))
    }

    /// The rules for one file.
    pub(crate) fn rules_for(&self, file: &Path) -> RuleSet {
        let mut rules = self.rules.clone();
        if self.overrides.is_empty() {
            return rules;
        }
        let relative = self.relative(file);
        for (_, table) in self.overrides.iter().filter(|(globs, _)| globs.is_match(&relative)) {
            // Every selector was tried when the file was read.
            let tried = table.change(&mut rules);
            debug_assert!(tried.is_ok());
        }
        rules
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
        self.find_upwards(paths::folder(folder))
    }

    /// The same for a file.
    pub(crate) fn find_for(&mut self, file: &Path) -> Result<Option<Arc<Settings>>, SettingsError> {
        self.find(file.parent().unwrap_or(Path::new("")))
    }

    fn find_upwards(&mut self, folder: PathBuf) -> Result<Option<Arc<Settings>>, SettingsError> {
        if let Some(known) = self.folders.get(&folder) {
            return Ok(known.clone());
        }
        let candidate = folder.join(FILE_NAME);
        let found = if candidate.is_file() {
            Some(Arc::new(Settings::read(&candidate)?))
        } else {
            folder.parent().map_or(Ok(None), |parent| self.find_upwards(parent.to_path_buf()))?
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
