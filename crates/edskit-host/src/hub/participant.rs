//! A participant of a hub in the hub's own process.

use super::board::{Board, MOST_WAITING, Seat};
use crate::queue::Queue;
use crate::{Bus, BusError, Event, Received, SendError, system_now};
use edskit_runtime::{Frame, Instant};
use std::sync::Arc;

/// A participant of a [`Hub`](crate::Hub) in the same process. Its transmit side is never full.
pub struct HubParticipant {
    board: Arc<Board>,
    seat: Seat,
    inbox: Arc<Queue<Received>>,
    /// Frames lost that nobody has been told of.
    lost: u64,
}

impl HubParticipant {
    pub(super) fn new(board: &Arc<Board>) -> Self {
        let (seat, inbox) = (board.seat(), Arc::new(Queue::new(MOST_WAITING)));
        board.join(seat, inbox.clone(), true, || {});
        Self { board: Arc::clone(board), seat, inbox, lost: 0 }
    }
}

impl Bus for HubParticipant {
    fn now(&self) -> Instant {
        system_now()
    }

    fn receive(&mut self) -> Result<Option<Received>, BusError> {
        self.lost += self.inbox.take_lost();
        Ok(self.inbox.pop())
    }

    fn send(&mut self, frame: &Frame) -> Result<(), SendError> {
        self.board.publish(self.seat, *frame);
        Ok(())
    }

    fn wait(&mut self, deadline: Instant) -> Result<(), BusError> {
        self.inbox.wait(deadline);
        Ok(())
    }

    fn event(&mut self) -> Option<Event> {
        let lost = std::mem::take(&mut self.lost);
        (lost > 0).then_some(Event::FramesLost(lost))
    }
}

impl Drop for HubParticipant {
    fn drop(&mut self) {
        self.board.leave(self.seat);
    }
}
