use crate::rule::rule;
use crate::wording::series;
use crate::{Context, Report};
use edskit_types::{Index, SubIndex};

rule! {
    /// A device with LSS lacks a part of its LSS address
    ///
    /// ## What it does
    /// Reports `LSS_Supported=1` in a file whose identity object 1018h does not have all of the sub-indices 01h to
    /// 04h.
    ///
    /// ## Why is this bad
    /// The LSS address is vendor-ID, product code, revision number and serial number. A master that wants to give one
    /// of several devices its node-ID needs all four.
    ///
    /// ## Example
    /// ```eds
    /// [DeviceInfo]
    /// LSS_Supported=1
    ///
    /// [1018]
    /// ParameterName=Identity object
    /// ObjectType=0x9
    /// SubNumber=4
    ///
    /// [1018sub1]
    /// ParameterName=Vendor-ID
    ///
    /// [1018sub2]
    /// ParameterName=Product code
    ///
    /// [1018sub3]
    /// ParameterName=Revision number
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [DeviceInfo]
    /// LSS_Supported=1
    ///
    /// [1018]
    /// ParameterName=Identity object
    /// ObjectType=0x9
    /// SubNumber=5
    ///
    /// [1018sub1]
    /// ParameterName=Vendor-ID
    ///
    /// [1018sub2]
    /// ParameterName=Product code
    ///
    /// [1018sub3]
    /// ParameterName=Revision number
    ///
    /// [1018sub4]
    /// ParameterName=Serial number
    /// ```
    ///
    /// ## References
    /// CiA 305 v2.2; CiA 301 v4.2, 7.5.2.21.
    pub(crate) static LSS_NEEDS_IDENTITY = {
        code: "DEV013",
        name: "lss-needs-identity",
        group: DeviceInfo,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let Some(field) = context.sheet.device_info().and_then(|info| info.lss_supported()) else { return };
    // That there is no 1018h at all is the matter of LST007.
    let Some(identity) = context.sheet.object(Index::IDENTITY) else { return };
    if field.known() != Some(true) {
        return;
    }
    let missing = (1..=4).map(SubIndex).filter(|&sub| identity.dictionary_entry(sub).is_none());
    let missing: Vec<SubIndex> = missing.collect();
    if missing.is_empty() {
        return;
    }
    let names: Vec<String> = missing.iter().map(SubIndex::to_string).collect();
    let sections: Vec<String> = missing.iter().map(|sub| format!("`[1018sub{sub:X}]`")).collect();
    report
        .add(field.span(), format!("LSS_Supported is 1, but 1018h has no sub-index {}", series(&names, "or")))
        .label(identity.span(), "the identity object, which is the LSS address")
        .help(format!("describe {}, or write `LSS_Supported=0`", series(&sections, "and")));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn all_four_numbers_are_needed() {
        let found = |supported: &str| {
            let text = format!("[DeviceInfo]\nLSS_Supported={supported}\n[1018]\nObjectType=9\n[1018sub2]\n");
            findings(&LSS_NEEDS_IDENTITY, &text)
        };
        assert_eq!(
            found("1"),
            ["2:15 warning: LSS_Supported is 1, but 1018h has no sub-index 01h, 03h or 04h"]
        );
        assert!(found("0").is_empty() && found("").is_empty() && found("maybe").is_empty());
        assert_eq!(found("yes").len(), 1, "DEV003 reports the word, and it is clear what it means");
        assert!(findings(&LSS_NEEDS_IDENTITY, "[DeviceInfo]\nLSS_Supported=1\n").is_empty());
    }
}
