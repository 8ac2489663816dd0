//! The table of PDOs.

use super::{fitting, rows, titled};
use crate::config::{content, milliseconds, why};
use crate::run::gateway::session::LiveGateway;
use edskit_devices::gateway::{Pdo, PdoTable, Source, Traffic, Word};
use edskit_types::PdoDirection;
use ratatui::Frame;
use ratatui::layout::{Constraint, Rect};
use ratatui::style::Stylize;
use ratatui::text::Line;
use ratatui::widgets::{Paragraph, Row, Table};

/// The columns before the content, and one between each two.
const WIDTHS: [u16; 6] = [6, 6, 6, 9, 7, 9];
const BEFORE_CONTENT: u16 = 6 + 6 + 6 + 9 + 7 + 9 + 6;
/// The title and the line with the names of the columns.
const HEAD: u16 = 2;

/// As many rows as show every PDO.
pub(super) fn rows_wanted(gateway: &LiveGateway) -> u16 {
    gateway.pdos().map_or(HEAD, |table| HEAD + rows(table.iter().count()))
}

pub(super) fn draw(frame: &mut Frame<'_>, area: Rect, gateway: &LiveGateway) {
    let Some(table) = gateway.pdos() else {
        let line = Line::raw("none: the gateway has not been initialised");
        return frame.render_widget(Paragraph::new(line).block(titled("PDOs")), area);
    };
    let columns = area.width.saturating_sub(BEFORE_CONTENT);
    let room = usize::from(area.height.saturating_sub(HEAD));
    let pdos = in_order(table);
    let (shown, others) = match pdos.len() {
        count if count <= room => (&pdos[..], 0),
        count => {
            let shown = room.saturating_sub(1);
            (&pdos[..shown], count - shown)
        }
    };
    let mut rows: Vec<Row<'_>> = shown.iter().map(|pdo| row(gateway, pdo, columns)).collect();
    if others > 0 {
        let text = fitting(&format!("{others} more on a higher terminal"), columns);
        rows.push(Row::new(["", "", "", "", "", "", text.as_str()].map(str::to_owned)).dim());
    }
    let head = ["PDO", "CAN-ID", "set", "effective", "count", "interval", "content, or why it is not active"];
    let widths = WIDTHS.map(Constraint::Length).into_iter().chain([Constraint::Fill(1)]);
    let table = Table::new(rows, widths).header(Row::new(head).dim()).block(titled("PDOs (times in ms)"));
    frame.render_widget(table, area);
}

/// The active ones first.
fn in_order(table: &PdoTable) -> Vec<&Pdo> {
    let (active, others): (Vec<&Pdo>, Vec<&Pdo>) = table.iter().partition(|pdo| pdo.activity.is_active());
    [active, others].concat()
}

fn row(gateway: &LiveGateway, pdo: &Pdo, columns: u16) -> Row<'static> {
    let name = pdo.party().to_string();
    let identifier = pdo.can_id.to_string();
    if !pdo.activity.is_active() {
        let why = why(gateway.effective_parameters(), pdo);
        let cells = [name, identifier, String::new(), String::new(), String::new(), String::new()];
        return Row::new(cells.into_iter().chain([fitting(&why, columns)])).dim();
    }
    let (set, effective) = match (pdo.period, pdo.direction) {
        (Some(period), _) => (period.setting_ms.to_string(), milliseconds(period.micros())),
        (None, PdoDirection::Transmit) => (String::new(), "on change".to_owned()),
        (None, PdoDirection::Receive) => (String::new(), "-".to_owned()),
    };
    let traffic = gateway.traffic(pdo);
    let interval = traffic.interval.map_or(String::new(), |micros| format!("{:.1}", micros as f64 / 1000.0));
    let content = fitting(&content_of(gateway, pdo, &traffic), columns);
    let cells = [name, identifier, set, effective, traffic.count.to_string(), interval, content];
    Row::new(cells)
}

/// The words of the last frame with their names; the names alone before the first one.
fn content_of(gateway: &LiveGateway, pdo: &Pdo, traffic: &Traffic) -> String {
    let mut bytes = traffic.data().chunks_exact(2);
    let word = |word: &Word| {
        let name = name_of(gateway, word.source);
        let bytes: Option<[u8; 2]> = bytes.next().and_then(|bytes| bytes.try_into().ok());
        let is_dummy = word.source == Source::Dummy;
        match bytes.map(u16::from_le_bytes).filter(|_| !is_dummy) {
            Some(value) => format!("{name}={}", value_of(word.source, value)),
            None => name,
        }
    };
    pdo.words().iter().map(word).collect::<Vec<_>>().join(", ")
}

/// What a word is, by its name alone where it has one: columns are scarce.
fn name_of(gateway: &LiveGateway, source: Source) -> String {
    let (configuration, signals) = (gateway.effective_parameters(), &gateway.governor().signals);
    match source {
        Source::Signal { number, .. } => {
            signals.name(number).map_or_else(|| number.to_string(), str::to_owned)
        }
        Source::Errors { first } => format!("errors {first}-{}", first + 15),
        Source::SensorFlags => "sensor flags".to_owned(),
        _ => content(configuration, signals, source),
    }
}

/// Analogue values as numbers, bits in hexadecimal digits.
fn value_of(source: Source, value: u16) -> String {
    match source {
        Source::Signal { signed: true, .. } => (value as i16).to_string(),
        Source::Signal { .. } | Source::Sensor { .. } => value.to_string(),
        _ => format!("{value:04X}h"),
    }
}
