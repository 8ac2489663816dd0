//! `edskit run gateway` in virtual time: whole runs, and what it says where nothing can be run.

use edskit::Exit;
use edskit_tests::{Folder, edskit, edskit_with_input};

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
    // GW-NOTE-33: the bus is tried every half second.
    let tries =
        frames.lines().filter(|line| line.starts_with("(0000000001.") || line.contains("(0000000002."));
    let tries: Vec<&str> = tries.filter(|line| line.contains(" 701#")).collect();
    assert_eq!(tries, ["(0000000001.500448) can0 701#7F", "(0000000002.000448) can0 701#7F"]);
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
