use crate::pdos::{self, Target};
use crate::rule::rule;
use crate::{Context, Report};
use edskit_types::DataType;

rule! {
    /// A mapped object has a data type that fits no PDO
    ///
    /// ## What it does
    /// Reports a mapping entry that names a DOMAIN or an object of a record type, and one that takes a part of a
    /// string's byte. Whole bytes of strings are left alone: their length may be fixed.
    ///
    /// ## Why is this bad
    /// A PDO has eight bytes, each at its fixed place. A DOMAIN has any size, and a record is mapped member by member.
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
    /// DefaultValue=0x22000020
    ///
    /// [2200]
    /// ParameterName=Recorded curve
    /// ObjectType=0x2
    /// DataType=0x000F
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
    /// DefaultValue=0x22010020
    ///
    /// [2201]
    /// ParameterName=Last point of the curve
    /// ObjectType=0x7
    /// DataType=0x0007
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.5.2.36 and 7.5.2.38.
    pub(crate) static UNMAPPABLE_TYPE = {
        code: "PDO019",
        name: "unmappable-type",
        group: Pdo,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("66")],
        check: File(check),
    }
}

/// Whether nothing of this type fits a PDO.
pub(super) fn fits_no_pdo(data_type: DataType) -> bool {
    !data_type.is_mappable() && !data_type.is_string()
}

fn check(context: &Context<'_>, report: &mut Report) {
    for pdo in context.pdos() {
        for mapped in pdo.mapped() {
            let Target::Entry(entry) = mapped.target else { continue };
            let Some(data_type) = entry.data_type() else { continue };
            let bits = mapped.entry.bits();
            let place = pdos::place_of(context.sheet, entry);
            let (message, help) = if fits_no_pdo(data_type) {
                (
                    format!("{pdo} maps {place}, but a {data_type} fits no PDO"),
                    "map an object of a fixed length",
                )
            } else if data_type.is_string() && (bits == 0 || bits % 8 != 0) {
                (
                    format!("{pdo} maps {} of {place}, a {data_type}", pdos::bits(bits)),
                    "map whole bytes of it",
                )
            } else {
                continue;
            };
            let finding = report.add(mapped.value.span(), message);
            finding.here(format!("entry {} of the mapping", mapped.sub_index.0)).help(help);
            if let Some(section) = pdos::attributes(context.sheet, entry) {
                finding.label(section.span(), format!("this is a {data_type}"));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    fn found(bits: u8, object: &str) -> Vec<String> {
        let text = format!(
            "[1A00]\nObjectType=9\n[1A00sub0]\nDataType=5\nDefaultValue=1\n[1A00sub1]\nDataType=7\nDefaultValue=0x200000{bits:02X}\n[2000]\n{object}\n"
        );
        findings(&UNMAPPABLE_TYPE, &text)
    }

    #[test]
    fn types_without_a_length() {
        assert_eq!(found(32, "ObjectType=2"), ["8:14 error: TPDO1 maps 2000h, but a DOMAIN fits no PDO"]);
        assert_eq!(found(4, "DataType=9"), ["8:14 error: TPDO1 maps 4 bits of 2000h, a VISIBLE_STRING"]);
        assert!(found(64, "DataType=9").is_empty() && found(64, "DataType=0xA").is_empty());
        assert!(found(32, "DataType=7").is_empty() && found(32, "DataType=0x40").is_empty());
    }
}
