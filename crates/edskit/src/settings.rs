//! `edskit.toml` is found upwards from each file.

use crate::paths;
use crate::profiles::{self, Unusable};
use edskit_lint::{Profile, RuleSet, SETTINGS_FILE, Severity};
use std::collections::HashMap;
use std::fmt;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// What is said of a file that was named and is left out.
pub(crate) const EXCLUDED: &str = "left out, because `exclude` of edskit.toml names it";

/// What one `edskit.toml` says, with the profiles that it names.
#[derive(Debug, Default)]
pub(crate) struct Settings {
    folder: PathBuf,
    said: edskit_lint::Settings,
    profiles: Arc<[Profile]>,
    baseline: Option<PathBuf>,
}

impl Settings {
    /// Reads and checks a file.
    pub(crate) fn read(path: &Path) -> Result<Self, SettingsError> {
        let wrong = |place: Option<(usize, usize)>, message: String| SettingsError {
            path: path.to_path_buf(),
            place,
            message,
        };
        let text = fs::read_to_string(path).map_err(|error| wrong(None, error.to_string()))?;
        let said = edskit_lint::Settings::parse(&text).map_err(|error| wrong(error.place, error.message))?;
        let folder = paths::folder(path.parent().unwrap_or(Path::new("")));
        let mut profiles = Vec::new();
        for named in said.profiles() {
            let read = profiles::read(&folder.join(&named.path));
            profiles.push(read.map_err(|error| match error {
                // A profile that is not there is a mistake of the settings; a mistake in the profile is one of its own.
                Unusable::Unreadable(..) | Unusable::Another(..) => {
                    wrong(Some((named.line, named.column)), error.to_string())
                }
                Unusable::Wrong(path, error) => {
                    SettingsError { path, place: Some((error.line, error.column)), message: error.message }
                }
            })?);
        }
        let baseline = said.baseline().map(|baseline| folder.join(baseline));
        Ok(Self { folder, said, profiles: profiles.into(), baseline })
    }

    /// The profiles that devices are held to besides those of CiA.
    pub(crate) fn profiles(&self) -> &Arc<[Profile]> {
        &self.profiles
    }

    /// From which severity on findings make the command fail, where the file says it.
    pub(crate) fn fail_on(&self) -> Option<Severity> {
        self.said.fail_on()
    }

    /// The baseline, where the file names one.
    pub(crate) fn baseline(&self) -> Option<&Path> {
        self.baseline.as_deref()
    }

    /// Whether a file is left alone.
    pub(crate) fn excludes(&self, file: &Path) -> bool {
        self.said.excludes_any() && self.said.excludes(&self.relative(file))
    }

    /// The rules for one file.
    pub(crate) fn rules_for(&self, file: &Path) -> RuleSet {
        let relative = if self.said.has_overrides() { self.relative(file) } else { String::new() };
        self.said.rules_for(&relative)
    }

    /// A file as the settings see it: from their folder.
    fn relative(&self, file: &Path) -> String {
        paths::text(&paths::relative(&self.folder, &paths::whole(file)))
    }
}

/// Finds and reads the settings of files, each file once.
#[derive(Default)]
pub(crate) struct Finder {
    /// For each folder that was looked at the settings that hold in it.
    folders: HashMap<PathBuf, Option<Arc<Settings>>>,
    /// The same for folders as they are typed.
    typed: HashMap<PathBuf, Option<Arc<Settings>>>,
}

impl Finder {
    /// The settings that hold for files in `folder`: those of the nearest `edskit.toml` upwards.
    pub(crate) fn find(&mut self, folder: &Path) -> Result<Option<Arc<Settings>>, SettingsError> {
        if let Some(known) = self.typed.get(folder) {
            return Ok(known.clone());
        }
        let found = self.find_upwards(paths::folder(folder))?;
        self.typed.insert(folder.to_path_buf(), found.clone());
        Ok(found)
    }

    /// The same for a file.
    pub(crate) fn find_for(&mut self, file: &Path) -> Result<Option<Arc<Settings>>, SettingsError> {
        self.find(file.parent().unwrap_or(Path::new("")))
    }

    fn find_upwards(&mut self, folder: PathBuf) -> Result<Option<Arc<Settings>>, SettingsError> {
        if let Some(known) = self.folders.get(&folder) {
            return Ok(known.clone());
        }
        let candidate = folder.join(SETTINGS_FILE);
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

impl fmt::Display for SettingsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.path.display())?;
        if let Some((line, column)) = self.place {
            write!(f, ":{line}:{column}")?;
        }
        write!(f, ": {}", self.message)
    }
}
