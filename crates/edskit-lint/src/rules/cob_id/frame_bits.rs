use super::judged::{JudgedCobId, Judgement};
use super::parameters::Parameter;
use crate::evaluate::node_ids;
use crate::rule::rule;
use crate::{Context, Edit, Report, Severity};
use edskit_types::{CobId, Party};

rule! {
    /// A COB-ID has bits that mean nothing
    ///
    /// ## What it does
    /// Reports bits 11 to 28 in a COB-ID without the frame bit (bit 29), bit 30 in the COB-ID of an EMCY message, which
    /// is a warning, and bit 30 in that of an RPDO, which is an information. SYNC is the matter of COM005.
    ///
    /// ## Why is this bad
    /// An 11-bit CAN-ID ends with bit 10. Devices refuse the value or cut the bits off, so nobody knows which CAN-ID
    /// counts. Reserved bits may get a meaning some day.
    ///
    /// ## Example
    /// ```eds
    /// [1800]
    /// ParameterName=TPDO 1 communication parameter
    /// ObjectType=0x9
    ///
    /// [1800sub1]
    /// ParameterName=COB-ID
    /// DataType=0x0007
    /// DefaultValue=0x00001185
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1800]
    /// ParameterName=TPDO 1 communication parameter
    /// ObjectType=0x9
    ///
    /// [1800sub1]
    /// ParameterName=COB-ID
    /// DataType=0x0007
    /// DefaultValue=$NODEID+0x180
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.5.2.17, 7.5.2.35 and 7.5.2.37.
    pub(crate) static FRAME_BITS = {
        code: "COB004",
        name: "frame-bits",
        group: CobId,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for JudgedCobId { parameter, judgement } in context.cob_ids() {
        let value = parameter.value;
        if let Some(cob_id) = stray(context, parameter, *judgement) {
            let bits = cob_id.0 & CobId::STRAY_MASK;
            let message = format!(
                "{} has the COB-ID {cob_id}, whose bits {bits:08X}h belong to no 11-bit CAN-ID",
                parameter.party
            );
            let finding = report.add(value.span(), message);
            if !parameter.is_in_use(cob_id) {
                finding.severity(Severity::Warning);
            }
            finding.help("write a CAN-ID of up to 7FFh, or set bit 29 for one of 29 bits");
            continue;
        }
        let (severity, who) = match parameter.party {
            Party::Emcy => (Severity::Warning, "EMCY"),
            party if party.is_rpdo() => (Severity::Info, "an RPDO"),
            _ => continue,
        };
        let Some(cob_id) = node_ids(context).find_map(|node_id| parameter.used_at(node_id)) else { continue };
        if !cob_id.bit30() {
            continue;
        }
        let finding = report.add(
            value.span(),
            format!("{} has the COB-ID {cob_id}, but bit 30 of {who} is reserved", parameter.party),
        );
        finding.severity(severity);
        let text = value.entry.text_before_comment();
        // Where the bit can be seen in the text, it can be taken out there.
        match value.constant::<u32>() {
            Some(number) => {
                let right = format!("0x{:X}", number & !CobId::BIT_30);
                finding
                    .help(format!("write `{right}`"))
                    .unsafe_fix("Clear bit 30", vec![Edit::replace(value.span(), right)]);
            }
            None => {
                finding.help(format!("take 0x40000000 out of `{text}`"));
            }
        }
    }
}

/// The COB-ID with stray bits, of a message in use or not.
fn stray(context: &Context<'_>, parameter: &Parameter<'_>, judgement: Option<Judgement>) -> Option<CobId> {
    match judgement {
        Some(Judgement::Stray(cob_id)) => Some(cob_id),
        Some(_) => None,
        None => {
            let at = node_ids(context).filter_map(|node_id| parameter.value.cob_id_at(node_id));
            at.into_iter().find(|cob_id| cob_id.has_stray_bits())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    fn text(index: &str, value: &str) -> String {
        format!("[{index}]\nObjectType=9\n[{index}sub1]\nDataType=7\nDefaultValue={value}\n")
    }

    fn found(index: &str, value: &str) -> String {
        findings(&FRAME_BITS, &text(index, value)).join("|")
    }

    #[test]
    fn stray_bits() {
        assert_eq!(
            found("1800", "0x00001185"),
            "5:14 error: TPDO1 has the COB-ID 00001185h, whose bits 00001000h belong to no 11-bit CAN-ID"
        );
        assert!(found("1800", "0x80001185").contains("warning"));
        assert!(found("1281", "$NODEID+0x7F0").contains("SDO client 2 request has the COB-ID 0000086Fh"));
        assert_eq!(found("1800", "0x20001185") + &found("1800", "0xC0000185") + &found("1800", "x"), "");
    }

    #[test]
    fn reserved_bits() {
        assert_eq!(
            found("1400", "0x40000205"),
            "5:14 info: RPDO1 has the COB-ID 40000205h, but bit 30 of an RPDO is reserved"
        );
        assert_eq!(fixed(&FRAME_BITS, &text("1400", "0x40000205")), text("1400", "0x205"));
        assert_eq!(found("1400", "0xC0000205"), "");
        assert_eq!(
            findings(&FRAME_BITS, "[1014]\nDataType=7\nDefaultValue=$NODEID+0x40000080\n"),
            ["3:14 warning: EMCY has the COB-ID 40000081h, but bit 30 of EMCY is reserved"]
        );
    }
}
