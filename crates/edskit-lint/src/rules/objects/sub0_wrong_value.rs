use super::structure::{counted_subs, elements, goes_beyond_ff, sub0};
use crate::edits::number_like;
use crate::rule::rule;
use crate::{Context, Edit, Report, Severity};
use edskit_model::{Description, Field, Object, Value};
use edskit_types::{Index, ObjectCode};

rule! {
    /// Sub-index 00h is not the highest described sub-index
    ///
    /// ## What it does
    /// Compares the default value of a read-only sub-index 00h with the highest described sub-index. A value that is
    /// too small is a warning. A value that is too large is a warning for a RECORD and an information for an ARRAY; an
    /// ARRAY of the communication profile with an element for each node may leave elements out. Gaps do not matter, and
    /// a DCF may say the right number as `ParameterValue`.
    ///
    /// Lists whose length changes while the device runs are left alone: 1003h, PDO mappings, a writable sub-index 00h,
    /// and one whose `HighLimit` covers all that is described.
    ///
    /// ## Why is this bad
    /// Masters read sub-index 00h to learn which elements there are. One that is too small hides elements, one that is
    /// too large leads to accesses that the device refuses.
    ///
    /// ## Example
    /// ```eds
    /// [2010]
    /// ParameterName=Ramps
    /// ObjectType=0x9
    /// SubNumber=3
    ///
    /// [2010sub0]
    /// ParameterName=Highest sub-index
    /// DataType=0x0005
    /// AccessType=ro
    /// DefaultValue=3
    ///
    /// [2010sub1]
    /// ParameterName=Ramp up
    ///
    /// [2010sub2]
    /// ParameterName=Ramp down
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [2010]
    /// ParameterName=Ramps
    /// ObjectType=0x9
    /// SubNumber=3
    ///
    /// [2010sub0]
    /// ParameterName=Highest sub-index
    /// DataType=0x0005
    /// AccessType=ro
    /// DefaultValue=2
    ///
    /// [2010sub1]
    /// ParameterName=Ramp up
    ///
    /// [2010sub2]
    /// ParameterName=Ramp down
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.4.5.2; CiA 306 v1.3, 4.6.3.2.
    pub(crate) static SUB0_WRONG_VALUE = {
        code: "OBJ014",
        name: "sub0-wrong-value",
        group: Objects,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("36"), CanChkEds("sub-index 00h"), EdsDcfCheck("OBJ007")],
        check: Object(check),
    }
}

fn check(_: &Context<'_>, object: Object<'_>, report: &mut Report) {
    let Some(sub0) = sub0(object) else { return };
    let Some(last) = counted_subs(object).next_back() else { return };
    let highest = last.sub_index().0;
    let Some(field) = sub0.default_value() else { return };
    let Some(Value::Integer(number)) = field.known() else { return };
    // In a DCF the device has the configured value, whatever others of its kind have.
    let configured = sub0.parameter_value().and_then(Field::known);
    let is_highest =
        |value: Value<'_>| matches!(value, Value::Integer(number) if number.value() == i128::from(highest));
    if is_highest(Value::Integer(number)) || configured.is_some_and(is_highest) {
        return;
    }
    let Some(code @ (ObjectCode::Array | ObjectCode::Record)) = object.object_code() else { return };
    if object.compact_count() > 0
        || changes_at_run_time(object.index())
        || sub0.access().is_none_or(|access| access.is_writable())
        || limit_covers(sub0.description(), highest)
        || goes_beyond_ff(object)
    {
        return;
    }
    let too_large = number.value() > i128::from(highest);
    let severity = match code {
        ObjectCode::Array if too_large && (0x1000..=0x1FFF).contains(&object.index().0) => return,
        ObjectCode::Array if too_large => Severity::Info,
        _ => Severity::Warning,
    };
    let claimed = object.sub_number().and_then(|field| field.known()).map(usize::from);
    if too_large && claimed.is_some_and(|claimed| claimed > counted_subs(object).len()) {
        // OBJ008: the sub-objects are missing.
        return;
    }
    let described = if elements(object).len() == 0 {
        "no element is described".to_owned()
    } else if too_large {
        format!("the highest described sub-index is {}", last.sub_index())
    } else {
        format!("sub-indexes up to {} are described", last.sub_index())
    };
    let message = format!("sub-index 00h of {} is {}, but {described}", object.index(), field.text());
    let value = number_like(highest.into(), field.entry.raw());
    let mut edits = vec![Edit::replace(field.span(), value.clone())];
    edits.extend(widened_limits(sub0.description(), highest));
    edits.sort_by_key(|edit| edit.span);
    report
        .add(field.span(), message)
        .severity(severity)
        .label(last.section().span(), "the highest one")
        .help(format!("write `DefaultValue={value}`, or describe what the object really has"))
        .unsafe_fix("Write the highest described sub-index", edits);
}

/// Lists whose sub-index 00h tells how many elements are in use just now.
fn changes_at_run_time(index: Index) -> bool {
    index == Index::PREDEFINED_ERROR_FIELD || matches!(index.0, 0x1600..=0x17FF | 0x1A00..=0x1BFF)
}

/// Edits that let the limits hold the value, where they do not: a value outside of them would be the next mistake.
fn widened_limits(sub0: Description<'_>, highest: u8) -> impl Iterator<Item = Edit> {
    let highest = i128::from(highest);
    let limits = [(sub0.low_limit(), false), (sub0.high_limit(), true)];
    limits.into_iter().filter_map(move |(limit, is_upper)| {
        let limit = limit?;
        let Ok(Value::Integer(number)) = limit.value else { return None };
        let excludes = if is_upper { number.value() < highest } else { number.value() > highest };
        excludes.then(|| Edit::replace(limit.span(), number_like(highest as u64, limit.entry.raw())))
    })
}

/// Whether limits say that the value moves up to at least what is described. The whole range of UNSIGNED8 says nothing.
fn limit_covers(sub0: Description<'_>, highest: u8) -> bool {
    let Some(Value::Integer(limit)) = sub0.high_limit().and_then(Field::known) else { return false };
    (i128::from(highest)..0xFE).contains(&limit.value())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    fn object(index: &str, code: u8, sub0: &str, subs: &[&str]) -> String {
        let mut text = format!("[{index}]\nObjectType={code}\n[{index}sub0]\nDataType=5\n{sub0}\n");
        for sub in subs {
            text += &format!("[{index}sub{sub}]\nDataType=5\n");
        }
        text
    }

    fn finding(index: &str, code: u8, sub0: &str, subs: &[&str]) -> String {
        findings(&SUB0_WRONG_VALUE, &object(index, code, sub0, subs)).join("|")
    }

    #[test]
    fn the_configured_value_counts_too() {
        let found = |value: &str| {
            let text = format!(
                "[2000]\nObjectType=9\n[2000sub0]\nDataType=5\nAccessType=ro\nDefaultValue=2\nParameterValue={value}\n[2000sub1]\n"
            );
            findings(&SUB0_WRONG_VALUE, &text).len()
        };
        assert_eq!([found("1"), found("2"), found("")], [0, 1, 1]);
    }

    #[test]
    fn too_small_and_too_large() {
        assert_eq!(
            finding("2000", 8, "AccessType=ro\nDefaultValue=1", &["1", "2"]),
            "6:14 warning: sub-index 00h of 2000h is 1, but sub-indexes up to 02h are described"
        );
        assert_eq!(
            finding("2000", 9, "AccessType=const\nDefaultValue=0x05", &["1", "2"]),
            "6:14 warning: sub-index 00h of 2000h is 0x05, but the highest described sub-index is 02h"
        );
        assert_eq!(
            finding("2000", 8, "AccessType=ro\nDefaultValue=5", &[]),
            "6:14 info: sub-index 00h of 2000h is 5, but no element is described"
        );
        let text = object("2000", 9, "AccessType=const\nDefaultValue=0x05", &["1", "2"]);
        assert_eq!(fixed(&SUB0_WRONG_VALUE, &text), text.replace("0x05", "0x02"));
    }

    #[test]
    fn limits_that_would_exclude_the_value_are_mended_with_it() {
        let text =
            object("2000", 9, "AccessType=ro\nLowLimit=0x01\nDefaultValue=3\nHighLimit=0x03", &["1", "5"]);
        let mended = text.replace("DefaultValue=3\nHighLimit=0x03", "DefaultValue=5\nHighLimit=0x05");
        assert_eq!(fixed(&SUB0_WRONG_VALUE, &text), mended);
        let text = object("2000", 9, "AccessType=ro\nDefaultValue=9\nLowLimit=4", &["1", "2"]);
        assert_eq!(
            fixed(&SUB0_WRONG_VALUE, &text),
            text.replace('9', "2").replace("Type=2", "Type=9").replace("=4", "=2")
        );
    }

    #[test]
    fn what_is_right() {
        assert_eq!(finding("2000", 9, "AccessType=ro\nDefaultValue=4", &["1", "4"]), "");
        assert_eq!(finding("2000", 9, "AccessType=ro\nDefaultValue=4", &["1", "4", "FF"]), "");
        assert_eq!(finding("2000", 9, "AccessType=ro", &["1"]), "");
        assert_eq!(finding("2000", 8, "AccessType=rw\nDefaultValue=0", &["1", "2"]), "");
        assert_eq!(finding("1003", 8, "AccessType=ro\nDefaultValue=0", &["1", "2"]), "");
        assert_eq!(finding("1A00", 9, "AccessType=ro\nDefaultValue=0", &["1", "2"]), "");
        assert_eq!(finding("1F81", 8, "AccessType=const\nDefaultValue=0x7F", &["2", "5"]), "");
        assert_eq!(finding("2000", 8, "AccessType=ro\nHighLimit=2\nDefaultValue=0", &["1", "2"]), "");
        assert_ne!(finding("2000", 8, "AccessType=ro\nHighLimit=0xFF\nDefaultValue=0", &["1", "2"]), "");
    }
}
