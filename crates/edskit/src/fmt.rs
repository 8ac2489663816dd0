//! `edskit fmt`.

use crate::cli::FmtArguments;
use crate::difference;
use crate::files::{self, Input};
use crate::settings::{self, Finder};
use crate::{Exit, Streams};
use edskit_model::nature::Nature;
use edskit_model::{Datasheet, Document, SectionKind, Unformattable, try_format};
use std::fs;
use std::io::{self, Write};
use std::path::Path;

/// The name of standard input in messages.
const STDIN: &str = "<stdin>";

pub(crate) fn run(arguments: &FmtArguments, streams: &mut Streams) -> io::Result<Exit> {
    let found = files::find(&arguments.paths, streams)?;
    let mut exit = Exit::Clean;
    for failure in &found.failures {
        streams.complain(format_args!("{failure}"));
        exit = Exit::Failed;
    }
    let mut counts = Counts::default();
    let mut finder = Finder::default();
    for input in &found.inputs {
        if let Input::File(path) = input {
            match is_excluded(path, &mut finder) {
                Ok(false) => {}
                Ok(true) => {
                    if arguments.paths.contains(path) {
                        streams.complain(format_args!("{}: {}", path.display(), settings::EXCLUDED));
                    }
                    continue;
                }
                Err(reason) => {
                    streams.complain(format_args!("{reason}"));
                    return Ok(Exit::Failed);
                }
            }
        }
        match format_input(input, arguments, streams) {
            Ok(true) => counts.changed += 1,
            Ok(false) => counts.unchanged += 1,
            Err(reason) => {
                streams.complain(format_args!("{reason}"));
                exit = Exit::Failed;
            }
        }
    }
    let only_looks = arguments.check || arguments.diff;
    if !found.inputs.iter().any(|input| matches!(input, Input::Stdin(_))) {
        writeln!(streams.stderr, "{}", counts.sentence(only_looks))?;
    }
    streams.stdout.flush()?;
    if only_looks && counts.changed > 0 { Ok(exit.max(Exit::Findings)) } else { Ok(exit) }
}

/// Whether the settings that hold for a file leave it alone.
fn is_excluded(path: &Path, finder: &mut Finder) -> Result<bool, String> {
    let settings = finder.find_for(path).map_err(|error| error.to_string())?;
    Ok(settings.is_some_and(|settings| settings.excludes(path)))
}

#[derive(Default)]
struct Counts {
    changed: usize,
    unchanged: usize,
}

impl Counts {
    fn sentence(&self, only_looks: bool) -> String {
        let files = |count: usize| if count == 1 { "1 file".to_owned() } else { format!("{count} files") };
        let done = if only_looks { "would be changed" } else { "changed" };
        format!("{} {done}, {} in canonical form already", files(self.changed), self.unchanged)
    }
}

/// Formats one file and says whether it was not in canonical form, or why it is left alone.
fn format_input(input: &Input, arguments: &FmtArguments, streams: &mut Streams) -> Result<bool, String> {
    let name = input.name(STDIN);
    let bytes = input.read().map_err(|error| files::unreadable(&name, &error))?;
    let sheet = Datasheet::new(Document::from_vec(bytes));
    let before = sheet.document().to_bytes();
    if Nature::of(before) != Nature::Text
        || sheet.sections().all(|section| section.kind() == SectionKind::Unknown)
    {
        let reason = files::own_file(before);
        let reason =
            reason.unwrap_or_else(|| "this is no CANopen file; `edskit lint` says what it is".to_owned());
        return Err(format!("{name}: left alone, {reason}"));
    }
    let after = try_format(&sheet).map_err(|reason| format!("{name}{}", left_alone(reason)))?;
    let changed = after != before;
    let written = if arguments.diff {
        if changed { streams.stdout.write_all(&difference::patch(&name, before, &after)) } else { Ok(()) }
    } else if arguments.check {
        if changed { writeln!(streams.stdout, "{name}") } else { Ok(()) }
    } else {
        match input {
            Input::Stdin(_) => streams.stdout.write_all(&after),
            Input::File(path) if changed => fs::write(path, &after),
            Input::File(_) => Ok(()),
        }
    };
    written.map_err(|error| format!("{name}: cannot be written: {error}"))?;
    Ok(changed)
}

/// Why a file is left alone, behind its name.
fn left_alone(reason: Unformattable) -> String {
    match reason {
        Unformattable::Conflict(line) => format!(
            ":{}: left alone, a version control system left a conflict here; decide which text is right first",
            line + 1
        ),
        Unformattable::TooLarge => ": left alone, it is larger than 4 GiB".to_owned(),
        Unformattable::ByteOrderMark => {
            ": left alone, a byte order mark in the midst of the file would come to its start".to_owned()
        }
    }
}
