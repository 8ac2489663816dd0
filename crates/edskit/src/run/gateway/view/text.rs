//! Texts in the room that there is: whatever does not fit is marked by `…`.

use ratatui::style::Style;
use ratatui::text::{Line, Span};

/// A text that fits into so many columns.
pub(super) fn fitting(text: &str, columns: u16) -> String {
    let columns = usize::from(columns);
    if text.chars().count() <= columns {
        return text.to_owned();
    }
    text.chars().take(columns.saturating_sub(1)).chain(['…']).collect()
}

/// The same for a line of several styles.
pub(super) fn fitting_line(parts: Vec<(String, Style)>, columns: u16) -> Line<'static> {
    let mut room = usize::from(columns);
    let length: usize = parts.iter().map(|(text, _)| text.chars().count()).sum();
    let is_cut = length > room;
    room = if is_cut { room.saturating_sub(1) } else { room };
    let mut spans = Vec::new();
    for (text, style) in parts {
        let part: String = text.chars().take(room).collect();
        room -= part.chars().count();
        spans.push(Span::styled(part, style));
    }
    spans.extend(is_cut.then(|| Span::raw("…")));
    Line::from(spans)
}

/// A text in lines of so many columns, divided at blanks, each but the first behind `indent` blanks. At most `rows` of them.
pub(super) fn wrapped(text: &str, columns: u16, indent: usize, rows: usize) -> Vec<String> {
    let columns = usize::from(columns).max(1);
    let indent = if indent + 10 > columns { 0 } else { indent };
    let (mut lines, mut line, mut used) = (Vec::new(), String::new(), 0);
    for word in text.split_inclusive(' ') {
        let content = word.trim_end_matches(' ');
        if used + content.chars().count() > columns && !line.trim().is_empty() {
            lines.push(std::mem::replace(&mut line, " ".repeat(indent)));
            used = indent;
        }
        for character in content.chars() {
            // A word that is longer than a line goes on in the next one.
            if used == columns {
                lines.push(std::mem::replace(&mut line, " ".repeat(indent)));
                used = indent;
            }
            line.push(character);
            used += 1;
        }
        let blanks = (word.len() - content.len()).min(columns - used);
        line.extend(std::iter::repeat_n(' ', blanks));
        used += blanks;
    }
    lines.push(line);
    let is_cut = lines.len() > rows;
    lines.truncate(rows);
    let mut lines: Vec<String> = lines.into_iter().map(|line| line.trim_end().to_owned()).collect();
    if let Some(last) = lines.last_mut().filter(|_| is_cut) {
        *last = fitting(&format!("{last} …"), u16::try_from(columns).unwrap_or(u16::MAX));
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_lost_without_a_mark() {
        let text = "error 3074 ErrCanOpen: error of CANopen, see 2005h and 0123456789012345678901234567890";
        let words = |text: &str| text.chars().filter(|character| *character != ' ').collect::<String>();
        for columns in 1..100 {
            for indent in [0, 4] {
                let lines = wrapped(text, columns, indent, 1_000);
                assert_eq!(words(&lines.concat()), words(text), "{columns}");
                assert!(
                    lines.iter().all(|line| line.chars().count() <= usize::from(columns)),
                    "{columns}: {lines:?}"
                );
                let cut = wrapped(text, columns, indent, lines.len() - 1);
                assert!(cut.is_empty() || cut[cut.len() - 1].ends_with('…'), "{columns}: {cut:?}");
            }
            let line = fitting_line(
                vec![("state".to_owned(), Style::new()), ("  node".to_owned(), Style::new())],
                columns,
            );
            assert_eq!(line.width(), usize::from(columns).min(11), "{columns}");
            assert_eq!(line.to_string().ends_with('…'), columns < 11);
        }
        assert_eq!(wrapped("a b", 80, 4, 5), ["a b"]);
        assert_eq!(wrapped("", 80, 4, 5), [""]);
    }
}
