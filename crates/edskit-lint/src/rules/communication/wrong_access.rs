use super::elements::{self, like, rewrite};
use crate::profile::alternatives;
use crate::rule::rule;
use crate::{Context, Report, Variable};
use edskit_model::SubObject;
use edskit_types::Index;

rule! {
    /// An object has other rights than its profile prescribes
    ///
    /// ## What it does
    /// Reports an access type that differs from what CiA 301, the device profile named by 1000h, or a profile given
    /// with `--profile` prescribes. `const` counts as `ro`, and `rwr` and `rww` count as `rw`: an SDO client can do the
    /// same with them. 1003h is left to COM004.
    ///
    /// ## Why is this bad
    /// A tool offers to write what the device must not let anybody write, or does not offer what the network needs to
    /// be set.
    ///
    /// ## Example
    /// ```eds
    /// [1000]
    /// ParameterName=Device type
    /// ObjectType=0x7
    /// DataType=0x0007
    /// AccessType=rw
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1000]
    /// ParameterName=Device type
    /// ObjectType=0x7
    /// DataType=0x0007
    /// AccessType=ro
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.5.2; the device profiles.
    pub(crate) static WRONG_ACCESS = {
        code: "COM003",
        name: "wrong-access",
        group: Communication,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("30")],
        check: Variable(check),
    }
}

fn check(context: &Context<'_>, variable: &Variable<'_>, report: &mut Report) {
    if variable.prescriptions.is_empty() || variable.index == Index::PREDEFINED_ERROR_FIELD {
        return;
    }
    let Some(field) = variable.access_type else { return };
    let Some(access) = field.known() else { return };
    for prescribed in variable.prescribed() {
        if prescribed.attributes.allows(access) {
            continue;
        }
        let allowed = &prescribed.attributes.access;
        let is_wrong_too = |sub: SubObject<'_>| sub.access() == Some(access);
        let Some(further) = elements::further(context, variable, prescribed, is_wrong_too) else { return };
        let message = format!(
            "{} ({}) is `{access}`, but {} prescribes {}{}",
            variable.place(),
            prescribed.name,
            prescribed.profile.name,
            alternatives(allowed.iter().map(|access| format!("`{access}`"))),
            like(&further)
        );
        report
            .add(field.span(), message)
            .help(format!("write `AccessType={}`", allowed[0]))
            .unsafe_fix(format!("Make it {}", allowed[0]), rewrite(field, &further, allowed[0]));
        return;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn rights_are_compared() {
        let text = "[1000]\nAccessType=const\n[1008]\nAccessType=rw\n[1010]\nObjectType=8\n[1010sub0]\nAccessType=RW\n[1010sub1]\nAccessType=ro\n[1014]\nAccessType=ro\n[1017]\nAccessType=wo\n[1024]\nAccessType=rw\n[1A00]\nObjectType=9\n[1A00sub0]\nAccessType=rw\n";
        assert_eq!(
            findings(&WRONG_ACCESS, text),
            [
                "4:12 warning: 1008h (manufacturer device name) is `rw`, but CiA 301 prescribes `const`",
                "8:12 warning: 1010h sub-index 00h (highest sub-index) is `rw`, but CiA 301 prescribes `ro`",
                "10:12 warning: 1010h sub-index 01h (save all parameters) is `ro`, but CiA 301 prescribes `rw`",
                "14:12 warning: 1017h (producer heartbeat time) is `wo`, but CiA 301 prescribes `rw` or `ro`",
                "16:12 warning: 1024h (OS command mode) is `rw`, but CiA 301 prescribes `wo`"
            ]
        );
        assert_eq!(fixed(&WRONG_ACCESS, "[1024]\nAccessType=rw\n"), "[1024]\nAccessType=wo\n");
    }

    #[test]
    fn elements_that_are_wrong_alike_are_mended_together() {
        let text = "[1010]\nObjectType=8\n[1010sub2]\nAccessType=ro\n[1010sub1]\nAccessType=ro\n[1010sub0]\nAccessType=ro\n";
        assert_eq!(
            findings(&WRONG_ACCESS, text),
            [
                "6:12 warning: 1010h sub-index 01h (save all parameters) is `ro`, but CiA 301 prescribes `rw` (like one further sub-index)"
            ]
        );
        assert_eq!(
            fixed(&WRONG_ACCESS, text),
            "[1010]\nObjectType=8\n[1010sub2]\nAccessType=rw\n[1010sub1]\nAccessType=rw\n[1010sub0]\nAccessType=ro\n"
        );
    }

    #[test]
    fn sub_objects_of_what_should_be_a_variable_are_not_compared() {
        assert!(findings(&WRONG_ACCESS, "[1017]\nObjectType=8\n[1017sub1]\nAccessType=wo\n").is_empty());
        assert!(findings(&WRONG_ACCESS, "[1018]\nObjectType=7\nAccessType=rw\n").is_empty());
    }
}
