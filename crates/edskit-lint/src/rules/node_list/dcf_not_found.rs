use super::network::{self, is_present};
use crate::rule::rule;
use crate::{Context, Report};

rule! {
    /// The DCF of a node does not exist, or is that of another node
    ///
    /// ## What it does
    /// Looks for the `NodeXDCFName` of each present node in the folder `EDSBaseName` and beside the nodelist, and
    /// compares the `NodeID` in it with X. A present node without a `NodeXDCFName` is reported too. Where the files are
    /// not at hand, as on standard input, nothing is looked for.
    ///
    /// ## Why is this bad
    /// The configuration tool cannot configure the node, or gives it the configuration of another one.
    ///
    /// ## Example
    /// ```cpj
    /// [Topology]
    /// Nodes=0x01
    /// Node5Present=0x01
    /// Node5Name=Drive
    /// ```
    ///
    /// ## Use instead
    /// ```cpj
    /// [Topology]
    /// Nodes=0x01
    /// Node5Present=0x01
    /// Node5Name=Drive
    /// Node5DCFName=drive.dcf
    /// ```
    ///
    /// ## References
    /// CiA 306-3 v1.2, 6.2.
    pub(crate) static DCF_NOT_FOUND = {
        code: "CPJ002",
        name: "dcf-not-found",
        group: NodeList,
        severity: Error,
        since: "0.1.0",
        files: NODE_LISTS,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for topology in context.sheet.topologies() {
        for node in topology.nodes().into_iter().filter(|node| is_present(*node)) {
            let id = node.node_id;
            let Some(name) = node.dcf_name else {
                let span = node.present.map_or(topology.span(), |present| present.entry.span());
                report
                    .add(span, format!("node {id} is present, but has no DCF"))
                    .help(format!("add `Node{id}DCFName`"));
                continue;
            };
            let Some(neighbours) = context.neighbours else { continue };
            match network::find(neighbours, topology, name) {
                Err(is_sure) => {
                    if is_sure {
                        report
                            .add(
                                name.value_span(),
                                format!("there is no file `{}` for node {id}", name.text()),
                            )
                            .help("put the DCF into the folder `EDSBaseName`, or write its name as it is");
                    }
                }
                Ok(path) => {
                    let Some(dcf) = neighbours.sheet(&path) else { continue };
                    let own = dcf.commissioning().and_then(|section| section.node_id()?.known());
                    if let Some(own) = own.filter(|own| u16::from(*own) != id) {
                        report
                            .add(
                                name.value_span(),
                                format!("`{}` is the DCF of node {own}, not of node {id}", name.text()),
                            )
                            .help(format!("write `NodeID={id}` there, or name the DCF of node {id} here"));
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{Folder, findings_among, findings_in};

    const LIST: &str = "[Topology]\nNodes=2\nNode1Present=1\nNode1DCFName=a.dcf\nNode2Present=1\nNode2DCFName=b.dcf\nNode3DCFName=c.dcf\n";

    #[test]
    fn each_present_node_has_its_dcf() {
        let node = |id: u8| format!("[DeviceComissioning]\nNodeID={id}\n");
        let among =
            |text: &str, folder: &Folder| findings_among(&DCF_NOT_FOUND, "nodelist.cpj", text, folder);
        let folder = Folder::default().with("a.dcf", &node(1)).with("b.dcf", &node(7));
        assert_eq!(among(LIST, &folder), ["6:14 error: `b.dcf` is the DCF of node 7, not of node 2"]);
        let folder = Folder::default().with("dcf/a.dcf", &node(1)).with("b.dcf", &node(2));
        assert_eq!(among(LIST, &folder), ["4:14 error: there is no file `a.dcf` for node 1"]);
        assert!(among(&format!("{LIST}EDSBaseName=dcf\n"), &folder).is_empty());
        assert!(findings_in(&DCF_NOT_FOUND, "nodelist.cpj", LIST.as_bytes()).is_empty());
    }
}
