use crate::profile::Prescription;
use crate::rule::rule;
use crate::{Context, Report, Variable};
use edskit_model::Object;
use edskit_types::{Index, SubIndex};

rule! {
    /// An object lacks a sub-index that its profile prescribes
    ///
    /// ## What it does
    /// Reports a described ARRAY or RECORD without a sub-index that is mandatory by CiA 301, the device profile named by 1000h,
    /// or a profile given with `--profile`. 1018h is left to COM013, the communication parameters of PDOs are left to PDO026.
    ///
    /// ## Why is this bad
    /// A master that knows the profile reads or writes the sub-index, and gets an abort code.
    ///
    /// ## Example
    /// ```eds
    /// [1010]
    /// ParameterName=Store parameters
    /// ObjectType=0x8
    /// SubNumber=2
    ///
    /// [1010sub0]
    /// ParameterName=Highest sub-index
    /// DataType=0x0005
    ///
    /// [1010sub2]
    /// ParameterName=Save communication parameters
    /// DataType=0x0007
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1010]
    /// ParameterName=Store parameters
    /// ObjectType=0x8
    /// SubNumber=2
    ///
    /// [1010sub0]
    /// ParameterName=Highest sub-index
    /// DataType=0x0005
    ///
    /// [1010sub1]
    /// ParameterName=Save all parameters
    /// DataType=0x0007
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.5.2; the device profiles.
    pub(crate) static SUB_OBJECT_MISSING = {
        code: "PRF003",
        name: "sub-object-missing",
        group: Profile,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("38, 39")],
        check: Variable(check),
    }
}

fn check(context: &Context<'_>, variable: &Variable<'_>, report: &mut Report) {
    if variable.prescriptions.is_empty() || variable.sub_index.is_some() || is_owned_elsewhere(variable.index)
    {
        return;
    }
    // A VAR is the matter of COM001, and an object without any sub-object that of OBJ008 and OBJ012.
    if !variable.code.is_some_and(|code| code.has_sub_objects()) {
        return;
    }
    let Some(object) = context.sheet.object(variable.index) else { return };
    if object.sub_objects().len() == 0 && !variable.is_compact() {
        return;
    }
    for prescription in variable.prescriptions {
        let missing = missing(object, *prescription);
        if !missing.is_empty() {
            let message = format!(
                "{} ({}) lacks {}, which {} prescribes",
                variable.index,
                prescription.object.name,
                missing.join(" and "),
                prescription.profile.name
            );
            report.add(variable.description.span(), message).help("describe it in a section of its own");
            return;
        }
    }
}

fn is_owned_elsewhere(index: Index) -> bool {
    index == Index::IDENTITY || index.is_rpdo_communication() || index.is_tpdo_communication()
}

fn missing(object: Object<'_>, prescription: Prescription<'_>) -> Vec<String> {
    let subs = prescription.object.subs.iter().filter(|sub| sub.mandatory);
    let missing = subs.filter(|sub| object.dictionary_entry(SubIndex(*sub.sub_indices.start())).is_none());
    let called = missing.map(|sub| {
        let sub_index = SubIndex(*sub.sub_indices.start());
        match &sub.name {
            Some(name) => format!("sub-index {sub_index} ({name})"),
            None => format!("sub-index {sub_index}"),
        }
    });
    called.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn mandatory_sub_indices_are_named() {
        let text = "[1003]\nObjectType=8\n[1003sub0]\nDataType=5\n[1200]\nObjectType=9\n[1200sub0]\nDataType=5\n[1800]\nObjectType=9\n[1800sub0]\nDataType=5\n[1018]\nObjectType=9\n[1018sub0]\nDataType=5\n[1010]\nObjectType=8\n[1011]\nObjectType=8\nCompactSubObj=1\n[1016]\nObjectType=7\n[1016sub0]\nDataType=5\n";
        assert_eq!(
            findings(&SUB_OBJECT_MISSING, text),
            [
                "1:1 warning: 1003h (pre-defined error field) lacks sub-index 01h, which CiA 301 prescribes",
                "5:1 warning: 1200h (default SDO server parameter) lacks sub-index 01h (COB-ID client to server) and sub-index 02h (COB-ID server to client), which CiA 301 prescribes"
            ]
        );
    }
}
