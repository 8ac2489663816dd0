//! What is reported of parameter files and scenarios.

use crate::lint::human::Notice;
use crate::printable;
use edskit_lint::{Label, Severity};
use edskit_model::Span;

/// A kind of problem. Codes are never reused; docs/gateway-parameters.md has the list.
#[derive(Debug)]
pub(crate) struct Kind {
    pub(crate) code: &'static str,
    pub(crate) name: &'static str,
    /// How bad it is, where the check does not say otherwise.
    severity: Severity,
}

macro_rules! kinds {
    ($($(#[doc = $doc:literal])* $kind:ident = $code:literal $name:literal $severity:ident;)*) => {
        $(
            $(#[doc = $doc])*
            pub(crate) const $kind: &Kind =
                &Kind { code: $code, name: $name, severity: Severity::$severity };
        )*

        /// Every kind, in the order of the codes.
        #[cfg(test)]
        const ALL: &[&Kind] = &[$($kind),*];
    };
}

kinds! {
    /// The file is no TOML.
    TOML_SYNTAX = "GWC001" "toml-syntax" Error;
    /// `device` is missing or names something else.
    UNKNOWN_DEVICE = "GWC002" "unknown-device" Error;
    /// A key that the file has no place for.
    UNKNOWN_KEY = "GWC003" "unknown-key" Error;
    /// A parameter that does not exist.
    UNKNOWN_PARAMETER = "GWC004" "unknown-parameter" Error;
    /// A measured value is set.
    MEASURED_VALUE = "GWC005" "measured-value" Error;
    /// A key stands twice, or a parameter under two of its names.
    DUPLICATE_KEY = "GWC006" "duplicate-key" Error;
    /// Number and name of a key belong to two parameters.
    NAME_NUMBER_MISMATCH = "GWC007" "name-number-mismatch" Error;
    /// A value is no number.
    WRONG_TYPE = "GWC008" "wrong-type" Error;
    /// A parameter cannot have this value.
    OUT_OF_RANGE = "GWC009" "out-of-range" Error;
    /// `[governor.signals]` is not understood.
    INVALID_SIGNAL = "GWC010" "invalid-signal" Error;
    /// Two have one identifier, or one that the gateway forbids (7.3, checks 1 to 8).
    IDENTIFIER_CONFLICT = "GWC011" "identifier-conflict" Error;
    /// Gateway and partner have one node-ID (7.3, check 9).
    EQUAL_NODE_IDS = "GWC012" "equal-node-ids" Error;
    /// CiA 301 restricts an identifier that the gateway accepts.
    RESTRICTED_CAN_ID = "GWC013" "restricted-can-id" Warning;
    /// The engine stop comes from CANopen.
    ENGINE_STOP = "GWC014" "engine-stop-from-canopen" Error;
    /// A switch function or sensor comes from CANopen, but from nowhere there.
    UNASSIGNED_INPUT = "GWC015" "unassigned-input" Warning;
    /// Two switch functions on one bit, or two sensors on one channel.
    SHARED_INPUT = "GWC016" "shared-input" Info;
    /// A TPDO is to carry a single bit.
    NOT_ANALOGUE = "GWC017" "not-analogue" Warning;
    /// Nothing is known of a parameter that a TPDO is to carry.
    UNKNOWN_SIGNAL = "GWC018" "unknown-signal" Info;
    /// A time is longer than the longest.
    CAPPED_TIME = "GWC019" "capped-time" Warning;
    /// A TPDO has data or a cycle time, but not both.
    IDLE_TPDO = "GWC020" "idle-tpdo" Info;
    /// The heartbeat of nobody is monitored.
    NO_PARTNER = "GWC021" "no-partner" Warning;
    /// What must be equal in gateway and governor is not.
    UNITS_DISAGREE = "GWC022" "units-disagree" Error;
    /// Gateway and governor do not talk to each other.
    COMMUNICATION_OFF = "GWC023" "communication-off" Warning;
    /// An identifier is written in decimal digits.
    DECIMAL_IDENTIFIER = "GWC024" "decimal-identifier" Info;
    /// A word of a scenario is none of those that can stand there.
    UNKNOWN_WORD = "GWC025" "unknown-word" Error;
    /// A step of a scenario does not say when it is.
    NO_TIME = "GWC026" "no-time" Error;
    /// A step of a scenario is after the end of the simulation.
    TOO_LATE = "GWC027" "too-late" Warning;
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
}

impl Problem {
    pub(crate) fn new(kind: &'static Kind, place: Label, message: impl Into<String>) -> Self {
        Self { kind, severity: kind.severity, message: message.into(), labels: vec![place], help: None }
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
        let page = include_str!("../../../../docs/gateway-parameters.md");
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
