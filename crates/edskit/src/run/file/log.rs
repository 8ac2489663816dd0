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
    ValueRefused { rpdo: u16, index: u16, sub_index: u8, code: u32 },
    BitRate { kbit_per_s: u16 },
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
        DeviceEvent::ValueRefused { rpdo, index, sub_index, code } => {
            let line = Line::ValueRefused { rpdo, index: index.0, sub_index: sub_index.0, code: code.0 };
            let what = || format!("RPDO{rpdo}: a value for {index} sub-index {sub_index} is refused, {code}");
            log.line(streams, &line, what)
        }
        DeviceEvent::BitRate(bit_rate) => {
            let line = Line::BitRate { kbit_per_s: bit_rate.kbit_per_s() };
            log.line(streams, &line, || format!("LSS: {bit_rate} from now on, which nothing changes here"))
        }
    }
}
