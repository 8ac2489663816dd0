//! What is written wrongly, and read as it was meant.

use edskit_model::Datasheet;
use serde::Serialize;
use std::io::{self, Write};

/// One value or header.
#[derive(Serialize)]
pub(super) struct MeantView {
    line: u32,
    column: u32,
    /// As it is written
    written: String,
    /// As it is read
    meant: String,
    reason: &'static str,
}

pub(super) fn views(sheet: &Datasheet) -> Vec<MeantView> {
    let view = |assumed: edskit_model::Assumed| {
        let place = sheet.document().position(assumed.span.start);
        MeantView {
            line: place.line,
            column: place.column,
            written: sheet.text(assumed.span).into_owned(),
            meant: assumed.text,
            reason: assumed.reason,
        }
    };
    sheet.assumed().into_iter().map(view).collect()
}

/// How many there are, and how to see them.
pub(super) fn summary(views: &[MeantView]) -> Option<String> {
    let what = match views.len() {
        0 => return None,
        1 => "1 value is written wrongly and read as it was meant".to_owned(),
        count => format!("{count} values are written wrongly and read as they were meant"),
    };
    Some(format!("{what}; --meant lists them"))
}

pub(super) fn write(views: &[MeantView], name: &str, out: &mut dyn Write) -> io::Result<()> {
    for MeantView { line, column, written, meant, reason } in views {
        writeln!(out, "{name}:{line}:{column}: `{written}` is read as `{meant}`: {reason}")?;
    }
    if views.is_empty() {
        writeln!(out, "{name}: everything is read as it is written")?;
    }
    Ok(())
}
