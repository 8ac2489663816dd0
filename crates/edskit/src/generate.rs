//! `edskit generate`: the object dictionary of an EDS as Rust, without a build script.

use crate::cli::GenerateArguments;
use crate::device_file::{DeviceFile, print_problems};
use crate::printable;
use crate::settings::{Finder, SettingsError};
use crate::{Exit, Streams};
use edskit_codegen::{generate, module_name, write_if_changed};
use edskit_lint::{Linter, RuleSet};
use std::ffi::OsString;
use std::io;
use std::path::Path;
use std::sync::Arc;

pub(crate) fn run(arguments: &GenerateArguments, streams: &mut Streams) -> io::Result<Exit> {
    let DeviceFile { eds, side_file, mut naming } =
        match DeviceFile::read(&arguments.file, arguments.side_file.as_deref()) {
            Ok(file) => file,
            Err(reason) => {
                streams.complain(format_args!("{reason}"));
                return Ok(Exit::Failed);
            }
        };
    if let Some(name) = &arguments.name {
        naming.module = module_name(name);
    }
    naming.runtime.clone_from(&arguments.runtime);
    let linter = match linter(&arguments.file) {
        Ok(linter) => linter,
        Err(error) => {
            streams.complain(format_args!("{error}"));
            return Ok(Exit::Failed);
        }
    };
    let generated = match generate(&eds, side_file.as_deref(), &naming, &linter) {
        Ok(generated) => generated,
        Err(problems) => {
            print_problems(&problems, &naming, streams)?;
            let reason = match problems.len() {
                1 => "1 error, nothing is generated".to_owned(),
                count => format!("{count} errors, nothing is generated"),
            };
            streams.complain(format_args!("{}: {reason}", printable::line(&naming.eds)));
            return Ok(Exit::Findings);
        }
    };
    print_problems(&generated.warnings, &naming, streams)?;
    let path = arguments.output.join(file_name(arguments));
    match write_if_changed(&path, &generated.code) {
        Ok(is_new) => {
            let what = if is_new { "written" } else { "unchanged" };
            writeln!(streams.stdout, "{}: {what}, module `{}`", path.display(), naming.module)?;
            streams.stdout.flush()?;
            Ok(Exit::Clean)
        }
        Err(error) => {
            streams.complain(format_args!("{}: {error}", path.display()));
            Ok(Exit::Failed)
        }
    }
}

/// The rules that `edskit.toml` gives the file, as `edskit lint` finds it.
fn linter(file: &Path) -> Result<Linter, SettingsError> {
    let folder = file.parent().unwrap_or(Path::new(""));
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let settings = Finder::default().find(folder)?;
    Ok(match settings {
        Some(settings) => {
            Linter::new(settings.rules_for(file)).with_profiles(Arc::clone(settings.profiles()))
        }
        None => Linter::new(RuleSet::default()),
    })
}

/// `Device.rs`, after the given name or the EDS.
fn file_name(arguments: &GenerateArguments) -> OsString {
    let stem = || arguments.file.file_stem().unwrap_or_default().to_owned();
    let mut name = arguments.name.as_ref().map_or_else(stem, OsString::from);
    name.push(".rs");
    name
}
