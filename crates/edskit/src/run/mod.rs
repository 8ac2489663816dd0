//! `edskit run`: any EDS or DCF as a live node.

mod log;

use crate::cli::RunArguments;
use crate::{Exit, Streams};
use edskit_codegen::{Layout, LoadedDictionary, SideFile, lay_out};
use edskit_host::{Address, Bus, BusError, Hub, HubOptions, MemoryDevice, MemoryStorage, Station, open};
use edskit_lint::FileKind;
use edskit_model::{Datasheet, Document, Field};
use edskit_runtime::{Microseconds, Node, Settings};
use edskit_types::NodeId;
use log::Log;
use std::fs;
use std::io;
use std::net::SocketAddr;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// How often the loop looks whether it has been asked to end, in microseconds.
const PATIENCE: Microseconds = Microseconds(200_000);

pub(crate) fn run(arguments: &RunArguments, streams: &mut Streams) -> io::Result<Exit> {
    let (layout, commissioned) = match load(&arguments.file) {
        Ok(loaded) => loaded,
        Err(reasons) => {
            for reason in reasons {
                streams.complain(format_args!("{reason}"));
            }
            return Ok(Exit::Failed);
        }
    };
    let node_id = arguments.node_id.or(commissioned).unwrap_or(NodeId::MIN);
    let mut log = Log::new(arguments.log);
    // The hub lives as long as the node.
    let (bus, _hub) = match connect(arguments, &mut log, streams) {
        Ok(connected) => connected,
        Err(reason) => {
            streams.complain(format_args!("{reason}"));
            return Ok(Exit::Failed);
        }
    };
    let stop = Arc::new(AtomicBool::new(false));
    let asked = Arc::clone(&stop);
    if let Err(error) = ctrlc::set_handler(move || asked.store(true, Ordering::Relaxed)) {
        streams.complain(format_args!("Ctrl-C cannot be caught: {error}"));
        return Ok(Exit::Failed);
    }
    log.node(streams, node_id, layout.product.as_deref())?;
    let settings = Settings { node_id: Some(node_id), ..Settings::default() };
    let node = Node::new(LoadedDictionary::new(&layout), settings, MemoryStorage::default());
    let mut station = Station::new(node, MemoryDevice::default(), bus);
    while !stop.load(Ordering::Relaxed) {
        let deadline = match station.round() {
            Ok(deadline) => deadline,
            Err(error) => return lost(&error, streams),
        };
        while let Some(event) = station.bus.event() {
            log.bus(streams, &event)?;
        }
        for event in station.device.take_events() {
            log.device(streams, &event)?;
        }
        let patience = station.bus.now() + PATIENCE;
        if let Err(error) = station.bus.wait(deadline.min(patience)) {
            return lost(&error, streams);
        }
    }
    Ok(Exit::Clean)
}

fn lost(error: &BusError, streams: &mut Streams) -> io::Result<Exit> {
    streams.complain(format_args!("{error}"));
    Ok(Exit::Failed)
}

/// Reads a file and lays its dictionary out; with the node-ID that a DCF commissions.
fn load(path: &Path) -> Result<(Layout, Option<NodeId>), Vec<String>> {
    let name = path.display();
    let bytes = fs::read(path).map_err(|error| vec![format!("{name}: {error}")])?;
    let sheet = Datasheet::new(Document::from_vec(bytes));
    let layout = lay_out(&sheet, &SideFile::default()).map_err(|problems| {
        problems
            .iter()
            .map(|problem| format!("{name}:{}: {}", problem.position, problem.message))
            .collect::<Vec<_>>()
    })?;
    if layout.entries.is_empty() {
        return Err(vec![format!("{name}: the file describes no object, so there is nothing to run")]);
    }
    let is_dcf = FileKind::of(&name.to_string()) == FileKind::Dcf;
    let commissioning = sheet.commissioning().filter(|_| is_dcf);
    let node_id = commissioning.and_then(|section| section.node_id()).and_then(Field::known);
    Ok((layout, node_id.and_then(|node_id| NodeId::new(node_id).ok())))
}

/// A bus, and the hub where this process has started one for it.
type Connected = (Box<dyn Bus>, Option<Hub>);

fn connect(arguments: &RunArguments, log: &mut Log, streams: &mut Streams) -> Result<Connected, String> {
    if arguments.bus != Address::Hub {
        let bus = open(&arguments.bus).map_err(|error| error.to_string())?;
        return Ok((bus, None));
    }
    let hub = Hub::start(&hub_options(arguments.listen)).map_err(|error| error.to_string())?;
    let addresses = [("socketcand", hub.socketcand_address()), ("slcan", hub.slcan_address())];
    for (protocol, address) in addresses {
        if let Some(address) = address {
            log.listening(streams, protocol, address).map_err(|error| error.to_string())?;
        }
    }
    Ok((Box::new(hub.attach()), Some(hub)))
}

/// The hub's ports: the given one for socketcand and the next one for SLCAN; port 0 takes free ones.
fn hub_options(listen: Option<SocketAddr>) -> HubOptions {
    let Some(listen) = listen else { return HubOptions::default() };
    let next = if listen.port() == 0 { 0 } else { listen.port().saturating_add(1) };
    HubOptions { socketcand: Some(listen), slcan: Some(SocketAddr::new(listen.ip(), next)) }
}
