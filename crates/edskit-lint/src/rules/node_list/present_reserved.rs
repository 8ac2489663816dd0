use crate::rule::rule;
use crate::{Context, Report};
use edskit_model::{Entry, KeyName};

rule! {
    /// Whether a node is present is said with a reserved value
    ///
    /// ## What it does
    /// Reports a `NodeXPresent` other than 0 and 1.
    ///
    /// ## Why is this bad
    /// Only `0x01` says that the node is present. Readers take other values for absent, or refuse the file.
    ///
    /// ## Example
    /// ```cpj
    /// [Topology]
    /// Nodes=0x01
    /// Node5Present=0x02
    /// ```
    ///
    /// ## Use instead
    /// ```cpj
    /// [Topology]
    /// Nodes=0x01
    /// Node5Present=0x01
    /// ```
    ///
    /// ## References
    /// CiA 306-3 v1.2, 6.2.
    pub(crate) static PRESENT_RESERVED = {
        code: "CPJ004",
        name: "present-reserved",
        group: NodeList,
        severity: Warning,
        since: "0.1.0",
        files: NODE_LISTS,
        check: Entry(check),
    }
}

fn check(_: &Context<'_>, entry: Entry<'_>, report: &mut Report) {
    if entry.key().name != KeyName::NodePresent || entry.is_empty() {
        return;
    }
    let Some(value @ 2..) = entry.unsigned::<u8>().known() else { return };
    report
        .add(entry.value_span(), format!("{} is {value}, but only 0 and 1 have a meaning", entry.key_text()))
        .help("write `0x01` for a node that is present, `0x00` for one that is not");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings_in;

    #[test]
    fn only_two_values_mean_something() {
        let text = "[Topology]\nNode1Present=0x00\nNode2Present=1\nNode3Present=\nNode4Present=0x10\nNode5Present=x\n";
        assert_eq!(
            findings_in(&PRESENT_RESERVED, "nodelist.cpj", text.as_bytes()),
            ["5:14 warning: Node4Present is 16, but only 0 and 1 have a meaning"]
        );
    }
}
