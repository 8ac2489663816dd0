//! What is reported of parameter files and scenarios.

mod kinds;

use crate::lint::human::Notice;
use crate::printable;
use edskit_devices::gateway::Parameter;
use edskit_lint::{Label, Severity};
use edskit_model::Span;
pub(crate) use kinds::*;

/// A kind of problem. Codes are never reused; docs/gateway-parameters.md has the list.
#[derive(Debug)]
pub(crate) struct Kind {
    pub(crate) code: &'static str,
    pub(crate) name: &'static str,
    /// How bad it is, where the check does not say otherwise.
    pub(crate) severity: Severity,
    /// The lines of its documentation, each with the blank behind `///`.
    lines: &'static [&'static str],
}

impl Kind {
    /// What it is, in Markdown; the first line is a summary.
    pub(crate) fn docs(&self) -> String {
        let lines = self.lines.iter().map(|line| line.strip_prefix(' ').unwrap_or(line));
        lines.collect::<Vec<_>>().join("\n")
    }

    /// The first line of its documentation.
    pub(crate) fn summary(&self) -> &'static str {
        self.lines.first().map(|line| line.trim()).unwrap_or_default()
    }
}

/// One problem in a file.
#[derive(Debug)]
pub(crate) struct Problem {
    pub(crate) kind: &'static Kind,
    pub(crate) severity: Severity,
    /// One sentence without a full stop.
    pub(crate) message: String,
    /// The first is the place itself.
    pub(crate) labels: Vec<Label>,
    pub(crate) help: Option<String>,
    /// The identifiers of whose decimal digits it speaks.
    pub(crate) decimals: Box<[Parameter]>,
    /// How it is called where several of its kind are told in one.
    brief: Option<Box<str>>,
}

impl Problem {
    pub(crate) fn new(kind: &'static Kind, place: Label, message: impl Into<String>) -> Self {
        let (severity, message) = (kind.severity, message.into());
        Self {
            kind,
            severity,
            message,
            labels: vec![place],
            help: None,
            decimals: Box::default(),
            brief: None,
        }
    }

    /// A problem at a place that needs no words.
    pub(crate) fn at(kind: &'static Kind, span: Span, message: impl Into<String>) -> Self {
        Self::new(kind, Label { span, text: String::new() }, message)
    }

    pub(crate) fn label(mut self, span: Span, text: impl Into<String>) -> Self {
        self.labels.push(Label { span, text: text.into() });
        self
    }

    pub(crate) fn labels(mut self, labels: impl IntoIterator<Item = Label>) -> Self {
        for label in labels {
            // Two remarks on one stretch would only draw it twice.
            match self.labels.iter_mut().find(|own| own.span == label.span) {
                Some(own) if own.text.contains(&label.text) => {}
                Some(own) if own.text.is_empty() => own.text = label.text,
                Some(own) => own.text = format!("{}; {}", own.text, label.text),
                None => self.labels.push(label),
            }
        }
        self
    }

    pub(crate) fn help(mut self, text: impl Into<String>) -> Self {
        self.help = Some(text.into());
        self
    }

    pub(crate) fn severity(mut self, severity: Severity) -> Self {
        self.severity = severity;
        self
    }

    /// It speaks of the decimal digits of these identifiers.
    pub(crate) fn decimals(mut self, parameters: impl IntoIterator<Item = Parameter>) -> Self {
        self.decimals = parameters.into_iter().collect();
        self
    }

    /// This one can be told together with others of its kind, and is called so there.
    pub(crate) fn brief(mut self, text: impl Into<String>) -> Self {
        self.brief = Some(text.into().into_boxed_str());
        self
    }

    pub(crate) fn can_be_merged(&self) -> bool {
        self.brief.is_some()
    }

    /// The same with nothing that would steer a terminal; texts quote the file.
    pub(crate) fn printable(mut self) -> Self {
        let texts = self.labels.iter_mut().map(|label| &mut label.text);
        for text in texts.chain([&mut self.message]).chain(&mut self.help) {
            *text = printable::line(text);
        }
        self
    }

    pub(crate) fn span(&self) -> Span {
        self.labels[0].span
    }
}

/// How many of those that are told in one are named, and how many are shown with their places.
const NAMED: usize = 12;
const SHOWN: usize = 3;

/// Puts those that can be told together into one, at the place of the first. `message` says how many of what they are, and
/// `help` what to do.
pub(crate) fn merged(problems: Vec<Problem>, message: impl Fn(usize) -> String, help: &str) -> Vec<Problem> {
    let (together, mut others): (Vec<Problem>, Vec<Problem>) =
        problems.into_iter().partition(|problem| problem.brief.is_some());
    let [first, rest @ ..] = &together[..] else { return others };
    if rest.is_empty() {
        others.extend(together);
        return others;
    }
    let count = together.len();
    let names = together.iter().take(NAMED).filter_map(|problem| problem.brief.as_deref());
    let mut names: Vec<String> = names.map(str::to_owned).collect();
    if count > NAMED {
        names.push(format!("and {} more", count - NAMED));
    }
    let message = format!("{}: {}", message(count), names.join(", "));
    let places =
        rest.iter().take(SHOWN - 1).map(|problem| Label { span: problem.span(), text: String::new() });
    let place = Label { span: first.span(), text: "the first one".to_owned() };
    let problem = Problem::new(first.kind, place, message).severity(first.severity);
    others.push(problem.labels(places).help(help));
    others
}

impl<'a> From<&'a Problem> for Notice<'a> {
    fn from(problem: &'a Problem) -> Self {
        Self {
            title: format!("{} {}", problem.kind.code, problem.kind.name),
            severity: problem.severity,
            message: &problem.message,
            labels: &problem.labels,
            help: problem.help.clone(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_lists_every_kind() {
        let page = include_str!("../../../../../docs/gateway-parameters.md");
        let rows: Vec<&str> = page.lines().filter(|line| line.starts_with("| GWC")).collect();
        assert_eq!(rows.len(), ALL.len());
        for (row, kind) in rows.iter().zip(ALL) {
            let start = format!("| {} | {} | {} |", kind.code, kind.name, kind.severity);
            assert!(row.starts_with(&start), "{row}: {start}");
        }
    }

    #[test]
    fn codes_and_names_are_unique_and_ordered() {
        assert!(ALL.is_sorted_by(|a, b| a.code < b.code));
        for (position, kind) in ALL.iter().enumerate() {
            assert!(ALL[..position].iter().all(|other| other.name != kind.name), "{}", kind.name);
        }
    }
}
