use super::*;
use crate::Streams;
use crate::config;
use crate::run::gateway::{gateway, scenario, session::Session};
use edskit_host::{Bus as _, Participant, VirtualBus};
use edskit_runtime::Frame as CanFrame;
use edskit_types::{Bitrate, CanId};
use ratatui::Terminal;
use ratatui::backend::TestBackend;
use std::path::PathBuf;

/// A gateway with the files of the fixtures, and the view of it.
struct Bench {
    session: Session<Participant>,
    /// Somebody else on the bus.
    tool: Participant,
    view: View,
}

impl Bench {
    fn new(parameters: &str, scenario: &str) -> Self {
        let mut streams = Streams::of_buffers(Vec::new(), Box::new(Vec::new()), Box::new(Vec::new()));
        let fixtures = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/fixtures"));
        let parameters = config::read(&fixtures.join("gateway").join(parameters), &mut streams);
        let steps = scenario::read(&fixtures.join("scenarios").join(scenario), None, &mut streams);
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
fn old_lines_go() {
    let mut view = View::new(String::new());
    let line = |nth| Line::new(Microseconds(nth), super::super::log::What::NotStored);
    view.add((0..3).map(line));
    view.add((3..MOST_LINES as u64 + 5).map(line));
    assert_eq!(view.lines.len(), MOST_LINES);
    assert!(view.lines[0].contains("0.000005"), "{}", view.lines[0]);
}
