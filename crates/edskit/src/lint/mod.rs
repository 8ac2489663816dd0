//! `edskit lint`.

mod baseline;
mod concise;
mod folder;
mod format;
mod github;
pub(crate) mod human;
pub(crate) mod json;
mod junit;
mod report;
mod sarif;
mod source;
mod statistics;

use crate::cli::{FailOn, LintArguments, LintFormat};
use crate::difference;
use crate::files::{self, Input};
use crate::positions::Located;
use crate::printable;
use crate::profiles;
use crate::settings::{self, Finder, Settings};
use crate::{Exit, Streams};
use baseline::{Baseline, Fingerprint};
use edskit_lint::{Applicability, FileKind, Finding, Fixed, Linter, Profile, RuleSet, Severity, UnknownRule};
use edskit_model::{Datasheet, Document};
use folder::Folder;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use rayon::prelude::*;
use report::{FileReport, Fixes, Outcome, Summary};
use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// From this many files on a terminal shows how far the run is.
const FILES_WORTH_A_BAR: usize = 50;

pub(crate) fn run(arguments: &LintArguments, streams: &mut Streams) -> io::Result<Exit> {
    match try_run(arguments, streams) {
        Err(Stopped::Refused(reason)) => {
            streams.complain(format_args!("{reason}"));
            Ok(Exit::Failed)
        }
        Err(Stopped::Broken(error)) => Err(error),
        Ok(exit) => Ok(exit),
    }
}

/// Why a run ended before its end.
enum Stopped {
    /// Something asked for cannot be done.
    Refused(String),
    /// Something could not be read or written.
    Broken(io::Error),
}

impl From<String> for Stopped {
    fn from(reason: String) -> Self {
        Self::Refused(reason)
    }
}

impl From<io::Error> for Stopped {
    fn from(error: io::Error) -> Self {
        Self::Broken(error)
    }
}

fn try_run(arguments: &LintArguments, streams: &mut Streams) -> Result<Exit, Stopped> {
    if arguments.statistics && !matches!(arguments.format, LintFormat::Human | LintFormat::Json) {
        return Err("--statistics goes with --format human or json".to_owned().into());
    }
    if arguments.unsafe_fixes && !arguments.fix && !arguments.diff {
        return Err("--unsafe-fixes goes with --fix or --diff".to_owned().into());
    }
    let found = files::find(&arguments.paths, streams)?;
    if arguments.fix && found.inputs.iter().any(|input| matches!(input, Input::Stdin(_))) {
        return Err("--fix cannot change standard input; --diff shows what it would do".to_owned().into());
    }
    let jobs = jobs(found.inputs, arguments, streams)?;
    let baselines = Baselines::read(&jobs, arguments, streams)?;
    let mut summary = Summary {
        failures: found.failures,
        only_looks: arguments.diff,
        fixes: arguments.fix || arguments.diff,
        ..Summary::default()
    };
    for failure in &summary.failures {
        streams.complain(format_args!("{failure}"));
    }
    if arguments.update_baseline {
        return update(baselines, &jobs, arguments, summary, streams);
    }
    let mut sink = Sink::open(arguments)?;
    let to_terminal = streams.is_terminal && arguments.output.is_none() && !arguments.diff;
    let style = human::Style { color: arguments.color.is_wanted(to_terminal), width: streams.width };
    let mut format = format::of(arguments);
    sink.write(streams, |out| format.begin(out))?;
    lint_all(&jobs, &baselines, arguments, style, streams, |file, streams| {
        summary.add(&file);
        if let Some(fixes) = file.fixes() {
            streams.stdout.write_all(&fixes.patch)?;
        }
        sink.write(streams, |out| format.file(&file, out))
    })?;
    sink.write(streams, |out| format.end(&summary, out))?;
    sink.close(streams)?;
    // The formats for machines have no summary, where people would read it.
    let has_summary = !arguments.quiet
        && (arguments.output.is_some()
            || matches!(arguments.format, LintFormat::Human | LintFormat::Concise));
    if let Some(left_out) = summary.left_out().filter(|_| !has_summary) {
        streams.complain(format_args!("{left_out}"));
    }
    if arguments.output.is_some() && !arguments.quiet {
        let out = if arguments.diff { &mut streams.stderr } else { &mut streams.stdout };
        writeln!(out, "{summary}")?;
    }
    streams.stdout.flush()?;
    Ok(summary.exit())
}

/// Where the findings go: into a file, or to standard output, which a patch has for itself.
struct Sink<'a> {
    file: Option<(&'a Path, BufWriter<File>)>,
    to_stderr: bool,
}

impl<'a> Sink<'a> {
    fn open(arguments: &'a LintArguments) -> io::Result<Self> {
        let file = match &arguments.output {
            None => None,
            Some(path) => {
                let file = File::create(path).map_err(|error| unwritable(path, &error))?;
                Some((path.as_path(), BufWriter::new(file)))
            }
        };
        Ok(Self { file, to_stderr: arguments.diff })
    }

    fn write(
        &mut self,
        streams: &mut Streams,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> io::Result<()> {
        match &mut self.file {
            Some((path, file)) => write(file).map_err(|error| unwritable(path, &error)),
            None if self.to_stderr => write(&mut streams.stderr),
            None => write(&mut streams.stdout),
        }
    }

    fn close(&mut self, streams: &mut Streams) -> io::Result<()> {
        self.write(streams, |out| out.flush())
    }
}

fn unwritable(path: &Path, error: &io::Error) -> io::Error {
    io::Error::new(error.kind(), format!("{}: cannot be written: {error}", path.display()))
}

/// The baselines of a run, by their paths: that of the command line, or those that settings name.
#[derive(Default)]
struct Baselines(BTreeMap<PathBuf, Baseline>);

impl Baselines {
    /// Reads those of `jobs`. One that is to be made need not be there.
    fn read(jobs: &[Job], arguments: &LintArguments, streams: &mut Streams) -> Result<Self, Stopped> {
        let mut baselines = Self::default();
        let given = arguments.baseline.iter();
        for path in jobs.iter().filter_map(|job| job.baseline.as_ref()).chain(given) {
            if baselines.0.contains_key(path) {
                continue;
            }
            let is_new = arguments.update_baseline && !path.exists();
            let mut baseline = if is_new { Baseline::new(path) } else { Baseline::read(path)? };
            if arguments.prune_baseline {
                let gone = baseline.prune();
                baseline.write()?;
                let files = if gone == 1 {
                    "1 file that is gone is"
                } else {
                    &format!("{gone} files that are gone are")
                };
                streams.complain(format_args!("{}: {files} taken out", path.display()));
            }
            baselines.0.insert(path.clone(), baseline);
        }
        if baselines.0.is_empty() && (arguments.update_baseline || arguments.prune_baseline) {
            return Err("there is no baseline: name one with --baseline or in edskit.toml".to_owned().into());
        }
        Ok(baselines)
    }

    fn of(&self, job: &Job) -> Option<&Baseline> {
        self.0.get(job.baseline.as_ref()?)
    }
}

/// Writes everything that is found as known.
fn update(
    baselines: Baselines,
    jobs: &[Job],
    arguments: &LintArguments,
    mut summary: Summary,
    streams: &mut Streams,
) -> Result<Exit, Stopped> {
    let style = human::Style { color: false, width: streams.width };
    // What is known already is found again, so no baseline takes it out.
    let mut updated = baselines;
    let mut written: BTreeMap<PathBuf, usize> = BTreeMap::new();
    let mut jobs_left = jobs.iter();
    lint_all(jobs, &Baselines::default(), arguments, style, streams, |file, _| {
        summary.add(&file);
        let job = jobs_left.next();
        let Some((job, path)) = job.and_then(|job| Some((job, job.baseline.as_ref()?))) else {
            return Ok(());
        };
        // A file that cannot be read was not looked at.
        if let (None, Some(baseline)) = (file.failure(), updated.0.get_mut(path)) {
            baseline.replace(&file.name, file.fingerprints(), job.linter.rules());
            *written.entry(path.clone()).or_default() += file.fingerprints().len();
        }
        Ok(())
    })?;
    for (path, baseline) in &updated.0 {
        baseline.write()?;
        let new = written.get(path).copied().unwrap_or_default();
        let kept = match baseline.len() - new {
            0 => String::new(),
            kept => format!(", {kept} of files and rules that were not looked at kept"),
        };
        writeln!(streams.stdout, "{new} findings written to {}{kept}", baseline.path().display())?;
    }
    streams.stdout.flush()?;
    Ok(if summary.failures.is_empty() { Exit::Clean } else { Exit::Failed })
}

/// How many files are linted before their findings are written: enough for all processors, and few in memory.
const FILES_AT_ONCE: usize = 32;

/// Lints the files side by side, and hands them on one by one in their order.
fn lint_all(
    jobs: &[Job],
    baselines: &Baselines,
    arguments: &LintArguments,
    style: human::Style,
    streams: &mut Streams,
    mut each: impl FnMut(FileReport, &mut Streams) -> io::Result<()>,
) -> io::Result<()> {
    let progress = progress(jobs.len(), arguments, streams);
    for some in jobs.chunks(FILES_AT_ONCE) {
        let files: Vec<(FileReport, Option<String>)> = some
            .par_iter()
            .map(|job| {
                let report = lint_file(job, baselines.of(job), arguments, style);
                progress.inc(1);
                report
            })
            .collect();
        for (file, remark) in files {
            for complaint in file.failure().into_iter().chain(remark.as_deref()) {
                streams.complain(format_args!("{complaint}"));
            }
            each(file, streams)?;
        }
    }
    progress.finish_and_clear();
    Ok(())
}

/// One file and the rules that run over it.
struct Job {
    input: Input,
    linter: Linter,
    /// From which severity on a finding makes the command fail.
    threshold: Severity,
    /// The path of the baseline.
    baseline: Option<PathBuf>,
}

/// Finds the settings of every file and puts what the command line says on top of them. What the settings exclude is left
/// out, and that is told where the file was named.
fn jobs(inputs: Vec<Input>, arguments: &LintArguments, streams: &mut Streams) -> Result<Vec<Job>, String> {
    let mut finder = Finder::default();
    let given = match &arguments.config {
        Some(path) => Some(Arc::new(Settings::read(path).map_err(|error| error.to_string())?)),
        None if arguments.isolated => Some(Arc::new(Settings::default())),
        None => None,
    };
    let nothing = Arc::new(Settings::default());
    let own = arguments.profiles.iter().map(|path| profiles::read(path));
    let own: Vec<Profile> = own.collect::<Result<_, _>>().map_err(|error| error.to_string())?;
    let mut job = |input: Input| {
        let path = match &input {
            Input::File(path) => path.clone(),
            Input::Stdin(_) => PathBuf::from(&arguments.stdin_filename),
        };
        let settings = match &given {
            Some(settings) => Arc::clone(settings),
            None => {
                let found = finder.find_for(&path).map_err(|error| error.to_string())?;
                found.unwrap_or_else(|| Arc::clone(&nothing))
            }
        };
        if settings.excludes(&path) {
            if arguments.paths.contains(&path) {
                streams.complain(format_args!("{}: {}", path.display(), settings::EXCLUDED));
            }
            return Ok(None);
        }
        let rules = on_top(settings.rules_for(&path), arguments).map_err(|error| error.to_string())?;
        let profiles = match &own[..] {
            [] => Arc::clone(settings.profiles()),
            own => settings.profiles().iter().chain(own).cloned().collect(),
        };
        let threshold = arguments.fail_on.map(FailOn::severity).or(settings.fail_on());
        Ok(Some(Job {
            input,
            linter: Linter::new(rules).with_profiles(profiles),
            threshold: threshold.unwrap_or(Severity::Warning),
            baseline: arguments.baseline.clone().or(settings.baseline().map(Path::to_path_buf)),
        }))
    };
    // Selectors of the command line are wrong even where there is no file.
    on_top(RuleSet::default(), arguments).map_err(|error| error.to_string())?;
    inputs.into_iter().filter_map(|input| job(input).transpose()).collect()
}

/// The rules after the options `--select`, `--extend-select` and `--ignore`.
fn on_top(mut rules: RuleSet, arguments: &LintArguments) -> Result<RuleSet, UnknownRule> {
    if !arguments.select.is_empty() {
        rules = rules.without_any();
    }
    for selector in arguments.select.iter().chain(&arguments.extend_select) {
        rules.select(selector)?;
    }
    for selector in &arguments.ignore {
        rules.ignore(selector)?;
    }
    Ok(rules)
}

fn progress(files: usize, arguments: &LintArguments, streams: &Streams) -> ProgressBar {
    if arguments.quiet || !streams.is_terminal || files < FILES_WORTH_A_BAR {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::with_draw_target(Some(files as u64), ProgressDrawTarget::stderr());
    match ProgressStyle::with_template("linting {bar:40} {pos} of {len} files") {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}

/// Lints a file, and says what else there is to say of it.
fn lint_file(
    job: &Job,
    baseline: Option<&Baseline>,
    arguments: &LintArguments,
    style: human::Style,
) -> (FileReport, Option<String>) {
    let name = job.input.name(&arguments.stdin_filename);
    let kind = FileKind::of(&name);
    let unreadable = |name: String, reason| {
        let outcome = Outcome::Unreadable(reason);
        (FileReport { name, kind, threshold: job.threshold, outcome }, None)
    };
    let bytes = match job.input.read() {
        Ok(bytes) => bytes,
        Err(error) => {
            let reason = files::unreadable(&name, &error);
            return unreadable(name, reason);
        }
    };
    let sheet = Datasheet::new(Document::from_vec(bytes));
    let mut remark = None;
    let (sheet, mut findings, fixes) = if arguments.fix || arguments.diff {
        match fix_file(job, &name, sheet, kind, arguments) {
            Ok((fixed, fixes)) => {
                if !fixed.converged {
                    remark = Some(format!("{name}: {GIVEN_UP}"));
                }
                (fixed.sheet, fixed.findings, fixes)
            }
            Err(error) => {
                let reason = format!("{name}: cannot be written: {error}");
                return unreadable(name, reason);
            }
        }
    } else {
        let mut found = findings(job, &name, &sheet, kind);
        let mut fixes = Fixes::default();
        if shows_fixes(arguments) {
            let again = |sheet: &Datasheet| findings(job, &name, sheet, kind);
            fixes.refused = edskit_lint::withdraw_refused(&sheet, &mut found, again);
        }
        (sheet, found, fixes)
    };
    findings.iter_mut().for_each(printable::finding);
    let mut fingerprints: Vec<Fingerprint> = if job.baseline.is_some() {
        findings.iter().map(|finding| Fingerprint::of(&sheet, finding)).collect()
    } else {
        Vec::new()
    };
    let known = match baseline {
        Some(baseline) => baseline.take_known(&name, &mut findings, &mut fingerprints),
        None => 0,
    };
    // Excerpts need the text, which is gone once the file is done.
    let excerpts = if arguments.format == LintFormat::Human && !arguments.statistics {
        human::excerpts(&name, sheet.document(), &findings, style)
    } else {
        String::new()
    };
    let findings = findings.into_iter().map(|finding| Located::new(sheet.document(), finding)).collect();
    let outcome = Outcome::Linted { findings, excerpts, fingerprints, known, fixes };
    (FileReport { name, kind, threshold: job.threshold, outcome }, remark)
}

/// Whether people see which findings have a safe fix, so that it has to be one.
fn shows_fixes(arguments: &LintArguments) -> bool {
    !arguments.statistics
        && matches!(arguments.format, LintFormat::Human | LintFormat::Json | LintFormat::Sarif)
}

/// What is said of a file whose fixes did not come to their end.
const GIVEN_UP: &str = "fixing was given up before its end: too many fixes had to be tried, or two rules want the opposite of each other";

/// What the rules find in a file; checks across files see the files beside it.
fn findings(job: &Job, name: &str, sheet: &Datasheet, kind: FileKind) -> Vec<Finding> {
    let own_name = name.rsplit('/').next();
    match &job.input {
        Input::File(path) => job.linter.lint_among(sheet, kind, own_name, &Folder::of(path)),
        Input::Stdin(_) => job.linter.lint(sheet, kind, own_name),
    }
}

/// Fixes a file, in place or only as a patch, and gives what is left.
fn fix_file(
    job: &Job,
    name: &str,
    sheet: Datasheet,
    kind: FileKind,
    arguments: &LintArguments,
) -> io::Result<(Fixed, Fixes)> {
    let least = if arguments.unsafe_fixes { Applicability::Unsafe } else { Applicability::Safe };
    let before = sheet.document().to_bytes().to_vec();
    let fixed = edskit_lint::fix_with(sheet, least, |sheet| findings(job, name, sheet, kind));
    let mut fixes = Fixes { applied: fixed.applied, refused: fixed.refused, patch: Vec::new() };
    if fixed.applied > 0 {
        let after = fixed.sheet.document().to_bytes();
        if arguments.diff {
            fixes.patch = difference::patch(name, &before, after);
        } else if let Input::File(path) = &job.input {
            // Standard input was refused before.
            fs::write(path, after)?;
        }
    }
    Ok((fixed, fixes))
}
