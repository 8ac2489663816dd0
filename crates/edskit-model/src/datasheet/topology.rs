//! The networks of a nodelist.cpj (CiA 306-3 v1.2, 6.2).

use super::{Datasheet, Entry, Field, Section};
use crate::key::KeyName;
use crate::section::SectionKind;
use core::ops::Deref;
use std::collections::BTreeMap;

/// One network: a section `[Topology]`, `[Topology2]` and so on.
#[derive(Clone, Copy, Debug)]
pub struct Topology<'a> {
    number: u16,
    section: Section<'a>,
}

/// One node of a network.
#[derive(Clone, Copy, Debug)]
pub struct TopologyNode<'a> {
    /// The node-ID that stands in its keys, 1..127 in a correct file.
    pub node_id: u16,
    /// `NodeXPresent`: 1 for present, 0 for not present, other values are reserved.
    pub present: Option<Field<'a, u8>>,
    /// `NodeXName`
    pub name: Option<Entry<'a>>,
    /// `NodeXRefd`
    pub refd: Option<Entry<'a>>,
    /// `NodeXDCFName`: the DCF, relative to EDSBaseName.
    pub dcf_name: Option<Entry<'a>>,
}

impl Datasheet {
    /// The networks in ascending order.
    pub fn topologies(&self) -> impl Iterator<Item = Topology<'_>> {
        self.other_sections().filter_map(|section| match section.kind() {
            SectionKind::Topology(number) => Some(Topology { number, section }),
            _ => None,
        })
    }
}

impl<'a> Topology<'a> {
    /// The number of the network, from 1.
    pub fn number(self) -> u16 {
        self.number
    }

    /// `NetName`
    pub fn net_name(self) -> Option<Entry<'a>> {
        self.filled(KeyName::NetName)
    }

    /// `Nodes`: how many nodes the network has.
    pub fn node_count(self) -> Option<Field<'a, u8>> {
        self.filled(KeyName::Nodes).map(Entry::unsigned)
    }

    /// `EDSBaseName`: the folder of the files.
    pub fn eds_base_name(self) -> Option<Entry<'a>> {
        self.filled(KeyName::EdsBaseName)
    }

    /// The nodes that any key names, in ascending order.
    pub fn nodes(self) -> Vec<TopologyNode<'a>> {
        let mut nodes: BTreeMap<u16, [Option<Entry<'a>>; 4]> = BTreeMap::new();
        for entry in self.entries() {
            let key = entry.key();
            let place = match key.name {
                KeyName::NodePresent => 0,
                KeyName::NodeItemName => 1,
                KeyName::NodeItemRefd => 2,
                KeyName::NodeDcfName => 3,
                _ => continue,
            };
            nodes.entry(key.number).or_default()[place].get_or_insert(entry);
        }
        let node = |(node_id, entries): (u16, [Option<Entry<'a>>; 4])| {
            let [present, name, refd, dcf_name] =
                entries.map(|entry| entry.filter(|entry| !entry.is_empty()));
            TopologyNode { node_id, present: present.map(Entry::unsigned), name, refd, dcf_name }
        };
        nodes.into_iter().map(node).collect()
    }
}

impl<'a> Deref for Topology<'a> {
    type Target = Section<'a>;

    fn deref(&self) -> &Section<'a> {
        &self.section
    }
}
