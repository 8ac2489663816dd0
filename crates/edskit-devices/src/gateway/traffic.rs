//! What has gone over each PDO.

use edskit_runtime::{Frame, Instant, MOST_DATA};

/// What has gone over a PDO since the last initialisation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Traffic {
    /// How many frames.
    pub count: u32,
    /// When the last one was handed to the bus or taken from it.
    pub last: Option<Instant>,
    /// How long before that the one before was.
    pub interval: Option<u64>,
    data: [u8; MOST_DATA],
    length: u8,
}

impl Traffic {
    /// The data of the last frame.
    #[must_use]
    pub fn data(&self) -> &[u8] {
        self.data.get(..usize::from(self.length)).unwrap_or_default()
    }

    pub(super) fn record(&mut self, now: Instant, frame: &Frame) {
        self.count = self.count.saturating_add(1);
        self.interval = self.last.map(|last| now.since(last).0);
        self.last = Some(now);
        self.length = frame.data().len() as u8;
        if let Some(place) = self.data.get_mut(..frame.data().len()) {
            place.copy_from_slice(frame.data());
        }
    }
}
