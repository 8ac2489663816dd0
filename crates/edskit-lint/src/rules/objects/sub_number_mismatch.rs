use super::structure::{counted_subs, goes_beyond_ff, sub0};
use super::words::is_are;
use crate::edits::number_like;
use crate::rule::rule;
use crate::wording::count;
use crate::{Context, Edit, Report};
use edskit_model::{Object, SectionKind};
use edskit_types::SubIndex;

rule! {
    /// SubNumber is not the number of described sub-objects
    ///
    /// ## What it does
    /// Compares `SubNumber` with the sub-objects that are described. Sub-index 00h counts, FFh does not, and gaps do
    /// not matter: the sub-indexes 00h, 01h and 04h are three.
    ///
    /// ## Why is this bad
    /// Readers that stop after `SubNumber` sub-objects lose the rest, others refuse the file. Often sub-objects have
    /// got lost, or sub-index 00h was not counted.
    ///
    /// ## Example
    /// ```eds
    /// [2010]
    /// ParameterName=Ramps
    /// ObjectType=0x9
    /// SubNumber=1
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
    /// ObjectType=0x9
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
    /// CiA 306 v1.3, 4.6.3.2.
    pub(crate) static SUB_NUMBER_MISMATCH = {
        code: "OBJ008",
        name: "subnumber-mismatch",
        group: Objects,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [
            CanChkEds("6"), CanChkEds("33, 34"), CanChkEds("redundant sub-object"), EdsDcfCheck("OBJ006"),
            Dcfchk("missing sub-object(s)"), Dcfchk("extra sub-object(s)"),
        ],
        check: Object(check),
    }
}

fn check(context: &Context<'_>, object: Object<'_>, report: &mut Report) {
    let Some(field) = object.sub_number() else { return };
    let Some(claimed) = field.known().map(usize::from) else { return };
    let described = counted_subs(object).len();
    if claimed == described
        || object.compact_sub_obj().is_some_and(|field| field.known() != Some(0))
        || !object.object_code().is_some_and(|code| code.has_sub_objects())
    {
        return;
    }
    if described > 0 && claimed == described + 1 && sub0(object).is_none() {
        // OBJ012: SubNumber is right, sub-index 00h is missing.
        return;
    }
    if goes_beyond_ff(object) || hides_sub_object(context, object) {
        return;
    }
    let message = format!(
        "SubNumber is {}, but {} {} described",
        field.text(),
        count(described, "sub-object"),
        is_are(described)
    );
    let finding = report.add(field.span(), message);
    let mut subs = counted_subs(object);
    match (subs.next(), subs.next_back()) {
        (Some(first), Some(last)) => {
            finding
                .label(first.section().span(), "the first one")
                .label(last.section().span(), "the last one");
        }
        (Some(only), None) => {
            finding.label(only.section().span(), "the only one");
        }
        (None, _) => {
            finding.help("describe the sub-objects; perhaps their sections have got lost");
            return;
        }
    }
    let number = number_like(described as u64, field.entry.raw());
    let hint = if claimed > described && object.sub_objects().len() > described {
        "; sub-index FFh is not counted"
    } else if claimed > described {
        ", or describe the missing ones"
    } else {
        ""
    };
    finding
        .help(format!("write `SubNumber={number}`{hint}"))
        .unsafe_fix("Write the number of described sub-objects", vec![Edit::replace(field.span(), number)]);
}

/// Whether the header of a sub-object stands behind other text, which is the matter of SYN008.
fn hides_sub_object(context: &Context<'_>, object: Object<'_>) -> bool {
    let hidden = context.hidden_sections();
    let first = hidden.partition_point(|kind| *kind < SectionKind::SubObject(object.index(), SubIndex(0)));
    matches!(hidden.get(first), Some(SectionKind::SubObject(index, _)) if *index == object.index())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn a_sub_object_whose_header_lost_its_line_is_described() {
        let text = "[2000]\nObjectType=9\nSubNumber=2\n[2000sub0]\nDataType=5[2000sub1]\nDataType=6\n";
        assert_eq!(findings(&SUB_NUMBER_MISMATCH, text), [""; 0]);
    }

    #[test]
    fn gaps_and_ffh_are_not_counted() {
        let text = |number: &str| {
            format!(
                "[2000]\nObjectType=9\nSubNumber={number}\n[2000sub0]\nDataType=5\n[2000sub4]\nDataType=5\n[2000subFF]\nDataType=7\n"
            )
        };
        assert_eq!(findings(&SUB_NUMBER_MISMATCH, &text("2")), [""; 0]);
        assert_eq!(
            findings(&SUB_NUMBER_MISMATCH, &text("5")),
            ["3:11 error: SubNumber is 5, but 2 sub-objects are described"]
        );
        assert_eq!(fixed(&SUB_NUMBER_MISMATCH, &text("0x05")), text("0x02"));
    }

    #[test]
    fn one_sub_object_and_none() {
        let text =
            "[2000]\nObjectType=8\nSubNumber=8\n[2000sub0]\nDataType=5\n[2001]\nObjectType=8\nSubNumber=3\n";
        assert_eq!(
            findings(&SUB_NUMBER_MISMATCH, text),
            [
                "3:11 error: SubNumber is 8, but 1 sub-object is described",
                "8:11 error: SubNumber is 3, but 0 sub-objects are described"
            ]
        );
    }

    #[test]
    fn what_other_rules_report() {
        let text = "[2000]\nObjectType=8\nSubNumber=2\n[2000sub1]\nDataType=5\n[2001]\nSubNumber=4\n\
                    [2002]\nObjectType=8\nSubNumber=3\nCompactSubObj=3\n[2003]\nObjectType=9\nSubNumber=x\n[2004]\nObjectType=x\nSubNumber=1\n\
                    [2005]\nObjectType=8\nSubNumber=101\n[2005sub99]\nDataType=5\n[2005sub100]\nDataType=5\n";
        assert_eq!(findings(&SUB_NUMBER_MISMATCH, text), [""; 0]);
    }
}
