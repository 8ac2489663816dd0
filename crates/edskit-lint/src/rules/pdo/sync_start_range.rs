use crate::rule::rule;
use crate::{Context, Report, Severity};
use edskit_types::{PdoDirection, Transmission};

rule! {
    /// A SYNC start value is out of range or without effect
    ///
    /// ## What it does
    /// Reports a SYNC start value (sub-index 06h of a TPDO's communication parameter) above 240. A value other than 0
    /// of a TPDO that is not sent cyclically with SYNC is an information.
    ///
    /// ## Why is this bad
    /// The SYNC counter ends at 240, so the TPDO would never start. Without a cyclic transmission type the value does
    /// nothing.
    ///
    /// ## Example
    /// ```eds
    /// [1800]
    /// ParameterName=TPDO 1 communication parameter
    /// ObjectType=0x9
    /// SubNumber=7
    ///
    /// [1800sub6]
    /// ParameterName=SYNC start value
    /// DataType=0x0005
    /// DefaultValue=250
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1800]
    /// ParameterName=TPDO 1 communication parameter
    /// ObjectType=0x9
    /// SubNumber=7
    ///
    /// [1800sub6]
    /// ParameterName=SYNC start value
    /// DataType=0x0005
    /// DefaultValue=0
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.5.2.37.
    pub(crate) static SYNC_START_RANGE = {
        code: "PDO015",
        name: "sync-start-range",
        group: Pdo,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: File(check),
    }
}

/// The greatest value of the SYNC counter.
const HIGHEST: u8 = 240;

fn check(context: &Context<'_>, report: &mut Report) {
    for pdo in context.pdos().iter().filter(|pdo| pdo.direction == PdoDirection::Transmit) {
        let Some(value) = pdo.parameter(6) else { continue };
        let Some(start @ 1..) = value.constant::<u8>() else { continue };
        if start > HIGHEST {
            report
                .add(value.span(), format!("{pdo} starts at SYNC {start}, but the counter ends at {HIGHEST}"))
                .help("write 0 to start at once, or a value of the SYNC counter");
            continue;
        }
        let (Some(kind), Some(transmission)) = (pdo.transmission_type, pdo.transmission()) else { continue };
        if !matches!(transmission, Transmission::SynchronousCyclic(_)) {
            report
                .add(
                    value.span(),
                    format!("{pdo} has the SYNC start value {start}, but is not sent cyclically with SYNC"),
                )
                .severity(Severity::Info)
                .label(kind.span(), "the transmission type")
                .help("write 0, or a transmission type of 1 to 240");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    fn found(kind: &str, start: &str) -> Vec<String> {
        let text = format!(
            "[1800]\nObjectType=9\n[1800sub2]\nDataType=5\nDefaultValue={kind}\n[1800sub6]\nDataType=5\nDefaultValue={start}\n"
        );
        findings(&SYNC_START_RANGE, &text)
    }

    #[test]
    fn values_of_the_counter() {
        assert!(found("1", "240").is_empty() && found("254", "0").is_empty() && found("", "5").is_empty());
        assert_eq!(found("1", "241"), ["8:14 error: TPDO1 starts at SYNC 241, but the counter ends at 240"]);
        assert_eq!(
            found("0xFF", "5"),
            ["8:14 info: TPDO1 has the SYNC start value 5, but is not sent cyclically with SYNC"]
        );
    }
}
