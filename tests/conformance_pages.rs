//! The pages in `docs/conformance/` say what the tests and the ledgers say.

use edskit_tests::conformance::{Device, Evidence, Id, Page, device, device_names, evidence};
use edskit_tests::{paths, read, root, shared};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::PathBuf;

/// A device with all that its page is made of.
struct Made {
    name: String,
    device: Device,
    evidence: Evidence,
    page: Page,
}

/// Every device that has a page.
fn made() -> Vec<Made> {
    let make = |name: String| {
        let device = device(&name)?;
        let evidence = evidence(&device)?;
        Ok(Made { page: Page::new(&name, &device, &evidence)?, name, device, evidence })
    };
    let made: Result<Vec<Made>, String> = device_names().into_iter().map(make).collect();
    made.unwrap_or_else(|problems| panic!("{problems}"))
}

fn text(path: &str) -> String {
    fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// A row of a table in Markdown, as its cells; `None` for other lines.
fn cells(line: &str) -> Option<Vec<&str>> {
    let cells = line.strip_prefix("| ")?.strip_suffix(" |")?.split(" | ");
    Some(cells.collect())
}

/// The rows of a page's tables, by ID.
fn rows<'a>(page: &'a str, prefix: &str) -> Vec<(&'a str, Vec<&'a str>)> {
    let row = |line: &'a str| {
        let mut cells = cells(line)?;
        Some((cells.remove(0), cells))
    };
    page.lines().filter_map(row).filter(|(id, _)| id.starts_with(prefix)).collect()
}

/// The file and the function of each test in a cell.
fn tests(cell: &str) -> Vec<(String, String)> {
    let link = |link: &str| {
        let (function, file) = link.strip_prefix("[`")?.strip_suffix(')')?.split_once("`](../../")?;
        Some((file.to_owned(), function.to_owned()))
    };
    cell.split(", ").filter_map(link).collect()
}

#[test]
fn the_pages_are_current() {
    let made = made();
    assert!(!made.is_empty());
    for Made { name, page, .. } in made {
        let path = format!("docs/conformance/{name}.md");
        assert!(text(&path) == page.text, "{path} is stale; `cargo xtask docs` writes it again");
    }
}

#[test]
fn pages_and_tests_name_each_other() {
    for Made { name, device, evidence, .. } in made() {
        let page = text(&format!("docs/conformance/{name}.md"));
        let mut on_page = BTreeSet::new();
        for (id, cells) in rows(&page, &device.prefix) {
            let tests = tests(cells[0]);
            assert!(!tests.is_empty() || cells[0].starts_with('*'), "{id} has neither test nor reason");
            for (file, function) in tests {
                let source = text(&file);
                assert!(source.contains(&format!("fn {function}(")), "{id}: {file} has no {function}");
                assert!(on_page.insert((id.to_owned(), file, function)), "{id} stands twice");
            }
        }
        let of = |id: Id| {
            let tests =
                evidence.of(&id).map(|(file, test)| (id.to_string(), file.to_owned(), test.to_owned()));
            tests.collect::<Vec<_>>()
        };
        let named: BTreeSet<_> = device.ids().flat_map(of).collect();
        let differences: Vec<_> = on_page.symmetric_difference(&named).collect();
        assert!(differences.is_empty(), "{name}.md and the tests differ in {differences:#?}");
    }
}

#[test]
fn doubtful_statements_have_a_reading() {
    for Made { name, device, .. } in made() {
        for (id, cells) in rows(&text(&format!("docs/conformance/{name}.md")), &device.prefix) {
            let is_doubtful = id.contains("-NOTE-") || id.contains("-GAP-");
            assert_eq!(cells.len(), if is_doubtful { 2 } else { 1 }, "{id}");
            assert!(cells.iter().all(|cell| !cell.is_empty()), "{id}");
        }
    }
}

/// The statements of a ledger by their IDs. It is every page whose name begins with that of the device.
fn ledger(name: &str, prefix: &str) -> Option<BTreeMap<String, String>> {
    let pages = paths(&shared("the ledger of a device")?.join("ledger"));
    let is_own = |path: &PathBuf| {
        let file = path.file_name().and_then(|file| file.to_str()).unwrap_or_default();
        file.starts_with(name) && file.ends_with(".md")
    };
    let mut statements = BTreeMap::new();
    for path in pages.into_iter().filter(is_own) {
        let text = String::from_utf8(read(&path)).expect("ledgers are UTF-8");
        for (id, cells) in rows(&text, prefix) {
            let before = statements.insert(id.to_owned(), cells[0].to_owned());
            assert_eq!(before, None, "{id} stands twice in the ledger");
        }
    }
    assert!(!statements.is_empty(), "the ledger has no page of {name}");
    Some(statements)
}

#[test]
fn the_statements_are_those_of_the_ledger() {
    for Made { name, device, .. } in made() {
        let Some(ledger) = ledger(&name, &device.prefix) else { return };
        let ledger: BTreeSet<String> = ledger.into_keys().collect();
        let known: BTreeSet<String> = device.ids().map(|id| id.to_string()).collect();
        let differences: Vec<&String> = known.symmetric_difference(&ledger).collect();
        assert!(differences.is_empty(), "{name}.toml and the ledger differ in {differences:?}");
        let page = text(&format!("docs/conformance/{name}.md"));
        let on_page: BTreeSet<String> =
            rows(&page, &device.prefix).into_iter().map(|(id, _)| id.to_owned()).collect();
        let differences: Vec<&String> = on_page.symmetric_difference(&ledger).collect();
        assert!(differences.is_empty(), "{name}.md and the ledger differ in {differences:?}");
    }
}

#[test]
fn every_statement_has_a_test_or_a_reason() {
    for Made { name, device, page, .. } in made() {
        // What the statements say helps whoever has the ledger, and the test holds for everybody.
        let ledger = if page.missing.is_empty() { None } else { ledger(&name, &device.prefix) };
        let says = |id: &Id| ledger.as_ref().and_then(|ledger| ledger.get(&id.to_string()).cloned());
        let line = |id: &Id| format!("{id}  {}\n", says(id).unwrap_or_default());
        let missing: String = page.missing.iter().map(line).collect();
        assert!(
            missing.is_empty(),
            "{name}: {} with neither test nor reason:\n{missing}",
            page.missing.len()
        );
    }
}
