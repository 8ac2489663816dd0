//! Frames that wait to be sent.

use crate::Frame;
use edskit_types::CanId;

/// How many frames can wait. A block of 127 SDO segments is not queued at once; it follows as the queue empties.
const CAPACITY: usize = 16;

/// A bounded queue, first in, first out.
#[derive(Debug)]
pub(crate) struct Queue {
    frames: [Option<Frame>; CAPACITY],
    first: usize,
    length: usize,
    /// Whether a frame was lost since [`Queue::take_overflow`] was asked last.
    has_overflown: bool,
}

impl Queue {
    pub(crate) const fn new() -> Self {
        Self { frames: [None; CAPACITY], first: 0, length: 0, has_overflown: false }
    }

    /// Appends a data frame; false where there is no room, and the frame is lost.
    #[inline(never)]
    pub(crate) fn send(&mut self, can_id: CanId, data: &[u8]) -> bool {
        self.push(Frame::new(can_id, data))
    }

    fn push(&mut self, frame: Frame) -> bool {
        let place = (self.first + self.length) % CAPACITY;
        match self.frames.get_mut(place) {
            Some(slot) if self.length < CAPACITY => {
                *slot = Some(frame);
                self.length += 1;
                true
            }
            _ => {
                self.has_overflown = true;
                false
            }
        }
    }

    pub(crate) fn pop(&mut self) -> Option<Frame> {
        let frame = self.frames.get_mut(self.first)?.take()?;
        self.first = (self.first + 1) % CAPACITY;
        self.length -= 1;
        Some(frame)
    }

    /// How many more frames fit.
    pub(crate) fn room(&self) -> usize {
        CAPACITY - self.length
    }

    pub(crate) fn clear(&mut self) {
        *self = Self::new();
    }

    /// Whether a frame was lost, once.
    pub(crate) fn take_overflow(&mut self) -> bool {
        core::mem::take(&mut self.has_overflown)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(number: u8) -> Frame {
        Frame::new(CanId::NMT, &[number])
    }

    #[test]
    fn what_does_not_fit_is_said_once() {
        let mut queue = Queue::new();
        for number in 0..CAPACITY as u8 {
            assert!(queue.push(frame(number)));
        }
        assert!(!queue.push(frame(99)) && queue.room() == 0);
        assert!(queue.take_overflow() && !queue.take_overflow());
        assert_eq!(queue.pop(), Some(frame(0)));
        assert!(queue.push(frame(77)));
        let rest: std::vec::Vec<Frame> = core::iter::from_fn(|| queue.pop()).collect();
        assert_eq!((rest.len(), rest[0], rest[CAPACITY - 1]), (CAPACITY, frame(1), frame(77)));
        assert_eq!((queue.pop(), queue.room()), (None, CAPACITY));
    }
}
