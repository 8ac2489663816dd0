//! Help, completions, manual page.

use edskit::Exit;
use edskit_tests::edskit;

#[test]
fn help_texts() {
    for command in ["", "lint", "fmt", "show", "config", "run", "explain", "completions", "man"] {
        let arguments: Vec<&str> = [command, "--help"].into_iter().filter(|part| !part.is_empty()).collect();
        let output = edskit(&arguments);
        assert_eq!(output.exit, Exit::Clean);
        let name = if command.is_empty() { "edskit" } else { command };
        insta::assert_snapshot!(format!("help_{name}"), output.stdout);
    }
}

#[test]
fn completions_for_every_shell_know_the_commands() {
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let script = edskit(&["completions", shell]).stdout;
        for word in ["lint", "fmt", "show", "config", "run", "explain", "fail-on"] {
            assert!(script.contains(word), "{shell}: {word}");
        }
    }
}

#[test]
fn the_manual_page_has_every_command() {
    let page = edskit(&["man"]).stdout;
    for command in ["edskit", "lint", "fmt", "show", "config", "run", "explain"] {
        assert!(
            page.contains(&format!(".TH {command}")) || page.contains(&format!(".TH edskit-{command}")),
            "{command}"
        );
    }
    assert!(page.contains("\\-\\-fail\\-on"));
}
