//! Profiles of one's own.

use edskit::Exit;
use edskit_tests::{Folder, edskit};
use std::fs;

const FILE: &str = "[1000]\nDataType=7\nDefaultValue=0\n[2100]\nDataType=6\n";
const PROFILE: &str = "name = 'Ours'\nobject = [{ index = 0x2100, name = 'speed', type = 'UNSIGNED8' }]\n";

/// The text of the first fence of a language.
fn fence<'a>(page: &'a str, language: &str) -> &'a str {
    let (_, rest) = page.split_once(&format!("\n```{language}\n")).expect("the page has the fence");
    rest.split_once("```\n").expect("the fence has an end").0
}

#[test]
fn the_example_of_the_page_is_true() {
    let page = fs::read_to_string(edskit_tests::root().join("docs/profiles.md")).unwrap();
    let folder = Folder::new("profile-page");
    let profile = folder.write("company.toml", fence(&page, "toml"));
    let file = folder.write("pump.eds", fence(&page, "eds"));
    let output = edskit(&[
        "lint",
        "--profile",
        &profile,
        "--select",
        "COM,PRF",
        "--format",
        "concise",
        "--quiet",
        &file,
    ]);
    let shown = output.stdout.replace(&file, "pump.eds");
    assert_eq!(shown, fence(&page, "text"));
    assert_eq!((output.exit, output.stderr.as_str()), (Exit::Findings, ""));
}

#[test]
fn settings_name_profiles_relative_to_their_own_folder() {
    let folder = Folder::new("profile-settings");
    folder.write("edskit.toml", "select = [\"COM002\"]\nprofiles = [\"rules/ours.toml\"]\n");
    folder.write("rules/ours.toml", PROFILE);
    folder.write("deep/a.eds", FILE);
    let lint = |arguments: &[&str]| {
        let output =
            edskit(&[&["lint", "--format", "concise", "--quiet", folder.path()], arguments].concat());
        output.stdout.lines().count()
    };
    assert_eq!(lint(&[]), 1);
    assert_eq!(lint(&["--isolated", "--select", "COM002"]), 0);
    let other = folder.write("other.toml", PROFILE.replace("UNSIGNED8", "UNSIGNED16"));
    assert_eq!(lint(&["--isolated", "--select", "COM002", "--profile", &other]), 0);
    assert_eq!(lint(&["--profile", &other]), 1);
}

#[test]
fn mistakes_have_a_place() {
    let folder = Folder::new("profile-mistakes");
    folder.write("a.eds", FILE);
    let profile = folder.write("ours.toml", PROFILE.replace("UNSIGNED8", "UNSIGNED9"));
    let output = edskit(&["lint", folder.path(), "--profile", &profile]);
    insta::assert_snapshot!("profile_unknown_type", folder.clean(&output));
    let output = edskit(&["lint", folder.path(), "--profile", "missing.toml"]);
    insta::assert_snapshot!("profile_missing", folder.clean(&output));
    folder.write("edskit.toml", "\nprofiles = [\"ours.toml\"]\n");
    insta::assert_snapshot!("profile_wrong_in_settings", folder.clean(&edskit(&["lint", folder.path()])));
    folder.write("edskit.toml", "profiles = [\"none.toml\"]\n");
    insta::assert_snapshot!("profile_missing_in_settings", folder.clean(&edskit(&["lint", folder.path()])));
    folder.write("edskit.toml", "[[override]]\nfiles = [\"a\"]\nprofiles = [\"ours.toml\"]\n");
    insta::assert_snapshot!("profile_in_override", folder.clean(&edskit(&["lint", folder.path()])));
}
