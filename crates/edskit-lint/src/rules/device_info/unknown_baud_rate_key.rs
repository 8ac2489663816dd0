use crate::rule::rule;
use crate::{Context, Edit, Report};
use edskit_model::{Entry, KeyName, Section};
use edskit_types::Bitrate;

rule! {
    /// A bit rate that CiA 306 does not know
    ///
    /// ## What it does
    /// Reports an entry of `[DeviceInfo]` whose key begins with `BaudRate_` but is none of the eight that CiA 306
    /// defines: 10, 20, 50, 125, 250, 500, 800 and 1000 kbit/s.
    ///
    /// ## Why is this bad
    /// Other keys are allowed as extensions, so nothing breaks, but no other tool reads them. A slip such as
    /// `BaudRate_500k` hides a bit rate that the device has.
    ///
    /// ## Example
    /// ```eds
    /// [DeviceInfo]
    /// BaudRate_100=1
    /// BaudRate_125=1
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [DeviceInfo]
    /// BaudRate_125=1
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.5.
    pub(crate) static UNKNOWN_BAUD_RATE_KEY = {
        code: "DEV005",
        name: "unknown-baud-rate-key",
        group: DeviceInfo,
        severity: Info,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("24")],
        check: File(check),
    }
}

const PREFIX: &[u8] = b"BaudRate";

/// The entries that begin like a bit rate and are none of CiA 306, slips such as `BaudRate500` included.
pub(super) fn unknown_keys(info: Section<'_>) -> impl Iterator<Item = Entry<'_>> {
    let source = info.sheet().document().to_bytes();
    info.all_numbered(KeyName::Unknown).filter(move |entry| {
        let key = entry.key_span().slice(source);
        key.get(..PREFIX.len()).is_some_and(|start| start.eq_ignore_ascii_case(PREFIX))
    })
}

fn check(context: &Context<'_>, report: &mut Report) {
    let Some(info) = context.sheet.device_info() else { return };
    let source = context.source();
    // Without the `_` it is a slip like any other, the matter of SYN024.
    let is_rate = |entry: &Entry<'_>| entry.key_span().slice(source).get(PREFIX.len()) == Some(&b'_');
    let mut keys = unknown_keys(*info).filter(is_rate).peekable();
    if keys.peek().is_none() {
        return;
    }
    let known: Vec<Bitrate> =
        Bitrate::ALL.iter().copied().filter(|&rate| info.supports(rate).is_some()).collect();
    for entry in keys {
        let key = entry.key_text();
        let finding = report.add(entry.key_span(), format!("CiA 306 knows no bit rate `{key}`"));
        match meant(&key).filter(|rate| !known.contains(rate)) {
            Some(rate) => {
                let canonical = format!("BaudRate_{}", rate.kbit_per_s());
                finding.help(format!("write `{canonical}={}`", entry.text())).unsafe_fix(
                    format!("Write {canonical}"),
                    vec![Edit::replace(entry.key_span(), canonical)],
                );
            }
            None => {
                finding.help(
                    "take the entry out; there are BaudRate_10, _20, _50, _125, _250, _500, _800 and _1000",
                );
            }
        }
    }
}

/// The bit rate whose number is all that the key says.
fn meant(key: &str) -> Option<Bitrate> {
    let number = key[PREFIX.len()..].trim_start_matches(['_', '-', ' ']);
    let number = number.trim_end_matches(|letter: char| letter.is_ascii_alphabetic());
    Bitrate::from_kbit_per_s(number.parse().ok()?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn slips_are_mended() {
        let text =
            "[DeviceInfo]\nBaudrate1000=1\nbaudrate_500k=1\nBaudRate_Auto=1\nBaudRate_020=1\nBaudRate_=1\n";
        assert_eq!(
            findings(&UNKNOWN_BAUD_RATE_KEY, text),
            [
                "3:1 info: CiA 306 knows no bit rate `baudrate_500k`",
                "4:1 info: CiA 306 knows no bit rate `BaudRate_Auto`",
                "5:1 info: CiA 306 knows no bit rate `BaudRate_020`",
                "6:1 info: CiA 306 knows no bit rate `BaudRate_`"
            ]
        );
        assert_eq!(
            fixed(&UNKNOWN_BAUD_RATE_KEY, text),
            "[DeviceInfo]\nBaudrate1000=1\nBaudRate_500=1\nBaudRate_Auto=1\nBaudRate_20=1\nBaudRate_=1\n"
        );
    }

    #[test]
    fn an_entry_that_is_there_is_not_written_again() {
        let text = "[DeviceInfo]\nBaudRate_1000k=1\nBaudRate_1000=1\n";
        assert_eq!(fixed(&UNKNOWN_BAUD_RATE_KEY, text), text);
        assert!(findings(&UNKNOWN_BAUD_RATE_KEY, "[DeviceInfo]\nBAUDRATE_1000=1\nBaud=1\n").is_empty());
    }
}
