use super::structure::{elements, fixed_code};
use crate::rule::rule;
use crate::{Context, Report};
use edskit_model::{Object, Span, SubObject};
use edskit_types::{DataType, DataTypeKind, Index, ObjectCode};

rule! {
    /// The elements of an ARRAY have different types
    ///
    /// ## What it does
    /// Reports an ARRAY in which an element from sub-index 01h on has another data type than the one before it.
    /// The ARRAYs of CiA 301 are left to COM002, and types that no element can have to VAL001.
    ///
    /// ## Why is this bad
    /// All elements of an ARRAY have one type; elements of different types make a RECORD. Tools that take the type of
    /// the first element for all of them read and write too many or too few bytes.
    ///
    /// ## Example
    /// ```eds
    /// [2010]
    /// ParameterName=Ramps
    /// ObjectType=0x8
    /// SubNumber=3
    ///
    /// [2010sub1]
    /// ParameterName=Ramp up
    /// DataType=0x0006
    ///
    /// [2010sub2]
    /// ParameterName=Ramp shape
    /// DataType=0x0005
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [2010]
    /// ParameterName=Ramps
    /// ObjectType=0x9
    /// SubNumber=3
    ///
    /// [2010sub1]
    /// ParameterName=Ramp up
    /// DataType=0x0006
    ///
    /// [2010sub2]
    /// ParameterName=Ramp shape
    /// DataType=0x0005
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.4.3.
    pub(crate) static ARRAY_MIXED_TYPES = {
        code: "OBJ015",
        name: "array-mixed-types",
        group: Objects,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("42")],
        check: Object(check),
    }
}

fn check(_: &Context<'_>, object: Object<'_>, report: &mut Report) {
    // RECORDs that are described as ARRAYs are the matter of OBJ016, and of course their members differ. Of the ARRAYs of
    // CiA 301 a wrong type is the matter of COM002.
    if object.object_code() != Some(ObjectCode::Array) || fixed_code(object.index()).is_some() {
        return;
    }
    let mut typed = elements(object).filter_map(|sub| Some((type_of(sub)?, sub)));
    let Some((first_type, first)) = typed.next() else { return };
    let Some((other_type, other)) = typed.find(|&(data_type, _)| data_type != first_type) else { return };
    let message = format!(
        "{} is an ARRAY, but sub-index {} is {} and sub-index {} is {}",
        object.index(),
        other.sub_index(),
        name(other_type),
        first.sub_index(),
        name(first_type)
    );
    report
        .add(place(other), message)
        .here(format!("{} here", name(other_type)))
        .label(place(first), format!("{} here", name(first_type)))
        .help("write `ObjectType=0x9` for a RECORD, or give all elements one data type");
}

/// The data type that an element gives itself, or has as a DOMAIN. What no element can have is the matter of VAL001.
fn type_of(sub: SubObject<'_>) -> Option<u16> {
    let is_possible = |index: &u16| match DataType::from_index(Index(*index)) {
        Some(known) => known.kind() != DataTypeKind::Record,
        None => (0x0040..=0x025F).contains(index),
    };
    match sub.data_type() {
        Some(field) => field.known().filter(is_possible),
        None => sub.standard_type().map(|data_type| data_type.index().0),
    }
}

fn name(data_type: u16) -> String {
    match DataType::from_index(Index(data_type)) {
        Some(known) => known.name().to_owned(),
        None => format!("of type {}", Index(data_type)),
    }
}

/// The data type, or the header where a DOMAIN has none.
fn place(sub: SubObject<'_>) -> Span {
    sub.data_type().map_or_else(|| sub.section().span(), |field| field.span())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn sub_indexes_00h_and_ffh_are_no_elements() {
        let text = "[2000]\nObjectType=8\n[2000sub0]\nDataType=5\n[2000sub1]\nDataType=6\n[2000sub2]\nDataType=0x0006\n[2000subFF]\nDataType=7\n";
        assert_eq!(findings(&ARRAY_MIXED_TYPES, text), [""; 0]);
    }

    #[test]
    fn types_that_do_not_exist_and_arrays_of_cia_301_are_left_to_their_rules() {
        let array = |index: &str, second: &str| {
            let text = format!(
                "[{index}]\nObjectType=8\n[{index}sub1]\nDataType=7\n[{index}sub2]\nDataType={second}\n"
            );
            findings(&ARRAY_MIXED_TYPES, &text)
        };
        for second in ["0x17", "0", "0x6040", "0x21"] {
            assert_eq!(array("2000", second), [""; 0], "VAL001: {second}");
        }
        assert_eq!(array("1016", "6"), [""; 0], "COM002");
        assert_eq!(array("2000", "6").len(), 1);
    }

    #[test]
    fn the_first_difference_is_shown() {
        let text = "[2000]\nObjectType=8\n[2000sub1]\nDataType=x\n[2000sub2]\nObjectType=2\n[2000sub3]\nDataType=0x40\n[2000sub4]\nDataType=5\n\
                    [1018]\nObjectType=8\n[1018sub1]\nDataType=5\n[1018sub2]\nDataType=7\n";
        assert_eq!(
            findings(&ARRAY_MIXED_TYPES, text),
            ["8:10 error: 2000h is an ARRAY, but sub-index 03h is of type 0040h and sub-index 02h is DOMAIN"]
        );
    }
}
