//! The nodes of a network with their DCFs.

use crate::{Context, Neighbours};
use edskit_model::{Datasheet, Entry, Field, Topology, TopologyNode};
use edskit_types::NodeId;
use std::rc::Rc;

/// A node that is present, with its DCF.
pub(crate) struct Node<'a> {
    pub(crate) id: NodeId,
    /// Where the nodelist names the DCF.
    pub(crate) dcf_name: Entry<'a>,
    pub(crate) dcf: Rc<Datasheet>,
}

/// The nodes of a network that are present and whose DCFs can be read, in ascending order.
pub(crate) fn nodes<'a>(context: &Context<'_>, topology: Topology<'a>) -> Vec<Node<'a>> {
    let Some(neighbours) = context.neighbours else { return Vec::new() };
    let node = |node: TopologyNode<'a>| {
        let id = NodeId::new(u8::try_from(node.node_id).ok()?).ok()?;
        let dcf_name = node.dcf_name.filter(|_| is_present(node))?;
        let path = find(neighbours, topology, dcf_name).ok()?;
        Some(Node { id, dcf_name, dcf: neighbours.sheet(&path)? })
    };
    topology.nodes().into_iter().filter_map(node).collect()
}

/// Whether a node is there; a missing entry says that it is not.
pub(crate) fn is_present(node: TopologyNode<'_>) -> bool {
    node.present.and_then(Field::known) == Some(1)
}

/// The relative name of a DCF that exists, in the folder EDSBaseName or beside the nodelist; else whether it is sure
/// that there is none.
pub(super) fn find(
    neighbours: &dyn Neighbours,
    topology: Topology<'_>,
    dcf_name: Entry<'_>,
) -> Result<String, bool> {
    let name = dcf_name.text().into_owned();
    let base = topology.eds_base_name().map(|entry| entry.text().into_owned());
    let inside = base.map(|base| format!("{}/{name}", base.trim_end_matches(['/', '\\'])));
    let mut is_sure = true;
    for path in inside.into_iter().chain([name]) {
        match neighbours.exists(&path) {
            Some(true) => return Ok(path),
            Some(false) => {}
            None => is_sure = false,
        }
    }
    Err(is_sure)
}
