use super::formulas;
use crate::rule::rule;
use crate::wording::series;
use crate::{Context, Edit, Report, Severity};
use edskit_model::{Number, Radix};

rule! {
    /// A formula is written so that not every reader understands it
    ///
    /// ## What it does
    /// Reports formulas with `$NODEID` in other letters than capitals or with blanks around `+`; and, as an info, with a
    /// decimal offset.
    ///
    /// ## Why is this bad
    /// Readers that compare the text do not find `$NODEID` in `$NodeID`, or fail at the blanks. CANFestival reads the
    /// offset as hexadecimal in any case: to it `$NODEID+384` is `$NODEID+0x384`.
    ///
    /// ## Example
    /// ```eds
    /// [1800sub1]
    /// DataType=0x0007
    /// DefaultValue=$NodeID + 0x180
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
    /// CiA 306 v1.3, 4.3. Engineering judgement for the decimal offset, which the standard allows.
    pub(crate) static NODEID_STYLE = {
        code: "SYN021",
        name: "nodeid-style",
        group: Syntax,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for (entry, formula) in formulas::understood(context) {
        let style = formula.style();
        // The fix of SYN020 mends the style as well.
        if style.variable_not_first {
            continue;
        }
        let mut oddities = Vec::new();
        if style.variable_case {
            oddities.push("`$NODEID` is not in capitals".to_owned());
        }
        if style.blanks {
            oddities.push("blanks stand around `+`".to_owned());
        }
        let portable = oddities.is_empty();
        if style.decimal && entry.raw().split(|&byte| byte == b'+').any(is_ambiguous) {
            oddities.push("the offset is decimal".to_owned());
        }
        if oddities.is_empty() {
            continue;
        }
        let message = format!("the formula `{}` is not portable: {}", entry.text(), series(&oddities, "and"));
        let finding = report.add(entry.value_span(), message);
        if portable {
            finding.severity(Severity::Info);
        }
        finding.help(format!("write `{}={formula}`", entry.key_text())).safe_fix(
            "Write it in the usual form",
            vec![Edit::replace(entry.value_span(), formula.to_string())],
        );
    }
}

/// Whether a term is a decimal number with another value in hexadecimal.
fn is_ambiguous(term: &[u8]) -> bool {
    let number = Number::parse(term.trim_ascii());
    number.is_ok_and(|number| number.radix() == Radix::Decimal && number.value() > 9)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn each_oddity_is_told() {
        let text = "[1800sub1]\nDataType=0x7\nDefaultValue=$nodeid+128\nLowLimit=$NODEID +0x1\nHighLimit=$NODEID+384\n";
        assert_eq!(
            findings(&NODEID_STYLE, text),
            [
                "3:14 warning: the formula `$nodeid+128` is not portable: `$NODEID` is not in capitals and the offset is decimal",
                "4:10 warning: the formula `$NODEID +0x1` is not portable: blanks stand around `+`",
                "5:11 info: the formula `$NODEID+384` is not portable: the offset is decimal",
            ]
        );
        assert_eq!(
            fixed(&NODEID_STYLE, text),
            "[1800sub1]\nDataType=0x7\nDefaultValue=$NODEID+0x80\nLowLimit=$NODEID+0x1\nHighLimit=$NODEID+0x180\n"
        );
    }

    #[test]
    fn what_is_fine_or_reported_elsewhere() {
        for value in
            ["$NODEID", "$NODEID+0x180", "$NODEID+0x100+0x80", "$NODEID+5", "384 + $NodeID", "$NODEID*2"]
        {
            let text = format!("[1800sub1]\nDataType=0x7\nDefaultValue={value}\n");
            assert_eq!(findings(&NODEID_STYLE, &text), [""; 0]);
        }
    }
}
