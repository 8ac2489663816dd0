use crate::pdos::MOST_BITS;
use crate::rule::rule;
use crate::{Context, Report};

rule! {
    /// A mapping has more than 64 bits
    ///
    /// ## What it does
    /// Adds up the lengths of the entries that sub-index 00h of a mapping parameter counts, and reports the first one
    /// that does not fit.
    ///
    /// ## Why is this bad
    /// A CAN frame has eight bytes. The device refuses such a mapping with abort code 0604 0042h.
    ///
    /// ## Example
    /// ```eds
    /// [1600]
    /// ParameterName=RPDO 1 mapping parameter
    /// ObjectType=0x9
    /// SubNumber=4
    ///
    /// [1600sub0]
    /// DataType=0x0005
    /// DefaultValue=3
    ///
    /// [1600sub1]
    /// DataType=0x0007
    /// DefaultValue=0x22000120
    ///
    /// [1600sub2]
    /// DataType=0x0007
    /// DefaultValue=0x22000220
    ///
    /// [1600sub3]
    /// DataType=0x0007
    /// DefaultValue=0x22000308
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1600]
    /// ParameterName=RPDO 1 mapping parameter
    /// ObjectType=0x9
    /// SubNumber=4
    ///
    /// [1600sub0]
    /// DataType=0x0005
    /// DefaultValue=2
    ///
    /// [1600sub1]
    /// DataType=0x0007
    /// DefaultValue=0x22000120
    ///
    /// [1600sub2]
    /// DataType=0x0007
    /// DefaultValue=0x22000220
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.5.2.36 and 7.5.2.38.
    pub(crate) static MAPPING_TOO_LONG = {
        code: "PDO003",
        name: "mapping-too-long",
        group: Pdo,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("64"), EdsDcfCheck("PDO004")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for pdo in context.pdos() {
        let mut bits = 0;
        let mut first = None;
        for mapped in pdo.mapped() {
            let before = bits;
            bits += u32::from(mapped.entry.bits());
            if bits > MOST_BITS && first.is_none() {
                first = Some((mapped, before));
            }
        }
        let Some((mapped, before)) = first else { continue };
        let message = format!("{pdo} maps {bits} bits, but a PDO has at most {MOST_BITS}");
        let finding = report.add(mapped.value.span(), message);
        finding
            .here(format!("the entries before it have {before} bits, this one has {}", mapped.entry.bits()));
        if let Some(count) = pdo.count {
            finding.label(count.span(), "so many entries are mapped");
        }
        finding.help("map fewer entries, or put some into another PDO");
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    fn found(count: u8, entries: &[&str]) -> Vec<String> {
        let mut text = format!("[1A00]\nObjectType=9\n[1A00sub0]\nDataType=5\nDefaultValue={count}\n");
        for (position, entry) in entries.iter().enumerate() {
            text += &format!("[1A00sub{}]\nDataType=7\nDefaultValue={entry}\n", position + 1);
        }
        findings(&MAPPING_TOO_LONG, &text)
    }

    #[test]
    fn only_what_is_counted_is_added_up() {
        let entries = ["0x20000040", "0x20010001", "0x20020020"];
        assert_eq!(found(3, &entries), ["11:14 error: TPDO1 maps 97 bits, but a PDO has at most 64"]);
        assert!(found(1, &entries).is_empty());
        assert!(found(254, &entries).is_empty());
        assert_eq!(found(1, &["0x200000FF"]).len(), 1);
    }
}
