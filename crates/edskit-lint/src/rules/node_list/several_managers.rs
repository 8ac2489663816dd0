use super::network;
use crate::rule::rule;
use crate::{Context, Report};

rule! {
    /// A network has several CANopen managers
    ///
    /// ## What it does
    /// Reports a present node whose DCF says `CANopenManager=1` where that of another node of the network says so too.
    /// It needs the DCFs; without them it says nothing.
    ///
    /// ## Why is this bad
    /// One manager starts the network and configures the nodes. Two of them work against each other, unless all take
    /// part in flying mastership.
    ///
    /// ## Example
    /// ```cpj
    /// [Topology]
    /// Nodes=0x02
    /// Node1Present=0x01
    /// Node1DCFName=panel.dcf
    /// Node2Present=0x01
    /// Node2DCFName=controller.dcf
    /// ```
    ///
    /// Both DCFs say:
    ///
    /// ```dcf panel.dcf
    /// [DeviceComissioning]
    /// CANopenManager=1
    /// ```
    ///
    /// ```dcf controller.dcf
    /// [DeviceComissioning]
    /// CANopenManager=1
    /// ```
    ///
    /// ## Use instead
    /// ```cpj
    /// [Topology]
    /// Nodes=0x02
    /// Node1Present=0x01
    /// Node1DCFName=panel.dcf
    /// Node2Present=0x01
    /// Node2DCFName=controller.dcf
    /// ```
    ///
    /// Only one of the DCFs says it:
    ///
    /// ```dcf panel.dcf
    /// [DeviceComissioning]
    /// CANopenManager=0
    /// ```
    ///
    /// ```dcf controller.dcf
    /// [DeviceComissioning]
    /// CANopenManager=1
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 5; CiA 302-2.
    pub(crate) static SEVERAL_MANAGERS = {
        code: "CPJ005",
        name: "several-managers",
        group: NodeList,
        severity: Warning,
        since: "0.1.0",
        files: NODE_LISTS,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for topology in context.sheet.topologies() {
        let nodes = network::nodes(context, topology);
        let mut managers = nodes.iter().filter(|node| {
            let flag = node.dcf.commissioning().and_then(|section| section.canopen_manager()?.known());
            flag == Some(true)
        });
        let Some(first) = managers.next() else { continue };
        for other in managers {
            let message = format!("nodes {} and {} are both the CANopen manager", first.id, other.id);
            report
                .add(other.dcf_name.value_span(), message)
                .here("says `CANopenManager=1`")
                .label(first.dcf_name.value_span(), "says so too")
                .help("write `CANopenManager=0` in one of the two");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{Folder, findings_among};

    #[test]
    fn one_manager_is_enough() {
        let dcf = |flag: u8| format!("[DeviceComissioning]\nCANopenManager={flag}\n");
        let folder = Folder::default().with("m.dcf", &dcf(1)).with("s.dcf", &dcf(0));
        let text = "[Topology]\nNode1Present=1\nNode1DCFName=m.dcf\nNode2Present=1\nNode2DCFName=s.dcf\nNode3Present=1\nNode3DCFName=m.dcf\n[Topology2]\nNode1Present=1\nNode1DCFName=m.dcf\nNode2DCFName=m.dcf\n";
        assert_eq!(
            findings_among(&SEVERAL_MANAGERS, "nodelist.cpj", text, &folder),
            ["7:14 warning: nodes 1 and 3 are both the CANopen manager"]
        );
    }
}
