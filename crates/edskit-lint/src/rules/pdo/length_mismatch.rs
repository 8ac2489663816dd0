use crate::pdos::{self, Target};
use crate::rule::rule;
use crate::{Context, Edit, Report, Severity};
use edskit_types::{DataType, MappingEntry};

rule! {
    /// A mapping entry has another length than the mapped object
    ///
    /// ## What it does
    /// Compares the length in a mapping entry (its lowest eight bits) with the data type of the object that it names.
    /// Strings and types of the manufacturer have no length to compare with; dummies are the matter of PDO009. A
    /// BOOLEAN mapped with 8 bits is a warning: some device stacks map whole bytes only.
    ///
    /// ## Why is this bad
    /// The device refuses the mapping, or all that follows in the PDO is read from the wrong place.
    ///
    /// ## Example
    /// ```eds
    /// [1A00]
    /// ParameterName=TPDO 1 mapping parameter
    /// ObjectType=0x9
    /// SubNumber=2
    ///
    /// [1A00sub0]
    /// DataType=0x0005
    /// DefaultValue=1
    ///
    /// [1A00sub1]
    /// DataType=0x0007
    /// DefaultValue=0x22000010
    ///
    /// [2200]
    /// ParameterName=Temperature
    /// DataType=0x0002
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1A00]
    /// ParameterName=TPDO 1 mapping parameter
    /// ObjectType=0x9
    /// SubNumber=2
    ///
    /// [1A00sub0]
    /// DataType=0x0005
    /// DefaultValue=1
    ///
    /// [1A00sub1]
    /// DataType=0x0007
    /// DefaultValue=0x22000008
    ///
    /// [2200]
    /// ParameterName=Temperature
    /// DataType=0x0002
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.5.2.36 and 7.5.2.38.
    pub(crate) static LENGTH_MISMATCH = {
        code: "PDO005",
        name: "length-mismatch",
        group: Pdo,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("65"), EdsDcfCheck("PDO003")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for pdo in context.pdos() {
        for mapped in pdo.mapped() {
            let Target::Entry(entry) = mapped.target else { continue };
            let Some(data_type) = entry.data_type() else { continue };
            let Some(bits) = data_type.bits() else { continue };
            if bits == u16::from(mapped.entry.bits()) {
                continue;
            }
            let message = format!(
                "{pdo} maps {} of {}, but {data_type} has {bits}",
                pdos::bits(mapped.entry.bits()),
                pdos::place_of(context.sheet, entry)
            );
            let finding = report.add(mapped.value.span(), message);
            if data_type == DataType::Boolean && mapped.entry.bits() == 8 {
                finding.severity(Severity::Warning);
            }
            finding.here(format!("entry {} of the mapping", mapped.sub_index.0));
            if let Some(section) = pdos::attributes(context.sheet, entry) {
                finding.label(section.span(), format!("this is {data_type}"));
            }
            let right = MappingEntry(mapped.entry.0 & !0xFF | u32::from(bits));
            finding.help(format!("write `0x{:08X}`", right.0)).unsafe_fix(
                format!("Map {}", pdos::bits(bits)),
                vec![Edit::replace(mapped.value.span(), format!("0x{:08X}", right.0))],
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    fn text(entry: &str, object: &str) -> String {
        format!(
            "[1600]\nObjectType=9\n[1600sub0]\nDataType=5\nDefaultValue=1\n[1600sub1]\nDataType=7\nDefaultValue={entry}\n{object}\n"
        )
    }

    #[test]
    fn the_data_type_decides() {
        let array = "[2000]\nObjectType=8\n[2000sub1]\nDataType=5";
        let wrong = text("0x20000110", array);
        assert_eq!(
            findings(&LENGTH_MISMATCH, &wrong),
            ["8:14 error: RPDO1 maps 16 bits of 2000h sub-index 01h, but UNSIGNED8 has 8"]
        );
        assert_eq!(fixed(&LENGTH_MISMATCH, &wrong), text("0x20000108", array));
        for object in ["[2000]\nDataType=6", "[2000]\nDataType=9", "[2000]\nDataType=0x40", "[2000]"] {
            assert!(findings(&LENGTH_MISMATCH, &text("0x20000010", object)).is_empty(), "{object}");
        }
        assert!(findings(&LENGTH_MISMATCH, &text("0x00050010", "")).is_empty());
        assert_eq!(
            findings(&LENGTH_MISMATCH, &text("0x20000008", "[2000]\nDataType=1")),
            ["8:14 warning: RPDO1 maps 8 bits of 2000h, but BOOLEAN has 1"]
        );
    }

    #[test]
    fn compact_elements_have_the_type_of_their_object() {
        let object = "[2000]\nObjectType=8\nDataType=6\nCompactSubObj=3";
        assert!(findings(&LENGTH_MISMATCH, &text("0x20000310", object)).is_empty());
        assert_eq!(findings(&LENGTH_MISMATCH, &text("0x20000308", object)).len(), 1);
    }
}
