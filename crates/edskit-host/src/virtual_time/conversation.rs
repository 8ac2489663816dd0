//! What one client and the bus say to each other, without a socket.

use super::lines::{Lines, Reply, Request, write_error};
use crate::{Bus, Participant, VirtualBus};
use edskit_runtime::{Frame, Instant};

/// How many refused frames are kept for the next wait. Who sends more without ever waiting is told, and loses them.
const MOST_REFUSED: usize = 4096;

/// One client. It thinks, and the time stands; or it waits, and then its input is left alone until the wait is over.
pub(super) struct Conversation {
    participant: Participant,
    input: Lines,
    output: Vec<u8>,
    /// When the wait ends if no frame arrives; `None` while the client thinks.
    waits_until: Option<Instant>,
    refused: Vec<Frame>,
}

impl Conversation {
    /// Begins with the greeting.
    pub(super) fn new(bus: &VirtualBus) -> Self {
        let mut output = Vec::new();
        Reply::Now(bus.now()).write(&mut output);
        let participant = bus.attach();
        Self { participant, input: Lines::default(), output, waits_until: None, refused: Vec::new() }
    }

    /// When the wait ends at the latest; `None` while the client thinks.
    pub(super) fn waits_until(&self) -> Option<Instant> {
        self.waits_until
    }

    /// Takes what the client says, for [`Conversation::heed`].
    pub(super) fn feed(&mut self, bytes: &[u8]) {
        self.input.feed(bytes);
    }

    /// Ends the wait where a frame has arrived or its time is over. What the client has said behind the wait is left for
    /// [`Conversation::heed`], so that it makes no difference whether it has come already.
    pub(super) fn look(&mut self) {
        let Some(end) = self.waits_until else { return };
        let now = self.participant.now();
        let mut has_frames = false;
        // A virtual bus never fails.
        while let Ok(Some(received)) = self.participant.receive() {
            has_frames = true;
            Reply::Frame(received).write(&mut self.output);
        }
        if has_frames || now >= end {
            for frame in self.refused.drain(..) {
                Reply::Refused(frame).write(&mut self.output);
            }
            Reply::Now(now).write(&mut self.output);
            self.waits_until = None;
        }
    }

    /// What has to be said to the client.
    pub(super) fn take_output(&mut self) -> Vec<u8> {
        std::mem::take(&mut self.output)
    }

    /// Does what the client has asked for, up to the next wait. Clients are heeded in one order, and each until it waits:
    /// then what several send at the same time goes over the bus in the same order every time.
    pub(super) fn heed(&mut self) {
        while self.waits_until.is_none() {
            match self.input.next() {
                None => return,
                Some(Ok(Request::Wait(time))) => {
                    self.waits_until = Some(self.participant.now() + time);
                }
                Some(Ok(Request::Send(frame))) if self.participant.send(&frame).is_err() => {
                    self.refuse(frame);
                }
                Some(Ok(Request::Send(_))) => {}
                Some(Err(mistake)) => write_error(mistake, &mut self.output),
            }
        }
    }

    fn refuse(&mut self, frame: Frame) {
        if self.refused.len() < MOST_REFUSED {
            self.refused.push(frame);
        } else {
            let text = format_args!(
                "{MOST_REFUSED} frames are refused already, this one is lost: nothing is sent \
                                     before you wait"
            );
            write_error(text, &mut self.output);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use edskit_types::{Bitrate, CanId};

    fn bus() -> VirtualBus {
        VirtualBus::new(Bitrate::Kbit1000)
    }

    fn say(conversation: &mut Conversation, lines: &str) {
        conversation.feed(lines.as_bytes());
        conversation.heed();
    }

    fn said(conversation: &mut Conversation) -> String {
        String::from_utf8(conversation.take_output()).unwrap()
    }

    /// Lets time pass as a server does while everybody waits.
    fn pass(bus: &VirtualBus, clients: &mut [&mut Conversation]) {
        loop {
            for client in clients.iter_mut() {
                client.look();
                client.heed();
            }
            let Some(end) = clients.iter().map(|client| client.waits_until).min().flatten() else { return };
            bus.step(end);
        }
    }

    #[test]
    fn the_greeting_is_the_time() {
        let bus = bus();
        bus.advance(Instant(1234));
        assert_eq!(said(&mut Conversation::new(&bus)), "now 1234\n");
    }

    #[test]
    fn a_wait_ends_with_its_time_or_with_a_frame_whichever_is_first() {
        let bus = bus();
        let (mut client, mut device) = (Conversation::new(&bus), bus.attach());
        client.take_output();
        say(&mut client, "wait 500\n");
        assert_eq!(client.waits_until(), Some(Instant(500)));
        pass(&bus, &mut [&mut client]);
        assert_eq!(said(&mut client), "now 500\n");

        device.send(&Frame::new(CanId::standard(0x705).unwrap(), &[0])).unwrap();
        device.send(&Frame::remote(CanId::extended(0x705).unwrap(), 3)).unwrap();
        say(&mut client, "wait 500\n");
        pass(&bus, &mut [&mut client]);
        assert_eq!(said(&mut client), "frame 568 00000705 R3\nnow 568\n", "the smaller identifier wins");
        say(&mut client, "wait 500\nwait 5\n");
        pass(&bus, &mut [&mut client]);
        assert_eq!(said(&mut client), "frame 626 705 00\nnow 626\nnow 631\n");
    }

    #[test]
    fn frames_are_sent_at_the_present_time_and_do_not_come_back() {
        let bus = bus();
        let (mut first, mut second) = (Conversation::new(&bus), Conversation::new(&bus));
        say(&mut first, "wait 100\n");
        say(&mut second, "wait 300\n");
        pass(&bus, &mut [&mut first, &mut second]);
        first.take_output();
        second.take_output();
        assert_eq!(bus.now(), Instant(100), "the first one thinks, so the time stands");

        say(&mut first, "send 181 0102\nsend 00000181 R2\nwait 1000\n");
        pass(&bus, &mut [&mut first, &mut second]);
        assert_eq!(said(&mut second), "frame 169 00000181 R2\nnow 169\n");
        say(&mut second, "wait 1000\n");
        pass(&bus, &mut [&mut first, &mut second]);
        assert_eq!(said(&mut second), "frame 236 181 0102\nnow 236\n");
        say(&mut second, "wait 2000\n");
        pass(&bus, &mut [&mut first, &mut second]);
        assert_eq!((said(&mut first).as_str(), said(&mut second).as_str()), ("now 1100\n", ""));
    }

    #[test]
    fn what_finds_no_room_is_refused_within_the_next_wait() {
        let bus = bus();
        let (mut client, mut device) = (Conversation::new(&bus), bus.attach());
        client.take_output();
        for number in 0..66 {
            say(&mut client, &format!("send 181 {number:02X}\n"));
        }
        assert_eq!(said(&mut client), "");
        say(&mut client, "wait 0\n");
        pass(&bus, &mut [&mut client]);
        assert_eq!(said(&mut client), "refused send 181 40\nrefused send 181 41\nnow 0\n");
        say(&mut client, "wait 100000\n");
        pass(&bus, &mut [&mut client]);
        let arrived =
            std::iter::from_fn(|| device.receive().unwrap()).map(|received| received.frame.data()[0]);
        assert_eq!(arrived.collect::<Vec<_>>(), (0..64).collect::<Vec<_>>());
        say(&mut client, "send 181 40\n");
        bus.advance(Instant(200_000));
        assert_eq!(device.receive().unwrap().map(|received| received.frame.data()[0]), Some(0x40));
    }

    #[test]
    fn who_never_waits_takes_no_memory_without_end() {
        let bus = bus();
        let mut client = Conversation::new(&bus);
        client.take_output();
        for _ in 0..64 + MOST_REFUSED {
            say(&mut client, "send 181\n");
        }
        assert_eq!(said(&mut client), "");
        say(&mut client, "send 181\n");
        assert!(said(&mut client).starts_with("error 4096 frames are refused already"));
    }

    #[test]
    fn nonsense_is_answered_at_once_and_changes_nothing() {
        let bus = bus();
        let mut client = Conversation::new(&bus);
        client.take_output();
        say(&mut client, "hello\n\nsend 605 1\n");
        assert_eq!(
            said(&mut client),
            "error expected `send ID DATA` or `wait MICROSECONDS`\n\
             error data are up to 8 bytes of two hexadecimal digits without blanks, or R and the length of a remote \
             frame (R0 to R8)\n"
        );
        say(&mut client, "wait 7\n");
        pass(&bus, &mut [&mut client]);
        assert_eq!(said(&mut client), "now 7\n");
    }
}
