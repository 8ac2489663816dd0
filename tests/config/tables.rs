//! `edskit config import` and `edskit config export`.

use edskit::Exit;
use edskit_tests::{Folder, Output, edskit, edskit_with_input, paths, read, root};
use serde_json::Value;

fn import(table: impl AsRef<[u8]>, rest: &[&str]) -> Output {
    edskit_with_input(&[&["config", "import", "-"], rest].concat(), table.as_ref())
}

/// The configuration that a parameter file gives, which has to be understood.
#[track_caller]
fn configuration(parameters: &str) -> Value {
    let output = edskit_with_input(&["config", "check", "-", "--format", "json"], parameters.as_bytes());
    let answer: Value = serde_json::from_str(&output.stdout).expect("the answer is JSON");
    assert!(answer["accepted"].is_boolean(), "{parameters}\n{}", output.stdout);
    answer["configuration"].clone()
}

/// The tables of the manual's examples, as they are printed (7.1 and 7.2).
const GATEWAY: &str = "\
Nummer;Parameter;Wert;Einheit
400;CanStartTimeOutDelay;1,0;s
401;CanMyNodeNumber;1;
402;CanDCNodeNumber;1;
416;HzmCanBaudrate;250;
4400;HzmCanCommDCOn;1;
4416;HzmCanSegmentOrBaurdate;0;
427;CanOpenMyNodeID;1;
426;CanOpenBaudrate;125;
4426;CanOpSegmentOrBaurdate;0;
428;CanOpenPartnerNodeID;127;
429;CanOpHeartBeatTxTime;1000;ms
430;CanOpHeartBeatRxTime;100;ms
16404;CanOpTPDO5-16ID(0);282;Hex
16407;CanOpTPDO5-16ID(3);382;Hex
16411;CanOpTPDO5-16ID(7);3;Hex
16415;CanOpTPDO5-16ID(11);57F;Hex
2411;CanDCNodeState15to01;2;Hex
";

const GOVERNOR: &str = "\
Number\tName\tValue\tUnit
16471\tCanOpTPDO4-16Cyc (11)\t0\tms
16472\tCanOpTPDO4-16Cyc(12)\t100\tms
16481\tCanOpRPDO1-4Cyc (1)\t100\tms
2950\tExhaustTemp\t451,5\t\u{B0}C
400\tCanStartTimeOutDelay\t1,0\ts
401\tCanMyNodeNumber\t1\t
403\tCanCMNodeNumber\t1\t
409\tCanBaudrate\t250\t
4409\tCanSegmentOrBaurdate\t0\t
835\tFunctLoadEnable\t-5\t
4835\tType_LoadEnable\t3\t
16448\tCanOpTPDO16Assign(0)\t2905\t
2000\tSpeed\t1500\t1/min
";

// GW-CFG-14, GW-CFG-43, GW-CFG-44, GW-TIMING-14, GW-NOTE-43
#[test]
fn the_tables_of_the_manual() {
    let gateway = import(GATEWAY, &[]);
    assert_eq!(
        (gateway.exit, gateway.stderr.as_str()),
        (Exit::Clean, "16 parameters of the gateway, 0 of the governor; 1 row is kept as a remark\n")
    );
    insta::assert_snapshot!("gateway", gateway.stdout);
    let governor = import(GOVERNOR, &[]);
    assert_eq!(governor.exit, Exit::Clean, "{}", governor.stderr);
    insta::assert_snapshot!("governor", governor.stdout);
    let folder = Folder::new("import-both");
    let files = [folder.write("gateway.csv", GATEWAY), folder.write("governor.csv", GOVERNOR)];
    let path = format!("{}/both.toml", folder.path());
    let output = edskit(&["config", "import", &files[0], &files[1], "-o", &path]);
    assert_eq!((output.exit, output.stdout.as_str()), (Exit::Clean, ""), "{}", output.stderr);
    let both = String::from_utf8(folder.read("both.toml")).unwrap();
    let view = configuration(&both);
    assert_eq!((&view["node_id"], &view["heartbeat"]["time"]["set_ms"]), (&1.into(), &1000.into()));
}

/// The same rows in other clothes give the same file.
#[test]
fn dividers_encodings_and_orders() {
    let head = "# From stdin.";
    let body =
        |output: &Output| output.stdout.split_once(head).map(|(_, body)| body.to_owned()).unwrap_or_default();
    let expected = import(GOVERNOR, &[]);
    let semicolons = GOVERNOR.replace('\t', ";");
    for (name, table) in [
        ("semicolons", semicolons.clone().into_bytes()),
        (
            "Windows-1252",
            semicolons
                .replace('\u{B0}', "\u{1}")
                .bytes()
                .map(|byte| if byte == 1 { 0xB0 } else { byte })
                .collect(),
        ),
        ("CRLF and a byte order mark", format!("\u{FEFF}{}", semicolons.replace('\n', "\r\n")).into_bytes()),
        (
            "quotation marks",
            semicolons
                .lines()
                .map(|line| format!("\"{}\"\n", line.replace(';', "\";\"")))
                .collect::<String>()
                .into_bytes(),
        ),
        ("columns in another order", {
            let turned = semicolons.lines().map(|line| {
                let cells: Vec<&str> = line.split(';').collect();
                format!("{};{};6;{};{}\n", cells[3], cells[2], cells[0], cells[1])
            });
            turned.collect::<String>().replace("Unit;Value;6;", "Unit;Value;Level;").into_bytes()
        }),
    ] {
        let output = import(&table, &[]);
        assert_eq!(output.exit, Exit::Clean, "{name}: {}", output.stderr);
        let entries =
            |text: &str| text.lines().filter(|line| !line.starts_with('#')).collect::<Vec<_>>().join("\n");
        assert_eq!(entries(&body(&output)), entries(&body(&expected)), "{name}");
        assert_eq!(output.stdout.matches("#: ").count(), 2, "{name}: {}", output.stdout);
    }
    let blanks = import(
        "427 CanOpenMyNodeID 1\n400   CanStartTimeOutDelay   1,0   s\n16404 CanOpTPDO5-16ID(0) 57F Hex\n",
        &[],
    );
    assert!(blanks.stdout.ends_with("\"427 CanOpenMyNodeID\" = 1\n\"400 CanStartTimeOutDelay\" = 1.0\n\"16404 CanOpTPDO5-16ID(0)\" = 0x57F\n"), "{}", blanks.stdout);
}

#[test]
fn whose_parameters_they_are() {
    let whose = |table: &str, rest: &[&str]| {
        let text = import(table, rest).stdout;
        (text.contains("[gateway]"), text.contains("[governor]"))
    };
    let ambiguous = "400;CanStartTimeOutDelay;1,0;s\n401;CanMyNodeNumber;2;\n";
    assert_eq!(whose(ambiguous, &[]), (true, false));
    assert_eq!(whose(ambiguous, &["--unit", "governor"]), (false, true));
    assert_eq!(whose(&format!("Digitalregler;;;\n{ambiguous}"), &[]), (false, true));
    assert_eq!(
        whose(&format!("{ambiguous}403;CanCMNodeNumber;1;\n"), &[]),
        (false, true),
        "the company of 403"
    );
    assert_eq!(whose("16404;;2000;\n16448;;2905;\n16472;;100;ms\n", &[]), (false, true));
    // Both units in one table without a title: the second time it is the other unit, and that is said.
    let both = format!("{ambiguous}402;CanDCNodeNumber;1;\n{ambiguous}403;CanCMNodeNumber;2;\n");
    let output = import(&both, &[]);
    assert_eq!(output.exit, Exit::Clean, "{}", output.stderr);
    insta::assert_snapshot!("both_in_one", output.all());
}

#[test]
fn what_cannot_be_read_is_kept_and_said() {
    let table = "Number;Name;Value;Unit\n427;CanOpenMyNodeID;200;\n428;CanOpenPartnerNodeID;;\n429;CanOpHeartBeatTxTime;1.000;ms\n\
                 426;CanOpenMyNodeID;5;\n430;CanOpHeartBeatRxTime;100;ms\n430;CanOpHeartBeatRxTime;200;ms\n16404;CanOpTPDO5-16ID(0);xyz;Hex\n";
    let output = import(table, &[]);
    assert_eq!(output.exit, Exit::Findings);
    insta::assert_snapshot!("kept", output.all());
    for row in table.lines().skip(1).filter(|row| !row.contains("1.000") && !row.contains("100;ms")) {
        assert!(output.stdout.contains(&format!("#: {row}\n")), "{row} is lost: {}", output.stdout);
    }
    for (name, input) in [
        ("nothing", ""),
        ("prose", "Parametrierbeispiel:\n\nKnotennummer des Partners ist 127.\n"),
        ("parameters", "device = \"heinzmann-canopen-gateway\"\n[gateway]\n427 = 5\n"),
        ("eds", "[FileInfo]\nFileName=a.eds\n"),
    ] {
        let output = import(input, &["-o", "/nowhere/at/all.toml"]);
        assert_eq!((output.exit, output.stdout.as_str()), (Exit::Findings, ""), "{name}: {}", output.stderr);
    }
    assert_eq!(edskit(&["config", "import", "no-such-file.csv"]).exit, Exit::Failed);
}

/// Every fixture that is understood: out to a table and in again gives what it gave before.
#[test]
fn there_and_back() {
    let mut count = 0;
    for path in paths(&root().join("tests/fixtures/gateway")) {
        let text = String::from_utf8_lossy(&read(&path)).into_owned();
        let name = path.display();
        let exported = edskit_with_input(&["config", "export", "-"], text.as_bytes());
        if exported.exit != Exit::Clean {
            assert_eq!(exported.stdout, "", "{name}: nothing is written of what is not understood");
            continue;
        }
        let imported = import(&exported.stdout, &[]);
        if exported.stdout.lines().count() == 1 {
            assert_eq!(imported.exit, Exit::Findings, "{name}: nothing is set");
            continue;
        }
        assert_eq!(imported.exit, Exit::Clean, "{name}: {}", imported.stderr);
        let again = edskit_with_input(&["config", "export", "-"], imported.stdout.as_bytes());
        assert_eq!(again.stdout, exported.stdout, "{name}");
        if !text.contains("signals") {
            assert_eq!(configuration(&imported.stdout), configuration(&text), "{name}");
        }
        count += 1;
    }
    assert!(count > 5, "{count}");
    // What is kept behind `#:` comes back too, in its unit.
    let full = import(GOVERNOR, &[]).stdout;
    let table = edskit_with_input(&["config", "export", "-", "--unit", "governor"], full.as_bytes()).stdout;
    insta::assert_snapshot!("governor_again", table);
    let sorted = |text: &str| {
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        lines.sort();
        lines
    };
    let again = import(&table, &["--unit", "governor"]).stdout;
    assert_eq!(sorted(&again), sorted(&full), "the rows that are kept stand at the end");
}

#[test]
fn hostile_tables() {
    for table in [
        "\0\0\0;;;\n".to_owned(),
        "427;\u{1b}[31m;5;\u{202e}\n428;;1;\n".to_owned(),
        "9".repeat(100_000),
        ";".repeat(100_000),
        "427;CanOpenMyNodeID;".to_owned() + &"9".repeat(10_000),
        (0..20_000).map(|number| format!("{number};x;1;\n")).collect(),
    ] {
        let output = import(&table, &[]);
        let bad = |c: char| (c.is_control() && c != '\n') || c == '\u{202E}';
        assert_eq!(output.all().find(bad), None);
    }
}
