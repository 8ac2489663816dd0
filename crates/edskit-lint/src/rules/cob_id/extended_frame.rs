use super::judged::{JudgedCobId, Judgement};
use crate::rule::rule;
use crate::{Context, Report};

rule! {
    /// A CAN-ID has 29 bits
    ///
    /// ## What it does
    /// Reports a message in use whose COB-ID has the frame bit (bit 29) set.
    ///
    /// ## Why is this bad
    /// Few CANopen devices support frames with 29-bit identifiers, and networks with such devices often have filters
    /// that drop them. A device without that support refuses the value with abort code 0609 0030h.
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
    /// DefaultValue=0x20000185
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
    /// CiA 301 v4.2, 7.5.2.35 and 7.5.2.37. That this is worth a warning is engineering judgement: the standard allows
    /// it.
    pub(crate) static EXTENDED_FRAME = {
        code: "COB005",
        name: "extended-frame",
        group: CobId,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for JudgedCobId { parameter, judgement } in context.cob_ids() {
        let Some(Judgement::Extended(cob_id)) = *judgement else { continue };
        report
            .add(
                parameter.value.span(),
                format!("{} has the 29-bit CAN-ID {}", parameter.party, cob_id.can_id()),
            )
            .help("clear bit 29 (20000000h) and write a CAN-ID of 11 bits");
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn only_messages_in_use() {
        let text =
            |value: &str| format!("[1800]\nObjectType=9\n[1800sub1]\nDataType=7\nDefaultValue={value}\n");
        assert_eq!(
            findings(&EXTENDED_FRAME, &text("$NODEID+0x20012300")),
            ["5:14 warning: TPDO1 has the 29-bit CAN-ID 00012301h"]
        );
        assert!(findings(&EXTENDED_FRAME, &text("0xA0012300")).is_empty());
        assert!(findings(&EXTENDED_FRAME, &text("0x185")).is_empty());
    }
}
