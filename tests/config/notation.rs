//! What people type from the manual or copy from the PC tool, in parameter files and scenarios.

use edskit::Exit;
use edskit_devices::gateway::{Owner, Quantity, parameters};
use edskit_tests::edskit_with_input;
use serde_json::Value;

const DEVICE: &str = "device = \"heinzmann-canopen-gateway\"\n";

/// The findings of a parameter file: code, message and help of each.
fn findings(text: &str) -> Vec<(String, String, String)> {
    let output = edskit_with_input(&["config", "check", "-", "--format", "json"], text.as_bytes());
    let answer: Value = serde_json::from_str(&output.stdout).expect("the answer is JSON");
    let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    let list = answer["findings"].as_array().expect("findings are a list").iter();
    list.map(|finding| (text(&finding["code"]), text(&finding["message"]), text(&finding["help"]))).collect()
}

/// The only finding of a line in a table.
#[track_caller]
fn answer(table: &str, line: &str) -> (String, String) {
    let found = findings(&format!("{DEVICE}[{table}]\n{line}\n"));
    let [(_, message, help)] = &found[..] else { panic!("{line}: {found:?}") };
    assert!(!message.contains("TOML: ") && !message.contains("literal string"), "{line}: {message}");
    (message.clone(), help.clone())
}

// GW-CFG-31, GW-CFG-41, GW-CFG-42
#[test]
fn the_help_has_the_line_as_it_has_to_be() {
    for (table, line, help) in [
        ("gateway", "16404 = 57F", "write `16404 = 0x57F`"),
        ("gateway", "16404 = 57Fh", "write `16404 = 0x57F`"),
        ("gateway", "16404 = 282 Hex", "write `16404 = 0x282`"),
        ("gateway", "16404 = 0X282", "write `16404 = 0x282`"),
        ("gateway", "16404 = 0282", "write `16404 = 0x282`"),
        ("gateway", "16404 = 5E2", "write `0x5E2`"),
        ("gateway", "16404 = \"57F\"", "write `0x57F`"),
        ("gateway", "16404 = C5", "write `16404 = 0xC5`"),
        ("gateway", "16404 = $282", "write `16404 = 0x282`"),
        ("gateway", "16404 = 0x282h # TPDO5", "write `16404 = 0x282`"),
        ("gateway", "400 = 1,0", "write `400 = 1.0`"),
        ("gateway", "400 = 1.5 s", "write `400 = 1.5`"),
        ("gateway", "400 = 1,5s", "write `400 = 1.5`"),
        ("gateway", "400 = 500 ms", "write `400 = 0.5`"),
        ("gateway", "429 = 1000 ms", "write `429 = 1000`"),
        ("gateway", "429 = 1 s", "write `429 = 1000`"),
        ("gateway", "429 = 1.000", "write `1`, or `1000` if it divides thousands"),
        ("gateway", "429 = 1e3", "write `1000`"),
        ("gateway", "426 = 125 kBit/s", "write `426 = 125`"),
        ("gateway", "426 = 1 MBit/s", "write `426 = 1000`"),
        ("gateway", "427 = 05", "write `427 = 5`"),
        ("gateway", "427 = 7Fh", "write `427 = 0x7F`"),
        ("gateway", "427 = 5 ; our node", "write `427 = 5`"),
        ("gateway", "427: 5", "write `427 = 5`"),
        ("gateway", "427 = 5,", "write `427 = 5`"),
        ("gateway", "\"427\" \"CanOpenMyNodeID\" = 1", "write `\"427 CanOpenMyNodeID\" = 1`"),
        ("gateway", "400 = .5", "write `400 = 0.5`"),
        ("gateway", "400 = 1.", "write `400 = 1.0`"),
        ("gateway", "427 == 5", "write `427 = 5`"),
        ("gateway", "4426 = ein", "write `4426 = 1`"),
        ("gateway", "4426 = true", "write `1`"),
        ("gateway", "427 CanOpenMyNodeID = 1", "write `\"427 CanOpenMyNodeID\" = 1`"),
        ("gateway", "P427 CanOpenMyNodeID = 1", "write `\"427 CanOpenMyNodeID\" = 1`"),
        ("gateway", "427\tCanOpenMyNodeID = 1", "write `\"427 CanOpenMyNodeID\" = 1`"),
        ("gateway", "427.CanOpenMyNodeID = 1", "write `\"427 CanOpenMyNodeID\" = 1`"),
        ("gateway", "CanOpTPDO5-16ID(0) = 0x282", "write `\"CanOpTPDO5-16ID(0)\" = 0x282`"),
        ("gateway", "CanOpTPDO5-16ID[0] = 0x282", "write `\"CanOpTPDO5-16ID(0)\" = 0x282`"),
        ("gateway", "16404 CanOpTPDO5-16ID(0) = 282 Hex", "write `\"16404 CanOpTPDO5-16ID(0)\" = 0x282`"),
        ("gateway", "\"16404 CanOpTPDO5-16ID(0)\" = 57F", "write `\"16404 CanOpTPDO5-16ID(0)\" = 0x57F`"),
        ("gateway", "4416 HzmCanSegmentOrBaurdate = 0", "write `\"4416 HzmCanSegmOrBaudrate\" = 0`"),
        ("gateway", "427 CanOpenMyNodeID 1", "write `\"427 CanOpenMyNodeID\" = 1`"),
        ("gateway", "400 CanStartTimeOutDelay 1,0 s", "write `\"400 CanStartTimeOutDelay\" = 1.0`"),
        ("gateway", "16415;CanOpTPDO5-16ID(11);57F;Hex", "write `\"16415 CanOpTPDO5-16ID(11)\" = 0x57F`"),
        ("gateway", "429\tCanOpHeartBeatTxTime\t1000\tms", "write `\"429 CanOpHeartBeatTxTime\" = 1000`"),
        ("governor", "16481 CanOpRPDO1-4Cyc (1) = 100", "write `\"16481 CanOpRPDO1-4Cyc(1)\" = 100`"),
        ("governor", "CanOpTPDO4-16Cyc (11) 100 ms", "write `\"CanOpTPDO4-16Cyc(11)\" = 100`"),
        ("governor", "AssignIn Setp1Ext = 1", "write `AssignIn_Setp1Ext = 1`"),
        ("governor", "835 = \u{2212}5", "write `835 = -5`"),
        ("governor", "835 FunctLoadEnable -5", "write `\"835 FunctLoadEnable\" = -5`"),
        ("governor.signals", "2950 = i16", "write `2950 = \"i16\"`"),
        (
            "governor.signals",
            "2950 ExhaustTemp = \"i16\"",
            "write `2950 = { name = \"ExhaustTemp\", type = \"i16\" }`",
        ),
    ] {
        let (message, found) = answer(table, line);
        assert!(found.starts_with(help), "{line}: {message}: {found}");
    }
    let found = findings("device = heinzmann-canopen-gateway\n[gateway]\n427 = 5\n");
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].2.contains("write `device = \"heinzmann-canopen-gateway\"`"));
}

/// Following the help always leads to a file that is understood.
#[test]
fn what_the_help_says_is_right() {
    for parameter in parameters() {
        let (table, number) = match parameter.owner() {
            Owner::Gateway => ("gateway", parameter.number()),
            Owner::Governor => ("governor", parameter.number()),
        };
        let value = parameter.default_value();
        let amount = parameter.amount(value).to_string().replace('.', ",");
        let printed = match parameter.quantity() {
            Quantity::Identifier => format!("{amount} Hex"),
            _ => amount,
        };
        let name = parameter.name().map(|name| format!(" {name}")).unwrap_or_default();
        let line = format!("{number}{name} = {printed}");
        let found = findings(&format!("{DEVICE}[{table}]\n{line}\n"));
        let Some((_, _, help)) = found.first() else { continue };
        let better = help.split('`').nth(1).unwrap_or_default();
        assert_eq!(findings(&format!("{DEVICE}[{table}]\n{better}\n")), [], "{line}: {help}");
    }
}

#[test]
fn a_file_with_everything_is_told_at_once() {
    let text = "[gateway]\n16404 = 57F\n400 = 1,0\n427 = 5\n429 = 1000 ms\n427 CanOpenMyNodeID = 1\n428 = 300\n\
                CanOpTPDO5-16ID(1) = 0x282\n[governor]\n2950 ExhaustTemp = 12,5\n[governor\n";
    let output = edskit_with_input(&["config", "check", "-"], format!("{DEVICE}{text}").as_bytes());
    assert_eq!(output.exit, Exit::Findings);
    insta::assert_snapshot!(output.stdout);
}

#[test]
fn a_pasted_table_is_not_told_row_by_row() {
    let rows: String = (16404..=16415).map(|number| format!("{number};;57F;Hex\n")).collect();
    let more: String = (410..=430)
        .filter(|number| ![417, 418, 419].contains(number))
        .map(|number| format!("{number};;1;\n"))
        .collect();
    let found = findings(&format!("{DEVICE}[gateway]\n{rows}{more}"));
    assert_eq!(found.len(), 20, "{found:?}");
    assert!(found.iter().any(|(_, _, help)| help.contains("`edskit config import`")), "{found:?}");
}

/// GW-NOTE-43: what the manual prints in its examples.
#[test]
fn names_as_the_examples_print_them() {
    for (table, key) in [
        ("gateway", "4416 HzmCanSegmentOrBaurdate"),
        ("gateway", "HzmCanSegmentOrBaurdate"),
        ("gateway", "4426 CanOpSegmentOrBaurdate"),
        ("gateway", "CanOpSegmentOrBaurdate"),
        ("gateway", "16404 CanOpTPDO5-16ID"),
        ("governor", "4409 CanSegmentOrBaurdate"),
        ("governor", "CanSegmentOrBaurdate"),
        ("governor", "16481 CanOpRPDO1-4Cyc (1)"),
        ("governor", "CanOpRPDO1-4Cyc (1)"),
        ("governor", "CanOpTPDO4-16Cyc (11)"),
        ("governor", "4811 Type IdleSpeed"),
        ("governor", "AssignIn Setp1Ext"),
        ("governor", "4900 ChanType_Setp1ext"),
    ] {
        assert_eq!(findings(&format!("{DEVICE}[{table}]\n\"{key}\" = 0\n")), [], "{key}");
    }
    for (table, key) in [
        ("gateway", "427 CanOpenBaudrate"),
        ("gateway", "4416 CanOpSegmentOrBaurdate"),
        ("governor", "4901 ChanType_Setp1Ext"),
        ("governor", "812 FunctIdleSpeed"),
        ("governor", "16481 CanOpRPDO1-4Cyc (2)"),
    ] {
        let found = findings(&format!("{DEVICE}[{table}]\n\"{key}\" = 1\n"));
        assert!(found.iter().any(|(code, ..)| code == "GWC007"), "{key}: {found:?}");
    }
}

/// Decimal digits of an identifier that run into a rule: that the other notation may be meant is part of the one finding.
#[test]
fn decimal_identifiers_that_run_into_a_rule() {
    let file = |node_id: u8, identifier: &str, more: &str| {
        format!(
            "{DEVICE}[gateway]\n427 = {node_id}\n16404 = {identifier}\n{more}[governor]\n14401 = 1\n16404 = 2000\n16461 = 100\n"
        )
    };
    for (node_id, identifier, meant, more) in [
        (1, "282", "0x282", ""),
        (1, "385", "0x385", ""),
        (1, "256", "0x256", ""),
        (1, "128", "0x128", ""),
        (9, "393", "0x393", ""),
        (1, "100", "0x100", ""),
    ] {
        let text = file(node_id, identifier, more);
        let found = findings(&text);
        let about: Vec<_> = found
            .iter()
            .filter(|(code, ..)| ["GWC011", "GWC013", "GWC024"].contains(&code.as_str()))
            .collect();
        let [(code, _, help)] = &about[..] else { panic!("{identifier}: {found:?}") };
        assert!(["GWC011", "GWC013"].contains(&code.as_str()), "{identifier}: {found:?}");
        let first = help.find("`0x").map(|at| &help[at + 1..at + 1 + meant.len()]);
        assert_eq!(first, Some(meant), "{identifier}: {help}");
        assert!(!help.contains("such as"), "{help}");
    }
    // Of two, each that is written so.
    let found = findings(&format!(
        "{DEVICE}[gateway]\n16404 = 445\n16405 = 0x1BD\n[governor]\n16404 = 2000\n16461 = 100\n16408 = 2000\n16462 = 100\n"
    ));
    let [(code, _, help)] = &found[..] else { panic!("{found:?}") };
    assert!(code == "GWC011" && help.contains("`0x445` if the 445h"), "{help}");
    // Without a rule in the way it is an info, as before.
    let found = findings(&file(1, "1666", ""));
    assert_eq!(found.iter().map(|(code, ..)| code.as_str()).collect::<Vec<_>>(), ["GWC024"]);
    let found = findings(&file(1, "0b11010000010", ""));
    assert!(found[0].1.contains("in binary digits"), "{found:?}");
    insta::assert_snapshot!(
        edskit_with_input(&["config", "check", "-", "--quiet"], file(1, "282", "").as_bytes()).stdout
    );
}

fn scenario(text: &str) -> edskit_tests::Output {
    edskit_with_input(&["run", "gateway", "--scenario", "-", "--simulate", "1"], text.as_bytes())
}

#[test]
fn scenarios_are_answered_in_the_same_way() {
    for (step, help) in [
        ("gateway = { 400 = 1,5 }", "write `400 = 1.5`"),
        ("gateway = { 427 = 5, 16404 = 57F, 400 = 1,5 }", "write `16404 = 0x57F`"),
        ("gateway = { 429 = 1000 ms }", "write `429 = 1000`"),
        ("gateway = { 16404 CanOpTPDO5-16ID(0) = 282 }", "write `\"16404 CanOpTPDO5-16ID(0)\" = 0x282`"),
        ("gateway = { 16404 = 5E2 }", "write `0x5E2`"),
        ("governor = { CanOpRPDO1-4Cyc (1) = 100 }", "write `\"CanOpRPDO1-4Cyc(1)\" = 100`"),
        ("[step.gateway]\n429 = 1000 ms", "write `429 = 1000`"),
        // TOML, and probably another number than it looks.
        (
            "gateway = { 16404 = 282 }",
            "write `0x11A`, or `0x282` if the 282h of the manual's notation is meant",
        ),
        // Advice names what stands in a step.
        ("gateway = { 16460 = 3 }", "write it in `governor = { .. }`"),
        ("gateway = { CanCommCMOn = 1 }", "write it in `governor = { .. }`"),
        ("governor = { 427 = 3 }", "write it in `gateway = { .. }`"),
        ("gateway = { 2411 = 3 }", "`read = { gateway = [2411] }` reads it"),
    ] {
        let output = scenario(&format!("[[step]]\nat = 0.5\n{step}\n"));
        let text = output.stderr.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(text.contains(help), "{step}: {text}");
        assert!(!text.contains("[governor]") && !text.contains("this is no TOML"), "{step}: {text}");
    }
}
