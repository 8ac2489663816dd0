//! `edskit run`: any EDS or DCF as a live node.

mod device;
mod dictionary;
mod log;
mod memory;

use crate::cli::RunArguments;
use crate::device_file::DeviceFile;
use crate::{Exit, Streams};
use device::LoadedDevice;
use dictionary::LoadedDictionary;
use edskit_codegen::{Layout, Problem, SideFile, lay_out};
use edskit_host::{Address, Bus, BusError, Hub, HubOptions, SendError, open};
use edskit_lint::FileKind;
use edskit_model::{Datasheet, Document, Field};
use edskit_runtime::{Frame, Node, Settings};
use edskit_types::NodeId;
use log::Log;
use memory::VolatileStorage;
use std::io;
use std::net::SocketAddr;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// How often the loop looks whether it has been asked to end, in microseconds.
const PATIENCE: u64 = 200_000;

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
    let (mut bus, _hub) = match connect(arguments, &mut log, streams) {
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
    let node = Node::new(LoadedDictionary::new(layout), settings, VolatileStorage::default());
    serve(node, &mut *bus, &mut log, &stop, streams)
}

/// Reads a file with its side-file and lays its dictionary out; with the node-ID that a DCF commissions.
fn load(path: &Path) -> Result<(Layout, Option<NodeId>), Vec<String>> {
    let DeviceFile { eds, side_file, naming } =
        DeviceFile::read(path, None).map_err(|reason| vec![reason])?;
    let name = &naming.eds;
    let line = |problem: &Problem| problem.line(name, &naming.side_file).to_string();
    let side_file = side_file.as_deref().map_or(Ok(SideFile::default()), SideFile::parse);
    let side_file = side_file.map_err(|problem| vec![line(&problem)])?;
    let sheet = Datasheet::new(Document::from_vec(eds));
    let layout =
        lay_out(&sheet, &side_file).map_err(|problems| problems.iter().map(line).collect::<Vec<_>>())?;
    if layout.entries.is_empty() {
        return Err(vec![format!("{name}: the file describes no object, so there is nothing to run")]);
    }
    let is_dcf = FileKind::of(name) == FileKind::Dcf;
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

fn serve(
    mut node: Node<LoadedDictionary, VolatileStorage>,
    bus: &mut dyn Bus,
    log: &mut Log,
    stop: &AtomicBool,
    streams: &mut Streams,
) -> io::Result<Exit> {
    let mut device = LoadedDevice::default();
    // A frame that the bus has not taken yet.
    let mut waiting: Option<Frame> = None;
    while !stop.load(Ordering::Relaxed) {
        match step(&mut node, &mut device, bus, &mut waiting) {
            Ok(()) => {}
            Err(error) => {
                streams.complain(format_args!("{error}"));
                return Ok(Exit::Failed);
            }
        }
        while let Some(event) = bus.event() {
            log.bus(streams, &event)?;
        }
        for event in device.take_events() {
            log.device(streams, &event)?;
        }
    }
    Ok(Exit::Clean)
}

/// One round: takes what has arrived, sends what is due, and waits for more.
fn step(
    node: &mut Node<LoadedDictionary, VolatileStorage>,
    device: &mut LoadedDevice,
    bus: &mut dyn Bus,
    waiting: &mut Option<Frame>,
) -> Result<(), BusError> {
    while let Some(received) = bus.receive()? {
        node.receive(bus.now(), &received.frame, device);
        send_all(node, bus, waiting);
    }
    node.poll(bus.now(), device);
    send_all(node, bus, waiting);
    let now = bus.now();
    let patience = edskit_runtime::Microseconds(PATIENCE);
    bus.wait(node.next_deadline(now).min(now + patience))
}

fn send_all(
    node: &mut Node<LoadedDictionary, VolatileStorage>,
    bus: &mut dyn Bus,
    waiting: &mut Option<Frame>,
) {
    while let Some(frame) = waiting.take().or_else(|| node.transmit()) {
        match bus.send(&frame) {
            Ok(()) => {}
            Err(SendError::Full) => {
                *waiting = Some(frame);
                return;
            }
            // Nobody can be told over a bus that is away; the frame is gone as on a real one.
            Err(_) => {}
        }
    }
}
