use crate::rule::rule;
use crate::{Context, Report};

rule! {
    /// A comment allows what does not occur
    ///
    /// ## What it does
    /// Reports a comment `;edskit: allow(RULE)` or `;edskit: allow-file(RULE)` that silences no finding, or that names
    /// no rule, and a comment that begins with `;edskit:` and is of neither form. Rules that are off in this run are not
    /// counted as unused.
    ///
    /// ## Why is this bad
    /// The comment outlived its reason. It will hide the next real finding at its place. One that cannot be read allows
    /// nothing, although it looks as if it did.
    ///
    /// ## Example
    /// ```eds
    /// ;edskit: allow(OBJ999) the supplier cannot change it
    /// [2000]
    /// ParameterName=Speed
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [2000]
    /// ParameterName=Speed
    /// ```
    ///
    /// ## References
    /// Engineering judgement: a suppression is a debt that should be seen when it is paid.
    pub(crate) static UNUSED_SUPPRESSION = {
        code: "SYN027",
        name: "unused-suppression",
        group: Syntax,
        severity: Warning,
        since: "0.1.0",
        files: ALL_FILES,
        check: File(check),
    }
}

/// Whether a comment is used shows only when all rules have run, so `suppression.rs` reports for this rule.
fn check(_: &Context<'_>, _: &mut Report) {}
