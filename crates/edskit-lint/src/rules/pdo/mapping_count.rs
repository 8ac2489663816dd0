use crate::pdos::MOST_ENTRIES;
use crate::rule::rule;
use crate::{Context, Report};

rule! {
    /// The number of mapped entries is not valid
    ///
    /// ## What it does
    /// Reports a sub-index 00h of a mapping parameter other than 0 to 64, 254 (scanned multiplexed PDO) and 255
    /// (addressed multiplexed PDO).
    ///
    /// ## Why is this bad
    /// A PDO has 64 bits, so no more than 64 entries fit. The device refuses such a value, and readers disagree about
    /// what is mapped.
    ///
    /// ## Example
    /// ```eds
    /// [1A00]
    /// ParameterName=TPDO 1 mapping parameter
    /// ObjectType=0x9
    /// SubNumber=1
    ///
    /// [1A00sub0]
    /// ParameterName=Number of mapped entries
    /// DataType=0x0005
    /// AccessType=rw
    /// DefaultValue=100
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1A00]
    /// ParameterName=TPDO 1 mapping parameter
    /// ObjectType=0x9
    /// SubNumber=1
    ///
    /// [1A00sub0]
    /// ParameterName=Number of mapped entries
    /// DataType=0x0005
    /// AccessType=rw
    /// DefaultValue=0
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.5.2.36 and 7.5.2.38.
    pub(crate) static MAPPING_COUNT = {
        code: "PDO002",
        name: "mapping-count",
        group: Pdo,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for pdo in context.pdos() {
        let Some(value) = pdo.count else { continue };
        let Some(count) = value.constant::<u8>() else { continue };
        if count <= MOST_ENTRIES || matches!(count, 254 | 255) {
            continue;
        }
        report
            .add(value.span(), format!("{pdo} maps {count} entries, but a PDO has at most {MOST_ENTRIES}"))
            .help("write how many of the entries below are mapped, or 254 or 255 for a multiplexed PDO");
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    fn found(value: &str) -> Vec<String> {
        findings(&MAPPING_COUNT, &format!("[1600]\nObjectType=9\n[1600sub0]\nDataType=5\n{value}\n"))
    }

    #[test]
    fn numbers_of_entries() {
        for value in ["0", "64", "254", "0xFF", "", "x", "300"] {
            assert!(found(&format!("DefaultValue={value}")).is_empty(), "{value}");
        }
        assert_eq!(
            found("DefaultValue=0\nParameterValue=65"),
            ["6:16 error: RPDO1 maps 65 entries, but a PDO has at most 64"]
        );
    }
}
