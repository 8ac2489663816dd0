use crate::rule::rule;
use crate::rules::syntax::lost_header;
use crate::{Context, Report, Severity};
use edskit_model::{Object, SectionKind};
use edskit_types::{Index, ObjectCode, SubIndex};

rule! {
    /// The identity object has too few or too many entries
    ///
    /// ## What it does
    /// Reports an identity object (1018h) without sub-index 01h, the vendor-ID, and, as a warning, one with a sub-index
    /// above 04h.
    ///
    /// ## Why is this bad
    /// The vendor-ID is mandatory; masters compare it before they let a device into the network. Above 04h the standard defines
    /// nothing.
    ///
    /// ## Example
    /// ```eds
    /// [1018]
    /// ParameterName=Identity object
    /// ObjectType=0x9
    /// SubNumber=2
    ///
    /// [1018sub0]
    /// DataType=0x0005
    /// DefaultValue=2
    ///
    /// [1018sub2]
    /// ParameterName=Product code
    /// DataType=0x0007
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1018]
    /// ParameterName=Identity object
    /// ObjectType=0x9
    /// SubNumber=2
    ///
    /// [1018sub0]
    /// DataType=0x0005
    /// DefaultValue=1
    ///
    /// [1018sub1]
    /// ParameterName=Vendor-ID
    /// DataType=0x0007
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.5.2.21.
    pub(crate) static IDENTITY_STRUCTURE = {
        code: "COM013",
        name: "identity-structure",
        group: Communication,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("38, 39")],
        check: Object(check),
    }
}

/// The serial number, the last member.
const LAST: SubIndex = SubIndex(4);

fn check(context: &Context<'_>, object: Object<'_>, report: &mut Report) {
    if object.index() != Index::IDENTITY {
        return;
    }
    // A VAR is the matter of COM001, and an object without any sub-object that of OBJ008 and OBJ012.
    if !matches!(object.object_code(), Some(ObjectCode::Array | ObjectCode::Record)) {
        return;
    }
    let compact = object.compact_count();
    if compact == 0 && object.sub_objects().len() == 0 {
        return;
    }
    let is_hidden = || lost_header::hides(context, SectionKind::SubObject(object.index(), SubIndex(1)));
    if object.dictionary_entry(SubIndex(1)).is_none() && !is_hidden() {
        report
            .add(object.span(), "the identity object has no vendor-ID (sub-index 01h)")
            .help("describe `[1018sub1]`, an UNSIGNED32 with access `ro`");
    }
    let beyond = object.sub_objects().find(|sub| (LAST.0 + 1..0xFF).contains(&sub.sub_index().0));
    if let Some(sub) = beyond {
        report
            .add(
                sub.span(),
                format!("the identity object ends at sub-index {LAST}, but {} is described", sub.sub_index()),
            )
            .severity(Severity::Warning)
            .help("describe what belongs to the manufacturer at 2000h to 5FFFh");
    } else if compact > LAST.0
        && let Some(field) = object.compact_sub_obj()
    {
        report
            .add(
                field.span(),
                format!("the identity object ends at sub-index {LAST}, but CompactSubObj is {compact}"),
            )
            .severity(Severity::Warning)
            .help("write `CompactSubObj=4`");
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn the_vendor_id_is_there_and_nothing_follows_the_serial_number() {
        let found = |subs: &[u8]| {
            let mut text = "[1018]\nObjectType=9\n".to_owned();
            for sub in subs {
                text.push_str(&format!("[1018sub{sub:X}]\nDataType=7\n"));
            }
            findings(&IDENTITY_STRUCTURE, &text)
        };
        assert!(
            found(&[0, 1]).is_empty() && found(&[0, 1, 2, 3, 4, 0xFF]).is_empty() && found(&[]).is_empty()
        );
        assert_eq!(found(&[0, 4]), ["1:1 error: the identity object has no vendor-ID (sub-index 01h)"]);
        assert_eq!(
            found(&[0, 1, 5, 6]),
            ["7:1 warning: the identity object ends at sub-index 04h, but 05h is described"]
        );
        assert_eq!(
            findings(&IDENTITY_STRUCTURE, "[1018]\nObjectType=9\nCompactSubObj=5\n"),
            ["3:15 warning: the identity object ends at sub-index 04h, but CompactSubObj is 5"]
        );
        assert!(findings(&IDENTITY_STRUCTURE, "[1018]\nObjectType=7\n[1018sub0]\nDataType=5\n").is_empty());
    }
}
