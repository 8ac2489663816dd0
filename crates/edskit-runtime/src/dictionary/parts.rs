//! A dictionary with the working memory of a node, sized for it.

use super::{Objects, Table};
use crate::heartbeat_consumer::HeartbeatConsumer;
use crate::pdo::{Mapped, Rpdo, Tpdo};
use crate::sdo::SdoServer;

/// An object dictionary with what a node needs to run it: a generated one, or one that is built at run time.
pub trait Dictionary {
    /// The dictionary and its working memory.
    fn parts(&mut self) -> Parts<'_>;
}

/// An object dictionary and the working memory that depends on its size.
#[derive(Debug)]
pub struct Parts<'a> {
    /// The dictionary.
    pub objects: Objects<'a>,
    /// A place for each RPDO of the dictionary.
    pub rpdos: &'a mut [Rpdo],
    /// A place for each TPDO of the dictionary.
    pub tpdos: &'a mut [Tpdo],
    /// A place for each entry of all mapping parameters.
    pub mapped: &'a mut [Mapped],
    /// A place for each SDO server: the default one and those from 1201h on.
    pub servers: &'a mut [SdoServer],
    /// A place for each entry of 1016h.
    pub consumers: &'a mut [HeartbeatConsumer],
    /// For each SDO server as many bytes as the longest value has that clients may write, DOMAIN aside, and
    /// at least eight.
    pub buffers: &'a mut [u8],
}

/// The changing part of a dictionary, of fixed size: what generated dictionaries consist of.
#[derive(Clone, Debug)]
pub struct Memory<
    const VALUES: usize,
    const RPDOS: usize,
    const TPDOS: usize,
    const MAPPED: usize,
    const SERVERS: usize,
    const CONSUMERS: usize,
    const BUFFERS: usize,
> {
    values: [u8; VALUES],
    rpdos: [Rpdo; RPDOS],
    tpdos: [Tpdo; TPDOS],
    mapped: [Mapped; MAPPED],
    servers: [SdoServer; SERVERS],
    consumers: [HeartbeatConsumer; CONSUMERS],
    buffers: [u8; BUFFERS],
}

impl<
    const VALUES: usize,
    const RPDOS: usize,
    const TPDOS: usize,
    const MAPPED: usize,
    const SERVERS: usize,
    const CONSUMERS: usize,
    const BUFFERS: usize,
> Memory<VALUES, RPDOS, TPDOS, MAPPED, SERVERS, CONSUMERS, BUFFERS>
{
    /// The values of power-on, before the node-ID is known.
    #[must_use]
    pub const fn new(defaults: [u8; VALUES]) -> Self {
        Self {
            values: defaults,
            rpdos: [Rpdo::NEW; RPDOS],
            tpdos: [Tpdo::NEW; TPDOS],
            mapped: [Mapped::NEW; MAPPED],
            servers: [SdoServer::NEW; SERVERS],
            consumers: [HeartbeatConsumer::NEW; CONSUMERS],
            buffers: [0; BUFFERS],
        }
    }

    /// Its parts, with the fixed part of the dictionary.
    pub fn parts<'a>(&'a mut self, table: &'a Table<'a>) -> Parts<'a> {
        Parts {
            objects: Objects::new(table, &mut self.values),
            rpdos: &mut self.rpdos,
            tpdos: &mut self.tpdos,
            mapped: &mut self.mapped,
            servers: &mut self.servers,
            consumers: &mut self.consumers,
            buffers: &mut self.buffers,
        }
    }
}
