//! `edskit.toml`, suppressions in files, baselines.

use edskit::Exit;
use edskit_tests::{Folder, edskit};

const BAD: &str = "[2000]\n[2000]\n[2000sub0]\nDataType=0x0007\n";

fn codes(folder: &Folder, arguments: &[&str]) -> Vec<String> {
    let output = edskit(&[&["lint", "--format", "concise", "--quiet", folder.path()], arguments].concat());
    // A line reads `FOLDER/a.eds:1:2: error[SYN013] message`.
    let code = |line: &str| {
        let (place, rest) = line.split_once(": ").expect("a place");
        let (_, file) = place.rsplit_once('/').expect("a folder");
        let (file, _) = file.split_once(':').expect("a line number");
        let (rule, _) = rest.split_once(']').expect("a code");
        format!("{file} {}", rule.replace('[', " "))
    };
    output.stdout.lines().map(code).collect()
}

#[test]
fn settings_are_found_upwards_and_the_nearest_counts() {
    let folder = Folder::new("settings");
    folder.write("edskit.toml", "select = [\"SYN013\"]\n");
    folder.write("a.eds", BAD);
    folder.write("deep/b.eds", BAD);
    folder.write("deep/own/edskit.toml", "select = [\"OBJ013\"]\n[severity]\nOBJ013 = \"info\"\n");
    folder.write("deep/own/c.eds", BAD);
    assert_eq!(codes(&folder, &[]), ["a.eds error SYN013", "b.eds error SYN013", "c.eds info OBJ013"]);
    assert_eq!(codes(&folder, &["--select", "OBJ013"]).len(), 3);
    assert!(codes(&folder, &["--isolated"]).len() > 3);
    let other = folder.write("other.toml", "select = []\n");
    assert!(codes(&folder, &["--config", &other]).is_empty());
}

#[test]
fn overrides_are_for_some_files() {
    let folder = Folder::new("overrides");
    folder.write(
        "edskit.toml",
        "select = [\"SYN013\", \"OBJ013\"]\n[[override]]\nfiles = [\"vendor/**\"]\nignore = [\"OBJ\"]\n[override.severity]\nduplicate-section = \"warning\"\n",
    );
    folder.write("own.eds", BAD);
    folder.write("vendor/theirs.eds", BAD);
    assert_eq!(
        codes(&folder, &[]),
        ["own.eds error SYN013", "own.eds error OBJ013", "theirs.eds warning SYN013"]
    );
}

#[test]
fn mistakes_in_settings_have_a_place() {
    let folder = Folder::new("bad-settings");
    folder.write("a.eds", BAD);
    for (name, text) in [
        ("syntax", "select = [\n"),
        ("unknown_key", "selcet = [\"SYN\"]\n"),
        ("unknown_rule", "\nignore = [\"SYN013\", \"duplicate-sektion\"]\n"),
        ("unknown_severity", "[severity]\nSYN013 = \"fatal\"\n"),
        ("override_without_files", "[[override]]\nignore = [\"SYN\"]\n"),
        ("files_without_override", "files = [\"a\"]\n"),
        ("bad_glob", "[[override]]\nfiles = [\"a[\"]\n"),
        ("bad_rule_in_override", "[[override]]\nfiles = [\"a\"]\nselect = [\"NOPE\"]\n"),
    ] {
        folder.write("edskit.toml", text);
        let output = edskit(&["lint", folder.path()]);
        assert_eq!(output.exit, Exit::Failed, "{name}");
        insta::assert_snapshot!(format!("settings_{name}"), folder.clean(&output));
    }
}

#[test]
fn comments_silence_findings() {
    let folder = Folder::new("suppression");
    folder.write(
        "a.eds",
        format!(";edskit: allow-file(SYN013) both are meant\n{BAD};edskit: allow(OBJ013)\nx=1\n"),
    );
    let all = ["--select", "SYN013,OBJ013,SYN027"];
    assert_eq!(codes(&folder, &all), ["a.eds error OBJ013", "a.eds warning SYN027"]);
}

#[test]
fn a_baseline_hides_what_is_known() {
    let folder = Folder::new("baseline");
    folder.write("a.eds", BAD);
    let baseline = format!("{}/known.json", folder.path());
    let rules = [
        "lint",
        folder.path(),
        "--isolated",
        "--select",
        "SYN013,OBJ013",
        "--format",
        "concise",
        "--baseline",
        &baseline,
    ];
    let missing = edskit(&rules);
    assert_eq!(missing.exit, Exit::Failed);
    insta::assert_snapshot!("baseline_missing", folder.clean(&missing));
    let update = edskit(&[&rules[..], &["--update-baseline"]].concat());
    insta::assert_snapshot!("baseline_update", folder.clean(&update));
    insta::assert_snapshot!("baseline_file", String::from_utf8(folder.read("known.json")).unwrap());
    let clean = edskit(&rules);
    assert_eq!(
        (clean.exit, clean.stdout.as_str()),
        (Exit::Clean, "1 file, no findings, 2 known from the baseline\n")
    );
    // Moved lines are still known; another finding of the same kind is new.
    folder.write("a.eds", format!(";moved\n\n{BAD}[2001sub0]\nDataType=0x0007\n"));
    let new = edskit(&rules);
    insta::assert_snapshot!("baseline_new_finding", folder.clean(&new));
    folder.write("known.json", "{}");
    insta::assert_snapshot!("baseline_broken", folder.clean(&edskit(&rules)));
}

/// Two folders with a finding of SYN013 and one of OBJ013 in each file.
fn two_files(name: &str) -> (Folder, String) {
    let folder = Folder::new(name);
    folder.write("eds/one.eds", BAD);
    folder.write("eds/two.eds", BAD);
    let baseline = format!("{}/known.json", folder.path());
    (folder, baseline)
}

fn with_baseline(baseline: &str, arguments: &[&str]) -> edskit_tests::Output {
    let rules = ["lint", "--isolated", "--format", "concise", "--baseline", baseline];
    let select: &[&str] = if arguments.contains(&"--select") { &[] } else { &["--select", "SYN013,OBJ013"] };
    edskit(&[&rules[..], select, arguments].concat())
}

#[test]
fn a_partial_run_costs_a_baseline_nothing() {
    let (folder, baseline) = two_files("baseline-partial");
    let all = format!("{}/eds", folder.path());
    let one = format!("{}/eds/one.eds", folder.path());
    assert_eq!(with_baseline(&baseline, &[&all, "--update-baseline"]).exit, Exit::Clean);
    let whole = folder.read("known.json");
    let clean = || {
        let output = with_baseline(&baseline, &[&all]);
        assert_eq!(
            (output.exit, output.stdout.as_str()),
            (Exit::Clean, "2 files, no findings, 4 known from the baseline\n")
        );
    };
    // One file of two.
    let output = with_baseline(&baseline, &[&one, "--update-baseline"]);
    assert_eq!(
        folder.clean(&output),
        "--- stdout\n2 findings written to <folder>/known.json, 2 of files and rules that were not looked at kept\n--- exit 0"
    );
    clean();
    // One rule of two.
    with_baseline(&baseline, &[&all, "--update-baseline", "--select", "SYN013"]);
    clean();
    // A file that cannot be read was not looked at.
    let missing = format!("{}/eds/gone.eds", folder.path());
    assert_eq!(with_baseline(&baseline, &[&one, &missing, "--update-baseline"]).exit, Exit::Failed);
    clean();
    // Nor was a file that settings exclude.
    folder.write("edskit.toml", "exclude = [\"eds/two.eds\"]\n");
    let rules = ["lint", "--baseline", &baseline, "--select", "SYN013,OBJ013", &all, "--update-baseline"];
    assert_eq!(edskit(&rules).exit, Exit::Clean);
    clean();
    assert_eq!(folder.read("known.json"), whole);
    // What is mended goes.
    folder.write("eds/one.eds", "[2000]\n");
    with_baseline(&baseline, &[&one, "--update-baseline"]);
    assert!(!String::from_utf8(folder.read("known.json")).unwrap().contains("one.eds"));
    // A baseline that cannot be read is not written over.
    folder.write("known.json", "{");
    assert_eq!(with_baseline(&baseline, &[&one, "--update-baseline"]).exit, Exit::Failed);
    assert_eq!(folder.read("known.json"), b"{");
}

#[test]
fn a_path_is_known_however_it_is_typed() {
    let (folder, baseline) = two_files("baseline-paths");
    with_baseline(&baseline, &[folder.path(), "--update-baseline"]);
    let text = String::from_utf8(folder.read("known.json")).unwrap();
    assert!(text.contains("\"eds/one.eds\"") && !text.contains(folder.path()), "{text}");
    let other = format!("{}/eds/../known.json", folder.path());
    for typed in ["eds/one.eds", "./eds/one.eds", "eds/../eds/one.eds", "eds//one.eds"] {
        let path = format!("{}/{typed}", folder.path());
        for baseline in [&baseline, &other] {
            assert_eq!(with_baseline(baseline, &[&path]).exit, Exit::Clean, "{typed}");
        }
    }
    // A baseline beside the files, not above them.
    let beside = folder.write("ci/known.json", text.replace("eds/", "../eds/"));
    assert_eq!(with_baseline(&beside, &[folder.path()]).exit, Exit::Clean);
    with_baseline(&beside, &[folder.path(), "--update-baseline"]);
    assert!(String::from_utf8(folder.read("ci/known.json")).unwrap().contains("\"../eds/one.eds\""));
    // One that was written with a whole path.
    let whole = folder.write("whole.json", text.replace("eds/", &format!("{}/eds/", folder.path())));
    assert_eq!(with_baseline(&whole, &[folder.path()]).exit, Exit::Clean);
}

#[test]
fn files_that_are_gone_leave_a_baseline_when_that_is_asked() {
    let (folder, baseline) = two_files("baseline-prune");
    with_baseline(&baseline, &[folder.path(), "--update-baseline"]);
    std::fs::remove_file(format!("{}/eds/two.eds", folder.path())).unwrap();
    with_baseline(&baseline, &[folder.path(), "--update-baseline"]);
    assert!(String::from_utf8(folder.read("known.json")).unwrap().contains("two.eds"));
    let output = with_baseline(&baseline, &[folder.path(), "--prune-baseline"]);
    assert_eq!(
        folder.clean(&output),
        "--- stdout\n1 file, no findings, 2 known from the baseline\n--- stderr\nedskit: <folder>/known.json: 1 file that is gone is taken out\n--- exit 0"
    );
    let text = String::from_utf8(folder.read("known.json")).unwrap();
    assert!(text.contains("one.eds") && !text.contains("two.eds"));
    let nothing = edskit(&["lint", "--isolated", "--prune-baseline", folder.path()]);
    assert_eq!(nothing.exit, Exit::Failed);
}

#[test]
fn what_is_excluded_is_left_alone() {
    let folder = Folder::new("exclude");
    folder.write("edskit.toml", "select = [\"SYN013\"]\nexclude = [\"vendor/**\", \"*.old.eds\"]\n");
    let own = folder.write("own.eds", BAD);
    let theirs = folder.write("vendor/deep/theirs.eds", BAD);
    folder.write("a.old.eds", BAD);
    folder.write("deep/b.old.eds", BAD);
    assert_eq!(codes(&folder, &[]), ["b.old.eds error SYN013", "own.eds error SYN013"]);
    // Below the folder of the settings, in a file that is named, and for other commands.
    let below = format!("{}/vendor", folder.path());
    let output = edskit(&["lint", &below]);
    assert_eq!((output.exit, output.stdout.as_str()), (Exit::Clean, "0 files, no findings\n"));
    let named = edskit(&["lint", "--format", "concise", "--quiet", &theirs, &own]);
    assert_eq!(named.stdout.lines().count(), 1);
    assert!(
        named.stderr.contains("theirs.eds: left out, because `exclude` of edskit.toml names it"),
        "{}",
        named.stderr
    );
    let before = folder.read("vendor/deep/theirs.eds");
    let messy = folder.write("vendor/messy.eds", "[1000]\nAccessType = RO\n");
    assert_eq!(edskit(&["fmt", "--check", &below]).exit, Exit::Clean);
    assert_eq!(edskit(&["fmt", &messy]).exit, Exit::Clean);
    assert_eq!(
        (folder.read("vendor/deep/theirs.eds"), folder.read("vendor/messy.eds")),
        (before, b"[1000]\nAccessType = RO\n".to_vec())
    );
    assert_eq!(codes(&folder, &["--isolated", "--select", "SYN013"]).len(), 4);
}

#[test]
fn the_threshold_and_the_baseline_may_stand_in_the_settings() {
    let folder = Folder::new("settings-ci");
    folder.write("edskit.toml", "select = [\"SYN013\", \"OBJ013\"]\nfail-on = \"error\"\n[severity]\nSYN013 = \"warning\"\nOBJ013 = \"info\"\n");
    let file = folder.write("deep/a.eds", BAD);
    assert_eq!(edskit(&["lint", &file]).exit, Exit::Clean);
    assert_eq!(
        edskit(&["lint", &file, "--fail-on", "warning"]).exit,
        Exit::Findings,
        "the command line comes first"
    );
    folder.write("edskit.toml", "select = [\"SYN013\"]\nbaseline = \"old.json\"\n");
    assert_eq!(edskit(&["lint", &file]).exit, Exit::Failed, "there is none yet");
    assert_eq!(edskit(&["lint", &file, "--update-baseline"]).exit, Exit::Clean);
    assert!(String::from_utf8(folder.read("old.json")).unwrap().contains("\"deep/a.eds\""));
    assert_eq!(edskit(&["lint", &file]).stdout, "1 file, no findings, 1 known from the baseline\n");
    let empty = folder.write("empty.json", "{\"version\": 1, \"files\": {}}");
    assert_eq!(edskit(&["lint", &file, "--baseline", &empty]).exit, Exit::Findings);
    for (name, text) in [
        ("bad_fail_on", "fail-on = \"fatal\"\n"),
        ("bad_exclude", "exclude = [\"a[\"]\n"),
        ("exclude_in_override", "[[override]]\nfiles = [\"a\"]\nexclude = [\"b\"]\n"),
        ("baseline_in_override", "[[override]]\nfiles = [\"a\"]\nbaseline = \"b\"\n"),
    ] {
        folder.write("edskit.toml", text);
        let output = edskit(&["lint", &file]);
        assert_eq!(output.exit, Exit::Failed, "{name}");
        insta::assert_snapshot!(format!("settings_{name}"), folder.clean(&output));
    }
}
