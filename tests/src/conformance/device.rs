//! What a file `docs/conformance/<device>.toml` says.

use super::Id;
use serde::Deserialize;
use std::collections::BTreeMap;

/// A device with its statements.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Device {
    /// What it is: `Heinzmann CANopen gateway`.
    pub device: String,
    /// The manual that the statements are drawn from.
    pub manual: String,
    /// What its IDs begin with: `GW`.
    pub prefix: String,
    /// The chapters of the page, in its order.
    #[serde(rename = "chapter")]
    pub chapters: Vec<Chapter>,
    /// How doubtful statements are read, by ID.
    pub reading: BTreeMap<String, String>,
    /// Why no test shows a statement, by ID.
    pub reason: BTreeMap<String, String>,
}

/// The statements with one name in the middle of their IDs.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Chapter {
    /// The name: `CFG`.
    pub name: String,
    /// What the statements are about.
    pub title: String,
    /// How many there are, numbered from 1.
    pub statements: u16,
}

impl Chapter {
    /// Whether its statements are doubtful, so that each needs a reading: places where the manual is unclear (`NOTE`) or
    /// silent (`GAP`).
    pub fn needs_readings(&self) -> bool {
        ["NOTE", "GAP"].contains(&self.name.as_str())
    }
}

impl Device {
    /// The IDs of all statements, by chapter and number.
    pub fn ids(&self) -> impl Iterator<Item = Id> {
        self.chapters.iter().flat_map(|chapter| self.ids_of(chapter))
    }

    /// The IDs of a chapter's statements.
    pub fn ids_of(&self, chapter: &Chapter) -> impl Iterator<Item = Id> {
        let (device, chapter, last) = (self.prefix.clone(), chapter.name.clone(), chapter.statements);
        (1..=last).map(move |number| Id { device: device.clone(), chapter: chapter.clone(), number })
    }

    /// The chapter that has this statement.
    pub fn chapter_of(&self, id: &Id) -> Option<&Chapter> {
        let has = |chapter: &&Chapter| {
            id.device == self.prefix
                && chapter.name == id.chapter
                && (1..=chapter.statements).contains(&id.number)
        };
        self.chapters.iter().find(has)
    }
}
