//! `edskit run gateway` in virtual time: whole runs, and what it says where nothing can be run.

use edskit::Exit;
use edskit_tests::{Folder, edskit, edskit_with_input};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Runs the gateway with files of the fixtures.
fn simulate(parameters: &str, scenario: &str, seconds: &str, rest: &[&str]) -> edskit_tests::Output {
    let parameters = format!("fixtures/gateway/{parameters}.toml");
    let scenario = format!("fixtures/scenarios/{scenario}.toml");
    let arguments =
        ["run", "gateway", "--params", &parameters, "--scenario", &scenario, "--simulate", seconds];
    edskit(&[&arguments, rest].concat())
}

// GW-CFG-30, GW-APP-17, GW-APP-19, GW-APP-23, GW-APP-27, GW-APP-28, GW-APP-29, GW-APP-34, GW-NOTE-08
#[test]
fn whole_runs() {
    for (parameters, scenario, seconds) in [
        ("node-1", "bus-lost", "3.5"),
        ("node-2", "mended", "2.5"),
        ("node-1", "faults", "9"),
        ("data", "started", "1"),
    ] {
        let output = simulate(parameters, scenario, seconds, &[]);
        assert_eq!(output.exit, Exit::Clean, "{}", output.stderr);
        insta::assert_snapshot!(format!("run_{parameters}_{scenario}"), output.stdout);
    }
}

#[test]
fn a_run_as_json() {
    let output = simulate("node-1", "faults", "9", &["--log", "json"]);
    assert_eq!(output.exit, Exit::Clean);
    for line in output.stdout.lines() {
        let line: serde_json::Value = serde_json::from_str(line).expect("each line is an object");
        assert!(line["time"].is_f64() && line["event"].is_string(), "{line}");
    }
    insta::assert_snapshot!(output.stdout);
    let mended = simulate("node-2", "mended", "1.8", &["--log", "json"]);
    insta::assert_snapshot!("a_refused_run_as_json", mended.stdout);
}

#[test]
fn the_same_run_gives_the_same_lines_and_frames() {
    let folder = Folder::new("gateway-trace");
    let run = |name: &str| {
        let trace = folder.write(name, "");
        let output = simulate("manual", "bus-lost", "3", &["--trace", &trace]);
        assert_eq!(output.exit, Exit::Clean, "{}", output.stderr);
        (output.stdout, String::from_utf8(folder.read(name)).expect("candump writes ASCII"))
    };
    let (lines, frames) = run("one.log");
    assert_eq!((&lines, &frames), (&run("two.log").0, &run("two.log").1));
    let first: Vec<&str> = frames.lines().take(6).collect();
    insta::assert_snapshot!("first_frames", first.join("\n"));
    // GW-NOTE-33, GW-APP-46: the bus is tried every half second, and for the last time after it was mended.
    let tries =
        frames.lines().filter(|line| line.starts_with("(0000000001.") || line.contains("(0000000002."));
    let tries: Vec<&str> = tries.filter(|line| line.contains(" 701#")).collect();
    let times = ["1.500448", "2.000448", "2.500448"].map(|time| format!("(000000000{time}) can0 701#7F"));
    assert_eq!(tries, times);
}

/// The faults of the page with the errors that stand beside them.
fn faults() -> Vec<(String, Vec<String>)> {
    let page = edskit_tests::read(&edskit_tests::root().join("docs/gateway.md"));
    let page = String::from_utf8(page).expect("the page is UTF-8");
    let rows = page.lines().skip_while(|line| *line != "## Faults").take_while(|line| *line != "## The log");
    let cells = rows.filter_map(|row| row.strip_prefix("| `")?.split_once("` | "));
    cells
        .map(|(name, rest)| {
            let errors = rest.split_once(" |").expect("a row has three cells").0;
            let numbers = errors.split(|character: char| !character.is_ascii_digit());
            (name.to_owned(), numbers.filter(|number| !number.is_empty()).map(str::to_owned).collect())
        })
        .collect()
}

// GW-APP-21, GW-APP-22, GW-APP-25, GW-APP-26, GW-APP-31
#[test]
fn each_fault_causes_the_errors_of_the_page() {
    let mut all = String::new();
    for (fault, errors) in faults() {
        let scenario = format!(
            "step = [{{ at = 0.5, nmt = 'start' }}, {{ at = 1, inject = '{fault}' }}, {{ at = 1.1, command = 'init' }}]"
        );
        let arguments = ["run", "gateway", "--scenario", "-", "--simulate", "2"];
        let output = edskit_with_input(&arguments, scenario.as_bytes());
        assert_eq!(output.exit, Exit::Clean, "{}", output.stderr);
        assert!(!errors.is_empty(), "{fault}");
        for error in errors {
            assert!(
                output.stdout.contains(&format!("  error {error} ")),
                "{fault}: {error}: {}",
                output.stdout
            );
        }
        let since = output.stdout.find("    1.000000").expect("the fault comes after a second");
        all += &format!("=== {fault}\n{}", &output.stdout[since..]);
    }
    insta::assert_snapshot!(all);
}

#[test]
fn the_defaults_run_without_files() {
    let output = edskit(&["run", "gateway", "--simulate", "0.25"]);
    assert_eq!((output.exit, output.stderr.as_str()), (Exit::Clean, ""));
    insta::assert_snapshot!(output.stdout);
}

#[test]
fn what_is_wrong_with_a_scenario_is_told_at_once() {
    let output = simulate("only-defaults", "wrong", "5", &[]);
    assert_eq!((output.exit, output.stdout.as_str()), (Exit::Findings, ""));
    insta::assert_snapshot!(output.stderr);
}

#[test]
fn scenarios_of_another_shape() {
    let cases: [(&str, &[u8]); 7] = [
        ("a number", b"step = 5\n"),
        ("a list of numbers", b"step = [5]\n"),
        ("no TOML", b"[[step]\nat = 1\n"),
        ("no UTF-8", b"[[step]]\nat = 1 # \xFF\n"),
        ("one table", b"[step]\nat = 1\n"),
        ("inline", b"step = [{ at = 0.1, clear-errors = true }]\n"),
        ("too late", b"[[step]]\nat = 0.3\nsupply = 7\n\n[[step]]\nat = 0.25\nsupply = 6\n"),
    ];
    let mut all = String::new();
    for (name, input) in cases {
        let output = edskit_with_input(&["run", "gateway", "--scenario", "-", "--simulate", "0.25"], input);
        all += &format!("=== {name}\n{}\n", output.all());
    }
    insta::assert_snapshot!(all);
}

#[test]
fn what_cannot_be_run() {
    let folder = Folder::new("run-gateway");
    let scenario = folder.write("late.toml", "[[step]]\nat = 1\n");
    let cases: [(&str, &[&str]); 9] = [
        ("out_of_range", &["gateway", "--params", "fixtures/gateway/out-of-range.toml", "--simulate", "1"]),
        ("no_parameters", &["gateway", "--params", "nowhere.toml", "--simulate", "1"]),
        ("no_scenario", &["gateway", "--scenario", "nowhere.toml"]),
        ("node_id", &["gateway", "--node-id", "5"]),
        ("trace", &["gateway", "--trace", "trace.txt", "--simulate", "1"]),
        ("nobody", &["gateway", "--scenario", &scenario, "--bus", "socketcand:127.0.0.1:1/can0"]),
        ("bus_in_virtual_time", &["gateway", "--simulate", "1", "--bus", "hub"]),
        ("no_time", &["gateway", "--simulate", "0"]),
        ("not_with_a_file", &["fixtures/generated/Pump.eds", "--scenario", &scenario]),
    ];
    for (name, arguments) in cases {
        let output = edskit(&[&["run"], arguments].concat());
        assert_ne!(output.exit, Exit::Clean, "{name}");
        insta::assert_snapshot!(format!("run_gateway_{name}"), folder.clean(&output));
    }
}

/// The log of a run with these files.
fn run(parameters: &str, scenario: &str, seconds: &str, log: &str) -> String {
    static RUNS: AtomicUsize = AtomicUsize::new(0);
    let folder = Folder::new(&format!("gateway-run-{}", RUNS.fetch_add(1, Ordering::Relaxed)));
    let parameters = folder.write("p.toml", format!("device = \"heinzmann-canopen-gateway\"\n{parameters}"));
    let scenario = folder.write("s.toml", scenario);
    let trace = folder.write("t.log", "");
    let arguments = ["run", "gateway", "--params", &parameters, "--scenario", &scenario];
    let rest = ["--simulate", seconds, "--log", log, "--trace", &trace];
    let output = edskit(&[&arguments[..], &rest].concat());
    assert_eq!(output.exit, Exit::Clean, "{}", output.all());
    let frames = String::from_utf8(folder.read("t.log")).expect("candump writes ASCII");
    format!("{}--- frames\n{frames}", output.stdout)
}

// GW-APP-45, GW-APP-46, GW-APP-27
#[test]
fn a_faulty_bus_in_any_order() {
    let fault = |at: &str| format!("[[step]]\nat = {at}\ninject = \"gateway-can-bus-2\"\n");
    let gone = "[[step]]\nat = 3\nremove = \"gateway-can-bus-2\"\n[[step]]\nat = 4\nclear-errors = true\n";
    let before = run("", &format!("{}{gone}", fault("0")), "5", "text");
    insta::assert_snapshot!("bus_faulty_from_the_start", before);
    let switched = format!(
        "[[step]]\nat = 1\noff = \"gateway\"\n{}[[step]]\nat = 2\non = \"gateway\"\n{gone}",
        fault("1.5")
    );
    insta::assert_snapshot!("bus_faulty_while_off", run("[gateway]\n429 = 250\n", &switched, "5", "text"));
}

// GW-APP-47, GW-APP-48
#[test]
fn every_bad_page_is_told_in_both_logs() {
    for code in [1, 8, 16, 32, 64, 2, 41] {
        let scenario = format!("[[step]]\nat = 1\neeprom = {code}\n[[step]]\nat = 2\nreset = \"gateway\"\n");
        let text = run("", &scenario, "3", "text");
        let json = run("", &scenario, "3", "json");
        assert!(text.contains(&format!("error 3099 EEPROMErrorCode = {code:04X}h: ")), "{text}");
        let told = json.lines().find(|line| line.contains("\"number\":3099")).unwrap_or_default();
        let told: serde_json::Value = serde_json::from_str(told).expect("each line is an object");
        assert_eq!((&told["event"], &told["value"]), (&"error".into(), &code.into()), "{json}");
        assert!(!text.contains("3074") || code & 1 == 0, "{text}");
        assert_eq!(text.contains("bootloader"), code & 1 == 1, "{text}");
    }
}

// GW-APP-51, GW-APP-52, GW-APP-40
#[test]
fn values_are_read() {
    let scenario = r#"
[[step]]
at = 1
read = { gateway = [2411, 12403, 3600, 3840, 3844, 3170, 400, 427, 16404, 3851], governor = [12403, 3074, 400, 2031, 812] }

[[step]]
at = 1.5
pc-tool = 4711
store = "gateway"
inject = "gateway-transmit-buffer-1"
supply = 7.25
read = { gateway = [2401, 3071, 3600, 3085, 3171, 3850, 3851, "CanOpStopped"], governor = ["Speed", 12422] }

[[step]]
at = 1.6
off = "governor"
read = { governor = 12403, gateway = 2405 }

[[step]]
at = 2
eeprom = 1
[[step]]
at = 2.1
reset = "gateway"
[[step]]
at = 2.5
read = { gateway = [3099, 2411] }
"#;
    let parameters = "[gateway]\n16404 = 0x1C5\n";
    let lines = |log: &str| {
        let text = run(parameters, scenario, "3", log);
        let lines: Vec<&str> = text
            .lines()
            .filter(|line| line.contains("value") || line.contains(" = ") || line.contains("read"))
            .collect();
        lines.join("\n")
    };
    insta::assert_snapshot!("values_as_text", lines("text"));
    insta::assert_snapshot!("values_as_json", lines("json"));
    let unknown = "[[step]]\nat = 0.1\nread = { gateway = [2406, 9999, 2000, \"CanDCNodeStat15to01\", 2.5], governor = [9999, 2411], pump = 1 }\n";
    let output =
        edskit_with_input(&["run", "gateway", "--scenario", "-", "--simulate", "1"], unknown.as_bytes());
    assert_eq!(output.exit, Exit::Findings);
    insta::assert_snapshot!("values_that_are_not_known", output.stderr);
}

// GW-APP-49, GW-NOTE-46, GW-NOTE-47, GW-APP-50
#[test]
fn what_the_manual_says_goes_over_the_bus() {
    let overflow = "[[step]]\nat = 1\ninject = \"canopen-buffer-1\"\n";
    insta::assert_snapshot!("overflow_of_the_canopen_buffer", run("", overflow, "2", "text"));
    let again = "[[step]]\nat = 0.5\nnmt = \"start\"\n[[step]]\nat = 1\nnmt = \"stop\"\n[[step]]\nat = 1.5\nnmt = \"start\"\n";
    let frames = run("[governor]\n14401 = 1\n14402 = 1\n", again, "2", "text");
    // The engine runs up, so that the status changes; errors do not.
    for (can_id, count) in [(" 181#", 1), (" 281#", 1)] {
        assert_eq!(frames.matches(can_id).count(), count, "{frames}");
    }
    let sensor = "[governor]\n900 = 1\n4900 = 3\n16481 = 100\n16400 = 2031\n16460 = 16\n";
    let start = "[[step]]\nat = 0.5\nengine = { setpoint = 1500 }\n[[step]]\nat = 1\nnmt = \"start\"\n";
    let frames = run(sensor, start, "1.5", "text");
    let setpoints: Vec<&str> = frames.lines().filter_map(|line| line.split(" 481#").nth(1)).collect();
    assert!(setpoints.len() > 20 && setpoints.iter().all(|setpoint| *setpoint == "DC05"), "{setpoints:?}");
    let apart = run("[gateway]\n427 = 5\n416 = 500\n[governor]\n416 = 250\n", "", "3", "text");
    insta::assert_snapshot!("bit_rates_apart", apart);
    let mended = "[[step]]\nat = 1\ngovernor = { 416 = 500 }\nstore = \"governor\"\n[[step]]\nat = 1.5\nreset = \"governor\"\n";
    let mended = run("[gateway]\n416 = 500\n", mended, "3", "text");
    assert!(mended.contains("pre-operational") && mended.contains(" 701#00"), "{mended}");
}
