use crate::rule::rule;
use crate::{Context, Report};
use edskit_types::{PdoDirection, Transmission};

rule! {
    /// A transmission type is reserved
    ///
    /// ## What it does
    /// Reports the transmission types 241 to 251, and 252 and 253 of an RPDO.
    ///
    /// ## Why is this bad
    /// The standard gives these numbers no meaning. Devices refuse them, or do what their maker thought of.
    ///
    /// ## Example
    /// ```eds
    /// [1400]
    /// ParameterName=RPDO 1 communication parameter
    /// ObjectType=0x9
    /// SubNumber=2
    ///
    /// [1400sub2]
    /// ParameterName=Transmission type
    /// DataType=0x0005
    /// DefaultValue=252
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1400]
    /// ParameterName=RPDO 1 communication parameter
    /// ObjectType=0x9
    /// SubNumber=2
    ///
    /// [1400sub2]
    /// ParameterName=Transmission type
    /// DataType=0x0005
    /// DefaultValue=254
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.5.2.35 and 7.5.2.37.
    pub(crate) static RESERVED_TYPE = {
        code: "PDO010",
        name: "reserved-type",
        group: Pdo,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for pdo in context.pdos() {
        if pdo.transmission() != Some(Transmission::Reserved) {
            continue;
        }
        let Some(value) = pdo.transmission_type else { continue };
        let number: u8 = value.constant().unwrap_or_default();
        let help = match pdo.direction {
            PdoDirection::Receive => "an RPDO takes 0 to 240 (at the next SYNC), 254 or 255 (at once)",
            PdoDirection::Transmit => {
                "a TPDO takes 0 to 240 (with SYNC), 252 or 253 (on request), 254 or 255 (on an event)"
            }
        };
        report
            .add(value.span(), format!("{pdo} has the transmission type {number}, which is reserved"))
            .help(help);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    fn found(index: &str, value: &str) -> Vec<String> {
        findings(
            &RESERVED_TYPE,
            &format!("[{index}]\nObjectType=9\n[{index}sub2]\nDataType=5\nDefaultValue={value}\n"),
        )
    }

    #[test]
    fn the_direction_matters() {
        for value in ["0", "240", "254", "255", "300", "", "x"] {
            assert!(found("1400", value).is_empty() && found("1800", value).is_empty(), "{value}");
        }
        assert!(found("1800", "0xFC").is_empty() && found("1800", "253").is_empty());
        assert_eq!(
            found("1400", "253"),
            ["5:14 error: RPDO1 has the transmission type 253, which is reserved"]
        );
        assert_eq!(
            found("1801", "0xF1"),
            ["5:14 error: TPDO2 has the transmission type 241, which is reserved"]
        );
    }
}
