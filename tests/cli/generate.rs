//! `edskit generate`. What it generates is judged by the tests of the generator.

use edskit_codegen::{Naming, generate};
use edskit_lint::{Linter, RuleSet};
use edskit_tests::{Folder, edskit};
use std::fs;

const PUMP: &str = "fixtures/generated/Pump.eds";

#[test]
fn the_same_as_in_a_build_script() {
    let folder = Folder::new("generate");
    let output = format!("{}/new/folder", folder.path());
    insta::assert_snapshot!("generate_written", folder.clean(&edskit(&["generate", PUMP, "-o", &output])));
    insta::assert_snapshot!("generate_unchanged", folder.clean(&edskit(&["generate", PUMP, "-o", &output])));
    let eds = fs::read(PUMP).unwrap();
    let expected = generate(&eds, None, &Naming::of(PUMP), &Linter::new(RuleSet::default())).unwrap();
    assert!(folder.read("new/folder/Pump.rs") == expected.code.as_bytes());
}

#[test]
fn names_and_side_files() {
    let folder = Folder::new("generate-named");
    let side_file = folder.write("units.toml", "[unit]\n'1017' = 'ms'\n");
    let arguments =
        ["generate", PUMP, "--output", folder.path(), "--name", "MainPump", "--side-file", &side_file];
    let output = edskit(&[&arguments[..], &["--runtime", "crate::runtime"]].concat());
    insta::assert_snapshot!("generate_named", folder.clean(&output));
    let code = String::from_utf8(folder.read("MainPump.rs")).unwrap();
    assert!(
        code.contains("pub mod main_pump") && code.contains("crate::runtime") && code.contains("in `ms`"),
        "{code}"
    );
}

#[test]
fn what_cannot_be_generated() {
    let folder = Folder::new("generate-not");
    let eds = folder.write("Pump.eds", fs::read(PUMP).unwrap());
    folder.write("Pump.toml", "[unit]\n'1O17' = 'ms'\n");
    let blocked = folder.write("file", "in the way");
    let cases: [(&str, &[&str]); 6] = [
        ("errors", &["fixtures/faulty.eds", "-o", folder.path()]),
        ("missing", &["nowhere.eds", "-o", folder.path()]),
        ("no_folder", &[PUMP]),
        ("bad_side_file", &[&eds, "-o", folder.path()]),
        ("missing_side_file", &[PUMP, "-o", folder.path(), "--side-file", "nowhere.toml"]),
        ("blocked", &[PUMP, "-o", &blocked]),
    ];
    for (name, arguments) in cases {
        let output = edskit(&[&["generate"], arguments].concat());
        insta::assert_snapshot!(format!("generate_{name}"), folder.clean(&output));
    }
}

#[test]
fn the_settings_of_lint_hold() {
    let folder = Folder::new("generate-settings");
    let text = "[2000]\nParameterName=x\nObjectType=7\nDataType=5\nAccessType=rw\nDefaultValue=300\n[DeviceComissioning]\n";
    let eds = folder.write("x.eds", text);
    let output = || edskit(&["generate", &eds, "-o", folder.path()]);
    let refused = output();
    assert!(refused.stderr.contains(":6:14: VAL002 "), "{}", refused.all());
    folder.write("edskit.toml", "[severity]\nVAL002 = 'warning'\n");
    let accepted = output().stderr;
    assert!(
        accepted.contains("warning: ")
            && accepted.contains(":6:14: VAL002 ")
            && !accepted.contains("error: "),
        "{accepted}"
    );
    folder.write("edskit.toml", "ignore = ['VAL002']\n");
    assert!(output().stderr.contains(":6:14: GEN `300` is left out: 300 is outside the data type"));
    folder.write("edskit.toml", "");
    folder.write("x.eds", text.replace("[2000]", ";edskit: allow(VAL002) as delivered\n[2000]"));
    assert!(!output().stderr.contains("error: "));
}
