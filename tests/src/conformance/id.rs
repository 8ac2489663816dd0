//! IDs of statements, and how comments write them.

use std::fmt;

/// The ID of a statement: `GW-CFG-18`.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Id {
    /// The device: `GW`.
    pub device: String,
    /// The chapter: `CFG`.
    pub chapter: String,
    /// The number in the chapter, from 1.
    pub number: u16,
}

impl fmt::Display for Id {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}-{}-{:02}", self.device, self.chapter, self.number)
    }
}

/// The IDs of a device in a text, in its order. `GW-CFG-31 to GW-CFG-42` are all from the first to the last.
///
/// # Errors
/// What begins like an ID of the device and is none, and ranges that are written otherwise.
pub fn ids(text: &str, device: &str) -> Result<Vec<Id>, String> {
    let start = format!("{device}-");
    let mut ids = Vec::new();
    let mut rest = text;
    while let Some(place) = rest.find(&start) {
        let is_part_of_a_word = rest[..place].ends_with(|c: char| c.is_alphanumeric() || c == '-');
        if is_part_of_a_word {
            rest = &rest[place + start.len()..];
            continue;
        }
        let (first, behind) = id(&rest[place..], device)?;
        let last = behind.trim_start().strip_prefix("to ").map(str::trim_start);
        let Some(last) = last.filter(|last| last.starts_with(&start)) else {
            ids.push(first);
            rest = behind;
            continue;
        };
        let (last, behind) = id(last, device)?;
        if first.chapter != last.chapter || first.number >= last.number {
            return Err(format!("{first} to {last} is no range"));
        }
        ids.extend((first.number..=last.number).map(|number| Id { number, ..first.clone() }));
        rest = behind;
    }
    Ok(ids)
}

/// The ID at the start of a text that begins like one, and what stands behind it.
fn id<'a>(text: &'a str, device: &str) -> Result<(Id, &'a str), String> {
    let end = |text: &str, is_part: fn(&char) -> bool| text.chars().take_while(is_part).count();
    let chapter = &text[device.len() + 1..];
    let (chapter, number) = chapter.split_at(end(chapter, char::is_ascii_uppercase));
    let number = number.strip_prefix('-').unwrap_or_default();
    let (number, behind) = number.split_at(end(number, char::is_ascii_digit));
    let id = Id {
        device: device.to_owned(),
        chapter: chapter.to_owned(),
        number: number.parse().unwrap_or_default(),
    };
    let runs_on =
        behind.starts_with("..") || behind.starts_with(|c: char| c.is_alphanumeric() || "-–/_".contains(c));
    if id.number == 0 || runs_on || !text.starts_with(&id.to_string()) {
        let word = text.split([' ', ',', ';']).next().unwrap_or_default();
        return Err(format!(
            "`{word}` is no ID; write `{device}-CFG-01`, or `{device}-CFG-01 to {device}-CFG-03`"
        ));
    }
    Ok((id, behind))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(text: &str) -> Result<String, String> {
        let ids = ids(text, "XY")?;
        Ok(ids.iter().map(Id::to_string).collect::<Vec<_>>().join(" "))
    }

    #[test]
    fn ids_stand_anywhere_in_a_text() {
        assert_eq!(
            shown("XY-CFG-18, XY-PDO-02: both; (XY-NOTE-120).").unwrap(),
            "XY-CFG-18 XY-PDO-02 XY-NOTE-120"
        );
        assert_eq!(shown("XYZ-CFG-1, AXY-CFG-1, A-XY-CFG-1 and XY").unwrap(), "");
    }

    #[test]
    fn ranges_are_all_from_the_first_to_the_last() {
        assert_eq!(shown("XY-OD-09 to XY-OD-11, XY-OD-13").unwrap(), "XY-OD-09 XY-OD-10 XY-OD-11 XY-OD-13");
        assert_eq!(shown("XY-OD-09   to  XY-OD-10").unwrap(), "XY-OD-09 XY-OD-10");
        assert_eq!(shown("from XY-OD-09 to the end").unwrap(), "XY-OD-09");
        for wrong in ["XY-OD-09 to XY-CFG-11", "XY-OD-09 to XY-OD-09", "XY-OD-09 to XY-OD-08"] {
            assert_eq!(shown(wrong), Err(format!("{wrong} is no range")));
        }
    }

    #[test]
    fn what_begins_like_an_id_is_one() {
        let wrong = [
            "XY-",
            "XY-CFG",
            "XY-CFG-",
            "XY-CFG-1",
            "XY-CFG-001",
            "XY-CFG-00",
            "XY-CFG-99999999",
            "XY-cfg-01",
            "XY-CFG-01a",
            "XY-CFG-01-02",
            "XY-CFG-01/02",
            "XY-CFG-01–02",
            "XY-CFG-01..02",
        ];
        for word in wrong {
            let error = shown(&format!("see {word}, XY-CFG-01")).unwrap_err();
            assert_eq!(error, format!("`{word}` is no ID; write `XY-CFG-01`, or `XY-CFG-01 to XY-CFG-03`"));
        }
    }
}
