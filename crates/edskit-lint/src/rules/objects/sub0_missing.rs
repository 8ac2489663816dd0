use super::structure::{counted_subs, sub0};
use super::words::with_article;
use crate::edits::{add_lines, number_like};
use crate::rule::rule;
use crate::rules::syntax::lost_header;
use crate::{Context, Edit, Report};
use edskit_model::{Object, SectionKind};
use edskit_types::{ObjectCode, SubIndex};

rule! {
    /// Sub-index 00h is missing
    ///
    /// ## What it does
    /// Reports an ARRAY or RECORD without sub-index 00h. An object with `CompactSubObj` has it without a section.
    ///
    /// ## Why is this bad
    /// Sub-index 00h holds the highest sub-index and is part of every ARRAY and RECORD. Masters read it first to learn
    /// how many elements there are.
    ///
    /// ## Example
    /// ```eds
    /// [2010]
    /// ParameterName=Ramps
    /// ObjectType=0x9
    /// SubNumber=1
    ///
    /// [2010sub1]
    /// ParameterName=Ramp up
    /// DataType=0x0006
    /// AccessType=rw
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
    /// ParameterName=Highest sub-index supported
    /// DataType=0x0005
    /// AccessType=const
    /// DefaultValue=1
    ///
    /// [2010sub1]
    /// ParameterName=Ramp up
    /// DataType=0x0006
    /// AccessType=rw
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.4.5.2; CiA 306 v1.3, 4.6.3.2.
    pub(crate) static SUB0_MISSING = {
        code: "OBJ012",
        name: "sub0-missing",
        group: Objects,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("14"), EdsDcfCheck("OBJ007")],
        check: Object(check),
    }
}

fn check(context: &Context<'_>, object: Object<'_>, report: &mut Report) {
    if sub0(object).is_some() {
        return;
    }
    let Some(code @ (ObjectCode::Array | ObjectCode::Record)) = object.object_code() else { return };
    if object.compact_sub_obj().is_some_and(|field| field.known() != Some(0)) {
        return;
    }
    let sub_number = object.sub_number();
    let claimed = sub_number.and_then(|field| field.known()).map(usize::from);
    let count = counted_subs(object).len();
    // Where nothing is described at all, that is the finding: of OBJ006, OBJ007 or OBJ008.
    if count == 0 && claimed != Some(0) {
        return;
    }
    if lost_header::hides(context, SectionKind::SubObject(object.index(), SubIndex(0))) {
        return;
    }
    let section = object.section();
    let name = format!("[{:X}sub0]", object.index().0);
    let message = format!("{} is {}, but has no sub-index 00h", object.index(), with_article(code));
    let finding = report.add(section.span(), message);
    let Some(last) = counted_subs(object).next_back() else {
        finding.help(format!("describe it in a section `{name}`, and the elements in sections of their own"));
        return;
    };
    let highest = last.sub_index().0;
    finding
        .label(last.section().span(), format!("sub-indexes up to {} are described", last.sub_index()))
        .help(format!(
            "describe it in a section `{name}` with `DataType=0x0005` and `DefaultValue={highest}`"
        ));
    let mut edits = Vec::new();
    if let (Some(field), Some(claimed)) = (sub_number, claimed)
        && claimed == count
    {
        edits.push(Edit::replace(field.span(), number_like(count as u64 + 1, field.entry.raw())));
    }
    edits.push(add_lines(
        section,
        &[
            "",
            &name,
            "ParameterName=Highest sub-index supported",
            "ObjectType=0x7",
            "DataType=0x0005",
            "AccessType=const",
            &format!("DefaultValue={highest}"),
            "PDOMapping=0",
        ],
    ));
    finding.unsafe_fix("Describe sub-index 00h", edits);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn the_fix_describes_it_and_counts_it() {
        let described = "\n\n[2000sub0]\nParameterName=Highest sub-index supported\nObjectType=0x7\nDataType=0x0005\n\
                         AccessType=const\nDefaultValue=3\nPDOMapping=0\n[2000sub3]\nDataType=5\n";
        for (before, after) in [("0x1", "0x2"), ("2", "2"), ("7", "7")] {
            assert_eq!(
                fixed(
                    &SUB0_MISSING,
                    &format!("[2000]\nObjectType=8\nSubNumber={before}\n[2000sub3]\nDataType=5\n")
                ),
                format!("[2000]\nObjectType=8\nSubNumber={after}{described}")
            );
        }
    }

    #[test]
    fn objects_without_any_sub_object() {
        let text = "[2000]\nObjectType=8\nSubNumber=0\n[2001]\nObjectType=8\nSubNumber=4\n[2002]\nObjectType=9\n\
                    [2003]\nObjectType=8\nCompactSubObj=4\n[2004]\nObjectType=6\nSubNumber=1\n[2004sub1]\nDataType=5\n";
        assert_eq!(findings(&SUB0_MISSING, text), ["1:1 error: 2000h is an ARRAY, but has no sub-index 00h"]);
    }
}
