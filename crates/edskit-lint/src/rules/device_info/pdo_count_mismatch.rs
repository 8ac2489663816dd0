use super::pdos::{self, MOST};
use crate::rule::rule;
use crate::wording::FEW;
use crate::{Context, Edit, Report, Severity};
use edskit_model::DeviceInfo;
use edskit_types::PdoDirection;

rule! {
    /// The number of PDOs differs from the PDOs that are described
    ///
    /// ## What it does
    /// Compares `NrOfRXPDO` and `NrOfTXPDO` with the number of described communication parameters 1400h to 15FFh and
    /// 1800h to 19FFh. More than 512 and fewer than described are errors. More than described are fine if `CompactPDO`
    /// or modules bring the rest, else a warning.
    ///
    /// ## Why is this bad
    /// The entries count all PDOs of the device. A reader that believes them stops before the last PDO, or waits for
    /// some that nothing describes, and those cannot be configured.
    ///
    /// ## Example
    /// ```eds
    /// [DeviceInfo]
    /// NrOfRXPDO=0
    /// NrOfTXPDO=4
    ///
    /// [1800]
    /// ParameterName=TPDO 1 communication parameter
    /// ObjectType=0x9
    /// SubNumber=3
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [DeviceInfo]
    /// NrOfRXPDO=0
    /// NrOfTXPDO=1
    ///
    /// [1800]
    /// ParameterName=TPDO 1 communication parameter
    /// ObjectType=0x9
    /// SubNumber=3
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.5 and 4.6.3.4.1.
    pub(crate) static PDO_COUNT_MISMATCH = {
        code: "DEV010",
        name: "pdo-count-mismatch",
        group: DeviceInfo,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("62"), EdsDcfCheck("MND005")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let Some(info) = context.sheet.device_info() else { return };
    for direction in [PdoDirection::Receive, PdoDirection::Transmit] {
        check_direction(context, info, direction, report);
    }
}

/// How many communication parameters are listed and not described.
fn listed_only(context: &Context<'_>, direction: PdoDirection) -> usize {
    let block = pdos::block(direction);
    let listing = context.listing();
    let mut indices: Vec<_> = listing.items().iter().filter_map(|item| item.index).collect();
    indices.retain(|index| block.contains(index) && !listing.is_described(*index));
    indices.sort_unstable();
    indices.dedup();
    indices.len()
}

fn check_direction(
    context: &Context<'_>,
    info: DeviceInfo<'_>,
    direction: PdoDirection,
    report: &mut Report,
) {
    let Some(field) = info.pdo_count(direction) else { return };
    let Some(claimed) = field.known() else { return };
    let (key, noun) = match direction {
        PdoDirection::Receive => ("NrOfRXPDO", "RPDO"),
        PdoDirection::Transmit => ("NrOfTXPDO", "TPDO"),
    };
    let described = pdos::communication(context.sheet, direction).len();
    let finding = if claimed > MOST {
        report.add(field.span(), format!("{key} is {claimed}, but CANopen has at most {MOST}"))
    } else {
        // A mask that cannot be read may bring the rest, too.
        let has_implicit = info.compact_pdo().is_some_and(|mask| mask.known() != Some(0));
        let is_more = usize::from(claimed) > described;
        // Those that are listed and have no section are the matter of LST004.
        if usize::from(claimed) == described + listed_only(context, direction) {
            return;
        }
        if usize::from(claimed) == described || is_more && (has_implicit || context.is_modular()) {
            return;
        }
        let what = match described {
            0 => format!("no {noun} is"),
            1 => format!("1 {noun} is"),
            _ => format!("{described} {noun}s are"),
        };
        let finding = report.add(field.span(), format!("{key} is {claimed}, but {what} described"));
        if is_more {
            finding.severity(Severity::Warning);
        }
        finding
    };
    for object in pdos::communication(context.sheet, direction).take(FEW) {
        finding.label(object.span(), format!("{noun} {}", object.index().0 % MOST + 1));
    }
    if usize::from(claimed) < described {
        finding.help(format!("write `{key}={described}`")).unsafe_fix(
            format!("Write {described}"),
            vec![Edit::replace(field.span(), described.to_string())],
        );
    } else {
        finding.help(format!("write `{key}={described}`, or describe the others"));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    fn found(entries: &str) -> Vec<String> {
        findings(&PDO_COUNT_MISMATCH, &format!("[DeviceInfo]\n{entries}\n[1400]\n[1402]\n[1600]\n"))
    }

    #[test]
    fn fewer_is_worse_than_more() {
        assert!(found("NrOfRXPDO=2\nNrOfTXPDO=0").is_empty());
        assert_eq!(found("NrOfRXPDO=1"), ["2:11 error: NrOfRXPDO is 1, but 2 RPDOs are described"]);
        assert_eq!(found("NrOfRXPDO=9"), ["2:11 warning: NrOfRXPDO is 9, but 2 RPDOs are described"]);
        assert_eq!(found("NrOfTXPDO=1"), ["2:11 warning: NrOfTXPDO is 1, but no TPDO is described"]);
        assert_eq!(found("NrOfRXPDO=513"), ["2:11 error: NrOfRXPDO is 513, but CANopen has at most 512"]);
        assert!(found("NrOfRXPDO=\nNrOfTXPDO=x").is_empty());
    }

    #[test]
    fn compact_storage_and_modules_bring_the_rest() {
        assert!(found("NrOfRXPDO=9\nCompactPDO=3").is_empty());
        assert!(found("NrOfRXPDO=9\n[SupportedModules]\nNrOfEntries=0").is_empty());
        assert_eq!(found("NrOfRXPDO=9\nCompactPDO=0").len(), 1);
        assert_eq!(found("NrOfRXPDO=1\nCompactPDO=3").len(), 1);
        assert_eq!(
            fixed(&PDO_COUNT_MISMATCH, "[DeviceInfo]\nNrOfRXPDO=0\n[1401]\n"),
            "[DeviceInfo]\nNrOfRXPDO=1\n[1401]\n"
        );
    }
}
