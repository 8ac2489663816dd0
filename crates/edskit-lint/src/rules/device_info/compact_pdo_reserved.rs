use crate::rule::rule;
use crate::{Context, Edit, Report};
use edskit_model::Radix;
use edskit_types::PdoDirection;

rule! {
    /// CompactPDO has reserved bits set, or lacks the bits that every PDO needs
    ///
    /// ## What it does
    /// Reports a `CompactPDO` with bit 6 or 7 set, and one without bit 0 (COB-ID) or bit 1 (transmission type) where
    /// PDOs exist that only `CompactPDO` describes.
    ///
    /// ## Why is this bad
    /// Bit k-1 says that sub-index k of the communication parameters exists; there are six of them. A reader builds
    /// the undescribed PDOs from this mask, and a PDO without COB-ID or transmission type cannot be used.
    ///
    /// ## Example
    /// ```eds
    /// [DeviceInfo]
    /// CompactPDO=0x57
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [DeviceInfo]
    /// CompactPDO=0x17
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.6.3.4.1.
    pub(crate) static COMPACT_PDO_RESERVED = {
        code: "DEV011",
        name: "compact-pdo-reserved",
        group: DeviceInfo,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: File(check),
    }
}

/// The sub-indices 01h to 06h of a communication parameter.
const KNOWN: u8 = 0x3F;
/// COB-ID and transmission type.
const NEEDED: u8 = 0x03;

fn check(context: &Context<'_>, report: &mut Report) {
    let Some(field) = context.sheet.device_info().and_then(|info| info.compact_pdo()) else { return };
    let Some(mask @ 1..) = field.known() else { return };
    let reserved = mask & !KNOWN;
    let is_used = || {
        [PdoDirection::Receive, PdoDirection::Transmit]
            .into_iter()
            .any(|direction| context.sheet.implicit_pdos(direction).next().is_some())
    };
    let lacking = if mask & NEEDED != NEEDED && is_used() { NEEDED & !mask } else { 0 };
    let text = field.text();
    let message = match (reserved, lacking) {
        (0, 0) => return,
        (0, 1) => format!("CompactPDO is `{text}`, so PDOs have no COB-ID: bit 0 is not set"),
        (0, 2) => format!("CompactPDO is `{text}`, so PDOs have no transmission type: bit 1 is not set"),
        (0, _) => {
            format!(
                "CompactPDO is `{text}`, so PDOs have no COB-ID and no transmission type: bits 0 and 1 are not set"
            )
        }
        _ => format!("CompactPDO is `{text}`, but only bits 0 to 5 have a meaning"),
    };
    let better = mask & KNOWN | lacking;
    let is_hexadecimal =
        field.entry.number().known().is_some_and(|number| number.radix() == Radix::Hexadecimal);
    let better = if is_hexadecimal { format!("0x{better:02X}") } else { better.to_string() };
    report
        .add(field.span(), message)
        .help(format!("write `CompactPDO={better}`"))
        .unsafe_fix(format!("Write {better}"), vec![Edit::replace(field.span(), better)]);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn bits_6_and_7_mean_nothing() {
        let text = "[DeviceInfo]\nCompactPDO=255\n";
        assert_eq!(
            findings(&COMPACT_PDO_RESERVED, text),
            ["2:12 warning: CompactPDO is `255`, but only bits 0 to 5 have a meaning"]
        );
        assert_eq!(fixed(&COMPACT_PDO_RESERVED, text), "[DeviceInfo]\nCompactPDO=63\n");
        for value in ["0", "0x3F", "0x10", "", "x"] {
            let text = format!("[DeviceInfo]\nCompactPDO={value}\n");
            assert!(findings(&COMPACT_PDO_RESERVED, &text).is_empty(), "{value}");
        }
    }

    #[test]
    fn a_pdo_needs_two_bits() {
        let text = "[DeviceInfo]\nCompactPDO=0x10\nNrOfRXPDO=1\n";
        assert_eq!(
            findings(&COMPACT_PDO_RESERVED, text),
            [
                "2:12 warning: CompactPDO is `0x10`, so PDOs have no COB-ID and no transmission type: bits 0 and 1 are not set"
            ]
        );
        assert_eq!(fixed(&COMPACT_PDO_RESERVED, text), "[DeviceInfo]\nCompactPDO=0x13\nNrOfRXPDO=1\n");
        assert!(findings(&COMPACT_PDO_RESERVED, &format!("{text}[1400]\n")).is_empty());
    }
}
