use super::elements;
use crate::rule::rule;
use crate::{Context, Edit, Report, Variable};
use edskit_model::{Field, SubObject};

rule! {
    /// An object can be mapped although its profile excludes that
    ///
    /// ## What it does
    /// Reports `PDOMapping=1` at an object that CiA 301, the device profile named by 1000h, or a profile given with `--profile`
    /// excludes from PDOs. In CiA 301 these are all objects but 1001h, 1002h, 1013h and a few others.
    ///
    /// ## Why is this bad
    /// A tool offers to map, say, a COB-ID into a PDO. The device refuses it (abort code 0604 0041h), or sets up its own
    /// communication by process data.
    ///
    /// ## Example
    /// ```eds
    /// [1017]
    /// ParameterName=Producer heartbeat time
    /// DataType=0x0006
    /// AccessType=rw
    /// PDOMapping=1
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1017]
    /// ParameterName=Producer heartbeat time
    /// DataType=0x0006
    /// AccessType=rw
    /// PDOMapping=0
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.5.2; the device profiles.
    pub(crate) static MAPPABLE_BY_MISTAKE = {
        code: "COM020",
        name: "mappable-by-mistake",
        group: Communication,
        severity: Info,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: Variable(check),
    }
}

fn check(context: &Context<'_>, variable: &Variable<'_>, report: &mut Report) {
    if variable.prescriptions.is_empty() {
        return;
    }
    let Some(field) = variable.pdo_mapping.filter(|field| field.known() == Some(true)) else { return };
    let Some(prescribed) =
        variable.prescribed().find(|prescribed| prescribed.attributes.mappable == Some(false))
    else {
        return;
    };
    let is_wrong_too = |sub: SubObject<'_>| sub.pdo_mapping().and_then(Field::known) == Some(true);
    let Some(further) = elements::further(context, variable, prescribed, is_wrong_too) else { return };
    let mut spans: Vec<_> =
        further.iter().filter_map(|sub| sub.pdo_mapping()).map(|field| field.span()).collect();
    spans.push(field.span());
    spans.sort_unstable();
    let message = format!(
        "{} ({}) can be mapped into a PDO, which {} excludes{}",
        variable.place(),
        prescribed.name,
        prescribed.profile.name,
        elements::like(&further)
    );
    report
        .add(field.span(), message)
        .help("write `PDOMapping=0`")
        .unsafe_fix("Write 0", spans.into_iter().map(|span| Edit::replace(span, "0")).collect());
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn most_of_the_communication_profile_is_not_mappable() {
        let text = "[1001]\nPDOMapping=1\n[1013]\nPDOMapping=1\n[1200]\nObjectType=9\n[1200sub1]\nPDOMapping=1\n[1200sub2]\nPDOMapping=0\n[2000]\nPDOMapping=1\n";
        assert_eq!(
            findings(&MAPPABLE_BY_MISTAKE, text),
            [
                "8:12 info: 1200h sub-index 01h (COB-ID client to server) can be mapped into a PDO, which CiA 301 excludes"
            ]
        );
    }

    #[test]
    fn elements_get_one_finding() {
        let text = "[1003]\nObjectType=8\n[1003sub1]\nPDOMapping=1\n[1003sub2]\nPDOMapping=0x1\n";
        assert_eq!(
            findings(&MAPPABLE_BY_MISTAKE, text),
            [
                "4:12 info: 1003h sub-index 01h (pre-defined error field) can be mapped into a PDO, which CiA 301 excludes (like one further sub-index)"
            ]
        );
        assert_eq!(
            fixed(&MAPPABLE_BY_MISTAKE, text),
            "[1003]\nObjectType=8\n[1003sub1]\nPDOMapping=0\n[1003sub2]\nPDOMapping=0\n"
        );
    }
}
