use crate::rule::rule;
use crate::{Context, Report};
use edskit_types::Bitrate;

rule! {
    /// A bit rate does not exist, or the device does not support it
    ///
    /// ## What it does
    /// Reports a `Baudrate` of `[DeviceComissioning]` that is none of 10, 20, 50, 125, 250, 500, 800 and 1000 kbit/s,
    /// and one whose `BaudRate_` flag in `[DeviceInfo]` is not 1.
    ///
    /// ## Why is this bad
    /// The device cannot be put on the bus with this bit rate. A device with the wrong one disturbs all others.
    ///
    /// ## Example
    /// ```dcf
    /// [DeviceInfo]
    /// BaudRate_500=1
    /// BaudRate_1000=0
    ///
    /// [DeviceComissioning]
    /// NodeID=5
    /// Baudrate=1000
    /// ```
    ///
    /// ## Use instead
    /// ```dcf
    /// [DeviceInfo]
    /// BaudRate_500=1
    /// BaudRate_1000=0
    ///
    /// [DeviceComissioning]
    /// NodeID=5
    /// Baudrate=500
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.5 and 5. That the two agree is engineering judgement: one contradicts the other.
    pub(crate) static BAUDRATE_UNSUPPORTED = {
        code: "DCF004",
        name: "baudrate-unsupported",
        group: Configuration,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [EdsDcfCheck("MND003")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let Some(field) = context.sheet.commissioning().and_then(|section| section.baudrate()) else { return };
    let Some(rate) = field.known() else { return };
    let supported: Vec<u16> = context
        .sheet
        .device_info()
        .into_iter()
        .flat_map(|info| info.bitrates())
        .map(Bitrate::kbit_per_s)
        .collect();
    let Some(bitrate) = Bitrate::from_kbit_per_s(rate.into()) else {
        let hint = if rate > 1000 && rate % 1000 == 0 { "the unit is kbit/s; " } else { "" };
        report
            .add(field.span(), format!("Baudrate is {rate}, which is no bit rate of CANopen"))
            .help(format!("{hint}write {}", choice(if supported.is_empty() { &ALL } else { &supported })));
        return;
    };
    // Where no flag is set at all, DEV004 reports that.
    if supported.is_empty() || supported.contains(&rate) {
        return;
    }
    let finding = report.add(field.span(), format!("Baudrate is {rate}, which the device does not support"));
    if let Some(flag) = context.sheet.device_info().and_then(|info| info.supports(bitrate)) {
        finding.label(flag.entry.span(), "not supported");
    }
    finding.help(format!("write {}, or `BaudRate_{rate}=1` if the device can do it", choice(&supported)));
}

/// Every bit rate of CANopen, in kbit/s.
const ALL: [u16; 8] = [10, 20, 50, 125, 250, 500, 800, 1000];

/// `125`, `125 or 250`, `125, 250 or 500`.
fn choice(rates: &[u16]) -> String {
    let texts: Vec<String> = rates.iter().map(u16::to_string).collect();
    match &texts[..] {
        [before @ .., last] if !before.is_empty() => format!("{} or {last}", before.join(", ")),
        _ => texts.concat(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, lint};
    use edskit_model::Datasheet;

    fn found(rate: &str, flags: &str) -> String {
        findings(
            &BAUDRATE_UNSUPPORTED,
            &format!("[DeviceComissioning]\nBaudrate={rate}\n[DeviceInfo]\n{flags}\n"),
        )
        .join("|")
    }

    #[test]
    fn rates_of_the_standard_and_of_the_device() {
        assert_eq!(found("125", "BaudRate_125=1"), "");
        assert_eq!(found("125", ""), "");
        assert_eq!(found("125", "BaudRate_125=0"), "");
        assert_eq!(
            found("0x7D", "BaudRate_125=0\nBaudRate_250=1"),
            "2:10 warning: Baudrate is 125, which the device does not support"
        );
        assert_eq!(found("0", ""), "2:10 warning: Baudrate is 0, which is no bit rate of CANopen");
        assert_eq!(found("", "") + &found("x", ""), "");
    }

    #[test]
    fn the_help_names_what_can_be_written() {
        let help = |text: &str| {
            lint(&BAUDRATE_UNSUPPORTED, "a.dcf", &Datasheet::parse(text.as_bytes()))[0].help.clone().unwrap()
        };
        let text = "[DeviceComissioning]\nBaudrate=50000\n[DeviceInfo]\nBaudRate_125=1\nBaudRate_500=1\nBaudRate_1000=1\n";
        assert_eq!(help(text), "the unit is kbit/s; write 125, 500 or 1000");
        assert_eq!(
            help("[DeviceComissioning]\nBaudrate=20\n[DeviceInfo]\nBaudRate_125=1\n"),
            "write 125, or `BaudRate_20=1` if the device can do it"
        );
        assert_eq!(choice(&ALL), "10, 20, 50, 125, 250, 500, 800 or 1000");
        assert_eq!(choice(&[]), "");
    }
}
