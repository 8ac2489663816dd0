//! One run of `conformance.py`, and what it says.

use super::node::{NODE_ID, Node};
use crate::step::command;
use std::fmt;
use std::path::Path;
use std::process::Stdio;

/// The script, and what it runs on.
#[derive(Clone, Copy)]
pub(super) struct Script<'a> {
    pub(super) python: &'a Path,
    pub(super) path: &'a Path,
}

/// How the script reaches the node.
#[derive(Clone, Copy)]
pub(super) enum Transport {
    /// In virtual time: nothing is ever late, so times are judged exactly.
    Virtual,
    Socketcand,
    Slcan,
}

/// What the script says.
#[derive(Debug)]
pub(super) struct Report {
    pub(super) lines: Vec<Line>,
    /// How many checks ended in which way, and how long they took.
    pub(super) summary: String,
}

/// One check.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Line {
    pub(super) verdict: Verdict,
    pub(super) id: String,
    /// Its title, and in brackets a value or a reason.
    text: String,
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Verdict {
    Pass,
    Fail,
    Warn,
    Skip,
}

impl Transport {
    pub(super) fn protocol(self) -> &'static str {
        match self {
            Self::Virtual => "virtual",
            Self::Socketcand => "socketcand",
            Self::Slcan => "slcan",
        }
    }
}

impl Script<'_> {
    /// Judges a node by its file.
    pub(super) fn judge(
        &self,
        node: &Node,
        transport: Transport,
        eds: &Path,
        options: &[&str],
    ) -> Result<Report, String> {
        let mut command = command(self.python, &[]);
        command.arg(self.path).args(["-n", NODE_ID, "-e"]).arg(eds);
        let port = node.port(transport.protocol())?;
        match transport {
            Transport::Virtual => command.args(["-i", "virtual", "--port", port]),
            Transport::Socketcand => {
                command.args(["-i", "socketcand", "--host", "127.0.0.1", "-c", "can0", "--port", port])
            }
            Transport::Slcan => command
                .args(["-i", "slcan", "--bus", "{\"sleep_after_open\":0}", "-c"])
                .arg(format!("socket://127.0.0.1:{port}")),
        };
        let output =
            command.args(options).stdin(Stdio::null()).output().map_err(|error| error.to_string())?;
        // 1 says that some checks failed, which the lines say too.
        let report = Report::of(&String::from_utf8_lossy(&output.stdout));
        match (output.status.code(), report) {
            (Some(0 | 1), Some(report)) => Ok(report),
            _ => {
                let complaints = String::from_utf8_lossy(&output.stderr);
                let last = complaints.lines().rfind(|line| !line.trim().is_empty());
                Err(last.map_or_else(|| output.status.to_string(), str::to_owned))
            }
        }
    }
}

impl Report {
    fn of(text: &str) -> Option<Self> {
        let lines = text.lines().filter_map(Line::of).collect();
        let is_summary = |line: &&str| line.starts_with('#') && line.contains(" checks in ");
        Some(Self { lines, summary: text.lines().find(is_summary)?.trim_start_matches("# ").to_owned() })
    }

    /// The checks that ended in this way.
    pub(super) fn of_verdict(&self, verdict: Verdict) -> impl Iterator<Item = &Line> {
        self.lines.iter().filter(move |line| line.verdict == verdict)
    }

    /// The checks that do not hold.
    pub(super) fn bad(&self) -> impl Iterator<Item = &Line> {
        self.of_verdict(Verdict::Fail).chain(self.of_verdict(Verdict::Warn))
    }
}

impl Line {
    fn of(line: &str) -> Option<Self> {
        let (verdict, rest) = line.split_once(' ')?;
        let verdict = match verdict {
            "PASS" => Verdict::Pass,
            "FAIL" => Verdict::Fail,
            "WARN" => Verdict::Warn,
            "SKIP" => Verdict::Skip,
            _ => return None,
        };
        let (id, text) = rest.split_once(' ')?;
        Some(Self { verdict, id: id.to_owned(), text: text.trim().to_owned() })
    }

    /// What stands in brackets behind the title.
    pub(super) fn reason(&self) -> &str {
        self.text.split_once(" [").map_or("", |(_, reason)| reason.trim_end_matches(']'))
    }
}

impl fmt::Display for Line {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?} {} {}", self.verdict, self.id, self.text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_report_is_read_line_by_line() {
        let text = "# a device\nPASS NMT-01  boot-up\nSKIP STO-01  save [not in the EDS]\nWARN HB-01  period [late]\n\
                    # 3 checks in 1 s: PASS 1, FAIL 0, WARN 1, SKIP 1\n";
        let report = Report::of(text).unwrap();
        assert_eq!(report.summary, "3 checks in 1 s: PASS 1, FAIL 0, WARN 1, SKIP 1");
        let lines: Vec<String> = report.lines.iter().map(Line::to_string).collect();
        assert_eq!(
            lines,
            ["Pass NMT-01 boot-up", "Skip STO-01 save [not in the EDS]", "Warn HB-01 period [late]"]
        );
        assert_eq!(report.lines[1].reason(), "not in the EDS");
        assert_eq!(report.bad().count(), 1);
        assert!(
            Report::of("PASS NMT-01  boot-up\n").is_none(),
            "a report that breaks off counts for nothing"
        );
    }
}
