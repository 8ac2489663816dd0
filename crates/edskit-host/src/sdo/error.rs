//! Why a transfer fails.

use crate::{BusError, SendError};
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
    #[error("no answer in time{}", on_stray(.stray))]
    TimedOut {
        /// The last message on the channel that could not be the awaited answer, where one came.
        stray: Option<[u8; 8]>,
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

fn on_stray(stray: &Option<[u8; 8]>) -> String {
    match stray {
        None => String::new(),
        Some(message) => {
            let bytes: Vec<String> = message.iter().map(|byte| format!("{byte:02X}")).collect();
            format!("; the last message, {}, is the answer to something else", bytes.join(" "))
        }
    }
}
