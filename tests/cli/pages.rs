//! The examples of the pages docs/ci.md and docs/configuration.md, run as they stand there, and the tests that
//! docs/kinds-of-mistakes.md names.

use edskit::Exit;
use edskit_tests::{Folder, edskit, root};
use std::fs;

/// A file with a finding, so that a baseline has something to know.
const FILE: &str = "[1018]\nParameterName=Identity\nObjectType=0x9\nSubNumber=1\n";
/// A profile as docs/profiles.md describes it.
const PROFILE: &str = "name = 'Ours'\nobject = [{ index = 0x2100, name = 'speed', type = 'UNSIGNED8' }]\n";

fn page(name: &str) -> String {
    fs::read_to_string(root().join("docs").join(name)).expect("the page can be read")
}

/// The fences of a language.
fn fences(page: &str, language: &str) -> Vec<String> {
    let start = format!("\n```{language}\n");
    let parts = page.split(&start).skip(1);
    parts.map(|part| part.split("```\n").next().expect("a fence ends").to_owned()).collect()
}

/// A repository as the pages speak of it: device files in `eds`, one of a supplier in `vendor`.
fn repository(name: &str) -> Folder {
    let folder = Folder::new(name);
    folder.write("eds/pump.eds", FILE);
    folder.write("vendor/drive.eds", FILE);
    folder.write("company.toml", PROFILE);
    folder
}

#[test]
fn settings_can_be_copied() {
    let examples = fences(&page("configuration.md"), "toml");
    assert!(!examples.is_empty());
    for text in examples {
        let folder = repository("page-settings");
        folder.write("edskit.toml", &text);
        // A baseline that the settings name is made first.
        if text.contains("\nbaseline") {
            assert_eq!(edskit(&["lint", folder.path(), "--update-baseline"]).exit, Exit::Clean, "{text}");
        }
        let output = edskit(&["lint", folder.path()]);
        assert!(output.exit != Exit::Failed, "{}\n{text}", output.stderr);
        // What is switched off in the example is valid, too, once it is switched on.
        let lines = text.lines().filter_map(|line| line.strip_prefix("# "));
        for line in lines.filter(|line| line.contains(" = ")) {
            folder.write("edskit.toml", line);
            let output = edskit(&["lint", folder.path()]);
            assert!(output.exit != Exit::Failed, "{}\n{line}", output.stderr);
        }
    }
}

#[test]
fn comments_silence_what_they_say() {
    for text in fences(&page("configuration.md"), "ini") {
        let folder = Folder::new("page-comments");
        let path = folder.write("a.eds", &text);
        let output =
            edskit(&["lint", "--isolated", "--format", "concise", "--select", "OBJ016,SYN027", &path]);
        assert_eq!(output.exit, Exit::Clean, "{}", output.stdout);
        let without = text.lines().filter(|line| !line.starts_with(';')).collect::<Vec<_>>().join("\n");
        let path = folder.write("b.eds", without);
        assert_eq!(edskit(&["lint", "--isolated", "--select", "OBJ016", &path]).exit, Exit::Findings);
    }
}

#[test]
fn commands_can_be_copied() {
    let mut commands = 0;
    for page in [page("ci.md"), page("configuration.md")] {
        let folder = repository("page-commands");
        for line in page.lines() {
            let Some(command) = command(line) else { continue };
            commands += 1;
            let arguments: Vec<String> =
                command.split_whitespace().map(|word| placed(&folder, word)).collect();
            let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
            let output = edskit(&arguments);
            assert!(output.exit != Exit::Failed, "{command}: {}", output.stderr);
        }
    }
    assert!(commands >= 6, "{commands}");
}

/// The arguments of `edskit` in a line of a script, a pipeline or a shell.
fn command(line: &str) -> Option<&str> {
    let (before, rest) = line.split_once("edskit ")?;
    let is_command = matches!(before.trim(), "" | "-" | "sh '");
    let rest = rest.split(['\'', '|', '#']).next()?;
    (is_command && !rest.contains("FILE")).then_some(rest)
}

/// A word of a command, with paths in the folder of the test.
fn placed(folder: &Folder, word: &str) -> String {
    let is_path = matches!(word, "eds" | "vendor" | ".") || word.contains('.') || word.contains('/');
    if is_path { format!("{}/{word}", folder.path()) } else { word.to_owned() }
}

#[test]
fn the_action_and_the_hooks_are_as_the_page_says() {
    let page = page("ci.md");
    let action = fs::read_to_string(root().join("action.yml")).unwrap();
    let hooks = fs::read_to_string(root().join(".pre-commit-hooks.yaml")).unwrap();
    let mut seen = 0;
    for yaml in fences(&page, "yaml") {
        let mut lines = yaml.lines();
        while let Some(line) = lines.next() {
            if let Some(hook) = line.trim().strip_prefix("- id: ") {
                assert!(hooks.contains(&format!("- id: {hook}\n")), "{hook}");
                seen += 1;
            }
            if line.contains("uses: edskit/edskit") {
                let inputs = lines.by_ref().skip(1).take_while(|line| line.starts_with("          "));
                for input in inputs.filter_map(|line| line.trim().split_once(':')) {
                    assert!(action.contains(&format!("\n  {}:\n", input.0)), "{}", input.0);
                    seen += 1;
                }
            }
        }
    }
    assert!(seen >= 5, "{seen}");
}

/// The keys of a JSON value, with those inside it.
fn keys(value: &serde_json::Value, path: &str, found: &mut Vec<String>) {
    match value {
        serde_json::Value::Object(object) => {
            for (key, value) in object {
                let path = format!("{path}.{key}");
                found.push(path.clone());
                keys(value, &path, found);
            }
        }
        serde_json::Value::Array(items) => items.iter().for_each(|item| keys(item, path, found)),
        _ => {}
    }
}

#[test]
fn the_json_of_the_page_has_the_keys_that_are_printed() {
    let all = |text: &str| {
        let mut found = Vec::new();
        keys(&serde_json::from_str(text).expect("it is JSON"), "", &mut found);
        found.sort();
        found.dedup();
        found
    };
    let printed = all(&edskit(&["lint", "--isolated", "--format", "json", "fixtures/faulty.eds"]).stdout);
    let example = fences(&page("ci.md"), "json").remove(0);
    assert_eq!(all(&example), printed);
}

#[test]
fn the_tests_that_show_each_kind_exist() {
    let page = page("kinds-of-mistakes.md");
    let mut count = 0;
    for link in page.split("[`").skip(1) {
        let Some((name, rest)) = link.split_once("`](../") else { continue };
        let path = rest.split(')').next().expect("a link ends");
        let source = fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"));
        assert!(source.contains(&format!("fn {name}()")), "{path} has no test {name}");
        count += 1;
    }
    assert!(count > 50, "{count} tests are named");
}
