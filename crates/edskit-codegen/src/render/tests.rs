use super::*;
use crate::{generate, parse};
use edskit_lint::{Linter, RuleSet};

const EDS: &str = include_str!("../../../../tests/fixtures/generated/Pump.eds");

/// The side-file in the documentation.
fn side_file() -> &'static str {
    let page = include_str!("../../../../docs/generating.md");
    let (_, block) = page.split_once("```toml\n# Pump.toml\n").unwrap();
    block.split_once("```").unwrap().0
}

#[test]
fn a_small_device() {
    let linter = Linter::new(RuleSet::default());
    let generated =
        generate(EDS.as_bytes(), Some(side_file()), &Naming::of("eds/Pump.eds"), &linter).unwrap();
    assert_eq!(generated.warnings, []);
    insta::assert_snapshot!(generated.code);
}

#[test]
fn the_same_input_gives_the_same_bytes() {
    let code = || render(&parse(EDS.as_bytes(), Some(side_file())).unwrap(), &Naming::of("Pump.eds"));
    assert_eq!(code(), code());
}

#[test]
fn names_stay_in_comments() {
    let eds = "[2000]\nParameterName=*/ pub fn a() {} \" \\ `x` [y] r#\"\nDataType=5\nAccessType=rw\n[DeviceComissioning]\n";
    let code = render(&parse(eds.as_bytes(), None).unwrap(), &Naming::of("a\"{b}.eds"));
    assert!(code.contains("// */ pub fn a() {} \" \\ `x` [y] r#\"\n"), "{code}");
    assert!(code.contains("/// `*/ pub fn a() {} \" \\ 'x' [y] r#\"`: `[2000]`, UNSIGNED8, rw.\n"), "{code}");
    assert!(code.contains("pub const PUB_FN_A_X_Y_R: Handle<u8> = Handle::new(Position(0));"), "{code}");
    assert!(code.contains("pub mod a_b {"), "{code}");
}

#[test]
fn an_empty_dictionary_is_rendered_too() {
    let code = render(&parse(b"", None).unwrap(), &Naming::of(".eds"));
    assert!(
        code.contains("pub mod eds {") && code.contains("static ENTRIES: [Entry; 0] = [\n    ];"),
        "{code}"
    );
}

#[test]
fn names_of_files_follow_the_path() {
    for (path, module, side_file) in [
        ("Device.eds", "device", "Device.toml"),
        ("a.b/c", "c", "a.b/c.toml"),
        ("eds/Drive.v2.dcf", "drive_v2", "eds/Drive.v2.toml"),
        ("a\\B.EDS", "b", "a\\B.toml"),
    ] {
        let naming = Naming::of(path);
        assert_eq!((&*naming.module, &*naming.side_file), (module, side_file));
    }
}
