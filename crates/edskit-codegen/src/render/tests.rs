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
    assert!(
        code.contains(
            "pub const PUB_FN_A_X_Y_R: Handle<u8> = Handle::new(Position(0), Key::new(0x2000, 0x00));"
        ),
        "{code}"
    );
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

/// An entry of a device, as `[2000]`.
fn section(name: &str, parameter_name: &str, keys: &str) -> String {
    format!("[{name}]\nParameterName={parameter_name}\n{}\n", keys.replace(' ', "\n"))
}

/// The code of a configured device, and what is told of it.
fn generated(eds: &str, side_file: &str) -> (String, String) {
    let eds = format!("{eds}[DeviceComissioning]\n");
    let linter = Linter::new(RuleSet::none());
    let generated = generate(eds.as_bytes(), Some(side_file), &Naming::of("a.eds"), &linter).unwrap();
    let told: Vec<_> =
        generated.warnings.iter().map(|told| told.line("a.eds", "a.toml").to_string()).collect();
    (generated.code, told.join("\n"))
}

#[test]
fn an_array_of_one_type_is_an_array_of_handles() {
    let element = |number: u8, keys: &str| {
        section(&format!("2003sub{number}"), &format!("Torque {number}"), &format!("AccessType=rw {keys}"))
    };
    let array = |object_type: &str, last: &str| {
        let eds = section("2003", "Torques", &format!("ObjectType={object_type}"))
            + &section("2003sub0", "n", "DataType=5 AccessType=ro DefaultValue=3")
            + &element(1, "DataType=6")
            + &element(2, "DataType=6")
            + last;
        generated(&eds, "").0
    };
    let torques = |count| {
        format!(
            "pub const TORQUES: [Handle<u16>; {count}] = Handle::run(Position(1), Key::new(0x2003, 0x01));"
        )
    };
    let whole = array("8", &element(3, "DataType=6"));
    assert!(whole.contains(&torques(3)) && whole.contains("pub const TORQUES_TORQUE_2: Key"), "{whole}");
    assert!(!whole.contains("TORQUES_TORQUE_2: Handle"), "{whole}");
    assert!(array("8", "").contains(&torques(2)));
    let constant = element(3, "DataType=6").replace("rw", "const");
    for (object_type, last) in [
        ("9", element(3, "DataType=6")),
        ("8", element(3, "DataType=5")),
        ("8", element(4, "DataType=6")),
        ("8", constant),
    ] {
        let code = array(object_type, &last);
        assert!(
            !code.contains("const TORQUES: [") && code.contains("pub const TORQUES_TORQUE_2: Handle<u16>"),
            "{code}"
        );
    }
}

#[test]
fn what_the_side_file_adds_together_is_an_array() {
    let eds = section("2003", "Channels", "ObjectType=9")
        + &section("2003sub0", "n", "DataType=5 AccessType=ro DefaultValue=1")
        + &section("2003sub1", "Mode", "DataType=5 AccessType=rw");
    let extra = |entries: &str| {
        format!("[[extra]]\nentries = '{entries}'\nname = 'Level'\ndata-type = 'INTEGER16'\naccess = 'ro'\n")
    };
    let (code, told) = generated(&eds, &extra("2003sub2-4"));
    let levels =
        "pub const CHANNELS_LEVEL: [Handle<i16>; 3] = Handle::run(Position(2), Key::new(0x2003, 0x02));";
    assert!(code.contains(levels) && code.contains("pub const CHANNELS_MODE: Handle<u8>"), "{code}");
    assert_eq!(told, "");
    let one = generated(&eds, &extra("2003sub2")).0;
    assert!(one.contains("pub const CHANNELS_LEVEL: Handle<i16>"), "{one}");
}

#[test]
fn names_of_the_side_file_are_used() {
    let eds = section("2000", "Geschwindigkeit", "DataType=6 AccessType=rw")
        + &section("2001", "Druck", "ObjectType=8")
        + &section("2001sub0", "n", "DataType=5 AccessType=ro DefaultValue=2")
        + &section("2001sub1", "Druck 1", "DataType=4 AccessType=ro")
        + &section("2001sub2", "Druck 2", "DataType=4 AccessType=ro");
    let code = |names: &str| generated(&eds, &format!("[names]\n{names}")).0;
    let array = code("'2000' = 'SPEED'\n'2001' = 'PRESSURE'\n");
    for part in
        ["SPEED: Handle<u16>", "PRESSURE: [Handle<i32>; 2]", "PRESSURE_N: Constant<u8>", "PRESSURE_2: Key"]
    {
        assert!(array.contains(&format!("pub const {part}")), "{array}");
    }
    let single = code("'2001sub1' = 'INLET'\n");
    assert!(
        single.contains("pub const INLET: Handle<i32>") && single.contains("DRUCK_2: Handle<i32>"),
        "{single}"
    );
}

#[test]
fn names_that_are_not_those_of_the_eds_are_told() {
    let pdo = |index: u16| {
        section(&format!("{index:X}"), "TPDO", "ObjectType=9")
            + &section(&format!("{index:X}sub0"), "n", "DataType=5 AccessType=ro DefaultValue=2")
            + &section(
                &format!("{index:X}sub1"),
                "COB-ID",
                "DataType=7 AccessType=rw DefaultValue=0x80000000",
            )
    };
    let long = "Number of mapped application objects in the process data object";
    let eds = pdo(0x1800)
        + &pdo(0x1801)
        + &section("2000", "Speed", "DataType=6 AccessType=rw")
        + &section("2001", "Speed", "DataType=6 AccessType=rw")
        + &section("2002", long, "DataType=6 AccessType=rw")
        + &section("2003", "\u{901F}\u{5EA6}", "DataType=6 AccessType=rw")
        + &section("2004", "Gr\u{f6}\u{df}e", "DataType=6 AccessType=rw");
    let (code, told) = generated(&eds, "");
    insta::assert_snapshot!(told);
    assert!(
        code.contains("pub const SPEED: Handle<u16>") && code.contains("pub const GROESSE: Handle"),
        "{code}"
    );
    let names = "[names]\n'1801' = 'SECOND'\n'2001' = 'TARGET'\n'2002' = 'MAPPED'\n'2003' = 'VELOCITY'\n";
    assert_eq!(generated(&eds, names).1, "");

    let many: String =
        (0..9).map(|place| section(&format!("200{place}"), "Speed", "DataType=6 AccessType=rw")).collect();
    let told = generated(&many, "").1;
    assert_eq!(told.lines().count(), 5);
    assert!(told.contains("becomes `SPEED_2005`; and so it is with 3 more ("), "{told}");
}

#[test]
fn the_code_does_not_depend_on_where_the_file_lies() {
    let code = |path: &str| {
        let linter = Linter::new(RuleSet::default());
        generate(EDS.as_bytes(), Some(side_file()), &Naming::of(path), &linter).unwrap().code
    };
    let there = code("/home/somebody/pumps/Pump.eds");
    assert_eq!(there, code("eds/Pump.eds"));
    assert_eq!(there, code("C:\\pumps\\Pump.eds"));
}
