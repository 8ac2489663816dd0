//! `edskit lint`: formats, selection, exit codes.

use edskit::Exit;
use edskit_tests::{Folder, edskit, edskit_with_input};

/// The gateway's data sheet as its manual prints it.
const PUBLISHED: &str = "fixtures/CANopenGateway.published.eds";
/// A small file with a finding of each severity, a fix, and two places.
const FAULTY: &str = "fixtures/faulty.eds";

#[test]
fn the_published_gateway_file() {
    // GW-EDS-11 to GW-EDS-13, GW-NOTE-17
    insta::assert_snapshot!("published_gateway", edskit(&["lint", PUBLISHED]).all());
    insta::assert_snapshot!(
        "published_gateway_all_rules",
        edskit(&["lint", "--select", "ALL", "--format", "concise", PUBLISHED]).all()
    );
}

#[test]
fn shipped_files_are_clean() {
    let output = edskit(&["lint", "../eds", "--fail-on", "info"]);
    assert_eq!((output.exit, output.stderr.as_str()), (Exit::Clean, ""), "{}", output.stdout);
}

#[test]
fn every_format() {
    for format in ["human", "concise", "json", "github", "junit"] {
        insta::assert_snapshot!(
            format!("format_{format}"),
            edskit(&["lint", FAULTY, "--format", format]).all()
        );
    }
    let colored = edskit(&["lint", FAULTY, "--color", "always"]);
    assert!(colored.stdout.contains("\u{1b}[") && !edskit(&["lint", FAULTY]).stdout.contains('\u{1b}'));
}

#[test]
fn sarif_follows_its_schema() {
    let schema = std::fs::read("fixtures/sarif-2.1.0.schema.json").unwrap();
    let mut schema: serde_json::Value = serde_json::from_slice(&schema).unwrap();
    // The published pattern has a bracket too many, so it is no regular expression.
    for owner in ["run", "toolComponent"] {
        let language = &mut schema["definitions"][owner]["properties"]["language"];
        let pattern = language.as_object_mut().unwrap().remove("pattern").unwrap();
        assert_eq!(pattern, "^[a-zA-Z]{2}|^[a-zA-Z]{2}-[a-zA-Z]{2}]?$");
    }
    let validator = jsonschema::validator_for(&schema).unwrap();
    for arguments in
        [&["lint", FAULTY, "--format", "sarif"][..], &["lint", "missing.eds", "--format", "sarif"]]
    {
        let mut log: serde_json::Value = serde_json::from_str(&edskit(arguments).stdout).unwrap();
        let errors: Vec<String> = validator.iter_errors(&log).map(|error| error.to_string()).collect();
        assert!(errors.is_empty(), "{errors:#?}");
        let driver = &mut log["runs"][0]["tool"]["driver"];
        assert!(driver["rules"].as_array().unwrap().len() > 90);
        driver["rules"] = "left out of this snapshot".into();
        driver["version"] = "left out".into();
        let name = if arguments[1] == FAULTY { "format_sarif" } else { "format_sarif_unreadable" };
        insta::assert_snapshot!(name, serde_json::to_string_pretty(&log).unwrap());
    }
}

#[test]
fn statistics() {
    insta::assert_snapshot!("statistics", edskit(&["lint", FAULTY, "--statistics"]).all());
    insta::assert_snapshot!(
        "statistics_json",
        edskit(&["lint", FAULTY, "--statistics", "--format", "json"]).all()
    );
}

#[test]
fn rules_are_selected_by_code_prefix_and_name() {
    let codes = |arguments: &[&str]| {
        let output = edskit(&[&["lint", FAULTY, "--format", "concise", "--quiet"], arguments].concat());
        let code = |line: &str| line.split_once('[').unwrap().1.split_once(']').unwrap().0.to_owned();
        let mut codes: Vec<String> = output.stdout.lines().map(code).collect();
        codes.sort();
        codes.dedup();
        codes
    };
    assert_eq!(codes(&["--select", "SYN013"]), ["SYN013"]);
    assert_eq!(codes(&["--select", "duplicate-section"]), ["SYN013"]);
    assert!(
        codes(&["--select", "OBJ,SYN"]).iter().all(|code| code.starts_with("OBJ") || code.starts_with("SYN"))
    );
    assert!(!codes(&["--ignore", "SYN"]).iter().any(|code| code.starts_with("SYN")));
    assert!(codes(&["--select", "SYN", "--ignore", "SYN"]).is_empty());
    let extended = edskit(&["lint", PUBLISHED, "--format", "concise", "--extend-select", "FIL008"]).stdout;
    assert!(extended.contains("[FIL008]") && extended.contains("[SYN017]"), "{extended}");
}

#[test]
fn the_exit_code_follows_the_threshold() {
    let folder = Folder::new("threshold");
    let info = folder.write("info.eds", "[Special]\n[FileInfo]\n");
    let run = |threshold| edskit(&["lint", &info, "--select", "SYN023", "--fail-on", threshold]).exit;
    assert_eq!((run("error"), run("warning"), run("info")), (Exit::Clean, Exit::Clean, Exit::Findings));
    assert_eq!(edskit(&["lint", FAULTY, "--fail-on", "error"]).exit, Exit::Findings);
}

#[test]
fn standard_input_has_a_name() {
    let output =
        edskit_with_input(&["lint", "-", "--format", "concise", "--select", "SYN013"], b"[1000]\n[1000]\n");
    assert_eq!(
        output.stdout,
        "stdin.eds:2:1: error[SYN013] section `[1000]` stands a second time\n1 error in 1 of 1 file\n"
    );
    let arguments =
        ["lint", "-", "--format", "concise", "--stdin-filename", "net.cpj", "--select", "SYN013,LST"];
    let output = edskit_with_input(&arguments, b"[Topology]\n[TOPOLOGY]\n");
    assert_eq!(
        output.stdout,
        "net.cpj:2:1: error[SYN013] section `[TOPOLOGY]` stands a second time\n1 error in 1 of 1 file\n"
    );
}

#[test]
fn folders_are_searched_and_git_is_heeded() {
    let folder = Folder::new("search");
    for name in ["b.EDS", "a.dcf", "deep/c.Cpj", "ignored/d.eds", "notes.txt"] {
        folder.write(name, "[1000]\n[1000]\n");
    }
    folder.write(".gitignore", "ignored/\n");
    let output = edskit(&["lint", folder.path(), "--select", "SYN013", "--format", "concise", "--quiet"]);
    let names: Vec<&str> = output.stdout.lines().map(|line| line.split(':').next().unwrap()).collect();
    let expected = ["a.dcf", "b.EDS", "deep/c.Cpj"].map(|name| format!("{}/{name}", folder.path()));
    assert_eq!(names, expected);
    // A file that is named is linted whatever git says, and only once.
    let ignored = format!("{}/ignored/d.eds", folder.path());
    let output =
        edskit(&["lint", &ignored, &ignored, "--select", "SYN013", "--format", "concise", "--quiet"]);
    assert_eq!(output.stdout.lines().count(), 1);
}

#[test]
fn the_order_is_the_same_in_every_run() {
    let folder = Folder::new("order");
    for number in 0..40 {
        folder.write(&format!("{number:02}.eds"), "[1000]\n[1000]\n");
    }
    let run = || edskit(&["lint", folder.path(), "--format", "json"]).stdout;
    let first = run();
    assert!((0..5).all(|_| run() == first));
}

#[test]
fn output_goes_to_a_file() {
    let folder = Folder::new("output");
    let target = format!("{}/report.xml", folder.path());
    let output = edskit(&["lint", FAULTY, "--format", "junit", "--output", &target]);
    let summary = "6 errors, 3 warnings, 2 info in 1 of 1 file\n";
    assert_eq!((output.exit, output.stdout.as_str()), (Exit::Findings, summary));
    let quiet = edskit(&["lint", FAULTY, "--format", "junit", "--quiet", "--output", &target]);
    assert_eq!((quiet.exit, quiet.stdout.as_str()), (Exit::Findings, ""));
    let written = String::from_utf8(folder.read("report.xml")).unwrap();
    assert_eq!(written, edskit(&["lint", FAULTY, "--format", "junit"]).stdout);
}

#[test]
fn the_rest_is_linted_when_a_file_is_missing() {
    let output =
        edskit(&["lint", "fixtures/missing.eds", FAULTY, "--format", "concise", "--select", "SYN013"]);
    insta::assert_snapshot!("one_file_missing", output.all());
    assert_eq!(output.exit, Exit::Failed);
}

#[test]
fn every_odd_file_says_what_is_odd() {
    let mut names: Vec<_> =
        std::fs::read_dir("fixtures/oddities").unwrap().map(|entry| entry.unwrap().path()).collect();
    names.sort();
    assert!(names.len() > 20);
    for path in names {
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        let output = edskit(&["lint", path.to_str().unwrap(), "--format", "human"]);
        insta::assert_snapshot!(format!("oddity_{name}"), output.all());
    }
}

#[test]
fn a_verdict_follows_the_threshold_in_junit_too() {
    let folder = Folder::new("junit");
    let path = folder.write("info.eds", "[Special]\n[FileInfo]\n");
    let junit = |threshold: &str| {
        edskit(&["lint", &path, "--select", "SYN023", "--format", "junit", "--fail-on", threshold])
    };
    let passed = junit("warning");
    assert!(passed.stdout.contains("tests=\"1\" failures=\"0\""), "{}", passed.stdout);
    assert!(passed.stdout.contains("<system-out>info: `[Special]`"), "{}", passed.stdout);
    let failed = junit("info");
    assert!(failed.stdout.contains("tests=\"1\" failures=\"1\""), "{}", failed.stdout);
    assert_eq!((passed.exit, failed.exit), (Exit::Clean, Exit::Findings));
}

#[test]
fn statistics_add_up_to_the_summary() {
    let Some(_) = edskit_tests::corpus("statistics") else { return };
    let rows =
        edskit(&["lint", "--isolated", "--statistics", "--format", "json", "../../shared/corpus"]).stdout;
    let rows: Vec<serde_json::Value> = serde_json::from_str(&rows).unwrap();
    let sum = |severity: &str| -> u64 {
        let rows = rows.iter().filter(|row| row["severity"] == severity);
        rows.map(|row| row["findings"].as_u64().unwrap()).sum()
    };
    let report = edskit(&["lint", "--isolated", "--format", "json", "../../shared/corpus"]).stdout;
    let report: serde_json::Value = serde_json::from_str(&report).unwrap();
    for (severity, key) in [("error", "errors"), ("warning", "warnings"), ("info", "infos")] {
        assert_eq!(report["summary"][key], sum(severity), "{severity}");
    }
}

#[test]
fn a_file_is_linted_once_however_it_is_typed() {
    let folder = Folder::new("once");
    let path = folder.write("eds/a.eds", "[1000]\n[1000]\n");
    let other = format!("{}/./eds/../eds/a.eds", folder.path());
    let output = edskit(&["lint", &path, &other, folder.path(), "--select", "SYN013", "--format", "concise"]);
    assert!(output.stdout.ends_with("1 error in 1 of 1 file\n"), "{}", output.stdout);
}

#[test]
fn globs_that_no_shell_has_expanded() {
    let folder = Folder::new("globs");
    let text = "[1000]\nParameterName=Device type\nDataType=7\n[1000]\n";
    for name in ["eds/a.eds", "eds/b.eds", "eds/deep/c.eds", "eds/.hidden.eds", "[x].eds"] {
        folder.write(name, text);
    }
    let count = |pattern: &str| {
        let pattern = format!("{}/{pattern}", folder.path());
        let output = edskit(&["lint", &pattern, "--select", "SYN013", "--format", "concise", "--quiet"]);
        (output.stdout.lines().count(), output.exit)
    };
    assert_eq!(count("eds/*.eds"), (2, Exit::Findings));
    assert_eq!(count("eds/**/*.eds"), (3, Exit::Findings));
    assert_eq!(count("**/*.eds"), (4, Exit::Findings));
    assert_eq!(count("eds/?.eds"), (2, Exit::Findings));
    assert_eq!(count("{eds/a,eds/b}.eds"), (2, Exit::Findings));
    assert_eq!(count("eds/d*"), (1, Exit::Findings), "a folder is searched");
    assert_eq!(count("[x].eds"), (1, Exit::Findings), "a file of that name comes first");
    for command in ["lint", "fmt", "show", "generate", "run"] {
        let pattern = format!("{}/eds/*.dcf", folder.path());
        let more: &[&str] = if command == "generate" { &["--output", folder.path()] } else { &[] };
        let output = edskit(&[&[command, &pattern], more].concat());
        assert_eq!(output.exit, Exit::Failed, "{command}");
        assert!(
            output.stderr.contains("there is no file that this glob means"),
            "{command}: {}",
            output.stderr
        );
    }
    let one = format!("{}/eds/a*.eds", folder.path());
    assert_eq!(edskit(&["show", &one]).exit, Exit::Clean);
    let two = format!("{}/eds/*.eds", folder.path());
    assert!(edskit(&["show", &two]).stderr.contains("2 files are meant"), "show takes one file");
    assert_eq!(edskit(&["fmt", "--check", &two]).stdout.lines().count(), 2);
}
