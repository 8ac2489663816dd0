use super::structure::counted_subs;
use super::words::{is_are, with_article};
use crate::edits::add_lines;
use crate::rule::rule;
use crate::wording::count;
use crate::{Context, Report};
use edskit_model::Object;

rule! {
    /// SubNumber is missing
    ///
    /// ## What it does
    /// Reports an ARRAY, RECORD or DEFSTRUCT that has neither `SubNumber` nor `CompactSubObj`.
    ///
    /// ## Why is this bad
    /// One of the two is mandatory. Readers that look for as many sub-objects as `SubNumber` says find none.
    ///
    /// ## Example
    /// ```eds
    /// [2010]
    /// ParameterName=Ramps
    /// ObjectType=0x8
    ///
    /// [2010sub0]
    /// ParameterName=Highest sub-index
    ///
    /// [2010sub1]
    /// ParameterName=Ramp up
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [2010]
    /// ParameterName=Ramps
    /// ObjectType=0x8
    /// SubNumber=2
    ///
    /// [2010sub0]
    /// ParameterName=Highest sub-index
    ///
    /// [2010sub1]
    /// ParameterName=Ramp up
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.6.3.2 and 4.6.3.4.2.
    pub(crate) static SUB_NUMBER_MISSING = {
        code: "OBJ007",
        name: "subnumber-missing",
        group: Objects,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("26"), EdsDcfCheck("OBJ006")],
        check: Object(check),
    }
}

fn check(_: &Context<'_>, object: Object<'_>, report: &mut Report) {
    let Some(code) = object.object_code().filter(|code| code.has_sub_objects()) else { return };
    if object.sub_number().is_some() || object.compact_sub_obj().is_some_and(|field| field.known() != Some(0))
    {
        return;
    }
    let described = counted_subs(object).len();
    if described == 0 && object.data_type().is_some() {
        // OBJ006: more likely the object is a VAR.
        return;
    }
    let section = object.section();
    let message = format!("{} is {}, but has no SubNumber", object.index(), with_article(code));
    let finding = report.add(section.span(), message);
    if described == 0 {
        finding.help("describe its sub-objects, and write their number as SubNumber");
    } else {
        let line = format!("SubNumber={described}");
        finding
            .help(format!(
                "write `{line}`: {} {} described",
                count(described, "sub-object"),
                is_are(described)
            ))
            .safe_fix("Write the SubNumber", vec![add_lines(section, &[&line])]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn the_number_is_counted_without_ffh() {
        let text =
            "[2000]\nObjectType=9\n[2000sub0]\nDataType=5\n[2000sub5]\nDataType=5\n[2000subFF]\nDataType=7\n";
        assert_eq!(
            findings(&SUB_NUMBER_MISSING, text),
            ["1:1 error: 2000h is a RECORD, but has no SubNumber"]
        );
        assert_eq!(
            fixed(&SUB_NUMBER_MISSING, text),
            text.replacen("ObjectType=9\n", "ObjectType=9\nSubNumber=2\n", 1)
        );
    }

    #[test]
    fn variables_and_compact_objects_need_none() {
        let text = "[2000]\nDataType=5\n[2001]\nObjectType=8\nCompactSubObj=4\n[2002]\nObjectType=2\n[2003]\nObjectType=8\nDataType=5\n";
        assert_eq!(findings(&SUB_NUMBER_MISSING, text), [""; 0]);
        let empty = "[2000]\nObjectType=8\nSubNumber=\nCompactSubObj=0\n";
        assert_eq!(
            findings(&SUB_NUMBER_MISSING, empty),
            ["1:1 error: 2000h is an ARRAY, but has no SubNumber"]
        );
    }
}
