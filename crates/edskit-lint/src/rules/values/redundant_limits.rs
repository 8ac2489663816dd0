use super::limits::{deletion, names, present};
use super::reading::Readings;
use crate::rule::rule;
use crate::{Context, Report, Variable};
use edskit_model::{Field, Value};
use edskit_types::NodeId;

rule! {
    /// The limits say no more than the data type
    ///
    /// ## What it does
    /// Reports limits of an integer or a BOOLEAN that are the smallest and the largest value of its data type.
    ///
    /// ## Why is this bad
    /// Nothing breaks. The two lines only look as if somebody had thought about the range.
    ///
    /// ## Example
    /// ```eds
    /// [2000]
    /// ParameterName=Speed
    /// DataType=0x0005
    /// LowLimit=0
    /// HighLimit=255
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [2000]
    /// ParameterName=Speed
    /// DataType=0x0005
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.6.3.2. Engineering judgement: limits are optional, and missing ones mean the same.
    pub(crate) static REDUNDANT_LIMITS = {
        code: "VAL012",
        name: "redundant-limits",
        group: Values,
        severity: Info,
        enabled: false,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: Variable(check),
    }
}

fn check(_: &Context<'_>, variable: &Variable<'_>, report: &mut Report) {
    if variable.low_limit.is_none() && variable.high_limit.is_none() {
        return;
    }
    let Some(data_type) = variable.standard_type else { return };
    let Some((low, high)) = data_type.range() else { return };
    let says = |limit: Option<Field<'_, Value<'_>>>, border: i128| {
        limit.is_none_or(|limit| {
            limit.known().is_some_and(|value| value.integer(data_type, None) == Ok(border))
        })
    };
    if !says(variable.low_limit, low) || !says(variable.high_limit, high) {
        return;
    }
    let limits = present(variable);
    let verb = if limits.len() == 1 { "says" } else { "say" };
    let finding = report
        .add(limits[0].entry.span(), format!("{} {verb} no more than {data_type} does", names(&limits)));
    for limit in &limits[1..] {
        finding.label(limit.entry.span(), "and here");
    }
    finding.help("leave the limits out, or write the range that the device accepts");
    if let Some(edits) = deletion(variable, &limits) {
        // Two's complement is not what every reader sees in a limit.
        let is_plain = |limit: &Field<'_, Value<'_>>| {
            let readings = limit.known().and_then(|value| Readings::of(value, data_type, NodeId::MIN));
            !readings.is_some_and(Readings::is_ambiguous)
        };
        if limits.iter().all(is_plain) {
            finding.safe_fix("Delete the limits", edits);
        } else {
            finding.unsafe_fix("Delete the limits", edits);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Applicability;
    use crate::testing::{findings, fixed, lint};
    use edskit_model::Datasheet;

    fn limits(data_type: u16, low: &str, high: &str) -> String {
        let text = format!("[2000]\nDataType={data_type}\nHighLimit={high}\nLowLimit={low}\n");
        findings(&REDUNDANT_LIMITS, &text).join("|")
    }

    #[test]
    fn both_ends_of_the_type() {
        let both = "3:1 info: `HighLimit` and `LowLimit` say no more than";
        assert_eq!(limits(3, "0x8000", "0x7FFF"), format!("{both} INTEGER16 does"));
        assert_eq!(limits(5, "0", "0xFF"), format!("{both} UNSIGNED8 does"));
        assert_eq!(limits(5, "", "0xFF"), "3:1 info: `HighLimit` says no more than UNSIGNED8 does");
        assert_eq!(limits(5, "0", "100"), "");
        assert_eq!(limits(3, "0", "0xFFFF"), "");
        assert_eq!(limits(1, "0", "0x1"), format!("{both} BOOLEAN does"));
        assert_eq!(limits(9, "0", "255"), "");
    }

    #[test]
    fn limits_that_readers_take_differently_are_not_safe_to_delete() {
        for (limits, applicability) in [
            ("LowLimit=-32768\nHighLimit=32767\n", Applicability::Safe),
            ("LowLimit=0x8000\nHighLimit=0x7FFF\n", Applicability::Unsafe),
        ] {
            let sheet = Datasheet::parse(format!("[2000]\nDataType=3\n{limits}").as_bytes());
            let finding = lint(&REDUNDANT_LIMITS, "a.eds", &sheet).remove(0);
            assert_eq!(finding.fix.unwrap().applicability, applicability, "{limits}");
        }
    }

    #[test]
    fn the_lines_are_taken_out() {
        assert_eq!(
            fixed(&REDUNDANT_LIMITS, "[2000]\nLowLimit=0\nDataType=5\nHighLimit=255"),
            "[2000]\nDataType=5\n"
        );
    }
}
