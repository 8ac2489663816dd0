//! `edskit show`.

mod human;
mod layout;
mod meant;
mod view;

use crate::cli::{ShowArguments, ShowFormat};
use crate::files;
use crate::printable;
use crate::{Exit, Streams};
use edskit_model::nature::Nature;
use edskit_model::{Datasheet, SectionKind};
use edskit_types::{Index, SubIndex};
use serde::Serialize;
use std::io::{self, Write};
use view::{ObjectView, PdoView, Viewer};

pub(crate) fn run(arguments: &ShowArguments, streams: &mut Streams) -> io::Result<Exit> {
    let name = arguments.file.to_string_lossy();
    let sheet = files::read_datasheet(&arguments.file, streams)?;
    if is_no_device(&sheet) {
        let reason = files::own_file(sheet.document().to_bytes());
        let reason =
            reason.unwrap_or_else(|| "this is no EDS or DCF; `edskit lint` says what it is".to_owned());
        streams.complain(format_args!("{name}: {reason}"));
        return Ok(Exit::Failed);
    }
    let assumed = meant::views(&sheet);
    if arguments.meant {
        return print(&assumed, arguments.format, streams, |view, out| meant::write(view, &name, out));
    }
    if let Some(line) = meant::summary(&assumed) {
        writeln!(streams.stderr, "{}: {line}", printable::line(&name))?;
    }
    let viewer = Viewer { sheet: &sheet, node_id: arguments.node_id.or(sheet.commissioned_node_id()) };
    let Some(place) = arguments.place else {
        let view = viewer.device();
        return print(&view, arguments.format, streams, |view, out| human::device(view, out));
    };
    let index = Index(place.index);
    let object = sheet.object(index).map(|object| viewer.object(object));
    let Some(mut object) = object else {
        streams.complain(format_args!("{name}: there is no object {index}"));
        return Ok(Exit::Failed);
    };
    if let Some(sub_index) = place.sub_index.map(SubIndex) {
        object.entries.retain(|entry| entry.sub_index == sub_index.0);
        if object.entries.is_empty() {
            streams.complain(format_args!("{name}: object {index} has no sub-index {sub_index}"));
            return Ok(Exit::Failed);
        }
    }
    let view = ObjectReport { object, pdo: viewer.pdo_of(index) };
    print(&view, arguments.format, streams, |view, out| human::object(&view.object, view.pdo.as_ref(), out))
}

/// One object, and the PDO that it is a parameter of.
#[derive(Serialize)]
struct ObjectReport {
    object: ObjectView,
    pdo: Option<PdoView>,
}

/// Whether there is nothing of a device in the file.
fn is_no_device(sheet: &Datasheet) -> bool {
    Nature::of(sheet.document().to_bytes()) != Nature::Text
        || sheet
            .sections()
            .all(|section| matches!(section.kind(), SectionKind::Unknown | SectionKind::Topology(_)))
}

fn print<T: Serialize>(
    view: &T,
    format: ShowFormat,
    streams: &mut Streams,
    human: impl FnOnce(&T, &mut dyn Write) -> io::Result<()>,
) -> io::Result<Exit> {
    match format {
        ShowFormat::Human => {
            let mut text = Vec::new();
            human(view, &mut text)?;
            for line in String::from_utf8_lossy(&text).lines() {
                writeln!(streams.stdout, "{}", printable::line(line))?;
            }
        }
        ShowFormat::Json => {
            serde_json::to_writer_pretty(&mut streams.stdout, view)?;
            writeln!(streams.stdout)?;
        }
    }
    streams.stdout.flush()?;
    Ok(Exit::Clean)
}
