//! Every real file as a device: the node that `edskit run` makes of it, under the independent check in virtual time. What
//! does not pass is held against a table that says for each case whose fault it is and why.

use super::check::{Report, Script, Transport};
use super::node::{self, Node, Program};
use super::table::{Expected, Table};
use super::{REQUIREMENTS, TOLERANCE, VENV};
use crate::python::{self, shared};
use crate::step::{Outcome, in_parallel};
use crate::{root, say};
use std::fs;
use std::path::{Path, PathBuf};

/// For a file and a check that does not pass: whose fault it is, and why.
const TABLE: &str = "tests/conformance/corpus.toml";

/// What has become of a file.
enum Found {
    Judged(Report),
    /// There is no node, or the check cannot read the file, and why.
    NotJudged(String),
}

/// Whether every real file makes a node that passes, but for what the table explains.
pub(crate) fn of_real_files() -> Outcome {
    let script = shared().join("conformance/conformance.py");
    let corpus = shared().join("corpus/files");
    let (true, Some(files)) = (script.is_file(), files(&corpus)) else {
        return Outcome::LeftOut(format!("{} or {} is missing", script.display(), corpus.display()));
    };
    let python = match python::installed(VENV, REQUIREMENTS) {
        Ok(python) => python,
        Err(reason) => return Outcome::LeftOut(reason),
    };
    if let Err(reason) = node::build_edskit() {
        return Outcome::Failed(reason);
    }
    let text = match fs::read_to_string(root().join(TABLE)) {
        Ok(text) => text,
        Err(error) => return Outcome::Failed(format!("{TABLE}: {error}")),
    };
    let table = match Table::read(&text) {
        Ok(table) => table,
        Err(reason) => return Outcome::Failed(format!("{TABLE}: {reason}")),
    };
    let script = Script { python: &python, path: &script };
    let found = in_parallel(&files, |file| judge(script, file));
    compare(&table, &files, &found)
}

/// The files of the corpus in their order.
fn files(folder: &Path) -> Option<Vec<PathBuf>> {
    let entries = fs::read_dir(folder).ok()?.map_while(Result::ok).map(|entry| entry.path());
    let is_device = |path: &PathBuf| {
        let ending = path.extension().unwrap_or_default();
        ending.eq_ignore_ascii_case("eds") || ending.eq_ignore_ascii_case("dcf")
    };
    let mut files: Vec<PathBuf> = entries.filter(is_device).collect();
    files.sort();
    Some(files)
}

fn judge(script: Script<'_>, file: &Path) -> Found {
    let options = ["--tol", TOLERANCE, "--store"];
    let report = Node::start_virtual(Program::Loaded, file)
        .and_then(|node| script.judge(&node, Transport::Virtual, file, &options));
    match report {
        Ok(report) => Found::Judged(report),
        Err(reason) => Found::NotJudged(reason),
    }
}

/// Holds what was found against the table; both ways, so that nothing stays in it that is mended.
fn compare(table: &Table, files: &[PathBuf], found: &[Found]) -> Outcome {
    let mut problems = Vec::new();
    let (mut judged, mut passed) = (0, 0);
    let mut names = Vec::new();
    for (file, found) in files.iter().zip(found) {
        let name = file.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let expected = table.of(&name);
        match found {
            Found::NotJudged(reason) => match expected {
                Some(Expected::NotJudged(why)) => say(format_args!("{name}: not judged: {why}")),
                _ => problems.push(format!("{name}: not judged: {reason}")),
            },
            Found::Judged(report) => {
                judged += 1;
                passed += u32::from(report.bad().next().is_none());
                let explained = |id: &str| expected.is_some_and(|expected| expected.explains(id));
                problems.extend(
                    report.bad().filter(|line| !explained(&line.id)).map(|line| format!("{name}: {line}")),
                );
                let ids: Vec<&str> = report.bad().map(|line| line.id.as_str()).collect();
                let mended = expected.map(|expected| expected.mended(&ids)).unwrap_or_default();
                problems
                    .extend(mended.into_iter().map(|id| format!("{name}: {id} is in {TABLE}, but passes")));
            }
        }
        names.push(name);
    }
    let gone = table.files().filter(|name| !names.iter().any(|known| known == name));
    problems.extend(gone.map(|name| format!("{name} is in {TABLE}, but not in the corpus")));
    say(format_args!("{} files, {judged} judged, {passed} pass entirely; {}", files.len(), table.summary()));
    if problems.is_empty() {
        return Outcome::Passed;
    }
    for problem in &problems {
        say(problem);
    }
    Outcome::Failed(format!("{} cases that {TABLE} does not explain", problems.len()))
}
