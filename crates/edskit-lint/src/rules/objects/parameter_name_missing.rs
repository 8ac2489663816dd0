use super::structure::is_under_value;
use crate::rule::rule;
use crate::{Context, Report, Severity, Variable};
use edskit_model::KeyName;
use edskit_types::ObjectCode;

rule! {
    /// An object or sub-object has no name
    ///
    /// ## What it does
    /// Reports an object or sub-object without `ParameterName` as an error, and one whose `ParameterName` is empty as
    /// a warning.
    ///
    /// ## Why is this bad
    /// The name is mandatory for every object and sub-object, and an empty entry counts as a missing one. Tools show
    /// the name to people and use it as a key; some refuse a file in which it is missing.
    ///
    /// ## Example
    /// ```eds
    /// [2010]
    /// ObjectType=0x7
    /// DataType=0x0006
    /// AccessType=rw
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [2010]
    /// ParameterName=Ramp time
    /// ObjectType=0x7
    /// DataType=0x0006
    /// AccessType=rw
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.2 and 4.6.3.2.
    pub(crate) static PARAMETER_NAME_MISSING = {
        code: "OBJ001",
        name: "parametername-missing",
        group: Objects,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: Variable(check),
    }
}

fn check(context: &Context<'_>, variable: &Variable<'_>, report: &mut Report) {
    let description = variable.description;
    if description.parameter_name().is_some() || variable.code == Some(ObjectCode::Null) {
        return;
    }
    if is_under_value(context, variable) {
        return;
    }
    let help = "write a name that says what the value is";
    match description.entry(KeyName::ParameterName) {
        Some(empty) => report
            .add(empty.span(), format!("the ParameterName of {} is empty", variable.place()))
            .severity(Severity::Warning)
            .help(help),
        None => report
            .add(description.section().span(), format!("{} has no ParameterName", variable.place()))
            .help(help),
    };
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn what_must_not_be_there_needs_no_name() {
        assert!(findings(&PARAMETER_NAME_MISSING, "[2000]\nParameterName=a\n[2000sub0]\n").is_empty());
    }

    #[test]
    fn empty_is_less_bad_than_missing() {
        assert_eq!(
            findings(
                &PARAMETER_NAME_MISSING,
                "[2000]\nObjectType=9\nParameterName=\n[2000sub1]\nDataType=5\n[2001]\nObjectType=0\n"
            ),
            [
                "3:1 warning: the ParameterName of 2000h is empty",
                "4:1 error: 2000h sub-index 01h has no ParameterName"
            ]
        );
    }
}
