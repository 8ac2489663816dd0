//! What a running node tells: lines for people, or JSON for machines.

use crate::Streams;
use crate::cli::LogFormat;
use edskit_host::{DeviceEvent, Event};
use edskit_types::NodeId;
use serde::Serialize;
use std::io;
use std::net::SocketAddr;

pub(super) struct Log(LogFormat);

/// One line of the log as JSON.
#[derive(Serialize)]
#[serde(tag = "event", rename_all = "kebab-case")]
enum Line<'a> {
    Listening { protocol: &'a str, address: SocketAddr },
    Node { node_id: u8, product: Option<&'a str> },
    Bus { message: String },
    State { state: String },
    Emergency { code: u16, register: u8, info: [u8; 5] },
}

impl Log {
    pub(super) fn new(format: LogFormat) -> Self {
        Self(format)
    }

    pub(super) fn listening(
        &mut self,
        streams: &mut Streams,
        protocol: &str,
        address: SocketAddr,
    ) -> io::Result<()> {
        self.line(streams, &Line::Listening { protocol, address }, || format!("{protocol} {address}"))
    }

    pub(super) fn node(
        &mut self,
        streams: &mut Streams,
        node_id: NodeId,
        product: Option<&str>,
    ) -> io::Result<()> {
        let node_id = node_id.get();
        let product = product.filter(|product| !product.is_empty());
        self.line(streams, &Line::Node { node_id, product }, || match product {
            Some(product) => format!("node {node_id}: {product}"),
            None => format!("node {node_id}"),
        })
    }

    pub(super) fn bus(&mut self, streams: &mut Streams, event: &Event) -> io::Result<()> {
        let message = event.to_string();
        self.line(streams, &Line::Bus { message: message.clone() }, || message)
    }

    pub(super) fn device(&mut self, streams: &mut Streams, event: &DeviceEvent) -> io::Result<()> {
        match *event {
            DeviceEvent::State(state) => {
                self.line(streams, &Line::State { state: state.to_string() }, || state.to_string())
            }
            DeviceEvent::Emergency(emergency) => {
                let edskit_runtime::Emergency { code, register, info } = emergency;
                self.line(streams, &Line::Emergency { code, register, info }, || match code {
                    0 => format!("an error has gone, error register {register:02X}h"),
                    _ => format!("emergency {code:04X}h, error register {register:02X}h, {info:02X?}"),
                })
            }
        }
    }

    /// Printed at once: whoever waits for the addresses must not wait for a full buffer.
    fn line(&self, streams: &mut Streams, line: &Line<'_>, text: impl FnOnce() -> String) -> io::Result<()> {
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
