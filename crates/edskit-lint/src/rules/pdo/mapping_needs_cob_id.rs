use crate::pdos::DescribedPdo;
use crate::rule::rule;
use crate::{Context, Report};
use edskit_types::SubIndex;

rule! {
    /// A mapping can be written, but the PDO cannot be switched off
    ///
    /// ## What it does
    /// Reports a PDO whose mapping parameter can be written (sub-index 00h), while its COB-ID is `ro` or `const`.
    ///
    /// ## Why is this bad
    /// Before a mapping is changed, the PDO must be switched off with bit 31 of the COB-ID. A device that follows the
    /// standard refuses the new mapping as long as the PDO is in use.
    ///
    /// ## Example
    /// ```eds
    /// [1800]
    /// ParameterName=TPDO 1 communication parameter
    /// ObjectType=0x9
    /// SubNumber=3
    ///
    /// [1800sub1]
    /// ParameterName=COB-ID
    /// DataType=0x0007
    /// DefaultValue=$NODEID+0x180
    /// AccessType=ro
    ///
    /// [1A00]
    /// ParameterName=TPDO 1 mapping parameter
    /// ObjectType=0x9
    /// SubNumber=1
    ///
    /// [1A00sub0]
    /// ParameterName=Number of mapped entries
    /// DataType=0x0005
    /// AccessType=rw
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1800]
    /// ParameterName=TPDO 1 communication parameter
    /// ObjectType=0x9
    /// SubNumber=3
    ///
    /// [1800sub1]
    /// ParameterName=COB-ID
    /// DataType=0x0007
    /// DefaultValue=$NODEID+0x180
    /// AccessType=rw
    ///
    /// [1A00]
    /// ParameterName=TPDO 1 mapping parameter
    /// ObjectType=0x9
    /// SubNumber=1
    ///
    /// [1A00sub0]
    /// ParameterName=Number of mapped entries
    /// DataType=0x0005
    /// AccessType=rw
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.5.2.36 and 7.5.2.38.
    pub(crate) static MAPPING_NEEDS_COB_ID = {
        code: "PDO025",
        name: "mapping-needs-cob-id",
        group: Pdo,
        severity: Info,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("COB-ID const")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for pdo in context.pdos() {
        check_pdo(pdo, report);
    }
}

fn check_pdo(pdo: &DescribedPdo<'_>, report: &mut Report) {
    let count = pdo.mapping.and_then(|mapping| mapping.sub_object(SubIndex(0))?.access_type());
    let cob_id = pdo.communication.and_then(|object| object.sub_object(SubIndex(1))?.access_type());
    let (Some(count), Some(cob_id)) = (count, cob_id) else { return };
    let (Some(mapping_access), Some(cob_id_access)) = (count.known(), cob_id.known()) else { return };
    if !mapping_access.is_writable() || cob_id_access.is_writable() || pdo.is_valid() != Some(true) {
        return;
    }
    report
        .add(
            cob_id.span(),
            format!("the mapping of {pdo} can be written, but its COB-ID is `{cob_id_access}`"),
        )
        .here("bit 31 switches the PDO off")
        .label(count.span(), "the number of mapped entries")
        .help("write `AccessType=rw`, or make the mapping read-only too");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    fn found(cob_id: &str, access: &str, mapping: &str) -> Vec<String> {
        let text = format!(
            "[1800]\nObjectType=9\n[1800sub1]\nDataType=7\nDefaultValue={cob_id}\nAccessType={access}\n[1A00]\nObjectType=9\n[1A00sub0]\nDataType=5\nAccessType={mapping}\n"
        );
        findings(&MAPPING_NEEDS_COB_ID, &text)
    }

    #[test]
    fn what_can_be_written_must_be_switched_off_first() {
        assert_eq!(
            found("$NODEID+0x180", "const", "rw"),
            ["6:12 info: the mapping of TPDO1 can be written, but its COB-ID is `const`"]
        );
        for (cob_id, access, mapping) in
            [("0x181", "rw", "rw"), ("0x181", "ro", "ro"), ("0x80000181", "ro", "rw"), ("0x181", "", "rw")]
        {
            assert!(found(cob_id, access, mapping).is_empty(), "{cob_id} {access} {mapping}");
        }
    }
}
