use super::reading::{Role, each_value, is_owned_elsewhere, name};
use crate::rule::rule;
use crate::{Context, Edit, Report, Variable};
use edskit_model::Value;
use edskit_types::DataType;

rule! {
    /// A BOOLEAN is neither 0 nor 1
    ///
    /// ## What it does
    /// Reports a value of a BOOLEAN object other than `0` and `1`.
    ///
    /// ## Why is this bad
    /// Readers differ: some take every other number as true, some refuse it, and a word is read by few.
    ///
    /// ## Example
    /// ```eds
    /// [2000]
    /// ParameterName=Brake released
    /// DataType=0x0001
    /// DefaultValue=true
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [2000]
    /// ParameterName=Brake released
    /// DataType=0x0001
    /// DefaultValue=1
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.3.
    pub(crate) static BOOLEAN_VALUE = {
        code: "VAL008",
        name: "boolean-value",
        group: Values,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [EdsDcfCheck("VAL001")],
        check: Variable(check),
    }
}

fn check(context: &Context<'_>, variable: &Variable<'_>, report: &mut Report) {
    if variable.standard_type != Some(DataType::Boolean) {
        return;
    }
    each_value(context, variable, |role, field| {
        let raw = field.entry.raw();
        if role == Role::Limit || field.value.is_ok() || is_owned_elsewhere(raw) {
            return;
        }
        let message = format!("{} is `{}`, but a BOOLEAN is 0 or 1", name(field.entry), field.text());
        let finding = report.add(field.span(), message);
        match field.known() {
            Some(value) => {
                let value = u8::from(value == Value::Boolean(true)).to_string();
                finding.help(format!("write `{value}`"));
                finding.unsafe_fix(format!("Write {value}"), vec![Edit::replace(field.span(), value)]);
            }
            None => {
                finding.help("write `0` or `1`");
            }
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, findings_in, fixed};

    #[test]
    fn numbers_and_words() {
        let default = |value: &str| {
            findings(&BOOLEAN_VALUE, &format!("[2000]\nDataType=1\nDefaultValue={value}\n")).join("|")
        };
        assert_eq!(default("2"), "3:14 warning: `DefaultValue` is `2`, but a BOOLEAN is 0 or 1");
        assert_eq!(default("False"), "3:14 warning: `DefaultValue` is `False`, but a BOOLEAN is 0 or 1");
        for value in ["0", "1", "0x01", "", "1 ; on", "$NODEID"] {
            assert_eq!(default(value), "");
        }
        assert_eq!(
            fixed(
                &BOOLEAN_VALUE,
                "[2000]\nDataType=1\nDefaultValue=YES\n[2001]\nDataType=1\nDefaultValue=2\n"
            ),
            "[2000]\nDataType=1\nDefaultValue=1\n[2001]\nDataType=1\nDefaultValue=2\n"
        );
    }

    #[test]
    fn limits_are_left_out_and_compact_values_are_not() {
        let text = "[2000]\nDataType=1\nObjectType=8\nCompactSubObj=2\nHighLimit=3\n[2000Value]\nNrOfEntries=1\n1=7\n";
        assert_eq!(
            findings_in(&BOOLEAN_VALUE, "a.dcf", text.as_bytes()),
            ["8:3 warning: value 1 of `[2000Value]` is `7`, but a BOOLEAN is 0 or 1"]
        );
    }
}
