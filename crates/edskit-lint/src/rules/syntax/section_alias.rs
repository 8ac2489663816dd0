use super::repeats;
use crate::rule::rule;
use crate::{Context, Report};

rule! {
    /// A section stands twice in two spellings
    ///
    /// ## What it does
    /// Reports sections that name the same thing in another spelling than the one before: a zero more, `0x`, one or two
    /// m in `DeviceComissioning`. Both places are shown.
    ///
    /// ## Why is this bad
    /// Readers that compare numbers see the same sub-object twice; readers that compare names see two, and look only
    /// for one of them. So the same file gives different devices.
    ///
    /// ## Example
    /// ```eds
    /// [1018sub1]
    /// DefaultValue=0x319
    ///
    /// [1018sub01]
    /// DefaultValue=0
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1018sub1]
    /// DefaultValue=0x319
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.2 and 4.6.3.2.
    pub(crate) static SECTION_ALIAS = {
        code: "SYN015",
        name: "section-alias",
        group: Syntax,
        severity: Error,
        since: "0.1.0",
        files: ALL_FILES,
        peers: [CanChkEds("4"), EdsDcfCheck("INI002")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for (first, again) in repeats::of_cia_306(context) {
        if first.name().eq_ignore_ascii_case(&again.name()) {
            continue;
        }
        let finding = report.add(
            again.span(),
            format!("the section `[{}]` is the same as `[{}]`", again.name(), first.name()),
        );
        finding.here("the second one").label(first.span(), "the first one");
        if let Some(name) = again.kind().canonical_name() {
            finding.help(format!("keep one of the two, and call it `[{name}]`"));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn spellings_of_one_section() {
        let text = "[1018sub01]\n[1018sub1]\n[1018SUB01]\n[0x1000]\n[1000]\n[DeviceComissioning]\n\
                    [DeviceCommissioning]\n[1001]\n[1001]\n";
        assert_eq!(
            findings(&SECTION_ALIAS, text),
            [
                "2:1 error: the section `[1018sub1]` is the same as `[1018sub01]`",
                "5:1 error: the section `[1000]` is the same as `[0x1000]`",
                "7:1 error: the section `[DeviceCommissioning]` is the same as `[DeviceComissioning]`",
            ]
        );
    }
}
