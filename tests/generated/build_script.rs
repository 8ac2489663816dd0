//! A device's package with a build script, as its author has it.

use crate::compiler::{Packages, dependency};

/// What the page does not show.
const MORE: &str = r#"//! A device that looks at its dictionary.
#![deny(warnings)]

use edskit_runtime::types::{Index, SubIndex};
use edskit_runtime::{Dictionary as _, Handle, Instant, NoApplication, NoStorage, Node, Reset, Settings, WriteError};

edskit_runtime::include_dictionary!("Pump");

const DICTIONARY: pump::Dictionary = pump::Dictionary::new();

fn main() {
    let mut dictionary = DICTIONARY;
    let mut objects = dictionary.parts().objects;
    objects.set(pump::objects::SET_SPEED, -1200);
    assert_eq!(objects.get(pump::objects::SET_SPEED), -1200_i16);
    assert_eq!(objects.text(pump::objects::MANUFACTURER_DEVICE_NAME), Ok("Pump"));
    assert_eq!(objects.set_text(pump::objects::LOCATION, "Hall 4"), Ok(()));
    assert_eq!(objects.set_text(pump::objects::LOCATION, "Hall 4, behind the door"), Err(WriteError::Length));
    assert_eq!(objects.text(pump::objects::LOCATION), Ok("Hall 4"));
    for (step, handle) in (1..).zip(pump::objects::STEPS) {
        objects.set(handle, step);
    }
    assert_eq!(objects.value(Index(0x2009), 3), Some(3_u8));
    let mut node = Node::new(pump::Dictionary::new(), Settings::default(), NoStorage);
    let serial_number = pump::objects::IDENTITY_OBJECT_SERIAL_NUMBER;
    node.objects().set(serial_number, 4711);
    node.poll(Instant(0), &mut NoApplication);
    node.reset(Instant(0), Reset::Node, &mut NoApplication);
    assert_eq!(node.objects().get(serial_number), 4711, "it is given");
    let emcy: Handle<u32> = pump::objects::COB_ID_EMCY;
    assert_eq!(node.objects().get(emcy), 0x81);
    assert!(pump::TABLE.find(Index(0x2001), SubIndex(4)).is_ok());
    assert_eq!(node.transmit().map(|frame| frame.data().to_vec()), Some(vec![0]), "the boot-up message");
    println!("works");
}
"#;

fn eds() -> String {
    let path = edskit_tests::root().join("tests/fixtures/generated/Pump.eds");
    String::from_utf8(edskit_tests::read(&path)).expect("the file is UTF-8")
}

/// The block of `docs/generating.md` that begins with this line.
fn block(first: &str) -> String {
    let page = edskit_tests::read(&edskit_tests::root().join("docs/generating.md"));
    let page = String::from_utf8(page).expect("the page is UTF-8");
    let start = page.find(&format!("\n{first}\n")).expect("the page has the block") + 1;
    page[start..].split("```").next().unwrap_or_default().to_owned()
}

#[test]
fn the_device_of_the_page_is_built_and_runs() {
    let (build, main, side_file) = (block("// build.rs"), block("// src/main.rs"), block("# Pump.toml"));
    let mut packages = Packages::new("build-script");
    packages.add(
        "pump",
        &format!("{}\n[build-dependencies]\n{}", dependency("edskit-host"), dependency("edskit-codegen")),
        &[
            ("build.rs", &build),
            ("src/main.rs", &main),
            ("src/bin/more.rs", MORE),
            ("eds/Pump.eds", &eds()),
            ("eds/Pump.toml", &side_file),
        ],
    );
    let heard = "0 ms: 701 [00]\n1000 ms: 701 [7F]\n2000 ms: 701 [7F]\n";
    for (program, printed) in [("pump", heard), ("more", "works\n")] {
        let output = packages.cargo(&["run", "--quiet", "--bin", program]);
        assert!(output.status.success(), "{}", packages.clean(&output));
        assert_eq!(String::from_utf8_lossy(&output.stdout), printed);
        assert_eq!(packages.clean(&output), "", "no warning");
    }

    packages.write("pump/eds/Pump.toml", &side_file.replace("\"1017\" =", "\"1019\" ="));
    let output = packages.cargo(&["clippy"]);
    assert!(output.status.success(), "{}", packages.clean(&output));
    let warning = "warning: pump@0.0.0: eds/Pump.toml:26:1: GEN the dictionary has no such entry";
    assert!(packages.clean(&output).contains(warning), "{}", packages.clean(&output));

    let eds = eds().replace("0x20020020", "0x20030020").replace("DataType=0x0018", "DataType=0x0999");
    packages.write("pump/eds/Pump.eds", &eds);
    let output = packages.cargo(&["check"]);
    assert!(!output.status.success());
    let printed = packages.clean(&output);
    let errors: Vec<&str> = printed.lines().filter(|line| line.starts_with("error")).collect();
    insta::assert_snapshot!(errors.join("\n"));
}
