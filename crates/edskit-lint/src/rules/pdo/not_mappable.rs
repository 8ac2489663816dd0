use super::unmappable_type::fits_no_pdo;
use crate::pdos::{self, Target};
use crate::rule::rule;
use crate::{Context, Edit, Report, Severity};
use edskit_model::KeyName;

rule! {
    /// A mapped object cannot be mapped
    ///
    /// ## What it does
    /// Reports a mapping entry that names an object with `PDOMapping=0`. Without `PDOMapping`, which means the same,
    /// it is a warning.
    ///
    /// ## Why is this bad
    /// The two contradict each other. A configuration tool refuses its own default mapping, or writes it and the
    /// device answers with abort code 0604 0041h.
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
    /// ParameterName=Speed
    /// DataType=0x0006
    /// PDOMapping=0
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
    /// DefaultValue=0x22000010
    ///
    /// [2200]
    /// ParameterName=Speed
    /// DataType=0x0006
    /// PDOMapping=1
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.6.3.2; CiA 301 v4.2, 7.5.2.36 and 7.5.2.38.
    pub(crate) static NOT_MAPPABLE = {
        code: "PDO006",
        name: "not-mappable",
        group: Pdo,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("35"), EdsDcfCheck("PDO002")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for pdo in context.pdos() {
        for mapped in pdo.mapped() {
            let Target::Entry(entry) = mapped.target else { continue };
            // What fits no PDO is the matter of PDO019, whatever it says.
            if entry.is_mappable() || entry.data_type().is_some_and(fits_no_pdo) {
                continue;
            }
            let Some(section) = pdos::attributes(context.sheet, entry) else { continue };
            let is_count = entry.description().is_none() && entry.sub_index.0 == 0;
            let flag = section.filled(KeyName::PdoMapping).filter(|_| !is_count);
            // What is neither 0 nor 1 is the matter of OBJ022.
            if flag.is_some_and(|flag| flag.flag().known().is_none()) {
                continue;
            }
            let place = pdos::place_of(context.sheet, entry);
            let finding =
                report.add(mapped.value.span(), format!("{pdo} maps {place}, which cannot be mapped"));
            finding.here(format!("entry {} of the mapping", mapped.sub_index.0));
            match flag {
                Some(flag) => finding
                    .label(flag.span(), "says that it cannot be mapped")
                    .help("write `PDOMapping=1` there if the device can map it, or map another object")
                    .unsafe_fix("Make it mappable", vec![Edit::replace(flag.value_span(), "1")]),
                None if is_count => finding
                    .label(section.span(), "sub-index 00h of compact storage")
                    .help("map another object"),
                None => finding
                    .severity(Severity::Warning)
                    .label(section.span(), "has no `PDOMapping`, which means 0")
                    .help("add `PDOMapping=1` there if the device can map it, or map another object"),
            };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    fn text(object: &str) -> String {
        format!(
            "[1600]\nObjectType=9\n[1600sub0]\nDataType=5\nDefaultValue=1\n[1600sub1]\nDataType=7\nDefaultValue=0x20000010\n[2000]\nDataType=6\n{object}\n"
        )
    }

    #[test]
    fn a_missing_flag_is_0() {
        assert_eq!(
            findings(&NOT_MAPPABLE, &text("PDOMapping=0")),
            ["8:14 error: RPDO1 maps 2000h, which cannot be mapped"]
        );
        let expected = ["8:14 warning: RPDO1 maps 2000h, which cannot be mapped"];
        assert_eq!(findings(&NOT_MAPPABLE, &text("")), expected);
        assert_eq!(findings(&NOT_MAPPABLE, &text("PDOMapping=")), expected);
        assert!(findings(&NOT_MAPPABLE, &text("PDOMapping=1")).is_empty());
        assert!(findings(&NOT_MAPPABLE, &text("PDOMapping=yes")).is_empty());
        assert_eq!(fixed(&NOT_MAPPABLE, &text("PDOMapping=0x0")), text("PDOMapping=1"));
    }
}
