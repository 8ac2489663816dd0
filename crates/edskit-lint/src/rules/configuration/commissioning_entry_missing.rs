use crate::rule::rule;
use crate::{Context, FileKind, Report, Severity};
use edskit_model::KeyName;

rule! {
    /// `[DeviceComissioning]` lacks an entry
    ///
    /// ## What it does
    /// Reports what a DCF must say in `[DeviceComissioning]` and does not: a missing or empty `NodeID` or `Baudrate` is
    /// a warning, a missing `NodeName`, `NetNumber`, `NetworkName` or `LSS_SerialNumber` an information. Those may be
    /// empty: many devices have no name.
    ///
    /// ## Why is this bad
    /// Without node-ID and bit rate the device cannot be put into its network. The others are names and numbers for
    /// people and for layer setting services.
    ///
    /// ## Example
    /// ```dcf
    /// [DeviceComissioning]
    /// NodeName=Drive left
    /// Baudrate=500
    /// NetNumber=1
    /// NetworkName=Line 1
    /// LSS_SerialNumber=0
    /// ```
    ///
    /// ## Use instead
    /// ```dcf
    /// [DeviceComissioning]
    /// NodeID=5
    /// NodeName=Drive left
    /// Baudrate=500
    /// NetNumber=1
    /// NetworkName=Line 1
    /// LSS_SerialNumber=0
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.2 and 5.
    pub(crate) static COMMISSIONING_ENTRY_MISSING = {
        code: "DCF011",
        name: "commissioning-entry-missing",
        group: Configuration,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [EdsDcfCheck("MND002"), EdsDcfCheck("DCF001")],
        check: File(check),
    }
}

const NEEDED: [KeyName; 2] = [KeyName::NodeId, KeyName::Baudrate];
const OTHERS: [KeyName; 4] =
    [KeyName::NodeName, KeyName::NetNumber, KeyName::NetworkName, KeyName::LssSerialNumber];

fn check(context: &Context<'_>, report: &mut Report) {
    let Some(section) = context.sheet.commissioning().filter(|_| context.kind == FileKind::Dcf) else {
        return;
    };
    let needed: Vec<KeyName> = NEEDED.into_iter().filter(|key| section.filled(*key).is_none()).collect();
    let others: Vec<KeyName> = OTHERS.into_iter().filter(|key| section.entry(*key).is_none()).collect();
    for (missing, severity) in [(needed, Severity::Warning), (others, Severity::Info)] {
        let names: Vec<String> = missing.iter().map(|key| format!("`{}`", key.spelling())).collect();
        let [before @ .., last] = &names[..] else { continue };
        let is_alone = before.is_empty();
        let names = if before.is_empty() { last.clone() } else { format!("{} or {last}", before.join(", ")) };
        let alone = section.entry(missing[0]).filter(|_| is_alone);
        let place = alone.map_or(section.span(), |empty| empty.span());
        let finding = report.add(place, format!("`[{}]` has no {names}", section.name()));
        finding.severity(severity);
        for entry in missing.iter().filter_map(|key| section.entry(*key)).filter(|_| !is_alone) {
            finding.label(entry.span(), "empty, which counts as missing");
        }
        finding.help("add what is missing");
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, findings_in};

    #[test]
    fn what_is_needed_and_what_is_nice_to_have() {
        let text = "[DeviceComissioning]\nNodeID=\nBaudrate=500\nNetNumber=\n";
        assert_eq!(
            findings_in(&COMMISSIONING_ENTRY_MISSING, "a.dcf", text.as_bytes()),
            [
                "1:1 info: `[DeviceComissioning]` has no `NodeName`, `NetworkName` or `LSS_SerialNumber`",
                "2:1 warning: `[DeviceComissioning]` has no `NodeID`"
            ]
        );
        assert!(findings(&COMMISSIONING_ENTRY_MISSING, text).is_empty());
    }
}
