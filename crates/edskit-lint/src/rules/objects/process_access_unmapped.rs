use crate::rule::rule;
use crate::{Context, Edit, Report, Variable};
use edskit_types::AccessType;

rule! {
    /// Process data access without mapping
    ///
    /// ## What it does
    /// Reports the access types `rwr` and `rww` where `PDOMapping` is 0 or missing.
    ///
    /// ## Why is this bad
    /// `rwr` and `rww` are `rw` with a direction for PDOs. Where the object cannot be mapped, the direction means
    /// nothing, and either the access or `PDOMapping` is wrong.
    ///
    /// ## Example
    /// ```eds
    /// [2010]
    /// ParameterName=Ramp time
    /// DataType=0x0006
    /// AccessType=rww
    /// PDOMapping=0
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [2010]
    /// ParameterName=Ramp time
    /// DataType=0x0006
    /// AccessType=rw
    /// PDOMapping=0
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.6.3.2.
    pub(crate) static PROCESS_ACCESS_UNMAPPED = {
        code: "OBJ024",
        name: "process-access-unmapped",
        group: Objects,
        severity: Info,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: Variable(check),
    }
}

fn check(_: &Context<'_>, variable: &Variable<'_>, report: &mut Report) {
    let Some(field) = variable.access_type else { return };
    let Some(access @ (AccessType::Rwr | AccessType::Rww)) = field.known() else { return };
    if variable.pdo_mapping.is_some_and(|mapping| mapping.known() != Some(false)) {
        return;
    }
    // At the section of an ARRAY or RECORD the access itself is out of place (OBJ006).
    if !variable.holds_value() && variable.description.compact_sub_obj().is_none() {
        return;
    }
    let finding =
        report.add(field.span(), format!("{} is `{access}`, but cannot be mapped", variable.place()));
    if let Some(mapping) = variable.pdo_mapping {
        finding.label(mapping.span(), "not mappable");
    }
    finding
        .help("write `AccessType=rw`, or `PDOMapping=1` if PDOs may carry it")
        .unsafe_fix("Write `rw`", vec![Edit::replace(field.span(), "rw")]);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn only_where_mapping_is_surely_off() {
        let text = "[2000]\nAccessType=rwr\n[2001]\nAccessType=rww\nPDOMapping=1\n[2002]\nAccessType=rww\nPDOMapping=x\n[2003]\nAccessType=rw\n\
                    [2004]\nObjectType=8\nAccessType=rww\n[2004sub1]\nAccessType=RWW\nPDOMapping=0\n";
        assert_eq!(
            findings(&PROCESS_ACCESS_UNMAPPED, text),
            [
                "2:12 info: 2000h is `rwr`, but cannot be mapped",
                "15:12 info: 2004h sub-index 01h is `rww`, but cannot be mapped"
            ]
        );
        assert_eq!(fixed(&PROCESS_ACCESS_UNMAPPED, "[2000]\nAccessType=rwr\n"), "[2000]\nAccessType=rw\n");
    }
}
