//! The terminal.

use super::View;
use crate::run::gateway::session::LiveGateway;
use edskit_runtime::Microseconds;
use ratatui::DefaultTerminal;
use ratatui::crossterm::event::{self, Event, KeyCode, KeyEvent, KeyModifiers};
use std::io;
use std::time::Duration;

/// The terminal, taken over until this is dropped. A panic gives it back too.
pub(in crate::run::gateway) struct Screen {
    terminal: DefaultTerminal,
}

impl Screen {
    /// How long a picture stays at least.
    pub(in crate::run::gateway) const INTERVAL: Microseconds = Microseconds::from_milliseconds(100);

    pub(in crate::run::gateway) fn open() -> io::Result<Self> {
        // A part of it may have been done before it failed.
        let terminal = ratatui::try_init().inspect_err(|_| ratatui::restore())?;
        Ok(Self { terminal })
    }

    /// Whether the user wants to leave: `q` or Ctrl-C, which is a key here and no signal.
    pub(in crate::run::gateway) fn is_left(&mut self) -> io::Result<bool> {
        while event::poll(Duration::ZERO)? {
            if let Event::Key(key) = event::read()?
                && leaves(&key)
            {
                return Ok(true);
            }
        }
        Ok(false)
    }

    pub(in crate::run::gateway) fn show(
        &mut self,
        view: &View,
        gateway: &LiveGateway,
        time: Microseconds,
    ) -> io::Result<()> {
        self.terminal.draw(|frame| view.draw(frame, gateway, time))?;
        Ok(())
    }
}

impl Drop for Screen {
    fn drop(&mut self) {
        ratatui::restore();
    }
}

fn leaves(key: &KeyEvent) -> bool {
    let is_control = key.modifiers.contains(KeyModifiers::CONTROL);
    key.is_press() && (key.code == KeyCode::Char('q') || is_control && key.code == KeyCode::Char('c'))
}
