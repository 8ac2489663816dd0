//! A device's package with a build script, as its author has it.

use crate::compiler::{Packages, dependency, stderr};

const BUILD: &str =
    "//! Generates the dictionary.\nfn main() {\n    edskit_codegen::compile(\"eds/Pump.eds\");\n}\n";

const MAIN: &str = r#"//! A device.
#![deny(warnings)]

use edskit_runtime::types::{Index, SubIndex};
use edskit_runtime::{Dictionary as _, Handle, Instant, NoApplication, NoStorage, Node, Settings};

edskit_runtime::include_dictionary!("Pump");

const DICTIONARY: pump::Dictionary = pump::Dictionary::new();

fn main() {
    let mut dictionary = DICTIONARY;
    let mut objects = dictionary.parts().objects;
    objects.set(pump::objects::SET_SPEED, -1200);
    assert_eq!(objects.get(pump::objects::SET_SPEED), -1200_i16);
    assert_eq!(objects.bytes(pump::objects::MANUFACTURER_DEVICE_NAME), b"Pump");
    let mut node = Node::new(pump::Dictionary::new(), Settings::default(), NoStorage);
    node.poll(Instant(0), &mut NoApplication);
    let emcy: Handle<u32> = pump::objects::COB_ID_EMCY;
    assert_eq!(node.objects().get(emcy), 0x81);
    assert!(pump::TABLE.find(Index(0x2001), SubIndex(4)).is_ok());
    assert_eq!(node.transmit().map(|frame| frame.data().to_vec()), Some(vec![0]), "the boot-up message");
    println!("works");
}
"#;

fn fixture(name: &str) -> String {
    let path = edskit_tests::root().join("tests/fixtures/generated").join(name);
    String::from_utf8(edskit_tests::read(&path)).expect("the file is UTF-8")
}

fn add(packages: &mut Packages, name: &str, eds: &str, side_file: &str) {
    let files =
        [("build.rs", BUILD), ("src/main.rs", MAIN), ("eds/Pump.eds", eds), ("eds/Pump.toml", side_file)];
    packages.add(name, &format!("\n[build-dependencies]\n{}", dependency("edskit-codegen")), &files);
}

#[test]
fn a_device_is_built_and_runs() {
    let mut packages = Packages::new("build-script");
    add(&mut packages, "pump", &fixture("Pump.eds"), &fixture("Pump.toml"));
    let output = packages.cargo(&["run", "--quiet", "-p", "pump"]);
    assert!(output.status.success(), "{}", stderr(&output));
    assert_eq!(String::from_utf8_lossy(&output.stdout), "works\n");
    assert_eq!(stderr(&output), "", "no warning");

    let side_file = fixture("Pump.toml").replace("\"1017\" =", "\"1019\" =");
    packages.write("pump/eds/Pump.toml", &side_file);
    let output = packages.cargo(&["check", "-p", "pump"]);
    assert!(output.status.success());
    let warning = "warning: pump@0.0.0: eds/Pump.toml:15:1: GEN the dictionary has no such entry";
    assert!(packages.clean(&output).contains(warning), "{}", packages.clean(&output));

    let eds =
        fixture("Pump.eds").replace("0x20020020", "0x20030020").replace("DataType=0x0018", "DataType=0x0999");
    packages.write("pump/eds/Pump.eds", &eds);
    let output = packages.cargo(&["check", "-p", "pump"]);
    assert!(!output.status.success());
    insta::assert_snapshot!(packages.clean(&output));
}
