//! Gateway and governor in one parameter file: what must agree, what is switched, what is not known.

use edskit::Exit;
use edskit_tests::{Output, edskit_with_input};
use serde_json::Value;

const DEVICE: &str = "device = \"heinzmann-canopen-gateway\"\n";

fn run(arguments: &[&str], parameters: &str) -> Output {
    edskit_with_input(arguments, format!("{DEVICE}{parameters}").as_bytes())
}

fn check(parameters: &str) -> String {
    run(&["config", "check", "-"], parameters).stdout
}

/// The codes of the findings with their severities, and the whole answer.
fn findings(parameters: &str) -> (Vec<(String, String)>, Value) {
    let output = run(&["config", "check", "-", "--format", "json"], parameters);
    let answer: Value = serde_json::from_str(&output.stdout).expect("the answer is JSON");
    let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    let list = answer["findings"].as_array().expect("findings are a list").iter();
    (list.map(|finding| (text(&finding["code"]), text(&finding["severity"]))).collect(), answer)
}

/// Parameters of both units with which they do not hear each other, and a word of the reason.
const APART: [(&str, &str); 12] = [
    ("[gateway]\n427 = 5\n416 = 500\n[governor]\n416 = 250\n", "500 kbit/s in the gateway"),
    ("[gateway]\n416 = 500\n", "P416 CanBaudrate is 250 kbit/s"),
    ("[governor]\n409 = 1000\n", "1000 kbit/s in the governor"),
    ("[governor]\n416 = 125\n409 = 125\n", "125 kbit/s in the governor"),
    ("[gateway]\n401 = 2\n402 = 5\n[governor]\n401 = 4\n403 = 1\n", "P402 CanDCNodeNumber is 5"),
    ("[gateway]\n401 = 2\n", "P401 CanMyNodeNumber is 2 in the gateway"),
    ("[gateway]\n402 = 2\n", "P402 CanDCNodeNumber is 2 in the gateway"),
    ("[governor]\n401 = 3\n", "P401 CanMyNodeNumber is 3 in the governor"),
    ("[governor]\n403 = 31\n", "P403 CanCMNodeNumber is 31 in the governor"),
    ("[gateway]\n4400 = 0\n", "P4400 HzmCanCommDCOn is 0"),
    ("[governor]\n4406 = 0\n", "P4406 CanCommCMOn is 0"),
    ("[gateway]\n4400 = 0\n428 = 1\n", "P4400 HzmCanCommDCOn is 0"),
];

// GW-CFG-46, GW-CFG-48, GW-CFG-32, GW-CFG-33, GW-CFG-34, GW-NOTE-37
#[test]
fn check_dcf_and_device_give_one_reason() {
    for (parameters, reason) in APART {
        let (found, answer) = findings(parameters);
        assert!(!found.is_empty(), "{parameters}");
        assert_eq!(answer["accepted"], false, "{parameters}");
        let apart = answer["apart"].as_str().unwrap_or_default();
        assert!(apart.contains(reason), "{parameters}: {apart}");
        let text = check(parameters);
        assert!(!text.contains("passes") && text.contains(apart), "{text}");
        let dcf = run(&["config", "dcf", "-"], parameters);
        assert_eq!((dcf.exit, dcf.stdout.as_str()), (Exit::Findings, ""), "{parameters}");
        assert!(dcf.stderr.contains(apart), "{}", dcf.stderr);
        let live = run(&["run", "gateway", "--params", "-", "--simulate", "3"], parameters);
        assert!(live.stdout.contains(apart), "{}", live.stdout);
        assert!(!live.stdout.contains("pre-operational"), "{}", live.stdout);
    }
    for parameters in ["", "[gateway]\n416 = 500\n401 = 7\n[governor]\n409 = 500\n403 = 7\n"] {
        let (found, answer) = findings(parameters);
        assert_eq!((found, &answer["accepted"], &answer["apart"]), (vec![], &true.into(), &Value::Null));
        assert_eq!(run(&["config", "dcf", "-"], parameters).exit, Exit::Clean);
    }
}

// GW-CFG-46
#[test]
fn different_bit_rates() {
    insta::assert_snapshot!("bit_rates", check(APART[0].0));
    insta::assert_snapshot!("bit_rate_of_one_unit", check(APART[2].0));
}

// GW-NOTE-37
#[test]
fn one_parameter_with_two_numbers() {
    for (parameters, expected) in [
        ("409 = 250\n416 = 250", None),
        ("4409 = 1\n4416 = 1", None),
        ("409 = 250\n416 = 500", Some("GWC006")),
        ("4409 = 0\n4416 = 1", Some("GWC006")),
    ] {
        let (found, _) = findings(&format!("[governor]\n{parameters}\n"));
        let codes: Vec<&str> = found.iter().map(|(code, _)| code.as_str()).collect();
        let is_found = expected.is_some_and(|code| codes.contains(&code));
        assert_eq!(is_found, expected.is_some(), "{parameters}: {codes:?}");
    }
    insta::assert_snapshot!("two_numbers", check("[governor]\n409 = 250\n416 = 500\n"));
}

// GW-CFG-47
#[test]
fn bit_timings_need_their_switch() {
    let timings: [(&str, std::ops::RangeInclusive<u16>, &[u16]); 3] = [
        ("gateway", 410..=415, &[4416]),
        ("gateway", 420..=425, &[4426]),
        ("governor", 410..=414, &[4416, 4409]),
    ];
    for (unit, segments, switches) in timings {
        for segment in segments {
            let file = |rest: &str| format!("[{unit}]\n{segment} = 1\n{rest}\n");
            let (found, answer) = findings(&file(""));
            assert_eq!(found, [("GWC029".to_owned(), "warning".to_owned())], "{unit} {segment}");
            let help = answer["findings"][0]["help"].as_str().unwrap_or_default();
            assert!(help.contains(&format!("{} = 1", switches[0])), "{help}");
            for switch in switches {
                let has = |rest: &str| findings(&file(rest)).0.iter().any(|(code, _)| code == "GWC029");
                assert!(has(&format!("{switch} = 0")) && !has(&format!("{switch} = 1")), "{unit} {segment}");
            }
            let (zero, _) = findings(&format!("[{unit}]\n{segment} = 0\n"));
            assert_eq!(zero, []);
        }
    }
    let example = "[gateway]\n410 = 3\n413 = 5\n414 = 2\n4416 = 0\n420 = 1\n423 = 5\n424 = 2\n4426 = 0\n";
    insta::assert_snapshot!("bit_timings", check(example));
}

// GW-NOTE-48
#[test]
fn what_cannot_be_compared_is_mentioned() {
    for (parameters, is_mentioned) in [
        ("[gateway]\n4416 = 1\n410 = 3\n", true),
        ("[governor]\n4409 = 1\n410 = 3\n", true),
        ("[gateway]\n4416 = 1\n410 = 3\n[governor]\n4416 = 1\n410 = 3\n", false),
        ("[gateway]\n4416 = 1\n410 = 3\n[governor]\n4416 = 1\n410 = 4\n", true),
        ("[gateway]\n4416 = 1\n415 = 3\n[governor]\n4416 = 1\n", false),
        // The bit rates do not count with both timings set by hand, whatever they are.
        ("[gateway]\n4416 = 1\n416 = 500\n[governor]\n4416 = 1\n", false),
        ("[gateway]\n4426 = 1\n420 = 3\n", false),
    ] {
        let (found, answer) = findings(parameters);
        let expected: &[(&str, &str)] = if is_mentioned { &[("GWC030", "info")] } else { &[] };
        let found: Vec<(&str, &str)> =
            found.iter().map(|(code, severity)| (code.as_str(), severity.as_str())).collect();
        assert_eq!((&found[..], &answer["accepted"]), (expected, &true.into()), "{parameters}");
    }
}

// GW-GAP-15
#[test]
fn what_is_not_known_of_the_governor_is_one_warning() {
    for number in [1800, 402, 415, 420, 424, 430, 4400, 4426, 2950, 12401, 9] {
        let (found, answer) = findings(&format!("[governor]\n{number} = 1\n"));
        assert_eq!(found, [("GWC004".to_owned(), "warning".to_owned())], "{number}");
        assert!(answer["configuration"]["pdos"].is_array(), "{number}: the table is shown");
    }
    let list: String = (2000..2200).map(|number| format!("{number} = 1\n")).collect();
    let (found, answer) = findings(&format!("[governor]\n{list}14401 = 1\n"));
    assert_eq!(found, [("GWC004".to_owned(), "warning".to_owned())]);
    assert!(answer["findings"][0]["message"].as_str().is_some_and(|text| text.contains("200")));
    let text = check(&format!("[governor]\n{list}14401 = 1\n"));
    assert!(text.lines().count() < 70, "{}", text.lines().count());
    insta::assert_snapshot!("a_full_list", text);
    let (_, single) = findings("[governor]\n16484 = 100\n");
    let help = single["findings"][0]["help"].as_str().unwrap_or_default();
    assert!(help.contains("unless P16483 CanOpRPDO1-4Cyc(3) was meant"), "{help}");
    // The same in a scenario, where the key is another one.
    let scenario = "[[step]]\nat = 0.1\ngovernor = { 1800 = 6, 402 = 1 }\n";
    let output =
        edskit_with_input(&["run", "gateway", "--scenario", "-", "--simulate", "0.3"], scenario.as_bytes());
    assert_eq!(output.exit, Exit::Clean, "{}", output.stderr);
    assert_eq!(output.stderr.matches("GWC004").count(), 1, "{}", output.stderr);
}

// GW-PDO-19
#[test]
fn bits_that_the_manual_names_are_left_out() {
    let bits = [3005, 3006, 3070, 3071, 3074, 4406, 4409, 4416, 12401, 12402, 12403, 12404, 14401, 14402];
    let can_open = (12411..=12415).chain(12419..=12424);
    for bit in bits.into_iter().chain(can_open) {
        let file =
            format!("[governor]\n16404 = 2000\n16405 = {bit}\n16461 = 100\n[gateway]\n16404 = 0x1C5\n");
        let (found, answer) = findings(&file);
        assert_eq!(found, [("GWC017".to_owned(), "warning".to_owned())], "{bit}");
        let pdos = answer["configuration"]["pdos"].as_array().unwrap();
        let tpdo = pdos.iter().find(|pdo| pdo["name"] == "TPDO5").unwrap();
        assert_eq!(tpdo["bytes"], 2, "{bit}");
        // Alone it is no reason to be active, also for what 7.3 forbids.
        let (found, answer) =
            findings(&format!("[governor]\n16404 = {bit}\n16461 = 100\n[gateway]\n16404 = 0x080\n"));
        assert!(found.iter().all(|(code, _)| code == "GWC017"), "{bit}: {found:?}");
        assert_eq!(answer["accepted"], true, "{bit}");
        // A description makes no more of it, and that is said.
        let described = format!("{file}[governor.signals]\n{bit} = \"u16\"\n");
        let (found, answer) = findings(&described);
        let is_named = ![3006].contains(&bit);
        let codes: Vec<&str> = found.iter().map(|(code, _)| code.as_str()).collect();
        assert_eq!(codes.contains(&"GWC010"), is_named, "{bit}: {codes:?}");
        let pdos = answer["configuration"]["pdos"].as_array().unwrap();
        let tpdo = pdos.iter().find(|pdo| pdo["name"] == "TPDO5").unwrap();
        assert_eq!(tpdo["bytes"] == 2, is_named, "{bit}");
    }
    // Its other parameters are known with their sign.
    for (number, object) in [
        (401, 0x2001),
        (409, 0x2001),
        (827, 0x2002),
        (811, 0x2002),
        (900, 0x2001),
        (4827, 0x2001),
        (16460, 0x2001),
    ] {
        let (found, answer) = findings(&format!("[governor]\n16400 = {number}\n16460 = 100\n"));
        assert_eq!(found, [], "{number}");
        let pdos = answer["configuration"]["pdos"].as_array().unwrap();
        let word = &pdos.iter().find(|pdo| pdo["name"] == "TPDO4").unwrap()["content"][0];
        assert_eq!(word["index"], object, "{number}");
    }
}
