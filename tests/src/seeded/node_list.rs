//! CPJ: node lists, and the DCFs that they name.

use super::base::{Base, Section};
use super::defect::{Defect, added, missing, value, value_of};
use super::mutant::Mutant;

pub(super) fn defects() -> Vec<Defect> {
    [counts(), nodes(), networks()].into_iter().flatten().collect()
}

fn counts() -> Vec<Defect> {
    vec![
        value("CPJ001", "a node more than present", "Nodes", is_topology, "0x06"),
        value("CPJ001", "fewer nodes than present", "Nodes", is_topology, "0x01"),
        value("CPJ001", "more than 127 nodes", "Nodes", is_topology, "0x80"),
        missing("CPJ001", "no number of nodes", "Nodes", is_topology),
    ]
}

fn nodes() -> Vec<Defect> {
    vec![
        value("CPJ002", "a DCF that does not exist", "Node5DCFName", is_topology, "lost.dcf"),
        value("CPJ002", "the DCF of another node", "Node5DCFName", is_topology, "coupler.dcf"),
        Defect::new("CPJ002", "a present node without a DCF", |base| {
            let lists = base.sections_where(is_topology).into_iter();
            let lost = lists.filter_map(|list| {
                let mutant = Mutant::of(base).delete(list.entry("Node6DCFName")?.line);
                Some(mutant.expect(list.entry("Node6Present")?.line))
            });
            lost.collect()
        }),
        Defect::new("CPJ002", "another node-ID in the DCF", |base| {
            with_changed_dcf(base, |dcf| {
                Some(Mutant::of(dcf).set(dcf.entry("DeviceComissioning", "NodeID")?, "9"))
            })
        }),
        added("CPJ003", "a node 0", is_topology, "Node0Present=0x00"),
        added("CPJ003", "a node 128", is_topology, "Node128Name=Spare"),
        Defect::new("CPJ004", "a node that is present with 2", |base| {
            let entries = base.sections().iter().flat_map(|section| &section.entries);
            let absent = entries.filter(|entry| entry.key.ends_with("Present") && entry.number() == Some(0));
            absent.map(|entry| Mutant::of(base).set(entry, "0x02")).collect()
        }),
        value_of("CPJ004", "a node that is present with 255", "Node6Present", is_topology, |_, _| {
            Some("0xFF".to_owned())
        })
        .with_consequence("CPJ001", "the node is not counted as present any more"),
    ]
}

fn networks() -> Vec<Defect> {
    vec![
        Defect::new("CPJ005", "two managers", |base| {
            with_changed_dcf(base, |dcf| {
                let manager =
                    dcf.entry("DeviceComissioning", "CANopenManager").filter(|entry| entry.value == "0")?;
                Some(Mutant::of(dcf).set(manager, "1"))
            })
        })
        .by_label(),
        Defect::new("CPJ006", "another bit rate than the other nodes", |base| {
            with_changed_dcf(base, |dcf| {
                Some(Mutant::of(dcf).set(dcf.entry("DeviceComissioning", "Baudrate")?, "500"))
            })
        })
        .by_label(),
    ]
}

/// A nodelist beside which one DCF was changed; the finding is expected where the nodelist names the DCF.
pub(super) fn with_changed_dcf(base: &Base, change: impl Fn(&Base) -> Option<Mutant>) -> Vec<Mutant> {
    let lists = base.sections_where(is_topology);
    let changed =
        base.neighbours.iter().filter(|(name, _)| name.ends_with(".dcf")).filter_map(|(name, text)| {
            let dcf = change(&Base::new(name, text))?;
            let named = lists.iter().flat_map(|list| &list.entries).filter(|entry| entry.value == *name);
            let mutant = Mutant::of(base).with_neighbour(name, dcf.text());
            Some(named.fold(mutant, |mutant, entry| mutant.expect(entry.line)))
        });
    changed.filter(|_| !lists.is_empty()).collect()
}

fn is_topology(section: &Section) -> bool {
    section.name.starts_with("Topology")
}
