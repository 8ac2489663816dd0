//! `edskit fmt`.

use edskit::Exit;
use edskit_tests::{Folder, edskit, edskit_with_input};

const MESSY: &str = "[deviceinfo]\r\nvendorname = Acme \r\n[FileInfo]\r\nFileName=a.eds\r\n; about the type\r\n[1000]\r\nAccessType=RO\r\nDataType=0x7\r\nParameterName=Type\r\n";

#[test]
fn files_are_formatted_in_place_once() {
    let folder = Folder::new("fmt");
    let path = folder.write("a.eds", MESSY);
    let first = edskit(&["fmt", &path]);
    insta::assert_snapshot!("fmt_in_place", folder.clean(&first));
    insta::assert_snapshot!(
        "fmt_result",
        String::from_utf8(folder.read("a.eds")).unwrap().replace('\r', "<CR>")
    );
    let after = folder.read("a.eds");
    assert_eq!(edskit(&["fmt", folder.path()]).exit, Exit::Clean);
    assert_eq!(folder.read("a.eds"), after);
}

#[test]
fn check_and_diff_change_nothing() {
    let folder = Folder::new("fmt-check");
    let path = folder.write("a.eds", MESSY);
    let check = edskit(&["fmt", "--check", &path]);
    insta::assert_snapshot!("fmt_check", folder.clean(&check));
    let diff = edskit(&["fmt", "--diff", &path]);
    insta::assert_snapshot!("fmt_diff", folder.clean(&diff).replace('\r', ""));
    assert_eq!((check.exit, diff.exit), (Exit::Findings, Exit::Findings));
    assert_eq!(folder.read("a.eds"), MESSY.as_bytes());
    assert_eq!(edskit(&["fmt", "--check", "../eds"]).exit, Exit::Clean);
}

#[test]
fn standard_input_goes_to_standard_output() {
    let output = edskit_with_input(&["fmt", "-"], MESSY.as_bytes());
    assert_eq!((output.exit, output.stderr.as_str()), (Exit::Clean, ""));
    let again = edskit_with_input(&["fmt", "-"], output.stdout.as_bytes());
    assert_eq!(again.stdout, output.stdout);
}
