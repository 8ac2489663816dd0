use super::parts::count_entry;
use crate::rule::rule;
use crate::{Context, Edit, Report, Severity};
use edskit_model::{Section, SectionKind};
use std::collections::BTreeMap;

rule! {
    /// The number of modules differs from the modules that are described
    ///
    /// ## What it does
    /// Compares `NrOfEntries` of `[SupportedModules]` with the sections `[M1ModuleInfo]`, `[M2ModuleInfo]` and so on.
    /// A module that is counted must be described, one that is described must be counted, and other sections of a
    /// module need its `[MxModuleInfo]`.
    ///
    /// ## Why is this bad
    /// A configuration tool offers the modules by their numbers. One that is missing cannot be chosen, one that is not
    /// counted is never read.
    ///
    /// ## Example
    /// ```eds
    /// [SupportedModules]
    /// NrOfEntries=2
    ///
    /// [M1ModuleInfo]
    /// ProductName=Digital inputs
    /// ProductVersion=1
    /// ProductRevision=0
    /// OrderCode=DI8
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [SupportedModules]
    /// NrOfEntries=1
    ///
    /// [M1ModuleInfo]
    /// ProductName=Digital inputs
    /// ProductVersion=1
    /// ProductRevision=0
    /// OrderCode=DI8
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 6.2.1 and 6.3.
    pub(crate) static MODULE_SECTION_MISSING = {
        code: "MOD001",
        name: "module-section-missing",
        group: Modules,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("51-55")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    // The first section of each module.
    let mut modules: BTreeMap<u16, Section<'_>> = BTreeMap::new();
    for section in context.sheet.other_sections() {
        if let SectionKind::Module(number, _) = section.kind() {
            modules.entry(number).or_insert(section);
        }
    }
    let supported = context.sheet.section(SectionKind::SupportedModules);
    let Some(supported) = supported else {
        if let Some((number, section)) = modules.first_key_value() {
            report
                .add(
                    section.span(),
                    format!("module {number} is described, but there is no section `[SupportedModules]`"),
                )
                .help(format!(
                    "add `[SupportedModules]` with `NrOfEntries={}`",
                    context.sheet.modules().count()
                ));
        }
        return;
    };
    for (number, section) in &modules {
        if context.sheet.module(*number).is_none() {
            report
                .add(
                    section.span(),
                    format!(
                        "module {number} has a section `[{}]`, but no `[M{number}ModuleInfo]`",
                        section.name()
                    ),
                )
                .help(format!("add `[M{number}ModuleInfo]`"));
        }
    }
    let Some(entry) = count_entry(supported) else {
        report
            .add(supported.span(), "`[SupportedModules]` does not say how many modules there are")
            .severity(Severity::Warning)
            .help(format!("add `NrOfEntries={}`", context.sheet.modules().count()));
        return;
    };
    let Some(count) = entry.unsigned::<u16>().known() else { return };
    let inside = modules.range(1..).filter(|(number, _)| **number <= count).count();
    let missing = usize::from(count) - inside;
    if missing > 0 {
        let first = (1..=count).find(|number| !modules.contains_key(number)).unwrap_or(count);
        let more = match missing {
            1 => String::new(),
            2 => ", nor of another module".to_owned(),
            _ => format!(", nor of {} other modules", missing - 1),
        };
        let message = format!("NrOfEntries is {count}, but there is no section `[M{first}ModuleInfo]`{more}");
        let described = context.sheet.modules().count();
        let finding = report.add(entry.value_span(), message);
        finding.help(format!("write `NrOfEntries={described}`, or describe the modules"));
        // Only where those that are described have the lowest numbers.
        if inside == described {
            finding.unsafe_fix(
                format!("Write {described}"),
                vec![Edit::replace(entry.value_span(), described.to_string())],
            );
        }
    }
    for (number, section) in modules.iter().filter(|(number, _)| **number == 0 || **number > count) {
        if context.sheet.module(*number).is_none() {
            continue;
        }
        let message = if *number == 0 {
            "module 0 is described, but modules are counted from 1".to_owned()
        } else {
            format!("module {number} is described, but NrOfEntries is {count}")
        };
        report.add(section.span(), message).label(entry.span(), "the number of modules").help(format!(
            "write `NrOfEntries={}`, and number the modules from 1",
            context.sheet.modules().count()
        ));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    fn found(text: &str) -> Vec<String> {
        findings(&MODULE_SECTION_MISSING, text)
    }

    #[test]
    fn every_module_is_counted_and_described() {
        assert!(found("[SupportedModules]\nNrOfEntries=2\n[M1ModuleInfo]\n[M2ModuleInfo]\n").is_empty());
        assert!(found("[SupportedModules]\nNrOfEntries=0\n").is_empty());
        assert_eq!(
            found("[SupportedModules]\nNrOfEntries=4\n[M1ModuleInfo]\n[M3ModuleInfo]\n"),
            ["2:13 error: NrOfEntries is 4, but there is no section `[M2ModuleInfo]`, nor of another module"]
        );
        assert_eq!(
            found("[SupportedModules]\nNrOfEntries=1\n[M1ModuleInfo]\n[M2ModuleInfo]\n"),
            ["4:1 error: module 2 is described, but NrOfEntries is 1"]
        );
        assert_eq!(
            found("[SupportedModules]\nNrOfEntries=1\n[M1Comments]\n"),
            ["3:1 error: module 1 has a section `[M1Comments]`, but no `[M1ModuleInfo]`"]
        );
        assert_eq!(
            found("[M1ModuleInfo]\n"),
            ["1:1 error: module 1 is described, but there is no section `[SupportedModules]`"]
        );
        assert_eq!(
            found("[SupportedModules]\n[M1ModuleInfo]\n"),
            ["1:1 warning: `[SupportedModules]` does not say how many modules there are"]
        );
        assert_eq!(
            fixed(&MODULE_SECTION_MISSING, "[SupportedModules]\nNrOfEntries=3\n[M1ModuleInfo]\n"),
            "[SupportedModules]\nNrOfEntries=1\n[M1ModuleInfo]\n"
        );
    }
}
