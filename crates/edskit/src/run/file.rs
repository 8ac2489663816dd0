//! Any EDS or DCF as a live node.

mod log;
mod refused;

use super::{Connected, connect};
use crate::cli::RunArguments;
use crate::device_file::{DeviceFile, print_problems};
use crate::live::{Log, PATIENCE, Stop, TraceFile};
use crate::{Exit, Streams};
use edskit_codegen::{Layout, LoadedDictionary, Naming, Problem, SideFile, lay_out};
use edskit_host::{Bus, MemoryDevice, MemoryStorage, Station};
use edskit_lint::{FileKind, Severity};
use edskit_model::{Datasheet, Document};
use edskit_runtime::{Node, NodeDevice, Settings};
use edskit_types::{Bitrate, NodeId};
use std::io;
use std::path::Path;

/// How many warnings are printed: the node is what was asked for.
const MOST_WARNINGS: usize = 20;

pub(crate) fn run(arguments: &RunArguments, streams: &mut Streams) -> io::Result<Exit> {
    let Loaded { layout, commissioned, bit_rate, naming } = match load(&arguments.file) {
        Ok(loaded) => loaded,
        Err(reasons) => {
            for reason in reasons {
                streams.complain(format_args!("{reason}"));
            }
            return Ok(Exit::Failed);
        }
    };
    let node_id = arguments.node_id.or(commissioned).unwrap_or(NodeId::MIN);
    let settings = Settings { node_id: Some(node_id), ..layout.settings };
    let mut warnings = warnings_of(&layout, node_id);
    // A COB-ID that cannot be used is named already, in words of its own.
    let named: Vec<_> =
        layout.cob_id_problems(Some(node_id)).into_iter().map(|problem| problem.span).collect();
    let refused = refused::problems(&layout, settings);
    warnings.extend(refused.into_iter().filter(|problem| !named.contains(&problem.span)));
    let (shown, others) = warnings.split_at(warnings.len().min(MOST_WARNINGS));
    print_problems(shown, &naming, streams)?;
    if !others.is_empty() {
        writeln!(streams.stderr, "and {} warnings more", others.len())?;
    }
    let log = Log::new(arguments.log.unwrap_or_default());
    let record = arguments.trace.as_deref().map(TraceFile::create).transpose().map_err(io::Error::other)?;
    let bit_rate = arguments.bit_rate.or(bit_rate).unwrap_or(Bitrate::Kbit1000);
    let Connected { bus, reachable, _hub } =
        connect(arguments, bit_rate, record).map_err(io::Error::other)?;
    log.reachable(streams, &reachable)?;
    let stop = Stop::on_request().map_err(io::Error::other)?;
    log::node(&log, streams, node_id, layout.product.as_deref())?;
    let node = Node::new(LoadedDictionary::new(&layout), settings, MemoryStorage::default());
    let mut station = Station::new(NodeDevice { node, application: MemoryDevice::default() }, bus);
    while !stop.is_asked() {
        let deadline = station.round().map_err(io::Error::other)?;
        while let Some(event) = station.bus.event() {
            log.bus(streams, &event)?;
        }
        for event in station.device.application.take_events() {
            log::device(&log, streams, &event)?;
        }
        let patience = station.bus.now() + PATIENCE;
        station.bus.wait(deadline.min(patience)).map_err(io::Error::other)?;
    }
    Ok(Exit::Clean)
}

/// What a file gives to run.
struct Loaded {
    layout: Layout,
    /// The node-ID that a DCF commissions.
    commissioned: Option<NodeId>,
    /// The bit rate that a DCF commissions.
    bit_rate: Option<Bitrate>,
    naming: Naming,
}

/// What was assumed, which services are not in use, and what else the node does without, although the file describes it.
fn warnings_of(layout: &Layout, node_id: NodeId) -> Vec<Problem> {
    let mappings = layout.mapping_problems();
    let without = mappings.into_iter().map(|problem| Problem { severity: Severity::Warning, ..problem });
    let cob_ids = layout.cob_id_problems(Some(node_id));
    let said = layout.lost.iter().chain(&layout.notes).cloned();
    layout.assumptions.iter().cloned().chain(cob_ids).chain(said).chain(without).collect()
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
    let commissioned = if is_dcf { sheet.commissioned_node_id() } else { None };
    let bit_rate = if is_dcf { sheet.commissioned_bitrate() } else { None };
    Ok(Loaded { layout, commissioned, bit_rate, naming })
}
