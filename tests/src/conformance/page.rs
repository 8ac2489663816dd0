//! The page of a device, and what is wrong with its sources.

use super::{Chapter, Device, Id, Source, ids};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

/// Which tests name which statements.
#[derive(Default)]
pub struct Evidence(BTreeMap<Id, BTreeSet<(String, String)>>);

impl Evidence {
    /// Adds the tests of a source. All its comments are looked at, so that no ID in them is misspelt; what stands outside
    /// tests shows nothing.
    ///
    /// # Errors
    /// What is wrong with the IDs in the comments.
    pub fn read(&mut self, device: &Device, file: &str, text: &str) -> Result<(), Vec<String>> {
        // Most sources know nothing of the device.
        if !text.contains(&format!("{}-", device.prefix)) {
            return Ok(());
        }
        let source = Source::parse(text).map_err(|error| vec![format!("{file}: {error}")])?;
        let mut problems = Vec::new();
        match ids(&source.comments, &device.prefix) {
            Err(problem) => problems.push(format!("{file}: {problem}")),
            Ok(ids) => {
                let unknown = ids.iter().filter(|id| device.chapter_of(id).is_none());
                problems.extend(unknown.map(|id| format!("{file}: there is no statement {id}")));
            }
        }
        for test in source.tests {
            // What is no ID in a test is none in the file either, and is reported.
            for id in ids(&test.comments, &device.prefix).unwrap_or_default() {
                self.0.entry(id).or_default().insert((file.to_owned(), test.name.clone()));
            }
        }
        if problems.is_empty() { Ok(()) } else { Err(problems) }
    }

    /// The tests that name a statement, as file and function, sorted.
    pub fn of(&self, id: &Id) -> impl ExactSizeIterator<Item = (&str, &str)> {
        let tests = self.0.get(id).map(BTreeSet::iter).unwrap_or_default();
        tests.map(|(file, function)| (file.as_str(), function.as_str()))
    }
}

/// The page of a device.
pub struct Page {
    /// The page in Markdown.
    pub text: String,
    /// The statements with neither test nor reason, which the page leaves out.
    pub missing: Vec<Id>,
}

impl Page {
    /// Makes the page `docs/conformance/<name>.md`.
    ///
    /// # Errors
    /// What does not fit together in `docs/conformance/<name>.toml` and the tests, one line for each.
    pub fn new(name: &str, device: &Device, evidence: &Evidence) -> Result<Self, String> {
        let problems = problems(device, evidence);
        if !problems.is_empty() {
            return Err(problems.join("\n"));
        }
        let is_shown = |id: &Id| evidence.of(id).len() > 0;
        let is_there = |id: &Id| is_shown(id) || device.reason.contains_key(&id.to_string());
        let mut text = introduction(name, device);
        let (all, shown) = (device.ids().count(), device.ids().filter(is_shown).count());
        let reasons = device.reason.len();
        line(
            &mut text,
            &format!("Statements: {all}. Shown by tests: {shown}. With a reason instead: {reasons}."),
        );
        for chapter in &device.chapters {
            let mut rows = device
                .ids_of(chapter)
                .filter(is_there)
                .map(|id| row(device, chapter, evidence, &id))
                .peekable();
            if rows.peek().is_none() {
                continue;
            }
            line(&mut text, &format!("\n## {}: {}\n", chapter.name, chapter.title));
            line(
                &mut text,
                match chapter.needs_readings() {
                    true => "| ID | What shows it | Reading |\n| --- | --- | --- |",
                    false => "| ID | What shows it |\n| --- | --- |",
                },
            );
            rows.for_each(|row| line(&mut text, &row));
        }
        Ok(Self { text, missing: device.ids().filter(|id| !is_there(id)).collect() })
    }
}

fn introduction(name: &str, device: &Device) -> String {
    let Device { device, manual, prefix, .. } = device;
    format!(
        "\
# Conformance: {device}

What shows that this project follows the manual {manual}.

What the manual says was written down as statements that can be tested, each with an ID such as `{prefix}-EDS-01`. The list
itself is not published. Code and tests name the IDs.

- *What shows it*: the tests that name the statement in a comment above or inside them; or in italics the reason why no
  test can show it.
- *Reading*: how a statement is read where the manual contradicts itself, has a slip or leaves something open (`NOTE`), or
  what was chosen where it says nothing (`GAP`).

`cargo xtask docs` writes this page from the tests and from `{name}.toml`. A test says when it is stale,
and when a statement has neither test nor reason.

"
    )
}

fn row(device: &Device, chapter: &Chapter, evidence: &Evidence, id: &Id) -> String {
    let id_text = id.to_string();
    let tests = evidence.of(id).map(|(file, function)| format!("[`{function}`](../../{file})"));
    let shown = match device.reason.get(&id_text) {
        Some(reason) => format!("*{reason}*"),
        None => tests.collect::<Vec<_>>().join(", "),
    };
    match device.reading.get(&id_text) {
        Some(reading) if chapter.needs_readings() => format!("| {id} | {shown} | {reading} |"),
        _ => format!("| {id} | {shown} |"),
    }
}

fn problems(device: &Device, evidence: &Evidence) -> Vec<String> {
    let mut problems = Vec::new();
    let known: BTreeMap<String, Id> = device.ids().map(|id| (id.to_string(), id)).collect();
    for (table, texts) in [("reading", &device.reading), ("reason", &device.reason)] {
        for (id, text) in texts {
            if !known.contains_key(id) {
                problems.push(format!("[{table}] {id}: there is no such statement"));
            }
            if text.trim().is_empty() || text.contains(['|', '\n']) {
                problems.push(format!("[{table}] {id}: write one line of text without `|`"));
            }
        }
    }
    for id in known.values() {
        let text = id.to_string();
        let needs_reading = device.chapter_of(id).is_some_and(Chapter::needs_readings);
        if needs_reading != device.reading.contains_key(&text) {
            let what = if needs_reading { "say how it is read" } else { "only NOTE and GAP have readings" };
            problems.push(format!("[reading] {text}: {what}"));
        }
        if let (true, Some((file, function))) = (device.reason.contains_key(&text), evidence.of(id).next()) {
            problems
                .push(format!("[reason] {text}: {function} in {file} shows it, so that no reason is needed"));
        }
    }
    problems
}

fn line(text: &mut String, line: &str) {
    writeln!(text, "{line}").expect("a string takes any text");
}

#[cfg(test)]
mod tests {
    use super::*;

    const DEVICE: &str = r#"
        device = "Example pump"
        manual = "PU 12"
        prefix = "XY"
        [[chapter]]
        name = "SDO"
        title = "SDO server"
        statements = 3
        [[chapter]]
        name = "NOTE"
        title = "readings"
        statements = 2
        [[chapter]]
        name = "EDS"
        title = "nothing shown"
        statements = 1
        [reading]
        XY-NOTE-01 = "As printed."
        XY-NOTE-02 = "The other way round."
        [reason]
        XY-SDO-03 = "It is about paper."
    "#;

    fn device() -> Device {
        toml::from_str(DEVICE).unwrap()
    }

    fn evidence(text: &str) -> Result<Evidence, Vec<String>> {
        let mut evidence = Evidence::default();
        evidence.read(&device(), "tests/pump.rs", text).map(|()| evidence)
    }

    #[test]
    fn a_page() {
        let text =
            "// XY-SDO-01 to XY-SDO-02\n#[test] fn b() {}\n #[test] fn a() { /* XY-SDO-02, XY-NOTE-02 */ }";
        let page = Page::new("pump", &device(), &evidence(text).unwrap()).unwrap();
        insta::assert_snapshot!("page", page.text);
        let missing: Vec<String> = page.missing.iter().map(Id::to_string).collect();
        assert_eq!(missing, ["XY-NOTE-01", "XY-EDS-01"]);
    }

    #[test]
    fn ids_outside_tests_show_nothing() {
        let page = Page::new("pump", &device(), &evidence("/// XY-SDO-01\nfn a() {}").unwrap()).unwrap();
        assert!(page.missing.iter().any(|id| id.to_string() == "XY-SDO-01"));
    }

    #[test]
    fn wrong_ids_are_reported_wherever_they_stand() {
        let errors = |text: &str| evidence(text).err().unwrap_or_default();
        assert_eq!(
            errors("// XY-SDO-04\n#[test] fn a() {}"),
            ["tests/pump.rs: there is no statement XY-SDO-04"]
        );
        assert_eq!(errors("/// XY-ODD-01\nfn a() {}"), ["tests/pump.rs: there is no statement XY-ODD-01"]);
        assert_eq!(
            errors("#[test] fn a() { // XY-SDO-01..03\n}"),
            ["tests/pump.rs: `XY-SDO-01..03` is no ID; write `XY-CFG-01`, or `XY-CFG-01 to XY-CFG-03`"]
        );
        assert!(errors("#[test] fn a() { let name = \"XY-ODD-01\"; }").is_empty());
    }

    #[test]
    fn what_does_not_fit_together() {
        let mut device = device();
        device.reading.insert("XY-SDO-01".to_owned(), "a | b".to_owned());
        device.reading.remove("XY-NOTE-01");
        device.reason.insert("XY-SDO-04".to_owned(), " ".to_owned());
        let evidence = evidence("// XY-SDO-03\n#[test] fn a() {}").unwrap();
        let problems = Page::new("pump", &device, &evidence).err().unwrap();
        insta::assert_snapshot!("problems", problems);
    }
}
