use super::error_field::{self, Part};
use crate::evaluate::stated;
use crate::rule::rule;
use crate::{Context, Edit, Report, Severity, Variable};
use edskit_model::KeyName;
use edskit_types::Index;

rule! {
    /// The file says which errors have happened
    ///
    /// ## What it does
    /// Reports a value other than 0 in the history of errors 1003h: the number of errors at sub-index 00h, and the errors
    /// behind it. In the error register 1001h it is an information.
    ///
    /// ## Why is this bad
    /// Sub-index 00h is no highest sub-index but counts the errors since power-on, which only the running device knows. A
    /// device that takes the value from the file tells errors that never happened; nobody can clear them where the count
    /// is read-only.
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
    /// AccessType=rw
    /// DefaultValue=1
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
    /// DefaultValue=0
    ///
    /// [1003sub1]
    /// ParameterName=Last error
    /// DataType=0x0007
    /// AccessType=ro
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.5.2.4.
    pub(crate) static RUN_TIME_VALUE = {
        code: "COM021",
        name: "run-time-value",
        group: Communication,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: Variable(check),
    }
}

fn check(context: &Context<'_>, variable: &Variable<'_>, report: &mut Report) {
    let part = error_field::part(variable);
    if part.is_none() && variable.index != Index::ERROR_REGISTER {
        return;
    }
    for value in stated(context, variable) {
        // What does not fit its type is the matter of VAL002.
        let Some(number) = value.constant::<i128>().filter(|number| *number != 0) else { continue };
        let entry = value.entry;
        let what = match part {
            None => {
                format!("the error register is {number:02X}h, but only the running device knows its errors")
            }
            Some(Part::Count) => {
                format!("1003h sub-index 00h is {number}, but it counts the errors since power-on")
            }
            Some(Part::Error | Part::Object) => format!(
                "{} holds the error {number:X}h, but no error has happened at power-on",
                variable.place()
            ),
        };
        let finding = report.add(value.span(), what);
        if part.is_none() {
            // A device may come up with an error each time; 1003h is empty all the same.
            finding.severity(Severity::Info);
        }
        if entry.key().name == KeyName::Item {
            finding.help("take it out of the list");
        } else {
            finding
                .help(format!("write `{}=0`", entry.key_text()))
                .unsafe_fix("Write 0", vec![Edit::replace(value.span(), "0")]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, findings_in, fixed};

    #[test]
    fn the_history_begins_empty() {
        let text = "[1003]\nObjectType=8\n[1003sub0]\nDataType=5\nDefaultValue=8\n[1003sub1]\nDataType=7\nDefaultValue=0x8130 ; heartbeat\n[1003sub2]\nDataType=7\nDefaultValue=0\n[1003subFF]\nDataType=7\nDefaultValue=0x0708\n";
        assert_eq!(
            findings(&RUN_TIME_VALUE, text),
            [
                "5:14 warning: 1003h sub-index 00h is 8, but it counts the errors since power-on",
                "8:14 warning: 1003h sub-index 01h holds the error 8130h, but no error has happened at power-on",
            ]
        );
        let zero = "[1003sub0]\nDataType=5\nDefaultValue=0\nParameterValue=0x0\n";
        assert_eq!(findings_in(&RUN_TIME_VALUE, "a.dcf", zero.as_bytes()), [""; 0]);
        assert_eq!(
            fixed(&RUN_TIME_VALUE, "[1003sub0]\nDataType=5\nDefaultValue=8\n"),
            "[1003sub0]\nDataType=5\nDefaultValue=0\n"
        );
    }

    #[test]
    fn the_error_register_is_the_devices_own() {
        let text = "[1001]\nObjectType=7\nDataType=5\nAccessType=ro\nDefaultValue=0x81\n";
        assert_eq!(
            findings(&RUN_TIME_VALUE, text),
            ["5:14 info: the error register is 81h, but only the running device knows its errors"]
        );
        let configured = text.replace("DefaultValue=0x81", "DefaultValue=0\nParameterValue=5");
        assert_eq!(findings_in(&RUN_TIME_VALUE, "a.dcf", configured.as_bytes()).len(), 1);
        assert_eq!(findings(&RUN_TIME_VALUE, &text.replace("0x81", "0x00")), [""; 0]);
    }

    #[test]
    fn compact_storage_counts_too() {
        let text = "[1003]\nObjectType=8\nDataType=7\nAccessType=ro\nDefaultValue=1\nCompactSubObj=8\n[1003Value]\nNrOfEntries=1\n2=5\n";
        assert_eq!(
            findings_in(&RUN_TIME_VALUE, "a.dcf", text.as_bytes()),
            [
                "5:14 warning: 1003h holds the error 1h, but no error has happened at power-on",
                "9:3 warning: 1003h holds the error 5h, but no error has happened at power-on",
            ]
        );
        let usual = "[1003]\nObjectType=8\nDataType=7\nAccessType=ro\nCompactSubObj=8\n";
        assert_eq!(findings(&RUN_TIME_VALUE, usual), [""; 0], "its number is the room for errors");
    }
}
