use crate::evaluate::Effective;
use crate::rule::rule;
use crate::{Context, FileKind, Report, Variable};
use edskit_types::{AccessType, DataType, NodeId};

rule! {
    /// A configured value differs from the default, but cannot be written
    ///
    /// ## What it does
    /// Reports a `ParameterValue` at an object with the access `const`, or `ro` in the communication profile's identity
    /// and PDO records, that differs from `DefaultValue`. Other `ro` objects may hold what was read from the device.
    ///
    /// ## Why is this bad
    /// A configuration tool that downloads the value gets abort code 0601 0002h, and the device keeps its own.
    ///
    /// ## Example
    /// ```dcf
    /// [1800sub2]
    /// ParameterName=Transmission type
    /// DataType=0x0005
    /// AccessType=const
    /// DefaultValue=254
    /// ParameterValue=1
    /// ```
    ///
    /// ## Use instead
    /// ```dcf
    /// [1800sub2]
    /// ParameterName=Transmission type
    /// DataType=0x0005
    /// AccessType=rw
    /// DefaultValue=254
    /// ParameterValue=1
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 5.3; CiA 301 v4.2 for the abort code.
    pub(crate) static PARAMETER_VALUE_READ_ONLY = {
        code: "DCF006",
        name: "parameter-value-read-only",
        group: Configuration,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: Variable(check),
    }
}

fn check(context: &Context<'_>, variable: &Variable<'_>, report: &mut Report) {
    let (Some(configured), Some(default)) = (variable.parameter_value, variable.default_value) else {
        return;
    };
    if context.kind != FileKind::Dcf {
        return;
    }
    let Some(access) = variable.access_type else { return };
    let Some(right @ (AccessType::Const | AccessType::Ro)) = access.known() else { return };
    if right == AccessType::Ro && !is_configuration(variable) {
        return;
    }
    let data_type = variable.standard_type.unwrap_or(DataType::Unsigned64);
    let node_id = crate::evaluate::commissioned(context).unwrap_or(NodeId::MIN);
    let number = |field| Effective::new(field, data_type).and_then(|value| value.at(node_id));
    let (Some(value), Some(expected)) = (number(configured), number(default)) else { return };
    if value == expected {
        return;
    }
    let message = format!(
        "{} is configured as `{}`, but is `{right}` with the default `{}`",
        variable.place(),
        configured.text(),
        default.text()
    );
    report
        .add(configured.span(), message)
        .label(access.span(), "cannot be written")
        .label(default.span(), "the device's own value")
        .help("take the `ParameterValue` out, or write `AccessType=rw` if the device lets it be written");
}

/// Whether an object holds a configuration, and nothing that the device measures.
fn is_configuration(variable: &Variable<'_>) -> bool {
    matches!(variable.index.0, 0x1018 | 0x1200..=0x127F | 0x1400..=0x1BFF)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings_in;

    fn found(section: &str, entries: &str) -> Vec<String> {
        let text = format!("[{section}]\nDataType=7\n{entries}\n[DeviceComissioning]\nNodeID=5\n");
        findings_in(&PARAMETER_VALUE_READ_ONLY, "a.dcf", text.as_bytes())
    }

    #[test]
    fn only_what_differs_and_is_no_measured_value() {
        assert_eq!(
            found("2000", "AccessType=const\nDefaultValue=1\nParameterValue=2"),
            ["5:16 warning: 2000h is configured as `2`, but is `const` with the default `1`"]
        );
        assert_eq!(found("1018sub2", "AccessType=ro\nDefaultValue=1\nParameterValue=2").len(), 1);
        for fine in [
            "AccessType=ro\nDefaultValue=1\nParameterValue=2",
            "AccessType=const\nDefaultValue=0x185\nParameterValue=$NODEID+0x180",
            "AccessType=const\nParameterValue=2",
            "AccessType=rw\nDefaultValue=1\nParameterValue=2",
        ] {
            assert!(found("2000", fine).is_empty(), "{fine}");
        }
    }
}
