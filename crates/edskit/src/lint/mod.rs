//! `edskit lint`.

mod baseline;
mod concise;
mod folder;
mod github;
pub(crate) mod human;
pub(crate) mod json;
mod junit;
mod report;
mod sarif;
mod source;
mod statistics;

use crate::cli::{LintArguments, LintFormat};
use crate::files::{self, Input};
use crate::positions::Located;
use crate::printable;
use crate::profiles;
use crate::settings::{Finder, Settings};
use crate::{Exit, Streams};
use baseline::{Baseline, Fingerprint};
use edskit_lint::{Applicability, FileKind, Finding, Linter, Profile, RuleSet, UnknownRule};
use edskit_model::{Datasheet, Document};
use folder::Folder;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use rayon::prelude::*;
use report::{FileReport, Fixes, Outcome, Report};
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// From this many files on a terminal shows how far the run is.
const FILES_WORTH_A_BAR: usize = 50;

pub(crate) fn run(arguments: &LintArguments, streams: &mut Streams) -> io::Result<Exit> {
    if arguments.statistics && !matches!(arguments.format, LintFormat::Human | LintFormat::Json) {
        streams.complain(format_args!("--statistics goes with --format human or json"));
        return Ok(Exit::Failed);
    }
    if arguments.unsafe_fixes && !arguments.fix && !arguments.diff {
        streams.complain(format_args!("--unsafe-fixes goes with --fix or --diff"));
        return Ok(Exit::Failed);
    }
    let found = files::find(&arguments.paths, streams)?;
    if arguments.fix && found.inputs.iter().any(|input| matches!(input, Input::Stdin(_))) {
        streams.complain(format_args!("--fix cannot change standard input; --diff shows what it would do"));
        return Ok(Exit::Failed);
    }
    let jobs = match jobs(found.inputs, arguments) {
        Ok(jobs) => jobs,
        Err(reason) => {
            streams.complain(format_args!("{reason}"));
            return Ok(Exit::Failed);
        }
    };
    let baseline = match &arguments.baseline {
        Some(path) if !arguments.update_baseline => match Baseline::read(path) {
            Ok(baseline) => Some(baseline),
            Err(reason) => {
                streams.complain(format_args!("{reason}"));
                return Ok(Exit::Failed);
            }
        },
        _ => None,
    };
    let to_terminal = streams.is_terminal && arguments.output.is_none();
    let style = human::Style { color: arguments.color.is_wanted(to_terminal), width: streams.width };
    let progress = progress(jobs.len(), arguments, streams);
    let files = jobs
        .par_iter()
        .map(|job| {
            let report = lint_file(job, baseline.as_ref(), arguments, style);
            progress.inc(1);
            report
        })
        .collect();
    progress.finish_and_clear();
    let report = Report { files, failures: found.failures };
    for failure in report.all_failures() {
        streams.complain(format_args!("{failure}"));
    }
    if let Some(path) = arguments.baseline.as_deref().filter(|_| arguments.update_baseline) {
        let known = Baseline::write(path, &report.files).map_err(|error| {
            io::Error::new(error.kind(), format!("{}: cannot be written: {error}", path.display()))
        })?;
        writeln!(streams.stdout, "{known} findings written to {}", path.display())?;
        streams.stdout.flush()?;
        return Ok(if report.all_failures().next().is_some() { Exit::Failed } else { Exit::Clean });
    }
    match &arguments.output {
        None => write(&report, arguments, &mut streams.stdout)?,
        Some(path) => {
            let unwritable = |error: io::Error| {
                io::Error::new(error.kind(), format!("{}: cannot be written: {error}", path.display()))
            };
            let mut file = BufWriter::new(File::create(path).map_err(unwritable)?);
            write(&report, arguments, &mut file).map_err(unwritable)?;
        }
    }
    Ok(report.exit(arguments.fail_on.severity()))
}

/// One file and the rules that run over it.
struct Job {
    input: Input,
    linter: Linter,
}

/// Finds the settings of every file and puts what the command line says on top of them.
fn jobs(inputs: Vec<Input>, arguments: &LintArguments) -> Result<Vec<Job>, String> {
    let mut finder = Finder::default();
    let given = match &arguments.config {
        Some(path) => Some(Arc::new(Settings::read(path).map_err(|error| error.to_string())?)),
        None if arguments.isolated => Some(Arc::new(Settings::none())),
        None => None,
    };
    let nothing = Arc::new(Settings::none());
    let own = arguments.profiles.iter().map(|path| profiles::read(path));
    let own: Vec<Profile> = own.collect::<Result<_, _>>().map_err(|error| error.to_string())?;
    let job = |input: Input| {
        let path = match &input {
            Input::File(path) => path.clone(),
            Input::Stdin(_) => PathBuf::from(&arguments.stdin_filename),
        };
        let settings = match &given {
            Some(settings) => Arc::clone(settings),
            None => {
                let folder = path.parent().unwrap_or(Path::new(""));
                let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
                let found = finder.find(folder).map_err(|error| error.to_string())?;
                found.unwrap_or_else(|| Arc::clone(&nothing))
            }
        };
        let rules = on_top(settings.rules_for(&path), arguments).map_err(|error| error.to_string())?;
        let profiles = match &own[..] {
            [] => Arc::clone(settings.profiles()),
            own => settings.profiles().iter().chain(own).cloned().collect(),
        };
        Ok(Job { input, linter: Linter::new(rules).with_profiles(profiles) })
    };
    // Selectors of the command line are wrong even where there is no file.
    on_top(RuleSet::default(), arguments).map_err(|error| error.to_string())?;
    inputs.into_iter().map(job).collect()
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

fn lint_file(
    job: &Job,
    baseline: Option<&Baseline>,
    arguments: &LintArguments,
    style: human::Style,
) -> FileReport {
    let name = job.input.name(&arguments.stdin_filename);
    let kind = FileKind::of(&name);
    let bytes = match job.input.read() {
        Ok(bytes) => bytes,
        Err(error) => {
            let reason = files::unreadable(&name, &error);
            return FileReport { name, kind, outcome: Outcome::Unreadable(reason) };
        }
    };
    let sheet = Datasheet::new(Document::from_vec(bytes));
    let (sheet, mut findings, fixes) = if arguments.fix || arguments.diff {
        match fix_file(job, &name, sheet, kind, arguments) {
            Ok(fixed) => fixed,
            Err(error) => {
                let reason = format!("{name}: cannot be written: {error}");
                return FileReport { name, kind, outcome: Outcome::Unreadable(reason) };
            }
        }
    } else {
        let found = findings(job, &name, &sheet, kind);
        (sheet, found, Fixes::default())
    };
    findings.iter_mut().for_each(printable::finding);
    let mut fingerprints: Vec<Fingerprint> = if arguments.baseline.is_some() {
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
    FileReport { name, kind, outcome: Outcome::Linted { findings, excerpts, fingerprints, known, fixes } }
}

/// What the rules find in a file; checks across files see the files beside it.
fn findings(job: &Job, name: &str, sheet: &Datasheet, kind: FileKind) -> Vec<Finding> {
    let own_name = name.rsplit('/').next();
    match &job.input {
        Input::File(path) => job.linter.lint_among(sheet, kind, own_name, &Folder::of(path)),
        Input::Stdin(_) => job.linter.lint(sheet, kind, own_name),
    }
}

/// Fixes a file, in place or only as a difference, and gives what is left.
fn fix_file(
    job: &Job,
    name: &str,
    sheet: Datasheet,
    kind: FileKind,
    arguments: &LintArguments,
) -> io::Result<(Datasheet, Vec<Finding>, Fixes)> {
    let least = if arguments.unsafe_fixes { Applicability::Unsafe } else { Applicability::Safe };
    let before = sheet.clone();
    let fixed = edskit_lint::fix_with(sheet, least, |sheet| findings(job, name, sheet, kind));
    let mut fixes = Fixes { applied: fixed.applied, diff: String::new() };
    if fixed.applied == 0 {
        return Ok((fixed.sheet, fixed.findings, fixes));
    }
    let after = fixed.sheet.document().to_bytes();
    if arguments.diff {
        fixes.diff = crate::difference::unified(name, before.document(), after, "fixed");
    } else {
        // Standard input was refused before.
        if let Input::File(path) = &job.input {
            fs::write(path, after)?;
        }
    }
    Ok((fixed.sheet, fixed.findings, fixes))
}

fn write(report: &Report, arguments: &LintArguments, out: &mut dyn Write) -> io::Result<()> {
    for fixes in report.files.iter().filter_map(FileReport::fixes) {
        out.write_all(fixes.diff.as_bytes())?;
    }
    match arguments.format {
        LintFormat::Human if arguments.statistics => statistics::human(report, out)?,
        LintFormat::Json if arguments.statistics => statistics::json(report, out)?,
        LintFormat::Human => human::write(report, arguments.quiet, out)?,
        LintFormat::Concise => concise::write(report, arguments.quiet, out)?,
        LintFormat::Json => json::write(report, out)?,
        LintFormat::Sarif => sarif::write(report, out)?,
        LintFormat::Github => github::write(report, out)?,
        LintFormat::Junit => junit::write(report, out)?,
    }
    out.flush()
}
