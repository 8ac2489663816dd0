//! Why a transfer fails.

use super::Heard;
use crate::{BusError, SendError};
use edskit_runtime::Frame;
use edskit_types::AbortCode;
use thiserror::Error;

/// Why an SDO transfer has failed.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SdoError {
    /// The server has refused or ended it.
    #[error("the server has refused it: {0}")]
    Aborted(AbortCode),
    /// The server has not answered in time; it was told so with the abort code 05040000h.
    #[error("no answer in time{}", on_untaken(.heard.untaken.as_ref()))]
    TimedOut {
        /// What was heard meanwhile.
        heard: Heard,
    },
    /// The server has answered against the protocol; it was told so with this abort code.
    #[error("{reason} (ended with {code})")]
    GivenUp {
        /// The code that the server was told.
        code: AbortCode,
        /// What was wrong with the answer.
        reason: &'static str,
    },
    /// The value does not fit an expedited transfer, which was asked for.
    #[error("an expedited transfer has 1 to 4 bytes; choose a segmented or a block transfer")]
    NotExpedited,
    /// The value is longer than a transfer can say.
    #[error("{0} bytes are more than a transfer can have")]
    TooLong(usize),
    /// The bus is gone.
    #[error(transparent)]
    Bus(#[from] BusError),
    /// The bus does not take the request.
    #[error("the request cannot be sent: {0}")]
    Send(#[from] SendError),
}

fn on_untaken(untaken: Option<&Frame>) -> String {
    let Some(frame) = untaken else { return String::new() };
    let bytes: Vec<String> = frame.data().iter().map(|byte| format!("{byte:02X}")).collect();
    let bytes = bytes.join(" ");
    match frame.data().len() {
        _ if frame.is_remote() => "; what came instead is a remote frame".to_owned(),
        8 => format!("; the last message, {bytes}, is not the answer to this request"),
        0 => "; what came instead is a frame without data, and an SDO message has 8 bytes".to_owned(),
        1 => format!("; what came instead, {bytes}, has 1 byte, and an SDO message has 8"),
        length => format!("; what came instead, {bytes}, has {length} bytes, and an SDO message has 8"),
    }
}
