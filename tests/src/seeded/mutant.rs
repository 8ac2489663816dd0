//! A base with a defect in it.

use super::base::{Base, Entry, Line, Section};
use std::collections::BTreeMap;
use std::rc::Rc;

/// A file with a defect, and where the defect is.
///
/// Lines are named by their number in the base, from 0, so that edits do not disturb each other. What [`set`](Self::set),
/// [`rewrite`](Self::rewrite) and [`insert`](Self::insert) write is where the finding is expected. What
/// [`set_too`](Self::set_too) and [`insert_too`](Self::insert_too) write only keeps the rest of the file as it must be.
#[derive(Clone)]
pub struct Mutant {
    /// The lines of the base.
    base: Rc<[Line]>,
    /// What stands in the place of some of them; the one behind the last is the end of the file.
    slots: BTreeMap<usize, Slot>,
    /// How the text becomes bytes.
    encoding: fn(&str) -> Vec<u8>,
    neighbours: Rc<Vec<(String, String)>>,
}

/// What stands in the place of a line.
#[derive(Clone)]
struct Slot {
    /// Lines that were put before it, and whether the finding is expected there.
    before: Vec<(Line, bool)>,
    line: Option<Line>,
    expected: bool,
}

impl Mutant {
    /// The base as it is.
    pub fn of(base: &Base) -> Self {
        Self {
            base: base.lines.clone(),
            slots: BTreeMap::new(),
            encoding: |text| text.as_bytes().to_vec(),
            neighbours: base.neighbours.clone(),
        }
    }

    /// A whole other file; the finding is expected in its first line.
    pub fn other_file(base: &Base, text: &str) -> Self {
        let line = Line { text: text.to_owned(), ending: String::new() };
        Self { base: [line].into(), ..Self::of(base) }.expect(0)
    }

    /// Gives an entry another value.
    pub fn set(self, entry: &Entry, value: &str) -> Self {
        let text = format!("{}={value}", entry.key);
        self.rewrite(entry.line, text)
    }

    /// Gives an entry another value where no finding is expected.
    pub fn set_too(self, entry: &Entry, value: &str) -> Self {
        let text = format!("{}={value}", entry.key);
        self.write(entry.line, text, false)
    }

    /// Puts another text in the place of a line.
    pub fn rewrite(self, line: usize, text: impl Into<String>) -> Self {
        self.write(line, text, true)
    }

    /// Puts another text in the place of a line where no finding is expected.
    pub fn rewrite_too(self, line: usize, text: impl Into<String>) -> Self {
        self.write(line, text, false)
    }

    /// Puts a line before a line; `line` may be the number of lines.
    pub fn insert(self, line: usize, text: impl Into<String>) -> Self {
        self.put(line, text, true)
    }

    /// Puts a line before a line where no finding is expected.
    pub fn insert_too(self, line: usize, text: impl Into<String>) -> Self {
        self.put(line, text, false)
    }

    /// Puts a section behind the last line; the finding is expected at its header.
    pub fn append_section(self, header: &str, entries: &[&str]) -> Self {
        let end = self.base.len();
        self.insert_section(end, header, entries)
    }

    /// Puts a section before a line; the finding is expected at its header.
    pub fn insert_section(self, line: usize, header: &str, entries: &[&str]) -> Self {
        let mutant = self.insert_too(line, "").insert(line, format!("[{header}]"));
        entries.iter().fold(mutant, |mutant, entry| mutant.insert_too(line, *entry))
    }

    /// Takes a line out.
    pub fn delete(mut self, line: usize) -> Self {
        self.slot(line).line = None;
        self
    }

    /// Takes the lines of a section out.
    pub fn delete_section(self, section: &Section) -> Self {
        (section.header..section.end).fold(self, Self::delete)
    }

    /// Expects the finding at a line that stays as it is.
    pub fn expect(mut self, line: usize) -> Self {
        self.slot(line).expected = true;
        self
    }

    /// Expects the finding at the first line that is left of the base.
    pub fn expect_first(self) -> Self {
        let is_left = |line: &usize| self.slots.get(line).is_none_or(|slot| slot.line.is_some());
        let first = (0..self.base.len()).find(is_left).unwrap_or_default();
        self.expect(first)
    }

    /// Ends a line with something else.
    pub fn end_line(mut self, line: usize, ending: &str) -> Self {
        self.line(line).ending = ending.to_owned();
        self.expect(line)
    }

    /// Changes how the text becomes bytes.
    pub fn encode(mut self, encoding: fn(&str) -> Vec<u8>) -> Self {
        self.encoding = encoding;
        self
    }

    /// Puts another text in the place of a file beside this one, or a file where there was none.
    pub fn with_neighbour(mut self, name: &str, text: impl Into<String>) -> Self {
        Rc::make_mut(&mut self.neighbours).retain(|(known, _)| known != name);
        Rc::make_mut(&mut self.neighbours).push((name.to_owned(), text.into()));
        self
    }

    /// Takes a file beside this one away.
    pub fn without_neighbour(mut self, name: &str) -> Self {
        Rc::make_mut(&mut self.neighbours).retain(|(known, _)| known != name);
        self
    }

    /// The file.
    pub fn bytes(&self) -> Vec<u8> {
        (self.encoding)(&self.text())
    }

    /// The file before it is encoded.
    pub fn text(&self) -> String {
        self.lines().flat_map(|(line, _)| [line.text.as_str(), &line.ending]).collect()
    }

    /// The lines where the finding may be, counted from 1.
    pub fn expected(&self) -> Vec<usize> {
        let lines = self.lines().enumerate();
        lines.filter(|(_, (_, expected))| *expected).map(|(number, _)| number + 1).collect()
    }

    /// The files beside it, by their names.
    pub fn neighbours(&self) -> &[(String, String)] {
        &self.neighbours
    }

    fn write(mut self, line: usize, text: impl Into<String>, expected: bool) -> Self {
        self.line(line).text = text.into();
        self.slot(line).expected = expected;
        self
    }

    /// Lines that are put before the same line stand in the order in which they were put there.
    fn put(mut self, line: usize, text: impl Into<String>, expected: bool) -> Self {
        let ending = self.base.first().map_or("\n", |line| &line.ending).to_owned();
        self.slot(line).before.push((Line { text: text.into(), ending }, expected));
        self
    }

    fn slot(&mut self, line: usize) -> &mut Slot {
        let old = || Slot { before: Vec::new(), line: self.base.get(line).cloned(), expected: false };
        self.slots.entry(line).or_insert_with(old)
    }

    fn line(&mut self, line: usize) -> &mut Line {
        self.slot(line).line.as_mut().expect("the line was not taken out before")
    }

    /// Every line, and whether the finding is expected there.
    fn lines(&self) -> impl Iterator<Item = (&Line, bool)> {
        (0..=self.base.len()).flat_map(|number| match self.slots.get(&number) {
            Some(slot) => {
                let before = slot.before.iter().map(|(line, expected)| (line, *expected));
                before.chain(slot.line.iter().map(|line| (line, slot.expected))).collect()
            }
            None => self.base.get(number).map(|line| (line, false)).into_iter().collect::<Vec<_>>(),
        })
    }
}
