//! The errors that are present, and those that have been.

use super::titled;
use crate::run::gateway::session::{ENGINE_ERRORS, LiveGateway};
use edskit_devices::gateway::GatewayError;
use ratatui::Frame;
use ratatui::layout::{Constraint, Rect};
use ratatui::style::{Color, Stylize};
use ratatui::widgets::{Row, Table};

/// One row for each error, those that are present first.
pub(super) fn rows(gateway: &LiveGateway) -> Vec<Row<'static>> {
    let present: Vec<GatewayError> = gateway.errors().collect();
    let own = present.iter().map(|error| of_the_gateway(gateway, *error, "now").fg(Color::Red));
    let can_open = gateway.can_open_errors().iter().map(|error| {
        row(["now", &error.number().to_string(), error.name(), "", error.meaning()]).fg(Color::Red)
    });
    let engine = of_the_engine(gateway).map(|numbers| {
        row(["now", "", "", "", &format!("of the engine or its sensors: {numbers}")]).fg(Color::Red)
    });
    let past = GatewayError::ALL.into_iter().filter(|error| !present.contains(error));
    let past = past.filter(|error| gateway.error_count(*error) > 0);
    let past = past.map(|error| of_the_gateway(gateway, error, "past").dim());
    let mut rows: Vec<Row<'static>> = own.chain(can_open).chain(engine).chain(past).collect();
    if rows.is_empty() {
        rows.push(row(["none", "", "", "", ""]));
    }
    rows
}

pub(super) fn draw(frame: &mut Frame<'_>, area: Rect, rows: Vec<Row<'static>>) {
    let widths = [4, 5, 18, 4].map(Constraint::Length).into_iter().chain([Constraint::Fill(1)]);
    frame.render_widget(Table::new(rows, widths).block(titled("errors")), area);
}

fn row(cells: [&str; 5]) -> Row<'static> {
    Row::new(cells.map(str::to_owned))
}

fn of_the_gateway(gateway: &LiveGateway, error: GatewayError, when: &str) -> Row<'static> {
    let count = format!("{}x", gateway.error_count(error));
    row([when, &error.number().to_string(), error.name(), &count, error.meaning()])
}

/// The numbers of the errors that the manual of the gateway does not name.
fn of_the_engine(gateway: &LiveGateway) -> Option<String> {
    let errors = gateway.all_errors() & ENGINE_ERRORS;
    let numbers = (0..128).filter(|nth| errors >> nth & 1 == 1).map(|nth| (3000 + nth).to_string());
    (errors != 0).then(|| numbers.collect::<Vec<_>>().join(" "))
}
