//! `edskit config check`: what it says to each file of `fixtures/gateway/`, and its page of documentation.

use edskit::Exit;
use edskit_devices::gateway::{Owner, Parameter, parameters};
use edskit_tests::{Output, edskit_with_input};
use serde_json::Value;

const DEVICE: &str = "device = \"heinzmann-canopen-gateway\"\n";

/// Runs `edskit config check` in the folder `tests/`.
fn check(arguments: &[&str], input: &[u8]) -> Output {
    edskit_with_input(&[&["config", "check"], arguments].concat(), input)
}

/// The findings as `code line:column`, and the whole answer.
fn findings(input: impl AsRef<[u8]>) -> (Vec<String>, Value) {
    let output = check(&["-", "--format", "json"], input.as_ref());
    let answer: Value = serde_json::from_str(&output.stdout).expect("the answer is JSON");
    let show = |finding: &Value| {
        let place = &finding["location"];
        let code = finding["code"].as_str().expect("a code is a text");
        format!("{code} {}:{}", place["line"], place["column"])
    };
    let list = answer["findings"].as_array().expect("findings are a list");
    (list.iter().map(show).collect(), answer)
}

#[test]
fn every_fixture() {
    // GW-CFG-31 to GW-CFG-34: what must be equal in both units (units.toml). GW-NOTE-08: times that are too long (data.toml).
    // GW-NOTE-26: a monitoring time that is rounded down (manual.toml).
    let folder = edskit_tests::root().join("tests/fixtures/gateway");
    let mut exits = String::new();
    for path in edskit_tests::paths(&folder) {
        let name = path.file_stem().unwrap().to_str().unwrap();
        let output = check(&[&format!("fixtures/gateway/{name}.toml")], b"");
        assert_eq!(output.stderr, "", "{name}");
        insta::assert_snapshot!(name, output.stdout);
        exits.push_str(&format!("{} {name}\n", output.exit.code()));
    }
    insta::assert_snapshot!("exits", exits);
}

/// GW-CFG-14 to GW-CFG-16, GW-NOTE-19: the manual's identifiers on the nodes 1, 2 and 127.
#[test]
fn the_example_of_the_manual_on_three_nodes() {
    let of = |name: &str| {
        let path = edskit_tests::root().join("tests/fixtures/gateway").join(name);
        let (found, answer) = findings(edskit_tests::read(&path));
        (found, answer["accepted"].as_bool())
    };
    assert_eq!(of("node-1.toml"), (vec!["GWC013 8:9".to_owned()], Some(true)));
    assert_eq!(of("node-2.toml"), (vec!["GWC011 6:9".to_owned()], Some(false)));
    assert_eq!(of("node-127.toml"), (vec!["GWC011 9:9".to_owned()], Some(false)));
}

/// GW-CFG-02, GW-CFG-06, GW-CFG-08, GW-CFG-43, GW-CFG-44, GW-TIMING-06, GW-TIMING-11, GW-TIMING-14, GW-PDO-10,
/// GW-PDO-11: all examples of chapter 7 in one file.
#[test]
fn the_examples_of_the_manual_as_json() {
    let output = check(&["fixtures/gateway/manual.toml", "--format", "json"], b"");
    assert_eq!(output.exit, Exit::Clean);
    insta::assert_snapshot!("manual_json", output.stdout);
    let answer: Value = serde_json::from_str(&output.stdout).unwrap();
    let configuration = &answer["configuration"];
    assert_eq!((&configuration["node_id"], &configuration["bit_rate"]), (&1.into(), &125.into()));
    let pdos = configuration["pdos"].as_array().unwrap();
    let pdo = |name: &str| pdos.iter().find(|pdo| pdo["name"] == name).unwrap();
    let active: Vec<&str> = pdos
        .iter()
        .filter(|pdo| pdo["active"].as_bool().unwrap())
        .map(|pdo| pdo["name"].as_str().unwrap())
        .collect();
    assert_eq!(active, ["RPDO1", "RPDO2", "RPDO3", "RPDO4", "TPDO1", "TPDO2", "TPDO4", "TPDO16"]);
    let effective = |name: &str| pdo(name)["time"]["effective_ms"].as_f64();
    assert_eq!(
        ["RPDO1", "RPDO2", "RPDO3", "RPDO4"].map(effective),
        [None, Some(93.75), Some(187.5), Some(1000.0)]
    );
    assert_eq!(["TPDO4", "TPDO6", "TPDO16"].map(effective), [Some(15.625), Some(187.5), Some(93.75)]);
    assert_eq!((&pdo("TPDO4")["bytes"], &pdo("TPDO16")["bytes"]), (&8.into(), &6.into()));
    assert_eq!(configuration["heartbeat"]["time"]["effective_ms"], 992.0);
    assert_eq!(configuration["partner_heartbeat"]["time"]["effective_ms"], 96.0);
}

/// The order and the line endings of a file, and its byte order mark, do not matter.
#[test]
fn the_same_file_in_other_clothes() {
    let path = edskit_tests::root().join("tests/fixtures/gateway/collisions.toml");
    let text = String::from_utf8(edskit_tests::read(&path)).unwrap();
    let (expected, _) = findings(&text);
    assert_eq!(findings(text.replace('\n', "\r\n")).0, expected);
    assert_eq!(findings(format!("\u{FEFF}{text}")).0, expected);
    let (head, tables) = text.split_once("[gateway]").unwrap();
    let (gateway, governor) = tables.split_once("[governor]").unwrap();
    let turned = format!("{head}[governor]{governor}\n[gateway]{gateway}");
    assert_eq!(findings(turned).0.len(), expected.len());
}

#[test]
fn every_parameter_can_be_named_in_each_way() {
    for parameter in parameters() {
        let table = match parameter.owner() {
            Owner::Gateway => "gateway",
            Owner::Governor => "governor",
        };
        let (number, value) = (parameter.number(), parameter.default_value());
        let value = if number == 400 { value / 1000 } else { value };
        let mut keys = vec![number.to_string(), format!("P{number}")];
        if let Some(name) = parameter.name() {
            keys.extend([format!("{number} {name}"), format!("p{number}_{name}")]);
            keys.extend([name.to_string(), name.to_string().to_uppercase()]);
        }
        for key in keys {
            let (found, _) = findings(format!("{DEVICE}[{table}]\n\"{key}\" = {value}\n"));
            assert!(found.is_empty(), "{parameter:?} as {key}: {found:?}");
        }
    }
}

#[test]
fn bytes_that_are_no_text() {
    let cases: [(&str, &[u8]); 5] = [
        ("not_utf8", b"device = \"heinzmann-canopen-gateway\"\n# Gr\xF6\xDFe\n[gateway]\nP427 = 1\n"),
        ("cut_utf8", b"# \xE2\x82"),
        ("zeros", b"\0\0\0\0"),
        ("eds", b"[FileInfo]\nFileName=a.eds\nFileVersion=1\nDescription=an EDS\n"),
        ("escapes", b"device = \"\\u001b[31m\\u202e\"\n"),
    ];
    for (name, bytes) in cases {
        let output = check(&["-"], bytes);
        assert_eq!(output.exit, Exit::Findings, "{name}");
        insta::assert_snapshot!(format!("bytes_{name}"), output.stdout);
    }
}

#[test]
fn a_file_cannot_steer_the_terminal() {
    let texts = [
        "device = \"\\u001b[31m\"",
        "device = \"heinzmann-canopen-gateway\"\n[gateway]\n\"\\u001b]0;x\\u0007\" = 1",
        "device = \"heinzmann-canopen-gateway\"\n[governor]\n16400 = 7\n16460 = 9\n[governor.signals]\n7 = { name = \"\\u001b[31m\", type = \"u8\" }",
        "# \u{202E}\ndevice = 1",
    ];
    for text in texts {
        let output = check(&["-"], text.as_bytes()).stdout;
        let bad = |c: char| (c.is_control() && c != '\n') || c == '\u{202E}';
        assert_eq!(output.find(bad), None, "{output}");
    }
}

#[test]
fn a_file_of_nonsense_is_not_shown_whole() {
    let text = "== x\n".repeat(10_000);
    let (found, _) = findings(&text);
    assert_eq!(found.len(), 20);
    let many: String = (0..10_000).map(|number| format!("Nonsense{number} = 1\n")).collect();
    let (found, _) = findings(format!("{DEVICE}[gateway]\n{many}"));
    assert_eq!(found.len(), 2_000);
}

#[test]
fn exit_codes_and_options() {
    let warning = "fixtures/gateway/node-1.toml";
    assert_eq!(check(&[warning], b"").exit, Exit::Findings);
    assert_eq!(check(&[warning, "--fail-on", "error"], b"").exit, Exit::Clean);
    assert_eq!(check(&["fixtures/gateway/manual.toml", "--fail-on", "info"], b"").exit, Exit::Findings);
    assert_eq!(check(&["fixtures/gateway/node-2.toml", "--fail-on", "error"], b"").exit, Exit::Findings);
    assert_eq!(check(&["fixtures/gateway/only-defaults.toml", "--quiet"], b"").stdout, "");
    assert!(check(&[warning, "--quiet"], b"").stdout.starts_with("GWC013 restricted-can-id (warning)"));
    let colored = check(&[warning, "--color", "always"], b"").stdout;
    assert!(
        colored.contains("\u{1B}[") && !check(&[warning, "--color", "never"], b"").stdout.contains('\u{1B}')
    );
    for (name, arguments) in [
        ("missing", &["fixtures/gateway/missing.toml"][..]),
        ("folder", &["fixtures/gateway"]),
        ("no_file", &[]),
        ("bad_format", &[warning, "--format", "sarif"]),
        ("two_files", &[warning, warning]),
    ] {
        let output = check(arguments, b"");
        assert_eq!((output.exit, output.stdout.as_str()), (Exit::Failed, ""), "{name}");
        insta::assert_snapshot!(format!("failed_{name}"), output.stderr);
    }
    insta::assert_snapshot!("help", check(&["--help"], b"").stdout);
}

/// Cuts, doubles and spoils stretches of a good file: whatever comes out is answered, with places inside the file.
#[test]
fn spoilt_files_are_answered() {
    let path = edskit_tests::root().join("tests/fixtures/gateway/manual.toml");
    let good = edskit_tests::read(&path);
    let mut state = 0x2545_F491_4F6C_DD1D_u64;
    let mut next = |below: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % below
    };
    for _ in 0..300 {
        let mut bytes = good.clone();
        for _ in 0..=next(3) {
            let start = next(bytes.len());
            let end = (start + next(40)).min(bytes.len());
            match next(4) {
                0 => drop(bytes.drain(start..end)),
                1 => bytes[start] = next(256) as u8,
                2 => bytes[start] = b"=[]{}\"'#\n.0x-"[next(13)],
                _ => {
                    let copy = bytes[start..end].to_vec();
                    let at = next(bytes.len());
                    bytes.splice(at..at, copy);
                }
            }
        }
        let (_, answer) = findings(&bytes);
        for finding in answer["findings"].as_array().unwrap() {
            let related = finding["related"].as_array().unwrap().iter().map(|related| &related["location"]);
            for place in [&finding["location"]].into_iter().chain(related) {
                let (start, end) = (place["offset"].as_u64().unwrap(), place["end_offset"].as_u64().unwrap());
                assert!(start <= end && end <= bytes.len() as u64, "{finding}");
            }
            assert_ne!(finding["message"], "", "{finding}");
        }
    }
}

fn page() -> String {
    let path = edskit_tests::root().join("docs/gateway-parameters.md");
    String::from_utf8(edskit_tests::read(&path)).expect("the page is UTF-8")
}

#[test]
fn the_example_of_the_page_is_right() {
    let page = page();
    let (_, rest) = page.split_once("```toml\n").expect("the page has an example");
    let (example, _) = rest.split_once("```").expect("the example ends");
    let output = check(&["-"], example.as_bytes());
    assert_eq!(output.exit, Exit::Clean, "{}", output.stdout);
    insta::assert_snapshot!("page", output.stdout);
}

/// The tables of parameters are those of `edskit-devices`.
#[test]
fn the_page_lists_every_parameter() {
    let mut rows: Vec<(Parameter, Parameter)> = Vec::new();
    for parameter in parameters() {
        match rows.last_mut() {
            Some((first, last)) if continues(*first, *last, parameter) => *last = parameter,
            _ => rows.push((parameter, parameter)),
        }
    }
    let mut expected = String::new();
    for (owner, title) in [(Owner::Gateway, "`[gateway]`"), (Owner::Governor, "`[governor]`")] {
        expected
            .push_str(&format!("| {title} | name | values | default | meaning |\n|---|---|---|---|---|\n"));
        for (first, last) in rows.iter().filter(|(first, _)| first.owner() == owner) {
            expected.push_str(&row(*first, *last));
        }
        expected.push('\n');
    }
    assert!(page().contains(&expected), "the page should have\n\n{expected}");
}

fn continues(first: Parameter, last: Parameter, parameter: Parameter) -> bool {
    parameter.owner() == first.owner()
        && parameter.number() == last.number() + 1
        && parameter.meaning() == first.meaning()
}

fn row(first: Parameter, last: Parameter) -> String {
    let name = |parameter: Parameter| parameter.name().map(|name| format!("`{name}`")).unwrap_or_default();
    let (numbers, names) = match first == last {
        true => (first.number().to_string(), name(first)),
        false => {
            let names = [name(first), name(last)].into_iter().filter(|name| !name.is_empty());
            (format!("{}..{}", first.number(), last.number()), names.collect::<Vec<_>>().join(".."))
        }
    };
    let default = first.amount(first.default_value());
    format!("| {numbers} | {names} | {} | {default} | {} |\n", first.allowed(), first.meaning())
}
