use super::structure::belongs_elsewhere;
use super::words::with_article;
use crate::rule::rule;
use crate::{Context, Edit, Report, Variable};
use edskit_model::{Field, Number};
use edskit_types::ObjectCode;

rule! {
    /// ObjectType is no object code
    ///
    /// ## What it does
    /// Reports an `ObjectType` that is none of the object codes NULL (0x0), DOMAIN (0x2), DEFTYPE (0x5), DEFSTRUCT
    /// (0x6), VAR (0x7), ARRAY (0x8) and RECORD (0x9). For a sub-object it also reports ARRAY, RECORD and DEFSTRUCT,
    /// because a sub-object cannot have sub-objects.
    ///
    /// ## Why is this bad
    /// The object code decides which other entries there are and what they mean. Without it a reader can only guess
    /// whether the object has sub-objects.
    ///
    /// ## Example
    /// ```eds
    /// [2010]
    /// ParameterName=Ramp time
    /// ObjectType=0x3
    /// DataType=0x0006
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
    /// CiA 301 v4.2, 7.4.3; CiA 306 v1.3, 4.6.3.2.
    pub(crate) static OBJECT_TYPE_INVALID = {
        code: "OBJ002",
        name: "objecttype-invalid",
        group: Objects,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("29"), EdsDcfCheck("OBJ001"), Dcfchk("invalid value for")],
        check: Variable(check),
    }
}

const CODES: &str = "write `0x7` for a VAR, `0x8` for an ARRAY, `0x9` for a RECORD or `0x2` for a DOMAIN";
const SUB_CODES: &str = "write `0x7` for a VAR or `0x2` for a DOMAIN";

fn check(context: &Context<'_>, variable: &Variable<'_>, report: &mut Report) {
    let Some(field) = variable.object_type else { return };
    let in_sub_object = variable.sub_index.is_some();
    let message = match field.value {
        Ok(code) if in_sub_object && code.has_sub_objects() => {
            format!("{} is {}, but a sub-object has no sub-objects", variable.place(), with_article(code))
        }
        Ok(_) => return,
        Err(_) if belongs_elsewhere(field.entry) => return,
        Err(_) if Number::parse(field.entry.raw()).is_ok() => {
            format!("`{}` is no object code", field.text())
        }
        Err(_) if named(field).is_some() => {
            format!("`{}` is the name of an object code where its number belongs", field.text())
        }
        Err(_) => format!("`{}` is no object code, which is a number", field.text()),
    };
    let finding = report.add(field.span(), message);
    match meant(context, variable, field) {
        Some(code) => {
            let number = format!("0x{}", code.code());
            finding.help(format!("write `{number}` for {}", with_article(code))).unsafe_fix(
                format!("Make it {}", with_article(code)),
                vec![Edit::replace(field.span(), number)],
            )
        }
        None => finding.help(if in_sub_object { SUB_CODES } else { CODES }),
    };
}

/// The object code whose name the text is.
fn named(field: Field<'_, ObjectCode>) -> Option<ObjectCode> {
    let raw = field.entry.raw();
    ObjectCode::ALL.iter().copied().find(|code| raw.eq_ignore_ascii_case(code.name().as_bytes()))
}

/// The object code that the rest of the description speaks for.
fn meant(context: &Context<'_>, variable: &Variable<'_>, field: Field<'_, ObjectCode>) -> Option<ObjectCode> {
    let in_sub_object = variable.sub_index.is_some();
    if let Some(code) = named(field).filter(|code| !in_sub_object || !code.has_sub_objects()) {
        return Some(code);
    }
    let single = in_sub_object
        || (context.sheet.object(variable.index)?.sub_objects().len() == 0
            && variable.description.sub_number().is_none()
            && variable.description.compact_sub_obj().is_none());
    (single && variable.data_type.is_some()).then_some(ObjectCode::Var)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn what_is_no_code_and_what_was_meant() {
        let text = "[2000]\nObjectType=record\n[2000sub1]\nObjectType=0x9\nDataType=5\n[2001]\nObjectType=x\n[2002]\nObjectType=0x10\nSubNumber=2\n";
        assert_eq!(
            findings(&OBJECT_TYPE_INVALID, text),
            [
                "2:12 error: `record` is the name of an object code where its number belongs",
                "4:12 error: 2000h sub-index 01h is a RECORD, but a sub-object has no sub-objects",
                "7:12 error: `x` is no object code, which is a number",
                "9:12 error: `0x10` is no object code",
            ]
        );
        assert_eq!(
            fixed(&OBJECT_TYPE_INVALID, text),
            "[2000]\nObjectType=0x9\n[2000sub1]\nObjectType=0x7\nDataType=5\n[2001]\nObjectType=x\n[2002]\nObjectType=0x10\nSubNumber=2\n"
        );
    }

    #[test]
    fn decimal_and_padded_codes_are_right_and_comments_belong_to_others() {
        let text = "[2000]\nObjectType=7\n[2001]\nObjectType=0x07\n[2002]\nObjectType=0x7 ; VAR\n[2003]\nObjectType=\n";
        assert_eq!(findings(&OBJECT_TYPE_INVALID, text), [""; 0]);
    }
}
