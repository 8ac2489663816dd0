//! How much working memory a node needs to run a dictionary.

use edskit_runtime::{Entry, Flags};
use edskit_types::{DataType, Index, SubIndex};

/// The sub-index of the COB-ID in a communication parameter: the PDO exists where it does.
const COB_ID: SubIndex = SubIndex(1);
/// The most entries that a mapping can have.
const MOST_MAPPED: u8 = 64;
/// A server's buffer has at least so many bytes, so that no number changes while it is read.
const SMALLEST_BUFFER: u16 = 8;

/// The sizes of a [`Memory`](edskit_runtime::Memory) besides that of the values.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Counts {
    /// RPDOs.
    pub rpdos: usize,
    /// TPDOs.
    pub tpdos: usize,
    /// Entries of the mapping parameters of all PDOs.
    pub mapped: usize,
    /// SDO servers, the default one included.
    pub servers: usize,
    /// Heartbeat consumers: the sub-indices of 1016h.
    pub consumers: usize,
    /// Bytes of all SDO servers together for values on their way.
    pub buffers: usize,
}

impl Counts {
    /// What a dictionary of these entries, which are sorted, needs.
    pub(super) fn of(entries: &[Entry]) -> Self {
        let has = |index: Index, sub_index: SubIndex| {
            entries.binary_search_by_key(&(index, sub_index), |entry| (entry.index, entry.sub_index)).is_ok()
        };
        let pdos = |is_communication: fn(Index) -> bool| {
            entries.iter().filter(|entry| is_communication(entry.index) && entry.sub_index == COB_ID).count()
        };
        let is_mapped = |entry: &&Entry| {
            let is_mapping = entry.index.is_rpdo_mapping() || entry.index.is_tpdo_mapping();
            is_mapping
                && (1..=MOST_MAPPED).contains(&entry.sub_index.0)
                && has(Index(entry.index.0 - 0x200), COB_ID)
        };
        let others =
            entries.chunk_by(|a, b| a.index == b.index).filter(|object| is_other_server(object[0].index));
        let servers = 1 + others.count();
        let consumer = |entry: &&Entry| entry.index == Index::CONSUMER_HEARTBEAT;
        let consumers = entries.iter().filter(consumer).map(|entry| entry.sub_index.0.into()).max();
        let is_buffered =
            |entry: &&Entry| entry.flags.has(Flags::WRITE) && entry.data_type != DataType::Domain;
        let longest = entries.iter().filter(is_buffered).map(|entry| entry.size).max().unwrap_or(0);
        let buffer = longest.max(SMALLEST_BUFFER);
        Self {
            rpdos: pdos(Index::is_rpdo_communication),
            tpdos: pdos(Index::is_tpdo_communication),
            mapped: entries.iter().filter(is_mapped).count(),
            servers,
            consumers: consumers.unwrap_or(0),
            buffers: servers * usize::from(buffer),
        }
    }
}

/// Whether an SDO server besides the default one is described at this index.
fn is_other_server(index: Index) -> bool {
    (0x1201..=0x127F).contains(&index.0)
}
