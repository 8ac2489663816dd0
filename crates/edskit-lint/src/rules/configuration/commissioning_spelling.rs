use crate::rule::rule;
use crate::{Context, Edit, Report};

rule! {
    /// `[DeviceComissioning]` is written with two m
    ///
    /// ## What it does
    /// Reports the section `[DeviceCommissioning]`.
    ///
    /// ## Why is this bad
    /// The standard writes the name with one m, and has never changed it. A reader that goes by the standard does not
    /// find the section, so the device has neither node-ID nor bit rate.
    ///
    /// ## Example
    /// ```dcf
    /// [DeviceCommissioning]
    /// NodeID=5
    /// ```
    ///
    /// ## Use instead
    /// ```dcf
    /// [DeviceComissioning]
    /// NodeID=5
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 5; CiA 306-1 v1.4, 7.3.5.
    pub(crate) static COMMISSIONING_SPELLING = {
        code: "DCF002",
        name: "commissioning-spelling",
        group: Configuration,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: File(check),
    }
}

/// The one spelling that counts.
const SPELLING: &str = "DeviceComissioning";

fn check(context: &Context<'_>, report: &mut Report) {
    let Some(section) = context.sheet.commissioning() else { return };
    let name = section.name();
    if !section.kind().is_alternative_spelling(name.as_bytes()) {
        return;
    }
    report
        .add(section.name_span(), format!("`[{name}]` is written `[{SPELLING}]`, with one m"))
        .help(format!("write `[{SPELLING}]`"))
        .safe_fix("Write it with one m", vec![Edit::replace(section.name_span(), SPELLING)]);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn case_does_not_matter() {
        assert!(findings(&COMMISSIONING_SPELLING, "[devicecomissioning]\n").is_empty());
        assert_eq!(
            findings(&COMMISSIONING_SPELLING, "[ DEVICECOMMISSIONING ]\n"),
            ["1:3 error: `[DEVICECOMMISSIONING]` is written `[DeviceComissioning]`, with one m"]
        );
        assert_eq!(fixed(&COMMISSIONING_SPELLING, "[DeviceCommissioning]\n"), "[DeviceComissioning]\n");
    }
}
