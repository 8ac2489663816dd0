use crate::evaluate::Effective;
use crate::rule::rule;
use crate::{Context, Report};
use edskit_types::{DataType, Index, PdoDirection};

rule! {
    /// The old count of PDOs contradicts the device information
    ///
    /// ## What it does
    /// Reports a 1004h whose sub-index 00h gives other numbers of PDOs than `NrOfRXPDO` and `NrOfTXPDO`, or whose sub-index 01h
    /// (synchronous PDOs) or 02h (asynchronous PDOs) gives more. The upper half of each value counts RPDOs, the lower half
    /// TPDOs. A sub-index 00h that is an UNSIGNED8 counts sub-indices, and is left alone.
    ///
    /// ## Why is this bad
    /// 1004h comes from the first editions of CiA 301 and is reserved today. Where a device still has it, masters of that time
    /// take the number of PDOs from it.
    ///
    /// ## Example
    /// ```eds
    /// [DeviceInfo]
    /// NrOfRXPDO=4
    /// NrOfTXPDO=4
    ///
    /// [1004]
    /// ParameterName=Number of PDOs supported
    /// ObjectType=0x8
    /// SubNumber=1
    ///
    /// [1004sub0]
    /// ParameterName=Number of PDOs
    /// DataType=0x0007
    /// DefaultValue=0x00020004
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [DeviceInfo]
    /// NrOfRXPDO=4
    /// NrOfTXPDO=4
    ///
    /// [1004]
    /// ParameterName=Number of PDOs supported
    /// ObjectType=0x8
    /// SubNumber=1
    ///
    /// [1004sub0]
    /// ParameterName=Number of PDOs
    /// DataType=0x0007
    /// DefaultValue=0x00040004
    /// ```
    ///
    /// ## References
    /// CiA 301 v3.0 describes 1004h; CiA 306 v1.3, 4.5 the two entries.
    pub(crate) static PDO_COUNTS_DIFFER = {
        code: "COM019",
        name: "pdo-counts-differ",
        group: Communication,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("71, 72")],
        check: File(check),
    }
}

/// 1004h: number of PDOs supported.
const PDO_COUNTS: Index = Index(0x1004);

/// Sub-index, what it counts, and the direction that each half stands for.
const COUNTS: [(u8, &str); 3] = [(0, "PDOs"), (1, "synchronous PDOs"), (2, "asynchronous PDOs")];

fn check(context: &Context<'_>, report: &mut Report) {
    let Some(object) = context.sheet.object(PDO_COUNTS) else { return };
    let Some(info) = context.sheet.device_info() else { return };
    for (sub_index, what) in COUNTS {
        let Some(entry) = object.dictionary_entry(edskit_types::SubIndex(sub_index)) else { continue };
        if entry.data_type() == Some(DataType::Unsigned8) {
            continue;
        }
        let Some(value) = Effective::of(object, sub_index) else { continue };
        let Some(bits) = value.constant::<u32>() else { continue };
        let halves =
            [(PdoDirection::Receive, "RPDO", bits >> 16), (PdoDirection::Transmit, "TPDO", bits & 0xFFFF)];
        for (direction, noun, count) in halves {
            let Some(stated) = info.pdo_count(direction) else { continue };
            let Some(total) = stated.known().map(u32::from) else { continue };
            if count <= total && (sub_index > 0 || count == total) {
                continue;
            }
            let kind = what.trim_end_matches("PDOs");
            let key = stated.entry.key_text();
            report
                .add(value.span(), format!("1004h counts {count} {kind}{noun}s, but {key} is {total}"))
                .here("the upper half counts RPDOs, the lower half TPDOs")
                .label(stated.span(), "the number of all")
                .help("correct one of the two, or drop 1004h, which is reserved today");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn the_total_is_equal_and_the_parts_are_not_larger() {
        let found = |total: &str, synchronous: &str| {
            let text = format!(
                "[DeviceInfo]\nNrOfRXPDO=2\nNrOfTXPDO=3\n[1004]\nObjectType=8\n[1004sub0]\nDataType=7\nDefaultValue={total}\n[1004sub1]\nDataType=7\nDefaultValue={synchronous}\n"
            );
            findings(&PDO_COUNTS_DIFFER, &text)
        };
        assert!(found("0x00020003", "0x00000003").is_empty());
        assert_eq!(
            found("0x00030002", "0x00020004"),
            [
                "8:14 warning: 1004h counts 3 RPDOs, but NrOfRXPDO is 2",
                "8:14 warning: 1004h counts 2 TPDOs, but NrOfTXPDO is 3",
                "11:14 warning: 1004h counts 4 synchronous TPDOs, but NrOfTXPDO is 3"
            ]
        );
    }

    #[test]
    fn a_number_of_entries_and_a_variable_are_understood() {
        let text = "[DeviceInfo]\nNrOfRXPDO=2\nNrOfTXPDO=3\n[1004]\nObjectType=8\n[1004sub0]\nDataType=5\nDefaultValue=2\n";
        assert!(findings(&PDO_COUNTS_DIFFER, text).is_empty());
        let text = "[DeviceInfo]\nNrOfRXPDO=2\nNrOfTXPDO=3\n[1004]\nDataType=7\nDefaultValue=0x20004\n";
        assert_eq!(findings(&PDO_COUNTS_DIFFER, text).len(), 1);
    }
}
