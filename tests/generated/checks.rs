//! The generated code itself refuses a mapping that cannot be.

use crate::compiler::{Packages, stderr};
use edskit_codegen::{Naming, parse, render};
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;

/// A mapping parameter with these entries, and something to map.
fn eds(entries: &[&str]) -> String {
    let mut eds = format!(
        "[1A00]\nObjectType=9\n[1A00sub0]\nDataType=5\nAccessType=rw\nDefaultValue={}\n\
         [2000]\nDataType=6\nAccessType=ro\nPDOMapping=1\n[2001]\nDataType=6\nAccessType=wo\nPDOMapping=1\n\
         [2002]\nDataType=0x1B\nAccessType=ro\nPDOMapping=1\n[2003]\nDataType=6\nAccessType=ro\n\
         [2004]\nDataType=9\nAccessType=ro\nPDOMapping=1\nDefaultValue=abcd\n\
         [2005]\nDataType=1\nAccessType=ro\nPDOMapping=1\n",
        entries.len()
    );
    for (number, entry) in entries.iter().enumerate() {
        let section = format!("[1A00sub{:X}]\nDataType=7\nAccessType=rw\nDefaultValue={entry}\n", number + 1);
        eds.push_str(&section);
    }
    eds
}

fn code(eds: &str, path: &str) -> String {
    render(&parse(eds.as_bytes(), None).expect("the EDS can be laid out"), &Naming::of(path))
}

/// The places that the compiler complains about: `a.eds:12:3`.
pub(crate) fn complaints(compiler: &str) -> BTreeSet<String> {
    let lines = compiler.lines().filter_map(|line| line.split_once("evaluation panicked: "));
    lines.map(|(_, message)| message.split(": ").next().unwrap_or_default().to_owned()).collect()
}

#[test]
fn a_mapping_that_cannot_be_stops_the_compiler_at_the_place_in_the_eds() {
    let mut packages = Packages::new("checks");
    let good = eds(&["0x20000010", "0x20040020", "0x20050001", "0x20050008"]);
    let many_pdos = "[DeviceInfo]\nGranularity=8\nCompactPDO=0x3F\nNrOfRXPDO=512\nNrOfTXPDO=512\n";
    let codes = [code(&good, "good.eds"), code("", "empty.eds"), code(many_pdos, "many_pdos.eds")];
    packages.add_library("good", codes.iter().map(String::as_str));
    packages.all("clippy");

    let bad = eds(&[
        "0x20000008",
        "0x20010010",
        "0x20030010",
        "0x20060010",
        "0x00060010",
        "0x20040028",
        "0x20020040",
    ]);
    let code = code(&bad, "eds/bad {device}.eds");
    packages.add_library("bad", [code.as_str()]);
    let output = packages.cargo(&["check", "-p", "bad"]);
    assert!(!output.status.success());
    let lines: BTreeSet<String> =
        [6, 34, 38, 42, 46, 50, 54].iter().map(|line| format!("bad {{device}}.eds:{line}:14")).collect();
    let compiler = stderr(&output);
    assert_eq!(complaints(&compiler), lines, "{compiler}");
    assert!(compiler.contains("TPDO1 cannot carry 2001h sub-index 00h with 16 bits"), "{compiler}");
    assert!(compiler.contains("TPDO1 carries 176 bits, and a PDO has 64"), "{compiler}");
}

#[test]
fn a_generated_file_that_is_checked_in_stays_as_it_is() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("formatted");
    fs::create_dir_all(&folder).expect("the folder can be made");
    let path = folder.join("good.rs");
    let code = code(&eds(&["0x20000010", "0x20040020"]), "good.eds");
    fs::write(&path, code).expect("the file can be written");
    let output = Command::new("rustfmt").args(["--check", "--edition", "2024"]).arg(&path).output();
    let output = output.expect("rustfmt runs");
    assert!(output.status.success(), "{}{}", String::from_utf8_lossy(&output.stdout), stderr(&output));
}
