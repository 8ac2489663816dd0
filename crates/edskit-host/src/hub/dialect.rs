//! What the protocols of the hub have in common.

use crate::Received;
use edskit_runtime::Frame;
use std::time::Duration;

/// One client's conversation in one protocol.
pub(crate) trait Dialect: Send {
    /// What is said to a client before it says anything.
    fn greeting(&self) -> Option<&'static [u8]>;

    /// Takes what the client says and answers.
    fn feed(&mut self, bytes: &[u8], answer: &mut dyn FnMut(Answer));

    /// Whether remote frames can be said.
    fn carries_remote_frames(&self) -> bool;

    /// What writes a frame for the client.
    fn encoder(&self) -> fn(&Received, &mut Vec<u8>);
}

/// What follows from what a client says.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Answer {
    /// Say this, in a segment of its own.
    Reply(&'static [u8]),
    /// Say this, in a segment of its own, and nothing for a while; from then on the client hears the bus. Who has heard
    /// the reply misses no frame that is sent afterwards.
    Join(&'static [u8], Duration),
    /// The client does not hear the bus any more.
    Leave,
    /// The client sends a frame.
    Frame(Frame),
}
