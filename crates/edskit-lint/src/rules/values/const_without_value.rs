use crate::rule::rule;
use crate::{Context, Report, Variable};
use edskit_model::KeyName;
use edskit_types::{AccessType, DataTypeKind, Index, SubIndex};

rule! {
    /// A constant has no value
    ///
    /// ## What it does
    /// Reports a variable with the access type `const` that has neither a `DefaultValue` nor a `ParameterValue`.
    /// Strings, DOMAIN and the serial number (1018h sub-index 04h), which differ from device to device, are left out.
    ///
    /// ## Why is this bad
    /// A constant never changes, so the file is the place where its value is known. A tool that checks a device, or
    /// makes one from the file, has nothing to go by.
    ///
    /// ## Example
    /// ```eds
    /// [1018sub1]
    /// ParameterName=Vendor-ID
    /// DataType=0x0007
    /// AccessType=const
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1018sub1]
    /// ParameterName=Vendor-ID
    /// DataType=0x0007
    /// AccessType=const
    /// DefaultValue=0x00000319
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.6.3.2. Engineering judgement: `DefaultValue` is optional there, also for constants.
    pub(crate) static CONST_WITHOUT_VALUE = {
        code: "VAL011",
        name: "const-without-value",
        group: Values,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: Variable(check),
    }
}

/// Where the serial number is.
const SERIAL_NUMBER: (Index, Option<SubIndex>) = (Index::IDENTITY, Some(SubIndex(4)));

fn check(_: &Context<'_>, variable: &Variable<'_>, report: &mut Report) {
    if variable.default_value.is_some() || variable.parameter_value.is_some() || !variable.holds_value() {
        return;
    }
    let Some(access) = variable.access_type else { return };
    if access.value != Ok(AccessType::Const) || (variable.index, variable.sub_index) == SERIAL_NUMBER {
        return;
    }
    let is_data = |kind| {
        matches!(
            kind,
            DataTypeKind::VisibleString
                | DataTypeKind::OctetString
                | DataTypeKind::UnicodeString
                | DataTypeKind::Domain
        )
    };
    if variable.standard_type.is_some_and(|data_type| is_data(data_type.kind())) {
        return;
    }
    let finding = report.add(access.span(), format!("{} is constant, but has no value", variable.place()));
    if let Some(empty) = variable.description.section().entry(KeyName::DefaultValue) {
        finding.label(empty.span(), "empty, which counts as missing");
    }
    finding.help("add a `DefaultValue`, or write `AccessType=ro` if the value differs from device to device");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn numbers_that_never_change_need_a_value() {
        let text = "[2000]\nDataType=5\nAccessType=const\nDefaultValue=\n[2001]\nDataType=5\nAccessType=ro\n[2002]\nDataType=5\nAccessType=const\nParameterValue=1\n";
        assert_eq!(
            findings(&CONST_WITHOUT_VALUE, text),
            ["3:12 warning: 2000h is constant, but has no value"]
        );
    }

    #[test]
    fn texts_serial_numbers_and_heads_are_left_out() {
        let text = "[1008]\nDataType=9\nAccessType=const\n[1018sub4]\nDataType=7\nAccessType=const\n[2000]\nObjectType=8\nAccessType=const\n";
        assert_eq!(findings(&CONST_WITHOUT_VALUE, text), [""; 0]);
    }
}
