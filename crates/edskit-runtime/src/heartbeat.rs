//! Heartbeat producer: 1017h (CiA 301 v4.2, 7.2.8.3.2).

use crate::Application;
use crate::context::Context;
use crate::nmt::error_control;
use crate::time::Timer;
use crate::{Instant, Microseconds};
use edskit_types::Index;

#[derive(Debug)]
pub(crate) struct Producer {
    timer: Timer,
    period: Microseconds,
}

impl Producer {
    pub(crate) const OFF: Self = Self { timer: Timer::OFF, period: Microseconds(0) };

    /// The boot-up message counts as the first heartbeat, so the next one comes after a period.
    pub(crate) fn started(now: Instant, period: Microseconds) -> Self {
        Self { timer: Timer::after(now, period), period }
    }

    pub(crate) fn deadline(&self) -> Instant {
        self.timer.deadline()
    }

    pub(crate) fn is_running(&self) -> bool {
        self.timer.is_running()
    }
}

impl<A: Application + ?Sized> Context<'_, A> {
    pub(crate) fn heartbeat_time(&mut self) -> Microseconds {
        let milliseconds: u16 = self.node.objects.value(Index::PRODUCER_HEARTBEAT, 0).unwrap_or_default();
        self.app.heartbeat_time(Microseconds::from_milliseconds(milliseconds.into()))
    }

    /// What follows from 1017h: the first heartbeat comes at once, and guarding ends, over which heartbeat has precedence.
    pub(crate) fn heartbeat_time_changed(&mut self) {
        let period = self.heartbeat_time();
        if period.0 == 0 {
            self.node.core.producer = Producer::OFF;
            return;
        }
        self.node.core.producer = Producer { timer: Timer::at(self.node.now), period };
        self.end_guarding();
        self.poll_heartbeat();
    }

    /// Sends the heartbeat when it is due, or as soon after that as the queue has room, which is told.
    pub(crate) fn poll_heartbeat(&mut self) {
        let (true, Some(node_id)) =
            (self.node.core.producer.timer.is_due(self.node.now), self.node.core.node_id)
        else {
            return;
        };
        if self.node.core.queue.room() == 0 {
            self.node.core.queue.note_loss();
            return;
        }
        self.node.core.queue.send(error_control(node_id), &[self.node.core.state.code()]);
        let producer = &mut self.node.core.producer;
        producer.timer = producer.timer.again(self.node.now, producer.period);
    }
}
