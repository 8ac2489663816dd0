//! Which transfer a message belongs to, and what it does there.

use super::running::Running;
use super::{Held, Step};
use edskit_host::sdo::SdoValue;
use edskit_types::{AbortCode, Index, SubIndex};

/// A channel of a node with the transfer that runs on it.
#[derive(Default)]
pub(crate) struct Channel {
    running: Option<Running>,
    /// What has been written in one message, until it is confirmed.
    written: Option<((Index, SubIndex), SdoValue)>,
    /// The write that was confirmed last; the same words once more say nothing new.
    confirmed: Option<(Index, SubIndex)>,
}

impl Channel {
    pub(crate) fn request(&mut self, message: [u8; 8]) -> Step {
        if let Some(segment) = self.block_segment(message, true) {
            return segment;
        }
        let command = message[0];
        match command >> 5 {
            0 => self.segment(message, true),
            1 => self.begin_write(message),
            2 => self.begin("read", message, false),
            3 => self.step(format!("next segment, toggle {}", command >> 4 & 1)),
            4 => self.abort(message),
            5 => match command & 3 {
                0 => self.begin(&format!("read in blocks of {}", message[4]), message, false),
                1 => {
                    let step = self.step("end of blocks confirmed".to_owned());
                    self.running = None;
                    step
                }
                2 => self.confirm(message),
                _ => {
                    if let Some(running) = &mut self.running {
                        running.is_in_block = true;
                    }
                    self.step("start of blocks".to_owned())
                }
            },
            6 if command & 1 == 0 => {
                let length = said_length(command & 2 != 0, message);
                self.begin(&format!("write in blocks{length}"), message, true)
            }
            6 => self.end_of_blocks(message),
            _ => self.step(format!("unknown command {command:02X}h")),
        }
    }

    pub(crate) fn response(&mut self, message: [u8; 8]) -> Step {
        if let Some(segment) = self.block_segment(message, false) {
            return segment;
        }
        let command = message[0];
        match command >> 5 {
            0 => self.segment(message, false),
            1 => self.segment_confirmed(),
            2 => self.read_begun(message),
            3 => self.write_begun(message),
            4 => self.abort(message),
            5 => match command & 3 {
                0 => {
                    if let Some(running) = &mut self.running {
                        running.is_in_block = true;
                    }
                    self.at(message, format!("blocks of {}", message[4]))
                }
                1 => self.complete("blocks complete".to_owned()),
                _ => self.confirm(message),
            },
            6 if command & 1 == 0 => {
                let length = said_length(command & 2 != 0, message);
                self.at(message, format!("read in blocks begun{length}"))
            }
            6 => {
                let mut step = self.end_of_blocks(message);
                if let Some(running) = &mut self.running {
                    let value = running.value();
                    let place = running.place;
                    step.held = Some(Held { place, value: value.clone(), is_written: false });
                    step.value = value.map(|value| (value, false));
                }
                step
            }
            _ => self.step(format!("unknown command {command:02X}h")),
        }
    }

    /// A message that belongs to what is running.
    fn step(&self, what: String) -> Step {
        Step {
            what,
            place: self.running.as_ref().map(|running| running.place),
            value: None,
            held: None,
            abort: None,
        }
    }

    /// A message that names its place.
    fn at(&self, message: [u8; 8], what: String) -> Step {
        Step { what, place: Some(place_of(message)), value: None, held: None, abort: None }
    }

    fn begin(&mut self, what: &str, message: [u8; 8], is_write: bool) -> Step {
        self.running = Some(Running::new(place_of(message), is_write));
        (self.written, self.confirmed) = (None, None);
        self.at(message, what.to_owned())
    }

    fn abort(&mut self, message: [u8; 8]) -> Step {
        self.running = None;
        self.written = None;
        Step { abort: Some(AbortCode(number_of(message))), ..self.at(message, "abort".to_owned()) }
    }

    /// The transfer is over, and its value is known.
    fn complete(&mut self, what: String) -> Step {
        let mut step = self.step(what);
        if let Some(mut running) = self.running.take() {
            let (place, value, is_written) = (running.place, running.value(), running.is_write);
            step.held = Some(Held { place, value: value.clone(), is_written });
            step.value = value.map(|value| (value, is_written));
        }
        step
    }

    /// The message that begins a transfer of more than one says how long it is, or does not.
    fn announce(&mut self, is_said: bool, message: [u8; 8]) -> String {
        if let Some(running) = &mut self.running {
            running.announced = is_said.then(|| number_of(message));
        }
        said_length(is_said, message)
    }

    fn begin_write(&mut self, message: [u8; 8]) -> Step {
        let command = message[0];
        if command & 2 == 0 {
            let mut step = self.begin("write in segments", message, true);
            step.what += &self.announce(command & 1 != 0, message);
            return step;
        }
        let mut step = self.begin("write", message, true);
        self.running = None;
        self.written = Some((place_of(message), expedited(message)));
        step.value = Some((expedited(message), true));
        step
    }

    fn write_begun(&mut self, message: [u8; 8]) -> Step {
        let is_in_segments = self.running.as_ref().is_some_and(|running| running.is_write);
        let what = if is_in_segments { "ready for segments" } else { "write confirmed" };
        let mut step = self.at(message, what.to_owned());
        let place = place_of(message);
        if !is_in_segments && self.confirmed != Some(place) {
            // Without its request, it is known that the entry was written, but not what.
            let value = self.written.take_if(|(written, _)| *written == place).map(|(_, value)| value);
            step.held = Some(Held { place, value, is_written: true });
            self.confirmed = Some(place);
        }
        step
    }

    fn read_begun(&mut self, message: [u8; 8]) -> Step {
        let command = message[0];
        if command & 2 == 0 {
            let length = self.announce(command & 1 != 0, message);
            return self.at(message, format!("read in segments begun{length}"));
        }
        self.running = None;
        let value = expedited(message);
        let held = Some(Held { place: place_of(message), value: Some(value.clone()), is_written: false });
        Step { value: Some((value, false)), held, ..self.at(message, "value".to_owned()) }
    }

    /// A segment of a transfer that is confirmed segment by segment. A repeated one counts once.
    fn segment(&mut self, message: [u8; 8], is_write: bool) -> Step {
        let command = message[0];
        let (toggle, is_last) = (command >> 4 & 1, command & 1 != 0);
        let bytes = &message[1..8 - usize::from(command >> 1 & 7)];
        let what = format!("{}segment, toggle {toggle}", if is_last { "last " } else { "" });
        if let Some(running) = &mut self.running
            && running.is_write == is_write
            && running.toggle != Some(toggle)
        {
            running.toggle = Some(toggle);
            running.append(bytes);
            running.is_complete = is_last;
            // A full segment is also one whose length is not said.
            running.unsure = if bytes.len() == 7 { 6 } else { 0 };
            // What is written counts when the server has confirmed it.
            if is_last && !is_write {
                return self.complete(what);
            }
        }
        self.step(what)
    }

    fn segment_confirmed(&mut self) -> Step {
        let is_complete =
            self.running.as_ref().is_some_and(|running| running.is_write && running.is_complete);
        let what = "segment confirmed".to_owned();
        if is_complete { self.complete(what) } else { self.step(what) }
    }

    /// A segment of a block, if this is where they come: its first byte is a number and no command.
    fn block_segment(&mut self, message: [u8; 8], is_request: bool) -> Option<Step> {
        let [head, bytes @ ..] = message;
        let running = self.running.as_mut()?;
        if !running.is_in_block || running.is_write != is_request || head == 0x80 {
            return None;
        }
        let (number, is_last) = (head & 0x7F, head & 0x80 != 0);
        let is_next = usize::from(number) == running.block.len() + 1;
        // An abort may have reserved bits.
        let is_known = AbortCode(number_of(message)).meaning().is_some();
        if head >> 5 == 4 && !is_next && place_of(message) == running.place && is_known {
            return None;
        }
        if is_next {
            running.block.push(bytes);
            running.is_complete = is_last;
        }
        let last = if is_last { "last " } else { "" };
        Some(self.step(format!("{last}segment {number} of the block")))
    }

    fn confirm(&mut self, message: [u8; 8]) -> Step {
        let [_, sequence, size, ..] = message;
        if let Some(running) = &mut self.running {
            running.confirm(sequence);
        }
        self.step(format!("block confirmed up to segment {sequence}, next of {size}"))
    }

    /// The last segment is cut to its length.
    fn end_of_blocks(&mut self, message: [u8; 8]) -> Step {
        let [command, low, high, ..] = message;
        let unused = usize::from(command >> 2 & 7);
        if let Some(data) = self.running.as_mut().and_then(|running| running.data.as_mut()) {
            data.truncate(data.len().saturating_sub(unused));
        }
        self.step(format!("end of blocks, checksum {:04X}h", u16::from_le_bytes([low, high])))
    }
}

fn place_of(message: [u8; 8]) -> (Index, SubIndex) {
    (Index(u16::from_le_bytes([message[1], message[2]])), SubIndex(message[3]))
}

fn number_of(message: [u8; 8]) -> u32 {
    u32::from_le_bytes([message[4], message[5], message[6], message[7]])
}

/// `, 12 bytes`, where a message that begins a transfer says its length.
fn said_length(is_said: bool, message: [u8; 8]) -> String {
    if is_said { format!(", {} bytes", number_of(message)) } else { String::new() }
}

/// The value of an expedited transfer.
fn expedited(message: [u8; 8]) -> SdoValue {
    let command = message[0];
    if command & 1 == 0 {
        return SdoValue { bytes: message[4..].to_vec(), unsure: 3 };
    }
    SdoValue::new(message[4..8 - usize::from(command >> 2 & 3)].to_vec())
}
