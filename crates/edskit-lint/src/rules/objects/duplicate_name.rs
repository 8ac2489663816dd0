use crate::rule::rule;
use crate::{Context, Report};
use edskit_model::Entry;
use std::collections::HashMap;

rule! {
    /// Two objects have the same name
    ///
    /// ## What it does
    /// Reports a `ParameterName` that several objects have, once for each name. Sub-objects are not compared, nor are
    /// the SDO and PDO parameters (1200h to 1BFFh), whose names repeat by nature. Names repeat in many files, so the
    /// rule is off by default.
    ///
    /// ## Why is this bad
    /// People cannot tell the objects apart, and tools that find objects by name, such as python-canopen, find only one
    /// of them.
    ///
    /// ## Example
    /// ```eds
    /// [2010]
    /// ParameterName=Speed
    /// DataType=0x0006
    ///
    /// [2011]
    /// ParameterName=Speed
    /// DataType=0x0006
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [2010]
    /// ParameterName=Speed of the conveyor
    /// DataType=0x0006
    ///
    /// [2011]
    /// ParameterName=Speed of the lift
    /// DataType=0x0006
    /// ```
    ///
    /// ## References
    /// Engineering judgement: CiA 306 does not ask for unique names, but tools use them as keys.
    pub(crate) static DUPLICATE_NAME = {
        code: "OBJ025",
        name: "duplicate-name",
        group: Objects,
        severity: Info,
        enabled: false,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    /// The first and the second object of a name, and how many more have it.
    struct Named<'a> {
        first: Entry<'a>,
        second: Option<Entry<'a>>,
        more: usize,
    }
    let mut names: HashMap<&[u8], Named<'_>> = HashMap::new();
    for object in context.sheet.objects().filter(|object| !matches!(object.index().0, 0x1200..=0x1BFF)) {
        let Some(name) = object.parameter_name() else { continue };
        names
            .entry(name.raw())
            .and_modify(|named| match named.second {
                None => named.second = Some(name),
                Some(_) => named.more += 1,
            })
            .or_insert(Named { first: name, second: None, more: 0 });
    }
    for named in names.values() {
        let Some(second) = named.second else { continue };
        let more = match named.more {
            0 => String::new(),
            more => format!(" and by {more} more"),
        };
        report
            .add(second.value_span(), format!("the name `{}` is used by another object{more}", second.text()))
            .label(named.first.value_span(), "the other one")
            .help("give each object a name of its own");
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn one_finding_for_each_name() {
        let text = "[2000]\nParameterName=a\n[2001]\nParameterName=a\n[2002]\nParameterName=a\n[2003]\nParameterName=A\n\
                    [2003sub1]\nParameterName=a\n[2004]\nParameterName=\n[2005]\nParameterName=\n[1A00]\nParameterName=m\n[1A01]\nParameterName=m\n";
        assert_eq!(
            findings(&DUPLICATE_NAME, text),
            ["4:15 info: the name `a` is used by another object and by 1 more"]
        );
    }
}
