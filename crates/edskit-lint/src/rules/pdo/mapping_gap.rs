use crate::pdos::{DescribedPdo, MOST_ENTRIES};
use crate::rule::rule;
use crate::{Context, Report};

rule! {
    /// An entry of a mapping is not described
    ///
    /// ## What it does
    /// Reports a mapping parameter that describes an entry, but not the one before it, and one whose sub-index 00h
    /// counts more entries than are described. A mapping parameter with sub-index 00h alone is left alone.
    ///
    /// ## Why is this bad
    /// Entries are numbered without gaps. What stands at a place that nobody describes is not known, so the PDO can be
    /// neither configured nor decoded from there on.
    ///
    /// ## Example
    /// ```eds
    /// [1A00]
    /// ParameterName=TPDO 1 mapping parameter
    /// ObjectType=0x9
    /// SubNumber=3
    ///
    /// [1A00sub0]
    /// DataType=0x0005
    /// DefaultValue=3
    ///
    /// [1A00sub1]
    /// DataType=0x0007
    /// DefaultValue=0x22000010
    ///
    /// [1A00sub3]
    /// DataType=0x0007
    /// DefaultValue=0x22010010
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1A00]
    /// ParameterName=TPDO 1 mapping parameter
    /// ObjectType=0x9
    /// SubNumber=3
    ///
    /// [1A00sub0]
    /// DataType=0x0005
    /// DefaultValue=2
    ///
    /// [1A00sub1]
    /// DataType=0x0007
    /// DefaultValue=0x22000010
    ///
    /// [1A00sub2]
    /// DataType=0x0007
    /// DefaultValue=0x22010010
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.5.2.36 and 7.5.2.38.
    pub(crate) static MAPPING_GAP = {
        code: "PDO018",
        name: "mapping-gap",
        group: Pdo,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("11")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for pdo in context.pdos() {
        check_pdo(pdo, report);
    }
}

fn check_pdo(pdo: &DescribedPdo<'_>, report: &mut Report) {
    let Some(mapping) = pdo.mapping.filter(|mapping| mapping.compact_count() == 0) else { return };
    let described = |sub_index: u8| (1..=MOST_ENTRIES).contains(&sub_index);
    let mut last = None;
    for sub in mapping.sub_objects().filter(|sub| described(sub.sub_index().0)) {
        let expected = last.map_or(1, |(number, _)| number + 1);
        let number = sub.sub_index().0;
        if number != expected {
            let missing = if expected + 1 == number {
                format!("entry {expected} of {pdo} is")
            } else {
                format!("entries {expected} to {} of {pdo} are", number - 1)
            };
            report
                .add(sub.span(), format!("{missing} not described, but entry {number} is"))
                .help("describe the entries without a gap, from sub-index 01h on");
            return;
        }
        last = Some((number, sub));
    }
    let (Some((highest, sub)), Some(count), Some(value)) = (last, pdo.mapped_count(), pdo.count) else {
        return;
    };
    // Where SubNumber counts what is not there, that is the matter of OBJ008.
    let claimed = mapping.sub_number().and_then(|field| field.known()).map_or(0, usize::from);
    if count > highest && claimed <= mapping.sub_objects().len() {
        let are = if highest == 1 { "1 is" } else { &format!("{highest} are") };
        report
            .add(value.span(), format!("{pdo} maps {count} entries, but only {are} described"))
            .label(sub.span(), "the last one")
            .help(format!("write {highest}, or describe the others"));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    fn found(count: &str, subs: &[&str]) -> Vec<String> {
        let mut text = format!("[1600]\nObjectType=9\n[1600sub0]\nDataType=5\nDefaultValue={count}\n");
        for sub in subs {
            text += &format!("[1600sub{sub}]\nDataType=7\nDefaultValue=0\n");
        }
        findings(&MAPPING_GAP, &text)
    }

    #[test]
    fn entries_have_no_gaps() {
        assert_eq!(found("0", &["2"]), ["6:1 error: entry 1 of RPDO1 is not described, but entry 2 is"]);
        assert_eq!(
            found("4", &["1", "4"]),
            ["9:1 error: entries 2 to 3 of RPDO1 are not described, but entry 4 is"]
        );
        assert_eq!(found("4", &["1", "2"]), ["5:14 error: RPDO1 maps 4 entries, but only 2 are described"]);
        assert_eq!(found("2", &["1"]), ["5:14 error: RPDO1 maps 2 entries, but only 1 is described"]);
        for subs in [&["1", "2", "FF"][..], &["1", "2", "3"], &[]] {
            assert!(found("2", subs).is_empty(), "{subs:?}");
        }
        assert!(found("255", &["1"]).is_empty());
        let promised =
            "[1600]\nObjectType=9\nSubNumber=3\n[1600sub0]\nDataType=5\nDefaultValue=2\n[1600sub1]\n";
        assert!(findings(&MAPPING_GAP, promised).is_empty());
    }

    #[test]
    fn compact_mappings_have_no_gaps() {
        let text = "[1600]\nObjectType=9\nDataType=7\nCompactSubObj=8\n[1600sub3]\nDataType=7\n";
        assert!(findings(&MAPPING_GAP, text).is_empty());
    }
}
