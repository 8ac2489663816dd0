use super::network::is_present;
use crate::rule::rule;
use crate::{Context, Edit, Report};
use edskit_model::Topology;

rule! {
    /// The number of nodes differs from the nodes that are present
    ///
    /// ## What it does
    /// Compares `Nodes` of `[Topology]` with the nodes whose `NodeXPresent` is 1. A number that counts the absent nodes
    /// too is left alone. A missing `Nodes`, and one above 127, are reported.
    ///
    /// ## Why is this bad
    /// Readers of a nodelist check the number, or stop after so many nodes.
    ///
    /// ## Example
    /// ```cpj
    /// [Topology]
    /// NetName=Line
    /// Nodes=0x03
    /// Node1Present=0x01
    /// Node1DCFName=master.dcf
    /// Node5Present=0x01
    /// Node5DCFName=drive.dcf
    /// ```
    ///
    /// ## Use instead
    /// ```cpj
    /// [Topology]
    /// NetName=Line
    /// Nodes=0x02
    /// Node1Present=0x01
    /// Node1DCFName=master.dcf
    /// Node5Present=0x01
    /// Node5DCFName=drive.dcf
    /// ```
    ///
    /// ## References
    /// CiA 306-3 v1.2, 6.2.
    pub(crate) static NODES_COUNT = {
        code: "CPJ001",
        name: "nodes-count",
        group: NodeList,
        severity: Error,
        since: "0.1.0",
        files: NODE_LISTS,
        check: File(check),
    }
}

/// The most nodes of one network.
const MOST: u8 = 127;

fn check(context: &Context<'_>, report: &mut Report) {
    for topology in context.sheet.topologies() {
        check_network(topology, report);
    }
}

fn check_network(topology: Topology<'_>, report: &mut Report) {
    let nodes = topology.nodes();
    let present = nodes.iter().filter(|node| is_present(**node)).count();
    let name = topology.name();
    let Some(field) = topology.node_count() else {
        report
            .add(topology.span(), format!("`[{name}]` does not say how many nodes there are"))
            .help(format!("add `Nodes=0x{present:02X}`"));
        return;
    };
    let Some(count) = field.known() else { return };
    let message = if count > MOST {
        format!("Nodes is {count}, but a network has at most {MOST} nodes")
    } else if usize::from(count) == present || usize::from(count) == nodes.len() {
        return;
    } else {
        let are = if present == 1 { "1 is" } else { &format!("{present} are") };
        format!("Nodes is {count}, but {are} present")
    };
    let finding = report.add(field.span(), message);
    for node in nodes.iter().filter(|node| is_present(**node)).take(4) {
        if let Some(present) = node.present {
            finding.label(present.entry.span(), "");
        }
    }
    finding.help(format!("write `Nodes=0x{present:02X}`")).unsafe_fix(
        format!("Write {present}"),
        vec![Edit::replace(field.span(), format!("0x{present:02X}"))],
    );
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings_in;

    fn found(entries: &str) -> Vec<String> {
        findings_in(&NODES_COUNT, "nodelist.cpj", format!("[Topology]\n{entries}\n").as_bytes())
    }

    #[test]
    fn present_nodes_are_counted() {
        let nodes = "Node1Present=1\nNode2Present=0\nNode3Name=Valve\nNode4Present=0x01";
        assert!(
            found(&format!("Nodes=2\n{nodes}")).is_empty() && found(&format!("Nodes=4\n{nodes}")).is_empty()
        );
        assert_eq!(found(&format!("Nodes=3\n{nodes}")), ["2:7 error: Nodes is 3, but 2 are present"]);
        assert_eq!(found("Nodes=2\nNode1Present=1"), ["2:7 error: Nodes is 2, but 1 is present"]);
        assert_eq!(found("Nodes=200"), ["2:7 error: Nodes is 200, but a network has at most 127 nodes"]);
        assert_eq!(found(nodes), ["1:1 error: `[Topology]` does not say how many nodes there are"]);
        assert!(found("Nodes=0").is_empty() && found("Nodes=x").is_empty());
    }
}
