//! `edskit config dcf`: the data sheet of the gateway with what the parameters make of it.

use edskit::Exit;
use edskit_model::Datasheet;
use edskit_tests::{Folder, Output, edskit, edskit_with_input};
use edskit_types::{Index, NodeId, SubIndex};
use std::fmt::Write;

const DEVICE: &str = "device = \"heinzmann-canopen-gateway\"\n";

/// `edskit config dcf` of a text.
fn dcf_of(parameters: &str) -> Output {
    edskit_with_input(&["config", "dcf", "-"], format!("{DEVICE}{parameters}").as_bytes())
}

fn last_line(output: &Output) -> &str {
    output.stderr.lines().next_back().unwrap_or_default()
}

/// The fixtures whose parameters the gateway accepts, each with its DCF.
fn accepted() -> Vec<(String, Datasheet)> {
    let folder = edskit_tests::root().join("tests/fixtures/gateway");
    let mut found = Vec::new();
    for path in edskit_tests::paths(&folder) {
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let output = edskit(&["config", "dcf", &format!("fixtures/gateway/{name}.toml")]);
        if output.exit == Exit::Clean {
            found.push((name, Datasheet::parse(output.stdout.as_bytes())));
        } else {
            assert_eq!(output.stdout, "", "{name}: there is no DCF of what is refused");
        }
    }
    found
}

/// What the DCF says that an entry holds.
fn value(sheet: &Datasheet, index: u16, sub_index: u8) -> i128 {
    let number = || {
        let entry = sheet.sub_object(Index(index), SubIndex(sub_index))?.description();
        let node_id = sheet.commissioning()?.node_id()?.known()?;
        let value = entry.default_value()?.known()?;
        value.integer(entry.standard_type()?, NodeId::new(node_id).ok()).ok()
    };
    number().unwrap_or_else(|| panic!("{index:04X}h:{sub_index:02X} has no value"))
}

/// The sub-indices behind 00h.
fn entries(sheet: &Datasheet, index: u16) -> Vec<u8> {
    let object = sheet.object(Index(index)).expect("every object of the data sheet exists");
    object.sub_objects().map(|entry| entry.sub_index().0).filter(|sub_index| *sub_index > 0).collect()
}

#[test]
fn what_the_dcf_says() {
    let output = edskit(&["config", "dcf", "fixtures/gateway/conformance.toml"]);
    let sheet = Datasheet::parse(output.stdout.as_bytes());
    let mut text = String::new();
    for section in sheet.sections().take_while(|section| section.name() != "DummyUsage") {
        writeln!(text, "[{}]", section.name()).unwrap();
        section.entries().for_each(|entry| writeln!(text, "{entry:?}").unwrap());
    }
    for object in sheet.objects() {
        write!(text, "{}", object.index()).unwrap();
        for description in
            [object.description()].into_iter().chain(object.sub_objects().map(|entry| entry.description()))
        {
            let value = description.default_value().map(|value| value.text().into_owned());
            let number = description.sub_number().map(|number| format!("{} entries:", number.text()));
            let content = description.denotation().map(|denotation| format!("({})", denotation.text()));
            let shown = number.or(value).or(content);
            write!(text, " {}", shown.unwrap_or_else(|| "?".to_owned())).unwrap();
        }
        text.push('\n');
    }
    insta::assert_snapshot!(text);
}

/// GW-EDS-16, GW-GAP-01: the entries are those that exist, and the counts count them.
#[test]
fn mappings_and_data_agree_in_every_dcf() {
    let accepted = accepted();
    assert!(accepted.len() > 5, "the fixtures have parameters that are accepted");
    for (name, sheet) in accepted {
        let mappings = (0x1600..=0x1603).chain(0x1A00..=0x1A0F);
        for index in mappings.clone().chain(0x2000..=0x2004) {
            let entries = entries(&sheet, index);
            let highest = entries.last().copied().unwrap_or_default();
            assert_eq!(value(&sheet, index, 0), highest.into(), "{name}: {index:04X}h");
            let object = sheet.object(Index(index)).unwrap().description();
            let number = object.sub_number().unwrap().known();
            assert_eq!(number, Some(entries.len() as u8 + 1), "{name}: {index:04X}h");
        }
        for index in mappings {
            for sub_index in entries(&sheet, index) {
                let mapped = value(&sheet, index, sub_index) as u32;
                let (object, entry) = (Index((mapped >> 16) as u16), SubIndex((mapped >> 8) as u8));
                let is_described = object < Index(0x20) || sheet.sub_object(object, entry).is_some();
                assert!(is_described, "{name}: {index:04X}h:{sub_index:02X} maps {object}:{entry}");
            }
        }
    }
}

/// What the linter finds is what the parameters ask for.
#[test]
fn what_the_linter_says_of_every_dcf() {
    let mut text = String::new();
    for (name, sheet) in accepted() {
        let folder = Folder::new(&format!("dcf-{name}"));
        let path = folder.write(&format!("{name}.dcf"), sheet.document().to_bytes());
        let output = edskit(&["lint", "--format", "concise", &path]);
        let findings = output.stdout.lines().filter_map(|line| line.strip_prefix(folder.path()));
        findings.for_each(|line| writeln!(text, "{line}").unwrap());
        assert_eq!(edskit(&["fmt", "--check", &path]).exit, Exit::Clean, "{name}");
    }
    insta::assert_snapshot!(text);
}

/// GW-CFG-14, GW-OD-08: the identifiers of the manual's example; bit 31 where a PDO is inactive.
#[test]
fn identifiers_are_those_of_the_parameters() {
    let output = edskit(&["config", "dcf", "fixtures/gateway/node-1.toml"]);
    let sheet = Datasheet::parse(output.stdout.as_bytes());
    let cob_ids = [0x1804, 0x1807, 0x180B, 0x180F, 0x1802].map(|index| value(&sheet, index, 1));
    assert_eq!(cob_ids, [0x282, 0x382, 0x003, 0x57F, 0x8000_0381]);
    let defaults = Datasheet::parse(dcf_of("").stdout.as_bytes());
    assert_eq!(value(&defaults, 0x1804, 1), 0x8000_0001);
}

#[test]
fn a_file_has_its_own_name_and_that_of_the_data_sheet() {
    let folder = Folder::new("dcf-names");
    let parameters = folder.write("line-3.toml", format!("{DEVICE}[gateway]\nCanOpenMyNodeID = 3\n"));
    let path = format!("{}/governor.dcf", folder.path());
    let output = edskit(&["config", "dcf", &parameters, "--output", &path]);
    assert_eq!((output.exit, output.stdout.as_str(), output.stderr.as_str()), (Exit::Clean, "", ""));
    let written = String::from_utf8(folder.read("governor.dcf")).unwrap();
    assert!(written.starts_with("[FileInfo]\r\nFileName=governor.dcf\r\n"), "{written}");
    let printed = edskit(&["config", "dcf", &parameters]).stdout;
    assert_eq!(printed, written.replace("governor.dcf", "line-3.dcf"));
    assert!(dcf_of("").stdout.contains("FileName=gateway.dcf\r\n"));
    for text in [&printed, &written] {
        assert!(text.contains("LastEDS=CANopenGateway.eds\r\n"));
    }
}

#[test]
fn what_cannot_be_described() {
    // GW-CFG-18: the gateway never boots with such parameters.
    insta::assert_snapshot!("refused", edskit(&["config", "dcf", "fixtures/gateway/node-2.toml"]).all());
    // GW-CFG-33: the two units have different numbers.
    insta::assert_snapshot!("apart", last_line(&edskit(&["config", "dcf", "fixtures/gateway/units.toml"])));
    insta::assert_snapshot!(
        "not_understood",
        edskit(&["config", "dcf", "fixtures/gateway/not-a-number.toml"]).all()
    );
    insta::assert_snapshot!("not_found", edskit(&["config", "dcf", "no-such-file.toml"]).all());
    let output = edskit(&["config", "dcf", "fixtures/gateway/manual.toml", "-o", "no-such-folder/a.dcf"]);
    insta::assert_snapshot!("not_written", output.all());
}
