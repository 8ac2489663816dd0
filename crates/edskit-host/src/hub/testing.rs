//! What the tests of both dialects need.

use super::{Answer, Dialect};
use edskit_runtime::Frame;
use edskit_types::CanId;

pub(crate) fn standard(id: u16, data: &[u8]) -> Frame {
    Frame::new(CanId::standard(id).unwrap(), data)
}

pub(crate) fn extended(id: u32, data: &[u8]) -> Frame {
    Frame::new(CanId::extended(id).unwrap(), data)
}

/// What a server answers to pieces of a conversation.
pub(crate) fn answers<S: Dialect + Default>(pieces: &[&[u8]]) -> Vec<Answer> {
    let (mut server, mut answers) = (S::default(), Vec::new());
    for piece in pieces {
        server.feed(piece, &mut |answer| answers.push(answer));
    }
    answers
}
