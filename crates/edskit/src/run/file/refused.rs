//! Values of a file that a client could not write, so that the node works without what hangs on them.

use edskit_codegen::{Layout, LoadedDictionary, Problem};
use edskit_lint::Severity;
use edskit_runtime::{Entry, Instant, NoApplication, NoStorage, Node, Settings};
use edskit_types::{AbortCode, CobId, IdentifierRules, Index, SubIndex};

/// A warning for each value, at the place of its entry. What is wrong with mappings and with the identifiers in COB-IDs the
/// layout says itself.
pub(super) fn problems(layout: &Layout, settings: Settings) -> Vec<Problem> {
    let mut node = Node::new(LoadedDictionary::new(layout), settings, NoStorage);
    node.poll(Instant(0), &mut NoApplication);
    let mut refused = Vec::new();
    node.refused(&mut NoApplication, &mut |entry, code| refused.push((*entry, code)));
    let objects = node.objects();
    let others =
        refused.iter().filter(|(entry, _)| !is_said(entry, objects.value(entry.index, entry.sub_index.0)));
    let problem = |(entry, code): &(Entry, AbortCode)| {
        let position = objects.table().find(entry.index, entry.sub_index).ok()?;
        let source = layout.sources.get(usize::from(position.0))?;
        let bytes = objects.bytes(position).iter().rev();
        let value: String = bytes.map(|byte| format!("{byte:02X}")).collect();
        let (index, sub_index) = (entry.index, entry.sub_index);
        let consequence = consequence(index, sub_index);
        let message = format!(
            "{index} sub-index {sub_index} is {value}h, which no client could write ({code}), so {consequence}"
        );
        Some(Problem {
            severity: Severity::Warning,
            code: "GEN",
            file: source.file,
            span: source.span,
            position: source.position,
            message,
            help: None,
        })
    };
    others.filter_map(problem).collect()
}

/// Whether the layout says what is wrong with a value.
fn is_said(entry: &Entry, value: Option<u32>) -> bool {
    let is_mapping = entry.index.is_rpdo_mapping() || entry.index.is_tpdo_mapping();
    let is_cob_id = match (entry.index.0, entry.sub_index.0) {
        (0x1005 | 0x1012 | 0x1014, 0) => true,
        (0x1201..=0x127F, sub_index) => (1..=2).contains(&sub_index),
        (0x1400..=0x15FF | 0x1800..=0x19FF, sub_index) => sub_index == 1,
        _ => false,
    };
    let cob_id = CobId(value.unwrap_or_default() & !CobId::BIT_31);
    is_mapping || (is_cob_id && IdentifierRules::CIA_301.fault(cob_id).is_some())
}

/// What the node does without.
fn consequence(index: Index, sub_index: SubIndex) -> String {
    match (index.0, sub_index.0) {
        (0x1005, _) => "it knows no SYNC message".to_owned(),
        (0x1012, _) => "it takes no TIME message".to_owned(),
        (0x1014, _) => "it sends no EMCY message".to_owned(),
        (0x1016, _) => "this entry monitors no heartbeat".to_owned(),
        (0x1019, _) => "the SYNC message has no counter".to_owned(),
        (0x1029, _) => "it counts as 00h".to_owned(),
        (0x1201..=0x127F, _) => format!("SDO server {} does not exist", index.0 - 0x1200 + 1),
        (0x1400..=0x15FF, 1 | 2) => format!("RPDO{} does not exist", index.0 - 0x1400 + 1),
        (0x1800..=0x19FF, 1 | 2) => format!("TPDO{} does not exist", index.0 - 0x1800 + 1),
        (0x1400..=0x15FF | 0x1800..=0x19FF, _) => "it counts as 00h".to_owned(),
        _ => "it stays what it is until a client writes another one".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use edskit_codegen::parse;

    #[test]
    fn each_value_is_named_with_what_the_node_does_without() {
        let object = |section: &str, data_type: u8, value: &str| {
            format!(
                "[{section}]\nParameterName=x\nDataType={data_type}\nAccessType=rw\nDefaultValue={value}\n"
            )
        };
        let record = |section: &str| format!("[{section}]\nParameterName=x\nObjectType=9\nSubNumber=2\n");
        let eds = [
            record("1016"),
            record("1201"),
            record("1400"),
            record("1801"),
            object("1005", 7, "0x40000080"),
            object("1012", 7, "0x40000100"),
            object("1014", 7, "$NODEID+0x80"),
            object("1019", 5, "1"),
            object("1016sub1", 7, "0xFF140064"),
            object("1201sub1", 7, "0x20000640"),
            object("1400sub1", 7, "0"),
            object("1400sub2", 5, "255"),
            object("1801sub1", 7, "0x185"),
            object("1801sub2", 5, "241"),
            object("2000", 1, "1"),
        ];
        let layout = parse(eds.concat().as_bytes(), None).expect("it can be laid out");
        let problems = problems(&layout, layout.settings);
        let lines: Vec<String> =
            problems.iter().map(|problem| problem.line("a.eds", "a.toml").to_string()).collect();
        insta::assert_snapshot!(lines.join("\n"));
    }
}
