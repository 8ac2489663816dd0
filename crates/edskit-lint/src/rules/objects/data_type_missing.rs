use super::structure::needs_attributes;
use crate::edits::add_lines;
use crate::missing::place_of;
use crate::rule::rule;
use crate::{Context, Report, Variable};
use edskit_model::KeyName;
use edskit_types::SubIndex;

rule! {
    /// A value has no data type
    ///
    /// ## What it does
    /// Reports a VAR, DEFTYPE or sub-object without `DataType`, and an object with `CompactSubObj` without one. A
    /// DOMAIN needs none. Where `AccessType` is missing as well, this rule says so for both.
    ///
    /// ## Why is this bad
    /// Without the data type nobody knows how many bytes the value has, nor what its default value and limits mean.
    /// Most readers refuse the object.
    ///
    /// ## Example
    /// ```eds
    /// [2010]
    /// ParameterName=Ramp time
    /// ObjectType=0x7
    /// AccessType=rw
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [2010]
    /// ParameterName=Ramp time
    /// ObjectType=0x7
    /// DataType=0x0006
    /// AccessType=rw
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.6.3.2.
    pub(crate) static DATA_TYPE_MISSING = {
        code: "OBJ003",
        name: "datatype-missing",
        group: Objects,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("26"), EdsDcfCheck("OBJ004"), Dcfchk("DataType not specified")],
        check: Variable(check),
    }
}

fn check(context: &Context<'_>, variable: &Variable<'_>, report: &mut Report) {
    if variable.data_type.is_some() || !needs_attributes(context, variable) {
        return;
    }
    let section = variable.description.section();
    let what = if variable.access_type.is_some() { "no DataType" } else { "neither DataType nor AccessType" };
    let finding =
        report.add(place_of(section, KeyName::DataType), format!("{} has {what}", variable.place()));
    if variable.sub_index == Some(SubIndex(0)) {
        finding
            .help("write `DataType=0x0005`: sub-index 00h is UNSIGNED8")
            .unsafe_fix("Make it UNSIGNED8", vec![add_lines(section, &["DataType=0x0005"])]);
    } else {
        finding.help("write the index of the type, such as `DataType=0x0006` for UNSIGNED16");
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn only_what_holds_a_value_needs_a_type() {
        let text = "[2000]\nObjectType=9\n[2000sub0]\nParameterName=n\n[2000sub1]\nObjectType=2\n\
                    [2001]\nObjectType=2\n[2002]\nObjectType=0\n[2003]\nDataType=\nAccessType=ro\n[2004]\nObjectType=8\nCompactSubObj=3\nAccessType=ro\n\
                    [2005]\nObjectType=6\n[2006]\nObjectType=5\n[2007]\nObjectType=7\n[2007sub1]\nDataType=5\n";
        assert_eq!(
            findings(&DATA_TYPE_MISSING, text),
            [
                "3:1 error: 2000h sub-index 00h has neither DataType nor AccessType",
                "12:1 error: 2003h has no DataType",
                "14:1 error: 2004h has no DataType",
                "20:1 error: 2006h has neither DataType nor AccessType"
            ]
        );
        assert_eq!(
            fixed(&DATA_TYPE_MISSING, "[2000sub0]\nParameterName=n\n"),
            "[2000sub0]\nParameterName=n\nDataType=0x0005\n"
        );
    }
}
