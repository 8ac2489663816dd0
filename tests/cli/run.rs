//! `edskit run`: what it says where nothing can be run. A node that runs is judged by the conformance check.

use edskit_tests::{Folder, edskit};

#[test]
fn what_cannot_be_run() {
    let folder = Folder::new("run");
    let empty = folder.write("empty.eds", "[FileInfo]\n");
    let good = folder.write("good.eds", "[1000]\nParameterName=Device type\nDataType=7\nAccessType=ro\n");
    let with_side_file =
        folder.write("sided.eds", "[1017]\nParameterName=Heartbeat\nDataType=6\nAccessType=rw\n");
    folder.write("sided.toml", "[unit]\n'1017' = 'ms'\n\n[capacity]\n'1017' = 'long'\n");
    let incomplete = folder.write(
        "incomplete.eds",
        "[1A00]\nObjectType=9\n[1A00sub0]\nDataType=5\nDefaultValue=1\n\
         [1A00sub1]\nDataType=7\nDefaultValue=0x20000010\n[2000]\nDataType=6 ; UNSIGNED16\nAccessType=ro\n",
    );
    let wrong: String = (0x2000..0x2030).map(|index| format!("[{index:X}]\nDataType=6\n")).collect();
    let wrong = folder.write("wrong.eds", &wrong);
    let unusable = folder.write(
        "unusable.eds",
        "[1001]\nParameterName=Errors\nDataType=5\nAccessType=ro\nDefaultValue=0\n\
         [1005]\nParameterName=SYNC\nDataType=7\nAccessType=rw\n\
         [1800]\nParameterName=TPDO 1\nObjectType=9\nSubNumber=3\n\
         [1800sub0]\nParameterName=n\nDataType=5\nAccessType=ro\n\
         [1800sub1]\nParameterName=COB-ID\nDataType=7\nAccessType=rw\nDefaultValue=0\n\
         [1800sub2]\nParameterName=Type\nDataType=5\nAccessType=rw\nDefaultValue=255\n\
         [2014]\nParameterName=Program\nObjectType=2\nDataType=15\nAccessType=rw\nDefaultValue=0102\n",
    );
    let nobody = "socketcand:127.0.0.1:1/can0";
    let cases: [(&str, &[&str]); 9] = [
        ("unusable", &[&unusable, "--bus", nobody]),
        ("missing", &["nowhere.eds"]),
        ("nothing", &[&empty]),
        ("side_file", &[&with_side_file]),
        ("bus", &[&good, "--bus", "socketcan"]),
        ("node_id", &[&good, "--node-id", "128"]),
        ("nobody", &[&good, "--bus", nobody]),
        ("incomplete", &[&incomplete, "--bus", nobody]),
        ("many_warnings", &[&wrong, "--bus", nobody]),
    ];
    for (name, arguments) in cases {
        let output = edskit(&[&["run"], arguments].concat());
        insta::assert_snapshot!(format!("run_{name}"), folder.clean(&output));
    }
}
