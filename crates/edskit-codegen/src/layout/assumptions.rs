//! What was read otherwise than it is written, in one line.

use crate::Problem;
use edskit_lint::Severity;
use edskit_model::Datasheet;

/// How often something is read as it was meant, at the first place, and how to see the others.
pub(super) fn misspelt(sheet: &Datasheet) -> Option<Problem> {
    let assumed = sheet.assumed();
    let first = assumed.first()?;
    let written: String = sheet.text(first.span).chars().take(40).collect();
    let what = match assumed.len() {
        1 => format!("`{written}` is read as it was meant, `{}`", first.text),
        count => {
            format!("{count} values are read as they were meant, as here `{written}` as `{}`", first.text)
        }
    };
    let help = "`edskit show --meant` with the file lists them, `edskit lint --fix` mends them".to_owned();
    let problem = Problem::in_eds(sheet.document(), Severity::Warning, first.span, what);
    Some(Problem { help: Some(help), ..problem })
}
