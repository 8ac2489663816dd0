//! `edskit explain`: what the rules say of themselves.

mod cross_reference;

use crate::cli::{ExplainArguments, ExplainFormat};
use crate::config::problem::{ALL, Kind};
use crate::{Exit, Streams};
use askama::Template;
use edskit_lint::{Group, Rule, UnknownRule, find, nearest, rules};
use serde::Serialize;
use std::io::{self, Write};

pub(crate) fn run(arguments: &ExplainArguments, streams: &mut Streams) -> io::Result<Exit> {
    let mut chosen: Vec<&'static Rule> = Vec::new();
    let mut kinds: Vec<&'static Kind> = Vec::new();
    if arguments.all {
        chosen.clone_from(&rules::ALL);
        // The pages that are made of all rules are those of the linter.
        if matches!(arguments.format, ExplainFormat::Human | ExplainFormat::Json) {
            kinds.extend(ALL);
        }
    }
    for selector in &arguments.rules {
        let of_parameters = kinds_named(selector);
        match find(selector) {
            Ok(found) => chosen.extend(found),
            Err(error) if of_parameters.is_empty() => {
                streams.complain(format_args!("{}", unknown(error)));
                return Ok(Exit::Failed);
            }
            Err(_) => {}
        }
        kinds.extend(of_parameters);
    }
    let out = &mut streams.stdout;
    match arguments.format {
        ExplainFormat::Human => {
            let rules = chosen.iter().map(|rule| rule_in_words(rule));
            let texts: Vec<String> = rules.chain(kinds.iter().map(|kind| kind_in_words(kind))).collect();
            write!(out, "{}", texts.join(&format!("\n{}\n\n", "-".repeat(80))))?;
        }
        ExplainFormat::Markdown => out.write_all(markdown_page(&chosen, &kinds)?.as_bytes())?,
        ExplainFormat::CrossReference => out.write_all(cross_reference::page(&chosen)?.as_bytes())?,
        ExplainFormat::Json => {
            let rules = chosen.iter().map(|rule| ExplainedRule::new(rule));
            let explained: Vec<_> =
                rules.chain(kinds.iter().map(|kind| ExplainedRule::of_kind(kind))).collect();
            serde_json::to_writer_pretty(&mut *out, &explained)?;
            writeln!(out)?;
        }
    }
    out.flush()?;
    Ok(Exit::Clean)
}

/// The kinds of findings on parameter files and scenarios that a code, a name or a prefix of codes names.
fn kinds_named(selector: &str) -> Vec<&'static Kind> {
    let wanted = selector.trim();
    let code = wanted.to_ascii_uppercase();
    let is_named = |kind: &&&'static Kind| {
        code == "ALL"
            || (!code.is_empty() && kind.code.starts_with(&code))
            || kind.name.eq_ignore_ascii_case(wanted)
    };
    ALL.iter().filter(is_named).copied().collect()
}

/// The same for a selector of neither, which may be meant for one of them.
fn unknown(error: UnknownRule) -> UnknownRule {
    let lower = error.selector.to_ascii_lowercase();
    let kinds = ALL.iter().flat_map(|kind| [kind.code, kind.name]);
    let is_of_parameters = lower.starts_with("gwc");
    let near = nearest(&lower, kinds).filter(|_| is_of_parameters || error.nearest.is_none());
    UnknownRule { nearest: near.or(error.nearest), ..error }
}

fn rule_in_words(rule: &Rule) -> String {
    let state = if rule.enabled { "" } else { ", off by default" };
    format!(
        "{} {} ({}{state}, since {})\n\n{}\n",
        rule.code,
        rule.name,
        rule.severity,
        rule.since,
        rule.docs()
    )
}

fn kind_in_words(kind: &Kind) -> String {
    format!("{} {} ({}, since {SINCE})\n\n{}\n", kind.code, kind.name, kind.severity, kind.docs())
}

/// Since when there are findings on parameter files and scenarios.
const SINCE: &str = "0.1.0";
/// What they are about, and how their codes begin.
const KINDS: (&str, &str) = ("parameter files and scenarios of the gateway", "GWC");

#[derive(Serialize)]
struct ExplainedRule {
    code: &'static str,
    name: &'static str,
    group: &'static str,
    severity: &'static str,
    enabled: bool,
    since: &'static str,
    summary: &'static str,
    /// The findings of other tools that it covers.
    peers: Vec<String>,
    documentation: String,
}

impl ExplainedRule {
    fn new(rule: &Rule) -> Self {
        Self {
            code: rule.code,
            name: rule.name,
            group: rule.group.title(),
            severity: rule.severity.name(),
            enabled: rule.enabled,
            since: rule.since,
            summary: rule.summary(),
            peers: rule.peers.iter().map(|(peer, id)| format!("{} {id}", peer.name())).collect(),
            documentation: rule.docs(),
        }
    }

    fn of_kind(kind: &Kind) -> Self {
        Self {
            code: kind.code,
            name: kind.name,
            group: KINDS.0,
            severity: kind.severity.name(),
            enabled: true,
            since: SINCE,
            summary: kind.summary(),
            peers: Vec::new(),
            documentation: kind.docs(),
        }
    }
}

#[derive(Template)]
#[template(path = "docs/rules.md")]
struct RulesPage {
    groups: Vec<GroupPage>,
}

struct GroupPage {
    prefix: &'static str,
    title: &'static str,
    rules: Vec<RulePage>,
}

struct RulePage {
    rule: ExplainedRule,
    /// The documentation behind its summary, one level of headings deeper.
    body: String,
}

fn markdown_page(chosen: &[&'static Rule], kinds: &[&'static Kind]) -> io::Result<String> {
    let page = |rule: ExplainedRule| {
        let (_, body) = rule.documentation.split_once('\n').unwrap_or_default();
        RulePage { body: body.replace("\n## ", "\n#### ").trim().to_owned(), rule }
    };
    let page_of = |rule: &&&'static Rule| page(ExplainedRule::new(rule));
    let of_parameters = GroupPage {
        prefix: KINDS.1,
        title: KINDS.0,
        rules: kinds.iter().map(|kind| page(ExplainedRule::of_kind(kind))).collect(),
    };
    let groups = Group::ALL.iter().map(|group| GroupPage {
        prefix: group.prefix(),
        title: group.title(),
        rules: chosen.iter().filter(|rule| rule.group == *group).map(|rule| page_of(&rule)).collect(),
    });
    let groups = groups.chain([of_parameters]).filter(|group| !group.rules.is_empty()).collect();
    RulesPage { groups }.render().map_err(io::Error::other)
}
