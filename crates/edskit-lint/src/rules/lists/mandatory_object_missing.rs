use crate::listing::{List, MANDATORY};
use crate::rule::rule;
use crate::rules::syntax::lost_header;
use crate::wording::series;
use crate::{Context, Report, Severity};
use edskit_model::SectionKind;
use edskit_types::Index;

rule! {
    /// An object that every device has is missing
    ///
    /// ## What it does
    /// Reports which of 1000h (device type), 1001h (error register) and 1018h (identity) are neither described nor
    /// listed, all in one finding. In a file of edition 3 a missing 1018h alone is a warning. A file without any list
    /// is a fragment, which LST001 reports.
    ///
    /// ## Why is this bad
    /// A master reads these objects at boot-up to find out what the device is and whether it is well. A device
    /// without them is no CANopen device.
    ///
    /// ## Example
    /// ```eds
    /// [MandatoryObjects]
    /// SupportedObjects=2
    /// 1=0x1000
    /// 2=0x1018
    ///
    /// [1000]
    /// ParameterName=Device type
    ///
    /// [1018]
    /// ParameterName=Identity object
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [MandatoryObjects]
    /// SupportedObjects=3
    /// 1=0x1000
    /// 2=0x1001
    /// 3=0x1018
    ///
    /// [1000]
    /// ParameterName=Device type
    ///
    /// [1001]
    /// ParameterName=Error register
    ///
    /// [1018]
    /// ParameterName=Identity object
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.5.2.1, 7.5.2.2 and 7.5.2.21; CiA 306 v1.3, 4.6.3.1.
    pub(crate) static MANDATORY_OBJECT_MISSING = {
        code: "LST007",
        name: "mandatory-object-missing",
        group: Lists,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("9"), EdsDcfCheck("LST005")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let listing = context.listing();
    let is_missing = |index: &Index| {
        !listing.is_described(*index)
            && !listing.is_listed(*index)
            && !lost_header::hides(context, SectionKind::Object(*index))
    };
    let missing: Vec<Index> = MANDATORY.into_iter().filter(is_missing).collect();
    let mut lists = List::ALL.into_iter().filter_map(|list| list.section(context.sheet));
    let (false, Some(list)) = (missing.is_empty(), lists.next()) else { return };
    let names: Vec<String> = missing.iter().map(|index| format!("{index} ({})", name(*index))).collect();
    let message = format!("the device has no {}, which every device has", series(&names, "or"));
    let finding = report.add(list.span(), message);
    if missing == [Index::IDENTITY] && is_edition_3(context) {
        finding.severity(Severity::Warning).here("1018h is mandatory since CANopen version 4");
    }
    let sections: Vec<String> = missing.iter().map(|index| format!("`[{index:X}]`")).collect();
    let pronoun = if missing.len() == 1 { "it" } else { "them" };
    finding
        .help(format!("describe {}, and list {pronoun} in `[MandatoryObjects]`", series(&sections, "and")));
}

const fn name(index: Index) -> &'static str {
    match index {
        Index::DEVICE_TYPE => "device type",
        Index::ERROR_REGISTER => "error register",
        _ => "identity",
    }
}

/// Whether the file is of an edition when 1018h was optional: 3.x, which a missing EDSVersion means, too.
fn is_edition_3(context: &Context<'_>) -> bool {
    let version = context.sheet.file_info().and_then(|info| info.eds_version());
    version.is_none_or(|version| matches!(version.raw(), [b'0'..=b'3', ..]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn described_or_listed_is_enough() {
        let text = "[OptionalObjects]\n1=0x1001\n[1000]\n[1018]\n";
        assert!(findings(&MANDATORY_OBJECT_MISSING, text).is_empty());
        assert_eq!(
            findings(&MANDATORY_OBJECT_MISSING, "[OptionalObjects]\n[1001]\n"),
            ["1:1 error: the device has no 1000h (device type) or 1018h (identity), which every device has"]
        );
        assert!(findings(&MANDATORY_OBJECT_MISSING, "[2000]\n").is_empty());
    }

    #[test]
    fn identity_was_optional_once() {
        for (version, severity) in
            [("EDSVersion=3.0", "warning"), ("", "warning"), ("EDSVersion=4.0", "error")]
        {
            let text = format!("[FileInfo]\n{version}\n[MandatoryObjects]\n[1000]\n[1001]\n");
            assert_eq!(
                findings(&MANDATORY_OBJECT_MISSING, &text),
                [format!("3:1 {severity}: the device has no 1018h (identity), which every device has")]
            );
        }
    }
}
