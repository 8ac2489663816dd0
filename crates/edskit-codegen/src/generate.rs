//! From the bytes of an EDS to code, without any file.

use crate::{Layout, Naming, Problem, SideFile, lay_out, render};
use edskit_lint::{FileKind, Linter, Severity};
use edskit_model::Datasheet;

/// A dictionary as code.
#[derive(Clone, Debug)]
pub struct Generated {
    /// The Rust code: one module.
    pub code: String,
    /// The same as data.
    pub layout: Layout,
    /// What is worth knowing, but does not stand against it: warnings of the linter and of the generator.
    pub warnings: Vec<Problem>,
}

/// Reads an EDS or DCF and a side-file into a layout, whatever the linter would say.
///
/// # Errors
/// What makes a dictionary impossible.
pub fn parse(eds: &[u8], side_file: Option<&str>) -> Result<Layout, Vec<Problem>> {
    lay_out(&Datasheet::parse(eds), &read_side_file(side_file)?)
}

/// Lints an EDS or DCF, lays it out and renders it.
///
/// ```
/// use edskit_codegen::{Naming, generate};
/// use edskit_lint::{Linter, RuleSet};
/// let text = b"[1017]\nParameterName=Heartbeat\nDataType=6\nAccessType=rw\n";
/// let generated = generate(text, None, &Naming::of("Pump.eds"), &Linter::new(RuleSet::none())).unwrap();
/// assert!(generated.code.contains("pub const HEARTBEAT: Handle<u16>"));
/// ```
///
/// # Errors
/// Every finding of severity error, or what makes a dictionary impossible.
pub fn generate(
    eds: &[u8],
    side_file: Option<&str>,
    naming: &Naming,
    linter: &Linter,
) -> Result<Generated, Vec<Problem>> {
    let sheet = Datasheet::parse(eds);
    let file_name = naming.eds.rsplit(['/', '\\']).next();
    let findings = linter.lint(&sheet, FileKind::of(&naming.eds), file_name);
    let problems = findings.into_iter().map(|finding| Problem::of_finding(sheet.document(), finding));
    let (errors, mut warnings): (Vec<_>, Vec<_>) =
        problems.partition(|problem| problem.severity == Severity::Error);
    if !errors.is_empty() {
        return Err(errors);
    }
    let layout = lay_out(&sheet, &read_side_file(side_file)?)?;
    let errors = layout.mapping_problems();
    if !errors.is_empty() {
        return Err(errors);
    }
    warnings.retain(|problem| problem.severity == Severity::Warning);
    warnings.extend_from_slice(&layout.notes);
    Ok(Generated { code: render(&layout, naming), layout, warnings })
}

fn read_side_file(text: Option<&str>) -> Result<SideFile, Vec<Problem>> {
    text.map_or(Ok(SideFile::default()), SideFile::parse).map_err(|problem| vec![problem])
}
