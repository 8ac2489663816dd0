use super::elements::{self, like};
use crate::profile::{alternatives, type_name};
use crate::rule::rule;
use crate::{Context, Report, Severity, Variable};
use edskit_model::{Field, SubObject};
use edskit_types::{DataType, DataTypeKind, Index};

rule! {
    /// An object has another data type than its profile prescribes
    ///
    /// ## What it does
    /// Reports a data type that differs from what CiA 301, the device profile named by 1000h, or a profile given with
    /// `--profile` prescribes. Where it is not CiA 301 that says so it is a warning. Sub-index 00h is left to OBJ013, and to
    /// VAL001 an index that is no data type at all, and a record type on a single value.
    ///
    /// ## Why is this bad
    /// A master that knows the profile transfers as many bytes as it prescribes. With another length the device
    /// refuses the transfer (abort code 0607 0010h), and a mapping no longer fits.
    ///
    /// ## Example
    /// ```eds
    /// [1001]
    /// ParameterName=Error register
    /// ObjectType=0x7
    /// DataType=0x0003
    /// AccessType=ro
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1001]
    /// ParameterName=Error register
    /// ObjectType=0x7
    /// DataType=0x0005
    /// AccessType=ro
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.5.2; the device profiles.
    pub(crate) static WRONG_DATATYPE = {
        code: "COM002",
        name: "wrong-datatype",
        group: Communication,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("30"), EdsDcfCheck("STD001")],
        check: Variable(check),
    }
}

/// The one profile that every CANopen device follows.
const CIA_301: &str = "CiA 301";

fn check(context: &Context<'_>, variable: &Variable<'_>, report: &mut Report) {
    if variable.prescriptions.is_empty() {
        return;
    }
    let Some(field) = variable.data_type else { return };
    let Some(data_type) = field.known().map(Index).filter(|&index| is_data_type(index)) else { return };
    // A record type on a single value is the matter of VAL001.
    if variable.holds_value()
        && variable.standard_type.is_some_and(|known| known.kind() == DataTypeKind::Record)
    {
        return;
    }
    for prescribed in variable.prescribed() {
        let types = &prescribed.attributes.types;
        if types.is_empty() || types.contains(&data_type) {
            continue;
        }
        let is_wrong_too = |sub: SubObject<'_>| sub.data_type().and_then(Field::known) == Some(data_type.0);
        let Some(further) = elements::further(context, variable, prescribed, is_wrong_too) else { return };
        let message = format!(
            "{} ({}) is {}, but {} prescribes {}{}",
            variable.place(),
            prescribed.name,
            type_name(data_type),
            prescribed.profile.name,
            alternatives(types.iter().map(|&index| type_name(index))),
            like(&further)
        );
        let finding = report.add(field.span(), message);
        finding.help(format!("write `DataType=0x{:04X}`", types[0]));
        if prescribed.profile.name != CIA_301 {
            finding.severity(Severity::Warning);
        }
        return;
    }
}

/// Whether VAL001 takes the index for a data type: one of CiA 301, of the manufacturer or of a device profile.
fn is_data_type(index: Index) -> bool {
    DataType::from_index(index).is_some() || (0x0040..=0x025F).contains(&index.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn variables_elements_and_members_are_compared() {
        let text = "[1017]\nDataType=7\n[1003]\nObjectType=8\n[1003sub0]\nDataType=7\n[1003sub1]\nDataType=4\n[1018]\nObjectType=9\nDataType=0x23\n[1018sub2]\nDataType=0x40\n[1018sub3]\nDataType=0x17\n[1016]\nObjectType=8\nDataType=6\nCompactSubObj=3\n[1280]\nObjectType=9\n[1280sub3]\nDataType=0x6\n";
        assert_eq!(
            findings(&WRONG_DATATYPE, text),
            [
                "2:10 error: 1017h (producer heartbeat time) is UNSIGNED32, but CiA 301 prescribes UNSIGNED16",
                "8:10 error: 1003h sub-index 01h (pre-defined error field) is INTEGER32, but CiA 301 prescribes UNSIGNED32",
                "13:10 error: 1018h sub-index 02h (product code) is 0040h, but CiA 301 prescribes UNSIGNED32",
                "18:10 error: 1016h (consumer heartbeat time) is UNSIGNED16, but CiA 301 prescribes UNSIGNED32",
                "23:10 error: 1280h sub-index 03h (node-ID of the server) is UNSIGNED16, but CiA 301 prescribes UNSIGNED8"
            ]
        );
    }

    #[test]
    fn elements_that_are_wrong_alike_get_one_finding() {
        let mut text = "[1010]\nObjectType=8\n".to_owned();
        for (sub, data_type) in [(0, 5), (1, 7), (2, 6), (3, 6), (4, 7), (5, 4), (6, 6)] {
            text.push_str(&format!("[1010sub{sub}]\nDataType={data_type}\n"));
        }
        assert_eq!(
            findings(&WRONG_DATATYPE, &text),
            [
                "8:10 error: 1010h sub-index 02h (store parameters) is UNSIGNED16, but CiA 301 prescribes UNSIGNED32 (like 2 further sub-indices)",
                "14:10 error: 1010h sub-index 05h (store parameters) is INTEGER32, but CiA 301 prescribes UNSIGNED32"
            ]
        );
    }

    #[test]
    fn several_types_can_be_right() {
        assert!(findings(&WRONG_DATATYPE, "[1022]\nDataType=5\n").is_empty());
        assert!(findings(&WRONG_DATATYPE, "[1022]\nDataType=6\n").is_empty());
        assert!(findings(&WRONG_DATATYPE, "[1022]\nDataType=0x21\n").is_empty(), "VAL001");
        assert_eq!(
            findings(&WRONG_DATATYPE, "[1022]\nDataType=7\n"),
            [
                "2:10 error: 1022h (storage format) is UNSIGNED32, but CiA 301 prescribes UNSIGNED16 or UNSIGNED8"
            ]
        );
    }

    #[test]
    fn further_logical_devices_follow_their_own_profile() {
        let text = "[1000]\nDataType=7\nDefaultValue=0x192\n[6FFF]\nDataType=7\nDefaultValue=0x20192\n[6041]\nDataType=5\n[6841]\nDataType=5\n[7041]\nDataType=5\n";
        assert_eq!(
            findings(&WRONG_DATATYPE, text),
            [
                "8:10 warning: 6041h (statusword) is UNSIGNED8, but CiA 402 prescribes UNSIGNED16",
                "10:10 warning: 6841h (statusword) is UNSIGNED8, but CiA 402 prescribes UNSIGNED16"
            ]
        );
    }

    #[test]
    fn with_several_logical_devices_1000h_names_no_profile() {
        let text = "[1000]\nDataType=7\nDefaultValue=0xFFFFFFFF\n[67FF]\nDataType=7\nDefaultValue=0x20192\n[6041]\nDataType=5\n";
        assert_eq!(findings(&WRONG_DATATYPE, text).len(), 1);
        assert!(
            findings(&WRONG_DATATYPE, "[1000]\nDataType=7\nDefaultValue=0xFFFFFFFF\n[6041]\nDataType=5\n")
                .is_empty()
        );
    }
}
