//! `edskit explain`: what the rules say of themselves.

mod cross_reference;

use crate::cli::{ExplainArguments, ExplainFormat};
use crate::{Exit, Streams};
use askama::Template;
use edskit_lint::{Group, Rule, find, rules};
use serde::Serialize;
use std::io::{self, Write};

pub(crate) fn run(arguments: &ExplainArguments, streams: &mut Streams) -> io::Result<Exit> {
    let mut chosen: Vec<&'static Rule> = Vec::new();
    if arguments.all {
        chosen.clone_from(&rules::ALL);
    }
    for selector in &arguments.rules {
        match find(selector) {
            Ok(found) => chosen.extend(found),
            Err(error) => {
                streams.complain(format_args!("{error}"));
                return Ok(Exit::Failed);
            }
        }
    }
    let out = &mut streams.stdout;
    match arguments.format {
        ExplainFormat::Human => {
            for (position, rule) in chosen.iter().enumerate() {
                if position > 0 {
                    writeln!(out, "\n{}\n", "-".repeat(80))?;
                }
                write_rule(rule, out)?;
            }
        }
        ExplainFormat::Markdown => out.write_all(markdown_page(&chosen)?.as_bytes())?,
        ExplainFormat::CrossReference => out.write_all(cross_reference::page(&chosen)?.as_bytes())?,
        ExplainFormat::Json => {
            let explained: Vec<_> = chosen.iter().map(|rule| ExplainedRule::new(rule)).collect();
            serde_json::to_writer_pretty(&mut *out, &explained)?;
            writeln!(out)?;
        }
    }
    out.flush()?;
    Ok(Exit::Clean)
}

fn write_rule(rule: &Rule, out: &mut dyn Write) -> io::Result<()> {
    let state = if rule.enabled { "" } else { ", off by default" };
    writeln!(out, "{} {} ({}{state}, since {})\n", rule.code, rule.name, rule.severity, rule.since)?;
    writeln!(out, "{}", rule.docs())
}

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

fn markdown_page(chosen: &[&'static Rule]) -> io::Result<String> {
    let page_of = |rule: &&&'static Rule| {
        let docs = rule.docs();
        let (_, body) = docs.split_once('\n').unwrap_or_default();
        RulePage { rule: ExplainedRule::new(rule), body: body.replace("\n## ", "\n#### ").trim().to_owned() }
    };
    let groups = Group::ALL.iter().map(|group| GroupPage {
        prefix: group.prefix(),
        title: group.title(),
        rules: chosen.iter().filter(|rule| rule.group == *group).map(|rule| page_of(&rule)).collect(),
    });
    let groups = groups.filter(|group| !group.rules.is_empty()).collect();
    RulesPage { groups }.render().map_err(io::Error::other)
}
