use crate::rule::rule;
use crate::{Context, Edit, Report};
use edskit_types::PdoDirection;

rule! {
    /// CompactPDO describes no PDO
    ///
    /// ## What it does
    /// Reports a `CompactPDO` other than 0 where `NrOfRXPDO` and `NrOfTXPDO` count no more PDOs than are described one
    /// by one.
    ///
    /// ## Why is this bad
    /// `CompactPDO` says how the PDOs look that have no section. Where there are none, it does nothing; or the numbers
    /// of PDOs are too small.
    ///
    /// ## Example
    /// ```eds
    /// [DeviceInfo]
    /// NrOfRXPDO=0
    /// NrOfTXPDO=0
    /// CompactPDO=0x17
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [DeviceInfo]
    /// NrOfRXPDO=0
    /// NrOfTXPDO=0
    /// CompactPDO=0
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.6.3.4.1.
    pub(crate) static COMPACT_PDO_UNUSED = {
        code: "PDO024",
        name: "compact-pdo-unused",
        group: Pdo,
        severity: Info,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("CompactPDO")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let Some(info) = context.sheet.device_info() else { return };
    let Some(field) = info.compact_pdo() else { return };
    let Some(1..) = field.known() else { return };
    let directions = [PdoDirection::Receive, PdoDirection::Transmit];
    // A number that is missing or cannot be read may count anything.
    let is_known = |direction| info.pdo_count(direction).is_some_and(|count| count.known().is_some());
    if !directions.into_iter().all(is_known)
        || directions.into_iter().any(|direction| context.sheet.implicit_pdos(direction).next().is_some())
    {
        return;
    }
    let why = if context.pdos().is_empty() { "the device has no PDO" } else { "every PDO is described" };
    let finding = report.add(field.span(), format!("CompactPDO is `{}`, but {why}", field.text()));
    for count in directions.into_iter().filter_map(|direction| info.pdo_count(direction)) {
        finding.label(count.entry.span(), "the number of PDOs");
    }
    finding
        .help("write `CompactPDO=0`, or count the PDOs that are not described")
        .unsafe_fix("Write 0", vec![Edit::replace(field.span(), "0")]);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    fn text(compact: &str, receive: &str) -> String {
        format!("[DeviceInfo]\nCompactPDO={compact}\nNrOfRXPDO={receive}\nNrOfTXPDO=0\n[1400]\n[1600]\n")
    }

    #[test]
    fn there_must_be_pdos_without_a_section() {
        assert_eq!(
            findings(&COMPACT_PDO_UNUSED, &text("0x17", "1")),
            ["2:12 info: CompactPDO is `0x17`, but every PDO is described"]
        );
        for fine in [text("0x17", "2"), text("0", "1"), text("0x17", ""), text("0x17", "x"), text("", "1")] {
            assert!(findings(&COMPACT_PDO_UNUSED, &fine).is_empty(), "{fine}");
        }
        assert_eq!(fixed(&COMPACT_PDO_UNUSED, &text("23", "1")), text("0", "1"));
    }
}
