use crate::rule::rule;
use crate::{Context, Report, Variable};
use edskit_types::{Index, SubIndex};

rule! {
    /// An object has a sub-index that its profile does not define
    ///
    /// ## What it does
    /// Reports an ARRAY or RECORD with a sub-index, or a `CompactSubObj`, above the highest one that CiA 301, the device profile
    /// named by 1000h, or a profile given with `--profile` defines. 1018h is left to COM013.
    ///
    /// ## Why is this bad
    /// What the profile leaves undefined, a later edition may define in another way. Data of the manufacturer belong to 2000h to
    /// 5FFFh.
    ///
    /// ## Example
    /// ```eds
    /// [1200]
    /// ParameterName=SDO server parameter
    /// ObjectType=0x9
    /// SubNumber=2
    ///
    /// [1200sub0]
    /// ParameterName=Highest sub-index
    /// DataType=0x0005
    ///
    /// [1200sub3]
    /// ParameterName=Node-ID of the client
    /// DataType=0x0005
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1200]
    /// ParameterName=SDO server parameter
    /// ObjectType=0x9
    /// SubNumber=2
    ///
    /// [1200sub0]
    /// ParameterName=Highest sub-index
    /// DataType=0x0005
    ///
    /// [1200sub1]
    /// ParameterName=COB-ID client to server
    /// DataType=0x0007
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.5.2; the device profiles.
    pub(crate) static SUB_OBJECT_UNDEFINED = {
        code: "PRF004",
        name: "sub-object-undefined",
        group: Profile,
        severity: Info,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("38, 39")],
        check: Variable(check),
    }
}

fn check(context: &Context<'_>, variable: &Variable<'_>, report: &mut Report) {
    if variable.prescriptions.is_empty() || variable.sub_index.is_some() || variable.index == Index::IDENTITY
    {
        return;
    }
    if !variable.code.is_some_and(|code| code.has_sub_objects()) {
        return;
    }
    let Some(object) = context.sheet.object(variable.index) else { return };
    for prescription in variable.prescriptions {
        let Some(highest) = prescription.object.highest else { continue };
        let beyond = object.sub_objects().find(|sub| sub.sub_index().0 > highest && sub.sub_index().0 < 0xFF);
        let compact =
            object.compact_sub_obj().filter(|field| field.known().is_some_and(|count| count > highest));
        let (span, what) = match (beyond, compact) {
            (Some(sub), _) => (sub.span(), format!("{} is described", sub.sub_index())),
            (None, Some(field)) => (field.span(), format!("CompactSubObj is {}", field.text())),
            (None, None) => continue,
        };
        let message = format!(
            "{} ({}) ends at sub-index {} in {}, but {what}",
            variable.index,
            prescription.object.name,
            SubIndex(highest),
            prescription.profile.name
        );
        report.add(span, message).help("describe what belongs to the manufacturer at 2000h to 5FFFh");
        return;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn the_first_one_beyond_is_shown() {
        let text = "[1200]\nObjectType=9\n[1200sub2]\nDataType=7\n[1200sub4]\nDataType=7\n[1200sub5]\nDataType=7\n[1200subFF]\nDataType=7\n[1016]\nObjectType=8\nCompactSubObj=0x80\n[1011]\nObjectType=8\nCompactSubObj=127\n[1018]\nObjectType=9\n[1018sub5]\nDataType=7\n";
        assert_eq!(
            findings(&SUB_OBJECT_UNDEFINED, text),
            [
                "5:1 info: 1200h (default SDO server parameter) ends at sub-index 02h in CiA 301, but 04h is described",
                "13:15 info: 1016h (consumer heartbeat time) ends at sub-index 7Fh in CiA 301, but CompactSubObj is 0x80"
            ]
        );
    }
}
