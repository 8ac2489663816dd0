use super::no_error_control::{GUARD_TIME, LIFE_TIME_FACTOR};
use crate::rule::rule;
use crate::{Context, Report};

rule! {
    /// Node guarding is described by half
    ///
    /// ## What it does
    /// Reports a guard time (100Ch) without a life time factor (100Dh), and the reverse.
    ///
    /// ## Why is this bad
    /// The life time of the node is the product of the two. A master that configures node guarding writes both, and fails at
    /// the one that is missing.
    ///
    /// ## Example
    /// ```eds
    /// [100C]
    /// ParameterName=Guard time
    /// DataType=0x0006
    /// AccessType=rw
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [100C]
    /// ParameterName=Guard time
    /// DataType=0x0006
    /// AccessType=rw
    ///
    /// [100D]
    /// ParameterName=Life time factor
    /// DataType=0x0005
    /// AccessType=rw
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.2.8.3.2.1 and 7.5.2.
    pub(crate) static GUARD_PAIR = {
        code: "COM011",
        name: "guard-pair",
        group: Communication,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let sheet = context.sheet;
    let (there, missing, data_type) = match (sheet.object(GUARD_TIME), sheet.object(LIFE_TIME_FACTOR)) {
        (Some(guard_time), None) => (guard_time, "the life time factor (100Dh)", "UNSIGNED8"),
        (None, Some(factor)) => (factor, "the guard time (100Ch)", "UNSIGNED16"),
        _ => return,
    };
    report
        .add(there.span(), format!("{} is of no use without {missing}", there.index()))
        .help(format!("describe {missing}, a VAR of {data_type}, or drop this object"));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn one_needs_the_other() {
        assert_eq!(
            findings(&GUARD_PAIR, "[100C]\n"),
            ["1:1 warning: 100Ch is of no use without the life time factor (100Dh)"]
        );
        assert_eq!(
            findings(&GUARD_PAIR, "[100D]\n"),
            ["1:1 warning: 100Dh is of no use without the guard time (100Ch)"]
        );
        assert!(findings(&GUARD_PAIR, "[100D]\n[100C]\n").is_empty());
    }
}
