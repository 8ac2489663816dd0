//! A dictionary that is laid out at run time.

use crate::Layout;
use edskit_runtime::{Dictionary, HeartbeatConsumer, Mapped, Objects, Parts, Rpdo, SdoServer, Table, Tpdo};

/// The dictionary of a file that is read at run time, with the working memory of its node: what a generated one is to a
/// file that is known when the device is compiled. Nodes over both give the same answers.
///
/// ```
/// use edskit_codegen::{LoadedDictionary, parse};
/// use edskit_runtime::{NoStorage, Node, Settings};
///
/// let text = b"[1000]\nParameterName=Device type\nDataType=7\nAccessType=ro\nDefaultValue=0x191\n";
/// let layout = parse(text, None).unwrap();
/// let node = Node::new(LoadedDictionary::new(&layout), Settings::default(), NoStorage);
/// ```
#[derive(Clone, Debug)]
pub struct LoadedDictionary<'a> {
    table: Table<'a>,
    values: Vec<u8>,
    rpdos: Vec<Rpdo>,
    tpdos: Vec<Tpdo>,
    mapped: Vec<Mapped>,
    servers: Vec<SdoServer>,
    consumers: Vec<HeartbeatConsumer>,
    buffers: Vec<u8>,
}

impl<'a> LoadedDictionary<'a> {
    /// The dictionary of a layout.
    #[must_use]
    pub fn new(layout: &'a Layout) -> Self {
        let counts = layout.counts;
        Self {
            table: layout.table(),
            values: layout.defaults.clone(),
            rpdos: vec![Rpdo::NEW; counts.rpdos],
            tpdos: vec![Tpdo::NEW; counts.tpdos],
            mapped: vec![Mapped::NEW; counts.mapped],
            servers: vec![SdoServer::NEW; counts.servers],
            consumers: vec![HeartbeatConsumer::NEW; counts.consumers],
            buffers: vec![0; counts.buffers],
        }
    }
}

impl Dictionary for LoadedDictionary<'_> {
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
