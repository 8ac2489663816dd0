use super::sync_without_period::PERIOD;
use crate::evaluate::effective;
use crate::rule::rule;
use crate::{Context, Report};
use edskit_types::Index;

rule! {
    /// The synchronous window is longer than the SYNC period
    ///
    /// ## What it does
    /// Reports a synchronous window length (1007h) above the communication cycle period (1006h), if the period is not 0.
    ///
    /// ## Why is this bad
    /// Synchronous PDOs must be through before the window ends. One that ends after the next SYNC message limits nothing.
    ///
    /// ## Example
    /// ```eds
    /// [1006]
    /// ParameterName=Communication cycle period
    /// DataType=0x0007
    /// AccessType=rw
    /// DefaultValue=1000
    ///
    /// [1007]
    /// ParameterName=Synchronous window length
    /// DataType=0x0007
    /// AccessType=rw
    /// DefaultValue=5000
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1006]
    /// ParameterName=Communication cycle period
    /// DataType=0x0007
    /// AccessType=rw
    /// DefaultValue=10000
    ///
    /// [1007]
    /// ParameterName=Synchronous window length
    /// DataType=0x0007
    /// AccessType=rw
    /// DefaultValue=5000
    /// ```
    ///
    /// ## References
    /// Engineering judgement. CiA 301 v4.2 defines the two times in 7.5.2.6 and 7.5.2.7, and the second only makes sense within
    /// the first.
    pub(crate) static WINDOW_EXCEEDS_PERIOD = {
        code: "COM007",
        name: "window-exceeds-period",
        group: Communication,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let value = |index| {
        let value = effective(context.sheet, index, 0)?;
        Some((value.constant::<u32>()?, value.span()))
    };
    let Some((window, window_span)) = value(Index(0x1007)) else { return };
    let Some((period, period_span)) = value(PERIOD) else { return };
    if period == 0 || window <= period {
        return;
    }
    report
        .add(
            window_span,
            format!("the synchronous window of {window} µs is longer than the period of {period} µs"),
        )
        .here("the window")
        .label(period_span, "the period")
        .help(format!("write at most {period} in 1007h, or 0 for no window"));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn a_period_of_0_is_no_limit() {
        let found = |period: &str, window: &str| {
            let text = format!(
                "[1006]\nDataType=7\nDefaultValue={period}\n[1007]\nDataType=7\nDefaultValue={window}\n"
            );
            findings(&WINDOW_EXCEEDS_PERIOD, &text)
        };
        assert_eq!(
            found("1000", "0x3E9"),
            ["6:14 warning: the synchronous window of 1001 µs is longer than the period of 1000 µs"]
        );
        assert!(
            found("1000", "1000").is_empty() && found("0", "1000").is_empty() && found("", "1000").is_empty()
        );
    }
}
