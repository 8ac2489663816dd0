//! Checks across files: a nodelist with its DCFs, a DCF with the files that it downloads.

use edskit_tests::{Folder, edskit, edskit_with_input};

const NODE_LIST: &str = "[Topology]\nNetName=Line\nNodes=0x02\nNode1Present=0x01\nNode1DCFName=PANEL.DCF\nNode5Present=0x01\nNode5DCFName=drive.dcf\nEDSBaseName=config\n";

fn dcf(node_id: u8, baudrate: u16) -> String {
    format!("[DeviceComissioning]\nNodeID={node_id}\nBaudrate={baudrate}\n")
}

fn findings(path: &str) -> String {
    edskit(&["lint", "--select", "CPJ,DCF007", "--format", "concise", "--quiet", path]).stdout
}

#[test]
fn a_nodelist_is_checked_with_its_dcfs() {
    let folder = Folder::new("nodelist");
    let list = folder.write("nodelist.cpj", NODE_LIST);
    folder.write("config/panel.dcf", dcf(1, 500));
    assert!(findings(&list).contains("there is no file `drive.dcf` for node 5"), "{}", findings(&list));
    folder.write("drive.dcf", dcf(6, 250));
    let found = findings(&list);
    assert!(found.contains("`drive.dcf` is the DCF of node 6, not of node 5"), "{found}");
    assert!(found.contains("node 5 has 250 kbit/s, but node 1 has 500 kbit/s"), "{found}");
    folder.write("drive.dcf", dcf(5, 500));
    assert_eq!(findings(&list), "");
}

#[test]
fn a_file_to_download_must_be_there() {
    let folder = Folder::new("download");
    let text = "[1F50sub1]\nParameterName=Program\nObjectType=0x2\nDownloadFile=bin\\Program.bin\n";
    let path = folder.write("a.dcf", text);
    assert!(findings(&path).contains("there is no file `bin\\Program.bin` beside the DCF"));
    folder.write("bin/program.bin", [0; 8]);
    assert_eq!(findings(&path), "");
    let elsewhere = folder.write("b.dcf", text.replace("bin\\", "C:\\data\\"));
    assert_eq!(findings(&elsewhere), "", "nobody can tell");
}

#[test]
fn standard_input_has_no_neighbours() {
    let arguments = [
        "lint",
        "-",
        "--stdin-filename",
        "nodelist.cpj",
        "--select",
        "CPJ002",
        "--format",
        "concise",
        "--quiet",
    ];
    assert_eq!(edskit_with_input(&arguments, NODE_LIST.as_bytes()).stdout, "");
}
