use super::low_above_high::contradict;
use super::reading::{Readings, Role, each_value, fits, name, node_ids, shown};
use crate::rule::rule;
use crate::{Context, Report, Variable};
use edskit_model::{Entry, Field, Value};
use edskit_types::{DataType, Index, NodeId};

rule! {
    /// A value is outside its own limits
    ///
    /// ## What it does
    /// Reports a `DefaultValue` or `ParameterValue` below the `LowLimit` or above the `HighLimit` of the same section.
    /// Hexadecimal of signed types is read as written and as two's complement; only where the value is outside under
    /// both readings is there a finding. Of 1010h and 1011h nothing is reported: what is read there is not what may be
    /// written.
    ///
    /// ## Why is this bad
    /// The device refuses the value when it is written (abort codes 0609 0031h and 0609 0032h), so it cannot be set
    /// back to what the file calls its default.
    ///
    /// ## Example
    /// ```eds
    /// [2000]
    /// ParameterName=Speed
    /// DataType=0x0006
    /// DefaultValue=4587
    /// LowLimit=0
    /// HighLimit=0x1000
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [2000]
    /// ParameterName=Speed
    /// DataType=0x0006
    /// DefaultValue=4000
    /// LowLimit=0
    /// HighLimit=0x1000
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.6.3.2.
    pub(crate) static VALUE_OUTSIDE_LIMITS = {
        code: "VAL004",
        name: "value-outside-limits",
        group: Values,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [
            CanChkEds("22"), EdsDcfCheck("VAL003"), EdsDcfCheck("VAL004"), Dcfchk("underflow"),
            Dcfchk("overflow"),
        ],
        check: Variable(check),
    }
}

fn check(context: &Context<'_>, variable: &Variable<'_>, report: &mut Report) {
    // The usual case, before anything is copied.
    if variable.low_limit.is_none() && variable.high_limit.is_none() && !variable.has_own_type {
        return;
    }
    let [low, high] = variable.range();
    let (low, high) = (variable.low_limit.or(low), variable.high_limit.or(high));
    if low.is_none() && high.is_none() {
        return;
    }
    let Some(data_type) = variable.standard_type.filter(|data_type| data_type.is_numeric()) else { return };
    if HAS_SIGNATURE.contains(&variable.index) {
        return;
    }
    let limits = Limits { low: Limit::of(low), high: Limit::of(high) };
    let node_ids = node_ids(context);
    each_value(context, variable, |role, field| {
        if let (Role::Value, Some(value)) = (role, field.known())
            && node_ids.into_iter().all(|node_id| limits.exclude(value, data_type, node_id))
            && node_ids.into_iter().all(|node_id| fits(value, data_type, node_id))
            && !limits.are_wrong(data_type, node_ids)
        {
            report_value(field, value, &limits, data_type, node_ids[0], report);
        }
    });
}

/// Objects whose limits are about the signature that is written, while the value is what is read.
const HAS_SIGNATURE: [Index; 2] = [Index::STORE_PARAMETERS, Index::RESTORE_PARAMETERS];

/// A limit that can be read.
#[derive(Clone, Copy)]
struct Limit<'a> {
    entry: Entry<'a>,
    value: Value<'a>,
}

impl<'a> Limit<'a> {
    fn of(field: Option<Field<'a, Value<'a>>>) -> Option<Self> {
        let field = field?;
        Some(Self { entry: field.entry, value: field.known()? })
    }
}

struct Limits<'a> {
    low: Option<Limit<'a>>,
    high: Option<Limit<'a>>,
}

impl Limits<'_> {
    /// Whether a value is outside under every reading.
    fn exclude(&self, value: Value<'_>, data_type: DataType, node_id: NodeId) -> bool {
        let read = |value| Readings::of(value, data_type, node_id).map(Readings::all);
        let Some(values) = read(value) else { return false };
        let low = self.low.and_then(|low| read(low.value));
        let high = self.high.and_then(|high| read(high.value));
        (0..values.len()).all(|kind| {
            low.is_some_and(|low| values[kind] < low[kind])
                || high.is_some_and(|high| values[kind] > high[kind])
        })
    }

    /// Whether the limits exclude each other, which VAL003 reports, or one of them is outside the data type, which
    /// VAL002 reports.
    fn are_wrong(&self, data_type: DataType, node_ids: [NodeId; 2]) -> bool {
        let misfit =
            |limit: Option<Limit<'_>>| limit.is_some_and(|limit| !fits(limit.value, data_type, node_ids[0]));
        misfit(self.low)
            || misfit(self.high)
            || self
                .low
                .zip(self.high)
                .is_some_and(|(low, high)| contradict(low.value, high.value, data_type, node_ids))
    }
}

#[cold]
fn report_value(
    field: Field<'_, Value<'_>>,
    value: Value<'_>,
    limits: &Limits<'_>,
    data_type: DataType,
    node_id: NodeId,
    report: &mut Report,
) {
    let read = |value| Readings::of(value, data_type, node_id).map(|readings| readings.as_bits);
    let Some(meaning) = read(value) else { return };
    let low = limits.low.and_then(|low| Some((low.entry, read(low.value)?)));
    let high = limits.high.and_then(|high| Some((high.entry, read(high.value)?)));
    let above = high.filter(|(_, high)| meaning > *high);
    let Some((limit, bound)) = above.or(low) else { return };
    let side = if above.is_some() { "above" } else { "below" };
    let allowed = match (low, high) {
        (Some((_, low)), Some((_, high))) if low == high => format!("{low}"),
        (Some((_, low)), Some((_, high))) => format!("a value from {low} to {high}"),
        (Some((_, low)), None) => format!("a value of at least {low}"),
        (None, Some((_, high))) => format!("a value of at most {high}"),
        (None, None) => return,
    };
    let message = format!(
        "{} {} is {side} {} {}",
        name(field.entry),
        shown(field.entry, meaning),
        name(limit),
        shown(limit, bound)
    );
    report
        .add(field.span(), message)
        .label(limit.value_span(), "the limit")
        .help(format!("write {allowed}, or correct the limit"));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    fn value(data_type: u16, value: &str, low: &str, high: &str) -> String {
        let text =
            format!("[2000]\nDataType={data_type}\nDefaultValue={value}\nLowLimit={low}\nHighLimit={high}\n");
        findings(&VALUE_OUTSIDE_LIMITS, &text).join("|")
    }

    #[test]
    fn both_limits_are_looked_at() {
        assert_eq!(value(5, "9", "10", ""), "3:14 warning: `DefaultValue` `9` is below `LowLimit` `10`");
        assert_eq!(
            value(5, "0x0B", "", "0xA"),
            "3:14 warning: `DefaultValue` `0x0B` (11) is above `HighLimit` `0xA` (10)"
        );
        assert_eq!(value(5, "10", "10", "10"), "");
    }

    #[test]
    fn a_signature_is_not_what_is_read() {
        let text = "[1010sub1]\nDataType=7\nDefaultValue=1\nLowLimit=0x65766173\nHighLimit=0x65766173\n";
        assert_eq!(findings(&VALUE_OUTSIDE_LIMITS, text), [""; 0]);
    }

    #[test]
    fn signed_hexadecimal_gets_the_benefit_of_the_doubt() {
        assert_eq!(value(3, "0xFF9C", "-100", "100"), "");
        assert_eq!(value(3, "0xFF9C", "0x8000", "0x7FFF"), "");
        assert_eq!(value(3, "0xFF9C", "0", "0xFFFF"), "");
        assert_eq!(
            value(3, "0xFF9C", "0", "100"),
            "3:14 warning: `DefaultValue` `0xFF9C` (-100) is below `LowLimit` `0`"
        );
        assert_eq!(
            value(3, "-1", "0", "0xFFFF"),
            "3:14 warning: `DefaultValue` `-1` is below `LowLimit` `0`"
        );
    }

    #[test]
    fn reals_are_compared_as_the_device_holds_them() {
        assert_eq!(value(8, "0.1", "0x3DCCCCCD", "1"), "");
        assert_eq!(
            value(8, "0.05", "0x3DCCCCCD", "1"),
            "3:14 warning: `DefaultValue` `0.05` is below `LowLimit` `0x3DCCCCCD` (0.1)"
        );
        assert_eq!(value(8, "50", "0", "0x64"), "");
    }

    #[test]
    fn formulas_must_be_outside_for_every_node() {
        assert_eq!(value(7, "$NODEID", "1", "99"), "");
        assert_eq!(
            value(7, "$NODEID+0x200", "1", "99"),
            "3:14 warning: `DefaultValue` `$NODEID+0x200` is above `HighLimit` `99`"
        );
    }

    #[test]
    fn one_defect_gives_one_finding() {
        assert_eq!(value(5, "300", "0", "255"), "", "VAL002");
        assert_eq!(value(5, "7", "5", "1"), "", "VAL003");
        assert_eq!(value(5, "7", "300", ""), "", "VAL002");
        assert_eq!(value(9, "7", "8", "9"), "", "VAL005");
    }
}
