//! `edskit lint --fix`, `--unsafe-fixes`, `--diff`.

use edskit::Exit;
use edskit_tests::{Folder, edskit, edskit_with_input};

const TEXT: &str = "[2000]\r\nParameterName=M\u{fc}ller\r\nAccessType=RW\r\nDataType =0x0005\r\n[2000sub0]\r\nDataType=0x0007\r\n";

#[test]
fn safe_fixes_keep_encoding_and_line_endings() {
    let folder = Folder::new("fix");
    let latin: Vec<u8> = TEXT.chars().map(|c| u8::try_from(u32::from(c)).unwrap()).collect();
    let path = folder.write("a.eds", &latin);
    let output = edskit(&["lint", "--fix", "--isolated", "--select", "SYN009,OBJ005,OBJ013", &path]);
    insta::assert_snapshot!("fix_safe", folder.clean(&output));
    let expected = TEXT.replace("RW", "rw").replace("DataType =", "DataType=");
    let expected: Vec<u8> = expected.chars().map(|c| u8::try_from(u32::from(c)).unwrap()).collect();
    assert_eq!(folder.read("a.eds"), expected);
    assert_eq!(output.exit, Exit::Findings, "the unsafe fix is left");
}

#[test]
fn unsafe_fixes_are_asked_for() {
    let folder = Folder::new("fix-unsafe");
    let path = folder.write("a.eds", TEXT);
    let output = edskit(&["lint", "--fix", "--unsafe-fixes", "--select", "OBJ013", &path]);
    assert_eq!(output.exit, Exit::Clean, "{}", output.all());
    assert!(String::from_utf8(folder.read("a.eds")).unwrap().ends_with("DataType=0x0005\r\n"));
}

#[test]
fn a_difference_changes_nothing() {
    let folder = Folder::new("fix-diff");
    let path = folder.write("a.eds", TEXT);
    let output =
        edskit(&["lint", "--diff", "--quiet", "--format", "concise", "--select", "SYN009,OBJ005", &path]);
    insta::assert_snapshot!("fix_diff", folder.clean(&output).replace('\r', ""));
    assert_eq!(folder.read("a.eds"), TEXT.as_bytes());
}

#[test]
fn what_cannot_be_fixed_is_said() {
    for arguments in [&["lint", "--fix", "-"][..], &["lint", "--unsafe-fixes", "-"]] {
        let output = edskit_with_input(arguments, b"[2000]\n");
        assert_eq!(output.exit, Exit::Failed);
        insta::assert_snapshot!(format!("fix_refused_{}", &arguments[1][2..]), output.all());
    }
}

/// A list in which a conflict left two halves that share a line, in the style of diff3 if there is a base.
fn conflict(base: &str) -> String {
    let ours = "[OptionalObjects]\nSupportedObjects=3\n1=0x1005\n<<<<<<< HEAD\n2=0x1017\n3=0x1014\n";
    format!("{ours}{base}=======\n2=0x1018\n3=0x1014\n>>>>>>> theirs\n\n[2000]\nParameterName =Speed\n")
}

#[test]
fn no_fix_changes_a_conflict() {
    let folder = Folder::new("fix-conflict");
    for (name, base) in [("a.eds", ""), ("b.dcf", "||||||| base\n2=0x1017\n"), ("c.cpj", "")] {
        let text = conflict(base);
        let path = folder.write(name, &text);
        for more in [&[][..], &["--unsafe-fixes"]] {
            edskit(&[&["lint", "--fix", "--isolated", "--select", "SYN,LST,STY", &path], more].concat());
            let after = String::from_utf8(folder.read(name)).unwrap();
            let (start, end) = (text.find("<<<<").unwrap(), text.find("\n\n[2000]").unwrap());
            assert!(after.contains(&text[start..end]), "{name}: {after}");
            assert!(after.contains("ParameterName=Speed"), "what is outside is mended: {after}");
        }
        // Where it is not clear what belongs to the conflict, nothing is changed.
        let stray = text.replace("<<<<<<< HEAD\n", "");
        folder.write(name, &stray);
        edskit(&["lint", "--fix", "--unsafe-fixes", "--isolated", "--select", "ALL", &path]);
        assert_eq!(folder.read(name), stray.as_bytes());
        let check = edskit(&["fmt", "--check", &path]);
        assert_eq!(check.exit, Exit::Failed);
        assert!(
            check.stderr.contains(&format!("{name}:")) && check.stderr.contains("a conflict"),
            "{}",
            check.stderr
        );
    }
}

#[test]
fn fixing_is_done_in_one_run_and_tells_what_is_left_out() {
    let folder = Folder::new("fix-done");
    let mut text = String::new();
    for number in 0..300 {
        let data_type = if number % 3 == 0 { "0x0005" } else { "0x0006" };
        text += &format!(
            "[{:X}]\nParameterName=a\nObjectType=0x7 ; VAR\nDataType={data_type} ; type\nAccessType=rw ; access\nDefaultValue=300 ; note\nPDOMapping=0 ; no\n",
            0x2000 + number
        );
    }
    let path = folder.write("a.eds", &text);
    let fix = || {
        edskit(&["lint", "--fix", "--isolated", "--select", "SYN012,VAL002,OBJ", "--format", "json", &path])
    };
    let first = fix();
    let once = folder.read("a.eds");
    let again = fix();
    assert_eq!(folder.read("a.eds"), once, "a second run changes the file");
    let report: serde_json::Value = serde_json::from_str(&first.stdout).unwrap();
    let left_out = report["summary"]["fixes_left_out"].as_u64().unwrap();
    assert_eq!(report["summary"]["fixed"].as_u64().unwrap() + left_out, 1_500);
    assert!(!first.stdout.contains("\"safe\"") && !again.stdout.contains("\"safe\""), "nothing safe is left");
    assert_eq!(first.stderr, "");
}

#[test]
fn a_fix_that_brings_up_worse_is_left_out_and_told() {
    let folder = Folder::new("fix-left-out");
    // Whoever mends the name of the second section makes it one that stands twice.
    let path = folder.write(
        "a.eds",
        "[2000]\nParameterName=a\n[2000sub1]\n#ParameterName=b\nParameterName=c\nParameterName=d\n",
    );
    for format in ["human", "concise", "json", "sarif", "github", "junit"] {
        let output = edskit(&["lint", "--fix", "--unsafe-fixes", "--isolated", "--format", format, &path]);
        assert!(
            !output.stdout.contains("safe fix") && !output.stdout.contains("\"safe\""),
            "{}",
            output.stdout
        );
    }
}

#[test]
fn git_takes_the_patch() {
    let folder = Folder::new("fix-patch");
    let latin: Vec<u8> = TEXT.chars().map(|c| u8::try_from(u32::from(c)).unwrap()).collect();
    let git = |arguments: &[&str], input: &[u8]| {
        use std::io::Write;
        let mut child = std::process::Command::new("git")
            .args(arguments)
            .current_dir(folder.path())
            .env("GIT_CONFIG_GLOBAL", "/dev/null")
            .stdin(std::process::Stdio::piped())
            .stderr(std::process::Stdio::piped())
            .spawn()
            .expect("git can be started");
        child.stdin.take().unwrap().write_all(input).unwrap();
        let output = child.wait_with_output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    };
    git(&["init", "--quiet"], b"");
    for (name, text) in [
        ("plain.eds", TEXT.as_bytes().to_vec()),
        ("with blank.eds", TEXT.replace('\r', "").into_bytes()),
        ("latin.eds", latin),
        ("no-end.eds", TEXT.trim_end().as_bytes().to_vec()),
    ] {
        let path = folder.write(name, &text);
        for command in
            [&["lint", "--diff", "--isolated", "--select", "SYN009,OBJ005"][..], &["fmt", "--diff"]]
        {
            folder.write(name, &text);
            let patch = edskit_tests::edskit_bytes(&[command, &[&path]].concat());
            // The tests run in a folder of their own, so the path is whole there.
            let patch = replace(&patch, format!("/{}/", folder.path()).as_bytes(), b"/");
            git(&["apply"], &patch);
            let mended = folder.read(name);
            assert_ne!(mended, text, "{name}");
            folder.write(name, &text);
            match command[0] {
                "lint" => edskit(&["lint", "--fix", "--isolated", "--select", "SYN009,OBJ005", &path]),
                _ => edskit(&["fmt", &path]),
            };
            assert_eq!(mended, folder.read(name), "{name} {command:?}");
        }
    }
}

/// `bytes` with every `old` replaced.
fn replace(bytes: &[u8], old: &[u8], new: &[u8]) -> Vec<u8> {
    let mut result = Vec::new();
    let mut rest = bytes;
    while let Some(place) = rest.windows(old.len()).position(|window| window == old) {
        result.extend_from_slice(&rest[..place]);
        result.extend_from_slice(new);
        rest = &rest[place + old.len()..];
    }
    result.extend_from_slice(rest);
    result
}

#[test]
fn a_patch_stands_alone_on_standard_output() {
    let folder = Folder::new("fix-alone");
    let path = folder.write("a.eds", TEXT);
    let output =
        edskit(&["lint", "--diff", "--isolated", "--format", "concise", "--select", "SYN009,OBJ013", &path]);
    assert!(output.stdout.starts_with("--- a/"), "{}", output.stdout);
    assert!(output.stdout.lines().all(|line| line.starts_with([' ', '+', '-', '@'])), "{}", output.stdout);
    assert!(
        output.stderr.contains("error[OBJ013]") && output.stderr.contains("1 would be fixed"),
        "{}",
        output.stderr
    );
}
