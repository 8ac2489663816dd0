use super::elements::{self, like, rewrite};
use super::error_field::{self, Part};
use crate::rule::rule;
use crate::{Context, Report, Variable};
use edskit_model::SubObject;
use edskit_types::AccessType;

rule! {
    /// The error history has the wrong rights
    ///
    /// ## What it does
    /// Reports a pre-defined error field (1003h) whose sub-index 00h cannot be written, or whose errors can.
    ///
    /// ## Why is this bad
    /// A client clears the history by writing 0 to sub-index 00h; where that is `ro`, tools do not offer it. The errors
    /// themselves are what the device has seen, and nobody may write them.
    ///
    /// ## Example
    /// ```eds
    /// [1003]
    /// ParameterName=Pre-defined error field
    /// ObjectType=0x8
    /// SubNumber=2
    ///
    /// [1003sub0]
    /// ParameterName=Number of errors
    /// DataType=0x0005
    /// AccessType=ro
    ///
    /// [1003sub1]
    /// ParameterName=Last error
    /// DataType=0x0007
    /// AccessType=ro
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1003]
    /// ParameterName=Pre-defined error field
    /// ObjectType=0x8
    /// SubNumber=2
    ///
    /// [1003sub0]
    /// ParameterName=Number of errors
    /// DataType=0x0005
    /// AccessType=rw
    ///
    /// [1003sub1]
    /// ParameterName=Last error
    /// DataType=0x0007
    /// AccessType=ro
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.5.2.4.
    pub(crate) static ERROR_HISTORY = {
        code: "COM004",
        name: "error-history",
        group: Communication,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: Variable(check),
    }
}

fn check(context: &Context<'_>, variable: &Variable<'_>, report: &mut Report) {
    let Some(part) = error_field::part(variable) else { return };
    let Some(field) = variable.access_type else { return };
    let Some(access) = field.known() else { return };
    // CiA 301 always prescribes something for it, unless it is a VAR, which is the matter of COM001.
    let Some(prescribed) = variable.prescribed().next() else { return };
    let is_clearable = access.is_readable() && access.is_writable();
    let is_history = access.is_readable() && !access.is_writable();
    let (right, message) = match part {
        Part::Count if !is_clearable => (
            AccessType::Rw,
            format!("1003h sub-index 00h is `{access}`, so that the error history cannot be cleared"),
        ),
        Part::Error if !is_history => (
            AccessType::Ro,
            format!("{} is `{access}`, so that anybody could write an error", variable.place()),
        ),
        Part::Object if variable.is_compact() && !is_history => {
            (AccessType::Ro, format!("the errors of 1003h are `{access}`, so that anybody could write one"))
        }
        _ => return,
    };
    let is_wrong_too = |sub: SubObject<'_>| sub.access() == Some(access);
    let Some(further) = elements::further(context, variable, prescribed, is_wrong_too) else { return };
    report
        .add(field.span(), format!("{message}{}", like(&further)))
        .help(format!("write `AccessType={right}`"))
        .unsafe_fix(format!("Make it {right}"), rewrite(field, &further, right));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn the_count_is_written_and_the_errors_are_not() {
        let text = "[1003]\nObjectType=8\n[1003sub0]\nAccessType=const\n[1003sub1]\nAccessType=rww\n[1003sub2]\nAccessType=ro\n[1003subFF]\nAccessType=rw\n";
        assert_eq!(
            findings(&ERROR_HISTORY, text),
            [
                "4:12 warning: 1003h sub-index 00h is `const`, so that the error history cannot be cleared",
                "6:12 warning: 1003h sub-index 01h is `rww`, so that anybody could write an error"
            ]
        );
        assert_eq!(
            findings(&ERROR_HISTORY, "[1003]\nObjectType=8\nAccessType=rw\nCompactSubObj=8\n"),
            ["3:12 warning: the errors of 1003h are `rw`, so that anybody could write one"]
        );
        assert_eq!(fixed(&ERROR_HISTORY, "[1003sub0]\nAccessType=ro\n"), "[1003sub0]\nAccessType=rw\n");
    }
}
