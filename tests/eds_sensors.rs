//! The data sheets of the Kuebler IN88 inclinometers and of the Gefran KHC pressure transmitter.

use std::collections::{BTreeMap, BTreeSet};

use edskit_model::{Datasheet, SectionKind};

fn file(name: &str) -> String {
    std::fs::read_to_string(edskit_tests::root().join("eds").join(name)).expect("it is shipped")
}

/// The sections of a file by name, each as written, with the comments above it.
fn sections(text: &str) -> BTreeMap<String, String> {
    let block = |block: &str| {
        let name = block
            .lines()
            .find_map(|line| line.strip_prefix('[')?.strip_suffix(']'))
            .expect("each block begins with a header");
        (name.to_owned(), block.to_owned())
    };
    text.trim_end().split("\n\n").map(block).collect()
}

/// What the two variants share stands in both files byte for byte; only the sections named here may differ.
#[test]
fn the_two_inclinometers_share_what_is_not_special_to_one() {
    const SPECIAL: [&str; 23] = [
        "1000",
        "1018sub2",
        "1A00sub0",
        "1A00sub2",
        "1A00sub3",
        "1A01sub0",
        "1A01sub2",
        "1A01sub3",
        "5002",
        "6000",
        "6012",
        "6013",
        "6014",
        "6020",
        "6021",
        "6022",
        "6023",
        "6024",
        "Comments",
        "DeviceInfo",
        "FileInfo",
        "ManufacturerObjects",
        "OptionalObjects",
    ];
    let [one, two] = ["IN88_1D.eds", "IN88_2D.eds"].map(|name| sections(&file(name)));
    let names: BTreeSet<_> = one.keys().chain(two.keys()).collect();
    let differing: Vec<_> = names.into_iter().filter(|name| one.get(*name) != two.get(*name)).collect();
    assert_eq!(differing, SPECIAL);
}

/// The rows of the object table of a ledger by section name; `None`, said aloud, where the ledger is not there.
fn table(ledger: &str, variant: Option<&str>) -> Option<BTreeMap<String, Vec<String>>> {
    let folder = edskit_tests::shared("the comparison of the data sheets with their ledgers")?;
    let text = std::fs::read_to_string(folder.join("ledger").join(ledger)).expect("the ledger is there");
    let mut rows = BTreeMap::new();
    for line in text.lines().filter(|line| line.starts_with("| ")) {
        let cells: Vec<_> =
            line.trim().trim_matches('|').split('|').map(|cell| cell.trim().to_owned()).collect();
        let is_object = cells[0].len() == 4 && u16::from_str_radix(&cells[0], 16).is_ok();
        if !is_object || variant.is_some_and(|variant| cells[11] != "both" && cells[11] != variant) {
            continue;
        }
        let sub_index = u8::from_str_radix(&cells[1], 16).map(|sub_index| format!("sub{sub_index:X}"));
        rows.insert(format!("{}{}", cells[0], sub_index.unwrap_or_default()), cells);
    }
    Some(rows)
}

/// A data type or an object code as a file has it.
fn code(name: &str) -> &'static str {
    match name {
        "VAR" => "0x7",
        "ARRAY" => "0x8",
        "RECORD" => "0x9",
        "INTEGER16" => "0x0003",
        "INTEGER32" => "0x0004",
        "UNSIGNED8" => "0x0005",
        "UNSIGNED16" => "0x0006",
        "UNSIGNED32" => "0x0007",
        "REAL32" => "0x0008",
        "VISIBLE_STRING" => "0x0009",
        other => panic!("{other}"),
    }
}

fn agrees_with_the_table(name: &str, ledger: &str, variant: Option<&str>) {
    let Some(rows) = table(ledger, variant) else { return };
    assert!(rows.len() > 60, "{name}: {} rows", rows.len());
    let text = file(name);
    let sheet = Datasheet::parse(text.as_bytes());
    let described = sections(&text).into_keys().filter(|name| name.as_bytes()[0].is_ascii_digit());
    assert_eq!(described.collect::<BTreeSet<_>>(), rows.keys().cloned().collect(), "{name}");
    for (section, row) in rows {
        let found = sheet.section(SectionKind::of(section.as_bytes())).expect("the section is there");
        let value = |key: &str| {
            let entry = found.entries().find(|entry| entry.key_text() == key);
            entry.map(|entry| entry.text().into_owned())
        };
        let written = |cell: &str| (cell != "none" && !cell.is_empty()).then(|| cell.to_owned());
        let expected = [
            ("ParameterName", written(&row[2])),
            ("ObjectType", Some(code(&row[3]).to_owned())),
            ("DataType", written(&row[4]).map(|name| code(&name).to_owned())),
            ("AccessType", written(&row[5])),
            ("PDOMapping", written(&row[6])),
            ("DefaultValue", written(&row[7])),
            ("LowLimit", written(&row[8])),
            ("HighLimit", written(&row[9])),
        ];
        for (key, expected) in expected {
            assert_eq!(value(key), expected, "{name} [{section}] {key}");
        }
    }
}

// IN-EDS-07
#[test]
fn the_inclinometers_have_the_objects_of_the_ledger() {
    agrees_with_the_table("IN88_1D.eds", "in88.md", Some("1D"));
    agrees_with_the_table("IN88_2D.eds", "in88.md", Some("2D"));
}

// KH-EDS-05
#[test]
fn the_pressure_transmitter_has_the_objects_of_the_ledger() {
    agrees_with_the_table("KHC.eds", "khc.md", None);
}

// IN-EDS-02, IN-EDS-03, IN-EDS-04, IN-EDS-06, KH-EDS-03, KH-EDS-04
#[test]
fn device_information() {
    for (name, ten, granularity, transmit_pdos, maker, product, revision) in [
        ("IN88_1D.eds", 1, 16, 2, "0x00000013", "0", "0x0000006C"),
        ("IN88_2D.eds", 1, 16, 2, "0x00000013", "0x08082721", "0x0000006C"),
        ("KHC.eds", 0, 8, 1, "0x00000093", "0x2043484B", "0x00010001"),
    ] {
        let section = sections(&file(name)).remove("DeviceInfo").expect("every file has it");
        let lines: BTreeSet<_> = section.lines().collect();
        let mut expected: Vec<_> =
            [20, 50, 125, 250, 500, 800, 1000].map(|bit_rate| format!("BaudRate_{bit_rate}=1")).into();
        expected.push(format!("BaudRate_10={ten}"));
        expected.push(format!("Granularity={granularity}"));
        expected.push(format!("NrOfTXPDO={transmit_pdos}"));
        expected.push(format!("VendorNumber={maker}"));
        expected.push(format!("ProductNumber={product}"));
        expected.push(format!("RevisionNumber={revision}"));
        let fixed = ["NrOfRXPDO=0", "LSS_Supported=1", "SimpleBootUpSlave=1", "SimpleBootUpMaster=0"];
        expected.extend(fixed.map(str::to_owned));
        for line in expected {
            assert!(lines.contains(line.as_str()), "{name}: {line}");
        }
    }
}
