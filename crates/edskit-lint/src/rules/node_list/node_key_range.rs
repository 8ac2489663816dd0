use crate::rule::rule;
use crate::{Context, Report};
use edskit_model::{KeyName, Section};
use std::collections::HashSet;

rule! {
    /// A node of a nodelist has no possible node-ID
    ///
    /// ## What it does
    /// Reports keys such as `Node0Present` and `Node128Name`, whose number is not 1 to 127.
    ///
    /// ## Why is this bad
    /// The number is the node-ID. No node can have this one.
    ///
    /// ## Example
    /// ```cpj
    /// [Topology]
    /// Nodes=0x01
    /// Node128Present=0x01
    /// ```
    ///
    /// ## Use instead
    /// ```cpj
    /// [Topology]
    /// Nodes=0x01
    /// Node127Present=0x01
    /// ```
    ///
    /// ## References
    /// CiA 306-3 v1.2, 6.2.
    pub(crate) static NODE_KEY_RANGE = {
        code: "CPJ003",
        name: "node-key-range",
        group: NodeList,
        severity: Error,
        since: "0.1.0",
        files: NODE_LISTS,
        check: Section(check),
    }
}

fn check(_: &Context<'_>, section: Section<'_>, report: &mut Report) {
    let mut seen = HashSet::new();
    for entry in section.entries() {
        let key = entry.key();
        let is_of_node = matches!(
            key.name,
            KeyName::NodePresent | KeyName::NodeItemName | KeyName::NodeItemRefd | KeyName::NodeDcfName
        );
        if is_of_node && !(1..=127).contains(&key.number) && seen.insert(key.number) {
            report
                .add(
                    entry.key_span(),
                    format!("`{}` names node {}, but node-IDs are 1 to 127", entry.key_text(), key.number),
                )
                .help("write the node-ID of the node");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings_in;

    #[test]
    fn one_finding_for_each_node() {
        let text = "[Topology]\nNode0Name=a\nNode0Present=1\nNode127Present=1\nNode300DCFName=x\n";
        assert_eq!(
            findings_in(&NODE_KEY_RANGE, "nodelist.cpj", text.as_bytes()),
            [
                "2:1 error: `Node0Name` names node 0, but node-IDs are 1 to 127",
                "5:1 error: `Node300DCFName` names node 300, but node-IDs are 1 to 127"
            ]
        );
    }
}
