use super::formulas::{self, Place};
use crate::rule::rule;
use crate::{Context, Edit, Report};
use edskit_model::meant;
use edskit_model::{Entry, Formula, FormulaError, FormulaErrorKind};

rule! {
    /// A value holds `$NODEID` or the like, but is no formula
    ///
    /// ## What it does
    /// Reports values that are meant to depend on the node-ID but are not `$NODEID` plus numbers: other operators, other
    /// variables, a misspelt name, a second `$NODEID`, and `$NODEID` in a key that is a plain number.
    ///
    /// ## Why is this bad
    /// No reader can tell the value. Some stop, some take the first number that they find.
    ///
    /// ## Example
    /// ```eds
    /// [1800sub1]
    /// DataType=0x0007
    /// DefaultValue=$NODE_ID+0x180
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1800sub1]
    /// DataType=0x0007
    /// DefaultValue=$NODEID+0x180
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.3.
    pub(crate) static NODEID_BAD_EXPRESSION = {
        code: "SYN022",
        name: "nodeid-bad-expression",
        group: Syntax,
        severity: Error,
        since: "0.1.0",
        files: ALL_FILES,
        peers: [
            EdsDcfCheck("FRM001"), EdsDcfCheck("FRM005"),
            Dcfchk("invalid DefaultValue, ParameterValue, LowLimit or HighLimit"),
        ],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for (entry, place) in formulas::entries(context) {
        if place == Place::Number {
            let message = format!("`{}={}` cannot depend on the node-ID", entry.key_text(), entry.text());
            report
                .add(entry.value_span(), message)
                .help("write a number; only the values and the limits of objects may be formulas");
        } else if let Err(error) = Formula::parse(entry.raw()) {
            bad(entry, error, report);
        }
    }
}

fn bad(entry: Entry<'_>, error: FormulaError, report: &mut Report) {
    let raw = entry.raw();
    let value = entry.value_span();
    let text = entry.text();
    let message = if raw.contains(&b'$') {
        format!("`{text}` is not a formula: {error}")
    } else {
        format!("`{text}` is not a formula: the node-ID is written `$NODEID`")
    };
    let span = value.sub(error.span.start as usize, error.span.len());
    let finding = report.add(if span.is_empty() { value } else { span }, message);
    match meant::formula(raw).or_else(|| with_plus(raw, error)) {
        Some(formula) => {
            finding
                .help(format!("write `{}={formula}`", entry.key_text()))
                .unsafe_fix(format!("Write `{formula}`"), vec![Edit::replace(value, formula.to_string())]);
        }
        None => {
            finding.help("the only form is `$NODEID+number`; the sum may have more than one number");
        }
    }
}

/// The formula with the `+` that is missing behind `$NODEID`, or without one that is too much at the end.
fn with_plus(raw: &[u8], error: FormulaError) -> Option<Formula> {
    let (before, after) = raw.split_at(error.span.start as usize);
    match error.kind {
        FormulaErrorKind::Operator => Formula::parse(&[before, b"+", after].concat()).ok(),
        FormulaErrorKind::Term(_) if after.trim_ascii().is_empty() => {
            Formula::parse(before.trim_ascii_end().strip_suffix(b"+")?).ok()
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    fn value(text: &str) -> String {
        format!("[1800sub1]\nDataType=0x7\nDefaultValue={text}\n")
    }

    #[test]
    fn what_is_wrong_is_told_and_placed() {
        for (text, message) in [
            (
                "$NODEID*2+0x180",
                "3:21 error: `$NODEID*2+0x180` is not a formula: only `+` may follow $NODEID",
            ),
            ("$NODEID-1", "3:21 error: `$NODEID-1` is not a formula: only `+` may follow $NODEID"),
            ("$NODEID+$NODEID", "3:22 error: `$NODEID+$NODEID` is not a formula: $NODEID stands twice"),
            ("$MASTER+1", "3:14 error: `$MASTER+1` is not a formula: the only variable is $NODEID"),
            ("NODEID+1", "3:14 error: `NODEID+1` is not a formula: the node-ID is written `$NODEID`"),
            ("$NODEID+", "3:14 error: `$NODEID+` is not a formula: a term is missing beside `+`"),
        ] {
            assert_eq!(findings(&NODEID_BAD_EXPRESSION, &value(text)), [message]);
        }
        assert_eq!(
            findings(&NODEID_BAD_EXPRESSION, "[DeviceInfo]\nVendorNumber=$NODEID+1\n"),
            ["2:14 error: `VendorNumber=$NODEID+1` cannot depend on the node-ID"]
        );
    }

    #[test]
    fn slips_are_mended() {
        for (wrong, right) in [
            ("NODEID+0x180", "$NODEID+0x180"),
            ("{NodeID}+0x5", "$NODEID+0x5"),
            ("$NODEID 0x180", "$NODEID+0x180"),
            ("$NODEID0x180", "$NODEID+0x180"),
            ("$NODEID+180h", "$NODEID+0x180"),
            ("$NODEID+0x180+", "$NODEID+0x180"),
            ("$NODEID-1", "$NODEID-1"),
        ] {
            assert_eq!(fixed(&NODEID_BAD_EXPRESSION, &value(wrong)), value(right));
        }
    }

    #[test]
    fn formulas_and_texts_are_fine() {
        for text in ["$NODEID+0x100+0x80", "0x180+$nodeid", "$FF", "0x5"] {
            assert_eq!(findings(&NODEID_BAD_EXPRESSION, &value(text)), [""; 0]);
        }
        assert_eq!(findings(&NODEID_BAD_EXPRESSION, "[Tool1]\nCommand=a $DCF $NODEID\n[1000]\n"), [""; 0]);
    }
}
