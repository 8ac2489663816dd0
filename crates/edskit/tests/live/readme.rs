//! The examples of the README: what is shown there is what the commands print.

use crate::process::{Process, edskit};
use std::fs;

/// An example: what follows `$ edskit`, and what is shown below it.
struct Example<'a> {
    arguments: Vec<&'a str>,
    shown: String,
}

/// What a person types, by words; a word in quotation marks can have spaces.
fn words(line: &str) -> Vec<&str> {
    let parts = line.split('"').enumerate();
    parts
        .flat_map(|(number, part)| match number % 2 {
            0 => part.split_whitespace().collect(),
            _ => vec![part],
        })
        .collect()
}

/// The examples in the fences of the language `console`.
fn examples(page: &str) -> Vec<Example<'_>> {
    let fences = page.split("\n```console\n").skip(1);
    fences
        .map(|rest| rest.split_once("\n```\n").expect("the fence has an end").0)
        .flat_map(|fence| fence.strip_prefix("$ ").expect("it begins with a command").split("\n$ "))
        .map(|example| {
            let (command, shown) = example.split_once('\n').expect("the command prints something");
            let arguments = words(command.strip_prefix("edskit ").expect("it is a command of edskit"));
            Example { arguments, shown: format!("{shown}\n") }
        })
        .collect()
}

#[test]
fn examples_print_what_the_readme_shows() {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
    // Commands run in `tests/`, people type them at the root; and what is generated is thrown away.
    let output = std::env::temp_dir().join(format!("edskit-readme-{}", std::process::id()));
    let output = output.to_str().expect("temporary paths are UTF-8");
    let here = |argument: &str| match argument {
        "target" => output.to_owned(),
        _ => argument.replace("tests/", ""),
    };
    let page = fs::read_to_string(format!("{root}/README.md")).expect("the repository has a README");
    let mut node: Option<Process> = None;
    let mut commands = Vec::new();
    for Example { arguments, shown } in examples(&page) {
        let mut arguments: Vec<String> = arguments.into_iter().map(here).collect();
        let command = arguments[0].clone();
        // Not the ports that everybody has: other buses may run on this machine.
        match (command.as_str(), &node) {
            ("run", _) => arguments.extend(["--listen", "127.0.0.1:0"].map(str::to_owned)),
            ("sdo" | "nmt", Some(node)) => arguments.extend(["--bus".to_owned(), node.bus("socketcand")]),
            _ => {}
        }
        let given: Vec<&str> = arguments.iter().map(String::as_str).collect();
        let printed = if command == "run" {
            let process = node.insert(Process::start(&given));
            process.wait_for("pre-operational");
            let port = |line: String| match line.rsplit_once(':') {
                Some((bus, _)) if line.starts_with("socketcand ") => format!("{bus}:29536\n"),
                Some((bus, _)) if line.starts_with("slcan ") => format!("{bus}:29537\n"),
                _ => line + "\n",
            };
            process.lines().into_iter().map(port).collect()
        } else {
            let done = edskit(&given);
            done.stdout + &done.stderr
        };
        let shown = shown.replace("tests/", "").replace("target/", &format!("{output}/"));
        assert_eq!(printed, shown, "{given:?}");
        commands.push(command);
    }
    for command in ["lint", "generate", "run", "sdo", "nmt"] {
        assert!(commands.iter().any(|shown| shown == command), "the README has no example of `{command}`");
    }
    fs::remove_dir_all(output).expect("the example has written there");
}
