//! The data sheets of the Heinzmann CANopen gateway: the one that its manual prints, and the corrected one.

use edskit_devices::gateway::{Configuration, Engine, Gateway, State};
use edskit_host::MemoryStorage;
use edskit_host::sdo::{SdoChannel, SdoError, SdoOptions, Transfer};
use edskit_model::{Datasheet, EvaluationError, KeyName, LineKind, Radix, SectionKind, Value};
use edskit_runtime::{Device, Instant};
use edskit_types::{AccessType, DataType, Index, NodeId, ObjectCode, SubIndex};

/// Chapter 10 of the manual.
fn published() -> Datasheet {
    Datasheet::parse(&edskit_tests::read(
        &edskit_tests::root().join("tests/fixtures/CANopenGateway.published.eds"),
    ))
}

fn corrected() -> Datasheet {
    Datasheet::parse(&edskit_tests::read(&edskit_tests::root().join("eds/CANopenGateway.eds")))
}

/// The value of a key of a section, as written.
fn text(sheet: &Datasheet, section: &str, key: &str) -> Option<String> {
    let section = sheet.section(SectionKind::of(section.as_bytes()))?;
    let entry = section.entries().find(|entry| entry.key_text() == key)?;
    Some(entry.text().into_owned())
}

/// The default of an entry on node 5; `None` if it has none.
fn default(sheet: &Datasheet, index: u16, sub_index: u8) -> Option<i128> {
    let entry = sheet.dictionary_entry(Index(index), SubIndex(sub_index))?;
    entry.default_value()?.integer(entry.data_type()?, NodeId::new(5).ok()).ok()
}

/// The default and the limits of sub-index 00h, `SubNumber`, and the sub-indices that are described.
fn extent(sheet: &Datasheet, index: u16) -> Option<(i128, i128, i128, u8, Vec<u8>)> {
    let entry = sheet.dictionary_entry(Index(index), SubIndex(0))?;
    let number = |value: Option<Value<'_>>| value?.integer(DataType::Unsigned8, None).ok();
    let [low, high] = entry.limits().map(|limit| limit?.known());
    let object = sheet.object(Index(index))?;
    let sub_indices = object.sub_objects().map(|sub_object| sub_object.sub_index().0).collect();
    let sub_number = object.description().sub_number()?.known()?;
    Some((number(entry.default_value())?, number(low)?, number(high)?, sub_number, sub_indices))
}

/// The mapping parameters and the objects with process data.
const DYNAMIC: [(std::ops::RangeInclusive<u16>, i128, i128); 10] = [
    (0x1600..=0x1600, 0, 3),
    (0x1601..=0x1603, 0, 4),
    (0x1A00..=0x1A00, 0, 4),
    (0x1A01..=0x1A01, 0, 2),
    (0x1A02..=0x1A02, 0, 1),
    (0x1A03..=0x1A0F, 0, 4),
    (0x2000..=0x2000, 6, 7),
    (0x2001..=0x2002, 0, 52),
    (0x2003..=0x2003, 0, 2),
    (0x2004..=0x2004, 0, 12),
];

#[test]
fn the_device_follows_cia_301_without_a_profile() {
    // GW-EDS-01
    for sheet in [published(), corrected()] {
        assert_eq!(default(&sheet, 0x1000, 0), Some(0));
    }
}

#[test]
fn device_information() {
    let section = |sheet: &Datasheet| {
        let section = sheet.section(SectionKind::DeviceInfo).unwrap();
        let line = |entry: edskit_model::Entry<'_>| format!("{}={}", entry.key_text(), entry.text());
        section.entries().map(line).collect::<Vec<_>>()
    };
    let expected = [
        // GW-EDS-09
        "VendorName=Heinzmann GmbH & Co. KG",
        "VendorNumber=0x00000161",
        "ProductName=CANopen Gateway",
        "ProductNumber=0x00001B59",
        "RevisionNumber=0",
        "OrderCode=CANopen Gateway",
        // GW-EDS-04, GW-EDS-23
        "BaudRate_10=0",
        "BaudRate_20=0",
        "BaudRate_50=0",
        "BaudRate_125=1",
        "BaudRate_250=1",
        "BaudRate_500=1",
        "BaudRate_800=0",
        "BaudRate_1000=1",
        // GW-EDS-06
        "SimpleBootUpMaster=0",
        "SimpleBootUpSlave=1",
        // GW-EDS-07
        "Granularity=0",
        "DynamicChannelsSupported=0",
        "GroupMessaging=0",
        // GW-EDS-03
        "NrOfRXPDO=4",
        "NrOfTXPDO=16",
        "LSS_Supported=0",
    ];
    assert_eq!(section(&published()), expected);
    assert_eq!(section(&corrected()), expected);
    assert_eq!(corrected().device_info().unwrap().product_number().unwrap().known(), Some(7001));
}

#[test]
fn the_mapping_is_fixed_and_gaps_are_unsigned16() {
    for sheet in [published(), corrected()] {
        // GW-EDS-07: nobody can write what is mapped.
        for (parameters, ..) in &DYNAMIC[..6] {
            for sub_object in
                parameters.clone().flat_map(|index| sheet.object(Index(index)).unwrap().sub_objects())
            {
                assert_eq!(sub_object.description().access(), Some(AccessType::Ro));
            }
        }
        // GW-EDS-08
        let dummies = (1..=7).map(|number| text(&sheet, "DummyUsage", &format!("Dummy{number:04}")).unwrap());
        assert_eq!(dummies.collect::<String>(), "0000010");
    }
}

#[test]
fn file_information() {
    let of = |sheet: &Datasheet, keys: &[&str]| {
        keys.iter().map(|key| text(sheet, "FileInfo", key).unwrap()).collect::<Vec<_>>()
    };
    let keys = ["FileName", "FileVersion", "FileRevision", "CreationDate", "ModificationDate"];
    // GW-EDS-10
    assert_eq!(of(&published(), &keys), ["CANopenGateway.eds", "1", "0", "05-19-2004", "05-19-2004"]);
    let keys = ["EDSVersion", "CreationTime", "ModificationTime"];
    // GW-EDS-12, GW-EDS-13
    assert_eq!(of(&published(), &keys), ["4", "00:00AM", "00:00AM"]);
    // GW-GAP-14
    assert_eq!(of(&corrected(), &keys), ["4.0", "12:00AM", "12:00AM"]);
}

#[test]
fn the_product_code_with_two_prefixes() {
    // GW-EDS-11
    let sheet = published();
    let entry = sheet.sub_object(Index::IDENTITY, SubIndex(2)).unwrap().description();
    let field = entry.default_value().unwrap();
    assert_eq!((field.text().as_ref(), field.value.is_err()), ("0x0x00001B59", true));
    // What was meant is as good as certain.
    assert_eq!(field.known().and_then(|value| value.integer(DataType::Unsigned32, None).ok()), Some(0x1B59));
    assert_eq!(sheet.text(field.error_span().unwrap()), "x00001B59");
    assert_eq!(sheet.document().position(field.span().start).line, 98);
    assert_eq!(sheet.device_info().unwrap().product_number().unwrap().known(), Some(0x1B59));
    assert_eq!(default(&corrected(), 0x1018, 2), Some(0x1B59));
}

#[test]
fn keys_in_any_case_and_order() {
    let sheet = published();
    for index in 0x2000..=0x2004 {
        // GW-EDS-14
        let sub_object = sheet.sub_object(Index(index), SubIndex(0)).unwrap().description();
        assert_eq!(sub_object.entry(KeyName::DefaultValue).unwrap().key_text(), "Defaultvalue");
        assert_eq!(default(&sheet, index, 0), Some(if index == 0x2000 { 6 } else { 0 }));
        // GW-EDS-15
        let object = sheet.object(Index(index)).unwrap().description();
        let keys: Vec<_> = object.entries().map(|entry| entry.key_text()).collect();
        assert_eq!(keys, ["SubNumber", "ParameterName", "ObjectType"]);
        assert_eq!(sub_object.object_type().unwrap().text(), "0x07");
    }
    let elsewhere = sheet.object(Index::DEVICE_TYPE).unwrap().description();
    assert_eq!(elsewhere.object_type().unwrap().text(), "0x7");
    for object_code in sheet.sub_objects().map(|sub_object| sub_object.description().object_code()) {
        assert_eq!(object_code, Some(ObjectCode::Var));
    }
}

#[test]
fn what_exists_only_in_some_configurations() {
    let (published, corrected) = (published(), corrected());
    for (indices, low, high) in DYNAMIC {
        for index in indices {
            let up_to = |last: i128| Some((low, low, high, last as u8 + 1, (0..=last as u8).collect()));
            // GW-EDS-16: only what always exists is described.
            assert_eq!(extent(&published, index), up_to(low), "{index:04X}h");
            // GW-GAP-01: all that can exist is described.
            assert_eq!(extent(&corrected, index), up_to(high), "{index:04X}h");
        }
    }
    for index in [0x1600..=0x1603, 0x1A00..=0x1A0F, 0x2001..=0x2004].into_iter().flatten() {
        let object = corrected.object(Index(index)).unwrap();
        for entry in object.dictionary_entries().skip(1) {
            // GW-GAP-01, GW-GAP-02, GW-GAP-03
            let (data_type, mappable) = match index {
                0x1600..=0x1A0F => (DataType::Unsigned32, false),
                0x2002 => (DataType::Integer16, true),
                _ => (DataType::Unsigned16, true),
            };
            let described = (entry.data_type(), entry.access(), entry.is_mappable());
            assert_eq!(described, (Some(data_type), Some(AccessType::Ro), mappable), "{index:04X}h");
        }
    }
}

#[test]
fn entries_without_a_default() {
    // GW-EDS-17
    let sheet = published();
    let without: Vec<String> = sheet
        .sub_objects()
        .filter(|sub_object| sub_object.description().default_value().is_none())
        .map(|sub_object| format!("{}:{:02X}", sub_object.index(), sub_object.sub_index().0))
        .collect();
    let communication = (0x1400..=0x1403).chain(0x1800..=0x180F).map(|index| format!("{index:04X}h:04"));
    let mut expected = vec!["1018h:03".to_owned(), "1018h:04".to_owned()];
    expected.extend(communication);
    expected.extend((1..=6).map(|sub_index| format!("2000h:{sub_index:02X}")));
    assert_eq!(without, expected);
    // GW-EDS-18
    assert_eq!(sheet.device_info().unwrap().revision_number().unwrap().known(), Some(0));
}

#[test]
fn identifiers_that_follow_the_node_id() {
    for sheet in [published(), corrected()] {
        let tpdos = [0x8000_0180, 0x8000_0280, 0x8000_0380, 0x8000_0480].into_iter().chain([0x8000_0000; 12]);
        let rpdos = [0x8000_0200, 0x8000_0300, 0x8000_0400, 0x8000_0500];
        for (index, offset) in (0x1800..).zip(tpdos).chain((0x1400..).zip(rpdos)) {
            // GW-EDS-19: 32 bits without sign.
            let entry = sheet.sub_object(Index(index), SubIndex(1)).unwrap().description();
            let field = entry.default_value().unwrap();
            assert_eq!(field.text(), format!("$NODEID+0x{offset:08X}"));
            let value = |node: Option<u8>| {
                let node_id = node.map(|node| NodeId::new(node).unwrap());
                field.known().unwrap().integer(DataType::Unsigned32, node_id)
            };
            for node in 1..=127 {
                assert_eq!(value(Some(node)), Ok(offset + i128::from(node)));
            }
            assert_eq!(value(None), Err(EvaluationError::NodeIdNeeded));
            // GW-GAP-05
            assert_eq!(default(&sheet, index, 5), Some(0));
        }
    }
}

#[test]
fn numbers_with_and_without_prefix() {
    // GW-EDS-20
    let sheet = published();
    let number = |index, sub_index, name| {
        let entry =
            sheet.sub_object(Index(index), SubIndex(sub_index)).unwrap().description().entry(name).unwrap();
        let number = entry.number().known().unwrap();
        (entry.text().into_owned(), number.radix(), number.value())
    };
    let default = KeyName::DefaultValue;
    assert_eq!(number(0x1400, 0, default), ("5".to_owned(), Radix::Decimal, 5));
    assert_eq!(number(0x1200, 0, default), ("0x2".to_owned(), Radix::Hexadecimal, 2));
    assert_eq!(number(0x1016, 0, default), ("0x01".to_owned(), Radix::Hexadecimal, 1));
    assert_eq!(number(0x1400, 5, default).2, 0);
    assert_eq!(number(0x2001, 0, KeyName::HighLimit), ("52".to_owned(), Radix::Decimal, 52));
}

#[test]
fn the_printed_text_is_kept() {
    // GW-NOTE-45
    let bytes = edskit_tests::read(&edskit_tests::root().join("tests/fixtures/CANopenGateway.published.eds"));
    assert!(bytes.is_ascii());
    let lines: Vec<&str> = str::from_utf8(&bytes).unwrap().split_terminator("\r\n").collect();
    assert!(lines.len() == 1875 && !lines.iter().any(|line| line.contains(['\r', '\n'])));
    // GW-EDS-15
    let sheet = published();
    assert_eq!(sheet.document().to_bytes(), bytes);
    // GW-EDS-21
    let comments = lines.iter().filter(|line| line.starts_with(';'));
    let document = sheet.document();
    assert_eq!(
        document.lines().iter().filter(|line| line.kind() == LineKind::Comment).count(),
        comments.count()
    );
    let list = sheet.section(SectionKind::OptionalObjects).unwrap();
    let item = list.entry(KeyName::Item).unwrap().line_number();
    assert_eq!(lines[item - 1..=item], [";Consumer Heartbeat Time", "1=0x1016"]);
    let header = sheet.object(Index::RPDO_COMMUNICATION).unwrap().description().line_number();
    let rule = ";***********************************";
    assert_eq!(lines[header - 3..=header], [rule, ";RPDO1 COMMUNICATION PARAMETERS", rule, "[1400]"]);
    // GW-EDS-22
    assert_eq!(lines[..3], ["[Comments]", "Lines=0", ""]);
    // GW-EDS-23
    for name in [KeyName::CompactPdo, KeyName::CompactSubObj, KeyName::ObjFlags] {
        assert!(!sheet.has_key(name));
    }
    assert!(sheet.section(SectionKind::Tools).is_none());
}

#[test]
fn lists_of_objects() {
    // GW-OD-22
    for sheet in [published(), corrected()] {
        let lists = ["MandatoryObjects", "OptionalObjects", "ManufacturerObjects"];
        let count = |list: &str| sheet.section(SectionKind::of(list.as_bytes())).unwrap().items().count();
        assert_eq!(lists.map(count), [3, 43, 6]);
        let supported = lists.map(|list| text(&sheet, list, "SupportedObjects").unwrap());
        assert_eq!(supported, ["3", "43", "6"]);
        assert_eq!(sheet.objects().len(), 52);
    }
}

#[test]
fn records_of_cia_301() {
    // GW-NOTE-17
    let records = [0x1018, 0x1200].into_iter().chain(0x1600..=0x1603).chain(0x1A00..=0x1A0F);
    let (published, corrected) = (published(), corrected());
    for index in records.map(Index) {
        let code = |sheet: &Datasheet| sheet.object(index).unwrap().description().object_code();
        let codes = (code(&published), code(&corrected));
        assert_eq!(codes, (Some(ObjectCode::Array), Some(ObjectCode::Record)), "{index}");
    }
}

/// A gateway with the default parameters, in pre-operational.
struct Live {
    device: Gateway<Engine, MemoryStorage>,
    now: Instant,
}

impl Live {
    fn new() -> Self {
        let device = Gateway::new(Configuration::new(), Engine::new(), MemoryStorage::default());
        let mut live = Self { device, now: Instant(0) };
        while live.device.state() != State::PreOperational {
            live.device.poll(live.now);
            while live.device.transmit().is_some() {}
            live.now = live.device.next_deadline(live.now);
        }
        live
    }

    /// What an entry holds; `None` where there is no such entry.
    fn read(&mut self, index: Index, sub_index: SubIndex) -> Option<i128> {
        let channel = SdoChannel::of_node(NodeId::MIN);
        let mut transfer = Transfer::read(channel, index, sub_index, SdoOptions::default(), self.now);
        loop {
            while let Some(request) = transfer.transmit(self.now) {
                self.device.receive(self.now, &request);
            }
            self.device.poll(self.now);
            while let Some(frame) = self.device.transmit() {
                transfer.receive(self.now, &frame);
            }
            match transfer.result() {
                None => {}
                Some(Ok(bytes)) => {
                    return Some(bytes.iter().rev().fold(0, |number, byte| number << 8 | i128::from(*byte)));
                }
                Some(Err(SdoError::Aborted(_))) => return None,
                Some(Err(error)) => panic!("{index}: {error:?}"),
            }
        }
    }
}

/// Every entry of a data sheet with its default at node 1, if it has one.
fn defaults(sheet: &Datasheet) -> Vec<(Index, SubIndex, Option<i128>)> {
    let entries = sheet.objects().flat_map(|object| object.dictionary_entries());
    let default = |entry: edskit_model::DictionaryEntry<'_>| {
        let value =
            entry.default_value().and_then(|value| value.integer(entry.data_type()?, Some(NodeId::MIN)).ok());
        (entry.index, entry.sub_index, value)
    };
    entries.map(default).collect()
}

// GW-EDS-24, GW-GAP-04, GW-GAP-13
#[test]
fn data_sheet_device_and_dcf_agree_in_every_default() {
    let sheet = corrected();
    let dcf =
        edskit_tests::edskit_with_input(&["config", "dcf", "-"], b"device = \"heinzmann-canopen-gateway\"\n");
    assert_eq!(dcf.exit, edskit::Exit::Clean, "{}", dcf.stderr);
    let dcf = Datasheet::parse(dcf.stdout.as_bytes());
    let mut live = Live::new();
    let (mut same, mut absent) = (0, 0);
    for (index, sub_index, stated) in defaults(&sheet) {
        let held = live.read(index, sub_index);
        let of_dcf =
            dcf.sub_object(index, sub_index).is_some() || dcf.object(index).is_some_and(|_| sub_index.0 == 0);
        assert_eq!(held.is_some(), of_dcf, "{index}:{sub_index}: the DCF has what the device has");
        match (held, stated) {
            // GW-GAP-01: the data sheet describes the greatest extent.
            (None, _) => absent += 1,
            (Some(held), Some(stated)) => {
                assert_eq!(held, stated, "{index}:{sub_index}: device and data sheet");
                let entry = dcf.dictionary_entry(index, sub_index).expect("it is in the DCF");
                let value = entry
                    .default_value()
                    .and_then(|value| value.integer(entry.data_type()?, Some(NodeId::MIN)).ok());
                assert_eq!(value, Some(held), "{index}:{sub_index}: device and DCF");
                same += 1;
            }
            (Some(held), None) => {
                let is_of_a_unit = (index, sub_index) == (Index::IDENTITY, SubIndex(4));
                assert!(is_of_a_unit || held == 0, "{index}:{sub_index} is {held}, and has no default");
            }
        }
    }
    assert!(same > 130 && absent > 150, "{same} {absent}");
    for sheet in [&sheet, &dcf] {
        assert_eq!(sheet.device_info().unwrap().revision_number().unwrap().known(), Some(0));
    }
    assert_eq!(live.read(Index::IDENTITY, SubIndex(3)), Some(0));
    // As printed (GW-EDS-17): the serial number of a unit is no default of all.
    assert_eq!(default(&corrected(), 0x1018, 4), None);
}
