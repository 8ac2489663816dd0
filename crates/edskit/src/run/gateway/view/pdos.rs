//! The table of PDOs.

use super::text::{fitting, wrapped};
use super::{rows, titled};
use crate::config::{content, milliseconds, why};
use crate::run::gateway::session::LiveGateway;
use edskit_devices::gateway::{Pdo, PdoTable, Source, Traffic, Word};
use edskit_types::PdoDirection;
use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::text::Line;
use ratatui::widgets::Paragraph;

/// The columns before the content, with a blank behind each: of a wide table, and of a narrow one, which has the first two.
const BEFORE_CONTENT: u16 = 6 + 6 + 6 + 9 + 7 + 9 + 6;
/// The least room for the content of a wide table.
const LEAST_CONTENT: u16 = 26;
/// The title and the line with the names of the columns.
const HEAD: u16 = 2;
/// How many rows a reason may have.
const MOST_REASON: usize = 6;

/// As many rows as show every PDO, or the reason why there is none.
pub(super) fn rows_wanted(gateway: &LiveGateway, reason: Option<&str>, columns: u16) -> u16 {
    match gateway.pdos() {
        Some(table) => HEAD + rows(table.iter().count()),
        None => 1 + rows(wrapped(reason.unwrap_or_default(), columns, 0, MOST_REASON).len()),
    }
}

/// `reason` is why there is none.
pub(super) fn draw(frame: &mut Frame<'_>, area: Rect, gateway: &LiveGateway, reason: Option<&str>) {
    let Some(table) = gateway.pdos() else {
        let room = usize::from(area.height.saturating_sub(1));
        let lines = wrapped(reason.unwrap_or_default(), area.width, 0, room.min(MOST_REASON));
        let lines: Vec<Line<'_>> = lines.into_iter().map(Line::raw).collect();
        return frame.render_widget(Paragraph::new(lines).block(titled("PDOs", area)), area);
    };
    let room = usize::from(area.height.saturating_sub(HEAD));
    let pdos = in_order(table);
    let (shown, others) = match pdos.len() {
        count if count <= room => (&pdos[..], 0),
        count => {
            let shown = room.saturating_sub(1);
            (&pdos[..shown], count - shown)
        }
    };
    let head = ["PDO", "CAN-ID", "set", "effective", "count", "interval", "content, or why not active"];
    let mut lines = vec![line(head.map(str::to_owned), area.width, Style::new().dim())];
    lines.extend(shown.iter().map(|pdo| row(gateway, pdo, area.width)));
    if others > 0 {
        let text = fitting(&format!("… {others} more on a higher terminal"), area.width);
        lines.push(Line::styled(text, Style::new().dim()));
    }
    frame.render_widget(Paragraph::new(lines).block(titled("PDOs (times in ms)", area)), area);
}

/// The cells of a row, as many as there is room for.
fn line(cells: [String; 7], columns: u16, style: Style) -> Line<'static> {
    let [name, identifier, set, effective, count, interval, content] = cells;
    let text = match columns >= BEFORE_CONTENT + LEAST_CONTENT {
        true => {
            format!("{name:<6} {identifier:<6} {set:<6} {effective:<9} {count:<7} {interval:<9} {content}")
        }
        false => format!("{name:<6} {identifier:<6} {content}"),
    };
    Line::styled(fitting(text.trim_end(), columns), style)
}

/// The active ones first.
fn in_order(table: &PdoTable) -> Vec<&Pdo> {
    let (active, others): (Vec<&Pdo>, Vec<&Pdo>) = table.iter().partition(|pdo| pdo.activity.is_active());
    [active, others].concat()
}

fn row(gateway: &LiveGateway, pdo: &Pdo, columns: u16) -> Line<'static> {
    let name = pdo.party().to_string();
    let identifier = pdo.can_id.to_string();
    if !pdo.activity.is_active() {
        let why = why(gateway.effective_parameters(), pdo);
        let empty = String::new;
        return line(
            [name, identifier, empty(), empty(), empty(), empty(), why],
            columns,
            Style::new().dim(),
        );
    }
    let (set, effective) = match (pdo.period, pdo.direction) {
        (Some(period), _) => (period.setting_ms.to_string(), milliseconds(period.micros())),
        (None, PdoDirection::Transmit) => (String::new(), "on change".to_owned()),
        (None, PdoDirection::Receive) => (String::new(), "-".to_owned()),
    };
    let traffic = gateway.traffic(pdo);
    let interval = traffic.interval.map_or(String::new(), |micros| format!("{:.1}", micros as f64 / 1000.0));
    let content = content_of(gateway, pdo, &traffic);
    line(
        [name, identifier, set, effective, traffic.count.to_string(), interval, content],
        columns,
        Style::new(),
    )
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
        Source::Signal { number, .. } => signals.name(number).unwrap_or_else(|| number.to_string()),
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
