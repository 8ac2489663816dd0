use super::structure::elements;
use super::words::is_are;
use crate::rule::rule;
use crate::wording::count;
use crate::{Context, Edit, Report};
use edskit_model::Object;

rule! {
    /// An object is described compactly and one by one
    ///
    /// ## What it does
    /// Reports an object with `CompactSubObj` that also has a `SubNumber` other than 0, or whose elements are described
    /// in sections of their own as well.
    ///
    /// ## Why is this bad
    /// The two ways exclude each other. Readers take one or the other, so names, types and values differ from tool to
    /// tool.
    ///
    /// ## Example
    /// ```eds
    /// [2010]
    /// ParameterName=Ramp
    /// ObjectType=0x8
    /// DataType=0x0006
    /// AccessType=rw
    /// SubNumber=6
    /// CompactSubObj=5
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [2010]
    /// ParameterName=Ramp
    /// ObjectType=0x8
    /// DataType=0x0006
    /// AccessType=rw
    /// CompactSubObj=5
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.6.3.4.2.
    pub(crate) static COMPACT_AND_SUB_NUMBER = {
        code: "OBJ009",
        name: "compact-and-subnumber",
        group: Objects,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [EdsDcfCheck("OBJ006"), Dcfchk("SubNumber and CompactSubObj specified")],
        check: Object(check),
    }
}

fn check(_: &Context<'_>, object: Object<'_>, report: &mut Report) {
    let Some(compact) = object.compact_sub_obj() else { return };
    let Some(claimed @ 1..) = compact.known() else { return };
    if !object.object_code().is_some_and(|code| code.has_sub_objects()) {
        return;
    }
    let described = elements(object).len();
    let sub_number = object.sub_number().filter(|field| field.known().is_some_and(|number| number > 0));
    let finding = match (sub_number, elements(object).next()) {
        (Some(field), first) => {
            let message = format!("SubNumber is {} beside CompactSubObj, which is {claimed}", field.text());
            let finding = report.add(field.span(), message);
            finding.label(compact.span(), "this describes all sub-objects");
            if first.is_none() {
                finding
                    .help("leave SubNumber out, or write `SubNumber=0`")
                    .unsafe_fix("Leave SubNumber out", vec![Edit::delete(field.entry.line().full_span())]);
                return;
            }
            finding
        }
        (None, Some(first)) => {
            let message = format!(
                "CompactSubObj is {}, but {} {} described one by one",
                compact.text(),
                count(described, "element"),
                is_are(described)
            );
            report.add(compact.span(), message).label(first.section().span(), "the first one")
        }
        (None, None) => return,
    };
    finding
        .help("keep CompactSubObj where all elements are alike, else leave it out and describe each element");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn one_way_or_the_other() {
        let text = "[2000]\nObjectType=8\nSubNumber=0\nCompactSubObj=5\n[2000sub0]\nDataType=5\n[2000subFF]\nDataType=7\n\
                    [2001]\nObjectType=8\nCompactSubObj=2\n[2001sub0]\nDataType=5\n[2001sub1]\nDataType=5\n\
                    [2002]\nObjectType=8\nSubNumber=0x3\nCompactSubObj=2\n[2002sub1]\nDataType=5\n\
                    [2003]\nObjectType=8\nSubNumber=3\nCompactSubObj=0\n[2004]\nSubNumber=3\nCompactSubObj=3\n";
        assert_eq!(
            findings(&COMPACT_AND_SUB_NUMBER, text),
            [
                "11:15 warning: CompactSubObj is 2, but 1 element is described one by one",
                "18:11 warning: SubNumber is 0x3 beside CompactSubObj, which is 2"
            ]
        );
    }

    #[test]
    fn the_fix_keeps_the_compact_form() {
        assert_eq!(
            fixed(&COMPACT_AND_SUB_NUMBER, "[2000]\r\nObjectType=8\r\nSubNumber=6\r\nCompactSubObj=5\r\n"),
            "[2000]\r\nObjectType=8\r\nCompactSubObj=5\r\n"
        );
    }
}
