use crate::rule::rule;
use crate::rules::syntax::lost_header;
use crate::{Context, Report};
use edskit_model::SectionKind;
use edskit_types::Index;

rule! {
    /// A PDO has a communication parameter without a mapping parameter, or the reverse
    ///
    /// ## What it does
    /// Reports a communication parameter (1400h to 15FFh, 1800h to 19FFh) whose mapping parameter, 200h above it, is
    /// not described, and a mapping parameter without its communication parameter.
    ///
    /// ## Why is this bad
    /// A described PDO must be described completely. Half of one can be neither configured nor decoded.
    ///
    /// ## Example
    /// ```eds
    /// [1800]
    /// ParameterName=TPDO 1 communication parameter
    /// ObjectType=0x9
    /// SubNumber=3
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1800]
    /// ParameterName=TPDO 1 communication parameter
    /// ObjectType=0x9
    /// SubNumber=3
    ///
    /// [1A00]
    /// ParameterName=TPDO 1 mapping parameter
    /// ObjectType=0x9
    /// SubNumber=2
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.6.3.4.1; CiA 301 v4.2, 7.5.2.35 to 7.5.2.38.
    pub(crate) static INCOMPLETE_PDO = {
        code: "PDO001",
        name: "incomplete-pdo",
        group: Pdo,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("63")],
        check: File(check),
    }
}

/// How far the mapping parameter of a PDO lies above its communication parameter.
const DISTANCE: u16 = 0x200;

fn check(context: &Context<'_>, report: &mut Report) {
    for pdo in context.pdos() {
        let (object, other, message) = match (pdo.communication, pdo.mapping) {
            (Some(object), None) => {
                let other = Index(object.index().0 + DISTANCE);
                let message = format!(
                    "{pdo} has a communication parameter, {}, but no mapping parameter {other}",
                    object.index()
                );
                (object, other, message)
            }
            (None, Some(object)) => {
                let other = Index(object.index().0 - DISTANCE);
                let message = format!(
                    "{pdo} has a mapping parameter, {}, but no communication parameter {other}",
                    object.index()
                );
                (object, other, message)
            }
            _ => continue,
        };
        // One that a list names is the matter of LST004, one whose header is misspelt that of SYN008 or SYN023.
        if context.listing().is_listed(other) || lost_header::hides(context, SectionKind::Object(other)) {
            continue;
        }
        report
            .add(object.span(), message)
            .help(format!("describe {other}, or take {} out if there is no {pdo}", object.index()));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn both_halves_are_needed() {
        assert_eq!(
            findings(&INCOMPLETE_PDO, "[1400]\n[1600]\n[1401]\n[1BFF]\n"),
            [
                "3:1 error: RPDO2 has a communication parameter, 1401h, but no mapping parameter 1601h",
                "4:1 error: TPDO512 has a mapping parameter, 1BFFh, but no communication parameter 19FFh"
            ]
        );
    }
}
