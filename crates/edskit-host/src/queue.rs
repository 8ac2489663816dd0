//! Bounded queues between threads.

use crate::clock::time_until;
use edskit_runtime::Instant;
use std::collections::VecDeque;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};

/// A queue that never holds more than its capacity. What happens when it is full is the writer's choice: [`Queue::push`]
/// drops the oldest item, [`Queue::offer`] refuses the new one.
pub(crate) struct Queue<T> {
    state: Mutex<State<T>>,
    changed: Condvar,
    capacity: usize,
}

struct State<T> {
    items: VecDeque<T>,
    lost: u64,
    is_closed: bool,
}

/// Why an item was not taken.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Refusal {
    Full,
    Closed,
}

impl<T> Queue<T> {
    pub(crate) fn new(capacity: usize) -> Self {
        let state = State { items: VecDeque::new(), lost: 0, is_closed: false };
        Self { state: Mutex::new(state), changed: Condvar::new(), capacity }
    }

    /// Puts an item in; where there is no room, the oldest goes and is counted. Returns whether that was so.
    pub(crate) fn push(&self, item: T) -> bool {
        let mut state = self.lock();
        if state.is_closed {
            return false;
        }
        let is_full = state.items.len() >= self.capacity;
        if is_full {
            state.items.pop_front();
            state.lost += 1;
        }
        state.items.push_back(item);
        drop(state);
        self.changed.notify_one();
        is_full
    }

    /// Puts an item in if there is room.
    pub(crate) fn offer(&self, item: T) -> Result<(), Refusal> {
        let mut state = self.lock();
        if state.is_closed {
            return Err(Refusal::Closed);
        }
        if state.items.len() >= self.capacity {
            return Err(Refusal::Full);
        }
        state.items.push_back(item);
        drop(state);
        self.changed.notify_one();
        Ok(())
    }

    /// The oldest item, if there is one.
    pub(crate) fn pop(&self) -> Option<T> {
        self.lock().items.pop_front()
    }

    /// How many items have been dropped since this was asked last.
    pub(crate) fn take_lost(&self) -> u64 {
        std::mem::take(&mut self.lock().lost)
    }

    /// Waits for an item, the end of the queue, or `deadline`.
    pub(crate) fn wait(&self, deadline: Instant) {
        let mut state = self.lock();
        while state.items.is_empty() && !state.is_closed {
            state = match time_until(deadline) {
                None => self.changed.wait(state).unwrap_or_else(PoisonError::into_inner),
                Some(rest) if rest.is_zero() => return,
                Some(rest) => {
                    self.changed.wait_timeout(state, rest).unwrap_or_else(PoisonError::into_inner).0
                }
            };
        }
    }

    /// Waits for items and moves up to `most` of them to `batch`. Without any, the queue is closed and empty.
    pub(crate) fn take_batch(&self, batch: &mut Vec<T>, most: usize) {
        self.wait(Instant::NEVER);
        let mut state = self.lock();
        let count = state.items.len().min(most);
        batch.extend(state.items.drain(..count));
    }

    /// Nothing goes in any more; what is in can be taken.
    pub(crate) fn close(&self) {
        self.lock().is_closed = true;
        self.changed.notify_all();
    }

    /// Nothing goes in any more, and what is in goes away.
    pub(crate) fn abort(&self) {
        self.lock().items = VecDeque::new();
        self.close();
    }

    /// A panic elsewhere leaves no half-made change behind, so the state can be used.
    fn lock(&self) -> MutexGuard<'_, State<T>> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system_now;
    use edskit_runtime::Microseconds;

    #[test]
    fn the_oldest_goes_and_is_counted() {
        let queue = Queue::new(2);
        assert_eq!([1, 2, 3, 4].map(|item| queue.push(item)), [false, false, true, true]);
        assert_eq!((queue.take_lost(), queue.take_lost()), (2, 0));
        assert_eq!([queue.pop(), queue.pop(), queue.pop()], [Some(3), Some(4), None]);
    }

    #[test]
    fn an_offer_to_a_full_or_closed_queue_is_refused() {
        let queue = Queue::new(1);
        assert_eq!(queue.offer(1), Ok(()));
        assert_eq!(queue.offer(2), Err(Refusal::Full));
        queue.close();
        assert_eq!(queue.offer(3), Err(Refusal::Closed));
        let mut batch = Vec::new();
        queue.take_batch(&mut batch, 9);
        assert_eq!(batch, [1]);
        batch.clear();
        queue.take_batch(&mut batch, 9);
        assert!(batch.is_empty());
    }

    #[test]
    fn waiting_ends_at_the_deadline() {
        let queue = Queue::<u8>::new(1);
        let deadline = system_now() + Microseconds(2_000);
        queue.wait(deadline);
        assert!(system_now() >= deadline);
    }
}
