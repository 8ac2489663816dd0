//! The composite action of `action.yml`, run on a small repository of EDS files as a CI system runs it.

use edskit_tests::{Folder, root};
use std::env;
use std::ffi::OsString;
use std::fs;
use std::path::Path;
use std::process::Command;

const BAD: &str = "[2000]\nParameterName=Speed\nObjectType=0x7\nDataType=0x0006\nAccessType=RX\n";

/// The command `edskit`.
const EDSKIT: &str = env!("CARGO_BIN_EXE_edskit");

/// What a run of the action left behind.
struct Run {
    code: Option<i32>,
    stdout: String,
    stderr: String,
}

/// The commands of the action's steps, in order.
fn steps() -> Vec<String> {
    let action = fs::read_to_string(root().join("action.yml")).expect("the action can be read");
    action.lines().filter_map(|line| line.trim().strip_prefix("run: ")).map(str::to_owned).collect()
}

/// Runs the steps of the action in a folder, with these inputs as `action.yml` hands them on.
fn run(folder: &Folder, inputs: &[(&str, &str)]) -> Run {
    let mut path = OsString::from(Path::new(EDSKIT).parent().expect("a command lies in a folder"));
    path.push(":");
    path.push(env::var_os("PATH").unwrap_or_default());
    let mut run = Run { code: None, stdout: String::new(), stderr: String::new() };
    for step in steps() {
        let output = Command::new("bash")
            .args(["-e", "-o", "pipefail", "-c", &step])
            .current_dir(folder.path())
            .env("PATH", &path)
            .env("GITHUB_ACTION_PATH", root())
            .env("GITHUB_STEP_SUMMARY", Path::new(folder.path()).join("summary.md"))
            .envs(inputs.iter().copied())
            .output()
            .expect("bash can be started");
        run.code = output.status.code();
        run.stdout += &String::from_utf8_lossy(&output.stdout);
        run.stderr += &String::from_utf8_lossy(&output.stderr);
        if !output.status.success() {
            break;
        }
    }
    run
}

/// A repository with a good file, a bad one in another folder, and settings.
fn repository(name: &str) -> Folder {
    let folder = Folder::new(name);
    let good = fs::read(root().join("eds/CANopenGateway.eds")).expect("the shipped file can be read");
    folder.write("eds/CANopenGateway.eds", good);
    folder.write("edskit.toml", "ignore = [\"STY\", \"FIL\", \"DEV\", \"LST\"]\n");
    folder.write("vendor/Bad.eds", BAD);
    folder.write("README.md", "Not for edskit.\n");
    folder
}

#[test]
fn every_input_reaches_the_script() {
    let action = fs::read_to_string(root().join("action.yml")).unwrap();
    let script = fs::read_to_string(root().join(".github/lint.sh")).unwrap();
    for input in ["paths", "fail-on", "sarif", "arguments"] {
        let variable = format!("EDSKIT_{}", input.to_uppercase().replace('-', "_"));
        assert!(action.contains(&format!("\n  {input}:\n")), "{input}");
        assert!(action.contains(&format!("{variable}: ${{{{ inputs.{input} }}}}")), "{input}");
        assert!(script.contains(&format!("${{{variable}:-")), "{input}");
    }
    assert_eq!(steps().len(), 2);
}

#[test]
fn a_clean_repository_passes() {
    let folder = repository("action-clean");
    let run = run(&folder, &[("EDSKIT_PATHS", "eds"), ("EDSKIT_FAIL_ON", "warning")]);
    assert_eq!((run.code, run.stdout.as_str()), (Some(0), ""), "{}", run.stderr);
}

#[test]
fn a_bad_file_fails_with_annotations_sarif_and_a_summary() {
    let folder = repository("action-bad");
    let inputs = [("EDSKIT_PATHS", "eds vendor"), ("EDSKIT_FAIL_ON", "error"), ("EDSKIT_SARIF", "out.sarif")];
    let run = run(&folder, &inputs);
    assert_eq!(run.code, Some(1), "{}", run.stderr);
    assert!(run.stdout.contains("::error file=vendor/Bad.eds,line=5,"), "{}", run.stdout);
    assert!(!run.stdout.contains("FIL001"), "the settings of the repository count");
    let sarif: serde_json::Value = serde_json::from_slice(&folder.read("out.sarif")).unwrap();
    let results = sarif["runs"][0]["results"].as_array().unwrap();
    assert!(results.iter().any(|result| result["ruleId"] == "OBJ005"), "{results:?}");
    let summary = String::from_utf8(folder.read("summary.md")).unwrap();
    assert!(summary.contains("OBJ005"), "{summary}");
}

#[test]
fn further_arguments_are_handed_on() {
    let folder = repository("action-arguments");
    let run = run(&folder, &[("EDSKIT_PATHS", "vendor"), ("EDSKIT_ARGUMENTS", "--ignore OBJ")]);
    assert_eq!(run.code, Some(0), "{}{}", run.stdout, run.stderr);
}

#[test]
fn what_cannot_be_done_fails_with_2() {
    let folder = repository("action-failed");
    let missing = run(&folder, &[("EDSKIT_PATHS", "nowhere")]);
    assert_eq!(missing.code, Some(2));
    assert!(missing.stderr.contains("nowhere"), "{}", missing.stderr);
    let unwritable = run(&folder, &[("EDSKIT_PATHS", "eds"), ("EDSKIT_SARIF", "no/such/folder.sarif")]);
    assert_eq!(unwritable.code, Some(2));
    assert!(unwritable.stderr.contains("folder.sarif"), "{}", unwritable.stderr);
}
