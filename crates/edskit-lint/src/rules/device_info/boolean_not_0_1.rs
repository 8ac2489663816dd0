use crate::rule::rule;
use crate::{Context, Edit, Report};
use edskit_model::meant::value_length;
use edskit_model::{Entry, Key, Section, SectionKind, Shape};
use std::collections::HashMap;

rule! {
    /// A flag is neither 0 nor 1
    ///
    /// ## What it does
    /// Reports a flag of `[DeviceInfo]`, `[DummyUsage]` or `[DeviceComissioning]` with another value than `0` or `1`.
    ///
    /// ## Why is this bad
    /// Flags are numbers. Readers that expect one refuse `yes`, and take `2` for true, false or an error.
    ///
    /// ## Example
    /// ```eds
    /// [DeviceInfo]
    /// LSS_Supported=yes
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [DeviceInfo]
    /// LSS_Supported=1
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.3.
    pub(crate) static BOOLEAN_NOT_0_1 = {
        code: "DEV003",
        name: "boolean-not-0-1",
        group: DeviceInfo,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("29"), EdsDcfCheck("MND003"), Dcfchk("invalid value for")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for kind in [SectionKind::DeviceInfo, SectionKind::DummyUsage, SectionKind::DeviceCommissioning] {
        if let Some(section) = context.sheet.section(kind) {
            check_section(section, report);
        }
    }
}

fn check_section(section: Section<'_>, report: &mut Report) {
    let is_bad = |entry: &Entry<'_>| {
        entry.key().name.shape() == Shape::Flag && !entry.is_empty() && entry.flag().value.is_err()
    };
    let mut bad = section.entries().filter(is_bad).peekable();
    if bad.peek().is_none() {
        return;
    }
    // Of a key that stands twice the first one counts.
    let mut firsts: HashMap<Key, u32> = HashMap::new();
    for entry in section.entries() {
        firsts.entry(entry.key()).or_insert(entry.id());
    }
    for entry in bad.filter(|entry| firsts[&entry.key()] == entry.id()) {
        if value_length(entry.raw()).is_none() {
            report_flag(entry, report);
        }
    }
}

fn report_flag(entry: Entry<'_>, report: &mut Report) {
    let (key, text) = (entry.key_text(), entry.text());
    let finding = report.add(entry.value_span(), format!("{key} is `{text}`, but a flag is 0 or 1"));
    let Some(meant) = entry.flag().known().map(|flag| u8::from(flag).to_string()) else {
        finding.help(format!("write `{key}=1` for yes or `{key}=0` for no"));
        return;
    };
    finding
        .help(format!("write `{key}={meant}`"))
        .unsafe_fix(format!("Write {meant}"), vec![Edit::replace(entry.value_span(), meant)]);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, findings_in, fixed};

    #[test]
    fn words_have_a_meaning_and_numbers_have_none() {
        let text = "[DeviceInfo]\nGroupMessaging=TRUE\nBaudRate_10=2\nBaudRate_20=0x01\nGranularity=2\n[DummyUsage]\nDummy0005=off\n";
        assert_eq!(
            findings(&BOOLEAN_NOT_0_1, text),
            [
                "2:16 warning: GroupMessaging is `TRUE`, but a flag is 0 or 1",
                "3:13 warning: BaudRate_10 is `2`, but a flag is 0 or 1",
                "7:11 warning: Dummy0005 is `off`, but a flag is 0 or 1"
            ]
        );
        assert_eq!(fixed(&BOOLEAN_NOT_0_1, text), text.replace("TRUE", "1").replace("off", "0"));
    }

    #[test]
    fn only_the_first_of_two_counts() {
        let text = "[DeviceInfo]\nBaudRate_10=1\nBaudRate_10=2\nBaudRate_20=\nBaudRate_50=1 ; yes\n";
        assert!(findings(&BOOLEAN_NOT_0_1, text).is_empty());
        let text = b"[DeviceComissioning]\nCANopenManager=yes\n[DeviceInfo]\n[DeviceInfo]\nBaudRate_10=2\n";
        assert_eq!(
            findings_in(&BOOLEAN_NOT_0_1, "a.dcf", text),
            ["2:16 warning: CANopenManager is `yes`, but a flag is 0 or 1"]
        );
    }
}
