use crate::rule::rule;
use crate::{Context, Edit, Report};
use edskit_model::{KeyName, Span};
use edskit_types::Index;

rule! {
    /// GroupMessaging and the multiplexed PDOs contradict each other
    ///
    /// ## What it does
    /// Reports `GroupMessaging=1` in a file without a multiplexed PDO, and `GroupMessaging=0` in a file with one. A PDO
    /// is multiplexed where sub-index 00h of its mapping is 254 or 255; the lists of scanned and dispatched objects
    /// (1FA0h to 1FFFh) tell of one too.
    ///
    /// ## Why is this bad
    /// The entry says whether the device supports multiplexed PDOs. A tool that believes it offers too much, or takes
    /// the frames for plain PDOs.
    ///
    /// ## Example
    /// ```eds
    /// [DeviceInfo]
    /// GroupMessaging=0
    ///
    /// [1A00]
    /// ParameterName=TPDO 1 mapping parameter
    /// ObjectType=0x9
    /// SubNumber=1
    ///
    /// [1A00sub0]
    /// DataType=0x0005
    /// DefaultValue=255
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [DeviceInfo]
    /// GroupMessaging=1
    ///
    /// [1A00]
    /// ParameterName=TPDO 1 mapping parameter
    /// ObjectType=0x9
    /// SubNumber=1
    ///
    /// [1A00sub0]
    /// DataType=0x0005
    /// DefaultValue=255
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.5; CiA 301 v4.2, 7.5.2.36 and 7.5.2.38.
    pub(crate) static GROUP_MESSAGING = {
        code: "PDO022",
        name: "group-messaging",
        group: Pdo,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("73")],
        check: File(check),
    }
}

/// The first and the last index of the lists of scanned and dispatched objects (CiA 302).
const LISTS: [Index; 2] = [Index(0x1FA0), Index(0x1FFF)];

fn check(context: &Context<'_>, report: &mut Report) {
    let entry = context.sheet.device_info().and_then(|info| info.filled(KeyName::GroupMessaging));
    let Some(field) = entry.map(|entry| entry.flag()) else { return };
    match (field.known(), multiplexed(context)) {
        (Some(true), None) => {
            report
                .add(field.span(), "GroupMessaging is 1, but no PDO is multiplexed")
                .help("write `GroupMessaging=0`, or set sub-index 00h of the mapping to 254 or 255")
                .unsafe_fix("Write 0", vec![Edit::replace(field.span(), "0")]);
        }
        (Some(false), Some((span, what))) => {
            report
                .add(field.span(), format!("GroupMessaging is 0, but {what}"))
                .label(span, "this needs multiplexed PDOs")
                .help("write `GroupMessaging=1`")
                .unsafe_fix("Write 1", vec![Edit::replace(field.span(), "1")]);
        }
        _ => {}
    }
}

/// What tells that the device has a multiplexed PDO.
fn multiplexed(context: &Context<'_>) -> Option<(Span, String)> {
    let count = context.pdos().iter().find_map(|pdo| {
        let value = pdo.count.filter(|count| matches!(count.constant(), Some(254_u8 | 255)))?;
        Some((value.span(), format!("{pdo} is multiplexed")))
    });
    count.or_else(|| {
        let list = context.sheet.objects_in(LISTS[0]..=LISTS[1]).next()?;
        Some((list.span(), format!("{} lists objects of multiplexed PDOs", list.index())))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    fn text(flag: &str, rest: &str) -> String {
        format!("[DeviceInfo]\nGroupMessaging={flag}\n{rest}")
    }

    #[test]
    fn both_or_none() {
        let pdo = "[1600]\nObjectType=9\n[1600sub0]\nDataType=5\nDefaultValue=0xFE\n";
        let list = "[1FA0]\nObjectType=8\n";
        assert_eq!(
            findings(&GROUP_MESSAGING, &text("0", pdo)),
            ["2:16 warning: GroupMessaging is 0, but RPDO1 is multiplexed"]
        );
        assert_eq!(
            findings(&GROUP_MESSAGING, &text("0", list)),
            ["2:16 warning: GroupMessaging is 0, but 1FA0h lists objects of multiplexed PDOs"]
        );
        assert_eq!(
            findings(&GROUP_MESSAGING, &text("1", "")),
            ["2:16 warning: GroupMessaging is 1, but no PDO is multiplexed"]
        );
        for fine in [text("1", pdo), text("1", list), text("0", ""), text("", pdo), text("x", pdo)] {
            assert!(findings(&GROUP_MESSAGING, &fine).is_empty(), "{fine}");
        }
        assert_eq!(fixed(&GROUP_MESSAGING, &text("0", pdo)), text("1", pdo));
    }
}
