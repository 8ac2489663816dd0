use super::structure::fixed_code;
use super::words::with_article;
use crate::rule::rule;
use crate::{Context, Edit, Report};
use edskit_model::Object;
use edskit_types::ObjectCode;

rule! {
    /// ARRAY and RECORD are confused
    ///
    /// ## What it does
    /// Reports an identity object (1018h), SDO parameter (1200h to 12FFh), PDO parameter or PDO mapping (1400h to
    /// 1BFFh) that is an ARRAY, and one of the ARRAYs 1003h, 1010h, 1011h, 1016h and 1029h that is a RECORD. Objects
    /// with `CompactSubObj` are left alone, since some readers know it for an ARRAY only.
    ///
    /// ## Why is this bad
    /// CiA 301 fixes the object code. python-canopen, among others, reads the members of an ARRAY by another way than
    /// those of a RECORD and does not find the members of such an object.
    ///
    /// ## Example
    /// ```eds
    /// [1018]
    /// ParameterName=Identity object
    /// ObjectType=0x8
    /// SubNumber=5
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1018]
    /// ParameterName=Identity object
    /// ObjectType=0x9
    /// SubNumber=5
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.5.2.21 and 7.5.2.33 to 7.5.2.38; python-canopen issue 139.
    pub(crate) static RECORD_AS_ARRAY = {
        code: "OBJ016",
        name: "record-as-array",
        group: Objects,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: Object(check),
    }
}

fn check(_: &Context<'_>, object: Object<'_>, report: &mut Report) {
    let Some(right) = fixed_code(object.index()) else { return };
    let Some(field) = object.object_type() else { return };
    let Some(wrong @ (ObjectCode::Array | ObjectCode::Record)) = field.known() else { return };
    if wrong == right || object.compact_count() > 0 {
        return;
    }
    let number = format!("0x{}", right.code());
    report
        .add(
            field.span(),
            format!("{} is {} instead of {}", object.index(), with_article(wrong), with_article(right)),
        )
        .help(format!("write `ObjectType={number}`"))
        .unsafe_fix(format!("Make it {}", with_article(right)), vec![Edit::replace(field.span(), number)]);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn both_ways() {
        let text = "[1016]\nObjectType=9\n[1200]\nObjectType=8\n[1A00]\nObjectType=0x08\nCompactSubObj=8\n[1BFF]\nObjectType=8\n[1C00]\nObjectType=8\n[1018]\nObjectType=7\n";
        assert_eq!(
            findings(&RECORD_AS_ARRAY, text),
            [
                "2:12 warning: 1016h is a RECORD instead of an ARRAY",
                "4:12 warning: 1200h is an ARRAY instead of a RECORD",
                "9:12 warning: 1BFFh is an ARRAY instead of a RECORD"
            ]
        );
        assert_eq!(fixed(&RECORD_AS_ARRAY, "[1016]\nObjectType=9\n"), "[1016]\nObjectType=0x8\n");
    }
}
