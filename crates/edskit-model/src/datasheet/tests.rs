use super::*;
use crate::{KeyGroup, KeyName, NumberErrorKind, ValueErrorKind};
use edskit_types::{AccessType, Bitrate, DataType, NodeId, ObjectCode, PdoDirection};
use proptest::prelude::*;

const DEVICE: &str = "\
[FileInfo]
FileName=device.eds
edsversion=4.0
[DeviceInfo]
VendorNumber=0x161
BaudRate_125=1
BaudRate_500=1
BaudRate_800=0
NrOfTXPDO=2
[MandatoryObjects]
SupportedObjects=2
1=0x1000
2=4120
[1018]
ParameterName=Identity
ObjectType=0x9
SubNumber=2
[1018sub1]
ParameterName=Vendor-ID
DataType=0x0007
AccessType=RO
DefaultValue=0x0x161
PDOMapping=0
[1018SUB00]
ParameterName=Count
DataType=5
DefaultValue=
[1000]
ParameterName=Device type
DataType=0x0007
AccessType=ro
[1018]
ParameterName=Again
[1020sub1]
ParameterName=Orphan
";

#[test]
fn sections_and_keys_are_found_in_any_case() {
    let sheet = Datasheet::parse(DEVICE.as_bytes());
    assert_eq!(sheet.file_info().unwrap().eds_version().unwrap().text(), "4.0");
    let info = sheet.device_info().unwrap();
    assert_eq!(info.vendor_number().unwrap().known(), Some(0x161));
    assert_eq!(info.bitrates().collect::<Vec<_>>(), [Bitrate::Kbit125, Bitrate::Kbit500]);
    assert_eq!(info.pdo_count(PdoDirection::Transmit).unwrap().known(), Some(2));
    assert!(info.pdo_count(PdoDirection::Receive).is_none());
    let list = sheet.section(SectionKind::MandatoryObjects).unwrap();
    assert_eq!(list.keys().map(|key| key.number).collect::<Vec<_>>(), [0, 1, 2]);
    let items: Vec<_> = list.items().map(|item| (item.number, item.index.known())).collect();
    assert_eq!(items, [(1, Some(0x1000)), (2, Some(0x1018))]);
}

#[test]
fn objects_come_sorted_and_the_first_of_two_counts() {
    let sheet = Datasheet::parse(DEVICE.as_bytes());
    let indices: Vec<_> = sheet.objects().map(Object::index).collect();
    assert_eq!(indices, [Index(0x1000), Index(0x1018)]);
    let identity = sheet.object(Index(0x1018)).unwrap();
    assert_eq!(identity.parameter_name().unwrap().text(), "Identity");
    assert_eq!(identity.object_code(), Some(ObjectCode::Record));
    let subs: Vec<_> = identity.sub_objects().map(SubObject::sub_index).collect();
    assert_eq!(subs, [SubIndex(0), SubIndex(1)]);
    assert_eq!(
        sheet.sub_object(Index(0x1020), SubIndex(1)).unwrap().parameter_name().unwrap().text(),
        "Orphan"
    );
    assert!(sheet.object(Index(0x1020)).is_none());
    assert_eq!(sheet.sections().count(), 9);
}

#[test]
fn objects_of_a_range_include_both_ends() {
    let sheet = Datasheet::parse(b"[1400]\n[13FF]\n[1600]\n[15FF]\n[1401]\n");
    let indices = |first, last| {
        sheet.objects_in(Index(first)..=Index(last)).map(|object| object.index().0).collect::<Vec<_>>()
    };
    assert_eq!(indices(0x1400, 0x15FF), [0x1400, 0x1401, 0x15FF]);
    assert_eq!(indices(0, 0xFFFF).len(), 5);
    assert!(indices(0x2000, 0xFFFF).is_empty());
}

#[test]
fn a_value_that_means_nothing_keeps_its_text_reason_and_place() {
    let sheet = Datasheet::parse(DEVICE.as_bytes());
    let vendor = sheet.sub_object(Index(0x1018), SubIndex(1)).unwrap();
    let default = vendor.default_value().unwrap();
    assert_eq!(default.text(), "0x0x161");
    assert_eq!(default.value.unwrap_err().kind, ValueErrorKind::Number(NumberErrorKind::Digit(b'x')));
    let place = sheet.document().position(default.error_span().unwrap().start);
    assert_eq!((place.line, place.column), (22, 17));
    assert_eq!(vendor.access(), Some(AccessType::Ro));
}

#[test]
fn an_empty_entry_counts_as_none_but_is_there() {
    let sheet = Datasheet::parse(DEVICE.as_bytes());
    let count = sheet.sub_object(Index(0x1018), SubIndex(0)).unwrap();
    assert!(count.default_value().is_none());
    assert!(count.entry(KeyName::DefaultValue).unwrap().is_empty());
}

#[test]
fn keys_of_the_file_are_known() {
    let sheet = Datasheet::parse(b"[1000]\nDataType=7\nobjflags=\n[FileInfo]\nAccessType=ro\n");
    assert!([KeyName::DataType, KeyName::ObjFlags, KeyName::Unknown].iter().all(|&key| sheet.has_key(key)));
    assert!(!sheet.has_key(KeyName::AccessType), "no key of this section");
    assert!(!sheet.has_key(KeyName::FileName) && !Datasheet::parse(b"").has_key(KeyName::Unknown));
}

#[test]
fn sections_know_the_next_one() {
    let sheet = Datasheet::parse(b"[1000]\n[2000]\n[1000]\n");
    let first = sheet.sections().next().unwrap();
    assert_eq!(first.following().unwrap().name(), "2000");
    assert_eq!(first.following().and_then(Section::following).unwrap().id(), 2);
    assert!(sheet.sections().next_back().unwrap().following().is_none());
}

#[test]
fn entries_know_their_sections() {
    let sheet = Datasheet::parse(b"a=1\n[FileInfo]\nFileName=x\n[Other]\n[DeviceInfo]\nVendorName=y\n");
    let sections: Vec<_> =
        sheet.entries().map(|entry| entry.section().map(|section| section.name())).collect();
    assert_eq!(sections, [None, Some("FileInfo".into()), Some("DeviceInfo".into())]);
    assert_eq!(sheet.entries_outside_sections().count(), 1);
    assert_eq!(Datasheet::parse(b"a=1").entries_outside_sections().count(), 1);
}

#[test]
fn entries_are_found_by_their_line() {
    let sheet = Datasheet::parse(b"[1000]\n; x\nDataType=7\n\nDefaultValue=1\n");
    let keys: Vec<_> =
        (0..6).map(|line| sheet.entry_on_line(line).map(|entry| entry.key_text().into_owned())).collect();
    assert_eq!(keys, [None, None, Some("DataType".to_owned()), None, Some("DefaultValue".to_owned()), None]);
}

#[test]
fn repeated_sections_of_cia_306_are_counted_in_every_spelling() {
    for (text, repeated) in [
        ("[1000]\n[1018sub1]\n[Tool1]\n[x]\n[x]\n", false),
        ("[1000]\n[0x1000]\n", true),
        ("[1018sub1]\n[1018SUB1]\n", true),
        ("[DeviceComissioning]\n[DeviceCommissioning]\n", true),
    ] {
        assert_eq!(Datasheet::parse(text.as_bytes()).has_repeated_sections(), repeated, "{text}");
    }
}

#[test]
fn only_descriptions_have_attributes() {
    let sheet = Datasheet::parse(b"[FileInfo]\n[1000]\nDataType=7\n[M1Fixed2000]\nDataType=5\n");
    let types: Vec<_> =
        sheet.sections().map(|section| section.description().and_then(Description::standard_type)).collect();
    assert_eq!(types, [None, Some(DataType::Unsigned32), Some(DataType::Unsigned8)]);
}

#[test]
fn a_domain_object_needs_neither_type_nor_access() {
    let sheet = Datasheet::parse(b"[1021]\nParameterName=Store EDS\nObjectType=2\nDefaultValue=0A1B\n");
    let domain = sheet.object(Index(0x1021)).unwrap();
    assert_eq!(domain.standard_type(), Some(DataType::Domain));
    assert_eq!(domain.access(), Some(AccessType::Rw));
    assert_eq!(domain.default_value().unwrap().known(), Some(crate::Value::Octets(b"0A1B")));
}

#[test]
fn commissioning_is_read_in_both_spellings() {
    for name in ["DeviceComissioning", "DeviceCommissioning"] {
        let sheet =
            Datasheet::parse(format!("[{name}]\nNodeID=0x05\nBaudrate=250\nCANopenManager=1\n").as_bytes());
        let commissioning = sheet.commissioning().unwrap();
        assert_eq!(commissioning.node_id().unwrap().known(), Some(5));
        assert_eq!(sheet.commissioned_node_id(), NodeId::new(5).ok());
        assert_eq!(commissioning.baudrate().unwrap().known(), Some(250));
        assert_eq!(commissioning.canopen_manager().unwrap().known(), Some(true));
    }
}

#[test]
fn modules_are_read_with_all_their_sections() {
    let text = "[SupportedModules]\nNrOfEntries=1\n[M1ModuleInfo]\nProductName=DI8\n[M1Comments]\nLines=0\n[M1FixedObjects]\nNrOfEntries=1\n1=0x2000\n[M1Fixed2000]\nParameterName=Fixed\n[M1Fixed2000sub1]\nParameterName=Part\n[M1SubExtends]\nNrOfEntries=2\n1=0x6000\n2=0x6100\n[M1SubExt6000]\nParameterName=Inputs\nCount=2\nObjExtend=8\n[M1SubExt6100]\nCount=0;4\n[ConnectedModules]\nNrOfEntries=2\n1=1\n2=1\n";
    let sheet = Datasheet::parse(text.as_bytes());
    assert_eq!(sheet.supported_modules().unwrap().known(), Some(1));
    let module = sheet.modules().next().unwrap();
    assert_eq!(module.info().unwrap().filled(KeyName::ProductName).unwrap().text(), "DI8");
    assert!(module.comments().is_some());
    assert_eq!(module.fixed_objects().next().unwrap().index.known(), Some(0x2000));
    assert_eq!(module.fixed_object(Index(0x2000)).unwrap().parameter_name().unwrap().text(), "Fixed");
    assert!(module.fixed_sub_object(Index(0x2000), SubIndex(1)).is_some());
    let extensions: Vec<_> = module
        .sub_extends()
        .map(|item| module.sub_extension(Index(item.index.known().unwrap())).unwrap())
        .map(|extension| {
            (extension.index().0, extension.count(), extension.obj_extend().and_then(Field::known))
        })
        .collect();
    assert_eq!(
        extensions,
        [(0x6000, Some(ModuleCount::SubIndices(2)), Some(8)), (0x6100, Some(ModuleCount::Bits(4)), None)]
    );
    assert_eq!(sheet.connected_modules().filter_map(Field::known).collect::<Vec<_>>(), [1, 1]);
    assert!(sheet.module(2).is_none());
}

#[test]
fn channels_and_tools_are_read() {
    let text = "[DynamicChannels]\nNrOfSeg=1\nType1=0x0001\nDir1=rww\nRange1=0xA080-0xA0BF\nPPOffset1=16, 1\n[Tools]\nItems=1\n[Tool1]\nName=Setup\nCommand=setup.exe $DCF\n";
    let sheet = Datasheet::parse(text.as_bytes());
    let channel = sheet.dynamic_channels().next().unwrap();
    assert_eq!(channel.data_type.unwrap().known(), Some(1));
    assert_eq!(channel.direction.unwrap().known(), Some(AccessType::Rww));
    assert_eq!(channel.indices(), Some((Index(0xA080), Index(0xA0BF))));
    assert_eq!(channel.process_image_offset(), Some(ChannelOffset { offset: 16, difference: Some(1) }));
    let tool = sheet.tools().next().unwrap();
    assert_eq!(tool.name.unwrap().text(), "Setup");
    assert_eq!(tool.command.unwrap().text(), "setup.exe $DCF");
}

#[test]
fn a_node_list_is_read() {
    let text = "[Topology]\nNetName=Line\nNodes=0x02\nNode1Present=0x01\nNode1Name=Drive\nNode1DCFName=d.dcf\nNode12Present=0\nEDSBaseName=eds\n[Topology2]\nNodes=0\n";
    let sheet = Datasheet::parse(text.as_bytes());
    let networks: Vec<_> = sheet.topologies().collect();
    assert_eq!(networks.len(), 2);
    assert_eq!(networks[0].node_count().unwrap().known(), Some(2));
    assert_eq!(networks[0].eds_base_name().unwrap().text(), "eds");
    let nodes = networks[0].nodes();
    assert_eq!(nodes.iter().map(|node| node.node_id).collect::<Vec<_>>(), [1, 12]);
    assert_eq!(nodes[0].dcf_name.unwrap().text(), "d.dcf");
    assert_eq!(nodes[1].present.unwrap().known(), Some(0));
}

proptest! {
    #[test]
    fn any_bytes_can_be_read(bytes in proptest::collection::vec(any::<u8>(), 0..300)) {
        read_everything(&Datasheet::parse(&bytes));
    }

    #[test]
    fn anything_like_a_datasheet_can_be_read(lines in proptest::collection::vec(line(), 0..40)) {
        read_everything(&Datasheet::parse(lines.join("\n").as_bytes()));
    }
}

fn line() -> impl Strategy<Value = String> {
    prop_oneof![
        "\\[(1018|2000|M1Fixed2000|FileInfo|DeviceInfo|Topology)(sub[0-9A-F]{1,3}|Name|Value)?\\]?",
        "(ParameterName|ObjectType|DataType|AccessType|DefaultValue|LowLimit|CompactSubObj|SubNumber)=(0x)?[0-9a-f$NODEID+;-]{0,12}",
        "(NrOfEntries|[0-9]{1,6}|Line[0-9]|Dummy[0-9a-f]{1,5}|Node[0-9]{1,4}Name|CompactPDO|NrOfRXPDO)=(0x)?[0-9A-F]{0,6}",
        ".{0,20}",
    ]
}

fn read_everything(sheet: &Datasheet) {
    for object in sheet.objects() {
        for entry in object.dictionary_entries() {
            let value = entry.value().and_then(|value| value.integer(entry.data_type()?, None).ok());
            let _ = (
                entry.name(),
                entry.access(),
                entry.limits(),
                entry.denotation(),
                entry.is_mappable(),
                value,
            );
        }
    }
    for section in sheet.sections() {
        let _ = (section.name(), section.end(), section.items().count());
    }
    let _ = sheet.implicit_pdos(PdoDirection::Receive).count();
    let _ = sheet.topologies().map(|topology| topology.nodes().len()).sum::<usize>();
    let _ = sheet.dynamic_channels().filter_map(|channel| channel.indices()).count();
}

#[test]
fn keys_are_those_of_their_section_whatever_stood_before() {
    let text = "[1000]\nParameterName=a\nDataType=7\nDefaultValue=1\n[1001]\nParameterName=b\nDataType=5\naccessType=ro\n\
        [1A00Name]\nNrOfEntries=1\n1=x\n[Tool1]\nName=a\nCommand=b\n[Topology]\nNode1Name=c\nName=d\n\
        [1002]\nparametername=c\nDataType=5\n[MandatoryObjects]\nSupportedObjects=1\n1=0x1000\nDataType=5\n";
    let sheet = Datasheet::parse(text.as_bytes());
    for entry in sheet.entries() {
        let group = KeyGroup::of(entry.section().unwrap().kind());
        assert_eq!(entry.key(), Key::of(group, entry.key_text().as_bytes()), "{}", entry.key_text());
    }
    let unusual: Vec<_> = sheet.unusual_keys().map(|entry| entry.key_text().into_owned()).collect();
    assert_eq!(unusual, ["accessType", "parametername"]);
}
