use super::*;
use crate::cli::{Cli, Command};
use clap::Parser as _;
use edskit_host::sdo::SdoChannel;
use edskit_host::{BusError, Participant, Received, SendError, VirtualBus};
use edskit_runtime::{Frame, Instant};
use edskit_types::{Bitrate, CanId, NodeId};
use std::cell::RefCell;
use std::rc::Rc;

/// A bus in virtual time on which somebody answers the requests to node 5.
struct Scripted<S> {
    bus: VirtualBus,
    tool: Participant,
    others: Participant,
    script: S,
}

impl<S: FnMut(&[u8]) -> Vec<Frame>> Bus for Scripted<S> {
    fn now(&self) -> Instant {
        self.bus.now()
    }

    fn receive(&mut self) -> Result<Option<Received>, BusError> {
        self.tool.receive()
    }

    fn send(&mut self, frame: &Frame) -> Result<(), SendError> {
        self.tool.send(frame)
    }

    fn wait(&mut self, deadline: Instant) -> Result<(), BusError> {
        self.bus.step(deadline);
        while let Some(received) = self.others.receive()? {
            for frame in (self.script)(received.frame.data()) {
                self.others.send(&frame).expect("the bus has room");
            }
        }
        Ok(())
    }
}

#[derive(Clone, Default)]
struct Output(Rc<RefCell<Vec<u8>>>);

impl io::Write for Output {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.borrow_mut().extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// What `edskit sdo` prints where this is what others send on each request.
fn sdo(arguments: &[&str], script: impl FnMut(&[u8]) -> Vec<Frame>) -> String {
    let all = [&["edskit", "sdo"], arguments].concat();
    let Command::Sdo(parsed) = Cli::try_parse_from(&all).expect("the arguments are right").command else {
        panic!("this is another command")
    };
    let bus = VirtualBus::new(Bitrate::Kbit1000);
    let mut bus = Scripted { tool: bus.attach(), others: bus.attach(), bus, script };
    let output = Output::default();
    let mut streams = Streams::of_buffers(Vec::new(), Box::new(output.clone()), Box::new(output.clone()));
    let exit = match &parsed.command {
        SdoCommand::Read(arguments) => {
            let target = Target::find(&arguments.place).unwrap();
            read_over(&mut bus, &target, arguments, &mut streams).unwrap()
        }
        SdoCommand::Write(arguments) => {
            let target = Target::find(&arguments.place).unwrap();
            let bytes = vec![7; arguments.value.as_deref().unwrap().parse().unwrap()];
            write_over(&mut bus, &target, arguments, &bytes, &mut streams).unwrap()
        }
    };
    let output = String::from_utf8(output.0.borrow().clone()).unwrap();
    format!(
        "$ edskit sdo {}\n{output}--- exit {}, after {} ms\n\n",
        arguments.join(" "),
        exit.code(),
        bus.now().0 / 1_000
    )
}

fn frame(can_id: u16, data: &[u8]) -> Frame {
    Frame::new(CanId::standard(can_id).unwrap(), data)
}

fn answer(data: &[u8]) -> Frame {
    frame(0x585, data)
}

// W13 of the field reports.
#[test]
fn lengths_that_are_not_said() {
    let cases: [(&[&str], &[u8]); 9] = [
        (&["read", "5", "1017", "--type", "u16"], &[0x42, 0x17, 0x10, 0, 0x2C, 1, 0, 0]),
        (&["read", "5", "1017", "--type", "u16", "--format", "json"], &[0x42, 0x17, 0x10, 0, 0x2C, 1, 0, 0]),
        (&["read", "5", "1017"], &[0x42, 0x17, 0x10, 0, 0x2C, 1, 0, 0]),
        (&["read", "5", "1017", "--format", "json"], &[0x42, 0x17, 0x10, 0, 0x2C, 1, 0, 0]),
        (&["read", "5", "1017", "--type", "u16"], &[0x43, 0x17, 0x10, 0, 0x2C, 1, 0, 0]),
        (&["read", "5", "1017", "--type", "u64"], &[0x42, 0x17, 0x10, 0, 0x2C, 1, 0, 0]),
        (&["read", "5", "1008", "--type", "string"], &[0x42, 0x08, 0x10, 0, b'A', b'B', 0, 0]),
        (&["read", "5", "2000", "--type", "bool"], &[0x42, 0, 0x20, 0, 1, 0xFF, 0xFF, 0xFF]),
        (&["read", "5", "2000", "--type", "domain"], &[0x42, 0, 0x20, 0, 1, 2, 3, 0]),
    ];
    let mut all = String::new();
    for (arguments, message) in cases {
        all += &sdo(arguments, |_| vec![answer(message)]);
    }
    // In segments, neither the first answer nor the last segment says it.
    let segments = |request: &[u8]| {
        vec![match request[0] {
            0x40 => answer(&[0x40, request[1], request[2], request[3], 0, 0, 0, 0]),
            _ => answer(&[request[0] & 0x10 | 1, 0xE8, 3, 0, 0, 0, 0, 0]),
        }]
    };
    all += &sdo(&["read", "5", "2001", "--type", "u32"], segments);
    all += &sdo(&["read", "5", "2001", "--type", "time"], segments);
    all += &sdo(&["read", "5", "2001"], segments);
    insta::assert_snapshot!(all);
}

#[test]
fn a_file_has_the_bytes_of_the_type() {
    let path = std::env::temp_dir().join(format!("edskit-sdo-{}", std::process::id()));
    let name = path.to_str().unwrap();
    let unsaid = |_: &[u8]| vec![answer(&[0x42, 0x17, 0x10, 0, 0x2C, 1, 0, 0])];
    let told = sdo(&["read", "5", "1017", "--type", "u16", "--file", name], unsaid);
    assert!(told.contains(&format!("1017h:00h: 2 bytes written to {name}\n")), "{told}");
    assert_eq!(fs::read(&path).unwrap(), [0x2C, 1]);
    let told = sdo(&["read", "5", "1017", "--file", name], unsaid);
    assert!(told.contains(&format!("4 bytes written to {name} (the length is not said)\n")), "{told}");
    fs::remove_file(&path).unwrap();
}

// W16 and U9 of the field reports.
#[test]
fn silence_is_explained_by_what_was_heard() {
    let read: [&str; 3] = ["read", "5", "1017"];
    let block = ["read", "5", "1017", "--transfer", "block"];
    let mut all = String::new();
    // The request itself, and an abort at the end, are what the others hear.
    let mut tell = |arguments: &[&str], frames: Vec<Frame>| {
        let mut frames = Some(frames);
        all += &sdo(arguments, |_| frames.take().unwrap_or_default());
    };
    tell(&read, vec![]);
    tell(&read, vec![frame(0x706, &[5]), frame(0x080, &[])]);
    tell(&read, vec![answer(&[0x4F, 0x17, 0x10, 0, 5])]);
    tell(&read, vec![answer(&[0x4F, 0x17, 0x10, 0, 5]), frame(0x705, &[5])]);
    tell(&read, vec![Frame::remote(SdoChannel::of_node(NodeId::new(5).unwrap()).response, 8)]);
    tell(&read, vec![frame(0x705, &[4])]);
    tell(&read, vec![frame(0x705, &[0x7F])]);
    tell(&read, vec![frame(0x085, &[0; 8])]);
    tell(&read, vec![frame(0x705, &[0])]);
    tell(&read, vec![answer(&[0x4B, 0, 0x10, 0, 1, 2, 0, 0])]);
    tell(&read, vec![answer(&[0x60, 0x17, 0x10, 0, 0, 0, 0, 0])]);
    tell(&read, vec![answer(&[0x00, 1, 2, 3, 4, 5, 6, 7])]);
    tell(&read, vec![frame(0x605, &[0x40, 0, 0x10, 0, 0, 0, 0, 0]), answer(&[0x43, 0, 0x10, 0, 1, 2, 0, 0])]);
    tell(&read, vec![answer(&[0x41, 0x17, 0x10, 0, 9, 0, 0, 0])]);
    tell(&block, vec![answer(&[0x41, 0x17, 0x10, 0, 0x2C, 1, 0, 0])]);
    tell(&block, vec![]);
    tell(&["write", "5", "2000", "300", "--type", "hex"], vec![]);
    insta::assert_snapshot!(all);
}

#[test]
fn what_ends_a_transfer_is_explained_by_its_kind() {
    let refuse = |code: u32| {
        move |request: &[u8]| {
            let [a, b, c, d] = code.to_le_bytes();
            let is_abort = request[0] == 0x80;
            let refusal = answer(&[0x80, request[1], request[2], request[3], a, b, c, d]);
            if is_abort { vec![] } else { vec![refusal] }
        }
    };
    let mut all = String::new();
    all += &sdo(&["read", "5", "1017"], refuse(0x0504_0001));
    all += &sdo(&["read", "5", "1017", "--transfer", "block"], refuse(0x0504_0001));
    all += &sdo(&["write", "5", "2000", "300", "--type", "hex"], refuse(0x0504_0001));
    all += &sdo(&["write", "5", "2000", "300", "--type", "hex"], refuse(0x0601_0002));
    all += &sdo(&["write", "5", "2000", "300", "--type", "hex", "--transfer", "block"], refuse(0x0504_0004));
    all += &sdo(&["read", "5", "1017", "--transfer", "block"], |_| vec![answer(&[0xFF; 8])]);
    all += &sdo(&["read", "5", "1017"], refuse(0x0800_0021));
    all += &sdo(&["read", "5", "1017"], refuse(0x0800_0022));
    insta::assert_snapshot!(all);
}
