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
    lost: Option<Event>,
}

impl HubParticipant {
    pub(super) fn new(board: &Arc<Board>) -> Self {
        let (seat, inbox) = (board.seat(), Arc::new(Queue::new(MOST_WAITING)));
        board.join(seat, inbox.clone(), true);
        Self { board: Arc::clone(board), seat, inbox, lost: None }
    }
}

impl Bus for HubParticipant {
    fn now(&self) -> Instant {
        system_now()
    }

    fn receive(&mut self) -> Result<Option<Received>, BusError> {
        let lost = self.inbox.take_lost();
        if lost > 0 {
            self.lost = Some(Event::FramesLost(lost));
        }
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
        self.lost.take()
    }
}

impl Drop for HubParticipant {
    fn drop(&mut self) {
        self.board.leave(self.seat);
    }
}
