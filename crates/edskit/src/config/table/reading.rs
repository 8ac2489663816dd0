//! The rows of a table.

use crate::config::typed::row::{self, Row};
use edskit_devices::gateway::{Owner, Parameter};

/// A line of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Line<'t> {
    /// A parameter or a measured value.
    Row(Row<'t>),
    /// From here on the rows are those of this unit.
    Unit(Owner),
    /// A remark.
    Remark,
    /// Something else, such as a title.
    Other,
}

/// Words over the columns, in the languages of the PC tool.
const COLUMNS: [&[&str]; 4] = [
    &["number", "no", "no.", "nr", "nr.", "nummer", "id", "parameternummer"],
    &["name", "parameter", "bezeichnung", "parametername"],
    &["value", "wert", "actual", "istwert"],
    &["unit", "einheit"],
];

/// Which column has number, name, value and unit.
type Columns = [Option<usize>; 4];

/// Every line of a text with what it is, in its order.
pub(super) fn lines(text: &str) -> Vec<(&str, Line<'_>)> {
    let mut columns: Option<Columns> = None;
    let mut lines = Vec::new();
    for line in text.lines() {
        let content = line.trim_start_matches('\u{FEFF}').trim();
        if content.is_empty() {
            continue;
        }
        let cells = row::cells(content);
        let found = cells.as_deref().and_then(heads);
        if found.is_some() {
            columns = found;
            continue;
        }
        lines.push((content, of_line(content, cells.as_deref(), columns)));
    }
    lines
}

fn of_line<'t>(content: &'t str, cells: Option<&[&'t str]>, columns: Option<Columns>) -> Line<'t> {
    if content.starts_with('#') {
        return Line::Remark;
    }
    if let Some(unit) = unit(cells.unwrap_or(&[content])) {
        return Line::Unit(unit);
    }
    let row = match (cells, columns) {
        (Some(cells), Some(columns)) => of_columns(cells, columns),
        (Some(_), None) => Row::of_cells(content),
        (None, _) => Row::of_words(content),
    };
    row.map_or(Line::Other, Line::Row)
}

/// The columns, where the cells are words over them.
fn heads(cells: &[&str]) -> Option<Columns> {
    let is = |cell: &&str, words: &[&str]| words.contains(&cell.to_lowercase().as_str());
    let columns = COLUMNS.map(|words| cells.iter().position(|cell| is(cell, words)));
    let is_head = columns.iter().flatten().count() >= 2 && !cells.iter().any(|cell| row::is_number(cell));
    is_head.then_some(columns)
}

fn of_columns<'t>(cells: &[&'t str], columns: Columns) -> Option<Row<'t>> {
    let [number, name, value, unit] =
        columns.map(|column| column.and_then(|column| cells.get(column)).copied().unwrap_or_default());
    let number = if row::is_number(number) { number } else { "" };
    (!(number.is_empty() && name.is_empty())).then_some(Row { number, name, value, unit })
}

/// The unit that a line names, which has nothing else.
fn unit(cells: &[&str]) -> Option<Owner> {
    let mut filled = cells.iter().filter(|cell| !cell.is_empty());
    let (Some(only), None) = (filled.next(), filled.next()) else { return None };
    match only.trim_matches(['[', ']', ':']).to_lowercase().as_str() {
        "gateway" | "canopen gateway" | "cm" => Some(Owner::Gateway),
        "governor" | "digitalregler" | "regler" | "dc" => Some(Owner::Governor),
        _ => None,
    }
}

/// The unit that has the parameter of a row, where only one has it.
pub(super) fn only_owner(row: &Row<'_>) -> Option<Owner> {
    let has = |owner: &Owner| match (row.number.trim_start_matches(['P', 'p']).parse(), row.name) {
        (Ok(number), "") => Parameter::find(*owner, number).is_some(),
        (Ok(number), name) => Parameter::find(*owner, number)
            .is_some_and(|parameter| parameter.is_called(name) || parameter.name().is_none()),
        (Err(_), name) => Parameter::by_name(*owner, name).is_some(),
    };
    let owners: Vec<Owner> = [Owner::Gateway, Owner::Governor].into_iter().filter(has).collect();
    match owners[..] {
        [only] => Some(only),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(text: &str) -> Vec<(&str, &str)> {
        let row = |(_, line): (_, Line<'static>)| match line {
            Line::Row(row) => Some((row.number, row.value)),
            _ => None,
        };
        let text: &'static str = text.to_owned().leak();
        lines(text).into_iter().filter_map(row).collect()
    }

    #[test]
    fn columns_may_stand_in_any_order() {
        assert_eq!(rows("Wert;Einheit;Nummer;Parameter\n1,0;s;400;CanStartTimeOutDelay\n"), [("400", "1,0")]);
        assert_eq!(rows("Nr.\tName\tLevel\tValue\tUnit\n427\tCanOpenMyNodeID\t6\t5\t\n"), [("427", "5")]);
        assert_eq!(rows("427;CanOpenMyNodeID;5;\n"), [("427", "5")]);
        assert_eq!(rows("Parametrierbeispiel:\n\n427 CanOpenMyNodeID 5\n"), [("427", "5")]);
    }

    #[test]
    fn units_are_told_by_titles_and_names() {
        let units: Vec<Line<'_>> = lines("[gateway];;;\nDigitalregler\nGateway:\n# remark\n")
            .into_iter()
            .map(|(_, line)| line)
            .collect();
        let expected = [
            Line::Unit(Owner::Gateway),
            Line::Unit(Owner::Governor),
            Line::Unit(Owner::Gateway),
            Line::Remark,
        ];
        assert_eq!(units, expected);
        for (line, owner) in [
            ("16404;CanOpTPDO5-16ID(0);282;Hex", Some(Owner::Gateway)),
            ("16404;CanOpTPDO5Assign(0);2000;", Some(Owner::Governor)),
            ("401;CanMyNodeNumber;1;", None),
            ("427;;1;", Some(Owner::Gateway)),
            ("2000;Speed;1500;1/min", None),
        ] {
            assert_eq!(only_owner(&Row::of_cells(line).unwrap()), owner, "{line}");
        }
    }
}
