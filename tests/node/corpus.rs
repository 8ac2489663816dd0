//! Every real file as a node, by the same steps as `edskit run`.

use crate::line::Line;
use edskit_codegen::{SideFile, lay_out};
use edskit_host::sdo::{SdoClient, SdoError};
use edskit_model::{Datasheet, KeyName};
use edskit_types::{AbortCode, Index, NodeId, SubIndex};

/// Nodes that do not answer with the value that their file has.
struct Special {
    reason: &'static str,
    answer: Result<&'static [u8], AbortCode>,
    files: &'static [&'static str],
}

const SPECIAL: &[Special] = &[
    Special {
        reason: "the file does not describe 1000h, so that it is added with 0",
        answer: Ok(&[0; 4]),
        files: &[
            "033995ad6fa3-challenge.eds",
            "26f48f5999d6-espac-pc0x01ff0000-rev0x00020000.eds",
            "38573627cad1-v2g500v30a.eds",
            "3857d2e2344a-espac-pc0x04ff0000-rev0x00010001.eds",
            "467e7021fb3d-display-pc0x03ff0000-rev0x00010000.eds",
            "87e240cebd0a-all-datatypes.eds",
            "952bc5ca6b78-dummy.eds",
            "a4847834b16a-datatypes.eds",
            "e2b11f966dfb-example1.eds",
            "e330114b3bad-espac-pc0x00000000-rev0x00000000.eds",
            "f1197838b9a3-emsiso.eds",
        ],
    },
    Special {
        reason: "the file describes no object, so that nothing is added",
        answer: Err(AbortCode::OBJECT_DOES_NOT_EXIST),
        files: &["c114dbc92fa2-stm32f767-cia418-reference.eds"],
    },
    Special {
        reason: "the file gives 1000h no value, so it is 0",
        answer: Ok(&[0; 4]),
        files: &[
            "071af8d20ced-test.eds",
            "15501a570b17-node26.eds",
            "23aec5ccadbc-yukondrive-1021-ado-v4-15-31.eds",
            "3fb8b18bffc4-sample.eds",
            "456597fc9ddb-schunk-0-63.dcf",
            "4c3c5d2a0c45-schunk.eds",
            "4f2afa48b683-epos4-70-15.eds",
            "55f1550112e6-schunk.eds",
            "575f31655394-kp-master.dcf",
            "5c2a9c2bd5b1-example.eds",
            "634bc6d2804e-od.eds",
            "7a632a60290d-prbt-0-1.dcf",
            "867685232410-test.eds",
            "9c882ae7c17d-caneds1.eds",
            "a6842893f70a-sample.eds",
            "bf99403b56a8-bk5120-modified.eds",
            "c2fcfd6558a1-inverter.eds",
            "c3119d3bacfd-sample.eds",
        ],
    },
    Special {
        reason: "the value of the file does not fit its 16 bits, so it counts as not given",
        answer: Ok(&[0; 2]),
        files: &["8513e6b6ce58-high-power-espac-pc0x0502f050-rev0x00030.eds"],
    },
];

#[test]
fn every_real_file_runs_and_tells_its_device_type() {
    let Some(corpus) = edskit_tests::corpus("running the files of the corpus") else { return };
    let node_id = NodeId::new(5).expect("5 is a node-ID");
    let client = SdoClient::new(node_id);
    let mut failures = Vec::new();
    for file in &corpus {
        let sheet = Datasheet::parse(&file.bytes);
        let layout = match lay_out(&sheet, &SideFile::default()) {
            Ok(layout) => layout,
            Err(problems) => panic!("{}: {}", file.name, problems[0].message),
        };
        let answer = client.read(&mut Line::new(&layout, node_id), Index::DEVICE_TYPE, SubIndex(0));
        let answer = match answer {
            Ok(value) => Ok(value.bytes),
            Err(SdoError::Aborted(code)) => Err(code),
            Err(error) => panic!("{}: {error}", file.name),
        };
        let special = SPECIAL.iter().find(|special| special.files.contains(&file.name.as_str()));
        let expected = match special {
            Some(special) => special.answer.map(<[u8]>::to_vec),
            None => {
                let value = device_type(&sheet).unwrap_or_else(|| panic!("{}: no value", file.name));
                Ok(value.to_le_bytes().to_vec())
            }
        };
        if answer != expected {
            let why = special.map_or("as the file says", |special| special.reason);
            failures.push(format!("{}: {answer:?} instead of {expected:?} ({why})", file.name));
        }
    }
    assert!(failures.is_empty(), "{failures:#?}");
    let is_gone = |name: &&str| corpus.iter().all(|file| file.name != *name);
    let gone: Vec<&str> = SPECIAL.iter().flat_map(|special| special.files).copied().filter(is_gone).collect();
    assert!(gone.is_empty(), "{gone:?} are no files of the corpus");
}

/// The value of 1000h in the file, read from its text without the parser of the model.
fn device_type(sheet: &Datasheet) -> Option<u32> {
    let section = sheet.object(Index::DEVICE_TYPE)?.description().section();
    let text_of = |key| section.entry(key).map(|entry| entry.text().trim().to_owned());
    let is_there = |text: &String| !text.is_empty();
    let text =
        text_of(KeyName::ParameterValue).filter(is_there).or_else(|| text_of(KeyName::DefaultValue))?;
    match text.strip_prefix("0x").or_else(|| text.strip_prefix("0X")) {
        Some(digits) => u32::from_str_radix(digits, 16).ok(),
        None => text.parse().ok(),
    }
}
