//! One transfer, without a bus and without a clock.

use super::message::{ABORT, LAST_SEGMENT, Message, SERVICE, message, number_of, place_of};
use super::{Heard, SdoChannel, SdoError, SdoMode, SdoOptions, SdoValue};
use edskit_runtime::{Frame, Instant};
use edskit_types::{AbortCode, Index, SubIndex};
use std::collections::VecDeque;

/// How often the server may ask for the same block again without any progress.
const MOST_REPETITIONS: u8 = 8;

/// An SDO transfer of a client: it reads or writes one entry of a server's dictionary (CiA 301 v4.2, 7.2.4).
///
/// [`receive`](Self::receive) and [`poll`](Self::poll) move it on, [`transmit`](Self::transmit) gives the frames to be
/// sent, and [`next_deadline`](Self::next_deadline) says when to poll. Once it has ended and `transmit` gives nothing
/// more, [`result`](Self::result) has what came of it. It always ends, and its memory is bounded by
/// [`SdoOptions::most_bytes`].
///
/// Frames that can be the answer to something else are passed over and do not count against the time-out: those with
/// another index or sub-index, those that repeat what was received before, and those of another service. Answers that
/// break the protocol end the transfer, and the server is told so by an abort message; an abort is never answered. What
/// was heard and not taken is in the error ([`Heard`]).
///
/// ```
/// use edskit_host::sdo::{SdoChannel, SdoOptions, Transfer};
/// use edskit_runtime::{Frame, Instant};
/// use edskit_types::{Index, NodeId, SubIndex};
///
/// let channel = SdoChannel::of_node(NodeId::new(5)?);
/// let mut transfer = Transfer::read(channel, Index(0x1000), SubIndex(0), SdoOptions::default(), Instant(0));
/// let request = transfer.transmit(Instant(0)).expect("a transfer begins with a request");
/// assert_eq!(request.data(), [0x40, 0x00, 0x10, 0x00, 0, 0, 0, 0]);
///
/// let answer = Frame::new(channel.response, &[0x43, 0x00, 0x10, 0x00, 0x91, 0x01, 0x01, 0x00]);
/// transfer.receive(Instant(500), &answer);
/// assert_eq!(transfer.result().unwrap()?, [0x91, 0x01, 0x01, 0x00]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Transfer {
    channel: SdoChannel,
    pub(super) index: Index,
    pub(super) sub_index: SubIndex,
    pub(super) options: SdoOptions,
    pub(super) phase: Phase,
    /// What is written, or what has been read so far.
    pub(super) data: Vec<u8>,
    /// How many bytes of `data` the server has confirmed; for what is written.
    pub(super) confirmed: usize,
    /// How many bytes the server has announced; for what is read.
    pub(super) announced: Option<u32>,
    /// Whether both sides use checksums; for blocks.
    pub(super) uses_crc: bool,
    /// How many blocks in a row have brought nothing.
    pub(super) repetitions: u8,
    /// The answer that began the transfer, and the last one that was taken.
    pub(super) first: Option<Message>,
    pub(super) last: Option<Message>,
    /// How many of the last bytes that were read may be filling.
    pub(super) unsure: usize,
    /// Whether the server was told of an end which was none, and the code with which it may have answered that.
    pub(super) may_be_echoed: bool,
    pub(super) echo: Option<AbortCode>,
    pub(super) heard: Heard,
    out: VecDeque<Message>,
    deadline: Instant,
    result: Option<Result<SdoValue, SdoError>>,
}

/// What a transfer waits for, or does.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Phase {
    UploadBegin,
    UploadSegment {
        toggle: u8,
    },
    DownloadBegin,
    DownloadSegment {
        toggle: u8,
        length: usize,
    },
    BlockUploadBegin,
    /// `sequence` segments of the block have come in order; `highest` is the number of the last one that came at all.
    BlockUpload {
        sequence: u8,
        highest: u8,
    },
    /// The last segment has come.
    BlockUploadEnd,
    BlockDownloadBegin,
    /// `sent` segments of a block of `size` have been sent.
    BlockDownload {
        sent: u8,
        size: u8,
    },
    BlockDownloadEnd,
    Ended,
}

impl Phase {
    /// Whether the server has answered nothing yet.
    pub(super) fn is_begin(self) -> bool {
        use Phase::{BlockDownloadBegin, BlockUploadBegin, DownloadBegin, UploadBegin};
        matches!(self, UploadBegin | DownloadBegin | BlockUploadBegin | BlockDownloadBegin)
    }
}

impl Transfer {
    /// Reads an entry. The time-out runs from `now`.
    #[must_use]
    pub fn read(
        channel: SdoChannel,
        index: Index,
        sub_index: SubIndex,
        options: SdoOptions,
        now: Instant,
    ) -> Self {
        let mut transfer = Self::new(channel, index, sub_index, options, now);
        match options.mode {
            SdoMode::Block => transfer.begin_block_upload(),
            SdoMode::Automatic | SdoMode::Expedited | SdoMode::Segmented => transfer.begin_upload(),
        }
        transfer
    }

    /// Writes `data` into an entry; its result is empty. The time-out runs from `now`. Where the mode does not suit the
    /// length, the transfer has ended before it began.
    #[must_use]
    pub fn write(
        channel: SdoChannel,
        index: Index,
        sub_index: SubIndex,
        data: &[u8],
        options: SdoOptions,
        now: Instant,
    ) -> Self {
        let mut transfer = Self::new(channel, index, sub_index, options, now);
        transfer.data = data.to_vec();
        transfer.begin_write();
        transfer
    }

    fn new(
        channel: SdoChannel,
        index: Index,
        sub_index: SubIndex,
        options: SdoOptions,
        now: Instant,
    ) -> Self {
        Self {
            channel,
            index,
            sub_index,
            options,
            phase: Phase::Ended,
            data: Vec::new(),
            confirmed: 0,
            announced: None,
            uses_crc: false,
            repetitions: 0,
            first: None,
            last: None,
            unsure: 0,
            may_be_echoed: false,
            echo: None,
            heard: Heard::default(),
            out: VecDeque::new(),
            deadline: now + options.time_out,
            result: None,
        }
    }

    /// Takes a frame from the bus; any frame may be handed in.
    pub fn receive(&mut self, now: Instant, frame: &Frame) {
        if self.has_ended() {
            return;
        }
        if frame.can_id() != self.channel.response {
            return self.heard.elsewhere(self.channel, frame);
        }
        let Ok(answer) = Message::try_from(frame.data()) else {
            self.heard.untaken = Some(*frame);
            return;
        };
        if self.phase == Phase::BlockUploadEnd && Some(answer) == self.last {
            // The last segment, repeated: it is no command.
            return;
        }
        // What has not been asked yet cannot have been answered.
        let is_asked = self.out.is_empty();
        if self.is_abort(&answer) && (is_asked || !self.phase.is_begin()) {
            return self.aborted(&answer, frame);
        }
        if !is_asked {
            return;
        }
        let is_taken = match self.phase {
            // In a block the first byte is a number and not a command.
            Phase::BlockUpload { sequence, highest } => self.block_upload_segment(&answer, sequence, highest),
            _ if answer[0] & SERVICE == SERVICE => {
                self.give_up(AbortCode::UNKNOWN_COMMAND, "the server answers with a reserved command");
                true
            }
            Phase::UploadBegin => self.upload_begun(&answer),
            Phase::UploadSegment { toggle } => self.upload_segment(&answer, toggle),
            Phase::DownloadBegin => self.download_begun(&answer),
            Phase::DownloadSegment { toggle, length } => self.download_segment(&answer, toggle, length),
            Phase::BlockUploadBegin => self.block_upload_begun(&answer),
            Phase::BlockUploadEnd => self.block_upload_ends(&answer),
            Phase::BlockDownloadBegin => self.block_download_begun(&answer),
            Phase::BlockDownload { sent, size } => self.block_confirmed(&answer, sent, size),
            Phase::BlockDownloadEnd => self.block_download_ended(&answer),
            Phase::Ended => false,
        };
        if is_taken {
            self.last = Some(answer);
            self.deadline = now + self.options.time_out;
            self.heard.answers += 1;
        } else {
            self.heard.untaken = Some(*frame);
        }
    }

    /// Ends the transfer where the server has been silent for too long.
    pub fn poll(&mut self, now: Instant) {
        if self.has_ended() || now < self.deadline {
            return;
        }
        match self.echo.filter(|_| self.phase.is_begin()) {
            Some(code) => self.end(Err(SdoError::Aborted(code))),
            None => self.fail(SdoError::TimedOut { heard: self.heard }),
        }
        self.deadline = now + self.options.time_out;
    }

    /// The next frame to be sent; `None` where there is none for now. The time-out runs from the frame that was taken
    /// last.
    pub fn transmit(&mut self, now: Instant) -> Option<Frame> {
        let frame = self.pending()?;
        self.sent(now);
        Some(frame)
    }

    /// The frame that `transmit` would give.
    pub(super) fn pending(&self) -> Option<Frame> {
        let message =
            self.out.front().copied().or_else(|| self.next_segment().map(|(message, _)| message))?;
        Some(Frame::new(self.channel.request, &message))
    }

    /// The pending frame is on its way.
    pub(super) fn sent(&mut self, now: Instant) {
        if self.out.pop_front().is_none()
            && let (Phase::BlockDownload { size, .. }, Some((_, sent))) = (self.phase, self.next_segment())
        {
            self.phase = Phase::BlockDownload { sent, size };
        }
        self.deadline = now + self.options.time_out;
    }

    /// When [`poll`](Self::poll) has something to do, unless a frame comes before; [`Instant::NEVER`] once the transfer
    /// has ended.
    #[must_use]
    pub fn next_deadline(&self) -> Instant {
        if self.has_ended() { Instant::NEVER } else { self.deadline }
    }

    /// Whether the transfer has ended. [`transmit`](Self::transmit) may still have a last word for the server.
    #[must_use]
    pub fn has_ended(&self) -> bool {
        self.phase == Phase::Ended
    }

    /// What came of the transfer: what was read, without any bytes for what was written. `None` where it has not ended, or
    /// where the result has been taken already.
    pub fn result(&mut self) -> Option<Result<SdoValue, SdoError>> {
        self.result.take()
    }

    pub(super) fn ask(&mut self, message: Message) {
        self.out.push_back(message);
    }

    /// Asks with the place in the dictionary.
    pub(super) fn ask_for_place(&mut self, command: u8, data: [u8; 4]) {
        self.ask(message(command, self.index, self.sub_index, data));
    }

    /// Whether an answer names the place that was asked for.
    pub(super) fn is_for_us(&self, answer: &Message) -> bool {
        place_of(answer) == (self.index, self.sub_index)
    }

    /// Command specifier 4, whatever the reserved bits are. With such bits it could also be the last segment of a block,
    /// whose first byte is a number; then it is an abort if that is not the next number and all else is that of one.
    fn is_abort(&self, answer: &Message) -> bool {
        let has_its_place = self.is_for_us(answer);
        let is_meant = match self.phase {
            Phase::BlockUpload { sequence, .. } => {
                let is_next = answer[0] & !LAST_SEGMENT == sequence + 1;
                !is_next && has_its_place && AbortCode(number_of(answer)).meaning().is_some()
            }
            Phase::BlockUploadEnd => has_its_place,
            _ => true,
        };
        answer[0] == ABORT || answer[0] & SERVICE == ABORT && is_meant
    }

    fn aborted(&mut self, answer: &Message, frame: &Frame) {
        // Some servers leave the place out.
        let (index, sub_index) = place_of(answer);
        let is_for_other = !self.is_for_us(answer) && (index, sub_index) != (Index(0), SubIndex(0));
        let code = AbortCode(number_of(answer));
        if is_for_other || self.is_echo(code) {
            self.heard.untaken = Some(*frame);
            return;
        }
        self.fail(SdoError::Aborted(code));
    }

    /// What the server answers is against the protocol.
    pub(super) fn give_up(&mut self, code: AbortCode, reason: &'static str) {
        self.fail(SdoError::GivenUp { code, reason });
    }

    /// Tells the server that the transfer is over.
    pub(super) fn tell(&mut self, code: AbortCode) {
        self.clear();
        self.ask_for_place(ABORT, code.0.to_le_bytes());
    }

    /// What was to be asked has no meaning any more.
    pub(super) fn clear(&mut self) {
        self.out.clear();
    }

    pub(super) fn end(&mut self, result: Result<SdoValue, SdoError>) {
        self.phase = Phase::Ended;
        self.result = Some(result);
    }

    /// Everything has been read, and the transfer is over; whether the length is right.
    pub(super) fn end_of_reading(&mut self) -> bool {
        let announced = self.announced.map(|announced| announced as usize);
        if let Some(announced) = announced {
            // What the last segment leaves unsaid, the first answer has said.
            let filling = self.data.len().saturating_sub(announced);
            if filling <= std::mem::take(&mut self.unsure) {
                self.data.truncate(announced);
            }
        }
        let length = self.data.len();
        match announced {
            _ if length > self.options.most_bytes => {
                self.give_up(AbortCode::OUT_OF_MEMORY, "the value is longer than the limit of this client");
            }
            Some(announced) if announced > length => {
                self.give_up(AbortCode::LENGTH_TOO_LOW, "the server has sent fewer bytes than it announced");
            }
            Some(announced) if announced < length => {
                self.give_up(AbortCode::LENGTH_TOO_HIGH, "the server has sent more bytes than it announced");
            }
            _ => {
                let (bytes, unsure) = (std::mem::take(&mut self.data), self.unsure);
                self.end(Ok(SdoValue { bytes, unsure }));
                return true;
            }
        }
        false
    }

    /// Takes bytes in that were read, as long as they are not too many; else the transfer is over. Up to `padding` of them
    /// may not count in the end.
    pub(super) fn take_in(&mut self, data: &[u8], padding: usize) -> bool {
        if self.data.len() + data.len() > self.options.most_bytes.saturating_add(padding) {
            self.give_up(AbortCode::OUT_OF_MEMORY, "the value is longer than the limit of this client");
            return false;
        }
        self.data.extend_from_slice(data);
        true
    }

    /// Counts blocks without progress, and says whether there may be more of them.
    pub(super) fn goes_on(&mut self, has_progress: bool) -> bool {
        self.repetitions = if has_progress { 0 } else { self.repetitions + 1 };
        let goes_on = self.repetitions <= MOST_REPETITIONS;
        if !goes_on {
            self.give_up(AbortCode::INVALID_SEQUENCE_NUMBER, "the same block was repeated again and again");
        }
        goes_on
    }
}
