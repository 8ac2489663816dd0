//! Ctrl-C, and what else asks a command to end.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Whether the user has asked the command to end.
pub(crate) struct Stop(Arc<AtomicBool>);

impl Stop {
    /// From now on Ctrl-C does not end the process but is noted; on Unix neither do SIGTERM and SIGHUP, so that what
    /// manages processes, or a terminal that is closed, ends a command as its user does.
    pub(crate) fn on_request() -> Result<Self, String> {
        let asked = Arc::new(AtomicBool::new(false));
        let noted = Arc::clone(&asked);
        ctrlc::set_handler(move || noted.store(true, Ordering::Relaxed))
            .map_err(|error| format!("signals cannot be caught: {error}"))?;
        Ok(Self(asked))
    }

    pub(crate) fn is_asked(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}
