//! `edskit lint`.

mod concise;
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
use crate::{Exit, Streams};
use edskit_lint::{FileKind, Linter, RuleSet, UnknownRule};
use edskit_model::{Datasheet, Document};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use rayon::prelude::*;
use report::{FileReport, Outcome, Report};
use std::fs::File;
use std::io::{self, BufWriter, Write};

/// From this many files on a terminal shows how far the run is.
const FILES_WORTH_A_BAR: usize = 50;

pub(crate) fn run(arguments: &LintArguments, streams: &mut Streams) -> io::Result<Exit> {
    let rules = match rule_set(arguments) {
        Ok(rules) => rules,
        Err(error) => {
            streams.complain(format_args!("{error}"));
            return Ok(Exit::Failed);
        }
    };
    if arguments.statistics && !matches!(arguments.format, LintFormat::Human | LintFormat::Json) {
        streams.complain(format_args!("--statistics goes with --format human or json"));
        return Ok(Exit::Failed);
    }
    let found = files::find(&arguments.paths, streams)?;
    let to_terminal = streams.is_terminal && arguments.output.is_none();
    let style = human::Style { color: arguments.color.is_wanted(to_terminal), width: streams.width };
    let linter = Linter::new(rules);
    let progress = progress(found.inputs.len(), arguments, streams);
    let files = found
        .inputs
        .par_iter()
        .map(|input| {
            let report = lint_file(&linter, input, arguments, style);
            progress.inc(1);
            report
        })
        .collect();
    progress.finish_and_clear();
    let report = Report { files, failures: found.failures };
    for failure in report.all_failures() {
        streams.complain(format_args!("{failure}"));
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

fn rule_set(arguments: &LintArguments) -> Result<RuleSet, UnknownRule> {
    let mut rules = if arguments.select.is_empty() { RuleSet::default() } else { RuleSet::none() };
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

fn lint_file(linter: &Linter, input: &Input, arguments: &LintArguments, style: human::Style) -> FileReport {
    let name = input.name(&arguments.stdin_filename);
    let kind = FileKind::of(&name);
    let bytes = match input.read() {
        Ok(bytes) => bytes,
        Err(error) => {
            let reason = files::unreadable(&name, &error);
            return FileReport { name, kind, outcome: Outcome::Unreadable(reason) };
        }
    };
    let sheet = Datasheet::new(Document::from_vec(bytes));
    let own_name = name.rsplit('/').next();
    let mut findings = linter.lint(&sheet, kind, own_name);
    findings.iter_mut().for_each(printable::finding);
    // Excerpts need the text, which is gone once the file is done.
    let excerpts = if arguments.format == LintFormat::Human && !arguments.statistics {
        human::excerpts(&name, sheet.document(), &findings, style)
    } else {
        String::new()
    };
    let findings = findings.into_iter().map(|finding| Located::new(sheet.document(), finding)).collect();
    FileReport { name, kind, outcome: Outcome::Linted { findings, excerpts } }
}

fn write(report: &Report, arguments: &LintArguments, out: &mut dyn Write) -> io::Result<()> {
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
