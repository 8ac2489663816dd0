use super::network;
use crate::rule::rule;
use crate::{Context, Report};
use edskit_types::Bitrate;

rule! {
    /// Nodes of one network have different bit rates
    ///
    /// ## What it does
    /// Compares `Baudrate` in the DCFs of all present nodes of a network. It needs the DCFs; without them it says
    /// nothing.
    ///
    /// ## Why is this bad
    /// All nodes of a network share one bit rate. One with another destroys every frame on the bus.
    ///
    /// ## Example
    /// ```cpj
    /// [Topology]
    /// Nodes=0x02
    /// Node1Present=0x01
    /// Node1DCFName=valve.dcf
    /// Node2Present=0x01
    /// Node2DCFName=drive.dcf
    /// ```
    ///
    /// ```dcf valve.dcf
    /// [DeviceComissioning]
    /// Baudrate=500
    /// ```
    ///
    /// ```dcf drive.dcf
    /// [DeviceComissioning]
    /// Baudrate=125
    /// ```
    ///
    /// ## Use instead
    /// ```cpj
    /// [Topology]
    /// Nodes=0x02
    /// Node1Present=0x01
    /// Node1DCFName=valve.dcf
    /// Node2Present=0x01
    /// Node2DCFName=drive.dcf
    /// ```
    ///
    /// ```dcf valve.dcf
    /// [DeviceComissioning]
    /// Baudrate=500
    /// ```
    ///
    /// ```dcf drive.dcf
    /// [DeviceComissioning]
    /// Baudrate=500
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 5; CiA 306 v1.3, 5.
    pub(crate) static BAUDRATES_DIFFER = {
        code: "CPJ006",
        name: "baudrates-differ",
        group: NodeList,
        severity: Error,
        since: "0.1.0",
        files: NODE_LISTS,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for topology in context.sheet.topologies() {
        let nodes = network::nodes(context, topology);
        let rates = nodes.iter().filter_map(|node| {
            let rate = node.dcf.commissioning()?.baudrate()?.known()?;
            // What is no bit rate is reported in the DCF.
            Some((node, Bitrate::from_kbit_per_s(rate.into())?))
        });
        let mut first = None;
        for (node, rate) in rates {
            let (other, expected) = *first.get_or_insert((node, rate));
            if rate == expected {
                continue;
            }
            let message = format!("node {} has {rate}, but node {} has {expected}", node.id, other.id);
            report
                .add(node.dcf_name.value_span(), message)
                .label(other.dcf_name.value_span(), format!("{expected}"))
                .help("give all nodes of the network one bit rate");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{Folder, findings_among};

    #[test]
    fn all_nodes_share_one_bit_rate() {
        let dcf = |rate: &str| format!("[DeviceComissioning]\nBaudrate={rate}\n");
        let folder =
            Folder::default().with("a.dcf", &dcf("500")).with("b.dcf", &dcf("0x7D")).with("c.dcf", &dcf("0"));
        let text = "[Topology]\nNode1Present=1\nNode1DCFName=c.dcf\nNode2Present=1\nNode2DCFName=a.dcf\nNode3Present=1\nNode3DCFName=b.dcf\nNode4Present=1\nNode4DCFName=a.dcf\n";
        assert_eq!(
            findings_among(&BAUDRATES_DIFFER, "nodelist.cpj", text, &folder),
            ["7:14 error: node 3 has 125 kbit/s, but node 2 has 500 kbit/s"]
        );
    }
}
