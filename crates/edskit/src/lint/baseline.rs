//! Findings that a team knows already, so that only new ones are shown.

use super::report::FileReport;
use crate::files::another_own_file;
use edskit_lint::Finding;
use edskit_model::Datasheet;
use edskit_model::own_file::OwnFile;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf, absolute};

const VERSION: u32 = 1;

/// What makes a finding the same after lines have moved: its rule, and the text it is about.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug, Serialize, Deserialize)]
pub(crate) struct Fingerprint {
    pub(crate) rule: String,
    /// The section that it stands in.
    pub(crate) section: String,
    /// The line that it points at, without blanks around it.
    pub(crate) line: String,
}

impl Fingerprint {
    pub(crate) fn of(sheet: &Datasheet, finding: &Finding) -> Self {
        let document = sheet.document();
        let number = document.line_at(finding.span().start);
        let line = document.lines().get(number).map(|line| document.text(line.trimmed(document.to_bytes())));
        let after = sheet.section_at(finding.span().start);
        Self {
            rule: finding.rule.code.to_owned(),
            section: after.map(|section| section.name().into_owned()).unwrap_or_default(),
            line: line.unwrap_or_default().into_owned(),
        }
    }
}

/// One known finding of a file.
#[derive(Serialize, Deserialize)]
struct Known {
    #[serde(flatten)]
    fingerprint: Fingerprint,
    /// How often it occurs.
    count: usize,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    version: u32,
    files: BTreeMap<String, Vec<Known>>,
}

/// A baseline file.
pub(crate) struct Baseline {
    folder: PathBuf,
    known: BTreeMap<String, BTreeMap<Fingerprint, usize>>,
}

impl Baseline {
    /// Reads a baseline; the error says what is wrong with it.
    pub(crate) fn read(path: &Path) -> Result<Self, String> {
        let name = path.display();
        let text = fs::read(path).map_err(|error| match error.kind() {
            io::ErrorKind::NotFound => {
                format!("{name}: there is no such baseline; --update-baseline makes one")
            }
            _ => format!("{name}: {error}"),
        })?;
        if let Some(reason) = another_own_file(&text, OwnFile::Baseline) {
            return Err(format!("{name}: {reason}"));
        }
        let written: Written =
            serde_json::from_slice(&text).map_err(|error| format!("{name}: this is no baseline: {error}"))?;
        if written.version != VERSION {
            return Err(format!(
                "{name}: baseline of version {}, this edskit reads {VERSION}",
                written.version
            ));
        }
        let counts =
            |known: Vec<Known>| known.into_iter().map(|known| (known.fingerprint, known.count)).collect();
        let known = written.files.into_iter().map(|(file, known)| (file, counts(known))).collect();
        Ok(Self { folder: folder_of(path), known })
    }

    /// Takes the known findings of a file out, with their fingerprints, and says how many those were.
    pub(crate) fn take_known(
        &self,
        file: &str,
        findings: &mut Vec<Finding>,
        fingerprints: &mut Vec<Fingerprint>,
    ) -> usize {
        let Some(known) = self.known.get(&relative(&self.folder, file)) else { return 0 };
        let mut left = known.clone();
        let is_new = |fingerprint: &Fingerprint| match left.get_mut(fingerprint) {
            Some(count) if *count > 0 => {
                *count -= 1;
                false
            }
            _ => true,
        };
        let new: Vec<bool> = fingerprints.iter().map(is_new).collect();
        let before = findings.len();
        retain(findings, &new);
        retain(fingerprints, &new);
        before - findings.len()
    }

    /// Writes everything that was found as known.
    pub(crate) fn write(path: &Path, files: &[FileReport]) -> io::Result<usize> {
        let folder = folder_of(path);
        let mut written = Written { version: VERSION, files: BTreeMap::new() };
        let mut total = 0;
        for file in files.iter().filter(|file| !file.fingerprints().is_empty()) {
            let mut counts: BTreeMap<&Fingerprint, usize> = BTreeMap::new();
            for fingerprint in file.fingerprints() {
                *counts.entry(fingerprint).or_default() += 1;
                total += 1;
            }
            let known = counts
                .into_iter()
                .map(|(fingerprint, count)| Known { fingerprint: fingerprint.clone(), count });
            written.files.insert(relative(&folder, &file.name), known.collect());
        }
        let mut text = serde_json::to_vec_pretty(&written)?;
        text.push(b'\n');
        fs::write(path, text)?;
        Ok(total)
    }
}

/// Keeps the items whose mark is set.
fn retain<T>(items: &mut Vec<T>, marks: &[bool]) {
    let mut marks = marks.iter();
    items.retain(|_| marks.next().copied().unwrap_or(true));
}

fn folder_of(path: &Path) -> PathBuf {
    absolute(path).ok().and_then(|path| path.parent().map(Path::to_path_buf)).unwrap_or_default()
}

/// A file's path from the baseline's folder, so that a checkout may stand anywhere.
fn relative(folder: &Path, file: &str) -> String {
    let whole = absolute(file).unwrap_or_else(|_| PathBuf::from(file));
    let path = whole.strip_prefix(folder).unwrap_or(&whole);
    path.to_string_lossy().replace(std::path::MAIN_SEPARATOR, "/")
}
