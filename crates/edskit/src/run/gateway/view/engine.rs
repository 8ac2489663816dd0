//! The values of the engine.

use super::text::wrapped;
use super::titled;
use crate::run::gateway::session::LiveGateway;
use edskit_devices::gateway::{Governor, NAMED_SIGNALS, Signal, Signals};
use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::text::Line;
use ratatui::widgets::Paragraph;

/// The title and two lines of values.
pub(super) const ROWS: u16 = 3;

pub(super) fn draw(frame: &mut Frame<'_>, area: Rect, gateway: &LiveGateway) {
    let governor = gateway.governor();
    let value = |signal: &Signal| {
        let value = governor.value(signal.number);
        let is_signed = governor.signal_type(signal.number).is_some_and(|kind| kind.is_signed());
        let number = if is_signed { i32::from(value as i16) } else { i32::from(value) };
        // Hard blanks keep name and value on one line.
        format!("{}\u{A0}{number}", signal.name)
    };
    let values: Vec<String> = NAMED_SIGNALS.iter().map(value).collect();
    let status = format!("status\u{A0}{:02X}h", governor.engine_status());
    let text = format!("{}  {status}", values.join("  "));
    let room = usize::from(area.height.saturating_sub(1));
    let lines = wrapped(&text, area.width, 0, room).into_iter().map(Line::raw);
    frame.render_widget(Paragraph::new(lines.collect::<Vec<_>>()).block(titled("engine", area)), area);
}
