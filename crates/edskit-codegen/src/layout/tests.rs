use super::*;
use crate::parse;
use edskit_runtime::StorageGroup;
use edskit_types::{BitRates, Bitrate, Index, SubIndex};

/// An object of an EDS.
fn object(header: &str, name: &str, keys: &str) -> String {
    format!("[{header}]\nParameterName={name}\n{}\n", keys.replace(' ', "\n"))
}

/// What makes a file that of a configured device, to which nothing is added.
const CONFIGURED: &str = "[DeviceComissioning]\n";

/// The layout of some objects alone.
fn layout(eds: &str, side_file: &str) -> Layout {
    parse(format!("{eds}{CONFIGURED}").as_bytes(), Some(side_file)).unwrap()
}

/// The layout of a device: with what CiA 301 adds.
fn device(eds: &str) -> Layout {
    parse(eds.as_bytes(), None).unwrap()
}

fn entry(layout: &Layout, index: u16, sub_index: u8) -> Entry {
    let position = layout.table().find(Index(index), SubIndex(sub_index)).unwrap();
    layout.entries[usize::from(position.0)]
}

fn flags(eds: &str, index: u16, sub_index: u8) -> Flags {
    entry(&layout(eds, ""), index, sub_index).flags
}

fn messages(problems: &[Problem]) -> Vec<String> {
    problems.iter().map(|problem| problem.line("a.eds", "a.toml").to_string()).collect()
}

#[test]
fn what_can_change_lies_in_the_values() {
    let is_variable =
        |index, keys: &str| flags(&object(&format!("{index:X}"), "x", keys), index, 0).has(Flags::VARIABLE);
    for (index, keys) in [
        (0x1001, "DataType=5 AccessType=ro DefaultValue=0"),
        (0x1002, "DataType=7 AccessType=ro DefaultValue=0"),
        (0x1014, "DataType=7 AccessType=const DefaultValue=$NODEID+0x80"),
        (0x1017, "DataType=6 AccessType=rw DefaultValue=0"),
        (0x1020, "DataType=6 AccessType=ro"),
        (0x2000, "DataType=6 AccessType=ro DefaultValue=1"),
        (0x6041, "DataType=6 AccessType=ro PDOMapping=1"),
        (0x6040, "DataType=6 AccessType=wo"),
    ] {
        assert!(is_variable(index, keys), "{index:X} {keys}");
    }
    for (index, keys) in [
        (0x1000, "DataType=7 AccessType=ro DefaultValue=0x191"),
        (0x1008, "DataType=9 AccessType=const DefaultValue=Pump"),
        (0x100A, "DataType=9 AccessType=const"),
        (0x2000, "DataType=6 AccessType=const DefaultValue=1 PDOMapping=1"),
        (0x2001, "DataType=15 AccessType=rw"),
        (0x2002, "ObjectType=2"),
    ] {
        assert!(!is_variable(index, keys), "{index:X} {keys}");
    }
}

#[test]
fn rights_follow_access_and_mapping() {
    let both = Flags::TPDO.and(Flags::RPDO);
    for (access, wanted) in [
        ("ro", Flags::READ.and(Flags::TPDO).and(Flags::VARIABLE)),
        ("const", Flags::READ.and(Flags::TPDO)),
        ("wo", Flags::WRITE.and(Flags::RPDO).and(Flags::VARIABLE)),
        ("rw", Flags::READ.and(Flags::WRITE).and(both).and(Flags::VARIABLE)),
        ("rwr", Flags::READ.and(Flags::WRITE).and(Flags::TPDO).and(Flags::VARIABLE)),
        ("rww", Flags::READ.and(Flags::WRITE).and(Flags::RPDO).and(Flags::VARIABLE)),
    ] {
        let keys = format!("DataType=6 AccessType={access} PDOMapping=1 DefaultValue=1");
        assert_eq!(flags(&object("2000", "x", &keys), 0x2000, 0), wanted, "{access}");
    }
    let domain = object("2000", "x", "ObjectType=2 PDOMapping=1");
    assert_eq!(flags(&domain, 0x2000, 0), Flags::READ.and(Flags::WRITE));
}

#[test]
fn texts_have_room() {
    let eds = [
        object("1008", "a", "DataType=9 AccessType=const DefaultValue=Pump"),
        object("2000", "b", "DataType=9 AccessType=rw DefaultValue=ok"),
        object("2001", "c", "DataType=10 AccessType=rw DefaultValue=0102"),
        object("2002", "d", "DataType=9 AccessType=ro DefaultValue=abc"),
        object("2003", "e", "DataType=9 AccessType=const DefaultValue=abc"),
    ]
    .concat();
    let layout = layout(&eds, "[capacity]\n'2001' = 3\n'2003' = 8\n");
    let sizes: Vec<u16> = layout.entries.iter().map(|entry| entry.size).collect();
    assert_eq!(sizes, [4, 32, 3, 3, 8]);
    assert_eq!(layout.constants, b"Pump");
    assert_eq!(layout.defaults.len(), 34 + 5 + 5 + 10);
    assert_eq!(layout.defaults[34..44], *b"\x02\x00\x01\x02\x00\x03\x00abc");
    let defaults: Vec<&[u8]> = layout.entries.iter().map(|entry| layout.default_of(entry)).collect();
    assert_eq!(defaults, [&b"Pump"[..], b"ok", &[1, 2], b"abc", b"abc"]);
    assert_eq!(layout.counts.buffers, 32);
}

#[test]
fn equal_constants_share_their_bytes() {
    let eds = ["1000", "1002", "2000"]
        .map(|index| object(index, "x", "DataType=7 AccessType=const DefaultValue=5"));
    let layout = layout(&eds.concat(), "");
    assert_eq!(layout.constants, [5, 0, 0, 0]);
    assert_eq!(layout.defaults, [5, 0, 0, 0], "1002h can change");
}

#[test]
fn compact_storage_is_expanded() {
    let eds = object("2100", "Ramp", "ObjectType=8 DataType=6 AccessType=rw DefaultValue=7 CompactSubObj=3")
        + "[2100Name]\nNrOfEntries=1\n2=Slope\n[2100Value]\nNrOfEntries=1\n3=0x20\n";
    let layout = layout(&eds, "");
    let names: Vec<_> = layout.sources.iter().map(|source| source.name.as_str()).collect();
    assert_eq!(names, ["NrOfObjects", "Ramp1", "Slope", "Ramp3"]);
    assert_eq!(layout.constants, [3]);
    assert_eq!(layout.defaults, [7, 0, 7, 0, 0x20, 0]);
    assert_eq!(layout.entries[0].data_type, DataType::Unsigned8);
}

#[test]
fn implicit_pdos_have_parameters() {
    let info = "[DeviceInfo]\nCompactPDO=0x13\nNrOfRXPDO=5\nNrOfTXPDO=1\nGranularity=16\n";
    let of_eds = device(info);
    assert_eq!(
        of_eds.counts,
        Counts { rpdos: 5, tpdos: 1, mapped: 24, servers: 1, consumers: 0, buffers: 8 }
    );
    assert_eq!(of_eds.default_of(&entry(&of_eds, 0x1400, 0)), [5]);
    let second = entry(&of_eds, 0x1401, 1);
    assert!(second.flags.has(Flags::NODE_RELATIVE.and(Flags::WRITE)));
    assert_eq!(of_eds.default_of(&second), 0x300_u32.to_le_bytes());
    assert_eq!(of_eds.default_of(&entry(&of_eds, 0x1404, 1)), 0x8000_0000_u32.to_le_bytes());
    assert!(of_eds.table().find(Index(0x1400), SubIndex(3)).is_err());
    let of_dcf = layout(&format!("{info}[DeviceComissioning]\nNodeID=1\n"), "");
    assert_eq!(of_dcf.default_of(&entry(&of_dcf, 0x1401, 1)), 0x8000_0000_u32.to_le_bytes());
}

#[test]
fn there_can_be_512_pdos_each_way() {
    let layout = device("[DeviceInfo]\nGranularity=8\nCompactPDO=0x3F\nNrOfRXPDO=512\nNrOfTXPDO=512\n");
    assert_eq!((layout.counts.rpdos, layout.counts.tpdos, layout.counts.mapped), (512, 512, 1024 * 8));
    assert!(layout.defaults.len() < MOST_BYTES, "{}", layout.defaults.len());
}

#[test]
fn a_deftype_is_followed_and_unknown_types_are_domains() {
    let eds = [
        object("0041", "Speed", "ObjectType=5 DataType=0x0040"),
        object("0040", "Number", "ObjectType=5 DataType=0x0006"),
        object("0042", "Itself", "ObjectType=5 DataType=0x0042"),
        object("2000", "a", "DataType=0x0041 AccessType=rw DefaultValue=0x1234"),
        object("2001", "b", "DataType=0x0042 AccessType=rw DefaultValue=1"),
        object("2002", "c", "DataType=0x0050 AccessType=rw"),
        object("2003", "d", "AccessType=rw"),
        object("2004", "e", "DataType=0x21 AccessType=rw"),
        object("2005", "f", "DataType=6 AccessType=often"),
    ]
    .concat();
    let layout = layout(&eds, "");
    let types: Vec<_> = layout.entries.iter().map(|entry| entry.data_type).collect();
    assert_eq!(types[0], DataType::Unsigned16);
    assert!(types[1..5].iter().all(|data_type| *data_type == DataType::Domain));
    assert_eq!(layout.defaults[..2], [0x34, 0x12]);
    assert!(!entry(&layout, 0x2005, 0).flags.has(Flags::WRITE));
    assert_eq!(
        messages(&layout.lost),
        [
            "a.eds:20:10: GEN [2001] becomes a DOMAIN, which only the application knows: `0x0042` is no data type of values",
            "a.eds:25:10: GEN [2002] becomes a DOMAIN, which only the application knows: `0x0050` is no data type of values",
            "a.eds:27:2: GEN [2003] becomes a DOMAIN, which only the application knows: it has no data type",
            "a.eds:32:10: GEN [2004] becomes a DOMAIN, which only the application knows: `0x21` is no data type of values",
            "a.eds:37:12: GEN [2005] has no access type that can be read, and becomes ro",
        ]
    );
}

#[test]
fn what_compact_sub_objects_share_is_noted_once() {
    let layout = layout(&object("2000", "x", "ObjectType=8 DataType=0x50 CompactSubObj=200"), "");
    assert_eq!(
        messages(&layout.lost),
        [
            "a.eds:1:2: GEN [2000] has no access type that can be read, and becomes ro",
            "a.eds:4:10: GEN [2000] becomes a DOMAIN, which only the application knows: `0x50` is no data type of values",
        ]
    );
}

#[test]
fn a_configured_value_comes_before_the_default() {
    let eds = object("1017", "x", "DataType=6 AccessType=rw DefaultValue=1 ParameterValue=2")
        + &object("1019", "y", "DataType=5 AccessType=rw DefaultValue=300");
    let layout = layout(&eds, "");
    assert_eq!(layout.defaults, [2, 0, 0]);
    assert_eq!(messages(&layout.lost), ["a.eds:11:14: GEN `300` is left out: 300 is outside the data type"]);
}

#[test]
fn limits_bind_what_clients_may_write() {
    let eds = [
        object("2000", "a", "DataType=6 AccessType=rw LowLimit=1"),
        object("2001", "b", "DataType=6 AccessType=ro LowLimit=1"),
        object("2002", "c", "DataType=6 AccessType=rw LowLimit=0 HighLimit=0xFFFF"),
    ]
    .concat();
    let layout = layout(&eds, "");
    assert_eq!(layout.limits, [Limits { position: Position(0), low: 1, high: 0xFFFF }]);
    let limited: Vec<bool> = layout.entries.iter().map(|entry| entry.flags.has(Flags::LIMITED)).collect();
    assert_eq!(limited, [true, false, false]);
}

fn parameters(saved: &[u8]) -> String {
    let subs = saved.iter().map(|sub| object(&format!("1010sub{sub:X}"), "x", "DataType=7 AccessType=rw"));
    let rest = [
        object("1010", "Store", "ObjectType=8"),
        object("1010sub0", "x", "DataType=5 AccessType=const DefaultValue=4"),
        object("1016", "a", "DataType=7 AccessType=rw"),
        object("1003", "b", "DataType=7 AccessType=rw"),
        object("1600", "c", "ObjectType=9"),
        object("1600sub0", "c", "DataType=5 AccessType=rw DefaultValue=1"),
        object("1600sub1", "c", "DataType=7 AccessType=rw DefaultValue=0x60400010"),
        object("6040", "d", "DataType=6 AccessType=rw PDOMapping=1"),
        object("6060", "e", "DataType=6 AccessType=rw PDOMapping=1"),
        object("6061", "f", "DataType=6 AccessType=rwr PDOMapping=1"),
        object("2000", "g", "DataType=6 AccessType=rw"),
        object("2001", "h", "DataType=6 AccessType=ro"),
    ];
    subs.chain(rest).collect()
}

#[test]
fn parameters_are_stored_in_their_group() {
    let groups = |saved: &[u8], side_file: &str| {
        let layout = layout(&parameters(saved), side_file);
        let stored = layout.entries.iter().filter_map(|entry| Some((entry.index.0, entry.flags.group()?.0)));
        stored.collect::<Vec<_>>()
    };
    let communication = [(0x1016, 2), (0x1600, 2), (0x1600, 2)];
    assert_eq!(groups(&[1], ""), [&communication[..], &[(0x2000, 4), (0x6060, 3)]].concat());
    assert_eq!(groups(&[1, 2], ""), communication);
    assert_eq!(groups(&[1, 3], ""), [(0x6060, 3)]);
    assert_eq!(groups(&[], ""), []);
    let side_file = "[storage]\n'1000-1FFF' = 'none'\n'2001' = 5\n'6060' = 'manufacturer'\n";
    assert_eq!(groups(&[1], side_file), [(0x2000, 4), (0x2001, 5), (0x6060, 4)]);
    assert_eq!(StorageGroup::MANUFACTURER.0, 4);
}

#[test]
fn a_side_file_adds_sub_objects() {
    let eds = object("2000", "Channel", "ObjectType=8")
        + &object("2000sub0", "n", "DataType=5 AccessType=ro DefaultValue=1")
        + &object("2000sub1", "x", "DataType=6 AccessType=rw")
        + &object("2001", "y", "DataType=6 AccessType=rw");
    let extra = |entries: &str| {
        format!(
            "[[extra]]\nentries = '{entries}'\nname = 'More'\ndata-type = 'INTEGER8'\naccess = 'ro'\ndefault = '-1'\n"
        )
    };
    let added = layout(&eds, &extra("2000sub2-3"));
    let places: Vec<_> = added.entries.iter().map(|entry| (entry.index.0, entry.sub_index.0)).collect();
    assert_eq!(places, [(0x2000, 0), (0x2000, 1), (0x2000, 2), (0x2000, 3), (0x2001, 0)]);
    assert!(entry(&added, 0x2000, 0).flags.has(Flags::VARIABLE), "the device says how many there are");
    assert_eq!(added.default_of(&entry(&added, 0x2000, 3)), [0xFF]);
    assert_eq!(added.sources[3].object.as_deref(), Some("Channel"));
    let refused = |entries: &str| messages(&parse(eds.as_bytes(), Some(&extra(entries))).unwrap_err());
    assert_eq!(refused("2000sub1-2"), ["a.toml:2:11: GEN 2000h sub-index 01h is in the dictionary already"]);
    assert_eq!(
        refused("2001sub1"),
        ["a.toml:2:11: GEN 2001h is described as a variable, which has no sub-objects"]
    );
}

#[test]
fn a_side_file_names_entries_of_some_configurations_and_units() {
    let eds =
        object("2000", "a", "DataType=6 AccessType=rw") + &object("2001", "b", "DataType=6 AccessType=rw");
    let layout = layout(&eds, "optional = ['2001', '3000']\n[unit]\n'2000-2001' = 'mm'\n");
    let optional: Vec<bool> = layout.entries.iter().map(|entry| entry.flags.has(Flags::OPTIONAL)).collect();
    assert_eq!(optional, [false, true]);
    assert!(layout.sources.iter().all(|source| source.unit.as_deref() == Some("mm")));
    assert_eq!(messages(&layout.notes), ["a.toml:1:21: GEN the dictionary has no such entry"]);
}

#[test]
fn a_side_file_names_what_the_device_changes() {
    let eds = object("1008", "a", "DataType=9 AccessType=const DefaultValue=Pump")
        + &object("1018", "b", "ObjectType=9")
        + &object("1018sub0", "b", "DataType=5 AccessType=ro DefaultValue=2")
        + &object("1018sub1", "b", "DataType=7 AccessType=ro DefaultValue=1")
        + &object("1018sub2", "b", "DataType=7 AccessType=ro DefaultValue=2")
        + &object("2000", "c", "DataType=15 AccessType=ro");
    let layout = layout(&eds, "variable = ['1008', '1018sub0', '1018sub2', '2000', '3000']\n");
    let variable: Vec<bool> = layout.entries.iter().map(|entry| entry.flags.has(Flags::VARIABLE)).collect();
    assert_eq!(variable, [true, true, false, true, false], "a domain lies nowhere");
    assert_eq!(layout.defaults, [&b"\x04\0Pump"[..], &[2], &[2, 0, 0, 0]].concat());
    assert_eq!(entry(&layout, 0x1018, 2).flags, Flags::READ.and(Flags::VARIABLE), "it is not stored");
    let domain = "a.toml:1:45: GEN 2000h is a DOMAIN, whose data the application has: it does not lie in RAM";
    assert_eq!(messages(&layout.notes), [domain, "a.toml:1:53: GEN the dictionary has no such entry"]);
}

#[test]
fn what_is_given_lies_in_ram_and_is_not_stored() {
    let eds = object("1008", "a", "DataType=9 AccessType=const DefaultValue=Pump")
        + &object("1018", "b", "ObjectType=9")
        + &object("1018sub4", "b", "DataType=7 AccessType=ro DefaultValue=2")
        + &object("1010", "c", "ObjectType=8")
        + &object("1010sub1", "c", "DataType=7 AccessType=rw");
    let layout =
        layout(&eds, "given = ['1008', '1018sub4']\n[capacity]\n'1008' = 9\n[storage]\n'1008' = 4\n");
    let given = Flags::READ.and(Flags::VARIABLE).and(Flags::GIVEN);
    assert_eq!((entry(&layout, 0x1008, 0).flags, entry(&layout, 0x1008, 0).size), (given, 9));
    assert_eq!(entry(&layout, 0x1018, 4).flags, given);
    assert_eq!(layout.default_of(&entry(&layout, 0x1018, 4)), [2, 0, 0, 0]);
    assert_eq!(messages(&layout.notes), ["a.toml:5:1: GEN 1008h is given at start, and so it is not stored"]);
}

#[test]
fn what_cannot_be_given_is_an_error() {
    let eds = object("1001", "a", "DataType=5 AccessType=ro")
        + &object("1014", "b", "DataType=7 AccessType=ro DefaultValue=$NODEID+0x80")
        + &object("2000", "c", "DataType=6 AccessType=rw")
        + &object("2001", "d", "DataType=15 AccessType=ro")
        + &object("2002", "e", "DataType=6 AccessType=ro PDOMapping=1");
    let reason = |place: &str| {
        let sheet = Datasheet::parse(eds.as_bytes());
        let side_file = format!("rpdo = ['2002']\ngiven = ['{place}']\n");
        let errors = lay_out(&sheet, &SideFile::parse(&side_file).unwrap()).unwrap_err();
        messages(&errors).join("\n").replace("a.toml:2:10: GEN ", "")
    };
    assert_eq!(reason("1001"), "1001h cannot be given: it tells what has happened since power-on");
    assert_eq!(reason("1014"), "1014h cannot be given: it follows the node-ID");
    assert_eq!(reason("2000"), "2000h cannot be given: clients write it");
    assert_eq!(reason("2001"), "2001h cannot be given: it is a DOMAIN, whose data the application has");
    assert_eq!(reason("2002"), "2002h cannot be given: RPDOs write it");
}

#[test]
fn what_has_no_effect_is_told_with_its_place() {
    let eds = object("2000", "a", "DataType=8 AccessType=rw")
        + &object("2001", "b", "DataType=6 AccessType=ro")
        + &object("2002", "c", "DataType=6 AccessType=const DefaultValue=1")
        + &object("2003", "d", "DataType=9 AccessType=rw DefaultValue=abcdef")
        + &object("2004", "e", "DataType=15 AccessType=rw");
    let told =
        |side_file: &str| messages(&layout(&eds, side_file).notes).join("\n").replace("a.toml:2:1: GEN ", "");
    let capacity = |place: &str, bytes: u8| told(&format!("[capacity]\n'{place}' = {bytes}\n"));
    assert_eq!(capacity("2000", 9), "only a text has a capacity: 2000h is REAL32, and has 4 bytes");
    assert_eq!(capacity("2004", 9), "only a text has a capacity: 2004h is DOMAIN");
    assert_eq!(capacity("2003", 3), "the default of 2003h has 6 bytes, and so has the text");
    assert_eq!((capacity("2003", 6), capacity("2000-2004", 9)), (String::new(), String::new()));
    let storage = |place: &str, group: &str| told(&format!("[storage]\n'{place}' = '{group}'\n"));
    assert!(
        storage("2001", "application")
            .starts_with("clients cannot write 2001h: what it has at the time of a save")
    );
    assert_eq!(storage("2001", "none"), "clients cannot write 2001h: it is not stored anyhow");
    assert_eq!(storage("2002", "application"), "2002h cannot change, and so it is not stored");
    assert!(storage("2004", "application").starts_with("2004h is a DOMAIN"));
    assert_eq!(
        (storage("2000", "none"), storage("2000-2004", "application")),
        (String::new(), String::new())
    );
    assert_eq!(told("variable = [\n'2000']\n"), "clients write 2000h: it lies in RAM anyhow");
    assert_eq!(
        told("given = ['2001']\nvariable = [\n'2001']\n").replace("a.toml:3:1: GEN ", ""),
        "2001h is given at start: it lies in RAM anyhow"
    );
}

#[test]
fn a_side_file_names_what_rpdos_write() {
    let eds = object("2000", "a", "DataType=6 AccessType=ro PDOMapping=1")
        + &object("2001", "b", "DataType=6 AccessType=const DefaultValue=1")
        + &object("2002", "c", "DataType=15 AccessType=ro")
        + &object("2003", "d", "DataType=6 AccessType=ro")
        + &object("1600", "e", "ObjectType=9")
        + &object("1600sub0", "e", "DataType=5 AccessType=ro DefaultValue=2")
        + &object("1600sub1", "e", "DataType=7 AccessType=ro DefaultValue=0x20000010")
        + &object("1600sub2", "e", "DataType=7 AccessType=ro DefaultValue=0x20010010");
    assert_eq!(layout(&eds, "").mapping_problems().len(), 2);
    let layout = layout(&eds, "rpdo = ['2000-2002', '3000sub1']\n");
    assert_eq!(layout.mapping_problems(), []);
    let of = |index| entry(&layout, index, 0).flags;
    let received = Flags::READ.and(Flags::RPDO).and(Flags::VARIABLE);
    assert_eq!(of(0x2000), received.and(Flags::TPDO));
    assert_eq!(of(0x2001), received);
    assert_eq!(of(0x2002), Flags::READ, "no PDO carries a domain");
    assert_eq!(of(0x2003), Flags::READ.and(Flags::VARIABLE));
    assert_eq!(messages(&layout.notes), ["a.toml:1:22: GEN the dictionary has no such entry"]);
    let domain = "a.toml:1:9: GEN no PDO carries DOMAIN, the type of 2002h";
    assert_eq!(messages(&self::layout(&eds, "rpdo = ['2002']\n").notes), [domain]);
}

#[test]
fn mappings_are_judged() {
    let mapping = |entries: &[&str]| {
        let head = object("1A00", "Mapping", "ObjectType=9")
            + &object("1A00sub0", "n", &format!("DataType=5 AccessType=rw DefaultValue={}", entries.len()));
        let entry = |(number, entry): (usize, &&str)| {
            object(
                &format!("1A00sub{}", number + 1),
                "m",
                &format!("DataType=7 AccessType=rw DefaultValue={entry}"),
            )
        };
        let objects = object("6041", "s", "DataType=6 AccessType=ro PDOMapping=1")
            + &object("6040", "c", "DataType=6 AccessType=rww PDOMapping=1")
            + &object("6042", "x", "DataType=0x1B AccessType=ro PDOMapping=1")
            + &object("6043", "x", "DataType=7 AccessType=ro");
        head + &entries.iter().enumerate().map(entry).collect::<String>() + &objects
    };
    let problems = |entries: &[&str]| {
        let lines = messages(&layout(&mapping(entries), "").mapping_problems());
        lines.iter().map(|line| line.split_once("GEN ").unwrap().1.to_owned()).collect::<Vec<_>>()
    };
    assert!(problems(&["0x60410010"]).is_empty());
    assert!(problems(&["0", "0"]).is_empty(), "room for entries");
    assert_eq!(
        problems(&["0x60410008"]),
        ["TPDO1 cannot carry 6041h sub-index 00h with 8 bits: it has another length"]
    );
    assert_eq!(
        problems(&["0x60400010"]),
        ["TPDO1 cannot carry 6040h sub-index 00h with 16 bits: it can be mapped in the other direction only"]
    );
    assert_eq!(
        problems(&["0x60430020"]),
        ["TPDO1 cannot carry 6043h sub-index 00h with 32 bits: it cannot be mapped"]
    );
    assert_eq!(
        problems(&["0x60500020"]),
        ["TPDO1 cannot carry 6050h sub-index 00h with 32 bits: there is no such entry"]
    );
    assert_eq!(
        problems(&["0x00050008"]),
        ["TPDO1 cannot carry 0005h sub-index 00h with 8 bits: a TPDO has no gaps"]
    );
    assert_eq!(problems(&["0x60420040", "0x60410010"]), ["TPDO1 carries 80 bits, and a PDO has 64"]);
}

#[test]
fn the_fingerprint_is_that_of_the_structure() {
    let of = |keys: &str| layout(&object("2000", "x", keys), "").fingerprint;
    let first = of("DataType=6 AccessType=rw DefaultValue=1");
    assert_eq!(of("DataType=6 AccessType=rw DefaultValue=2"), first);
    assert_ne!(of("DataType=5 AccessType=rw DefaultValue=1"), first);
}

#[test]
fn what_cannot_be_addressed_is_refused() {
    let text =
        object("2000", "x", "DataType=9 AccessType=rw") + &object("2001", "y", "DataType=9 AccessType=rw");
    let refused = parse(text.as_bytes(), Some("[capacity]\n'2000-2001' = 40000\n")).unwrap_err();
    assert_eq!(
        messages(&refused),
        ["a.eds:5:2: GEN the values of this entry and those before it take more than 65535 bytes"]
    );
    let many: String = (0x2000..0x2200)
        .map(|index| {
            object(&format!("{index:X}"), "x", "ObjectType=8 DataType=5 AccessType=rw CompactSubObj=254")
        })
        .collect();
    let refused = parse(many.as_bytes(), None).unwrap_err();
    assert!(
        messages(&refused)[0].ends_with("this is one entry more than the 65535 that a dictionary can have")
    );
}

/// A device with these objects besides the mandatory ones.
fn with_mandatory(objects: &str) -> String {
    let mandatory = [
        object("1000", "Type", "DataType=7 AccessType=ro DefaultValue=0"),
        object("1001", "Errors", "DataType=5 AccessType=ro DefaultValue=0"),
        object("1018", "Identity", "ObjectType=9"),
        object("1018sub0", "n", "DataType=5 AccessType=ro DefaultValue=1"),
        object("1018sub1", "v", "DataType=7 AccessType=ro DefaultValue=5"),
    ];
    format!("{}{objects}", mandatory.concat())
}

/// The default of an entry as a number, and whether the node-ID is added.
fn value(layout: &Layout, index: u16, sub_index: u8) -> (u64, bool) {
    let entry = entry(layout, index, sub_index);
    let bytes = layout.default_of(&entry);
    let number = bytes.iter().rev().fold(0, |number, byte| number << 8 | u64::from(*byte));
    (number, entry.flags.has(Flags::NODE_RELATIVE))
}

/// A record or array without any value: sub-index 00h, and these further ones of 32 bits.
fn without_values(index: &str, subs: &[u8]) -> String {
    let header = object(index, "x", "ObjectType=9");
    let count = object(&format!("{index}sub0"), "n", "DataType=5 AccessType=ro");
    let elements =
        subs.iter().map(|sub| object(&format!("{index}sub{sub:X}"), "e", "DataType=7 AccessType=rw"));
    format!("{header}{count}{}", elements.collect::<String>())
}

#[test]
fn what_is_meant_is_laid_out_as_if_it_were_written_so() {
    let right = "DataType=0x0006 AccessType=rw DefaultValue=1000 LowLimit=10 PDOMapping=1";
    let right = layout(&object("2000", "x", right), "");
    let written = "[2000h]\nParameterName=x\nObjectType=VAR\nDataType=0x0006 ; UNSIGNED16\nAccessType=R/W\n\
        DefaultValue=1000; ms\nLowLimit=0x0x0A\nPDOMapping=yes\n";
    let meant = layout(written, "");
    assert_eq!(
        (&meant.entries, &meant.defaults, &meant.limits),
        (&right.entries, &right.defaults, &right.limits)
    );
    assert_eq!((messages(&meant.lost), messages(&right.assumptions)), (vec![], vec![]));
    assert_eq!(
        messages(&meant.assumptions),
        [
            "a.eds:1:2: GEN 7 values are read as they were meant, as here `2000h` as `2000` (`edskit show --meant` with the \
          file lists them, `edskit lint --fix` mends them)"
        ]
    );
    for (written, data_type, bytes) in [
        ("$NODEID + 180h", 7, vec![0x80, 1, 0, 0]),
        ("1,5", 8, 1.5_f32.to_le_bytes().to_vec()),
        ("true", 1, vec![1]),
        ("01 02 ; two", 10, vec![1, 2]),
        ("365 43200000", 12, vec![0x00, 0x2E, 0x93, 0x02, 0x6D, 0x01]),
        ("0x1234 5678", 7, vec![0x78, 0x56, 0x34, 0x12]),
    ] {
        let text = format!(
            "[2000]\nParameterName=x\nDataType={data_type}\nAccessType=const\nDefaultValue={written}\n"
        );
        let layout = layout(&text, "");
        assert_eq!(layout.default_of(&entry(&layout, 0x2000, 0)), bytes, "{written}");
    }
}

#[test]
fn a_range_type_brings_its_limits() {
    let eds = "[A0]\nObjectType=6\n[A0sub1]\nDefaultValue=3\n[A0sub2]\nDefaultValue=-100\n[A0sub3]\nDefaultValue=100\n\
        [2000]\nDataType=0x00A0\nAccessType=rw\nDefaultValue=25\n\
        [2001]\nObjectType=8\nDataType=0xA0\nAccessType=rw\nCompactSubObj=1\n";
    let layout = layout(eds, "");
    assert_eq!(entry(&layout, 0x2000, 0).data_type, DataType::Integer16);
    assert_eq!(value(&layout, 0x2000, 0), (25, false));
    let (low, high) = (-100_i64 as u64, 100);
    let limits = [Position(0), Position(2)].map(|position| Limits { position, low, high });
    assert_eq!(layout.limits, limits);
    assert_eq!(messages(&layout.lost), [""; 0]);
}

#[test]
fn what_an_eds_leaves_out_has_the_default_of_cia_301() {
    let vars = ["1005", "1012", "1014"].map(|index| object(index, "x", "DataType=7 AccessType=rw"));
    let records = [
        without_values("1003", &[1, 2]),
        without_values("1010", &[1, 3]),
        without_values("1200", &[1, 2]),
        without_values("1201", &[1, 2]),
        without_values("1403", &[1]),
        without_values("1404", &[1]),
        without_values("1800", &[1]),
        without_values("1A00", &[1, 2]),
        without_values("2000", &[1, 4]),
    ];
    let objects = format!("{}{}", vars.concat(), records.concat());
    let eds = with_mandatory(&objects);
    let with_defaults = device(&eds);
    for (index, sub_index, wanted) in [
        (0x1005, 0, (0x80, false)),
        (0x1012, 0, (0x100, false)),
        (0x1014, 0, (0x80, true)),
        (0x1003, 0, (0, false)),
        (0x1010, 0, (3, false)),
        (0x1200, 0, (2, false)),
        (0x1200, 1, (0x600, true)),
        (0x1200, 2, (0x580, true)),
        (0x1201, 2, (0x8000_0000, false)),
        (0x1403, 1, (0x500, true)),
        (0x1404, 1, (0x8000_0000, false)),
        (0x1800, 1, (0x180, true)),
        (0x1A00, 0, (0, false)),
        (0x2000, 0, (4, false)),
        (0x2000, 1, (0, false)),
    ] {
        assert_eq!(value(&with_defaults, index, sub_index), wanted, "{index:X}:{sub_index:02X}");
    }
    assert_eq!(
        messages(&with_defaults.assumptions),
        [
            "a.eds:24:2: GEN 17 entries have no value in the file, and what CiA 301 gives: 1005h = 0x80, 1010h sub-index 00h = \
          3h, 1012h = 0x100, 1014h = $NODEID+0x80, 1200h sub-index 00h = 2h, 1200h sub-index 01h = $NODEID+0x600, and 11 more"
        ]
    );
    let configured = layout(&eds, "");
    assert_eq!(messages(&configured.assumptions), [""; 0]);
    assert_eq!(value(&configured, 0x1014, 0), (0, false));
}

#[test]
fn what_a_file_says_is_not_replaced() {
    let objects = [
        object("1014", "x", "DataType=7 AccessType=rw DefaultValue=0x85"),
        without_values("1600", &[2]).replace("AccessType=ro\n", "AccessType=rw\nDefaultValue=1\n"),
        object("1600sub1", "e", "DataType=7 AccessType=rw DefaultValue=0x20000010"),
    ];
    let layout = device(&with_mandatory(&objects.concat()));
    assert_eq!((value(&layout, 0x1014, 0), value(&layout, 0x1600, 0)), ((0x85, false), (1, false)));
    assert_eq!(messages(&layout.assumptions), [""; 0]);
}

#[test]
fn mandatory_objects_are_added_to_an_eds() {
    let info = "[DeviceInfo]\nVendorNumber=0x1B7 ; ours\nProductNumber=0x51\nRevisionNumber=0x00010000\n[MandatoryObjects]\n";
    let eds = format!("{info}{}", object("1017", "x", "DataType=6 AccessType=rw DefaultValue=0"));
    let complete = device(&eds);
    let entries: Vec<_> = complete.entries.iter().map(|entry| (entry.index.0, entry.sub_index.0)).collect();
    let identity = [(0x1018, 0), (0x1018, 1), (0x1018, 2), (0x1018, 3)];
    assert_eq!(entries[..3], [(0x1000, 0), (0x1001, 0), (0x1017, 0)]);
    assert_eq!(entries[3..], identity);
    assert_eq!([1, 2, 3].map(|sub| value(&complete, 0x1018, sub).0), [0x1B7, 0x51, 0x10000]);
    assert_eq!(
        messages(&complete.assumptions)[1..],
        [
            "a.eds:5:2: GEN the mandatory object 1000h is missing in the file, and is added with 0",
            "a.eds:5:2: GEN the mandatory object 1001h is missing in the file, and is added with 0",
            "a.eds:5:2: GEN the mandatory object 1018h is missing in the file, and is added with the numbers of [DeviceInfo]",
        ]
    );
    assert_eq!(layout(&eds, "").entries.len(), 1, "a DCF is not changed");
    assert!(device("[FileInfo]\n").entries.is_empty(), "a file without any object is no device");
}

#[test]
fn a_missing_sub_index_00h_is_added() {
    let eds = with_mandatory(
        &[object("2000", "x", "ObjectType=8"), object("2000sub3", "e", "DataType=5 AccessType=rw")].concat(),
    );
    let layout = device(&eds);
    assert_eq!(value(&layout, 0x2000, 0), (3, false));
    assert_eq!(
        messages(&layout.assumptions),
        ["a.eds:24:2: GEN sub-index 00h of 2000h is missing in the file, and is added with 3"]
    );
}

#[test]
fn the_error_history_begins_empty_and_can_be_cleared_in_every_form() {
    let long = [
        object("1003", "x", "ObjectType=8"),
        object("1003sub0", "n", "DataType=5 AccessType=ro DefaultValue=8 ParameterValue=2"),
        object("1003sub1", "e", "DataType=7 AccessType=ro DefaultValue=0x8130"),
    ];
    let compact = object("1003", "x", "ObjectType=8 DataType=7 AccessType=ro CompactSubObj=8");
    let register = object("1001", "e", "DataType=5 AccessType=ro DefaultValue=0x11");
    for (eds, notes) in [(long.concat(), 2), (compact, 0)] {
        for layout in [layout(&format!("{register}{eds}"), ""), device(&format!("{register}{eds}"))] {
            assert_eq!(
                (value(&layout, 0x1003, 0), value(&layout, 0x1003, 1)),
                ((0, false), (0, false)),
                "{eds}"
            );
            assert_eq!(value(&layout, 0x1001, 0), (0, false));
            assert!(entry(&layout, 0x1003, 0).flags.has(Flags::READ.and(Flags::WRITE).and(Flags::VARIABLE)));
            assert!(!entry(&layout, 0x1003, 1).flags.has(Flags::WRITE));
            assert_eq!(layout.notes.len(), notes + 1, "{:?}", messages(&layout.notes));
        }
    }
}

#[test]
fn the_data_of_a_domain_are_left_out_and_told() {
    let eds = [
        object("2000", "a", "ObjectType=2 DataType=15 DefaultValue=0102030405"),
        object("2001", "b", "DataType=15 AccessType=rw ParameterValue=01"),
        object("2002", "c", "ObjectType=2 UploadFile=trace.bin"),
    ];
    assert_eq!(
        messages(&layout(&eds.concat(), "").notes),
        [
            "a.eds:5:14: GEN `0102030405` is left out: the application has the data of a DOMAIN",
            "a.eds:10:16: GEN `01` is left out: the application has the data of a DOMAIN",
        ]
    );
}

#[test]
fn cob_ids_that_cannot_be_used_are_told() {
    let pdo = |index: &str, value: &str| {
        let keys = format!("DataType=7 AccessType=rw DefaultValue={value}");
        format!("{}{}", object(index, "x", "ObjectType=9"), object(&format!("{index}sub1"), "c", &keys))
    };
    let told = |eds: &str, node_id: Option<u8>| {
        let problems =
            layout(eds, "").cob_id_problems(node_id.map(|id| edskit_types::NodeId::new(id).unwrap()));
        messages(&problems).join("|")
    };
    let help = " (set bit 31, as in `0x80000000`, if it is not meant to be)";
    assert_eq!(
        told(&pdo("1800", "0"), Some(5)),
        format!("a.eds:8:14: GEN TPDO1 is not in use: the CAN-ID 000h is restricted: 000h (NMT){help}")
    );
    for (index, value, reason) in [
        ("1401", "0x601", "RPDO2 is not in use: the CAN-ID 601h is restricted: 601h to 67Fh (default SDO)"),
        ("1806", "0x180", "TPDO7 is not in use: the CAN-ID 180h is restricted: 101h to 180h (reserved)"),
        ("1800", "0x20000185", "TPDO1 is not in use: CAN-IDs of 29 bits are not supported"),
        ("1400", "0x1185", "RPDO1 is not in use: bits 28 to 11 are not 0"),
        (
            "1201",
            "0x701",
            "SDO server 2 request is not in use: the CAN-ID 701h is restricted: 701h to 77Fh (NMT error control)",
        ),
        (
            "1804",
            "$NODEID+0x680",
            "TPDO5 is not in use at node-IDs 96 to 127: the CAN-ID 6E0h is restricted: 6E0h to 6FFh (reserved)",
        ),
    ] {
        assert_eq!(told(&pdo(index, value), None), format!("a.eds:8:14: GEN {reason}{help}"));
    }
    assert_eq!(told(&pdo("1804", "$NODEID+0x680"), Some(5)), "");
    for (index, value, reason) in [
        ("1005", "0", "SYNC is not in use: the CAN-ID 000h is restricted: 000h (NMT)"),
        ("1005", "0x80000000", "SYNC is not in use: the CAN-ID 000h is restricted: 000h (NMT)"),
        (
            "1012",
            "0x80000701",
            "TIME is not in use: the CAN-ID 701h is restricted: 701h to 77Fh (NMT error control)",
        ),
        ("1014", "0", "EMCY is not in use: the CAN-ID 000h is restricted: 000h (NMT)"),
    ] {
        let keys = format!("DataType=7 AccessType=rw DefaultValue={value}");
        let found = told(&object(index, "x", &keys), None);
        assert!(found.starts_with(&format!("a.eds:5:14: GEN {reason}")), "{found}");
    }
    for (index, value) in
        [("1800", "0x80000000"), ("1800", "0xC0000000"), ("1400", "0x181"), ("1201", "0x605")]
    {
        assert_eq!(told(&pdo(index, value), None), "", "{index} {value}");
    }
    for (index, value) in
        [("1012", "0"), ("1005", "0x40000080"), ("1014", "$NODEID+0x80"), ("1014", "0x80000000")]
    {
        let keys = format!("DataType=7 AccessType=rw DefaultValue={value}");
        assert_eq!(told(&object(index, "x", &keys), None), "", "{index} {value}");
    }
    let implicit = device("[DeviceInfo]\nCompactPDO=0x13\nNrOfRXPDO=5\nNrOfTXPDO=5\n");
    assert_eq!((implicit.cob_ids.len(), implicit.cob_id_problems(None).len()), (10, 0));
}

#[test]
fn device_info_says_what_a_node_may() {
    let of = |keys: &str| {
        let text = format!("[DeviceInfo]\n{}\n", keys.replace(' ', "\n"));
        layout(&(text + &object("2000", "x", "DataType=6 AccessType=rw PDOMapping=1")), "").settings
    };
    let nothing = of("VendorName=edskit");
    assert_eq!((nothing.bit_rates, nothing.has_lss, nothing.granularity), (BitRates::ALL, true, 1));
    assert!(!nothing.starts_by_itself);
    let some = of("BaudRate_10=0 BaudRate_125=1 BaudRate_500=0x1 LSS_Supported=0 Granularity=8");
    assert_eq!(some.bit_rates, BitRates::NONE.and(Bitrate::Kbit125).and(Bitrate::Kbit500));
    assert_eq!((some.has_lss, some.granularity), (false, 8));
    assert_eq!(of("BaudRate_10=0 BaudRate_20=0").bit_rates, BitRates::NONE);
    for (keys, starts) in [
        ("SimpleBootUpMaster=1 SimpleBootUpSlave=0", true),
        ("SimpleBootUpMaster=1 SimpleBootUpSlave=1", false),
        ("SimpleBootUpMaster=0 SimpleBootUpSlave=0", false),
        ("SimpleBootUpMaster=1", false),
    ] {
        assert_eq!(of(keys).starts_by_itself, starts, "{keys}");
    }
}

#[test]
fn a_granularity_that_the_file_contradicts_counts_as_1() {
    let eds = "[DeviceInfo]\nGranularity=64\n".to_owned()
        + &object("1A00sub1", "x", "DataType=7 AccessType=rw DefaultValue=0x20000010")
        + &object("2000", "x", "DataType=6 AccessType=rw PDOMapping=1");
    let layout = layout(&eds, "");
    assert_eq!(layout.settings.granularity, 1);
    let said = messages(&layout.assumptions);
    let expected = "a.eds:2:13: GEN Granularity 64 counts as 1, because 2000h sub-index 00h with its 16 bits can be mapped";
    assert!(said.iter().any(|line| line == expected), "{said:#?}");
}

#[test]
fn a_mapping_of_a_pdo_that_does_not_exist_stops_nothing() {
    let mapping = "[1A00]\nObjectType=9\n[1A00sub0]\nDataType=5\nDefaultValue=1\n[1A00sub1]\nDataType=7\nDefaultValue=0x20000010\n";
    let severity = |cob_id: &str| {
        let communication =
            format!("[1800]\nObjectType=9\n[1800sub1]\nDataType=7\nAccessType=rw\nDefaultValue={cob_id}\n");
        let problems = layout(&format!("{communication}{mapping}"), "").mapping_problems();
        problems.iter().map(|problem| problem.severity).collect::<Vec<_>>()
    };
    assert_eq!(severity("$NODEID+0x80000180"), [Severity::Warning]);
    assert_eq!(severity("$NODEID+0x180"), [Severity::Error]);
    let alone = layout(mapping, "").mapping_problems();
    assert_eq!(alone[0].severity, Severity::Error, "nothing says that it does not exist");
}
