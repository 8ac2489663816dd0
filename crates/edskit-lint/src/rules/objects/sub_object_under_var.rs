use super::structure::{counted_subs, elements, fixed_code};
use super::words::{is_are, with_article};
use crate::edits::add_lines;
use crate::rule::rule;
use crate::wording::count;
use crate::{Context, Edit, Report};
use edskit_model::Object;
use edskit_types::ObjectCode;

rule! {
    /// A VAR or DOMAIN has sub-objects
    ///
    /// ## What it does
    /// Reports sub-objects of an object that is a VAR or a DOMAIN, also one that is a VAR because its `ObjectType` is
    /// missing.
    ///
    /// ## Why is this bad
    /// A VAR and a DOMAIN are one value, in sub-index 00h. Readers ignore the sub-objects, or refuse the file.
    ///
    /// ## Example
    /// ```eds
    /// [2010]
    /// ParameterName=Ramps
    /// ObjectType=0x7
    /// SubNumber=2
    ///
    /// [2010sub0]
    /// ParameterName=Highest sub-index
    ///
    /// [2010sub1]
    /// ParameterName=Ramp up
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
    /// ParameterName=Highest sub-index
    ///
    /// [2010sub1]
    /// ParameterName=Ramp up
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.4.3; CiA 306 v1.3, 4.6.3.2.
    pub(crate) static SUB_OBJECT_UNDER_VAR = {
        code: "OBJ011",
        name: "sub-object-under-var",
        group: Objects,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [Dcfchk("ObjectType should be 0x08 or 0x09")],
        check: Object(check),
    }
}

fn check(_: &Context<'_>, object: Object<'_>, report: &mut Report) {
    let Some(first) = counted_subs(object).next() else { return };
    let Some(code @ (ObjectCode::Var | ObjectCode::Domain)) = object.object_code() else { return };
    let described = counted_subs(object).len();
    let subs = format!("{} {} described", count(described, "sub-object"), is_are(described));
    let object_type = object.object_type();
    let finding = match object_type {
        Some(field) => {
            report.add(field.span(), format!("{} is {}, but {subs}", object.index(), with_article(code)))
        }
        None => report.add(
            object.section().span(),
            format!("{} is a VAR because it has no ObjectType, but {subs}", object.index()),
        ),
    };
    finding.label(first.section().span(), "the first sub-object");
    if elements(object).len() == 0 {
        finding.help(format!(
            "leave `[{}]` out; `[{:X}]` itself describes the value",
            first.name(),
            object.index().0
        ));
        return;
    }
    let meant = fixed_code(object.index()).unwrap_or(ObjectCode::Record);
    let number = format!("0x{}", meant.code());
    finding.help(format!("write `ObjectType={number}` for {}", with_article(meant)));
    if object.data_type().is_none() {
        let edit = match object_type {
            Some(field) => Edit::replace(field.span(), number),
            None => add_lines(object.section(), &[&format!("ObjectType={number}")]),
        };
        finding.unsafe_fix(format!("Make it {}", with_article(meant)), vec![edit]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn variables_domains_and_missing_types() {
        let text = "[2000]\nObjectType=7\nDataType=5\n[2000sub0]\nDataType=5\n\
                    [2001]\nObjectType=2\n[2001sub1]\nDataType=5\n\
                    [1010]\nSubNumber=2\n[1010sub0]\nDataType=5\n[1010sub1]\nDataType=7\n\
                    [2002]\nObjectType=7\n[2002subFF]\nDataType=7\n[2003]\nObjectType=8\n[2003sub0]\nDataType=5\n";
        assert_eq!(
            findings(&SUB_OBJECT_UNDER_VAR, text),
            [
                "2:12 error: 2000h is a VAR, but 1 sub-object is described",
                "7:12 error: 2001h is a DOMAIN, but 1 sub-object is described",
                "10:1 error: 1010h is a VAR because it has no ObjectType, but 2 sub-objects are described"
            ]
        );
    }

    #[test]
    fn the_fix_makes_it_a_record_or_what_cia_301_says() {
        assert_eq!(
            fixed(&SUB_OBJECT_UNDER_VAR, "[1010]\nSubNumber=1\n[1010sub1]\nDataType=7\n"),
            "[1010]\nSubNumber=1\nObjectType=0x8\n[1010sub1]\nDataType=7\n"
        );
        assert_eq!(
            fixed(&SUB_OBJECT_UNDER_VAR, "[2000]\nObjectType=0x7\n[2000sub1]\nDataType=7\n"),
            "[2000]\nObjectType=0x9\n[2000sub1]\nDataType=7\n"
        );
    }
}
