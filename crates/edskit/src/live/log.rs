//! What a command on a bus tells: lines for people, or JSON for machines.

use crate::Streams;
use crate::cli::LogFormat;
use edskit_host::Event;
use serde::Serialize;
use std::io;
use std::net::SocketAddr;

pub(crate) struct Log(LogFormat);

/// One line as JSON.
#[derive(Serialize)]
#[serde(tag = "event", rename_all = "kebab-case")]
enum Line<'a> {
    Listening { protocol: &'a str, address: SocketAddr },
    Bus { message: &'a str },
}

impl Log {
    pub(crate) fn new(format: LogFormat) -> Self {
        Self(format)
    }

    /// Where the bus of this process can be reached, on the first lines.
    pub(crate) fn reachable(
        &self,
        streams: &mut Streams,
        addresses: &[(&'static str, SocketAddr)],
    ) -> io::Result<()> {
        for (protocol, address) in addresses.iter().copied() {
            let line = Line::Listening { protocol, address };
            self.line(streams, &line, || format!("{protocol} {address}"))?;
        }
        Ok(())
    }

    pub(crate) fn bus(&self, streams: &mut Streams, event: &Event) -> io::Result<()> {
        self.message(streams, &event.to_string())
    }

    /// Something about the bus itself.
    pub(crate) fn message(&self, streams: &mut Streams, message: &str) -> io::Result<()> {
        self.line(streams, &Line::Bus { message }, || message.to_owned())
    }

    /// Printed at once: whoever waits for a line must not wait for a full buffer.
    pub(crate) fn line(
        &self,
        streams: &mut Streams,
        line: &impl Serialize,
        text: impl FnOnce() -> String,
    ) -> io::Result<()> {
        match self.0 {
            LogFormat::Text => writeln!(streams.stdout, "{}", text())?,
            LogFormat::Json => {
                serde_json::to_writer(&mut streams.stdout, line)?;
                writeln!(streams.stdout)?;
            }
        }
        streams.stdout.flush()
    }
}
