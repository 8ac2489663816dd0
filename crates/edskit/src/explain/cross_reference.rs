//! The page of what other tools find, against the rules.

use askama::Template;
use edskit_lint::{PEER_FINDINGS, Peer, PeerFinding, Rule};
use std::io;

#[derive(Template)]
#[template(path = "docs/cross-reference.md")]
struct CrossReference<'a> {
    tools: Vec<Tool<'a>>,
    /// How many rules there are.
    rules: usize,
    /// The rules that cover nothing that another tool finds.
    own: Vec<&'a Rule>,
}

struct Tool<'a> {
    peer: Peer,
    findings: Vec<(&'static PeerFinding, Vec<&'a Rule>)>,
}

/// The page as Markdown. A finding without a rule shows its reason.
pub(super) fn page(rules: &[&Rule]) -> io::Result<String> {
    let covers = |rule: &Rule, finding: &PeerFinding| rule.peers.contains(&(finding.peer, finding.id));
    let rules_of = |finding| rules.iter().copied().filter(|rule| covers(rule, finding)).collect();
    let tools = Peer::ALL.map(|peer| {
        let findings = PEER_FINDINGS.iter().filter(|finding| finding.peer == peer);
        Tool { peer, findings: findings.map(|finding| (finding, rules_of(finding))).collect() }
    });
    let own = rules.iter().copied().filter(|rule| rule.peers.is_empty()).collect();
    CrossReference { tools: tools.into(), rules: rules.len(), own }.render().map_err(io::Error::other)
}
