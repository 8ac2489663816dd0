use super::reading::is_compact;
use crate::rule::rule;
use crate::{Context, Report, Severity, Variable};
use edskit_types::{DataType, DataTypeKind, Index, ObjectArea};

rule! {
    /// The data type does not exist
    ///
    /// ## What it does
    /// Reports a `DataType` that CiA 301 reserves, that is no index of a data type at all, or that is a record type
    /// on something that holds a single value. Types of manufacturers (0040h to 005Fh) and of device profiles (0060h
    /// to 025Fh) are legal; where the file has no section for such a type, that is reported as an information.
    ///
    /// ## Why is this bad
    /// Without the type nobody knows the size of the value, so it can neither be transferred nor mapped. Most tools
    /// refuse the file or skip the object.
    ///
    /// ## Example
    /// ```eds
    /// [2000]
    /// ParameterName=Speed
    /// DataType=0x0017
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [2000]
    /// ParameterName=Speed
    /// DataType=0x0007
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.4.3; CiA 306 v1.3, 4.6.3.2.
    pub(crate) static UNKNOWN_DATATYPE = {
        code: "VAL001",
        name: "unknown-datatype",
        group: Values,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("32"), CanChkEds("type not checkable"), EdsDcfCheck("OBJ003")],
        check: Variable(check),
    }
}

fn check(context: &Context<'_>, variable: &Variable<'_>, report: &mut Report) {
    if variable.standard_type.is_some_and(|known| known.kind() != DataTypeKind::Record) {
        return;
    }
    let Some(field) = variable.data_type else { return };
    let Some(index) = field.known().map(Index) else { return };
    if !variable.holds_value() && !is_compact(variable) {
        return;
    }
    let place = variable.place();
    if let Some(record) = variable.standard_type {
        report
            .add(
                field.span(),
                format!("{place} holds a single value, but its data type is the record {record}"),
            )
            .help(
                "give the type of the value, such as `DataType=0x0007` for UNSIGNED32, or describe a RECORD",
            );
        return;
    }
    match index.area() {
        // The records of the OS command and the OS debugger: sources differ on whether they have a type of their own.
        _ if matches!(index.0, 0x0024 | 0x0025) => {}
        ObjectArea::ManufacturerDataType | ObjectArea::ProfileDataType => {
            if context.sheet.object(index).is_none() {
                report
                    .add(field.span(), format!("data type {index} of {place} is not described"))
                    .help(format!("add a section `[{index:X}]` that describes the type"))
                    .severity(Severity::Info);
            }
        }
        ObjectArea::StaticDataType | ObjectArea::ComplexDataType => {
            report.add(field.span(), format!("data type {index} of {place} is reserved")).help(format!(
                "the types of CiA 301 are {} to {}",
                first(),
                last()
            ));
        }
        _ => {
            report.add(field.span(), format!("data type {index} of {place} does not exist")).help(format!(
                "the types of CiA 301 are {} to {}",
                first(),
                last()
            ));
        }
    }
}

fn first() -> String {
    let data_type = DataType::Boolean;
    format!("0x{:04X} ({data_type})", data_type.index())
}

fn last() -> String {
    let data_type = DataType::Unsigned64;
    format!("0x{:04X} ({data_type})", data_type.index())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    fn with(text: &str) -> String {
        findings(&UNKNOWN_DATATYPE, text).join("|")
    }

    #[test]
    fn reserved_and_impossible_types() {
        assert_eq!(with("[2000]\nDataType=0\n"), "2:10 error: data type 0000h of 2000h does not exist");
        assert_eq!(
            with("[2000sub1]\nDataType=0x1C\n"),
            "2:10 error: data type 001Ch of 2000h sub-index 01h is reserved"
        );
        assert_eq!(with("[2000]\nDataType=0x0260\n"), "2:10 error: data type 0260h of 2000h does not exist");
        assert_eq!(with("[2000]\nDataType=0x0025\n"), "");
        assert_eq!(with("[2000]\nDataType=x\n[2001]\nDataType=\n[2002]\n"), "");
    }

    #[test]
    fn types_of_manufacturers_want_a_description() {
        assert_eq!(with("[2000]\nDataType=0x0040\n"), "2:10 info: data type 0040h of 2000h is not described");
        assert_eq!(with("[2000]\nDataType=0x0040\n[0040]\nObjectType=5\nDataType=0x7\n"), "");
        assert_eq!(with("[2000]\nDataType=0x0081\n[81]\nObjectType=6\nSubNumber=2\n"), "");
    }

    #[test]
    fn record_types_belong_to_records() {
        assert_eq!(with("[1018]\nObjectType=9\nDataType=0x23\nSubNumber=5\n"), "");
        assert_eq!(
            with("[1018]\nObjectType=7\nDataType=0x23\n"),
            "2:1 error: 1018h holds a single value, but its data type is the record IDENTITY"
                .replace("2:1", "3:10")
        );
        assert_eq!(
            with("[2100]\nObjectType=9\nDataType=0x21\nCompactSubObj=3\n"),
            "3:10 error: 2100h holds a single value, but its data type is the record PDO_MAPPING"
        );
    }
}
