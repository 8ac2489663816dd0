//! The grammar of commands on a live bus.

use super::{LogFormat, one_file, parse_node_id};
use crate::value::ValueType;
use clap::{Args, Subcommand, ValueEnum, ValueHint};
use edskit_host::Address;
use edskit_host::sdo::SdoMode;
use edskit_runtime::Microseconds;
use edskit_types::{Bitrate, NmtCommand, NodeId};
use std::net::SocketAddr;
use std::path::PathBuf;

/// The hub that `edskit bus` and `edskit run` open, over socketcand.
const HUB: &str = "socketcand:127.0.0.1:29536/can0";
/// The same over SLCAN, which has remote frames.
const HUB_WITH_REMOTE_FRAMES: &str = "slcan:127.0.0.1:29537";

#[derive(Args, Debug)]
pub(crate) struct RunArguments {
    /// An EDS or DCF; or `gateway`, the Heinzmann CANopen gateway, which is built in (a file of that name is `./gateway`)
    #[arg(value_hint = ValueHint::FilePath, value_parser = one_file())]
    pub(crate) file: PathBuf,
    /// The node-ID; that of a DCF if it has one, else 1. That of the gateway is its parameter P427
    #[arg(long, value_parser = parse_node_id)]
    pub(crate) node_id: Option<NodeId>,
    /// The bus: `hub` starts one in this process, `virtual` one whose time passes only while every attached program waits
    /// (docs/virtual-time.md), `socketcand:HOST:PORT`, `slcan:HOST:PORT`, `virtual:HOST:PORT` and `socketcan:can0` join one
    #[arg(long, value_name = "ADDRESS", default_value = "hub")]
    pub(crate) bus: Address,
    /// Where the hub listens for socketcand, and on the next port for SLCAN; where the bus in virtual time listens; port 0
    /// takes free ones
    #[arg(long, value_name = "ADDR:PORT")]
    pub(crate) listen: Option<SocketAddr>,
    /// The bit rate of the bus in virtual time, in kbit/s: 10, 20, 50, 125, 250, 500, 800, 1000 [default: that of a DCF if
    /// it has one, else 1000]. That of the gateway is its parameter P426
    #[arg(long, value_name = "KBIT", value_parser = parse_bit_rate)]
    pub(crate) bit_rate: Option<Bitrate>,
    /// Record every frame in this file: .log for the format of candump, .pcap for that of Wireshark
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub(crate) trace: Option<PathBuf>,
    /// How events are printed [default: text; of the gateway on a terminal a view instead]
    #[arg(long, value_enum)]
    pub(crate) log: Option<LogFormat>,
    /// The gateway's parameters, in a file as `edskit config check` takes it; without it each has its default
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath, value_parser = one_file())]
    pub(crate) params: Option<PathBuf>,
    /// What happens to the gateway, and when (docs/gateway.md)
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath, value_parser = one_file())]
    pub(crate) scenario: Option<PathBuf>,
    /// Run the gateway for so many seconds of virtual time, on a bus of its own and without waiting
    #[arg(long, value_name = "SECONDS", value_parser = parse_seconds, conflicts_with_all = ["bus", "listen", "bit_rate"])]
    pub(crate) simulate: Option<Microseconds>,
}

#[derive(Args, Debug)]
pub(crate) struct BusArguments {
    /// Where to listen for socketcand, and on the next port for SLCAN; port 0 takes free ones [default: 127.0.0.1:29536]
    #[arg(long, value_name = "ADDR:PORT")]
    pub(crate) listen: Option<SocketAddr>,
    /// Record every frame in this file: .log for the format of candump, .pcap for that of Wireshark
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub(crate) trace: Option<PathBuf>,
    /// How events are printed
    #[arg(long, value_enum, default_value_t = LogFormat::Text)]
    pub(crate) log: LogFormat,
}

#[derive(Args, Debug)]
pub(crate) struct MonitorArguments {
    /// The bus: `slcan:HOST:PORT`, `socketcand:HOST:PORT/CHANNEL` (has no remote frames), `virtual:HOST:PORT` or
    /// `socketcan:can0`; `hub` starts one
    #[arg(long, value_name = "ADDRESS", default_value = HUB_WITH_REMOTE_FRAMES)]
    pub(crate) bus: Address,
    /// An EDS or DCF that gives names and types to what a node says, and its PDOs until transfers show others; @NODE says
    /// which one, a DCF knows its own; may be given several times
    #[arg(long = "eds", value_name = "FILE[@NODE]", value_hint = ValueHint::FilePath)]
    pub(crate) devices: Vec<String>,
    /// How frames are printed
    #[arg(long, value_enum, default_value_t = LogFormat::Text)]
    pub(crate) log: LogFormat,
    /// Record every frame in this file: .log for the format of candump, .pcap for that of Wireshark
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub(crate) trace: Option<PathBuf>,
}

/// Where the bus is, and how long to wait on it.
#[derive(Args, Debug)]
pub(crate) struct ConnectionArguments {
    /// The bus: `socketcand:HOST:PORT/CHANNEL`, `slcan:HOST:PORT`, `virtual:HOST:PORT` or `socketcan:can0`
    #[arg(long, value_name = "ADDRESS", default_value = HUB)]
    pub(crate) bus: Address,
    /// How long to wait for an answer, in ms
    #[arg(long, value_name = "MS", default_value = "1000", value_parser = parse_time_out)]
    pub(crate) timeout: Microseconds,
}

#[derive(Args, Debug)]
pub(crate) struct NmtArguments {
    /// The node-ID, 1..127; 0 or `all` for every node
    #[arg(value_name = "NODE", value_parser = parse_nmt_target)]
    pub(crate) target: NmtTarget,
    /// What the node shall do
    #[arg(value_enum)]
    pub(crate) action: NmtAction,
    #[command(flatten)]
    pub(crate) connection: ConnectionArguments,
}

/// Whom an NMT command is for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum NmtTarget {
    All,
    Node(NodeId),
}

#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum NmtAction {
    /// Go to operational
    Start,
    /// Go to stopped
    Stop,
    /// Go to pre-operational
    Preop,
    /// Reset the node
    Reset,
    /// Reset its communication
    ResetComm,
}

impl NmtAction {
    pub(crate) fn command(self) -> NmtCommand {
        match self {
            Self::Start => NmtCommand::Start,
            Self::Stop => NmtCommand::Stop,
            Self::Preop => NmtCommand::EnterPreOperational,
            Self::Reset => NmtCommand::ResetNode,
            Self::ResetComm => NmtCommand::ResetCommunication,
        }
    }
}

#[derive(Args, Debug)]
pub(crate) struct SdoArguments {
    #[command(subcommand)]
    pub(crate) command: SdoCommand,
}

#[derive(Subcommand, Debug)]
pub(crate) enum SdoCommand {
    /// Read an entry
    Read(SdoReadArguments),
    /// Write an entry
    Write(SdoWriteArguments),
}

/// Which entry of which node, and how it is reached.
#[derive(Args, Debug)]
pub(crate) struct SdoPlaceArguments {
    /// The node-ID, 1..127
    #[arg(value_parser = parse_node_id)]
    pub(crate) node: NodeId,
    /// The entry in hexadecimal, `1018` or `1018:1`; with --eds also by its name, `Identity object/Vendor-ID`
    #[arg(value_name = "INDEX[:SUB]")]
    pub(crate) place: String,
    /// The EDS or DCF of the node: names, types, and better reasons where something is refused
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath, value_parser = one_file())]
    pub(crate) eds: Option<PathBuf>,
    /// The type of the value: u8..u64, i8..i64, f32, f64, bool, string, unicode, hex, time, duration
    #[arg(long = "type", value_name = "TYPE")]
    pub(crate) value_type: Option<ValueType>,
    /// The kind of transfer
    #[arg(long, value_enum, default_value_t = TransferKind::Auto)]
    pub(crate) transfer: TransferKind,
    #[command(flatten)]
    pub(crate) connection: ConnectionArguments,
}

#[derive(Args, Debug)]
pub(crate) struct SdoReadArguments {
    #[command(flatten)]
    pub(crate) place: SdoPlaceArguments,
    /// Write the bytes as they come into this file
    #[arg(long = "file", value_name = "PATH", value_hint = ValueHint::FilePath, conflicts_with = "format")]
    pub(crate) file: Option<PathBuf>,
    /// How the value is printed
    #[arg(long, value_enum, default_value_t = ReadFormat::Text)]
    pub(crate) format: ReadFormat,
}

#[derive(Args, Debug)]
pub(crate) struct SdoWriteArguments {
    #[command(flatten)]
    pub(crate) place: SdoPlaceArguments,
    /// The value, as an EDS would have it: 100, 0x64, -5, 1.5, text, 0A0B0C
    #[arg(required_unless_present = "file", conflicts_with = "file", allow_negative_numbers = true)]
    pub(crate) value: Option<String>,
    /// Write the bytes of this file
    #[arg(long = "file", value_name = "PATH", value_hint = ValueHint::FilePath)]
    pub(crate) file: Option<PathBuf>,
}

#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum TransferKind {
    /// What suits the length; segments where the node does no blocks
    Auto,
    /// In segments
    Segmented,
    /// In blocks
    Block,
    /// In one message
    Expedited,
}

impl TransferKind {
    pub(crate) fn mode(self) -> SdoMode {
        match self {
            Self::Auto => SdoMode::Automatic,
            Self::Segmented => SdoMode::Segmented,
            Self::Block => SdoMode::Block,
            Self::Expedited => SdoMode::Expedited,
        }
    }
}

#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum ReadFormat {
    /// Text
    Text,
    /// JSON
    Json,
}

fn parse_bit_rate(text: &str) -> Result<Bitrate, String> {
    let bit_rate = text.parse().ok().and_then(Bitrate::from_kbit_per_s);
    bit_rate
        .ok_or_else(|| "a bit rate of CANopen is 10, 20, 50, 125, 250, 500, 800 or 1000 kbit/s".to_owned())
}

/// The longest time that can be simulated, in s: eleven days.
const MOST_SECONDS: f64 = 1e6;

fn parse_seconds(text: &str) -> Result<Microseconds, String> {
    let seconds = text.parse().ok().filter(|seconds| (1e-6..=MOST_SECONDS).contains(seconds));
    let seconds: f64 = seconds.ok_or("seconds are expected, up to 1000000")?;
    Ok(Microseconds((seconds * 1e6).round() as u64))
}

fn parse_nmt_target(text: &str) -> Result<NmtTarget, String> {
    if text == "all" || text == "0" {
        return Ok(NmtTarget::All);
    }
    let node_id = parse_node_id(text).map_err(|_| "a node-ID is 1..127, and 0 or `all` means every node")?;
    Ok(NmtTarget::Node(node_id))
}

fn parse_time_out(text: &str) -> Result<Microseconds, String> {
    let milliseconds: u32 = text.parse().map_err(|_| "milliseconds are expected, 1..4294967295")?;
    if milliseconds == 0 {
        return Err("without any time nobody can answer".to_owned());
    }
    Ok(Microseconds::from_milliseconds(milliseconds))
}
