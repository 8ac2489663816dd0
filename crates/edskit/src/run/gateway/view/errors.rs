//! The errors that are present, and those that have been.

use super::text::{fitting, wrapped};
use super::titled;
use crate::run::gateway::session::{ENGINE_ERRORS, LiveGateway};
use edskit_devices::gateway::{EepromErrors, GatewayError, measured_value};
use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::style::{Color, Style};
use ratatui::text::Line;
use ratatui::widgets::Paragraph;

/// The columns before what an error means.
const BEFORE_MEANING: usize = 4 + 1 + 5 + 1 + 18 + 1 + 4 + 1;
/// How many lines one error may have.
const MOST_LINES: usize = 20;

/// One error, in as many lines as it needs.
pub(super) struct Shown {
    lines: Vec<String>,
    style: Style,
}

/// All of them, those that are present first.
pub(super) fn shown(gateway: &LiveGateway, columns: u16) -> Vec<Shown> {
    let now = Style::new().fg(Color::Red);
    let one = |when: &str, number: &str, name: &str, count: &str, meaning: &str, style| {
        let text = format!("{when:<4} {number:<5} {name:<18} {count:<4} {meaning}");
        Shown { lines: wrapped(text.trim_end(), columns, BEFORE_MEANING, MOST_LINES), style }
    };
    let of_the_gateway = |error: GatewayError, when, style| {
        let (number, count) = (error.number().to_string(), format!("{}x", gateway.error_count(error)));
        one(when, &number, error.name(), &count, error.meaning(), style)
    };
    let present: Vec<GatewayError> = gateway.errors().collect();
    let own = present.iter().map(|error| of_the_gateway(*error, "now", now));
    let eeprom = Some(gateway.eeprom_errors()).filter(|errors| !errors.is_empty()).map(|errors| {
        let name = measured_value(EepromErrors::NUMBER).unwrap_or_default();
        let meaning = format!("{:04X}h: {errors}", errors.0);
        one("now", &EepromErrors::NUMBER.to_string(), name, "", &meaning, now)
    });
    let can_open = gateway.can_open_errors().iter();
    let can_open =
        can_open.map(|error| one("now", &error.number().to_string(), error.name(), "", error.meaning(), now));
    let engine = of_the_engine(gateway)
        .map(|numbers| one("now", "", "", "", &format!("of the engine or its sensors: {numbers}"), now));
    let past = GatewayError::ALL.into_iter().filter(|error| !present.contains(error));
    let past = past.filter(|error| gateway.error_count(*error) > 0);
    let past = past.map(|error| of_the_gateway(error, "past", Style::new().dim()));
    let mut shown: Vec<Shown> = own.chain(eeprom).chain(can_open).chain(engine).chain(past).collect();
    if shown.is_empty() {
        shown.push(one("none", "", "", "", "", Style::new()));
    }
    shown
}

/// How many lines they all need.
pub(super) fn lines_wanted(shown: &[Shown]) -> usize {
    shown.iter().map(|error| error.lines.len()).sum()
}

pub(super) fn draw(frame: &mut Frame<'_>, area: Rect, shown: &[Shown]) {
    let room = usize::from(area.height.saturating_sub(1));
    let mut lines: Vec<Line<'_>> = Vec::new();
    for (nth, error) in shown.iter().enumerate() {
        let is_last = nth + 1 == shown.len();
        // The last line is kept for the count of those that do not fit.
        let needed = error.lines.len() + usize::from(!is_last);
        if lines.len() + needed > room {
            let count = shown.len() - nth;
            let text = format!("… {count} more on a higher terminal");
            lines.push(Line::styled(fitting(&text, area.width), error.style));
            break;
        }
        lines.extend(error.lines.iter().map(|line| Line::styled(line.as_str(), error.style)));
    }
    frame.render_widget(Paragraph::new(lines).block(titled("errors", area)), area);
}

/// The numbers of the errors that the manual of the gateway does not name.
fn of_the_engine(gateway: &LiveGateway) -> Option<String> {
    let errors = gateway.all_errors() & ENGINE_ERRORS;
    let numbers = (0..128).filter(|nth| errors >> nth & 1 == 1).map(|nth| (3000 + nth).to_string());
    (errors != 0).then(|| numbers.collect::<Vec<_>>().join(" "))
}
