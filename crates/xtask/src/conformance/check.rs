//! One run of `conformance.py`, and what it says.

use super::node::{NODE_ID, Node};
use crate::root;
use crate::step::command;
use std::fmt;
use std::fs::{self, File};
use std::path::Path;
use std::time::Duration;

/// How many random frames the script sends in a second over SLCAN. python-can reads SLCAN byte by byte; of a faster flood
/// it takes answers for current ones that are seconds old.
const SLCAN_RATE: &str = "1000";

#[derive(Clone, Copy)]
pub(super) enum Transport {
    Socketcand,
    Slcan,
}

/// A node, and how it is judged.
pub(super) struct Check<'a> {
    pub(super) node: &'a Node,
    pub(super) transport: Transport,
    pub(super) python: &'a Path,
    pub(super) script: &'a Path,
    pub(super) eds: &'a Path,
    /// Checks that are not run, each with its reason.
    pub(super) left_out: &'static [(&'static str, &'static str)],
}

/// What the script says.
pub(super) struct Report {
    pub(super) lines: Vec<Line>,
    /// How many checks ended in which way.
    pub(super) summary: String,
}

/// One check.
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

impl Check<'_> {
    /// The dictionary of the node, its file, and the transport.
    pub(super) fn title(&self) -> String {
        let transport = match self.transport {
            Transport::Socketcand => "socketcand",
            Transport::Slcan => "slcan",
        };
        let file = self.eds.file_stem().unwrap_or_default().display();
        format!("{} {file} over {transport}", self.node.program.title())
    }

    /// Runs all checks.
    pub(super) fn run(&self) -> Result<Report, String> {
        self.run_with("", &[])
    }

    /// Runs one check, which allows times to be wrong by so much.
    pub(super) fn run_again(&self, id: &str, tolerance: Duration) -> Result<Report, String> {
        let tolerance = tolerance.as_millis().to_string();
        self.run_with(&format!("-{id}"), &["--only", id, "--tol", &tolerance])
    }

    /// Runs the script with further arguments; the name of the report gets a suffix.
    fn run_with(&self, suffix: &str, arguments: &[&str]) -> Result<Report, String> {
        let mut command = command(self.python, &[]);
        command.arg(self.script).args(["-n", NODE_ID, "--store", "-e"]).arg(self.eds);
        let Node { socketcand, slcan, .. } = self.node;
        match self.transport {
            Transport::Socketcand => {
                command.args(["-i", "socketcand", "--host", "127.0.0.1", "-c", "can0", "--port", socketcand])
            }
            Transport::Slcan => command
                .args(["-i", "slcan", "--bus", "{\"sleep_after_open\":0}", "--fuzz-rate", SLCAN_RATE, "-c"])
                .arg(format!("socket://127.0.0.1:{slcan}")),
        };
        if !self.left_out.is_empty() {
            let ids: Vec<&str> = self.left_out.iter().map(|(id, _)| *id).collect();
            command.arg("--skip").arg(ids.join(","));
        }
        command.args(arguments);
        let path = root().join(format!("target/conformance-{}{suffix}.txt", self.title().replace(' ', "-")));
        let wrong = |error| format!("{}: {error}", path.display());
        let output = File::create(&path).map_err(wrong)?;
        let status = command.stdout(output).status().map_err(|error| format!("{}: {error}", self.title()))?;
        // 1 says that some checks failed, which the lines say too.
        if !matches!(status.code(), Some(0 | 1)) {
            return Err(format!("{}: {status}", self.title()));
        }
        Report::of(&fs::read_to_string(&path).map_err(wrong)?)
            .ok_or(format!("{}: no summary", path.display()))
    }
}

impl Report {
    fn of(text: &str) -> Option<Self> {
        let lines = text.lines().filter_map(Line::of).collect();
        let is_summary = |line: &&str| line.starts_with('#') && line.contains(" checks in ");
        Some(Self { lines, summary: text.lines().find(is_summary)?.trim_start_matches("# ").to_owned() })
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

    /// Whether the check finds the mean of a period right, and only one message at another time than expected. Each
    /// period of a node is tested to the microsecond in virtual time, so this says something about the machine.
    pub(super) fn is_jitter(&self) -> bool {
        self.verdict == Verdict::Warn && self.text.ends_with("(host jitter?)]")
    }
}

impl fmt::Display for Line {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?} {} {}", self.verdict, self.id, self.text)
    }
}

impl Verdict {
    pub(super) fn is_bad(self) -> bool {
        matches!(self, Self::Fail | Self::Warn)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_late_message_is_told_from_other_warnings() {
        let line = |text| Line::of(text).unwrap();
        assert!(
            line("WARN HB-01  period [mean 100.0 ms ok, but one gap is off by 47.9 ms (host jitter?)]")
                .is_jitter()
        );
        assert!(!line("FAIL HB-01  period [mean period 112.7 ms, expected 100 (+-6.0)]").is_jitter());
        assert!(!line("WARN PDO-08  event timer 0 [2 event-driven PDOs in 0.6 s]").is_jitter());
    }

    #[test]
    fn a_report_is_read_line_by_line() {
        let text = "# a device\nPASS NMT-01  boot-up\nSKIP STO-01  save [not in the EDS]\n\
                    # 2 checks in 1 s: PASS 1, FAIL 0, WARN 0, SKIP 1\n";
        let report = Report::of(text).unwrap();
        assert_eq!(report.summary, "2 checks in 1 s: PASS 1, FAIL 0, WARN 0, SKIP 1");
        let lines: Vec<String> = report.lines.iter().map(Line::to_string).collect();
        assert_eq!(lines, ["Pass NMT-01 boot-up", "Skip STO-01 save [not in the EDS]"]);
        assert_eq!(report.lines[1].reason(), "not in the EDS");
        assert!(
            Report::of("PASS NMT-01  boot-up\n").is_none(),
            "a report that breaks off counts for nothing"
        );
    }
}
