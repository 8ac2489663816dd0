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
