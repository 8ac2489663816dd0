use super::structure::needs_attributes;
use crate::missing::place_of;
use crate::rule::rule;
use crate::{Context, Report, Variable};
use edskit_model::KeyName;

rule! {
    /// A value has no access type
    ///
    /// ## What it does
    /// Reports a VAR, DEFTYPE or sub-object without `AccessType`, and an object with `CompactSubObj` without one. A
    /// DOMAIN needs none. Where `DataType` is missing as well, OBJ003 says so for both.
    ///
    /// ## Why is this bad
    /// Without the access type a tool does not know whether it may read or write the value. Some assume `rw` and
    /// configure what the device refuses, others leave the object out.
    ///
    /// ## Example
    /// ```eds
    /// [2010]
    /// ParameterName=Ramp time
    /// ObjectType=0x7
    /// DataType=0x0006
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
    pub(crate) static ACCESS_TYPE_MISSING = {
        code: "OBJ004",
        name: "accesstype-missing",
        group: Objects,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("26"), EdsDcfCheck("OBJ005"), Dcfchk("AccessType not specified")],
        check: Variable(check),
    }
}

fn check(context: &Context<'_>, variable: &Variable<'_>, report: &mut Report) {
    if variable.access_type.is_some() || variable.data_type.is_none() || !needs_attributes(context, variable)
    {
        return;
    }
    report
        .add(
            place_of(variable.description.section(), KeyName::AccessType),
            format!("{} has no AccessType", variable.place()),
        )
        .help("write `AccessType=` with `ro`, `wo`, `rw`, `rwr`, `rww` or `const`");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn only_what_holds_a_value_needs_access() {
        let text = "[2000]\nObjectType=8\n[2000sub1]\nDataType=5\nAccessType=\n[2001]\nObjectType=2\n[2002]\nObjectType=x\n\
                    [2003]\nDataType=5\n[2004]\nObjectType=8\nCompactSubObj=0\n[2005]\nObjectType=9\nCompactSubObj=4\nDataType=5\n\
                    [2006]\nObjectType=7\n";
        assert_eq!(
            findings(&ACCESS_TYPE_MISSING, text),
            [
                "5:1 error: 2000h sub-index 01h has no AccessType",
                "10:1 error: 2003h has no AccessType",
                "15:1 error: 2005h has no AccessType"
            ]
        );
    }
}
