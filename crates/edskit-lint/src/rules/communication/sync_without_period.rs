use crate::evaluate::{effective, node_ids};
use crate::rule::rule;
use crate::{Context, Report, Severity};
use edskit_types::Index;

rule! {
    /// A SYNC producer has no period
    ///
    /// ## What it does
    /// Reports a 1005h whose bit 30 makes the device produce the SYNC message, if 1006h does not exist, and, as an
    /// information, if it is 0.
    ///
    /// ## Why is this bad
    /// Without a period the device sends no SYNC message. Every synchronous PDO in the network waits for it.
    ///
    /// ## Example
    /// ```eds
    /// [1005]
    /// ParameterName=COB-ID SYNC
    /// DataType=0x0007
    /// AccessType=rw
    /// DefaultValue=0x40000080
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1005]
    /// ParameterName=COB-ID SYNC
    /// DataType=0x0007
    /// AccessType=rw
    /// DefaultValue=0x40000080
    ///
    /// [1006]
    /// ParameterName=Communication cycle period
    /// DataType=0x0007
    /// AccessType=rw
    /// DefaultValue=10000
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.5.2.5 and 7.5.2.6.
    pub(crate) static SYNC_WITHOUT_PERIOD = {
        code: "COM006",
        name: "sync-without-period",
        group: Communication,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: File(check),
    }
}

/// 1006h: the period of the SYNC message in µs.
pub(super) const PERIOD: Index = Index(0x1006);

fn check(context: &Context<'_>, report: &mut Report) {
    let Some(cob_id) = effective(context.sheet, Index::SYNC_COB_ID, 0) else { return };
    let Some(node_id) = node_ids(context).next() else { return };
    if !cob_id.cob_id_at(node_id).is_some_and(|cob_id| cob_id.bit30()) {
        return;
    }
    let period = effective(context.sheet, PERIOD, 0);
    let (severity, what) =
        match (context.sheet.object(PERIOD), period.and_then(|period| period.constant::<u32>())) {
            (None, _) => (Severity::Warning, "1006h does not exist"),
            // A client can still set one.
            (Some(_), Some(0)) => (Severity::Info, "the period in 1006h is 0"),
            _ => return,
        };
    let finding =
        report.add(cob_id.span(), format!("bit 30 of 1005h makes the device a SYNC producer, but {what}"));
    finding
        .severity(severity)
        .here("bit 30 is 1")
        .help("give 1006h a period in µs, or clear bit 30 of 1005h");
    if let Some(period) = period {
        finding.label(period.span(), "no SYNC message is sent");
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn a_producer_needs_a_period() {
        let found = |cob_id: &str, period: &str| {
            findings(&SYNC_WITHOUT_PERIOD, &format!("[1005]\nDataType=7\nDefaultValue={cob_id}\n{period}"))
        };
        assert_eq!(
            found("0x40000080", ""),
            ["3:14 warning: bit 30 of 1005h makes the device a SYNC producer, but 1006h does not exist"]
        );
        assert_eq!(
            found("0x40000080", "[1006]\nDataType=7\nDefaultValue=0x0\n"),
            ["3:14 info: bit 30 of 1005h makes the device a SYNC producer, but the period in 1006h is 0"]
        );
        assert!(found("0x40000080", "[1006]\nDataType=7\n").is_empty());
        assert!(found("0x40000080", "[1006]\nDataType=7\nDefaultValue=1000\n").is_empty());
        assert!(found("0x80000080", "").is_empty());
    }
}
