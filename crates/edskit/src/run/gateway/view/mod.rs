//! The view of the gateway on a terminal.

mod engine;
mod errors;
mod header;
mod pdos;
mod screen;
mod standstill;
mod text;

use super::log::Line;
use super::session::LiveGateway;
use edskit_runtime::Microseconds;
use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::style::Stylize;
use ratatui::text::Line as TextLine;
use ratatui::widgets::{Block, Borders, Paragraph};
pub(super) use screen::Screen;
use std::collections::VecDeque;

/// How many lines of the log are kept: those of a high terminal.
const MOST_LINES: usize = 200;
/// The fewest rows of the log, with its title.
const LEAST_LOG: u16 = 5;
/// The columns before what a line of the log tells.
const BEFORE_EVENT: usize = 14;

/// What the view shows beside the gateway itself.
pub(super) struct View {
    /// Which bus the gateway is on.
    bus: String,
    /// The last lines of the log.
    lines: VecDeque<String>,
    /// Since when the state lasts.
    since: Microseconds,
}

impl View {
    pub(super) fn new(bus: String) -> Self {
        Self { bus, lines: VecDeque::new(), since: Microseconds(0) }
    }

    /// Adds to the log.
    pub(super) fn add(&mut self, lines: impl IntoIterator<Item = Line>) {
        for line in lines {
            self.since = line.begin_of_state().unwrap_or(self.since);
            self.lines.push_back(line.text());
        }
        self.lines.drain(..self.lines.len().saturating_sub(MOST_LINES));
    }

    /// Draws everything, `time` after the start. Where room is scarce, PDOs, errors and old lines are left out, with a mark
    /// and a count.
    fn draw(&self, frame: &mut Frame<'_>, gateway: &LiveGateway, time: Microseconds) {
        let area = frame.area();
        let errors = errors::shown(gateway, area.width);
        let reason = standstill::reason(gateway, self.since);
        let rest = area.height.saturating_sub(header::ROWS + engine::ROWS + LEAST_LOG);
        let wanted_by_pdos = pdos::rows_wanted(gateway, reason.as_deref(), area.width);
        let wanted_by_errors = rows(errors::lines_wanted(&errors)).saturating_add(1);
        // Errors take what the PDOs leave, and some rows in any case.
        let for_errors = rest.saturating_sub(wanted_by_pdos).max((area.height / 6).max(3) + 1);
        let rows_of_errors = wanted_by_errors.min(for_errors);
        let rows_of_pdos = rest.saturating_sub(rows_of_errors).min(wanted_by_pdos);
        let heights = [header::ROWS, rows_of_pdos, rows_of_errors, engine::ROWS].map(Constraint::Length);
        let [header_area, pdo_area, error_area, engine_area, log_area] =
            Layout::vertical(heights.into_iter().chain([Constraint::Fill(1)])).areas(area);
        header::draw(frame, header_area, gateway, &self.bus, time);
        pdos::draw(frame, pdo_area, gateway, reason.as_deref());
        errors::draw(frame, error_area, &errors);
        engine::draw(frame, engine_area, gateway);
        self.draw_log(frame, log_area);
    }

    /// The last lines that fit as a whole, the newest at the end.
    fn draw_log(&self, frame: &mut Frame<'_>, area: Rect) {
        let room = usize::from(area.height.saturating_sub(1));
        let mut shown: VecDeque<String> = VecDeque::new();
        for line in self.lines.iter().rev() {
            let lines = text::wrapped(line, area.width, BEFORE_EVENT, room);
            if shown.len() + lines.len() > room {
                break;
            }
            lines.into_iter().rev().for_each(|line| shown.push_front(line));
        }
        let lines: Vec<TextLine<'_>> = shown.into_iter().map(TextLine::raw).collect();
        frame.render_widget(Paragraph::new(lines).block(titled("log", area)), area);
    }
}

/// The title line of a part.
fn titled(title: &str, area: Rect) -> Block<'static> {
    Block::new().borders(Borders::TOP).title(text::fitting(title, area.width).bold())
}

fn rows(count: usize) -> u16 {
    u16::try_from(count).unwrap_or(u16::MAX)
}

#[cfg(test)]
mod tests;
