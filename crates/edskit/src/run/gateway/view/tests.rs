use super::*;
use crate::Streams;
use crate::config;
use crate::run::gateway::{gateway, scenario, session::Session};
use edskit_host::{Bus as _, Participant, VirtualBus};
use edskit_runtime::Frame as CanFrame;
use edskit_types::{Bitrate, CanId};
use ratatui::Terminal;
use ratatui::backend::TestBackend;
use std::path::{Path, PathBuf};

/// A gateway with the files of the fixtures, and the view of it.
struct Bench {
    session: Session<Participant>,
    /// Somebody else on the bus.
    tool: Participant,
    view: View,
}

impl Bench {
    fn new(parameters: &str, scenario: &str) -> Self {
        let fixtures = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/fixtures"));
        let read = |path: PathBuf| std::fs::read(path).expect("the fixture is there");
        let parameters = read(fixtures.join("gateway").join(parameters));
        Self::of(&parameters, &read(fixtures.join("scenarios").join(scenario)))
    }

    /// With the texts of the two files.
    fn of(parameters: &[u8], scenario: &[u8]) -> Self {
        let streams =
            |input: &[u8]| Streams::of_buffers(input.to_vec(), Box::new(Vec::new()), Box::new(Vec::new()));
        let stdin = Path::new("-");
        let parameters = config::read(stdin, &mut streams(parameters));
        let signals = config::KnownSignals::default();
        let steps = scenario::read(stdin, None, &signals, &mut streams(scenario));
        let device = gateway(parameters.unwrap().expect("the parameters are right"));
        let bus = VirtualBus::new(Bitrate::Kbit125);
        let steps = steps.unwrap().expect("the scenario is right");
        let session = Session::new(device, bus.attach(), Some(bus.attach()), steps);
        let view = View::new("socketcand 127.0.0.1:29536, slcan 127.0.0.1:29537".to_owned());
        Self { session, tool: bus.attach(), view }
    }

    /// Runs until so many milliseconds after the start; `sent` are sent every 50 ms.
    fn run(&mut self, milliseconds: u32, sent: &[CanFrame]) -> &mut Self {
        let end = self.session.instant(Microseconds::from_milliseconds(milliseconds));
        let mut next_sent = self.session.station.bus.now();
        loop {
            let next = self.session.turn().unwrap();
            self.view.add(self.session.take_lines());
            let now = self.session.station.bus.now();
            if now >= next_sent {
                sent.iter().for_each(|frame| self.tool.send(frame).unwrap());
                next_sent = now + Microseconds::from_milliseconds(50);
            }
            if now >= end {
                return self;
            }
            self.session.station.bus.wait(next.min(next_sent).min(end)).unwrap();
        }
    }

    fn picture(&self, width: u16, height: u16) -> String {
        let mut terminal = Terminal::new(TestBackend::new(width, height)).unwrap();
        let (device, time) = (&self.session.station.device, self.session.time());
        terminal.draw(|frame| self.view.draw(frame, device, time)).unwrap();
        terminal.backend().to_string()
    }
}

fn frame(can_id: u16, words: &[u16]) -> CanFrame {
    let data: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
    CanFrame::new(CanId::standard(can_id).unwrap(), &data)
}

/// The gateway of the manual's examples in operational, with RPDOs and the heartbeat of the partner.
fn with_traffic() -> Bench {
    let received = [
        frame(0x201, &[0x0010, 0, 0x0800]),
        frame(0x301, &[1400, 1450]),
        frame(0x401, &[0, 0, 1013]),
        frame(0x501, &[0, 0, 0, 650]),
        CanFrame::new(CanId::standard(0x77F).unwrap(), &[5]),
    ];
    let mut bench = Bench::new("manual.toml", "started.toml");
    bench.run(4_000, &received);
    bench
}

#[test]
fn a_running_gateway() {
    insta::assert_snapshot!(with_traffic().picture(150, 45));
}

#[test]
fn a_small_terminal() {
    insta::assert_snapshot!(with_traffic().picture(80, 24));
}

#[test]
fn a_gateway_with_errors() {
    let mut bench = Bench::new("manual.toml", "bus-lost.toml");
    insta::assert_snapshot!("errors_that_are_present", bench.run(1_600, &[]).picture(100, 36));
    insta::assert_snapshot!("errors_that_have_been", bench.run(2_600, &[]).picture(100, 36));
}

#[test]
fn a_gateway_that_has_given_up() {
    let mut bench = Bench::new("node-2.toml", "mended.toml");
    insta::assert_snapshot!(bench.run(900, &[]).picture(80, 24));
}

#[test]
fn no_terminal_is_too_small() {
    let bench = with_traffic();
    for (width, height) in [(1, 1), (5, 3), (20, 10), (200, 2), (10, 100)] {
        let picture = bench.picture(width, height);
        assert_eq!(picture.lines().count(), usize::from(height), "{width}x{height}");
    }
}

#[test]
fn a_running_gateway_at_every_size() {
    for (width, height) in [(80, 24), (110, 30), (200, 60)] {
        insta::assert_snapshot!(format!("running_{width}x{height}"), with_traffic().picture(width, height));
    }
}

const DEVICE: &str = "device = \"heinzmann-canopen-gateway\"\n";

/// A gateway with these parameters, after so many milliseconds.
fn with(parameters: &str, scenario: &str, milliseconds: u32) -> Bench {
    let mut bench = Bench::of(format!("{DEVICE}{parameters}").as_bytes(), scenario.as_bytes());
    bench.run(milliseconds, &[]);
    bench
}

// GW-CFG-48, GW-APP-50, GW-APP-14
#[test]
fn units_that_disagree() {
    for (name, parameters) in [
        ("node_numbers", "[gateway]\n401 = 2\n402 = 5\n[governor]\n401 = 4\n403 = 1\n"),
        ("bit_rates", "[gateway]\n427 = 5\n416 = 500\n[governor]\n416 = 250\n"),
        ("switched_off", "[governor]\n4406 = 0\n"),
        (
            "identifiers",
            "[gateway]\n427 = 2\n16404 = 0x282\n[governor]\n14401 = 1\n16404 = 2000\n16461 = 100\n",
        ),
    ] {
        for (width, height) in [(80, 24), (110, 30), (200, 60)] {
            let picture = with(parameters, "", 3_000).picture(width, height);
            insta::assert_snapshot!(format!("{name}_{width}x{height}"), picture);
        }
    }
}

/// The picture as one text, without line breaks.
fn words(picture: &str) -> String {
    let lines = picture.lines().map(|line| line.trim_matches('"').trim());
    lines.collect::<Vec<_>>().join(" ")
}

#[test]
fn no_error_is_left_out_without_a_sign() {
    let errors: Vec<u16> = (3010..3017).collect();
    let scenario = format!("[[step]]\nat = 0.3\nengine-error = {errors:?}\n");
    let bench = with("", &scenario, 500);
    insta::assert_snapshot!("seven_engine_errors_80x24", bench.picture(80, 24));
    for height in [10, 16, 24, 30, 60] {
        for width in 20..=200 {
            let picture = bench.picture(width, height);
            let errors_area = picture.split("errors").nth(1).unwrap_or_default();
            let errors_area = words(errors_area.split("engine─").next().unwrap_or_default());
            let shown = errors.iter().all(|number| errors_area.contains(&number.to_string()));
            assert!(shown || errors_area.contains('…'), "{width}x{height}: {picture}");
        }
    }
    assert!(words(&bench.picture(80, 24)).contains("3016"), "at the usual size all of them are there");
}

// GW-APP-47, GW-APP-48
#[test]
fn pages_that_are_bad() {
    let reset =
        |code: u16| format!("[[step]]\nat = 1\neeprom = {code}\n[[step]]\nat = 1.1\nreset = \"gateway\"\n");
    for (name, code) in [("serial_number", 8), ("bootloader", 1)] {
        let picture = with("", &reset(code), 2_000).picture(80, 24);
        insta::assert_snapshot!(format!("bad_page_{name}"), picture);
    }
}

// GW-NMT-12
#[test]
fn states_are_said_as_they_are() {
    let says = |scenario: &str, milliseconds, what: &str| {
        let picture = words(&with("", scenario, milliseconds).picture(200, 60));
        assert!(picture.contains(what), "{what}: {picture}");
    };
    says("", 100, "none while undefined, since 0.0 s: the program of the gateway has not started");
    says("", 220, "none while init, since 0.2 s: the governor initialises the gateway");
    says(
        "[[step]]\nat = 1\ninject = \"intern\"\n",
        5_000,
        "since 1.0 s: error 3094 ErrIntern: exception of the program",
    );
    says("[[step]]\nat = 1\ncommand = \"undefined\"\n", 2_000, "since 1.0 s: the governor has commanded it");
    says("[[step]]\nat = 1\noff = \"gateway\"\n", 2_000, "since 1.0 s: the gateway has no supply");
    says(
        "[[step]]\nat = 1\noff = \"governor\"\n",
        5_000,
        ": the governor, which initialises the gateway, has no supply",
    );
    says("[[step]]\nat = 1\ninject = \"link-broken\"\n", 5_000, ": the fault link-broken lasts");
    says(
        "[[step]]\nat = 1\ninject = \"governor-can-comm\"\n",
        2_000,
        "since 1.0 s: error 12415 CanOpDCErrCanComm",
    );
}

#[test]
fn old_lines_go() {
    let mut view = View::new(String::new());
    let line = |nth| Line::new(Microseconds(nth), super::super::log::What::NotStored);
    view.add((0..3).map(line));
    view.add((3..MOST_LINES as u64 + 5).map(line));
    assert_eq!(view.lines.len(), MOST_LINES);
    assert!(view.lines[0].contains("0.000005"), "{}", view.lines[0]);
}
