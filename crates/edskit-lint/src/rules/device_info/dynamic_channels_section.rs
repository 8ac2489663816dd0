use crate::rule::rule;
use crate::{Context, Edit, Report, Severity};
use edskit_model::SectionKind;

rule! {
    /// DynamicChannelsSupported and the section `[DynamicChannels]` contradict each other
    ///
    /// ## What it does
    /// Reports a `DynamicChannelsSupported` other than 0 in a file without `[DynamicChannels]`. The other way round, a
    /// section with segments that a 0 switches off, is a warning.
    ///
    /// ## Why is this bad
    /// The entry announces network variables, and the section says which indices they may have. A programming system
    /// finds none, or never looks at those that are there.
    ///
    /// ## Example
    /// ```eds
    /// [DeviceInfo]
    /// DynamicChannelsSupported=1
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [DeviceInfo]
    /// DynamicChannelsSupported=1
    ///
    /// [DynamicChannels]
    /// NrOfSeg=1
    /// Type1=0x0005
    /// Dir1=rww
    /// Range1=0xA040-0xA07F
    /// PPOffset1=0
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.5; CiA 306-3 v1.2, 5.2.
    pub(crate) static DYNAMIC_CHANNELS_SECTION = {
        code: "DEV012",
        name: "dynamic-channels-section",
        group: DeviceInfo,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("DynamicChannels unsupported")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let claimed = context.sheet.device_info().and_then(|info| info.dynamic_channels_supported());
    let Some((field, claimed)) = claimed.and_then(|field| Some((field, field.known()?))) else { return };
    match (claimed, context.sheet.section(SectionKind::DynamicChannels)) {
        (0, Some(section)) if context.sheet.dynamic_channels().next().is_some() => {
            report
                .add(
                    field.span(),
                    "DynamicChannelsSupported is 0, but there is a section `[DynamicChannels]`",
                )
                .severity(Severity::Warning)
                .label(section.span(), "readers skip this section")
                .help("write `DynamicChannelsSupported=1`, or take the section out");
        }
        (1.., None) => {
            let message =
                format!("DynamicChannelsSupported is {claimed}, but there is no section `[DynamicChannels]`");
            report
                .add(field.span(), message)
                .help("write `DynamicChannelsSupported=0`, or add the section")
                .unsafe_fix("Write 0", vec![Edit::replace(field.span(), "0")]);
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn both_or_none() {
        let with = |value: &str| {
            format!("[DeviceInfo]\nDynamicChannelsSupported={value}\n[DynamicChannels]\nNrOfSeg=1\n")
        };
        let without = |value: &str| format!("[DeviceInfo]\nDynamicChannelsSupported={value}\n");
        assert!(findings(&DYNAMIC_CHANNELS_SECTION, &with("0x1")).is_empty());
        assert!(findings(&DYNAMIC_CHANNELS_SECTION, &with("")).is_empty());
        assert!(findings(&DYNAMIC_CHANNELS_SECTION, &with("0").replace("Seg=1", "Seg=0")).is_empty());
        assert!(findings(&DYNAMIC_CHANNELS_SECTION, &without("0")).is_empty());
        assert_eq!(
            findings(&DYNAMIC_CHANNELS_SECTION, &with("0")),
            ["2:26 warning: DynamicChannelsSupported is 0, but there is a section `[DynamicChannels]`"]
        );
        assert_eq!(fixed(&DYNAMIC_CHANNELS_SECTION, &without("2")), without("0"));
    }
}
