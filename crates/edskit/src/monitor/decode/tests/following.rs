//! U10 of the field reports: PDOs and identifiers that change while the monitor watches.

use super::*;

/// A write of `bytes` into an entry of a node, and its confirmation.
fn write(node: u8, index: u16, sub_index: u8, bytes: &[u8]) -> Vec<String> {
    let [low, high] = index.to_le_bytes();
    let mut data = [0; 4];
    data[..bytes.len()].copy_from_slice(bytes);
    let command = 0x23 | (4 - bytes.len() as u8) << 2;
    vec![
        message(0x600, node, [command, low, high, sub_index, data[0], data[1], data[2], data[3]]),
        message(0x580, node, [0x60, low, high, sub_index, 0, 0, 0, 0]),
    ]
}

fn message(first: u16, node: u8, bytes: [u8; 8]) -> String {
    let bytes: Vec<String> = bytes.iter().map(|byte| format!("{byte:02X}")).collect();
    format!("{:03X}h {}", first + u16::from(node), bytes.join(" "))
}

/// TPDO1 of a node gets these entries and this COB-ID, in the order of CiA 301.
fn remap(node: u8, cob_id: u32, entries: &[u32]) -> Vec<String> {
    let mut frames = write(node, 0x1800, 1, &(cob_id | 0x8000_0000).to_le_bytes());
    frames.extend(write(node, 0x1A00, 0, &[0]));
    for (sub_index, entry) in (1..).zip(entries) {
        frames.extend(write(node, 0x1A00, sub_index, &entry.to_le_bytes()));
    }
    frames.extend(write(node, 0x1A00, 0, &[entries.len() as u8]));
    frames.extend(write(node, 0x1800, 1, &cob_id.to_le_bytes()));
    frames
}

impl Screen {
    /// What these frames say, without time and bytes.
    fn says(&mut self, frames: &[&str]) -> Vec<String> {
        let meaning = |line: String| line.get(48..).unwrap_or_default().trim().to_owned();
        frames.iter().map(|text| meaning(self.frame(&parse(text)))).collect()
    }

    fn pass(&mut self, frames: &[String]) {
        for frame in frames {
            self.frame(&parse(frame));
        }
    }
}

const FLOW: &str = "1A5h 00 00 C0 3F";
const ALL: &str = "1A5h 01 9C FF 00 00 C0 3F";

fn shows(screen: &mut Screen, frame: &str) -> String {
    screen.says(&[frame]).remove(0)
}

fn by_file(screen: &mut Screen) -> bool {
    shows(screen, ALL) == "node 5   TPDO1     Is open = 1 (true), Pressure/Inlet = -100 (-0064h), Flow = 1.5"
}

#[test]
fn a_remapping_is_followed_until_the_node_starts_anew() {
    let mut screen = Screen::new();
    assert!(by_file(&mut screen));
    screen.pass(&remap(5, 0x1A5, &[0x2002_0020]));
    assert_eq!(shows(&mut screen, FLOW), "node 5   TPDO1     Flow = 1.5");
    // As it is remapped step by step, in the words of a person.
    let mut frames = remap(5, 0x4000_01B7, &[0x2002_0020, 0x2001_0110]);
    frames.insert(2, ALL.to_owned());
    for frame in ["1B7h 00 00 C0 3F 9C FF", "1B7h 00 00 C0 3F", "1A5h 00 00 C0 3F", "000h 81 05"] {
        frames.push(frame.to_owned());
    }
    frames.extend([ALL.to_owned(), "1B7h 00 00 C0 3F 9C FF".to_owned()]);
    let frames: Vec<&str> = frames.iter().map(String::as_str).collect();
    insta::assert_snapshot!(screen.all(&frames));
    for reset in ["000h 81 00", "000h 82 05", "000h 82 00", "705h 00"] {
        screen.pass(&remap(5, 0x1A5, &[0x2002_0020]));
        assert!(!by_file(&mut screen));
        shows(&mut screen, reset);
        assert!(by_file(&mut screen), "{reset}");
    }
    for other in ["000h 81 06", "000h 01 05", "000h 80 00", "706h 00", "000h 81"] {
        screen.pass(&remap(5, 0x1A5, &[0x2002_0020]));
        shows(&mut screen, other);
        assert!(!by_file(&mut screen), "{other}");
        shows(&mut screen, "000h 81 05");
    }
}

#[test]
fn every_kind_of_transfer_counts_once_it_has_come_to_its_end() {
    let transfers: [(&[&str], bool); 14] = [
        // In one message, with its length and without.
        (&["605h 2F 00 1A 00 01 00 00 00", "585h 60 00 1A 00 00 00 00 00"], true),
        (&["605h 22 00 1A 00 01 FF FF FF", "585h 60 00 1A 00 00 00 00 00"], true),
        (
            &["605h 2F 00 1A 00 01 00 00 00", "585h 60 00 1A 00 00 00 00 00", "585h 60 00 1A 00 00 00 00 00"],
            true,
        ),
        // Not confirmed, refused, replaced by another, confirmed for another entry.
        (&["605h 2F 00 1A 00 01 00 00 00"], false),
        (&["605h 2F 00 1A 00 01 00 00 00", "585h 80 00 1A 00 00 00 01 06"], false),
        (&["605h 2F 00 1A 00 01 00 00 00", "585h 9F 00 1A 00 00 00 01 06"], false),
        (&["605h 2F 00 1A 00 01 00 00 00", "605h 40 17 10 00 00 00 00 00"], false),
        (&["605h 2F 00 1A 00 01 00 00 00", "585h 60 00 16 00 00 00 00 00"], false),
        // In segments.
        (
            &[
                "605h 21 00 1A 00 01 00 00 00",
                "585h 60 00 1A 00 00 00 00 00",
                "605h 0D 01 00 00 00 00 00 00",
                "585h 20 00 00 00 00 00 00 00",
            ],
            true,
        ),
        (
            &[
                "605h 21 00 1A 00 01 00 00 00",
                "585h 60 00 1A 00 00 00 00 00",
                "605h 0D 01 00 00 00 00 00 00",
                "585h 80 00 1A 00 00 00 01 06",
            ],
            false,
        ),
        // In blocks.
        (
            &[
                "605h C6 00 1A 00 01 00 00 00",
                "585h A4 00 1A 00 7F 00 00 00",
                "605h 81 01 00 00 00 00 00 00",
                "585h A2 01 7F 00 00 00 00 00",
                "605h D9 00 00 00 00 00 00 00",
                "585h A1 00 00 00 00 00 00 00",
            ],
            true,
        ),
        // What is read is what is.
        (&["605h 40 00 1A 00 00 00 00 00", "585h 4F 00 1A 00 01 00 00 00"], true),
        (&["605h 40 00 1A 00 00 00 00 00", "585h 42 00 1A 00 01 FF FF FF"], true),
        (
            &[
                "605h 40 00 1A 00 00 00 00 00",
                "585h 41 00 1A 00 01 00 00 00",
                "605h 60 00 00 00 00 00 00 00",
                "585h 0D 01 00 00 00 00 00 00",
            ],
            true,
        ),
    ];
    for (frames, counts) in transfers {
        let mut screen = Screen::new();
        screen.says(frames);
        let shown = shows(&mut screen, "1A5h 01");
        let expected =
            if counts { "Is open = 1 (true)" } else { "(too short, 7 bytes are mapped by the file)" };
        assert!(shown.ends_with(expected), "{frames:?}: {shown}");
    }
}

#[test]
fn what_was_not_seen_whole_is_said() {
    let mut screen = Screen::new();
    // The first segment of the block is missing.
    screen.says(&[
        "605h C6 00 1A 01 0A 00 00 00",
        "585h A4 00 1A 01 7F 00 00 00",
        "605h 82 01 00 00 00 00 00 00",
        "585h A2 02 7F 00 00 00 00 00",
        "605h D1 00 00 00 00 00 00 00",
        "585h A1 00 00 00 00 00 00 00",
    ]);
    assert_eq!(
        shows(&mut screen, ALL),
        "node 5   TPDO1     (its mapping has changed, and not all of that was seen)"
    );
    // The request is missing, since the monitor has just begun, or frames were lost; or another has come between.
    for request in ["605h 40 17 10 00 00 00 00 00", "605h 2F 00 1A 00 01 00 00 00"] {
        let mut screen = Screen::new();
        shows(&mut screen, request);
        screen.decoder.forget();
        shows(&mut screen, "585h 60 00 1A 00 00 00 00 00");
        assert!(shows(&mut screen, ALL).ends_with("(its mapping has changed, and not all of that was seen)"));
    }
    screen.pass(&write(5, 0x1A00, 0, &[0]));
    assert_eq!(shows(&mut screen, FLOW), "node 5   TPDO1     (nothing is mapped by what was seen of it)");
    screen.pass(&remap(5, 0x1A5, &[0x2002_0020]));
    assert_eq!(shows(&mut screen, FLOW), "node 5   TPDO1     Flow = 1.5");
    assert_eq!(
        shows(&mut screen, "1A5h 00 00 C0 3F 00"),
        "node 5   TPDO1     Flow = 1.5 (too long, 4 bytes are mapped by what was seen of it)"
    );
}

#[test]
fn other_pdos_and_nodes_without_a_file() {
    let mut screen = Screen::new();
    // RPDO 7, of which the file says nothing.
    screen.pass(&write(5, 0x1606, 1, &0x2002_0020_u32.to_le_bytes()));
    screen.pass(&write(5, 0x1606, 0, &[1]));
    screen.pass(&write(5, 0x1406, 1, &0x345_u32.to_le_bytes()));
    assert_eq!(shows(&mut screen, "345h 00 00 C0 3F"), "node 5   RPDO7     Flow = 1.5");
    screen.pass(&write(5, 0x1406, 1, &0x8000_0345_u32.to_le_bytes()));
    assert_eq!(
        shows(&mut screen, "345h 00 00 C0 3F"),
        "node 69  RPDO2",
        "it is the pre-defined one of another"
    );
    // Node 9 has no file: its mapping counts where its PDO is, first by the pre-defined connection set.
    screen.pass(&write(9, 0x1A00, 1, &0x2001_0110_u32.to_le_bytes()));
    screen.pass(&write(9, 0x1A00, 0, &[1]));
    assert_eq!(shows(&mut screen, "189h 9C FF"), "node 9   TPDO1     2001h:01h = 9C FF (65436)");
    screen.pass(&write(9, 0x1800, 1, &0x2000_1189_u32.to_le_bytes()));
    assert_eq!(shows(&mut screen, "00001189h 9C FF"), "node 9   TPDO1     2001h:01h = 9C FF (65436)");
    assert_eq!(shows(&mut screen, "189h 9C FF"), "");
    assert_eq!(shows(&mut screen, "289h 9C FF"), "node 9   TPDO2", "of which nothing is known");
    shows(&mut screen, "709h 00");
    assert_eq!(shows(&mut screen, "189h 9C FF"), "node 9   TPDO1");
}

#[test]
fn identifiers_of_emcy_sync_and_time() {
    let mut screen = Screen::new();
    let emcy = "30 81 11 05 00 00 00 00";
    screen.pass(&write(5, 0x1014, 0, &0x0C5_u32.to_le_bytes()));
    assert!(shows(&mut screen, &format!("0C5h {emcy}")).starts_with("node 5   EMCY      8130h"));
    assert_eq!(shows(&mut screen, &format!("085h {emcy}")), "");
    screen.pass(&write(5, 0x1014, 0, &0x8000_00C5_u32.to_le_bytes()));
    assert!(shows(&mut screen, &format!("0C5h {emcy}")).starts_with("node 69"));
    screen.pass(&write(5, 0x1005, 0, &0x4000_00A0_u32.to_le_bytes()));
    screen.pass(&write(5, 0x1012, 0, &0x8000_00A1_u32.to_le_bytes()));
    assert_eq!(
        screen.says(&["0A0h 07", "0A1h 40 77 1B 02 2D 3D", "080h"]),
        ["SYNC 7", "TIME 2026-11-17 09:49:14.432", "SYNC"]
    );
    screen.pass(&write(5, 0x1012, 0, &0x0000_00A1_u32.to_le_bytes()));
    assert_eq!(
        shows(&mut screen, "0A1h 40 77 1B 02 2D 3D"),
        "(expected an EMCY of eight bytes)",
        "of node 33"
    );
    shows(&mut screen, "000h 81 05");
    assert_eq!(shows(&mut screen, "100h 40 77 1B 02 2D 3D"), "TIME 2026-11-17 09:49:14.432");
    assert!(shows(&mut screen, &format!("085h {emcy}")).starts_with("node 5   EMCY"));
}

#[test]
fn a_heartbeat_ends_guarding() {
    let mut screen = Screen::new();
    shows(&mut screen, "705h R1");
    assert_eq!(shows(&mut screen, "705h 05"), "node 5   guarding  operational, toggle 0");
    screen.pass(&write(5, 0x1017, 0, &500_u16.to_le_bytes()));
    assert_eq!(shows(&mut screen, "705h 05"), "node 5   heartbeat operational");
    screen.pass(&write(5, 0x1017, 0, &[0, 0]));
    assert_eq!(shows(&mut screen, "705h 05"), "node 5   guarding  operational, toggle 0");
    shows(&mut screen, "705h 00");
    assert_eq!(
        shows(&mut screen, "705h 05"),
        "node 5   heartbeat operational",
        "nobody has guarded it since"
    );
}

#[test]
fn what_is_stored_outlives_a_reset() {
    let mut screen = Screen::new();
    screen.pass(&remap(5, 0x1A5, &[0x2002_0020]));
    screen.pass(&write(5, 0x1010, 1, b"save"));
    screen.pass(&remap(5, 0x1A5, &[0x2001_0110]));
    assert_eq!(shows(&mut screen, "1A5h 9C FF"), "node 5   TPDO1     Pressure/Inlet = -100 (-0064h)");
    shows(&mut screen, "000h 81 05");
    assert_eq!(shows(&mut screen, FLOW), "node 5   TPDO1     Flow = 1.5");
    screen.pass(&write(5, 0x1011, 1, b"load"));
    assert_eq!(shows(&mut screen, FLOW), "node 5   TPDO1     Flow = 1.5", "until the reset");
    shows(&mut screen, "705h 00");
    assert!(by_file(&mut screen));
    // The application's parameters, and words that are none.
    for (sub_index, word) in [(3, b"save"), (1, b"evas")] {
        screen.pass(&remap(5, 0x1A5, &[0x2002_0020]));
        screen.pass(&write(5, 0x1010, sub_index, word));
        shows(&mut screen, "705h 00");
        assert!(by_file(&mut screen));
    }
}

#[test]
fn a_second_sdo_server_is_followed_too() {
    let mut screen = Screen::new();
    screen.pass(&write(5, 0x1201, 1, &0x643_u32.to_le_bytes()));
    assert_eq!(shows(&mut screen, "643h 40 17 10 00 00 00 00 00"), "node 67  SDO >     1017h:00h: read");
    screen.pass(&write(5, 0x1201, 1, &0x480_u32.to_le_bytes()));
    screen.pass(&write(5, 0x1201, 2, &0x500_u32.to_le_bytes()));
    let says = screen.says(&[
        "480h 40 17 10 00 00 00 00 00",
        "605h 40 03 20 00 00 00 00 00",
        "500h 4B 17 10 00 2C 01 00 00",
    ]);
    assert_eq!(says[0], "node 5   SDO >     1017h:00h Heartbeat time: read");
    assert_eq!(says[2], "node 5   SDO <     1017h:00h Heartbeat time: value 300 (012Ch)");
    screen.says(&["480h 2F 00 1A 00 01 00 00 00", "500h 60 00 1A 00 00 00 00 00"]);
    assert_eq!(shows(&mut screen, "1A5h 01"), "node 5   TPDO1     Is open = 1 (true)");
}

#[test]
fn a_file_cannot_take_the_identifiers_of_others() {
    let eds = EDS.replace("$NODEID+0x400001A0", "0").replace("$NODEID+0x80", "0x605");
    let device = KnownDevice { file: "wrong.eds".to_owned(), sheet: Datasheet::parse(eds.as_bytes()) };
    let mut network = Network::default();
    network.add(NodeId::new(5).unwrap(), device).unwrap();
    let mut screen = Screen { decoder: Decoder::new(network), time: 0 };
    assert_eq!(shows(&mut screen, "000h 01 05"), "node 5   NMT       start");
    assert_eq!(
        shows(&mut screen, "605h 40 17 10 00 00 00 00 00"),
        "node 5   SDO >     1017h:00h Heartbeat time: read"
    );
}
