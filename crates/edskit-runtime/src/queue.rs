//! Frames that wait to be sent.

use crate::Frame;
use crate::ring::Ring;
use edskit_types::CanId;

/// How many frames can wait. A block of 127 SDO segments is not queued at once; it follows as the queue empties.
const CAPACITY: usize = 16;

/// The frames that wait, and whether all could.
#[derive(Debug)]
pub(crate) struct Queue {
    frames: Ring<Frame, CAPACITY>,
    /// Whether something was lost since [`Queue::take_overflow`] was asked last.
    has_overflown: bool,
}

impl Queue {
    pub(crate) const fn new() -> Self {
        Self { frames: Ring::new(Frame::NONE), has_overflown: false }
    }

    /// Appends a data frame; where there is no room it is lost, and that is noted.
    #[inline(never)]
    pub(crate) fn send(&mut self, can_id: CanId, data: &[u8]) {
        self.has_overflown |= !self.frames.push(Frame::new(can_id, data));
    }

    pub(crate) fn pop(&mut self) -> Option<Frame> {
        self.frames.pop()
    }

    /// How many more frames fit.
    pub(crate) fn room(&self) -> usize {
        self.frames.room()
    }

    pub(crate) fn clear(&mut self) {
        self.frames.clear();
        self.has_overflown = false;
    }

    /// Something could not be sent in its time, and will not be or is late.
    pub(crate) fn note_loss(&mut self) {
        self.has_overflown = true;
    }

    /// Whether a frame was lost, once.
    pub(crate) fn take_overflow(&mut self) -> bool {
        core::mem::take(&mut self.has_overflown)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_does_not_fit_is_said_once() {
        let mut queue = Queue::new();
        for number in 0..CAPACITY as u8 {
            queue.send(CanId::NMT, &[number]);
        }
        assert!(!queue.take_overflow() && queue.room() == 0);
        queue.send(CanId::NMT, &[99]);
        assert!(queue.take_overflow() && !queue.take_overflow());
        assert_eq!(queue.pop(), Some(Frame::new(CanId::NMT, &[0])));
    }
}
