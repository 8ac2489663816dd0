use super::structure::{counted_subs, fixed_code};
use super::words::with_article;
use crate::rule::rule;
use crate::wording::few;
use crate::{Context, Edit, Report, Variable};
use edskit_model::{Entry, KeyName};
use edskit_types::ObjectCode;

rule! {
    /// A key does not apply to the object code
    ///
    /// ## What it does
    /// Reports keys that the object code does not have: `SubNumber` and `CompactSubObj` of a VAR, DEFTYPE, DOMAIN or
    /// sub-object; `DataType`, `AccessType`, `DefaultValue`, `PDOMapping`, `LowLimit` and `HighLimit` of an ARRAY,
    /// RECORD or DEFSTRUCT whose sub-objects are described one by one. Empty values and 0 are taken as nothing. All
    /// keys of one section make one finding.
    ///
    /// ## Why is this bad
    /// Either the key or the object code is wrong, and readers choose differently. A value at the object's own section
    /// is lost where only the sub-objects hold values.
    ///
    /// ## Example
    /// ```eds
    /// [2010]
    /// ParameterName=Ramps
    /// ObjectType=0x9
    /// DataType=0x0006
    /// AccessType=rw
    /// SubNumber=2
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [2010]
    /// ParameterName=Ramps
    /// ObjectType=0x9
    /// SubNumber=2
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.6.3.2.
    pub(crate) static KEY_NOT_SUPPORTED = {
        code: "OBJ006",
        name: "key-not-supported",
        group: Objects,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [
            CanChkEds("27"), EdsDcfCheck("OBJ006"), EdsDcfCheck("LIB001"),
            Dcfchk("AccessType not supported"), Dcfchk("ObjectType should be 0x08 or 0x09"),
        ],
        check: Variable(check),
    }
}

fn check(context: &Context<'_>, variable: &Variable<'_>, report: &mut Report) {
    let Some(code) = variable.code else { return };
    let structured = code.has_sub_objects();
    let description = variable.description;
    let foreign = |entry: &Entry<'_>| is_foreign(entry.key().name, structured) && says_something(*entry);
    // The usual case: nothing foreign, and nothing is allocated.
    if code == ObjectCode::Null || (structured && variable.sub_index.is_some()) {
        return;
    }
    let Some(first) = description.entries().find(foreign) else { return };
    if structured && description.compact_sub_obj().is_some_and(|field| field.known() != Some(0)) {
        return;
    }
    let object = context.sheet.object(variable.index);
    if !structured
        && variable.sub_index.is_none()
        && object.is_some_and(|object| counted_subs(object).len() > 0)
    {
        // OBJ011: not the keys are wrong, but the object code.
        return;
    }
    let entries: Vec<Entry<'_>> = description.entries().filter(foreign).collect();
    let keys: Vec<&str> = entries.iter().map(|entry| entry.key().name.spelling()).collect();
    let verb = if keys.len() == 1 { "does" } else { "do" };
    let whose = if variable.sub_index.is_some() { "a sub-object".to_owned() } else { with_article(code) };
    let finding = report.add(first.key_span(), format!("{} {verb} not apply to {whose}", few(keys.iter())));
    for entry in &entries[1..] {
        finding.label(entry.key_span(), "nor this one");
    }
    let compact = entries.iter().any(|entry| entry.key().name == KeyName::CompactSubObj);
    if let (true, None, Some(object_type)) = (compact, variable.sub_index, variable.object_type) {
        let code = fixed_code(variable.index).unwrap_or(ObjectCode::Array);
        let number = format!("0x{}", code.code());
        finding
            .label(object_type.span(), format!("this makes it {whose}"))
            .help(format!(
                "write `ObjectType={number}`: CompactSubObj describes the elements of {}",
                with_article(code)
            ))
            .unsafe_fix(
                format!("Make it {}", with_article(code)),
                vec![Edit::replace(object_type.span(), number)],
            );
        return;
    }
    let (pronoun, plural) = if keys.len() == 1 { ("it", "the key") } else { ("them", "the keys") };
    let empty = structured && object.is_none_or(|object| counted_subs(object).len() == 0);
    finding.help(match (structured, empty) {
        (true, true) => {
            format!("write `ObjectType=0x7` if it is one value; else leave {plural} to the sub-objects")
        }
        (true, false) => format!("leave {pronoun} out: each sub-object has its own"),
        (false, _) => format!("leave {pronoun} out: there are no sub-objects"),
    });
    if !empty {
        let lines = entries.iter().map(|entry| Edit::delete(entry.line().full_span())).collect();
        finding.unsafe_fix(format!("Leave {plural} out"), lines);
    }
}

/// Whether a key belongs to values where there is a structure, or the other way round.
#[inline]
fn is_foreign(key: KeyName, structured: bool) -> bool {
    use KeyName::*;
    match key {
        DataType | AccessType | DefaultValue | PdoMapping | LowLimit | HighLimit => structured,
        SubNumber | CompactSubObj => !structured,
        _ => false,
    }
}

/// Whether the value is more than nothing. A number that cannot be read is the matter of SYN017.
#[inline(never)]
fn says_something(entry: Entry<'_>) -> bool {
    match entry.key().name {
        KeyName::AccessType | KeyName::DataType | KeyName::DefaultValue => !entry.is_empty(),
        _ => entry.number().known().is_some_and(|number| number.value() != 0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn zero_and_empty_are_nothing() {
        let text = "[2000]\nDataType=5\nSubNumber=0\nCompactSubObj=\n[2001]\nObjectType=8\nDataType=\nPDOMapping=0\n";
        assert_eq!(findings(&KEY_NOT_SUPPORTED, text), [""; 0]);
    }

    #[test]
    fn keys_of_compact_objects_are_right() {
        let text = "[2000]\nObjectType=8\nDataType=5\nAccessType=rw\nLowLimit=1\nCompactSubObj=4\n";
        assert_eq!(findings(&KEY_NOT_SUPPORTED, text), [""; 0]);
    }

    #[test]
    fn one_finding_for_all_keys_of_a_section() {
        let text = "[2000]\nObjectType=8\nSubNumber=1\nDataType=5\nAccessType=rw\nHighLimit=4\n[2000sub0]\nDataType=5\n";
        assert_eq!(
            findings(&KEY_NOT_SUPPORTED, text),
            ["4:1 warning: DataType, AccessType and HighLimit do not apply to an ARRAY"]
        );
        assert_eq!(
            fixed(&KEY_NOT_SUPPORTED, text),
            "[2000]\nObjectType=8\nSubNumber=1\n[2000sub0]\nDataType=5\n"
        );
    }

    #[test]
    fn variables_have_no_sub_objects_to_count() {
        let text = "[2000]\nObjectType=0x7\nCompactSubObj=127\n[2001]\nSubNumber=2\n[2002sub1]\nSubNumber=1\n[2003]\nSubNumber=2\n[2003sub1]\nDataType=5\n";
        assert_eq!(
            findings(&KEY_NOT_SUPPORTED, text),
            [
                "3:1 warning: CompactSubObj does not apply to a VAR",
                "5:1 warning: SubNumber does not apply to a VAR",
                "7:1 warning: SubNumber does not apply to a sub-object"
            ]
        );
        assert_eq!(
            fixed(&KEY_NOT_SUPPORTED, text),
            "[2000]\nObjectType=0x8\nCompactSubObj=127\n[2001]\n[2002sub1]\n[2003]\nSubNumber=2\n[2003sub1]\nDataType=5\n"
        );
    }
}
