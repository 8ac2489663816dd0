use crate::rule::rule;
use crate::{Context, Report};
use edskit_model::Field;
use edskit_types::Index;

rule! {
    /// The device is the CANopen manager, but has no NMT start-up object
    ///
    /// ## What it does
    /// Reports `CANopenManager=1` in a file that does not describe 1F80h.
    ///
    /// ## Why is this bad
    /// 1F80h says how the manager starts the network. A device without it cannot be configured as one.
    ///
    /// ## Example
    /// ```dcf
    /// [DeviceComissioning]
    /// NodeID=1
    /// CANopenManager=1
    /// ```
    ///
    /// ## Use instead
    /// ```dcf
    /// [DeviceComissioning]
    /// NodeID=1
    /// CANopenManager=1
    ///
    /// [1F80]
    /// ParameterName=NMT start-up
    /// DataType=0x0007
    /// AccessType=rw
    /// DefaultValue=0
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 5; CiA 302-2.
    pub(crate) static MANAGER_WITHOUT_1F80 = {
        code: "DCF009",
        name: "manager-without-1f80",
        group: Configuration,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: File(check),
    }
}

/// NMT start-up.
const NMT_STARTUP: Index = Index(0x1F80);

fn check(context: &Context<'_>, report: &mut Report) {
    let Some(field) = context.sheet.commissioning().and_then(|section| section.canopen_manager()) else {
        return;
    };
    if Field::known(field) != Some(true) || context.sheet.object(NMT_STARTUP).is_some() {
        return;
    }
    report
        .add(field.span(), "the device is the CANopen manager, but has no object 1F80h")
        .help("write `CANopenManager=0`, or describe 1F80h");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn a_manager_has_1f80() {
        let text = |flag: &str| format!("[DeviceComissioning]\nCANopenManager={flag}\n");
        assert_eq!(
            findings(&MANAGER_WITHOUT_1F80, &text("0x1")),
            ["2:16 warning: the device is the CANopen manager, but has no object 1F80h"]
        );
        assert!(findings(&MANAGER_WITHOUT_1F80, &(text("1") + "[1F80]\n")).is_empty());
        assert!(findings(&MANAGER_WITHOUT_1F80, &text("0")).is_empty());
    }
}
