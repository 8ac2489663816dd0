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
