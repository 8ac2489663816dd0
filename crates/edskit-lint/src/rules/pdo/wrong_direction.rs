use crate::pdos::{self, Target};
use crate::rule::rule;
use crate::{Context, Report, Severity};
use edskit_model::KeyName;
use edskit_types::{AccessType, PdoDirection};

rule! {
    /// A mapped object cannot be carried in this direction
    ///
    /// ## What it does
    /// Reports an RPDO that maps an object with the access `ro`, `const` or `rwr`, and a TPDO that maps one with `wo`
    /// or `rww`. With `rwr` and `rww` it is a warning: they say what the value is for, and devices differ in how strict
    /// they are.
    ///
    /// ## Why is this bad
    /// An RPDO writes what it maps, a TPDO reads it. The access forbids this, so the mapping is refused or does
    /// nothing.
    ///
    /// ## Example
    /// ```eds
    /// [1600]
    /// ParameterName=RPDO 1 mapping parameter
    /// ObjectType=0x9
    /// SubNumber=2
    ///
    /// [1600sub0]
    /// DataType=0x0005
    /// DefaultValue=1
    ///
    /// [1600sub1]
    /// DataType=0x0007
    /// DefaultValue=0x22000010
    ///
    /// [2200]
    /// ParameterName=Speed actual value
    /// DataType=0x0006
    /// AccessType=ro
    /// PDOMapping=1
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
    /// ParameterName=Speed actual value
    /// DataType=0x0006
    /// AccessType=ro
    /// PDOMapping=1
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.6.3.2; CiA 301 v4.2, 7.5.2.36 and 7.5.2.38.
    pub(crate) static WRONG_DIRECTION = {
        code: "PDO007",
        name: "wrong-direction",
        group: Pdo,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("8"), EdsDcfCheck("PDO002")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for pdo in context.pdos() {
        for mapped in pdo.mapped() {
            let Target::Entry(entry) = mapped.target else { continue };
            let Some(access) = entry.access() else { continue };
            let (is_allowed, does, better) = match pdo.direction {
                PdoDirection::Receive => (access.allows_rpdo(), "writes", "`rww`, `rw` or `wo`"),
                PdoDirection::Transmit => (access.allows_tpdo(), "reads", "`ro`, `rwr` or `rw`"),
            };
            // Whatever cannot be mapped at all is the matter of PDO006.
            if is_allowed || !entry.is_mappable() {
                continue;
            }
            let place = pdos::place_of(context.sheet, entry);
            let message = format!("{pdo} {does} what it maps, but {place} is `{access}`");
            let finding = report.add(mapped.value.span(), message);
            finding.here(format!("entry {} of the mapping", mapped.sub_index.0));
            if matches!(access, AccessType::Rwr | AccessType::Rww) {
                finding.severity(Severity::Warning);
            }
            let section = pdos::attributes(context.sheet, entry);
            if let Some(field) = section.and_then(|section| section.filled(KeyName::AccessType)) {
                finding.label(field.span(), "the access");
            }
            finding
                .help(format!("map another object, or write {better} there if that is what the device does"));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    fn found(mapping: &str, access: &str) -> Vec<String> {
        let text = format!(
            "[{mapping}]\nObjectType=9\n[{mapping}sub0]\nDataType=5\nDefaultValue=1\n[{mapping}sub1]\nDataType=7\nDefaultValue=0x20000010\n\
             [2000]\nDataType=6\nPDOMapping=1\nAccessType={access}\n"
        );
        findings(&WRONG_DIRECTION, &text)
    }

    #[test]
    fn each_access_has_its_directions() {
        for access in ["wo", "rw", "rww", "x", ""] {
            assert!(found("1600", access).is_empty(), "{access}");
        }
        for access in ["ro", "const", "rw", "rwr"] {
            assert!(found("1A00", access).is_empty(), "{access}");
        }
        assert_eq!(found("1600", "rwr"), ["8:14 warning: RPDO1 writes what it maps, but 2000h is `rwr`"]);
        assert_eq!(found("1A00", "wo"), ["8:14 error: TPDO1 reads what it maps, but 2000h is `wo`"]);
        assert_eq!(found("1600", "const").len() + found("1600", "RO").len() + found("1A00", "rww").len(), 3);
    }
}
