//! The view of the gateway on a terminal.

mod engine;
mod errors;
mod header;
mod pdos;
mod screen;

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

/// What the view shows beside the gateway itself.
pub(super) struct View {
    /// Which bus the gateway is on.
    bus: String,
    /// The last lines of the log.
    lines: VecDeque<String>,
}

impl View {
    pub(super) fn new(bus: String) -> Self {
        Self { bus, lines: VecDeque::new() }
    }

    /// Adds to the log.
    pub(super) fn add(&mut self, lines: impl IntoIterator<Item = Line>) {
        self.lines.extend(lines.into_iter().map(|line| line.text()));
        self.lines.drain(..self.lines.len().saturating_sub(MOST_LINES));
    }

    /// Draws everything, `time` after the start. Where rows are scarce, PDOs and old lines are left out.
    fn draw(&self, frame: &mut Frame<'_>, gateway: &LiveGateway, time: Microseconds) {
        let area = frame.area();
        let errors = errors::rows(gateway);
        let rows_of_errors = rows(errors.len()).clamp(1, (area.height / 6).max(3)) + 1;
        let rest = area.height.saturating_sub(header::ROWS + rows_of_errors + engine::ROWS);
        let rows_of_pdos = rest.saturating_sub(LEAST_LOG).min(pdos::rows_wanted(gateway));
        let heights = [header::ROWS, rows_of_pdos, rows_of_errors, engine::ROWS].map(Constraint::Length);
        let [header_area, pdo_area, error_area, engine_area, log_area] =
            Layout::vertical(heights.into_iter().chain([Constraint::Fill(1)])).areas(area);
        header::draw(frame, header_area, gateway, &self.bus, time);
        pdos::draw(frame, pdo_area, gateway);
        errors::draw(frame, error_area, errors);
        engine::draw(frame, engine_area, gateway);
        self.draw_log(frame, log_area);
    }

    fn draw_log(&self, frame: &mut Frame<'_>, area: Rect) {
        let room = usize::from(area.height.saturating_sub(1));
        let shown = self.lines.iter().skip(self.lines.len().saturating_sub(room));
        let lines: Vec<TextLine<'_>> = shown.map(|line| TextLine::raw(line.as_str())).collect();
        frame.render_widget(Paragraph::new(lines).block(titled("log")), area);
    }
}

/// The title line of a part.
fn titled(title: &str) -> Block<'_> {
    Block::new().borders(Borders::TOP).title(title.bold())
}

fn rows(count: usize) -> u16 {
    u16::try_from(count).unwrap_or(u16::MAX)
}

/// A text that fits into so many columns, with a mark where it was cut.
fn fitting(text: &str, columns: u16) -> String {
    let columns = usize::from(columns);
    if text.chars().count() <= columns {
        return text.to_owned();
    }
    text.chars().take(columns.saturating_sub(1)).chain(['…']).collect()
}

#[cfg(test)]
mod tests;
