//! What is wrong with a COB-ID, so that each defect has one rule.

use super::parameters::{self, Parameter};
use crate::Context;
use crate::evaluate::node_ids;
use edskit_types::{CobId, IdentifierRules, NodeId, Party, Restriction};

/// The first thing that is wrong with the COB-ID of a message in use.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Judgement {
    /// Bits that belong to no 11-bit CAN-ID (COB004).
    Stray(CobId),
    /// A 29-bit CAN-ID (COB005).
    Extended(CobId),
    /// The CAN-ID is restricted at a node-ID, or at all of them (COB001).
    Restricted { cob_id: CobId, node_id: NodeId, restriction: Restriction, always: bool },
    /// The bare base of a pre-defined CAN-ID: the node-ID was forgotten (COB002).
    Bare(CobId),
    /// The pre-defined CAN-ID of this message on one node (COB006).
    OfNode { cob_id: CobId, node: u32 },
    /// Nothing of all that.
    Fine(CobId),
}

/// A COB-ID parameter with what is wrong with it.
pub(crate) struct JudgedCobId<'a> {
    pub(super) parameter: Parameter<'a>,
    /// `None` where the message is not in use or the COB-ID is not known.
    pub(super) judgement: Option<Judgement>,
}

impl<'a> JudgedCobId<'a> {
    pub(crate) fn all(context: &Context<'a>) -> Vec<Self> {
        let judged = |parameter| Self { judgement: judge(context, &parameter), parameter };
        parameters::all(context).into_iter().map(judged).collect()
    }
}

/// The lowest and the highest base of the pre-defined connection set besides that of EMCY.
const BASES: core::ops::RangeInclusive<u32> = 0x180..=0x600;

/// Judges a COB-ID; `None` where the message is not in use or the COB-ID is not known.
fn judge(context: &Context<'_>, parameter: &Parameter<'_>) -> Option<Judgement> {
    let mut at = node_ids(context).filter_map(|node_id| Some((node_id, parameter.used_at(node_id)?)));
    let (_, first) = at.clone().next()?;
    if let Some((_, cob_id)) = at.find(|(_, cob_id)| cob_id.has_stray_bits()) {
        return Some(Judgement::Stray(cob_id));
    }
    if first.is_extended() {
        return Some(Judgement::Extended(first));
    }
    if parameter.party.is_configurable()
        && let Some(judgement) = restricted(context, parameter)
    {
        return Some(judgement);
    }
    if parameter.value.depends_on_node_id() {
        return Some(Judgement::Fine(first));
    }
    let id = first.can_id().raw();
    let is_bare = match parameter.party {
        Party::Pdo { .. } => BASES.contains(&id) && id % 0x80 == 0,
        Party::Emcy => id == 0x80,
        _ => false,
    };
    if is_bare {
        return Some(Judgement::Bare(first));
    }
    let node = parameter.base().and_then(|base| id.checked_sub(base)).filter(|node| (1..=127).contains(node));
    Some(match node {
        Some(node) => Judgement::OfNode { cob_id: first, node },
        None => Judgement::Fine(first),
    })
}

fn restricted(context: &Context<'_>, parameter: &Parameter<'_>) -> Option<Judgement> {
    let mut found = None;
    let mut always = true;
    for node_id in node_ids(context) {
        let Some(cob_id) = parameter.used_at(node_id) else { continue };
        match IdentifierRules::CIA_301.restriction(cob_id.can_id()) {
            Some(restriction) => {
                found.get_or_insert((cob_id, node_id, restriction));
            }
            None => always = false,
        }
    }
    let (cob_id, node_id, restriction) = found?;
    Some(Judgement::Restricted { cob_id, node_id, restriction, always })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::FileKind;
    use edskit_model::Datasheet;

    fn judged(index: &str, value: &str) -> Option<Judgement> {
        let text = match index {
            "1014" => format!("[1014]\nDataType=7\nDefaultValue={value}\n"),
            _ => format!("[{index}]\nObjectType=9\n[{index}sub1]\nDataType=7\nDefaultValue={value}\n"),
        };
        let sheet = Datasheet::parse(text.as_bytes());
        let context = Context::new(&sheet, FileKind::Eds, None);
        context.cob_ids().first().and_then(|cob_id| cob_id.judgement)
    }

    #[test]
    fn each_defect_has_one_name() {
        let fine = |id| Some(Judgement::Fine(CobId(id)));
        assert_eq!(judged("1800", "$NODEID+0x180"), fine(0x181));
        assert_eq!(judged("1800", "0x80000185"), None);
        assert_eq!(judged("1800", "0x1185"), Some(Judgement::Stray(CobId(0x1185))));
        assert_eq!(judged("1800", "$NODEID+0x7F0"), Some(Judgement::Stray(CobId(0x86F))));
        assert_eq!(judged("1800", "0x20000185"), Some(Judgement::Extended(CobId(0x2000_0185))));
        assert_eq!(judged("1400", "0x40000200"), Some(Judgement::Bare(CobId(0x4000_0200))));
        assert_eq!(judged("1014", "0x80"), Some(Judgement::Bare(CobId(0x80))));
        assert_eq!(judged("1801", "0x286"), Some(Judgement::OfNode { cob_id: CobId(0x286), node: 6 }));
        assert_eq!(judged("1400", "0x186"), fine(0x186));
        assert!(matches!(judged("1800", "0x180"), Some(Judgement::Restricted { always: true, .. })));
        assert!(matches!(judged("1804", "$NODEID+0x680"), Some(Judgement::Restricted { always: false, .. })));
    }
}
