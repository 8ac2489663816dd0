use super::judged::{JudgedCobId, Judgement};
use super::parameters::{self, Parameter};
use crate::evaluate::{commissioned, node_ids};
use crate::rule::rule;
use crate::{Context, Report, Severity};
use edskit_types::{CanId, Claim, CobId, IdentifierRules, NodeId, Opponent, Party, SdoRole, conflicts};
use std::collections::HashMap;

rule! {
    /// Two messages of the device have one CAN-ID
    ///
    /// ## What it does
    /// Compares the CAN-IDs of all messages in use: PDOs, SYNC, TIME, EMCY (its own and those it listens to), SDO
    /// channels, its heartbeat and those it monitors. Two RPDOs may share one. In an EDS only what collides at every
    /// node-ID is reported. An RPDO that listens to another message of its own device, and an SDO client of its own
    /// server, are warnings: such values are there to be changed. EMCY at the bare 80h is left to COB002.
    ///
    /// ## Why is this bad
    /// Whoever receives such a frame cannot tell which of the two it is, and two nodes that send it at once destroy it.
    ///
    /// ## Example
    /// ```eds
    /// [1800]
    /// ParameterName=TPDO 1 communication parameter
    /// ObjectType=0x9
    ///
    /// [1800sub1]
    /// ParameterName=COB-ID
    /// DataType=0x0007
    /// DefaultValue=$NODEID+0x180
    ///
    /// [1804]
    /// ParameterName=TPDO 5 communication parameter
    /// ObjectType=0x9
    ///
    /// [1804sub1]
    /// ParameterName=COB-ID
    /// DataType=0x0007
    /// DefaultValue=$NODEID+0x180
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1800]
    /// ParameterName=TPDO 1 communication parameter
    /// ObjectType=0x9
    ///
    /// [1800sub1]
    /// ParameterName=COB-ID
    /// DataType=0x0007
    /// DefaultValue=$NODEID+0x180
    ///
    /// [1804]
    /// ParameterName=TPDO 5 communication parameter
    /// ObjectType=0x9
    ///
    /// [1804sub1]
    /// ParameterName=COB-ID
    /// DataType=0x0007
    /// DefaultValue=0x80000000
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.3.3.
    pub(crate) static DUPLICATE_CAN_ID = {
        code: "COB003",
        name: "duplicate-can-id",
        group: CobId,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    // EMCY at 80h has the CAN-ID of SYNC only because the node-ID was forgotten, which is the matter of COB002.
    let is_bare_emcy = |cob_id: &&JudgedCobId<'_>| {
        cob_id.parameter.party == Party::Emcy && matches!(cob_id.judgement, Some(Judgement::Bare(_)))
    };
    let cob_ids = context.cob_ids().iter().filter(|cob_id| !is_bare_emcy(cob_id));
    let mut parameters: Vec<Parameter<'_>> = cob_ids.map(|cob_id| cob_id.parameter).collect();
    parameters.extend(parameters::sync(context.sheet));
    let mut node_ids = node_ids(context);
    let Some(first) = node_ids.next() else { return };
    let mut found = collisions(context, &parameters, first);
    for other in node_ids {
        let there = collisions(context, &parameters, other);
        found.retain(|collision| there.iter().any(|other| other.parties == collision.parties));
    }
    let values: HashMap<Party, &Parameter<'_>> =
        parameters.iter().map(|parameter| (parameter.party, parameter)).collect();
    for Collision { parties: [party, other], can_id } in found {
        // Of services without a COB-ID of their own nothing stands in the file.
        let Some(parameter) = values.get(&party).or_else(|| values.get(&other)) else { continue };
        let listeners = [party, other].map(|party| listens(party, values.get(&party).copied(), first));
        // Whoever listens to a service does not send it: the own EMCY message is one that somebody may wait for.
        if listeners != [false; 2] && is_same_service(party, other) {
            continue;
        }
        let at = match commissioned(context) {
            None if parameter.value.depends_on_node_id() => format!(" at node-ID {first}"),
            _ => String::new(),
        };
        let finding = report
            .add(parameter.value.span(), format!("{party} and {other} both have the CAN-ID {can_id}{at}"));
        if let Some(second) = values.get(&other).filter(|second| second.party != parameter.party) {
            finding.here(party.to_string()).label(second.value.span(), other.to_string());
        }
        let is_client = |party| matches!(party, Party::Sdo { role: SdoRole::Client, .. });
        if listeners != [false; 2] || is_client(party) || is_client(other) {
            finding.severity(Severity::Warning);
        }
        finding.help("give one of the two another CAN-ID, or set bit 31 of the one that is not in use");
    }
}

/// Whether a device only receives a message.
fn listens(party: Party, parameter: Option<&Parameter<'_>>, node_id: NodeId) -> bool {
    match party {
        Party::EmcyOf(_) | Party::HeartbeatOf(_) => true,
        Party::Sync | Party::Time => {
            let cob_id = parameter.and_then(|parameter| parameter.value.cob_id_at(node_id));
            cob_id.is_some_and(|cob_id| cob_id.0 & CobId::BIT_30 == 0)
        }
        _ => party.is_rpdo(),
    }
}

/// Whether both are EMCY messages, or both heartbeats, of whatever node.
fn is_same_service(party: Party, other: Party) -> bool {
    let is_emcy = |party| matches!(party, Party::Emcy | Party::EmcyOf(_));
    let is_heartbeat = |party| matches!(party, Party::Heartbeat | Party::HeartbeatOf(_));
    is_emcy(party) && is_emcy(other) || is_heartbeat(party) && is_heartbeat(other)
}

/// Two messages with one CAN-ID.
struct Collision {
    parties: [Party; 2],
    can_id: CanId,
}

/// What collides on one node-ID; what is restricted is the matter of COB001.
fn collisions(context: &Context<'_>, parameters: &[Parameter<'_>], node_id: NodeId) -> Vec<Collision> {
    let claim = |parameter: &Parameter<'_>| {
        let cob_id = parameter.used_at(node_id).filter(|cob_id| !cob_id.has_stray_bits())?;
        let is_restricted = IdentifierRules::CIA_301.restriction(cob_id.can_id()).is_some();
        let party = parameter.party;
        // Zeros stand for an SDO channel that nobody has set up.
        (!(is_restricted && party.is_configurable()) && cob_id.can_id().raw() > 0)
            .then_some(Claim { can_id: cob_id.can_id(), party })
    };
    let mut claims: Vec<Claim> = parameters.iter().filter_map(claim).collect();
    if claims.is_empty() {
        return Vec::new();
    }
    claims.extend(parameters::fixed_claims(context.sheet, node_id));
    let rules = IdentifierRules { restricted: &[], ..IdentifierRules::CIA_301 };
    let collision = |conflict: edskit_types::Conflict| match conflict.with {
        Opponent::Party(other) => {
            Some(Collision { parties: [conflict.party, other], can_id: conflict.can_id })
        }
        Opponent::Restricted(_) => None,
    };
    conflicts(&mut claims, &rules).filter_map(collision).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, findings_in};

    fn pdo(index: &str, value: &str) -> String {
        format!("[{index}]\nObjectType=9\n[{index}sub1]\nDataType=7\nDefaultValue={value}\n")
    }

    fn found(text: &str) -> Vec<String> {
        findings(&DUPLICATE_CAN_ID, text)
    }

    #[test]
    fn pdos_and_services() {
        assert_eq!(
            found(&(pdo("1800", "$NODEID+0x180") + &pdo("1805", "$NODEID+0x40000180"))),
            ["10:14 error: TPDO6 and TPDO1 both have the CAN-ID 181h at node-ID 1"]
        );
        assert_eq!(
            found(&(pdo("1800", "$NODEID+0x180") + &pdo("1400", "$NODEID+0x180"))),
            ["5:14 warning: TPDO1 and RPDO1 both have the CAN-ID 181h at node-ID 1"]
        );
        assert_eq!(
            found(&("[1005]\nDataType=7\nDefaultValue=0x90\n".to_owned() + &pdo("1800", "0x90"))),
            ["8:14 warning: TPDO1 and SYNC both have the CAN-ID 090h"],
            "the device only waits for SYNC"
        );
        assert_eq!(
            found(&("[1005]\nDataType=7\nDefaultValue=0x40000090\n".to_owned() + &pdo("1800", "0x90"))),
            ["8:14 error: TPDO1 and SYNC both have the CAN-ID 090h"]
        );
        let sync = "[1005]\nDataType=7\nDefaultValue=0x80\n";
        assert!(found(&format!("{sync}[1014]\nDataType=7\nDefaultValue=0x80\n")).is_empty(), "COB002");
        assert!(found(&(pdo("1400", "0x205") + &pdo("1401", "0x205"))).is_empty());
        assert!(found(&(pdo("1800", "0x185") + &pdo("1801", "0x80000185"))).is_empty());
        assert!(found(&(pdo("1800", "0x180") + &pdo("1801", "0x180"))).is_empty(), "COB001");
    }

    #[test]
    fn who_listens_does_not_send() {
        let consumer =
            |value: &str| format!("[1028]\nObjectType=8\n[1028sub1]\nDataType=7\nDefaultValue={value}\n");
        let own = "[1014]\nDataType=7\nDefaultValue=$NODEID+0x80\n";
        assert_eq!(found(&(own.to_owned() + &consumer("$NODEID+0x80"))), [""; 0]);
        assert_eq!(
            found(&(consumer("0x185") + &pdo("1800", "0x185"))),
            ["10:14 warning: TPDO1 and EMCY of node 1 both have the CAN-ID 185h"]
        );
        let heartbeats = "[1016]\nObjectType=8\n[1016sub1]\nDataType=7\nDefaultValue=0x000503E8\n";
        let dcf = format!("[DeviceComissioning]\nNodeID=5\n{heartbeats}");
        assert_eq!(findings_in(&DUPLICATE_CAN_ID, "a.dcf", dcf.as_bytes()), [""; 0]);
    }

    #[test]
    fn what_collides_at_one_node_id_only_is_no_defect_of_an_eds() {
        let text = pdo("1800", "$NODEID+0x180") + &pdo("1400", "0x181");
        assert!(found(&text).is_empty());
        let dcf = |node: u8| format!("[DeviceComissioning]\nNodeID={node}\n{text}");
        let found = |node| findings_in(&DUPLICATE_CAN_ID, "a.dcf", dcf(node).as_bytes());
        assert!(found(2).is_empty());
        assert_eq!(found(1), ["7:14 warning: TPDO1 and RPDO1 both have the CAN-ID 181h"]);
    }

    #[test]
    fn a_client_of_its_own_server() {
        let text = "[1280]\nObjectType=9\n[1280sub1]\nDataType=7\nDefaultValue=$NODEID+0x600\n";
        assert_eq!(
            found(text),
            [
                "5:14 warning: SDO client 1 request and SDO server request both have the CAN-ID 601h at node-ID 1"
            ]
        );
    }
}
