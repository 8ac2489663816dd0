use super::structure::is_under_value;
use crate::rule::rule;
use crate::{Context, Report, Severity, Variable};
use edskit_model::{KeyName, SubObject};
use edskit_types::ObjectCode;

rule! {
    /// An object or sub-object has no name
    ///
    /// ## What it does
    /// Reports an object or sub-object without `ParameterName` as an error, and one whose `ParameterName` is empty as
    /// a warning, one for the sub-objects of an object.
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
        peers: [CanChkEds("26"), EdsDcfCheck("OBJ010"), Dcfchk("ParameterName not specified")],
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
        Some(empty) => {
            let Some(further) = further(context, variable) else { return };
            let so_are = match further {
                0 => String::new(),
                1 => ", and so is that of one further sub-index".to_owned(),
                more => format!(", and so are those of {more} further sub-indices"),
            };
            report
                .add(empty.span(), format!("the ParameterName of {} is empty{so_are}", variable.place()))
                .severity(Severity::Warning)
                .help(help)
        }
        None => report
            .add(description.section().span(), format!("{} has no ParameterName", variable.place()))
            .help(help),
    };
}

/// How many sub-objects behind this one have an empty name as well; `None` where one before it has, which tells of all.
fn further(context: &Context<'_>, variable: &Variable<'_>) -> Option<usize> {
    let Some(own) = variable.sub_index else { return Some(0) };
    let Some(object) = context.sheet.object(variable.index) else { return Some(0) };
    let has_empty_name = |sub: &SubObject<'_>| {
        let name = sub.description().entry(KeyName::ParameterName);
        name.is_some_and(|entry| entry.is_empty())
    };
    let mut alike = object.sub_objects().filter(has_empty_name);
    (alike.next()?.sub_index() == own).then(|| alike.count())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn empty_names_of_one_object_are_one_finding() {
        let mut text = "[1F81]\nObjectType=8\nParameterName=a\n".to_owned();
        for sub in 0..5 {
            let name = if sub == 1 { "b" } else { "" };
            text.push_str(&format!("[1F81sub{sub}]\nParameterName={name}\n"));
        }
        assert_eq!(
            findings(&PARAMETER_NAME_MISSING, &text),
            [
                "5:1 warning: the ParameterName of 1F81h sub-index 00h is empty, and so are those of 3 further sub-indices"
            ]
        );
    }

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
