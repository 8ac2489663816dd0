//! Findings that a team knows already, so that only new ones are shown.

use crate::files::another_own_file;
use crate::paths;
use edskit_lint::{Finding, RuleSet};
use edskit_model::Datasheet;
use edskit_model::own_file::OwnFile;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, HashSet};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

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
    path: PathBuf,
    folder: PathBuf,
    /// For each file, by its path from the folder, what is known of it and how often it occurs.
    known: BTreeMap<String, BTreeMap<Fingerprint, usize>>,
}

impl Baseline {
    /// One that knows nothing yet.
    pub(crate) fn new(path: &Path) -> Self {
        let folder = paths::folder(path.parent().unwrap_or(Path::new("")));
        Self { path: path.to_path_buf(), folder, known: BTreeMap::new() }
    }

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
        let mut baseline = Self::new(path);
        for (file, known) in written.files {
            // A path that was written whole is the same file.
            let key = baseline.key(&baseline.folder.join(file));
            let counts = baseline.known.entry(key).or_default();
            for known in known {
                *counts.entry(known.fingerprint).or_default() += known.count;
            }
        }
        Ok(baseline)
    }

    /// The baseline's own path, as it was given.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Takes the known findings of a file out, with their fingerprints, and says how many those were.
    pub(crate) fn take_known(
        &self,
        file: &str,
        findings: &mut Vec<Finding>,
        fingerprints: &mut Vec<Fingerprint>,
    ) -> usize {
        let Some(known) = self.known.get(&self.key(Path::new(file))) else { return 0 };
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

    /// Puts what was found in a file in the place of what was known of it. What is known of rules that did not run stays.
    pub(crate) fn replace(&mut self, file: &str, found: &[Fingerprint], rules: &RuleSet) {
        let key = self.key(Path::new(file));
        let ran: HashSet<&str> = rules.enabled().map(|rule| rule.code).collect();
        let mut counts = self.known.remove(&key).unwrap_or_default();
        counts.retain(|fingerprint, _| !ran.contains(fingerprint.rule.as_str()));
        for fingerprint in found {
            *counts.entry(fingerprint.clone()).or_default() += 1;
        }
        if !counts.is_empty() {
            self.known.insert(key, counts);
        }
    }

    /// Takes the files out that are gone, and says how many those were.
    pub(crate) fn prune(&mut self) -> usize {
        let before = self.known.len();
        let folder = &self.folder;
        self.known.retain(|file, _| folder.join(file).exists());
        before - self.known.len()
    }

    /// How many findings are known.
    pub(crate) fn len(&self) -> usize {
        self.known.values().flat_map(BTreeMap::values).sum()
    }

    /// Writes the file.
    pub(crate) fn write(&self) -> io::Result<()> {
        let known = |counts: &BTreeMap<Fingerprint, usize>| {
            let known = |(fingerprint, count): (&Fingerprint, &usize)| Known {
                fingerprint: fingerprint.clone(),
                count: *count,
            };
            counts.iter().map(known).collect()
        };
        let files = self.known.iter().map(|(file, counts)| (file.clone(), known(counts))).collect();
        let mut text = serde_json::to_vec_pretty(&Written { version: VERSION, files })?;
        text.push(b'\n');
        let named = |error: io::Error| {
            io::Error::new(error.kind(), format!("{}: cannot be written: {error}", self.path.display()))
        };
        fs::write(&self.path, text).map_err(named)
    }

    /// A file's path from the baseline's folder, so that a checkout may stand anywhere.
    fn key(&self, file: &Path) -> String {
        paths::text(&paths::relative(&self.folder, &paths::whole(file)))
    }
}

/// Keeps the items whose mark is set.
fn retain<T>(items: &mut Vec<T>, marks: &[bool]) {
    let mut marks = marks.iter();
    items.retain(|_| marks.next().copied().unwrap_or(true));
}
