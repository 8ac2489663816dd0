use super::formulas;
use crate::rule::rule;
use crate::{Context, Edit, Report};

rule! {
    /// `$NODEID` does not stand first in a formula
    ///
    /// ## What it does
    /// Reports formulas whose number stands before `$NODEID`.
    ///
    /// ## Why is this bad
    /// By CiA 306 such a text is no formula at all. Some readers understand it, some refuse it, and some take the number
    /// alone, so that every node gets the same COB-ID.
    ///
    /// ## Example
    /// ```eds
    /// [1800sub1]
    /// DataType=0x0007
    /// DefaultValue=0x180+$NODEID
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
    pub(crate) static NODEID_NOT_FIRST = {
        code: "SYN020",
        name: "nodeid-not-first",
        group: Syntax,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [
            EdsDcfCheck("FRM002"), Dcfchk("invalid DefaultValue, ParameterValue, LowLimit or HighLimit"),
        ],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for (entry, formula) in formulas::understood(context) {
        if formula.style().variable_not_first {
            report
                .add(entry.value_span(), format!("`$NODEID` does not stand first in `{}`", entry.text()))
                .help(format!("write `{}={formula}`", entry.key_text()))
                .safe_fix(
                    "Write `$NODEID` first",
                    vec![Edit::replace(entry.value_span(), formula.to_string())],
                );
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn the_order_is_turned() {
        let text = "[1800sub1]\nDataType=0x7\nDefaultValue=0x100 + $NodeId+0x80\nLowLimit=$NODEID\n";
        assert_eq!(
            findings(&NODEID_NOT_FIRST, text),
            ["3:14 error: `$NODEID` does not stand first in `0x100 + $NodeId+0x80`"]
        );
        assert_eq!(
            fixed(&NODEID_NOT_FIRST, text),
            "[1800sub1]\nDataType=0x7\nDefaultValue=$NODEID+0x180\nLowLimit=$NODEID\n"
        );
    }
}
