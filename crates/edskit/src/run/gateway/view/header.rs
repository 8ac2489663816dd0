//! The first lines: state, node-ID, bit rate, time, units, faults, bus.

use super::text::fitting_line;
use crate::run::gateway::scenario::words::{UNITS, fault_name};
use crate::run::gateway::session::LiveGateway;
use edskit_devices::gateway::{Owner, State};
use edskit_runtime::Microseconds;
use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::style::{Color, Style};
use ratatui::widgets::Paragraph;

pub(super) const ROWS: u16 = 3;

/// P12405 CanOpOnline.
const ONLINE: u16 = 12405;

pub(super) fn draw(frame: &mut Frame<'_>, area: Rect, gateway: &LiveGateway, bus: &str, time: Microseconds) {
    let state = gateway.state();
    let bit_rate = match gateway.bit_rate() {
        Some(rate) => format!("{} kbit/s", rate.kbit_per_s()),
        None => "manual bit timing".to_owned(),
    };
    let is_online = gateway.measured(ONLINE) == Some(1);
    let plain = Style::new();
    let first = vec![
        ("CANopen gateway  ".to_owned(), plain.bold()),
        (state.to_string(), style_of(state)),
        (format!("  node-ID {}", gateway.effective_parameters().node_id()), plain),
        (format!("  {bit_rate}"), plain),
        if is_online {
            ("  online".to_owned(), plain)
        } else {
            ("  offline".to_owned(), plain.fg(Color::Yellow))
        },
        (format!("  {}.{} s", time.0 / 1_000_000, time.0 / 100_000 % 10), plain),
    ];
    let units = UNITS.map(|(name, unit)| format!("{name} {}", condition(gateway, unit)));
    let faults: Vec<&str> = gateway.faults().map(fault_name).collect();
    let mut second = vec![(units.join(", "), plain)];
    if !faults.is_empty() {
        second.push((format!("; faults: {}", faults.join(", ")), plain.fg(Color::Red)));
    }
    let third = vec![(format!("{bus}; q ends"), plain.dim())];
    let lines = [first, second, third].map(|parts| fitting_line(parts, area.width));
    frame.render_widget(Paragraph::new(lines.to_vec()), area);
}

fn condition(gateway: &LiveGateway, unit: Owner) -> &'static str {
    match (gateway.is_powered(unit), gateway.is_running(unit)) {
        (_, true) => "on",
        (true, false) if unit == Owner::Gateway && gateway.stays_in_bootloader() => "in its bootloader",
        (true, false) => "starting",
        (false, false) => "off",
    }
}

fn style_of(state: State) -> Style {
    let color = match state {
        State::Undefined => Color::Red,
        State::Init | State::Stopped => Color::Yellow,
        State::PreOperational => Color::Cyan,
        State::Operational => Color::Green,
    };
    Style::new().fg(color).bold()
}
