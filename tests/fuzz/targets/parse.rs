//! Any bytes become a document that gives them back, and a datasheet of which everything can be asked.
#![no_main]

use edskit_model::{Datasheet, Document, Line};
use edskit_types::NodeId;
use libfuzzer_sys::fuzz_target;

/// The most objects whose entries are asked for one by one: compact storage has no end in time otherwise.
const EXPANDED: usize = 16;

fuzz_target!(|bytes: &[u8]| {
    let sheet = Datasheet::parse(bytes);
    let document = sheet.document();
    assert_eq!(document.to_bytes(), bytes);
    assert!(tiles(document));
    for section in sheet.sections() {
        let _ = (section.name(), section.kind().canonical_name(), section.end(), section.items().count());
    }
    for entry in sheet.entries() {
        let _ = (entry.key_text(), entry.text(), entry.section().map(|section| section.id()));
        assert!(entry.line().span().contains(entry.value_span()));
    }
    for object in sheet.objects().take(EXPANDED) {
        for entry in object.dictionary_entries() {
            let value = entry.value().zip(entry.data_type());
            let _ = value.map(|(value, data_type)| value.integer(data_type, NodeId::new(127).ok()));
            let _ = (entry.name(), entry.access(), entry.limits(), entry.denotation(), entry.is_mappable());
        }
    }
    for sub in sheet.sub_objects() {
        let description = sub.description();
        let _ = (description.default_value().and_then(|field| field.error_span()), description.access());
    }
    let _ = sheet.topologies().map(|topology| topology.nodes().len()).sum::<usize>();
    let _ = sheet.dynamic_channels().filter_map(|channel| channel.indices()).count();
    let _ = document.position(bytes.len() as u32);
});

/// Whether the byte order mark and the lines with their endings cover every byte once.
fn tiles(document: &Document) -> bool {
    let start = document.byte_order_mark().map_or(0, |mark| mark.end);
    let spans = document.lines().iter().map(Line::full_span);
    let end = spans.fold(Some(start), |end, span| end.filter(|&end| end == span.start).map(|_| span.end));
    end == Some(document.to_bytes().len() as u32)
}
