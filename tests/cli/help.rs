//! Help, completions, manual page.

use edskit::Exit;
use edskit_tests::edskit;

#[test]
fn help_texts() {
    let commands = [
        "",
        "lint",
        "fmt",
        "show",
        "config",
        "generate",
        "run",
        "bus",
        "monitor",
        "nmt",
        "sdo",
        "sdo read",
        "sdo write",
        "explain",
        "completions",
        "man",
    ];
    for command in commands {
        let arguments: Vec<&str> = command.split_whitespace().chain(["--help"]).collect();
        let output = edskit(&arguments);
        assert_eq!(output.exit, Exit::Clean);
        let name = if command.is_empty() { "edskit".to_owned() } else { command.replace(' ', "_") };
        insta::assert_snapshot!(format!("help_{name}"), output.stdout);
    }
}

#[test]
fn completions_for_every_shell_know_the_commands() {
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let script = edskit(&["completions", shell]).stdout;
        for word in [
            "lint", "fmt", "show", "config", "generate", "run", "bus", "monitor", "nmt", "sdo", "explain",
            "fail-on",
        ] {
            assert!(script.contains(word), "{shell}: {word}");
        }
    }
}

#[test]
fn the_manual_page_has_every_command() {
    let page = edskit(&["man"]).stdout;
    for command in [
        "edskit", "lint", "fmt", "show", "config", "generate", "run", "bus", "monitor", "nmt", "sdo",
        "explain",
    ] {
        assert!(
            page.contains(&format!(".TH {command}")) || page.contains(&format!(".TH edskit-{command}")),
            "{command}"
        );
    }
    assert!(page.contains("\\-\\-fail\\-on"));
}
