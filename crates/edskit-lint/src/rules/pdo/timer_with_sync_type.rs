use crate::rule::rule;
use crate::{Context, Report};
use edskit_types::{PdoDirection, Transmission};

rule! {
    /// An event timer has no effect
    ///
    /// ## What it does
    /// Reports an event timer (sub-index 05h) other than 0 of a TPDO that is sent cyclically with SYNC or on remote
    /// request only.
    ///
    /// ## Why is this bad
    /// The event timer sends a TPDO of type 254 or 255 again after so many milliseconds. For the other types it does
    /// nothing, so either the timer or the type is not what was meant.
    ///
    /// ## Example
    /// ```eds
    /// [1800]
    /// ParameterName=TPDO 1 communication parameter
    /// ObjectType=0x9
    /// SubNumber=6
    ///
    /// [1800sub2]
    /// ParameterName=Transmission type
    /// DataType=0x0005
    /// DefaultValue=1
    ///
    /// [1800sub5]
    /// ParameterName=Event timer
    /// DataType=0x0006
    /// DefaultValue=100
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1800]
    /// ParameterName=TPDO 1 communication parameter
    /// ObjectType=0x9
    /// SubNumber=6
    ///
    /// [1800sub2]
    /// ParameterName=Transmission type
    /// DataType=0x0005
    /// DefaultValue=254
    ///
    /// [1800sub5]
    /// ParameterName=Event timer
    /// DataType=0x0006
    /// DefaultValue=100
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.5.2.37.
    pub(crate) static TIMER_WITH_SYNC_TYPE = {
        code: "PDO016",
        name: "timer-with-sync-type",
        group: Pdo,
        severity: Info,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for pdo in context.pdos().iter().filter(|pdo| pdo.direction == PdoDirection::Transmit) {
        let how = match pdo.transmission() {
            Some(Transmission::SynchronousCyclic(_)) => "with SYNC",
            Some(Transmission::RtrSynchronous | Transmission::RtrEvent) => "on request",
            _ => continue,
        };
        let (Some(timer), Some(kind)) = (pdo.parameter(5), pdo.transmission_type) else { continue };
        let Some(time @ 1..) = timer.constant::<u16>() else { continue };
        report
            .add(timer.span(), format!("{pdo} has an event timer of {time} ms, but is sent {how}"))
            .label(kind.span(), "the transmission type")
            .help("write 0 here, or 254 or 255 there");
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    fn found(index: &str, kind: &str, timer: &str) -> Vec<String> {
        let text = format!(
            "[{index}]\nObjectType=9\n[{index}sub2]\nDataType=5\nDefaultValue={kind}\n[{index}sub5]\nDataType=6\nDefaultValue={timer}\n"
        );
        findings(&TIMER_WITH_SYNC_TYPE, &text)
    }

    #[test]
    fn timers_belong_to_events() {
        assert_eq!(
            found("1800", "240", "20"),
            ["8:14 info: TPDO1 has an event timer of 20 ms, but is sent with SYNC"]
        );
        assert_eq!(
            found("1801", "253", "20"),
            ["8:14 info: TPDO2 has an event timer of 20 ms, but is sent on request"]
        );
        assert!(found("1800", "254", "20").is_empty() && found("1800", "1", "0").is_empty());
        assert!(found("1400", "1", "20").is_empty(), "an RPDO may be monitored whatever its type is");
        assert!(found("1800", "0", "20").is_empty(), "an event may be what makes it due");
    }
}
