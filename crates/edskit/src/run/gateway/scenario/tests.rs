use super::reading::steps_of;
use super::words::KEYS;
use super::*;
use crate::config::KnownSignals;

/// The actions of a file that is right, as the log names them, with their times in µs.
fn actions(text: &str) -> Vec<(u64, String)> {
    let (steps, problems) = steps_of(text.as_bytes(), None, &KnownSignals::default());
    assert!(problems.is_empty(), "{problems:?}");
    let of_step = |step: &Step| {
        let at = step.at.0;
        let shown =
            |action: &Action| (at, format!("{} {}", action.key(), action.value()).trim_end().to_owned());
        step.actions.iter().map(shown).collect::<Vec<_>>()
    };
    steps.iter().flat_map(of_step).collect()
}

#[test]
fn steps_are_sorted_by_their_times_and_else_stay_in_order() {
    let text = "[[step]]\nat = 2\nsupply = 7\n[[step]]\nat = 0.000001\nsupply = 1\n[[step]]\nat = 2.0\nsupply = 3.5\n\
                [[step]]\nat = 0\nsupply = 0\n";
    let expected =
        [(0, "supply 0 V"), (1, "supply 1 V"), (2_000_000, "supply 7 V"), (2_000_000, "supply 3.5 V")];
    assert_eq!(actions(text), expected.map(|(at, action)| (at, action.to_owned())));
    assert_eq!(actions(""), []);
}

/// Every key in one step, backwards, with everything that it can hold.
const EVERYTHING: &str = r#"
[[step]]
read = { governor = [12403, "Speed"], gateway = [2411, "PowerSupply", "P427"] }
nmt = "reset-node"
command = "pre-operational"
clear-errors = true
remove = ["link-broken", "data"]
inject = "gateway-can-bus-2"
engine-error-gone = [3000]
engine-error = [3069, 3001]
engine = { running = false, load = 12.5, setpoint = 1200 }
eeprom = 0x21
supply = 7.499
store = "both"
pc-tool = 4711
governor = { CanOpenSendErrors = 1 }
gateway = { P427 = 5, "16404 CanOpTPDO5-16ID(0)" = 0x1C5, 400 = 1.5 }
reset = "governor"
on = "both"
off = "gateway"
at = 1.5
"#;

#[test]
fn keys_are_carried_out_in_their_order_whatever_that_of_the_file_is() {
    let actions: Vec<String> = actions(EVERYTHING).into_iter().map(|(_, action)| action).collect();
    insta::assert_snapshot!(actions.join("\n"));
    let mut keys: Vec<&str> =
        actions.iter().map(|action| action.split(' ').next().unwrap_or_default()).collect();
    keys.dedup();
    assert_eq!(keys, KEYS);
}

/// The second cells of a table's rows whose first cells are one of `words`.
fn rows<'p>(page: &'p str, word: &str) -> Vec<&'p str> {
    let start = format!("| `{word}` |");
    page.lines().filter(|line| line.starts_with(&start)).collect()
}

#[test]
fn the_page_has_every_key_in_order_and_every_fault() {
    let page = include_str!("../../../../../../docs/gateway.md");
    let positions: Vec<usize> = ["at"]
        .into_iter()
        .chain(KEYS)
        .map(|key| page.find(&format!("\n| `{key}` |")).unwrap_or_else(|| panic!("{key} is missing")))
        .collect();
    assert!(positions.is_sorted(), "{positions:?}");
    for fault in Fault::ALL {
        assert_eq!(rows(page, fault_name(fault)).len(), 1, "{fault:?}");
    }
}
