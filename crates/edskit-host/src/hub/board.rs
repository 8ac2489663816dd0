//! Who is on the bus of a hub, and the delivery of frames.

use crate::queue::Queue;
use crate::{Received, system_now};
use edskit_runtime::Frame;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// How many frames may wait for a participant: more than tools send in a burst.
pub(crate) const MOST_WAITING: usize = 32_768;

/// How many clients are served at a time.
const MOST_CLIENTS: usize = 64;

/// Names a participant in the life of a board.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Seat(u64);

/// Where the frames for a participant go.
pub(crate) trait Inbox: Send + Sync {
    /// Takes a frame; says whether an older one had to go.
    fn put(&self, received: Received) -> bool;
}

impl Inbox for Queue<Received> {
    fn put(&self, received: Received) -> bool {
        self.push(received)
    }
}

/// The participants.
#[derive(Default)]
pub(crate) struct Board {
    members: Mutex<Vec<Member>>,
    next_seat: AtomicU64,
    frames_lost: AtomicU64,
    clients: AtomicUsize,
}

struct Member {
    seat: Seat,
    inbox: Arc<dyn Inbox>,
    takes_remote_frames: bool,
}

impl Board {
    /// A name for someone who may send and later join.
    pub(crate) fn seat(&self) -> Seat {
        Seat(self.next_seat.fetch_add(1, Ordering::Relaxed))
    }

    /// From now on `inbox` gets the frames of all others. No frame comes between what `before` does and that.
    pub(crate) fn join(
        &self,
        seat: Seat,
        inbox: Arc<dyn Inbox>,
        takes_remote_frames: bool,
        before: impl FnOnce(),
    ) {
        let mut members = self.members();
        before();
        if members.iter().all(|member| member.seat != seat) {
            members.push(Member { seat, inbox, takes_remote_frames });
        }
    }

    pub(crate) fn leave(&self, seat: Seat) {
        self.members().retain(|member| member.seat != seat);
    }

    /// Delivers a frame to all but its sender. The lock makes the order the same for all.
    pub(crate) fn publish(&self, sender: Seat, frame: Frame) {
        let members = self.members();
        let received = Received { time: system_now(), frame };
        for member in members.iter().filter(|member| member.seat != sender) {
            if (member.takes_remote_frames || !frame.is_remote()) && member.inbox.put(received) {
                self.frames_lost.fetch_add(1, Ordering::Relaxed);
            }
        }
    }

    /// Counts a client in, if there is room for it.
    pub(crate) fn admit(&self) -> bool {
        let room = |count| (count < MOST_CLIENTS).then_some(count + 1);
        self.clients.fetch_update(Ordering::Relaxed, Ordering::Relaxed, room).is_ok()
    }

    /// Counts a client out.
    pub(crate) fn dismiss(&self) {
        self.clients.fetch_sub(1, Ordering::Relaxed);
    }

    pub(crate) fn clients(&self) -> usize {
        self.clients.load(Ordering::Relaxed)
    }

    pub(crate) fn frames_lost(&self) -> u64 {
        self.frames_lost.load(Ordering::Relaxed)
    }

    /// A panic elsewhere leaves no half-made change behind, so the list can be used.
    fn members(&self) -> MutexGuard<'_, Vec<Member>> {
        self.members.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use edskit_types::CanId;

    #[test]
    fn a_full_inbox_loses_the_oldest_and_the_board_counts() {
        let board = Board::default();
        let (sender, reader) = (board.seat(), board.seat());
        let inbox = Arc::new(Queue::<Received>::new(3));
        board.join(reader, inbox.clone(), false, || {});
        for byte in 0..5 {
            board.publish(sender, Frame::new(CanId::NMT, &[byte]));
        }
        board.publish(sender, Frame::remote(CanId::NMT, 0));
        board.publish(reader, Frame::new(CanId::NMT, &[9]));
        assert_eq!(board.frames_lost(), 2);
        let left = std::iter::from_fn(|| inbox.pop()).map(|received| received.frame.data()[0]);
        assert_eq!(left.collect::<Vec<_>>(), [2, 3, 4]);
    }

    #[test]
    fn there_is_room_for_so_many_clients() {
        let board = Board::default();
        assert_eq!((0..100).filter(|_| board.admit()).count(), MOST_CLIENTS);
        board.dismiss();
        assert!(board.admit() && !board.admit());
    }
}
