//! A transfer that has begun: what has come of its value.

use edskit_host::sdo::SdoValue;
use edskit_types::{Index, SubIndex};

/// How much of a value is remembered; of longer ones the transfer is followed, but the value is not shown.
const MOST_BYTES: usize = 1 << 20;

/// What has been seen of a transfer.
pub(super) struct Running {
    pub(super) place: (Index, SubIndex),
    pub(super) is_write: bool,
    /// `None` where a part is missing or where it is too long.
    pub(super) data: Option<Vec<u8>>,
    /// How many bytes there are, where that was said before they came.
    pub(super) announced: Option<u32>,
    /// How many of the last bytes may be filling.
    pub(super) unsure: usize,
    /// The toggle bit of the segment that was taken last.
    pub(super) toggle: Option<u8>,
    /// In a block transfer: the segments of the block that came in order, and whether segments come now.
    pub(super) block: Vec<[u8; 7]>,
    pub(super) is_in_block: bool,
    pub(super) is_complete: bool,
}

impl Running {
    pub(super) fn new(place: (Index, SubIndex), is_write: bool) -> Self {
        let (data, block) = (Some(Vec::new()), Vec::new());
        Self {
            place,
            is_write,
            data,
            announced: None,
            unsure: 0,
            toggle: None,
            block,
            is_in_block: false,
            is_complete: false,
        }
    }

    /// The value, as far as it has come. What the last segment leaves unsaid, the first message may have said.
    pub(super) fn value(&mut self) -> Option<SdoValue> {
        let mut value = SdoValue { bytes: self.data.take()?, unsure: self.unsure };
        if let Some(announced) = self.announced {
            if value.bytes.len().saturating_sub(announced as usize) <= value.unsure {
                value.bytes.truncate(announced as usize);
            }
            value.unsure = 0;
        }
        Some(value)
    }

    pub(super) fn append(&mut self, bytes: &[u8]) {
        self.data = self.data.take().filter(|data| data.len() + bytes.len() <= MOST_BYTES);
        if let Some(data) = &mut self.data {
            data.extend_from_slice(bytes);
        }
    }

    /// A confirmed part of a block.
    pub(super) fn confirm(&mut self, sequence: u8) {
        let segments = std::mem::take(&mut self.block);
        if segments.len() < usize::from(sequence) {
            self.data = None;
        }
        for segment in segments.iter().take(sequence.into()) {
            self.append(segment);
        }
        self.is_complete &= segments.len() == usize::from(sequence);
        self.is_in_block = !self.is_complete;
    }
}
