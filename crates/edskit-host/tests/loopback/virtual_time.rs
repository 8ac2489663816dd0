//! A bus in virtual time over loopback: programs that speak by hand, and the client.

use crate::tool::{Tool, frame};
use edskit_host::{Bus, BusError, VirtualBus, VirtualClient, VirtualServer, frame_bits};
use edskit_runtime::{Frame, Instant};
use edskit_types::{Bitrate, CanId};
use std::net::TcpListener;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{self, JoinHandle};

/// A server in a thread of its own, with a device that sends a heartbeat every millisecond and answers 60Ah by 58Ah.
struct Served {
    port: u16,
    is_over: Arc<AtomicBool>,
    thread: Option<JoinHandle<Instant>>,
}

impl Served {
    fn start() -> Self {
        let is_over = Arc::new(AtomicBool::new(false));
        let (sender, port) = std::sync::mpsc::channel();
        let over = Arc::clone(&is_over);
        let thread = thread::spawn(move || {
            let bus = VirtualBus::new(Bitrate::Kbit1000);
            let mut server =
                VirtualServer::start(&bus, ([127, 0, 0, 1], 0).into()).expect("there are free ports");
            sender.send(server.address().port()).expect("the test waits for it");
            let mut device = bus.attach();
            let mut heartbeat = Instant(1_000);
            while !over.load(Ordering::Relaxed) {
                while let Some(received) = device.receive().expect("a virtual bus stays") {
                    if received.frame.can_id() == frame(0x60A, &[]).can_id() {
                        device.send(&frame(0x58A, received.frame.data())).expect("the bus has room");
                    }
                }
                if bus.now() >= heartbeat {
                    device.send(&frame(0x70A, &[5])).expect("the bus has room");
                    heartbeat = Instant(heartbeat.0 + 1_000);
                }
                server.wait(heartbeat);
            }
            bus.now()
        });
        Self { port: port.recv().expect("the server starts"), is_over, thread: Some(thread) }
    }

    fn tool(&self) -> Tool {
        let mut tool = Tool::new(Some(([127, 0, 0, 1], self.port).into()));
        assert!(tool.hear("\n").starts_with("now "));
        tool
    }

    fn client(&self) -> VirtualClient {
        VirtualClient::connect("127.0.0.1", self.port).expect("the server listens")
    }

    /// Ends it; says which time it was then.
    fn end(mut self) -> Instant {
        self.is_over.store(true, Ordering::Relaxed);
        self.thread.take().expect("it runs").join().expect("it does not panic")
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        self.is_over.store(true, Ordering::Relaxed);
    }
}

/// When a frame has arrived that begins at this time: at 1 Mbit/s a bit takes a microsecond, and the last three are the
/// pause behind it.
fn arrival(start: u32, id: u16, data: &[u8]) -> u32 {
    start + frame_bits(&frame(id, data)) - 3
}

#[test]
fn time_passes_only_while_everybody_waits() {
    let served = Served::start();
    let (mut first, mut second) = (served.tool(), served.tool());
    first.say("send 60A 11\nwait 500\n");
    // The second one thinks; the first one's frame is on its way as soon as both wait.
    second.say("wait 0\n");
    assert_eq!(second.hear("\n"), "now 0\n");
    second.say("wait 100\n");
    let request = arrival(0, 0x60A, &[0x11]);
    assert_eq!(second.hear("\n"), format!("frame {request} 60A 11\n"));
    assert_eq!(second.hear("\n"), format!("now {request}\n"));
    second.say("wait 1000\n");
    // The pause behind the request comes before the answer.
    let answer = arrival(request + 3, 0x58A, &[0x11]);
    for tool in [&mut first, &mut second] {
        assert_eq!(tool.hear("\n"), format!("frame {answer} 58A 11\n"));
        assert_eq!(tool.hear("\n"), format!("now {answer}\n"));
    }
    drop((first, second));
    assert_eq!(served.end(), Instant(answer.into()), "while nobody is there the time stands");
}

#[test]
fn the_same_programs_see_the_same_frames_at_the_same_times() {
    /// What one of several hears that all send the same identifier at the same time, as often as it can.
    fn hear(number: usize, mut tool: Tool) -> String {
        let mut heard = String::new();
        for round in 0..50 {
            tool.say(&format!("send 70B {number:02}{round:02}\nwait 700\n"));
            if round % 10 == 0 {
                tool.say(&format!("send 60A {number:02}\n"));
            }
            loop {
                let line = tool.hear("\n");
                heard += &line;
                if line.starts_with("now ") {
                    break;
                }
            }
        }
        heard
    }
    let run = || {
        let served = Served::start();
        let tools = [served.tool(), served.tool(), served.tool()];
        let programs = tools.into_iter().enumerate();
        // Each is a thread of its own, so which one speaks first is up to the machine.
        let programs: Vec<_> =
            programs.map(|(number, tool)| thread::spawn(move || hear(number, tool))).collect();
        programs.into_iter().map(|program| program.join().unwrap()).collect::<Vec<_>>()
    };
    let heard = run();
    assert!(heard[0].contains(" 70A 05\n") && heard[0].contains(" 58A 02\n"), "{heard:?}");
    for _ in 0..5 {
        assert_eq!(heard, run());
    }
}

#[test]
fn a_program_that_vanishes_inside_a_wait_holds_nobody_up() {
    let served = Served::start();
    let (mut leaves, mut stays) = (served.tool(), served.tool());
    leaves.say("send 181 AA\nwait 18446744073709551615\n");
    stays.say("wait 10\n");
    assert_eq!(stays.hear("\n"), "now 10\n");
    drop(leaves);
    stays.say("wait 500000\n");
    let time = arrival(0, 0x181, &[0xAA]);
    assert_eq!(stays.hear("\n"), format!("frame {time} 181 AA\n"), "what was handed over is sent");
    assert_eq!(stays.hear("\n"), format!("now {time}\n"));
    for millisecond in 1..2_000 {
        stays.say("wait 500000\n");
        let time = arrival(millisecond * 1_000, 0x70A, &[5]);
        assert_eq!(stays.hear("\n"), format!("frame {time} 70A 05\n"));
        assert_eq!(stays.hear("\n"), format!("now {time}\n"));
    }
}

#[test]
fn a_program_that_vanishes_is_noticed_though_nothing_is_to_be_said_to_it() {
    let bus = VirtualBus::new(Bitrate::Kbit1000);
    let mut server = VirtualServer::start(&bus, ([127, 0, 0, 1], 0).into()).unwrap();
    let mut tool = Tool::new(Some(server.address()));
    tool.say("wait 18446744073709551615\n");
    while bus.now() == Instant(0) {
        server.wait(Instant(1));
    }
    assert_eq!(server.clients(), 1);
    drop(tool);
    while server.clients() == 1 {
        assert!(bus.now() < Instant(10_000_000), "time goes on for nobody");
        server.wait(Instant(bus.now().0 + 1));
    }
    let now = bus.now();
    server.wait(Instant::NEVER);
    assert_eq!(bus.now(), now);
}

#[test]
fn nonsense_harms_nobody() {
    let served = Served::start();
    let (mut strange, mut other) = (served.tool(), served.tool());
    strange.say("GET / HTTP/1.1\r\n");
    assert_eq!(strange.hear("\n"), "error expected `send ID DATA` or `wait MICROSECONDS`\n");
    strange.say(&"x".repeat(100_000));
    strange.say("\nsend 60A zz\nwait 5000\n");
    assert_eq!(strange.hear("\n"), "error a line has up to 64 characters\n");
    assert!(strange.hear("\n").starts_with("error data are"));
    other.say("send 60A 01\nwait 500\n");
    let request = arrival(0, 0x60A, &[1]);
    assert_eq!(strange.hear("\n"), format!("frame {request} 60A 01\n"));
    assert_eq!(strange.hear("\n"), format!("now {request}\n"));
    drop(strange);
    assert_eq!(other.hear("\n"), format!("frame {} 58A 01\n", arrival(request + 3, 0x58A, &[1])));
}

#[test]
fn the_client_is_a_participant_as_on_any_other_bus() {
    let served = Served::start();
    let mut bus = served.client();
    assert_eq!(bus.now(), Instant(0));
    bus.send(&frame(0x60A, &[1, 2])).unwrap();
    bus.send(&Frame::remote(CanId::extended(0x60A).unwrap(), 4)).unwrap();
    let mut heard = Vec::new();
    while bus.now() < Instant(2_500) {
        bus.wait(Instant(2_500)).unwrap();
        heard.extend(std::iter::from_fn(|| bus.receive().unwrap()));
    }
    let heard: Vec<_> = heard.iter().map(|received| (received.time.0, received.frame)).collect();
    let heartbeat = |start| (u64::from(arrival(start, 0x70A, &[5])), frame(0x70A, &[5]));
    assert_eq!(heard[1..], [heartbeat(1_000), heartbeat(2_000)]);
    assert_eq!(heard[0].1, frame(0x58A, &[1, 2]));
}

#[test]
fn frames_that_are_refused_are_handed_over_again() {
    let served = Served::start();
    let mut bus = served.client();
    let (mut sent, mut answered) = (0_u16, Vec::new());
    while answered.len() < 300 {
        while sent < 300 && bus.send(&frame(0x60A, &sent.to_le_bytes())).is_ok() {
            sent += 1;
        }
        // Ten microseconds are less than a frame takes, so the bus has no room for most of the next ones.
        bus.wait(Instant(bus.now().0 + 10)).unwrap();
        while let Some(received) = bus.receive().unwrap() {
            if received.frame.can_id() == CanId::standard(0x58A).unwrap() {
                answered.push(u16::from_le_bytes([received.frame.data()[0], received.frame.data()[1]]));
            }
        }
    }
    assert_eq!(answered, (0..300).collect::<Vec<_>>());
}

#[test]
fn a_bus_that_is_gone_or_is_another_one_is_told() {
    let served = Served::start();
    let mut bus = served.client();
    served.end();
    let error = bus.wait(Instant(1_000_000_000_000)).unwrap_err();
    assert!(matches!(error, BusError::Gone { .. }), "{error}");

    let other = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = other.local_addr().unwrap().port();
    let greets = thread::spawn(move || {
        std::io::Write::write_all(&mut other.accept().unwrap().0, b"< hi >\n").unwrap();
    });
    let error = VirtualClient::connect("127.0.0.1", port).err().expect("it speaks something else");
    greets.join().unwrap();
    let text = error.to_string();
    assert!(text.contains("does not speak virtual time: expected `now TIME`, got \"< hi >\""), "{text}");
    let error = VirtualClient::connect("127.0.0.1", port).err().expect("nobody listens any more");
    assert!(error.to_string().contains("nothing listens there"), "{error}");
}

#[test]
fn the_page_on_virtual_time_shows_the_example() {
    let page = include_str!("../../../../docs/virtual-time.md");
    assert!(page.contains(include_str!("../../examples/time_to_boot.rs")));
}
