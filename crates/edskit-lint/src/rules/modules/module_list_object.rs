use crate::rule::rule;
use crate::{Context, Report};
use edskit_model::SectionKind;
use edskit_types::Index;

rule! {
    /// 1027h and `[SupportedModules]` contradict each other
    ///
    /// ## What it does
    /// Reports a device with modules that does not describe 1027h, and a device with 1027h, but without a section
    /// `[SupportedModules]`.
    ///
    /// ## Why is this bad
    /// 1027h tells a master which modules are plugged in. A modular device without it cannot be checked against its
    /// configuration; 1027h without modules tells nothing.
    ///
    /// ## Example
    /// ```eds
    /// [1027]
    /// ParameterName=Module list
    /// ObjectType=0x8
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1027]
    /// ParameterName=Module list
    /// ObjectType=0x8
    ///
    /// [SupportedModules]
    /// NrOfEntries=1
    ///
    /// [M1ModuleInfo]
    /// ProductName=Digital inputs
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.5.2.30; CiA 306 v1.3, 6.2.1.
    pub(crate) static MODULE_LIST_OBJECT = {
        code: "MOD009",
        name: "module-list-object",
        group: Modules,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("51-55")],
        check: File(check),
    }
}

/// Module list.
const MODULE_LIST: Index = Index(0x1027);

fn check(context: &Context<'_>, report: &mut Report) {
    let supported = context.sheet.section(SectionKind::SupportedModules);
    match (context.sheet.object(MODULE_LIST), supported) {
        (Some(object), None) => {
            report
                .add(
                    object.span(),
                    "the device has a module list, 1027h, but no section `[SupportedModules]`",
                )
                .help("describe the modules, or take 1027h out");
        }
        // Only a number that is surely 0 says that there are no modules.
        (None, Some(section))
            if context.sheet.supported_modules().and_then(|field| field.known()) != Some(0) =>
        {
            report
                .add(section.span(), "the device has modules, but no module list 1027h")
                .help("describe 1027h, an ARRAY of UNSIGNED16 with an element for each place of a module");
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn both_or_none() {
        assert!(findings(&MODULE_LIST_OBJECT, "[1000]\n").is_empty());
        assert!(findings(&MODULE_LIST_OBJECT, "[1027]\n[SupportedModules]\nNrOfEntries=1\n").is_empty());
        assert!(findings(&MODULE_LIST_OBJECT, "[SupportedModules]\nNrOfEntries=0\n").is_empty());
        assert_eq!(
            findings(&MODULE_LIST_OBJECT, "[SupportedModules]\nNrOfEntries=1\n"),
            ["1:1 warning: the device has modules, but no module list 1027h"]
        );
        assert_eq!(
            findings(&MODULE_LIST_OBJECT, "[1027]\n"),
            ["1:1 warning: the device has a module list, 1027h, but no section `[SupportedModules]`"]
        );
    }
}
