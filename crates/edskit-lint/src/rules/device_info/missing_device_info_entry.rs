use super::{identity, pdos};
use crate::missing::Missing;
use crate::rule::rule;
use crate::{Context, Report, Severity};
use edskit_model::{Datasheet, KeyName};
use edskit_types::PdoDirection;

rule! {
    /// A mandatory entry of `[DeviceInfo]` is missing
    ///
    /// ## What it does
    /// Reports which of the mandatory entries of `[DeviceInfo]` are absent or empty, all in one finding. If only the
    /// names `VendorName`, `ProductName` and `OrderCode` are, the finding is an info. The bit rates, of which the
    /// specification's own example lists only some, have a rule of their own.
    ///
    /// ## Why is this bad
    /// A reader has to guess: may the mapping be changed, does the device speak LSS, how many PDOs are there. The
    /// numbers of vendor, product and revision are how a tool finds the file for a device on the bus. The names are
    /// read by people only, and half of the files in use lack the order code.
    ///
    /// ## Example
    /// ```eds
    /// [DeviceInfo]
    /// VendorName=Nordlicht
    /// VendorNumber=0x000003F5
    /// ProductName=Pump controller
    /// ProductNumber=7
    /// RevisionNumber=0x00010002
    /// OrderCode=
    /// SimpleBootUpMaster=0
    /// SimpleBootUpSlave=1
    /// DynamicChannelsSupported=0
    /// GroupMessaging=0
    /// NrOfRXPDO=0
    /// NrOfTXPDO=0
    /// LSS_Supported=0
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [DeviceInfo]
    /// VendorName=Nordlicht
    /// VendorNumber=0x000003F5
    /// ProductName=Pump controller
    /// ProductNumber=7
    /// RevisionNumber=0x00010002
    /// OrderCode=PC-7
    /// SimpleBootUpMaster=0
    /// SimpleBootUpSlave=1
    /// Granularity=8
    /// DynamicChannelsSupported=0
    /// GroupMessaging=0
    /// NrOfRXPDO=0
    /// NrOfTXPDO=0
    /// LSS_Supported=0
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.2 and 4.5. The severity is engineering judgement: it follows what files in use lack.
    pub(crate) static MISSING_DEVICE_INFO_ENTRY = {
        code: "DEV002",
        name: "missing-device-info-entry",
        group: DeviceInfo,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("26"), CanChkEds("recommended key missing"), EdsDcfCheck("MND002")],
        check: File(check),
    }
}

const MANDATORY: [KeyName; 14] = [
    KeyName::VendorName,
    KeyName::VendorNumber,
    KeyName::ProductName,
    KeyName::ProductNumber,
    KeyName::RevisionNumber,
    KeyName::OrderCode,
    KeyName::SimpleBootUpMaster,
    KeyName::SimpleBootUpSlave,
    KeyName::Granularity,
    KeyName::DynamicChannelsSupported,
    KeyName::GroupMessaging,
    KeyName::NrOfRxPdo,
    KeyName::NrOfTxPdo,
    KeyName::LssSupported,
];

const NAMES: [KeyName; 3] = [KeyName::VendorName, KeyName::ProductName, KeyName::OrderCode];

fn check(context: &Context<'_>, report: &mut Report) {
    let Some(info) = context.sheet.device_info() else { return };
    let Some(missing) = Missing::of(*info, &MANDATORY) else { return };
    let finding = missing.report(context, |key| computed(context.sheet, key), report);
    if missing.keys().all(|key| NAMES.contains(&key)) {
        finding.severity(Severity::Info);
    }
}

/// The value that the objects of the file give an entry.
fn computed(sheet: &Datasheet, key: KeyName) -> Option<String> {
    let pdo_count = |direction| {
        // Modules and compact storage bring PDOs that no object describes.
        let mask = sheet.device_info().and_then(|info| info.compact_pdo());
        let is_complete =
            sheet.supported_modules().is_none() && mask.is_none_or(|mask| mask.known() == Some(0));
        is_complete.then(|| pdos::communication(sheet, direction).len().to_string())
    };
    match key {
        KeyName::NrOfRxPdo => pdo_count(PdoDirection::Receive),
        KeyName::NrOfTxPdo => pdo_count(PdoDirection::Transmit),
        _ => {
            let (_, sub_index) = identity::NUMBERS.into_iter().find(|&(name, _)| name == key)?;
            let (number, entry) = identity::value(sheet, sub_index)?;
            (number != 0).then(|| entry.text().into_owned())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    const COMPLETE: &str = "[DeviceInfo]\nVendorName=a\nVendorNumber=1\nProductName=b\nProductNumber=2\nRevisionNumber=3\nOrderCode=c\nSimpleBootUpMaster=0\nSimpleBootUpSlave=1\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO=0\nNrOfTXPDO=0\nLSS_Supported=0\n";

    #[test]
    fn names_alone_are_an_info() {
        assert!(findings(&MISSING_DEVICE_INFO_ENTRY, COMPLETE).is_empty());
        let text = COMPLETE.replace("OrderCode=c\n", "").replace("ProductName=b", "ProductName=");
        assert_eq!(
            findings(&MISSING_DEVICE_INFO_ENTRY, &text),
            ["1:1 info: `[DeviceInfo]` has no `OrderCode`; `ProductName` is empty"]
        );
    }

    #[test]
    fn what_the_objects_tell_is_offered() {
        let text = COMPLETE
            .replace("NrOfTXPDO=0\n", "")
            .replace("VendorNumber=1", "VendorNumber=")
            .replace("RevisionNumber=3\n", "");
        let objects = "[1800]\nObjectType=9\n[1018sub1]\nDataType=7\nDefaultValue=0x3F5\n[1018sub3]\nDataType=7\nDefaultValue=0\n";
        let fixed = fixed(&MISSING_DEVICE_INFO_ENTRY, &format!("{text}{objects}"));
        assert!(
            fixed.contains("VendorNumber=0x3F5\n") && fixed.contains("LSS_Supported=0\nNrOfTXPDO=1\n[1800]")
        );
        assert_eq!(
            findings(&MISSING_DEVICE_INFO_ENTRY, &fixed),
            ["1:1 warning: `[DeviceInfo]` has no `RevisionNumber`"]
        );
    }
}
