//! What the command line says to input that it cannot use.

use edskit::Exit;
use edskit_tests::{Folder, edskit, edskit_with_input};

#[test]
fn bad_options_are_explained() {
    let cases: [&[&str]; 12] = [
        &[],
        &["lnt"],
        &["lint", "--format", "xml"],
        &["lint", "--select", "duplicate-sektion"],
        &["lint", "--ignore", "XYZ999"],
        &["lint", "--select", ""],
        &["lint", "--statistics", "--format", "sarif"],
        &["explain"],
        &["explain", "SYN999"],
        &["show", "../eds/CANopenGateway.eds", "zz"],
        &["show", "../eds/CANopenGateway.eds", "--node-id", "128"],
        &["completions", "tcsh"],
    ];
    for (number, arguments) in cases.into_iter().enumerate() {
        let output = edskit(arguments);
        assert_eq!(output.exit, Exit::Failed, "{arguments:?}");
        insta::assert_snapshot!(
            format!("bad_option_{number:02}"),
            format!("{arguments:?}\n{}", output.all())
        );
    }
}

#[test]
fn files_that_are_no_canopen_files_get_one_finding() {
    let utf16: Vec<u8> =
        "[FileInfo]\r\nFileName=a.eds\r\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
    let cases: [(&str, &[u8]); 11] = [
        ("empty", b""),
        ("blank", b"\r\n  \r\n"),
        ("utf16", &utf16),
        ("zip", b"PK\x03\x04\x14\0\0\0"),
        ("gzip", b"\x1F\x8B\x08\0\0\0\0\0"),
        ("xdd", b"<?xml version=\"1.0\"?>\n<ISO15745ProfileContainer>\n"),
        ("html", b"<!DOCTYPE html>\n<html><body>404</body></html>\n"),
        ("json", b"{\"message\": \"Not Found\"}\n"),
        ("ethernet_ip", b"$ made by hand\n[File]\nDescText = \"device\";\n[Device]\nVendCode = 1;\n"),
        ("binary", b"\x7FELF\x02\x01\x01\0\0\0\0\0\0\0\0\0\x03\0"),
        ("source", b"int main(void)\n{\n    return 0;\n}\n"),
    ];
    let mut all = String::new();
    for (name, bytes) in cases {
        let output = edskit_with_input(&["lint", "-", "--format", "concise", "--quiet"], bytes);
        assert_eq!(output.stdout.lines().count(), 1, "{name}: {}", output.stdout);
        all.push_str(&format!("{name}: {}", output.stdout));
    }
    insta::assert_snapshot!("foreign_files", all);
}

#[test]
fn other_commands_refuse_such_files_too() {
    let folder = Folder::new("foreign");
    let zip = folder.write("a.eds", b"PK\x03\x04");
    let cpj = folder.write("a.cpj", "[Topology]\nNodes=0\n");
    insta::assert_snapshot!("show_zip", folder.clean(&edskit(&["show", &zip])));
    insta::assert_snapshot!("show_nodelist", folder.clean(&edskit(&["show", &cpj])));
    insta::assert_snapshot!("fmt_zip", folder.clean(&edskit(&["fmt", &zip])));
    assert_eq!(folder.read("a.eds"), b"PK\x03\x04");
}

#[test]
fn paths_that_lead_nowhere() {
    let folder = Folder::new("nowhere");
    let file = folder.write("a.eds", "[FileInfo]\n");
    for (name, arguments) in [
        ("lint_empty_folder", vec!["lint", "snapshots-that-do-not-exist"]),
        ("show_missing", vec!["show", "missing.eds"]),
        ("show_folder", vec!["show", folder.path()]),
        ("fmt_missing", vec!["fmt", "missing.eds"]),
        ("output_into_nothing", vec!["lint", &file, "--output", "no/such/folder/report.json"]),
        ("show_missing_object", vec!["show", &file, "1000"]),
        ("show_missing_sub_index", vec!["show", "../eds/CANopenGateway.eds", "1018:9"]),
    ] {
        let output = edskit(&arguments);
        assert_eq!(output.exit, Exit::Failed, "{name}");
        insta::assert_snapshot!(format!("nowhere_{name}"), folder.clean(&output));
    }
    let empty = Folder::new("without-files");
    empty.write("readme.txt", "nothing here");
    insta::assert_snapshot!("nowhere_folder_without_files", empty.clean(&edskit(&["lint", empty.path()])));
}

#[test]
fn control_characters_do_not_reach_the_terminal() {
    let text = b"[FileInfo]\nFileName=\x1b[31mred\x1b]0;title\x07\x00\n[1000]\n[1000]\nParameterName=\xE2\x80\xAEabc\n";
    for format in ["human", "concise", "github"] {
        let output = edskit_with_input(&["lint", "-", "--format", format, "--select", "ALL"], text);
        let bad = |c: char| c.is_control() && c != '\n';
        assert_eq!(output.stdout.chars().find(|&c| bad(c)), None, "{format}: {}", output.stdout);
    }
}
