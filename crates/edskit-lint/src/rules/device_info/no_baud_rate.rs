use super::unknown_baud_rate_key::unknown_keys;
use crate::rule::rule;
use crate::wording::FEW;
use crate::{Context, Report};
use edskit_model::Field;
use edskit_types::Bitrate;

rule! {
    /// The device supports no bit rate
    ///
    /// ## What it does
    /// Reports a `[DeviceInfo]` in which every `BaudRate_*` entry is 0 or missing.
    ///
    /// ## Why is this bad
    /// A tool that offers only the supported bit rates has none to offer, so the device cannot be put on a bus.
    ///
    /// ## Example
    /// ```eds
    /// [DeviceInfo]
    /// VendorName=Nordlicht
    /// BaudRate_125=0
    /// BaudRate_250=0
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [DeviceInfo]
    /// VendorName=Nordlicht
    /// BaudRate_125=0
    /// BaudRate_250=1
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.5.
    pub(crate) static NO_BAUD_RATE = {
        code: "DEV004",
        name: "no-baud-rate",
        group: DeviceInfo,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [EdsDcfCheck("MND004")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let Some(info) = context.sheet.device_info() else { return };
    let flags: Vec<Field<'_, bool>> = Bitrate::ALL.iter().filter_map(|&rate| info.supports(rate)).collect();
    // A flag that cannot be read may mean yes, and so may a rate that CiA 306 does not know.
    let is_open = flags.iter().any(|flag| flag.known() != Some(false));
    if is_open || unknown_keys(*info).any(|entry| entry.flag().known() != Some(false)) {
        return;
    }
    let message = if flags.is_empty() {
        "no bit rate is supported: there is no `BaudRate_*` with a value"
    } else {
        "no bit rate is supported: every `BaudRate_*` is 0"
    };
    let finding = report.add(info.span(), message);
    for flag in flags.iter().take(FEW) {
        finding.label(flag.entry.span(), "not supported");
    }
    let configured = context.sheet.commissioning().and_then(|part| part.baudrate()?.known());
    let configured = configured.and_then(|rate| Bitrate::from_kbit_per_s(rate.into()));
    finding.help(match configured {
        Some(rate) => {
            format!(
                "write `BaudRate_{}=1`, the bit rate that the device is configured for",
                rate.kbit_per_s()
            )
        }
        None => "write 1 for each bit rate that the device has, such as `BaudRate_250=1`".to_owned(),
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, lint};
    use edskit_model::Datasheet;

    #[test]
    fn one_rate_is_enough_and_doubt_counts() {
        for entry in ["BaudRate_10=1", "BaudRate_10=yes", "BaudRate_100=1", "BaudRate_Auto=yes"] {
            assert!(findings(&NO_BAUD_RATE, &format!("[DeviceInfo]\nBaudRate_20=0\n{entry}\n")).is_empty());
        }
        assert_eq!(
            findings(&NO_BAUD_RATE, "[DeviceInfo]\nBaudRate_10=\nBaudRate_100=0\n"),
            ["1:1 warning: no bit rate is supported: there is no `BaudRate_*` with a value"]
        );
    }

    #[test]
    fn a_dcf_tells_which_rate_it_needs() {
        let sheet = Datasheet::parse(b"[DeviceInfo]\nBaudRate_500=0\n[DeviceComissioning]\nBaudrate=500\n");
        let findings = lint(&NO_BAUD_RATE, "a.dcf", &sheet);
        assert_eq!(findings[0].message, "no bit rate is supported: every `BaudRate_*` is 0");
        let help = findings[0].help.as_deref();
        assert_eq!(help, Some("write `BaudRate_500=1`, the bit rate that the device is configured for"));
    }
}
