use super::*;
use crate::same_meaning;
use proptest::prelude::*;

fn formatted(text: &str) -> String {
    String::from_utf8(checked(text.as_bytes())).unwrap()
}

/// Formats, and checks what always holds.
fn checked(bytes: &[u8]) -> Vec<u8> {
    let before = Datasheet::parse(bytes);
    let text = format(&before);
    let after = Datasheet::parse(&text);
    let shown = String::from_utf8_lossy(&text);
    assert_eq!(same_meaning(&before, &after), Ok(()), "{shown}");
    assert_eq!(String::from_utf8_lossy(&format(&after)), shown);
    text
}

const MESSY: &str = "

   ; pump station, drawn up by hand

; objects of the pump
[ManufacturerObjects]
SupportedObjects = 0x02
2=0x2001
1=0x2000
[2000]
parametername= Pressure\t
datatype = 4
AccessType=RO
; must stay below the burst pressure
highlimit=0x0000ffff
LOWLIMIT=-0X10
PDOMapping=1
Unit=mbar
ObjectType=0x07
; calibrated at 20 degrees

; the old valve, see service note 12
[2001]
ObjectType=8
SubNumber=2
ParameterName=Valve
[2001SUB01]
ParameterName=Opening
DataType=0x5
AccessType=RWW
DefaultValue=0x7
[2001sub0]
ParameterName=Highest sub-index
DataType=0x5
AccessType=const
DefaultValue=1

[Plant]
Line = 4
[MandatoryObjects]
supportedobjects=3
3=0x1018
1=0x1000
2=0x1001
[1001]
ParameterName=Error register
DataType=5
this line lost its equals sign
AccessType = ro
[1000]
DataType=0x7
ParameterName=Device type
AccessType=ro
AccessType=rw
DefaultValue=0x191
[1014]
ParameterName=COB-ID EMCY
DataType=7
AccessType=rw
DefaultValue=0x00000080 + $NodeID
[DeviceInfo]
LSS_Supported=1
vendornumber=0x319
VendorName=Example
[fileinfo]
EDSVersion=4.0
FileName=pump.eds
; end of file
";

#[test]
fn a_messy_file_becomes_tidy() {
    insta::assert_snapshot!(formatted(MESSY));
}

#[test]
fn sections_stand_in_one_order() {
    let text = "[6000]\n[M1SubExt6000]\n[2000sub1]\n[ManufacturerObjects]\n1=0x2000\n[1000]\n[ConnectedModules]\n[SupportedModules]\n[MandatoryObjects]\n1=0x1000\n[M1Fixed2000sub1]\n[M1Fixed2000]\n[M1ModuleInfo]\n[M1Fixed1000]\n[2000]\n[2000Value]\n[2000ObjectLinks]\n[Comments]\n[DeviceInfo]\n[FileInfo]\n[0005]\n[OptionalObjects]\n[DummyUsage]\n[1018]\n[Tool2]\n[Tools]\n[Tool1]\n[DynamicChannels]\n[DeviceComissioning]\n";
    let order: Vec<_> =
        formatted(text).lines().filter(|line| line.starts_with('[')).map(str::to_owned).collect();
    assert_eq!(
        order.join(""),
        "[FileInfo][DeviceInfo][DeviceComissioning][DummyUsage][Comments][Tools][Tool1][Tool2][DynamicChannels][SupportedModules][M1ModuleInfo][M1Fixed1000][M1Fixed2000][M1Fixed2000sub1][M1SubExt6000][ConnectedModules][5][MandatoryObjects][1000][1018][OptionalObjects][6000][ManufacturerObjects][2000][2000sub1][2000ObjectLinks][2000Value]"
    );
}

#[test]
fn names_and_keys_are_spelled_as_in_the_specification() {
    assert_eq!(
        formatted(
            "[ 1a00SUB0A ]\nparametername = a b \n[devicecommissioning]\nnodeid=5\n[ My Section ]\nMy Key = 1\n"
        ),
        "[DeviceComissioning]\nNodeID=5\n\n[My Section]\nMy Key=1\n\n[1A00subA]\nParameterName=a b\n"
    );
}

#[test]
fn entries_stand_in_one_order_and_unknown_ones_follow() {
    assert_eq!(
        formatted(
            "[1000]\nFirst=1\nPDOMapping=0\nVendor=2\nAccessType=ro\nParameterName=a\nvendor=3\nAccessType=rw\n"
        ),
        "[1000]\nFirst=1\nParameterName=a\nAccessType=ro\nAccessType=rw\nPDOMapping=0\nVendor=2\nvendor=3\n"
            .replace("ro\nAccessType=rw\n", "ro\nvendor_\nAccessType=rw\n")
            .replace("vendor_\n", "")
    );
    assert_eq!(
        formatted("[DynamicChannels]\nDir2=ro\nType1=0x5\nDir1=RWW\nNrOfSeg=2\nType2=5\n"),
        "[DynamicChannels]\nNrOfSeg=2\nType1=0x0005\nDir1=rww\nType2=5\nDir2=ro\n"
    );
    assert_eq!(
        formatted("[MandatoryObjects]\n2=0x1001\n10=0x1018\n1=4096\nSupportedObjects=3\n"),
        "[MandatoryObjects]\nSupportedObjects=3\n1=4096\n2=0x1001\n10=0x1018\n"
    );
}

#[test]
fn a_nodelist_keeps_its_order() {
    let text = "[Topology2]\nNode2Present=0x01\nNodes=0x01\n\n[Topology]\nNodes=0x00\nx=y\n";
    assert_eq!(formatted(text), text);
}

#[test]
fn hexadecimal_numbers_have_the_width_of_their_type() {
    let value = |data_type: u16, value: &str| {
        let text = formatted(&format!("[2000]\nDataType={data_type}\nDefaultValue={value}\n"));
        text.trim_end().rsplit('=').next().unwrap().to_owned()
    };
    for (data_type, before, after) in [
        (5, "0X1a", "0x1A"),
        (6, "0x1a", "0x001A"),
        (7, "0x000000001a", "0x0000001A"),
        (0x16, "0x1", "0x000001"),
        (6, "0x12345", "0x12345"),
        (6, "26", "26"),
        (6, "017", "017"),
        (3, "0x7f", "0x007F"),
        (3, "0xff9c", "0xFF9C"),
        (3, "0xffffff9c", "0xFFFFFF9C"),
        (3, "0x000000ff", "0x000000FF"),
        (3, "-0X0a", "-0x0A"),
        (3, "+0x0a", "+0x0a"),
        (1, "0x01", "0x1"),
        (8, "0x3f800000", "0x3F800000"),
        (8, "0x0", "0x00000000"),
        (8, "1.50", "1.50"),
        (0xC, "0xab", "0x0000000000AB"),
        (0xA, "ab", "ab"),
        (9, "0x1a", "0x1a"),
        (0x40, "0x1a", "0x1a"),
        (6, "0x1a ; x", "0x1a ; x"),
    ] {
        assert_eq!(value(data_type, before), after, "{data_type}: {before}");
    }
}

#[test]
fn formulas_begin_with_the_node_id() {
    let value = |value: &str| {
        let text = formatted(&format!("[1800sub1]\nDataType=7\nDefaultValue={value}\n"));
        text.trim_end().rsplit('=').next().unwrap().to_owned()
    };
    for (before, after) in [
        ("0X180 + $NodeId", "$NODEID+0x180"),
        ("$NODEID+0x00000180", "$NODEID+0x180"),
        ("$NODEID + 384", "$NODEID+384"),
        ("0x100+$NODEID+0x80", "$NODEID+0x100+0x80"),
        ("$nodeid", "$NODEID"),
        ("$NODEID*2", "$NODEID*2"),
        ("$nodeid-1", "$nodeid-1"),
    ] {
        assert_eq!(value(before), after, "{before}");
    }
}

#[test]
fn keys_have_their_own_widths() {
    assert_eq!(
        formatted(
            "[DeviceInfo]\nVendorNumber=0x2d\nGranularity=0x08\nCompactPDO=0x3\nLSS_Supported=0x01\n[1000]\nObjectType=0x07\nSubNumber=0x0b\nObjFlags=0x00000000\n[1000Value]\n1=0x1\n[1000Name]\n1=0x1\n[1000ObjectLinks]\n1=0x7\n"
        ),
        "[DeviceInfo]\nVendorNumber=0x0000002D\nGranularity=0x08\nCompactPDO=0x03\nLSS_Supported=0x1\n\n[1000]\nObjectType=0x7\nSubNumber=0xB\nObjFlags=0x0\n\n[1000ObjectLinks]\n1=0x0007\n\n[1000Name]\n1=0x1\n\n[1000Value]\n1=0x1\n"
    );
}

#[test]
fn comments_travel_with_what_they_precede() {
    assert_eq!(
        formatted(
            "\n\n; licence\n\n  ; about 2000\n[2000]\n; type\nDataType=5\n\n; name\nParameterName=a\n; after 2000\n\n; above\n\n; directly above\n[1000]\nx=1\n; end of 1000\n\n; end of file\n\n"
        ),
        "; licence\n\n; about 2000\n\n; above\n\n; directly above\n[1000]\nx=1\n\n[2000]\n; name\nParameterName=a\n; type\nDataType=5\n; after 2000\n\n; end of 1000\n\n; end of file\n"
    );
    assert_eq!(formatted("; a\n[1000]\n; b\n[1001]\n; c"), "; a\n[1000]\n\n; b\n[1001]\n; c\n");
    assert_eq!(formatted("; only\n\n\n; comments"), "; only\n\n; comments\n");
}

#[test]
fn sections_with_errors_are_left_alone_behind_their_predecessor() {
    assert_eq!(
        formatted("[6000]\nDataType = 5\n[2000] ; here\n  DataType = 6\n\n  what\n\n; x\n[1000]\nb = 1\n"),
        "; x\n[1000]\nb=1\n\n[6000]\nDataType=5\n\n[2000] ; here\n  DataType = 6\n\n  what\n"
    );
    assert_eq!(formatted("[6000\na = 1\n[1000]\na = 1\n"), "[6000\na = 1\n\n[1000]\na=1\n");
}

#[test]
fn doubled_sections_do_not_overtake_each_other() {
    assert_eq!(
        formatted("[6000]\n[2000]\nx = 1\nwhat\n[1000]\n[2000]\nx = 2\n"),
        "[6000]\n\n[2000]\nx = 1\nwhat\n\n[1000]\n\n[2000]\nx=2\n"
    );
    assert_eq!(
        formatted("[2000]\nx=1\n[Own]\na=1\n[1000]\n[own]\na=2\n[2000]\nx=2\n"),
        "[1000]\n\n[2000]\nx=1\n\n[Own]\na=1\n\n[own]\na=2\n\n[2000]\nx=2\n"
    );
}

#[test]
fn text_before_the_first_section_is_copied() {
    assert_eq!(
        formatted("\n; a\nb = 1\n\n  c\n; d\n\n; e\n[1000]\n"),
        "; a\nb = 1\n\n  c\n; d\n\n; e\n[1000]\n"
    );
}

#[test]
fn a_merge_conflict_is_not_touched() {
    for text in [
        "[2000]\nx = 1\n<<<<<<< HEAD\n=======\n>>>>>>> other\n[1000]",
        "[2000]\nx = 1\n=======\n[1000]",
        "[2000]\nx = 1\n||||||| base\n[1000]",
    ] {
        assert_eq!(formatted(text), text);
        assert_eq!(try_format(&Datasheet::parse(text.as_bytes())), Err(Unformattable::Conflict(2)));
    }
    let text = "[2000]\nx = 1\n  <<<<<<< a=b\n";
    assert_eq!(formatted(text), text);
}

#[test]
fn line_endings_are_those_of_most_lines() {
    assert_eq!(formatted("[1000]\r\na=1\r\n[1001]\nb"), "[1000]\r\na=1\r\n\r\n[1001]\r\nb\r\n");
    assert_eq!(formatted("[1000]\ra=1"), "[1000]\ra=1\r");
    assert_eq!(formatted(""), "");
    assert_eq!(formatted("\n \n"), "");
}

#[test]
fn bytes_of_texts_stay_and_the_byte_order_mark_goes() {
    assert_eq!(checked(b"[FileInfo]\nCreatedBy= M\xFCller "), b"[FileInfo]\nCreatedBy=M\xFCller\n");
    assert_eq!(formatted("\u{FEFF}[FileInfo]\nCreatedBy=Müller"), "[FileInfo]\nCreatedBy=Müller\n");
    let text = "\u{FEFF}\u{FEFF}[FileInfo]\n[1000]";
    assert_eq!(formatted(text), text);
}

/// Lines that get into each other's way.
const LINES: &[&str] = &[
    "[1000]",
    "[2000]",
    "[2000sub1]",
    "[2000value]",
    "[01001]",
    "[1001",
    "[ 1000 ] ;",
    "[]",
    "[Own]",
    "[ own ]",
    "[other]",
    "[FileInfo]",
    "[OptionalObjects]",
    "[MandatoryObjects]",
    "[Topology]",
    "[M1Fixed2000sub1]",
    "DataType=7",
    "datatype = 3",
    "DataType=",
    "DefaultValue=0xfffe",
    "DefaultValue=0x1+$nodeid",
    "Own=1",
    " own = 2 ",
    "AccessType=RW",
    "1=0x2000",
    "01=4096",
    "2=0x1000",
    "; a",
    " ;b ",
    "# c",
    "",
    " \t",
    "what",
    "=",
    " <<<<<<< a=b",
    "<<<<<<< HEAD",
    "=======",
    "\u{FEFF}",
    "\u{FEFF}[1000]",
    "VendorName=\u{FC}",
];

proptest! {
    #[test]
    fn any_lines_are_formatted_once(lines in proptest::collection::vec(
        (proptest::sample::select(LINES), proptest::sample::select(&["\n", "\n", "\n\n", "\r\n", "\r", ""])),
        0..40,
    )) {
        let text: String = lines.into_iter().flat_map(|(line, ending)| [line, ending]).collect();
        checked(text.as_bytes());
    }

    #[test]
    fn any_bytes_are_formatted_once(bytes in proptest::collection::vec(any::<u8>(), 0..80)) {
        checked(&bytes);
    }
}
