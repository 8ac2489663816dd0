use crate::rule::rule;
use crate::rules::syntax::lost_header;
use crate::{Context, Report};
use edskit_model::SectionKind;
use edskit_types::SubIndex;

rule! {
    /// A PDO lacks its COB-ID or its transmission type
    ///
    /// ## What it does
    /// Reports a communication parameter of a PDO that does not describe sub-index 01h (COB-ID) or 02h (transmission
    /// type). Where the mapping parameter is missing as well, PDO001 says so.
    ///
    /// ## Why is this bad
    /// Both are mandatory. Without a COB-ID nobody knows the frames of the PDO, without a transmission type nobody
    /// knows when they come.
    ///
    /// ## Example
    /// ```eds
    /// [1800]
    /// ParameterName=TPDO 1 communication parameter
    /// ObjectType=0x9
    /// SubNumber=2
    ///
    /// [1800sub0]
    /// ParameterName=Highest sub-index
    /// DataType=0x0005
    ///
    /// [1800sub1]
    /// ParameterName=COB-ID
    /// DataType=0x0007
    ///
    /// [1A00]
    /// ParameterName=TPDO 1 mapping parameter
    /// ObjectType=0x9
    /// CompactSubObj=8
    /// DataType=0x0007
    /// AccessType=rw
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1800]
    /// ParameterName=TPDO 1 communication parameter
    /// ObjectType=0x9
    /// SubNumber=3
    ///
    /// [1800sub0]
    /// ParameterName=Highest sub-index
    /// DataType=0x0005
    ///
    /// [1800sub1]
    /// ParameterName=COB-ID
    /// DataType=0x0007
    ///
    /// [1800sub2]
    /// ParameterName=Transmission type
    /// DataType=0x0005
    ///
    /// [1A00]
    /// ParameterName=TPDO 1 mapping parameter
    /// ObjectType=0x9
    /// CompactSubObj=8
    /// DataType=0x0007
    /// AccessType=rw
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.5.2.35 and 7.5.2.37.
    pub(crate) static PDO_PARAMETER_MISSING = {
        code: "PDO026",
        name: "pdo-parameter-missing",
        group: Pdo,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for pdo in context.pdos() {
        // A PDO of which a whole half is missing is the matter of PDO001.
        let (Some(object), Some(_)) = (pdo.communication, pdo.mapping) else { continue };
        if pdo.cob_id.is_some() && pdo.transmission_type.is_some() {
            continue;
        }
        // A SubNumber that promises more, or no sub-object at all, is the matter of OBJ008 and OBJ012.
        if object.sub_objects().len() == 0 && object.compact_count() == 0 {
            continue;
        }
        let lacks = |sub_index| {
            let sub_index = SubIndex(sub_index);
            object.dictionary_entry(sub_index).is_none()
                && !lost_header::hides(context, SectionKind::SubObject(object.index(), sub_index))
        };
        let what = match (lacks(1), lacks(2)) {
            (true, true) => "neither COB-ID (sub-index 01h) nor transmission type (sub-index 02h)",
            (true, false) => "no COB-ID (sub-index 01h)",
            (false, true) => "no transmission type (sub-index 02h)",
            (false, false) => continue,
        };
        report
            .add(object.span(), format!("{pdo} has {what}"))
            .help(format!("describe what is missing in `[{0:X}sub1]` and `[{0:X}sub2]`", object.index()));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn both_are_mandatory() {
        let text = "[1400]\nObjectType=9\n[1400sub0]\n[1400sub1]\n[1400sub2]\n[1401]\nObjectType=9\n[1401sub0]\n[1401sub2]\n[1800]\nObjectType=9\n[1800sub0]\n[1801]\nObjectType=9\n[1600]\n[1601]\n[1A00]\n[1A01]\n";
        assert_eq!(
            findings(&PDO_PARAMETER_MISSING, text),
            [
                "6:1 error: RPDO2 has no COB-ID (sub-index 01h)",
                "10:1 error: TPDO1 has neither COB-ID (sub-index 01h) nor transmission type (sub-index 02h)"
            ]
        );
        assert!(
            findings(&PDO_PARAMETER_MISSING, "[1400]\nObjectType=9\nDataType=7\nCompactSubObj=2\n[1600]\n")
                .is_empty()
        );
    }

    #[test]
    fn half_a_pdo_is_one_defect() {
        assert!(findings(&PDO_PARAMETER_MISSING, "[1400]\nObjectType=9\n[1400sub1]\n").is_empty());
    }
}
