//! A dictionary that is laid out at run time.

use edskit_codegen::Layout;
use edskit_runtime::{
    Dictionary, Entry, HeartbeatConsumer, Limits, Mapped, Objects, Parts, Rpdo, SdoServer, Table, Tpdo,
};

/// The dictionary of a file, with the working memory of its node.
pub(super) struct LoadedDictionary {
    table: Table<'static>,
    values: Vec<u8>,
    rpdos: Vec<Rpdo>,
    tpdos: Vec<Tpdo>,
    mapped: Vec<Mapped>,
    servers: Vec<SdoServer>,
    consumers: Vec<HeartbeatConsumer>,
    buffers: Vec<u8>,
}

impl LoadedDictionary {
    /// The dictionary of a layout. A process runs one, so its fixed part is never given back.
    pub(super) fn new(layout: Layout) -> Self {
        let counts = layout.counts;
        let values = layout.defaults.clone();
        let entries: &'static [Entry] = layout.entries.leak();
        let limits: &'static [Limits] = layout.limits.leak();
        let table = Table {
            entries,
            constants: layout.constants.leak(),
            defaults: layout.defaults.leak(),
            limits,
            dummies: layout.dummies,
            fingerprint: layout.fingerprint,
        };
        Self {
            table,
            values,
            rpdos: vec![Rpdo::NEW; counts.rpdos],
            tpdos: vec![Tpdo::NEW; counts.tpdos],
            mapped: vec![Mapped::NEW; counts.mapped],
            servers: vec![SdoServer::NEW; counts.servers],
            consumers: vec![HeartbeatConsumer::NEW; counts.consumers],
            buffers: vec![0; counts.buffers],
        }
    }
}

impl Dictionary for LoadedDictionary {
    fn parts(&mut self) -> Parts<'_> {
        Parts {
            objects: Objects::new(&self.table, &mut self.values),
            rpdos: &mut self.rpdos,
            tpdos: &mut self.tpdos,
            mapped: &mut self.mapped,
            servers: &mut self.servers,
            consumers: &mut self.consumers,
            buffers: &mut self.buffers,
        }
    }
}
