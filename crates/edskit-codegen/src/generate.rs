//! From the bytes of an EDS to code, without any file.

use crate::gate::Gate;
use crate::render::{called, renamed, render_called};
use crate::{Layout, Naming, Problem, SideFile, lay_out};
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
/// What makes the dictionary wrong, ambiguous or impossible: findings of severity error where a value or type is lost or
/// something is described twice, findings of rules that were given the severity error, mappings that lead nowhere. All other
/// findings are warnings.
pub fn generate(
    eds: &[u8],
    side_file: Option<&str>,
    naming: &Naming,
    linter: &Linter,
) -> Result<Generated, Vec<Problem>> {
    let sheet = Datasheet::parse(eds);
    let file_name = naming.eds.rsplit(['/', '\\']).next();
    let findings = linter.lint(&sheet, FileKind::of(&naming.eds), file_name);
    let layout = lay_out(&sheet, &read_side_file(side_file)?);
    let gate = Gate::new(&sheet, linter.rules(), layout.as_ref().ok());
    let (stopping, others): (Vec<_>, Vec<_>) = findings.into_iter().partition(|finding| gate.stops(finding));
    let problem = |finding| Problem::of_finding(sheet.document(), finding);
    if !stopping.is_empty() {
        return Err(stopping.into_iter().map(problem).collect());
    }
    let layout = layout?;
    let (errors, unused): (Vec<_>, Vec<_>) =
        layout.mapping_problems().into_iter().partition(|problem| problem.severity == Severity::Error);
    if !errors.is_empty() {
        return Err(errors);
    }
    let mut warnings = layout.assumptions.clone();
    let of_linter = others.into_iter().filter(|finding| finding.severity >= Severity::Warning).map(problem);
    warnings.extend(of_linter.map(|problem| Problem { severity: Severity::Warning, ..problem }));
    warnings.extend_from_slice(&layout.lost);
    warnings.extend_from_slice(&layout.notes);
    warnings.extend(layout.cob_id_problems(None));
    warnings.extend(unused);
    let called = called(&layout);
    warnings.extend(renamed(&layout, &called));
    Ok(Generated { code: render_called(&layout, naming, called), layout, warnings })
}

fn read_side_file(text: Option<&str>) -> Result<SideFile, Vec<Problem>> {
    text.map_or(Ok(SideFile::default()), SideFile::parse).map_err(|problem| vec![problem])
}
