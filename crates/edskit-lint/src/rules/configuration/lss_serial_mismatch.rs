use crate::evaluate::effective;
use crate::rule::rule;
use crate::{Context, Report};
use edskit_types::Index;

rule! {
    /// The serial number for LSS is not that of the identity object
    ///
    /// ## What it does
    /// Compares `LSS_SerialNumber` of `[DeviceComissioning]` with the value of 1018h sub-index 04h. A 0 on either side
    /// means that the number is not known, and is left alone.
    ///
    /// ## Why is this bad
    /// Layer setting services find the device by its identity. With another serial number they find none, or a
    /// wrong one.
    ///
    /// ## Example
    /// ```dcf
    /// [DeviceComissioning]
    /// NodeID=5
    /// LSS_SerialNumber=1001
    ///
    /// [1018]
    /// ParameterName=Identity
    /// ObjectType=0x9
    ///
    /// [1018sub4]
    /// ParameterName=Serial number
    /// DataType=0x0007
    /// ParameterValue=1002
    /// ```
    ///
    /// ## Use instead
    /// ```dcf
    /// [DeviceComissioning]
    /// NodeID=5
    /// LSS_SerialNumber=1002
    ///
    /// [1018]
    /// ParameterName=Identity
    /// ObjectType=0x9
    ///
    /// [1018sub4]
    /// ParameterName=Serial number
    /// DataType=0x0007
    /// ParameterValue=1002
    /// ```
    ///
    /// ## References
    /// CiA 305 v2.2; CiA 301 v4.2, 7.5.2.21. That the two agree is engineering judgement: they are the same number.
    pub(crate) static LSS_SERIAL_MISMATCH = {
        code: "DCF010",
        name: "lss-serial-mismatch",
        group: Configuration,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [Dcfchk("LSS_SerialNumber differs")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let Some(field) = context.sheet.commissioning().and_then(|section| section.lss_serial_number()) else {
        return;
    };
    let Some(commissioned @ 1..) = field.known() else { return };
    let Some(value) = effective(context.sheet, Index::IDENTITY, 4) else { return };
    let Some(identity @ 1..) = value.constant::<u32>() else { return };
    if commissioned == identity {
        return;
    }
    report
        .add(
            field.span(),
            format!(
                "LSS_SerialNumber is `{}`, but the identity object says `{}`",
                field.text(),
                value.entry.text()
            ),
        )
        .label(value.span(), "1018h sub-index 04h")
        .help(format!("write the same number in both, `{}` or `{}`", field.text(), value.entry.text()));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    fn found(commissioned: &str, identity: &str) -> Vec<String> {
        let text = format!(
            "[DeviceComissioning]\nLSS_SerialNumber={commissioned}\n[1018]\nObjectType=9\n[1018sub4]\nDataType=7\n{identity}\n"
        );
        findings(&LSS_SERIAL_MISMATCH, &text)
    }

    #[test]
    fn both_are_one_number() {
        assert_eq!(
            found("0x10", "DefaultValue=17"),
            ["2:18 warning: LSS_SerialNumber is `0x10`, but the identity object says `17`"]
        );
        for (commissioned, identity) in [
            ("0x10", "DefaultValue=16"),
            ("0", "DefaultValue=1"),
            ("1", "DefaultValue=0"),
            ("1", ""),
            ("1", "DefaultValue=5\nParameterValue=1"),
        ] {
            assert!(found(commissioned, identity).is_empty(), "{commissioned} {identity}");
        }
    }
}
