//! `edskit show`.

use edskit_tests::{edskit, edskit_with_input};

const GATEWAY: &str = "../eds/CANopenGateway.eds";
const DRIVE: &str = "fixtures/drive.dcf";

#[test]
fn a_device() {
    insta::assert_snapshot!("show_drive", edskit(&["show", DRIVE]).all());
    let gateway = edskit(&["show", GATEWAY, "--node-id", "5"]).stdout;
    assert!(gateway.contains("$NODEID+0x580 = 585h"), "{gateway}");
}

#[test]
fn one_object_with_its_pdo() {
    insta::assert_snapshot!("show_object", edskit(&["show", DRIVE, "1A00"]).all());
    insta::assert_snapshot!("show_entry", edskit(&["show", DRIVE, "1018:01"]).all());
    insta::assert_snapshot!("show_compact", edskit(&["show", DRIVE, "2100"]).all());
}

#[test]
fn json() {
    insta::assert_snapshot!("show_object_json", edskit(&["show", DRIVE, "1A00", "--format", "json"]).all());
    let device: serde_json::Value =
        serde_json::from_str(&edskit(&["show", DRIVE, "--format", "json"]).stdout).unwrap();
    assert_eq!(device["node_id"], 12);
    assert_eq!(device["pdos"][1]["mapped"][0]["name"], "Statusword");
}

#[test]
fn standard_input() {
    let text = std::fs::read(DRIVE).unwrap();
    assert_eq!(edskit_with_input(&["show", "-"], &text).stdout, edskit(&["show", DRIVE]).stdout);
}

/// A device whose file has mistakes of many kinds.
const MISTAKES: &str = "[DeviceInfo]\nLSS_Supported=yes\n[ManufacturerObjects]\nSupportedObjects=1\n1=2000\n\
    [1014h]\nParameterName=EMCY\nDataType=0x0007 ; UNSIGNED32\nAccessType=R/W\nDefaultValue=80h + NODEID\n\
    [2000]\nParameterName=Limit\nDataType=0xA0\nAccessType=rw;\nDefaultValue=25 (percent)\nPDOMapping=0;\n\
    [A0]\nObjectType=6\n[A0sub1]\nDefaultValue=3\n[A0sub2]\nDefaultValue=-100\n[A0sub3]\nDefaultValue=100\n";

#[test]
fn what_is_written_wrongly_is_shown_as_it_was_meant() {
    let all = edskit_with_input(&["show", "-", "--node-id", "5"], MISTAKES.as_bytes()).all();
    insta::assert_snapshot!("show_mistakes", all);
    insta::assert_snapshot!(
        "show_meant",
        edskit_with_input(&["show", "-", "--meant"], MISTAKES.as_bytes()).all()
    );
    let output = edskit_with_input(&["show", "-", "--meant", "--format", "json"], MISTAKES.as_bytes());
    let meant: serde_json::Value = serde_json::from_str(&output.stdout).unwrap();
    assert_eq!(
        (&meant[0]["line"], &meant[0]["written"], &meant[0]["meant"]),
        (&2.into(), &"yes".into(), &"1".into())
    );
    insta::assert_snapshot!("show_nothing_meant", edskit(&["show", DRIVE, "--meant"]).all());
}

#[test]
fn what_differs_among_compact_entries_and_the_files_of_domains() {
    let text = "[1016]\nParameterName=Consumer\nObjectType=8\nDataType=7\nAccessType=rw\nDefaultValue=0\nCompactSubObj=4\n\
        [1016Name]\nNrOfEntries=1\n2=Watch the pump\n[1016Value]\nNrOfEntries=2\n1=0x00020064\n3=sometimes\n\
        [1016Denotation]\nNrOfEntries=1\n1=Pump\n\
        [2100]\nParameterName=Trace\nObjectType=2\nAccessType=ro\nUploadFile=trace.bin\nObjFlags=0x1\n\
        [2101]\nParameterName=Program\nObjectType=9\nSubNumber=2\n[2101sub0]\nParameterName=n\nDataType=5\nAccessType=ro\nDefaultValue=1\n\
        [2101sub1]\nParameterName=Code\nDataType=15\nAccessType=wo\nDownloadFile=code.bin\nParamRefd=P1\n";
    let show = |arguments: &[&str]| edskit_with_input(&[&["show", "-"], arguments].concat(), text.as_bytes());
    insta::assert_snapshot!("show_differing", show(&[]).all());
    let json = |arguments: &[&str]| -> serde_json::Value {
        serde_json::from_str(&show(&[arguments, &["--format", "json"]].concat()).stdout).unwrap()
    };
    let all = json(&[]);
    for (position, index) in ["1016", "2100", "2101"].into_iter().enumerate() {
        assert_eq!(all["objects"][position], json(&[index])["object"], "{index}");
    }
    assert_eq!(all["objects"][0]["entries"][3]["value"], "sometimes");
    assert_eq!(all["objects"][1]["entries"][0]["upload_file"], "trace.bin");
    assert_eq!(all["objects"][2]["entries"][1]["download_file"], "code.bin");
    let one = show(&["2100"]).stdout;
    assert!(one.contains("UploadFile: trace.bin\n") && one.contains("ObjFlags: 0x1\n"), "{one}");
    assert!(show(&["2101:1"]).stdout.contains("DownloadFile: code.bin\n"));
}
