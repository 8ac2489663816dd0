//! What a running node tells.

use crate::Streams;
use crate::live::Log;
use edskit_host::DeviceEvent;
use edskit_types::NodeId;
use serde::Serialize;
use std::io;

/// One line of the log as JSON.
#[derive(Serialize)]
#[serde(tag = "event", rename_all = "kebab-case")]
enum Line<'a> {
    Node { node_id: u8, product: Option<&'a str> },
    State { state: String },
    Emergency { code: u16, register: u8, info: [u8; 5] },
}

/// Which node it is.
pub(super) fn node(
    log: &Log,
    streams: &mut Streams,
    node_id: NodeId,
    product: Option<&str>,
) -> io::Result<()> {
    let node_id = node_id.get();
    let product = product.filter(|product| !product.is_empty());
    log.line(streams, &Line::Node { node_id, product }, || match product {
        Some(product) => format!("node {node_id}: {product}"),
        None => format!("node {node_id}"),
    })
}

/// What has happened to the device.
pub(super) fn device(log: &Log, streams: &mut Streams, event: &DeviceEvent) -> io::Result<()> {
    match *event {
        DeviceEvent::State(state) => {
            log.line(streams, &Line::State { state: state.to_string() }, || state.to_string())
        }
        DeviceEvent::Emergency(emergency) => {
            let edskit_runtime::Emergency { code, register, info } = emergency;
            log.line(streams, &Line::Emergency { code, register, info }, || match code {
                0 => format!("an error has gone, error register {register:02X}h"),
                _ => format!("emergency {code:04X}h, error register {register:02X}h, {info:02X?}"),
            })
        }
    }
}
