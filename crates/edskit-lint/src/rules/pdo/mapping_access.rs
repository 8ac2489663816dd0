use crate::pdos::DescribedPdo;
use crate::rule::rule;
use crate::{Context, Report, Severity};
use edskit_model::{Field, SubObject};
use edskit_types::AccessType;

rule! {
    /// The entries of a mapping and their number differ in access
    ///
    /// ## What it does
    /// Reports a mapping parameter whose entries can be written while sub-index 00h cannot, and, as an information,
    /// one whose sub-index 00h can be written while no entry can.
    ///
    /// ## Why is this bad
    /// A mapping is changed in three steps: 0 to sub-index 00h, the entries, their number to sub-index 00h. Where only
    /// one of the two can be written, no tool can change the mapping in that way.
    ///
    /// ## Example
    /// ```eds
    /// [1A00]
    /// ParameterName=TPDO 1 mapping parameter
    /// ObjectType=0x9
    /// SubNumber=2
    ///
    /// [1A00sub0]
    /// DataType=0x0005
    /// AccessType=ro
    ///
    /// [1A00sub1]
    /// DataType=0x0007
    /// AccessType=rw
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1A00]
    /// ParameterName=TPDO 1 mapping parameter
    /// ObjectType=0x9
    /// SubNumber=2
    ///
    /// [1A00sub0]
    /// DataType=0x0005
    /// AccessType=rw
    ///
    /// [1A00sub1]
    /// DataType=0x0007
    /// AccessType=rw
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.5.2.36 and 7.5.2.38.
    pub(crate) static MAPPING_ACCESS = {
        code: "PDO020",
        name: "mapping-access",
        group: Pdo,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("67, 68")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for pdo in context.pdos() {
        check_pdo(pdo, report);
    }
}

fn check_pdo(pdo: &DescribedPdo<'_>, report: &mut Report) {
    let Some(mapping) = pdo.mapping else { return };
    let mut subs = mapping.sub_objects();
    let Some(count) = subs.next().filter(|sub| sub.sub_index().0 == 0).and_then(access) else { return };
    let mut entries = subs.filter(|sub| sub.sub_index().0 < 0xFF).map(access);
    let Some(first) = entries.next() else { return };
    // Mostly the first one settles it.
    if count.1.is_writable() && first.is_some_and(|(_, access)| access.is_writable()) {
        return;
    }
    let entries: Option<Vec<_>> = core::iter::once(first).chain(entries).collect();
    // Where one says nothing, nobody knows.
    let Some(entries) = entries else { return };
    let writable = entries.iter().find(|(_, access)| access.is_writable());
    match (count.1.is_writable(), writable) {
        (false, Some((entry, _))) => {
            report
                .add(count.0.span(), format!("the entries of {pdo} can be written, but not their number"))
                .here("sub-index 00h must be set to 0 before the entries are written")
                .label(entry.span(), "an entry")
                .help("write `AccessType=rw`, or `ro` or `const` at the entries of a fixed mapping");
        }
        (true, None) => {
            report
                .add(count.0.span(), format!("the number of entries of {pdo} can be written, but no entry"))
                .severity(Severity::Info)
                .label(entries[0].0.span(), "an entry")
                .help("write `AccessType=const`, or `rw` at the entries if the mapping can be changed");
        }
        _ => {}
    }
}

fn access(sub: SubObject<'_>) -> Option<(Field<'_, AccessType>, AccessType)> {
    let field = sub.access_type()?;
    Some((field, field.known()?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    fn found(accesses: &[&str]) -> Vec<String> {
        let mut text = "[1600]\nObjectType=9\n".to_owned();
        for (sub, access) in accesses.iter().enumerate() {
            text += &format!("[1600sub{sub}]\nDataType=7\nAccessType={access}\n");
        }
        findings(&MAPPING_ACCESS, &text)
    }

    #[test]
    fn both_or_none_can_be_written() {
        assert_eq!(
            found(&["const", "ro", "rw"]),
            ["5:12 warning: the entries of RPDO1 can be written, but not their number"]
        );
        assert_eq!(
            found(&["rw", "ro"]),
            ["5:12 info: the number of entries of RPDO1 can be written, but no entry"]
        );
        for accesses in [&["rw", "rw", "ro"][..], &["ro", "const"], &["rw"], &["ro", "rw", ""], &["", "rw"]] {
            assert!(found(accesses).is_empty(), "{accesses:?}");
        }
    }
}
