use crate::rule::rule;
use crate::{Context, Report, Variable};
use edskit_types::AccessType;

rule! {
    /// A mappable object does not say into which PDOs
    ///
    /// ## What it does
    /// Reports `PDOMapping=1` at an object with the access `rw`. Off by default, because most files are written so.
    ///
    /// ## Why is this bad
    /// `rw` leaves both directions open. Written as `rwr` (into TPDOs) or `rww` (into RPDOs), a tool offers the object
    /// only where the device takes it.
    ///
    /// ## Example
    /// ```eds
    /// [2200]
    /// ParameterName=Set point
    /// DataType=0x0006
    /// AccessType=rw
    /// PDOMapping=1
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [2200]
    /// ParameterName=Set point
    /// DataType=0x0006
    /// AccessType=rww
    /// PDOMapping=1
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.6.3.2.
    pub(crate) static MAPPABLE_RW = {
        code: "PDO023",
        name: "mappable-rw",
        group: Pdo,
        severity: Info,
        enabled: false,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("mappable without direction")],
        check: Variable(check),
    }
}

fn check(_: &Context<'_>, variable: &Variable<'_>, report: &mut Report) {
    let Some(flag) = variable.pdo_mapping.filter(|flag| flag.known() == Some(true)) else { return };
    let Some(access) = variable.access_type.filter(|access| access.known() == Some(AccessType::Rw)) else {
        return;
    };
    report
        .add(access.span(), format!("{} can be mapped, but does not say into which PDOs", variable.place()))
        .label(flag.span(), "can be mapped")
        .help("write `rww` if only RPDOs carry it, `rwr` if only TPDOs do");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn only_rw_leaves_the_direction_open() {
        let text = "[2000]\nAccessType=rw\nPDOMapping=1\n[2001]\nAccessType=rwr\nPDOMapping=1\n[2002]\nAccessType=rw\nPDOMapping=0\n[2003sub1]\nAccessType=RW\nPDOMapping=1\n";
        assert_eq!(
            findings(&MAPPABLE_RW, text),
            [
                "2:12 info: 2000h can be mapped, but does not say into which PDOs",
                "11:12 info: 2003h sub-index 01h can be mapped, but does not say into which PDOs"
            ]
        );
    }
}
