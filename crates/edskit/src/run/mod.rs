//! `edskit run`: any EDS or DCF as a live node.

mod log;

use crate::cli::RunArguments;
use crate::device_file::{DeviceFile, print_problems};
use crate::live::{Log, PATIENCE, Stop, start_hub};
use crate::{Exit, Streams};
use edskit_codegen::{Layout, LoadedDictionary, Naming, Problem, SideFile, lay_out};
use edskit_host::{Address, Bus, BusError, Hub, MemoryDevice, MemoryStorage, Station, open};
use edskit_lint::{FileKind, Severity};
use edskit_model::{Datasheet, Document, Field};
use edskit_runtime::{Node, NodeDevice, Settings};
use edskit_types::NodeId;
use std::io;
use std::path::Path;

/// How many warnings are printed: the node is what was asked for.
const MOST_WARNINGS: usize = 20;

pub(crate) fn run(arguments: &RunArguments, streams: &mut Streams) -> io::Result<Exit> {
    let Loaded { layout, commissioned, naming } = match load(&arguments.file) {
        Ok(loaded) => loaded,
        Err(reasons) => {
            for reason in reasons {
                streams.complain(format_args!("{reason}"));
            }
            return Ok(Exit::Failed);
        }
    };
    let warnings = warnings_of(&layout);
    let (shown, others) = warnings.split_at(warnings.len().min(MOST_WARNINGS));
    print_problems(shown, &naming, streams)?;
    if !others.is_empty() {
        writeln!(streams.stderr, "and {} warnings more", others.len())?;
    }
    let node_id = arguments.node_id.or(commissioned).unwrap_or(NodeId::MIN);
    let log = Log::new(arguments.log);
    // The hub lives as long as the node.
    let (bus, _hub) = match connect(arguments, &log, streams) {
        Ok(connected) => connected,
        Err(reason) => {
            streams.complain(format_args!("{reason}"));
            return Ok(Exit::Failed);
        }
    };
    let stop = match Stop::on_ctrl_c() {
        Ok(stop) => stop,
        Err(reason) => {
            streams.complain(format_args!("{reason}"));
            return Ok(Exit::Failed);
        }
    };
    log::node(&log, streams, node_id, layout.product.as_deref())?;
    let settings = Settings { node_id: Some(node_id), ..Settings::default() };
    let node = Node::new(LoadedDictionary::new(&layout), settings, MemoryStorage::default());
    let mut station = Station::new(NodeDevice { node, application: MemoryDevice::default() }, bus);
    while !stop.is_asked() {
        let deadline = match station.round() {
            Ok(deadline) => deadline,
            Err(error) => return lost(&error, streams),
        };
        while let Some(event) = station.bus.event() {
            log.bus(streams, &event)?;
        }
        for event in station.device.application.take_events() {
            log::device(&log, streams, &event)?;
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

/// What a file gives to run.
struct Loaded {
    layout: Layout,
    /// The node-ID that a DCF commissions.
    commissioned: Option<NodeId>,
    naming: Naming,
}

/// What the node does without, although the file describes it.
fn warnings_of(layout: &Layout) -> Vec<Problem> {
    let mappings = layout.mapping_problems();
    let without = mappings.into_iter().map(|problem| Problem { severity: Severity::Warning, ..problem });
    layout.notes.iter().cloned().chain(without).collect()
}

/// Reads a file with its side-file and lays its dictionary out.
fn load(path: &Path) -> Result<Loaded, Vec<String>> {
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
    let commissioned = node_id.and_then(|node_id| NodeId::new(node_id).ok());
    Ok(Loaded { layout, commissioned, naming })
}

/// A bus, and the hub where this process has started one for it.
type Connected = (Box<dyn Bus>, Option<Hub>);

fn connect(arguments: &RunArguments, log: &Log, streams: &mut Streams) -> Result<Connected, String> {
    if arguments.bus != Address::Hub {
        let bus = open(&arguments.bus).map_err(|error| error.to_string())?;
        return Ok((bus, None));
    }
    let hub = start_hub(arguments.listen, log, streams)?;
    Ok((Box::new(hub.attach()), Some(hub)))
}
