use crate::rule::rule;
use crate::{Context, Edit, Report, Severity, Variable};
use edskit_model::{Value, octets};
use edskit_types::{DataType, SubIndex};

rule! {
    /// PDOMapping=1 for a value that fits no PDO
    ///
    /// ## What it does
    /// Reports `PDOMapping=1` for a DOMAIN, for a string whose value is longer than 8 bytes, and for a record type as a
    /// warning; for a string without a value and for sub-index 00h of an ARRAY or RECORD as an information. A string
    /// with a value of up to 8 bytes may have a fixed length and is left alone.
    ///
    /// ## Why is this bad
    /// A PDO carries at most 8 bytes, each value with a fixed length. A tool that believes the entry offers a mapping
    /// that the device refuses. The number of elements can be mapped, but nobody gains from it.
    ///
    /// ## Example
    /// ```eds
    /// [2010]
    /// ParameterName=Name of the axis
    /// DataType=0x0009
    /// AccessType=rw
    /// DefaultValue=Left conveyor
    /// PDOMapping=1
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [2010]
    /// ParameterName=Name of the axis
    /// DataType=0x0009
    /// AccessType=rw
    /// DefaultValue=Left conveyor
    /// PDOMapping=0
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.5.2.36 and 7.5.2.38: a PDO has at most 64 bits. Leaving out sub-index 00h is engineering
    /// judgement: it never changes while a PDO is in use.
    pub(crate) static PDO_MAPPING_UNMAPPABLE = {
        code: "OBJ023",
        name: "pdomapping-unmappable",
        group: Objects,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("66")],
        check: Variable(check),
    }
}

fn check(context: &Context<'_>, variable: &Variable<'_>, report: &mut Report) {
    let Some(field) = variable.pdo_mapping.filter(|field| field.known() == Some(true)) else { return };
    let unmappable = variable.standard_type.filter(|data_type| !data_type.is_mappable());
    let (severity, message) = if let Some(data_type) = unmappable {
        let place = variable.place();
        match bytes(variable) {
            Some(0..=8) => return,
            Some(length) => (
                Severity::Warning,
                format!("{place} is mappable, but its value has {length} bytes and a PDO at most 8"),
            ),
            None if data_type.is_string() => {
                (Severity::Info, format!("{place} is mappable, but {data_type} has no fixed length"))
            }
            None => (Severity::Warning, format!("{place} is mappable, but a {data_type} fits no PDO")),
        }
    } else if variable.sub_index == Some(SubIndex(0)) && counts_elements(context, variable) {
        (
            Severity::Info,
            format!("sub-index 00h of {} is mappable, but only counts the elements", variable.index),
        )
    } else {
        return;
    };
    let finding = report.add(field.span(), message);
    finding.severity(severity).help("write `PDOMapping=0`");
    if let (Some(_), Some(data_type)) = (unmappable, variable.data_type) {
        finding.label(data_type.span(), "the data type");
    }
    finding.unsafe_fix("Make it not mappable", vec![Edit::replace(field.span(), "0")]);
}

/// How many bytes the longer one of the values of a string has.
fn bytes(variable: &Variable<'_>) -> Option<usize> {
    let length = |value: Value<'_>| match value {
        Value::Text(text) if variable.standard_type == Some(DataType::UnicodeString) => Some(2 * text.len()),
        Value::Text(text) => Some(text.len()),
        Value::Octets(digits) => Some(octets(digits).count()),
        _ => None,
    };
    let values = [variable.default_value, variable.parameter_value];
    values.into_iter().flatten().filter_map(|field| length(field.known()?)).max()
}

fn counts_elements(context: &Context<'_>, variable: &Variable<'_>) -> bool {
    let code = context.sheet.object(variable.index).and_then(|object| object.object_code());
    code.is_some_and(|code| code.has_sub_objects())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    fn finding(entries: &str) -> String {
        findings(&PDO_MAPPING_UNMAPPABLE, &format!("[2000]\nPDOMapping=1\n{entries}\n")).join("|")
    }

    #[test]
    fn strings_and_domains() {
        assert_eq!(
            finding("DataType=0x000A\nDefaultValue=001122334455667788"),
            "2:12 warning: 2000h is mappable, but its value has 9 bytes and a PDO at most 8"
        );
        assert_eq!(
            finding("DataType=9"),
            "2:12 info: 2000h is mappable, but VISIBLE_STRING has no fixed length"
        );
        assert_eq!(finding("ObjectType=2"), "2:12 warning: 2000h is mappable, but a DOMAIN fits no PDO");
        assert_eq!(finding("DataType=9\nDefaultValue=ABCD"), "");
        assert_eq!(finding("DataType=0x1B"), "");
        assert_eq!(finding("DataType=0x40"), "");
    }

    #[test]
    fn numbers_of_elements() {
        let text = "[2000]\nObjectType=8\n[2000sub0]\nDataType=5\nPDOMapping=1\n[2000sub1]\nDataType=5\nPDOMapping=1\n[2001]\n[2001sub0]\nDataType=5\nPDOMapping=1\n";
        assert_eq!(
            findings(&PDO_MAPPING_UNMAPPABLE, text),
            ["5:12 info: sub-index 00h of 2000h is mappable, but only counts the elements"]
        );
        assert_eq!(fixed(&PDO_MAPPING_UNMAPPABLE, text), text.replacen("PDOMapping=1", "PDOMapping=0", 1));
    }
}
