use super::parameters::{self, Parameter};
use crate::rule::rule;
use crate::rules::node_list::network::{self, Node};
use crate::{Context, FileKind, Report};
use edskit_types::{
    Claim, CobId, IdentifierRules, Opponent, Party, PdoDirection, SdoMessage, SdoRole, conflicts,
};

rule! {
    /// Two nodes of a network send on one CAN-ID
    ///
    /// ## What it does
    /// Collects what the present nodes of a network send, by the DCFs that the nodelist names: their TPDOs in use,
    /// EMCY, SDO answers and heartbeats, each at the node-ID of the nodelist, and compares it with each other and with
    /// SYNC and TIME. Two producers of SYNC or of TIME are reported too. Without the DCFs it says nothing.
    /// A node that has the DCF of another one is left to CPJ002.
    ///
    /// ## Why is this bad
    /// When both send at the same time, the frames destroy each other and both nodes go off the bus in the end.
    ///
    /// ## Example
    /// ```cpj
    /// [Topology]
    /// Nodes=0x02
    /// Node5Present=0x01
    /// Node5DCFName=valve.dcf
    /// Node6Present=0x01
    /// Node6DCFName=drive.dcf
    /// ```
    ///
    /// The valve sends TPDO1 where it was delivered, the drive was copied from it:
    ///
    /// ```dcf valve.dcf
    /// [1800]
    /// ObjectType=0x9
    ///
    /// [1800sub1]
    /// DataType=0x0007
    /// DefaultValue=$NODEID+0x180
    /// ```
    ///
    /// ```dcf drive.dcf
    /// [1800]
    /// ObjectType=0x9
    ///
    /// [1800sub1]
    /// DataType=0x0007
    /// DefaultValue=$NODEID+0x180
    /// ParameterValue=0x185
    /// ```
    ///
    /// ## Use instead
    /// ```cpj
    /// [Topology]
    /// Nodes=0x02
    /// Node5Present=0x01
    /// Node5DCFName=valve.dcf
    /// Node6Present=0x01
    /// Node6DCFName=drive.dcf
    /// ```
    ///
    /// ```dcf valve.dcf
    /// [1800]
    /// ObjectType=0x9
    ///
    /// [1800sub1]
    /// DataType=0x0007
    /// DefaultValue=$NODEID+0x180
    /// ```
    ///
    /// ```dcf drive.dcf
    /// [1800]
    /// ObjectType=0x9
    ///
    /// [1800sub1]
    /// DataType=0x0007
    /// DefaultValue=$NODEID+0x180
    /// ParameterValue=0x186
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.3.3.
    pub(crate) static CROSS_NODE_CONFLICT = {
        code: "COB008",
        name: "cross-node-conflict",
        group: CobId,
        severity: Error,
        since: "0.1.0",
        files: NODE_LISTS,
        check: File(check),
    }
}

/// How many PDOs of one direction a node has; the claims of a network number them through.
const PDOS_OF_NODE: u16 = 512;

fn check(context: &Context<'_>, report: &mut Report) {
    for topology in context.sheet.topologies() {
        let mut nodes = network::nodes(context, topology);
        // The DCF of another node is the matter of CPJ002.
        nodes.retain(|node| {
            let own = node.dcf.commissioning().and_then(|section| section.node_id()?.known());
            own.is_none_or(|own| own == node.id.get())
        });
        let mut claims: Vec<Claim> = Vec::new();
        // Of SYNC and TIME only one node is the producer.
        let mut producers: [Option<&Node<'_>>; 2] = [None, None];
        for node in &nodes {
            // Only parties are taken from the context, so what is beside the DCF does not matter.
            let dcf = Context::new(&node.dcf, FileKind::Dcf, None);
            let mut parameters = parameters::all(&dcf);
            parameters.extend(parameters::sync(&node.dcf));
            for parameter in &parameters {
                claims.extend(sent(node, parameter));
                let position = match parameter.party {
                    Party::Sync => 0,
                    Party::Time => 1,
                    _ => continue,
                };
                if parameter.used_at(node.id).is_some_and(CobId::bit30) {
                    match producers[position] {
                        None => producers[position] = Some(node),
                        Some(other) => two_producers(parameter.party, node, other, report),
                    }
                }
            }
            claims.extend([Party::HeartbeatOf(node.id.get()), answer(node)].into_iter().filter_map(
                |party| {
                    let party_of_node = if let Party::Sdo { .. } = party { default_answer() } else { party };
                    let can_id = party_of_node.predefined_can_id(node.id)?;
                    Some(Claim { can_id, party })
                },
            ));
        }
        let rules = IdentifierRules { restricted: &[], ..IdentifierRules::CIA_301 };
        for conflict in conflicts(&mut claims, &rules) {
            let Opponent::Party(other) = conflict.with else { continue };
            let [Some((node, name)), second] = [conflict.party, other].map(|party| sender(&nodes, party))
            else {
                continue;
            };
            // Two messages of one node are the matter of COB003.
            if second.as_ref().is_some_and(|(other, _)| other.id == node.id) {
                continue;
            }
            let other_name = second.as_ref().map_or_else(|| other.to_string(), |(_, name)| name.clone());
            let message = format!("{name} and {other_name} both have the CAN-ID {}", conflict.can_id);
            let finding = report.add(node.dcf_name.value_span(), message);
            if let Some((other, name)) = second {
                finding.label(other.dcf_name.value_span(), name);
            }
            finding.help("change one of the two in the DCF of its node");
        }
    }
}

/// What a node sends with a COB-ID, numbered through the network.
fn sent(node: &Node<'_>, parameter: &Parameter<'_>) -> Option<Claim> {
    let id = node.id.get();
    let party = match parameter.party {
        Party::Pdo { direction: PdoDirection::Transmit, number } => Party::Pdo {
            direction: PdoDirection::Transmit,
            number: (u16::from(id) - 1) * PDOS_OF_NODE + number,
        },
        Party::Emcy => Party::EmcyOf(id),
        Party::Sdo { role: role @ SdoRole::Server, message: message @ SdoMessage::Response, .. } => {
            Party::Sdo { role, number: id, message }
        }
        party @ (Party::Sync | Party::Time) => party,
        _ => return None,
    };
    let cob_id = parameter.used_at(node.id).filter(|cob_id| !cob_id.has_stray_bits())?;
    Some(Claim { can_id: cob_id.can_id(), party })
}

/// The answers of a node's default SDO server.
fn default_answer() -> Party {
    Party::Sdo { role: SdoRole::Server, number: 1, message: SdoMessage::Response }
}

/// The same, with the node's number.
fn answer(node: &Node<'_>) -> Party {
    Party::Sdo { role: SdoRole::Server, number: node.id.get(), message: SdoMessage::Response }
}

/// The node that sends a message of the network, and what it is called.
fn sender<'n, 'a>(nodes: &'n [Node<'a>], party: Party) -> Option<(&'n Node<'a>, String)> {
    let (id, name) = match party {
        Party::Pdo { number, .. } => {
            let id = (number - 1) / PDOS_OF_NODE + 1;
            (id, format!("TPDO{} of node {id}", (number - 1) % PDOS_OF_NODE + 1))
        }
        Party::EmcyOf(id) | Party::HeartbeatOf(id) => (id.into(), party.to_string()),
        Party::Sdo { number, .. } => (number.into(), format!("SDO server response of node {number}")),
        _ => return None,
    };
    Some((nodes.iter().find(|node| u16::from(node.id.get()) == id)?, name))
}

fn two_producers(party: Party, node: &Node<'_>, other: &Node<'_>, report: &mut Report) {
    report
        .add(node.dcf_name.value_span(), format!("nodes {} and {} both produce {party}", other.id, node.id))
        .label(other.dcf_name.value_span(), format!("produces {party} too"))
        .help("clear bit 30 of the COB-ID in the DCF of one of the two");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{Folder, findings_among};

    fn pdo(index: &str, value: &str) -> String {
        format!("[{index}]\nObjectType=9\n[{index}sub1]\nDataType=7\nDefaultValue={value}\n")
    }

    fn found(first: &str, second: &str) -> Vec<String> {
        let folder = Folder::default().with("a.dcf", first).with("b.dcf", second);
        let text = "[Topology]\nNode5Present=1\nNode5DCFName=a.dcf\nNode127Present=1\nNode127DCFName=b.dcf\n";
        findings_among(&CROSS_NODE_CONFLICT, "nodelist.cpj", text, &folder)
    }

    #[test]
    fn what_two_nodes_send() {
        let own = pdo("1800", "$NODEID+0x180");
        assert!(found(&own, &own).is_empty());
        assert!(found(&own, &format!("[DeviceComissioning]\nNodeID=6\n{}", pdo("1800", "0x185"))).is_empty());
        assert!(found(&own, &pdo("1400", "0x185")).is_empty(), "an RPDO listens");
        assert_eq!(
            found(&pdo("1801", "0x1FF"), &own),
            ["5:16 error: TPDO1 of node 127 and TPDO2 of node 5 both have the CAN-ID 1FFh"]
        );
        assert_eq!(
            found(&own, &pdo("19FF", "0x705")),
            ["5:16 error: TPDO512 of node 127 and heartbeat of node 5 both have the CAN-ID 705h"]
        );
        assert_eq!(
            found(&own, &pdo("1800", "0x585")),
            ["5:16 error: TPDO1 of node 127 and SDO server response of node 5 both have the CAN-ID 585h"]
        );
        assert!(found(&(pdo("1800", "0x190") + &pdo("1801", "0x190")), &own).is_empty(), "COB003");
    }

    #[test]
    fn sync_and_time() {
        let sync = |value: &str| format!("[1005]\nDataType=7\nDefaultValue={value}\n");
        assert!(found(&sync("0x80"), &sync("0x40000080")).is_empty());
        assert_eq!(
            found(&sync("0x40000080"), &sync("0x40000080")),
            ["5:16 error: nodes 5 and 127 both produce SYNC"]
        );
        assert_eq!(
            found(&sync("0x80"), &pdo("1800", "0x80")),
            ["5:16 error: TPDO1 of node 127 and SYNC both have the CAN-ID 080h"]
        );
    }
}
