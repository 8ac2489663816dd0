use crate::described::is_known;
use crate::rule::rule;
use crate::{Context, Report};
use edskit_model::SectionKind;
use edskit_types::Index;

rule! {
    /// The device has neither heartbeat nor node guarding
    ///
    /// ## What it does
    /// Reports a file that describes 1000h, but neither the producer heartbeat time (1017h) nor guard time and life time factor
    /// (100Ch and 100Dh). One of the latter alone is left to COM011, and an object that only a list names to LST004.
    ///
    /// ## Why is this bad
    /// Nobody in the network can see that the device has failed.
    ///
    /// ## Example
    /// ```eds
    /// [1000]
    /// ParameterName=Device type
    /// DataType=0x0007
    /// AccessType=ro
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1000]
    /// ParameterName=Device type
    /// DataType=0x0007
    /// AccessType=ro
    ///
    /// [1017]
    /// ParameterName=Producer heartbeat time
    /// DataType=0x0006
    /// AccessType=rw
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.5.2.20: a device has heartbeat or node guarding.
    pub(crate) static NO_ERROR_CONTROL = {
        code: "COM010",
        name: "no-error-control",
        group: Communication,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: File(check),
    }
}

/// 100Ch: the guard time in ms.
pub(super) const GUARD_TIME: Index = Index(0x100C);
/// 100Dh: how many guard times pass before the master is taken for gone.
pub(super) const LIFE_TIME_FACTOR: Index = Index(0x100D);

fn check(context: &Context<'_>, report: &mut Report) {
    let sheet = context.sheet;
    let Some(device_type) = sheet.object(Index::DEVICE_TYPE) else { return };
    let objects = [Index::PRODUCER_HEARTBEAT, GUARD_TIME, LIFE_TIME_FACTOR];
    if objects.iter().any(|index| is_known(sheet, *index)) {
        return;
    }
    let place = sheet.section(SectionKind::OptionalObjects).unwrap_or(device_type.section());
    report
        .add(place.span(), "the device has neither heartbeat (1017h) nor node guarding (100Ch and 100Dh)")
        .help("describe 1017h, the producer heartbeat time");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn one_of_the_two_is_enough() {
        let found = |more: &str| findings(&NO_ERROR_CONTROL, &format!("[1000]\nDataType=7\n{more}"));
        assert_eq!(
            found("[OptionalObjects]\n1=0x1018\n"),
            ["3:1 warning: the device has neither heartbeat (1017h) nor node guarding (100Ch and 100Dh)"]
        );
        assert!(found("[1017]\n").is_empty());
        assert!(found("[100C]\n").is_empty());
        assert!(found("[OptionalObjects]\n1=0x1017\n").is_empty());
        assert!(findings(&NO_ERROR_CONTROL, "[1001]\n").is_empty());
    }
}
