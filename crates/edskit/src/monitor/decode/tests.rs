mod following;
mod lengths;

use super::*;
use crate::live::KnownDevice;
use crate::monitor::render::Report;
use edskit_model::Datasheet;
use edskit_types::CanId;

/// A device with values of several types, and PDOs that are not where the pre-defined connection set has them.
const EDS: &str = "\
[1014]\nParameterName=COB-ID EMCY\nDataType=7\nAccessType=ro\nDefaultValue=$NODEID+0x80\n\
[1017]\nParameterName=Heartbeat time\nDataType=6\nAccessType=rw\n\
[1800]\nParameterName=TPDO 1\nObjectType=9\n\
[1800sub1]\nParameterName=COB-ID\nDataType=7\nAccessType=rw\nDefaultValue=$NODEID+0x400001A0\n\
[1A00]\nParameterName=Mapping 1\nObjectType=9\n\
[1A00sub0]\nParameterName=Count\nDataType=5\nAccessType=rw\nDefaultValue=4\n\
[1A00sub1]\nParameterName=1\nDataType=7\nAccessType=rw\nDefaultValue=0x20000001\n\
[1A00sub2]\nParameterName=2\nDataType=7\nAccessType=rw\nDefaultValue=0x00050007\n\
[1A00sub3]\nParameterName=3\nDataType=7\nAccessType=rw\nDefaultValue=0x20010110\n\
[1A00sub4]\nParameterName=4\nDataType=7\nAccessType=rw\nDefaultValue=0x20020020\n\
[2000]\nParameterName=Is open\nDataType=1\nAccessType=ro\nPDOMapping=1\n\
[2001]\nParameterName=Pressure\nObjectType=8\n\
[2001sub1]\nParameterName=Inlet\nDataType=3\nAccessType=ro\nPDOMapping=1\n\
[2002]\nParameterName=Flow\nDataType=8\nAccessType=ro\nPDOMapping=1\n\
[2003]\nParameterName=Location\nDataType=9\nAccessType=rw\n\
";

/// Decodes frames that are given as `605h 40 17 10`, and prints each as people see it.
struct Screen {
    decoder: Decoder,
    time: u64,
}

impl Screen {
    fn new() -> Self {
        let device = KnownDevice { file: "pump.eds".to_owned(), sheet: Datasheet::parse(EDS.as_bytes()) };
        let mut network = Network::default();
        network.add(NodeId::new(5).unwrap(), device).unwrap();
        Self { decoder: Decoder::new(network), time: 1_700_000_000_000_000 }
    }

    fn frame(&mut self, frame: &Frame) -> String {
        self.time += 1_250;
        let report = Report { time: self.time, frame, message: self.decoder.decode(frame) };
        serde_json::to_string(&report).expect("every message is JSON");
        report.text()
    }

    fn all(&mut self, frames: &[&str]) -> String {
        frames.iter().map(|text| self.frame(&parse(text)) + "\n").collect()
    }
}

fn parse(text: &str) -> Frame {
    let (can_id, data) = text.split_once(' ').unwrap_or((text, ""));
    let number = u32::from_str_radix(can_id.trim_end_matches('h'), 16).unwrap();
    let can_id = if can_id.len() > 4 { CanId::extended(number) } else { CanId::standard(number as u16) };
    if let Some(length) = data.strip_prefix('R') {
        return Frame::remote(can_id.unwrap(), length.parse().unwrap());
    }
    let data: Vec<u8> = data.split_whitespace().map(|byte| u8::from_str_radix(byte, 16).unwrap()).collect();
    Frame::new(can_id.unwrap(), &data)
}

#[test]
fn network_management() {
    let frames = [
        "000h 01 05",
        "000h 80 00",
        "000h 77 05",
        "000h 01",
        "705h 00",
        "705h 7F",
        "705h 05",
        "705h 63",
        "705h 05 00",
        "703h R1",
        "703h 05",
        "703h 85",
        "706h 84",
    ];
    insta::assert_snapshot!(Screen::new().all(&frames));
}

#[test]
fn sync_time_emergencies_and_what_is_none_of_them() {
    let frames = [
        "080h",
        "080h 0C",
        "080h 0C 0D",
        "100h 40 77 1B 02 2D 3D",
        "100h 00",
        "085h 30 81 11 05 00 00 00 00",
        "085h 00 00 00 00 00 00 00 00",
        "086h 00 A0 80 01 02 03 04 05",
        "085h 30 81",
        "7DFh 01 02",
        "00000185h 01",
    ];
    insta::assert_snapshot!(Screen::new().all(&frames));
}

#[test]
fn transfers_are_followed_to_their_values() {
    let expedited = [
        "605h 40 17 10 00 00 00 00 00",
        "585h 4B 17 10 00 E8 03 00 00",
        "605h 2B 17 10 00 F4 01 00 00",
        "585h 60 17 10 00 00 00 00 00",
        "605h 40 00 50 01 00 00 00 00",
        "585h 80 00 50 01 00 00 02 06",
        "609h 40 17 10 00 00 00 00 00",
        "589h 43 17 10 00 01 02 00 00",
        "605h 40 17 10",
    ];
    let segments = [
        "605h 40 03 20 00 00 00 00 00",
        "585h 41 03 20 00 0A 00 00 00",
        "605h 60 00 00 00 00 00 00 00",
        "585h 00 65 6E 67 69 6E 65 20",
        "585h 00 65 6E 67 69 6E 65 20",
        "605h 70 00 00 00 00 00 00 00",
        "585h 19 72 6F 6F 00 00 00 00",
        "605h 21 03 20 00 08 00 00 00",
        "585h 60 03 20 00 00 00 00 00",
        "605h 00 68 61 6C 6C 20 33 34",
        "585h 20 00 00 00 00 00 00 00",
        "605h 1D 35 00 00 00 00 00 00",
        "585h 30 00 00 00 00 00 00 00",
    ];
    let blocks = [
        "605h A4 03 20 00 02 00 00 00",
        "585h C6 03 20 00 0A 00 00 00",
        "605h A3 00 00 00 00 00 00 00",
        "585h 01 65 6E 67 69 6E 65 20",
        "585h 82 72 6F 6F 00 00 00 00",
        "605h A2 02 02 00 00 00 00 00",
        "585h D1 34 12 00 00 00 00 00",
        "605h A1 00 00 00 00 00 00 00",
        "605h C6 03 20 00 09 00 00 00",
        "585h A4 03 20 00 7F 00 00 00",
        "605h 01 65 6E 67 69 6E 65 20",
        "605h 82 34 32 00 00 00 00 00",
        "585h A2 01 7F 00 00 00 00 00",
        "605h 81 34 32 00 00 00 00 00",
        "585h A2 01 7F 00 00 00 00 00",
        "605h D5 34 12 00 00 00 00 00",
        "585h A1 00 00 00 00 00 00 00",
        "605h E0 00 00 00 00 00 00 00",
    ];
    let mut screen = Screen::new();
    insta::assert_snapshot!("expedited", screen.all(&expedited));
    insta::assert_snapshot!("segments", screen.all(&segments));
    insta::assert_snapshot!("blocks", screen.all(&blocks));
}

#[test]
fn pdos_have_the_values_that_the_file_maps() {
    let frames = [
        "1A5h 01 9C FF 00 00 C0 3F",
        "1A5h 01 9C FF",
        "1A5h",
        "1A5h 01 9C FF 00 00 C0 3F 00",
        "1A5h R7",
        "185h 01",
        "186h 01 02",
        "206h 01 02",
    ];
    insta::assert_snapshot!(Screen::new().all(&frames));
}

#[test]
fn layer_setting_services() {
    let frames = [
        "7E5h 04 01 00 00 00 00 00 00",
        "7E5h 40 60 03 00 00 00 00 00",
        "7E5h 43 01 00 00 00 00 00 00",
        "7E4h 44 00 00 00 00 00 00 00",
        "7E5h 11 07 00 00 00 00 00 00",
        "7E4h 11 00 00 00 00 00 00 00",
        "7E5h 13 00 02 00 00 00 00 00",
        "7E5h 13 00 05 00 00 00 00 00",
        "7E4h 13 01 00 00 00 00 00 00",
        "7E5h 15 E8 03 00 00 00 00 00",
        "7E5h 17 00 00 00 00 00 00 00",
        "7E4h 17 FF 09 00 00 00 00 00",
        "7E5h 49 FF FF FF FF 00 00 00",
        "7E5h 4C 00 00 00 00 00 00 00",
        "7E4h 50 00 00 00 00 00 00 00",
        "7E5h 51 00 00 00 00 80 00 00",
        "7E5h 51 60 03 00 00 1F 00 01",
        "7E4h 4F 00 00 00 00 00 00 00",
        "7E5h 5A 00 00 00 00 00 00 00",
        "7E4h 5A 60 03 00 00 00 00 00",
        "7E5h 5E 00 00 00 00 00 00 00",
        "7E4h 5E 07 00 00 00 00 00 00",
        "7E5h 99 00 00 00 00 00 00 00",
        "7E5h 04 01",
    ];
    insta::assert_snapshot!(Screen::new().all(&frames));
}

#[test]
fn json_has_numbers() {
    let mut screen = Screen::new();
    let mut json = |text: &str| {
        let frame = parse(text);
        let report = Report { time: 1, frame: &frame, message: screen.decoder.decode(&frame) };
        serde_json::to_value(&report).unwrap()
    };
    let pdo = json("1A5h 01 9C FF 00 00 C0 3F");
    assert_eq!((&pdo["service"], &pdo["pdo"], &pdo["node"]), (&"pdo".into(), &"TPDO1".into(), &5.into()));
    assert_eq!(pdo["values"][2]["value"], -100);
    assert_eq!(pdo["values"][3]["name"], "Flow");
    assert_eq!(json("585h 80 17 10 00 00 00 02 06")["abort_code"], 0x0602_0000);
    assert_eq!(json("705h 05")["state"], "operational");
}

#[test]
fn no_frames_make_the_decoder_panic() {
    let mut screen = Screen::new();
    let mut random = 1_u64;
    for _ in 0..200_000 {
        random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let bytes = (random >> 8).to_le_bytes();
        let ids = [0x605, 0x585, 0x1A5, 0x705, 0x085, 0x7E5, 0x7E4, (random >> 40) as u16 & 0x7FF];
        let can_id = CanId::standard(ids[(random >> 60) as usize % ids.len()]).unwrap();
        // SDOs need all their bytes to get anywhere.
        let length = if random >> 50 & 3 == 0 { (random >> 52) as usize % 9 } else { 8 };
        screen.decoder.decode(&Frame::new(can_id, &bytes[..length]));
    }
}
