use crate::rule::rule;
use crate::{Context, Report, Severity};
use edskit_model::{Entry, KeyName, ModuleSection, Number, SectionKind};

rule! {
    /// A value of a module has no meaning
    ///
    /// ## What it does
    /// Reports a `Count` that is neither a number of sub-indices (`2`) nor `0;` and a number of bits (`0;4`), a
    /// `[MxSubExt...]` without `Count`, and an item of `[ConnectedModules]` that is not the number of a module.
    /// A module that is described, but not counted, is left to MOD001.
    ///
    /// ## Why is this bad
    /// A tool cannot tell which sub-indices the module adds, or which module is plugged in.
    ///
    /// ## Example
    /// ```eds
    /// [M1SubExt6000]
    /// ParameterName=Inputs
    /// DataType=0x0005
    /// Count=2,8
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [M1SubExt6000]
    /// ParameterName=Inputs
    /// DataType=0x0005
    /// Count=2
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 6.3 and 6.4.
    pub(crate) static MODULE_VALUES = {
        code: "MOD002",
        name: "module-values",
        group: Modules,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for section in context.sheet.other_sections() {
        match section.kind() {
            SectionKind::Module(_, ModuleSection::SubExtension(_)) => match section.filled(KeyName::Count) {
                Some(entry) => check_count(entry, report),
                None => {
                    report
                        .add(section.span(), format!("`[{}]` has no `Count`", section.name()))
                        .help("add `Count=1` if each module adds one sub-index");
                }
            },
            SectionKind::ConnectedModules => {
                let supported = context.sheet.supported_modules();
                // A number that cannot be read may be any.
                let count = match supported {
                    None => 0,
                    Some(field) => match field.known() {
                        Some(count) => count,
                        None => continue,
                    },
                };
                for entry in section.all_numbered(KeyName::Item).filter(|entry| !entry.is_empty()) {
                    check_connected(context, entry, count, supported.map(|field| field.entry), report);
                }
            }
            _ => {}
        }
    }
}

fn check_count(entry: Entry<'_>, report: &mut Report) {
    let raw = entry.raw();
    let number = |text: &[u8]| Number::parse(text.trim_ascii()).ok().and_then(Number::to::<u8>);
    let is_understood = match raw.iter().position(|&byte| byte == b';') {
        None => number(raw).is_some(),
        Some(semicolon) => {
            number(&raw[..semicolon]) == Some(0) && number(&raw[semicolon + 1..]).is_some_and(|bits| bits > 0)
        }
    };
    if is_understood || edskit_model::meant::value_length(raw).is_some() {
        return;
    }
    report.add(entry.value_span(), format!("Count is `{}`, which says nothing", entry.text())).help(
        "write the number of sub-indices that a module adds, or `0;` and its bits where modules share one",
    );
}

fn check_connected(
    context: &Context<'_>,
    entry: Entry<'_>,
    count: u16,
    limit: Option<Entry<'_>>,
    report: &mut Report,
) {
    let Some(module) = entry.unsigned::<u16>().known() else { return };
    // Where the module is described, the number of modules is wrong, which is the matter of MOD001.
    let is_described = || context.sheet.section(SectionKind::Module(module, ModuleSection::Info)).is_some();
    if (1..=count).contains(&module) || is_described() {
        return;
    }
    let message = match count {
        0 => format!("module {module} is connected, but no module is supported"),
        _ => format!("module {module} is connected, but the supported modules are 1 to {count}"),
    };
    let finding = report.add(entry.value_span(), message);
    finding.severity(Severity::Error);
    if let Some(limit) = limit {
        finding.label(limit.span(), "the number of supported modules");
    }
    finding.help("write the number x of the module's section `[MxModuleInfo]`");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    fn count(value: &str) -> Vec<String> {
        findings(&MODULE_VALUES, &format!("[M1SubExt6000]\nCount={value}\n"))
    }

    #[test]
    fn counts() {
        for fine in ["2", "0x02", "0;4", "0; 4", "255"] {
            assert!(count(fine).is_empty(), "{fine}");
        }
        assert_eq!(count("2,8"), ["2:7 warning: Count is `2,8`, which says nothing"]);
        for bad in ["1;4", "0;0", "0;", "x", "256"] {
            assert_eq!(count(bad).len(), 1, "{bad}");
        }
        assert_eq!(count(""), ["1:1 warning: `[M1SubExt6000]` has no `Count`"]);
    }

    #[test]
    fn connected_modules_exist() {
        let connected = |supported: &str, items: &str| {
            findings(&MODULE_VALUES, &format!("{supported}[ConnectedModules]\nNrOfEntries=2\n{items}\n"))
        };
        let supported = "[SupportedModules]\nNrOfEntries=2\n";
        assert!(connected(supported, "1=2\n2=0x1\n3=\n4=x").is_empty());
        assert_eq!(
            connected(supported, "1=3\n2=0"),
            [
                "5:3 error: module 3 is connected, but the supported modules are 1 to 2",
                "6:3 error: module 0 is connected, but the supported modules are 1 to 2"
            ]
        );
        assert!(connected("[M1ModuleInfo]\n", "1=1").is_empty(), "MOD001");
        assert_eq!(connected("", "1=1"), ["3:3 error: module 1 is connected, but no module is supported"]);
    }
}
