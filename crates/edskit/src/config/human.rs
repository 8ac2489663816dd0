//! The PDOs as a table for people.

use super::Report;
use super::view::{HeartbeatView, PdoView, TimeView, View};
use edskit_devices::gateway::{CanOpenError, INITIALISATION_ATTEMPTS};
use edskit_lint::Severity;
use std::io::{self, Write};

pub(super) fn write(report: &Report, excerpts: &str, quiet: bool, out: &mut dyn Write) -> io::Result<()> {
    out.write_all(excerpts.as_bytes())?;
    if quiet {
        return Ok(());
    }
    match &report.view {
        Some(view) => table(view, out)?,
        None => {
            writeln!(out, "The PDOs and their identifiers are left out until every entry can be understood.")?
        }
    }
    if let Some(reason) = &report.apart {
        writeln!(
            out,
            "\nGateway and governor do not hear each other, so that there is no initialisation: {reason}."
        )?;
        return writeln!(out, "{}", summary(report));
    }
    match report.is_accepted {
        Some(true) => writeln!(out, "\nThe gateway's own check at its initialisation passes.")?,
        Some(false) => writeln!(
            out,
            "\nThe gateway refuses this configuration: after {INITIALISATION_ATTEMPTS} attempts it stays off CANopen with {}.",
            CanOpenError::Init
        )?,
        None => {}
    }
    writeln!(out, "{}", summary(report))
}

fn summary(report: &Report) -> String {
    let count = |severity| report.problems.iter().filter(|problem| problem.severity == severity).count();
    let kinds = [(Severity::Error, "errors"), (Severity::Warning, "warnings"), (Severity::Info, "info")];
    let counts = kinds.map(|(severity, word)| (count(severity), word)).into_iter();
    let words: Vec<String> = counts
        .filter(|(count, _)| *count > 0)
        .map(|(count, word)| {
            format!("{count} {}", if count == 1 { word.trim_end_matches('s') } else { word })
        })
        .collect();
    match words.is_empty() {
        true => "no findings".to_owned(),
        false => words.join(", "),
    }
}

fn table(view: &View, out: &mut dyn Write) -> io::Result<()> {
    let rate = match view.bit_rate {
        Some(rate) => format!("at {rate} kbit/s"),
        None => "with manual bit timing".to_owned(),
    };
    writeln!(out, "PDOs of node {} {rate}\n", view.node_id)?;
    writeln!(out, "PDO     CAN-ID  bytes  active  because                         set        effective")?;
    for pdo in &view.pdos {
        row(pdo, out)?;
    }
    writeln!(out)?;
    heartbeat("heartbeat", "not sent", &view.heartbeat, out)?;
    if let Some(partner) = &view.partner_heartbeat {
        heartbeat(&format!("heartbeat of node {}", partner.node_id), "not monitored", partner, out)?;
    }
    Ok(())
}

fn row(pdo: &PdoView, out: &mut dyn Write) -> io::Result<()> {
    let bytes = if pdo.active { pdo.bytes.to_string() } else { "-".to_owned() };
    let active = if pdo.active { "yes" } else { "no" };
    let (set, effective) = times(pdo);
    let line = format!(
        "{:<7} {:03X}h    {bytes:>5}  {active:<6}  {:<30}  {set:<9}  {effective}",
        pdo.name, pdo.can_id, pdo.why
    );
    writeln!(out, "{}", line.trim_end())?;
    if pdo.content.is_empty() {
        return Ok(());
    }
    let content: Vec<&str> = pdo.content.iter().map(|word| word.text.as_str()).collect();
    writeln!(out, "        {}", content.join(" | "))
}

/// The time as it is set and as it takes effect.
fn times(pdo: &PdoView) -> (String, String) {
    match pdo.time {
        _ if !pdo.active => (String::new(), String::new()),
        Some(time) => (set(time), effective(time)),
        None if pdo.name.starts_with('R') => (String::new(), "not monitored".to_owned()),
        None => (String::new(), "when its data change".to_owned()),
    }
}

fn set(time: TimeView) -> String {
    format!("{} ms", time.set_ms)
}

fn effective(time: TimeView) -> String {
    let plural = if time.main_cycles == 1 { "" } else { "s" };
    format!("{} ms ({} main cycle{plural})", time.effective_ms, time.main_cycles)
}

fn heartbeat(name: &str, off: &str, view: &HeartbeatView, out: &mut dyn Write) -> io::Result<()> {
    let (set, effective) = match view.time {
        Some(time) => (set(time), effective(time)),
        None => (String::new(), off.to_owned()),
    };
    writeln!(out, "{name:<54} {:03X}h  {set:<9}  {effective}", view.can_id)
}
