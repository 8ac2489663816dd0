//! Segments, where `Automatic` has chosen blocks and the server does not do them.

use super::message::{Message, SERVICE};
use super::transfer::Phase;
use super::{SdoError, SdoMode, SdoValue, Transfer};
use edskit_types::AbortCode;

impl Transfer {
    /// An answer to the request for blocks that only an ordinary transfer has. CiA 301 v4.2, 7.2.4.3 lets a server switch
    /// only where the client allows it, but some do it always.
    pub(super) fn switches_to_segments(&mut self, answer: &Message) -> bool {
        let is_ordinary = matches!(answer[0] & SERVICE, 0x40 | 0x60) && self.is_for_us(answer);
        // Who has asked for blocks alone may hear the answer to an earlier request.
        if !is_ordinary || self.options.mode != SdoMode::Automatic {
            return false;
        }
        self.give_up(AbortCode::UNKNOWN_COMMAND, "the server answers the request for blocks as any other");
        true
    }

    /// The transfer has failed; the server is told where it does not know. It ends, unless segments may do.
    pub(super) fn fail(&mut self, error: SdoError) {
        self.clear();
        match error {
            SdoError::GivenUp { code, .. } => self.tell(code),
            SdoError::TimedOut { .. } => self.tell(AbortCode::TIME_OUT),
            _ => {}
        }
        if self.segments_may_do(&error) {
            self.may_be_echoed = !matches!(error, SdoError::Aborted(_));
            self.begin_in_segments();
        } else {
            self.end(Err(error));
        }
    }

    fn segments_may_do(&self, error: &SdoError) -> bool {
        if self.options.mode != SdoMode::Automatic {
            return false;
        }
        match (self.phase, error) {
            // The limit of this client is the same in segments.
            (_, SdoError::GivenUp { code: AbortCode::OUT_OF_MEMORY, .. }) => false,
            // Reading once more does no harm, and that the entry can be read is known.
            (Phase::BlockUploadBegin | Phase::BlockUpload { .. } | Phase::BlockUploadEnd, _) => true,
            (Phase::BlockDownloadBegin | Phase::BlockDownload { .. } | Phase::BlockDownloadEnd, error) => {
                match *error {
                    SdoError::Aborted(code) if self.confirmed > 0 => is_about_blocks(code),
                    SdoError::Aborted(code) => !is_about_the_entry(code),
                    // A server that has confirmed a block does them; it is away, or busy with what it got.
                    SdoError::TimedOut { .. } => self.confirmed == 0,
                    _ => true,
                }
            }
            _ => false,
        }
    }

    fn begin_in_segments(&mut self) {
        self.options.mode = SdoMode::Segmented;
        self.heard.without_blocks = true;
        self.confirmed = 0;
        self.announced = None;
        self.first = None;
        match self.phase {
            Phase::BlockDownloadBegin | Phase::BlockDownload { .. } | Phase::BlockDownloadEnd => {
                self.begin_write();
            }
            _ => {
                self.data.clear();
                self.begin_upload();
            }
        }
    }

    /// An abort that may be the answer to our own: some servers answer those too. If nothing else comes, it was meant.
    pub(super) fn is_echo(&mut self, code: AbortCode) -> bool {
        let is_echo = self.may_be_echoed && self.phase.is_begin();
        if is_echo {
            self.may_be_echoed = false;
            self.echo = Some(code);
        }
        is_echo
    }

    pub(super) fn done(&mut self) {
        self.end(Ok(SdoValue::default()));
    }
}

/// Whether a server that has taken a block already says by this code that it and we do blocks in different ways.
fn is_about_blocks(code: AbortCode) -> bool {
    matches!(
        code,
        AbortCode::UNKNOWN_COMMAND
            | AbortCode::INVALID_BLOCK_SIZE
            | AbortCode::INVALID_SEQUENCE_NUMBER
            | AbortCode::CRC_ERROR
    )
}

/// Whether a server says by this code that the entry cannot be written in any kind of transfer.
fn is_about_the_entry(code: AbortCode) -> bool {
    matches!(
        code,
        AbortCode::WRITE_ONLY
            | AbortCode::READ_ONLY
            | AbortCode::OBJECT_DOES_NOT_EXIST
            | AbortCode::SUB_INDEX_DOES_NOT_EXIST
            | AbortCode::INVALID_VALUE
            | AbortCode::VALUE_TOO_HIGH
            | AbortCode::VALUE_TOO_LOW
    )
}
