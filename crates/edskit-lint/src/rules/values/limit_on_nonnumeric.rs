use super::limits::{deletion, names, present};
use crate::rule::rule;
use crate::{Context, Report, Variable};
use edskit_model::{Field, Value};
use edskit_types::{DataType, DataTypeKind};

rule! {
    /// A limit stands on a type without an order
    ///
    /// ## What it does
    /// Reports `LowLimit` and `HighLimit` of a string or a DOMAIN, and limits of a BOOLEAN other than 0 and 1 (those
    /// only say what is true anyway; see `redundant-limits`).
    ///
    /// ## Why is this bad
    /// Texts and blocks of data have no order, so the limit means nothing. Some writers put the length there, some
    /// readers fail.
    ///
    /// ## Example
    /// ```eds
    /// [2000]
    /// ParameterName=Site
    /// DataType=0x0009
    /// LowLimit=0
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [2000]
    /// ParameterName=Site
    /// DataType=0x0009
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.6.3.2. Engineering judgement: the specification does not say which types have limits, but
    /// only numbers can be compared.
    pub(crate) static LIMIT_ON_NONNUMERIC = {
        code: "VAL005",
        name: "limit-on-nonnumeric",
        group: Values,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [EdsDcfCheck("VAL006"), Dcfchk("LowLimit not supported"), Dcfchk("HighLimit not supported")],
        check: Variable(check),
    }
}

fn check(_: &Context<'_>, variable: &Variable<'_>, report: &mut Report) {
    if variable.low_limit.is_none() && variable.high_limit.is_none() {
        return;
    }
    let Some(data_type) = variable.standard_type else { return };
    if !matches!(
        data_type.kind(),
        DataTypeKind::Boolean
            | DataTypeKind::VisibleString
            | DataTypeKind::OctetString
            | DataTypeKind::UnicodeString
            | DataTypeKind::Domain
    ) {
        return;
    }
    let reason = match data_type {
        DataType::Boolean if is_0_to_1(variable) => return,
        DataType::Boolean => "is 0 or 1",
        _ => "has no order",
    };
    let limits = present(variable);
    let finding =
        report.add(limits[0].entry.span(), format!("{} on {data_type}, which {reason}", names(&limits)));
    for limit in &limits[1..] {
        finding.label(limit.entry.span(), "and here");
    }
    finding.help("leave the limits out");
    if let Some(edits) = deletion(variable, &limits) {
        finding.unsafe_fix("Delete the limits", edits);
    }
}

/// Whether the limits of a BOOLEAN say no more than the type does.
fn is_0_to_1(variable: &Variable<'_>) -> bool {
    let says = |limit: Option<Field<'_, Value<'_>>>, border: bool| {
        limit.is_none_or(|limit| limit.value == Ok(Value::Boolean(border)))
    };
    says(variable.low_limit, false) && says(variable.high_limit, true)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn one_finding_for_both_limits() {
        let text = "[2000]\nDataType=0xF\nHighLimit=0xFF\nLowLimit=0\n[2001]\nDataType=9\nLowLimit=\nHighLimit=20\n[2002]\nDataType=5\nLowLimit=0\n";
        assert_eq!(
            findings(&LIMIT_ON_NONNUMERIC, text),
            [
                "3:1 warning: `HighLimit` and `LowLimit` on DOMAIN, which has no order",
                "8:1 warning: `HighLimit` on VISIBLE_STRING, which has no order"
            ]
        );
        assert_eq!(
            fixed(&LIMIT_ON_NONNUMERIC, text),
            "[2000]\nDataType=0xF\n[2001]\nDataType=9\nLowLimit=\n[2002]\nDataType=5\nLowLimit=0\n"
        );
    }

    #[test]
    fn a_boolean_from_0_to_1_is_harmless() {
        let limits =
            |limits: &str| findings(&LIMIT_ON_NONNUMERIC, &format!("[2000]\nDataType=1\n{limits}")).join("|");
        assert_eq!(limits("LowLimit=0\nHighLimit=0x1\n"), "");
        assert_eq!(limits("HighLimit=0xFFFF\n"), "3:1 warning: `HighLimit` on BOOLEAN, which is 0 or 1");
    }

    #[test]
    fn a_second_limit_would_come_to_light() {
        let text = "[2000]\nDataType=9\nLowLimit=1\nLowLimit=2\n";
        assert_eq!(fixed(&LIMIT_ON_NONNUMERIC, text), text);
    }
}
