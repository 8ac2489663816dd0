//! A dictionary for tests, made entry by entry.

use crate::{
    Dictionary, Entry, Flags, HeartbeatConsumer, Limits, Mapped, Objects, Parts, Position, Rpdo, SdoServer,
    StorageGroup, Table, Tpdo,
};
use edskit_types::{DataType, Index, SubIndex};
use std::boxed::Box;
use std::vec;
use std::vec::Vec;

pub(super) const RO: Flags = Flags::READ.and(Flags::VARIABLE);
pub(super) const WO: Flags = Flags::WRITE.and(Flags::VARIABLE);
pub(super) const RW: Flags = Flags::READ.and(Flags::WRITE).and(Flags::VARIABLE);
/// A COB-ID that follows the node-ID.
pub(super) const COB_ID: Flags = RW.and(Flags::NODE_RELATIVE);

/// One entry before it has its place.
struct Draft {
    entry: Entry,
    value: Vec<u8>,
    limits: Option<(u64, u64)>,
}

/// A dictionary to be.
pub(super) struct Builder(Vec<Draft>);

impl Builder {
    pub(super) fn add(
        mut self,
        index: u16,
        sub_index: u8,
        data_type: DataType,
        flags: Flags,
        value: impl AsRef<[u8]>,
    ) -> Self {
        let entry = Entry {
            index: Index(index),
            sub_index: SubIndex(sub_index),
            data_type,
            flags,
            offset: 0,
            size: 0,
        };
        self.0.push(Draft { entry, value: value.as_ref().to_vec(), limits: None });
        self
    }

    pub(super) fn u8(self, index: u16, sub_index: u8, flags: Flags, value: u8) -> Self {
        self.add(index, sub_index, DataType::Unsigned8, flags, [value])
    }

    pub(super) fn u16(self, index: u16, sub_index: u8, flags: Flags, value: u16) -> Self {
        self.add(index, sub_index, DataType::Unsigned16, flags, value.to_le_bytes())
    }

    pub(super) fn u32(self, index: u16, sub_index: u8, flags: Flags, value: u32) -> Self {
        self.add(index, sub_index, DataType::Unsigned32, flags, value.to_le_bytes())
    }

    /// Limits of the entry that was added last.
    pub(super) fn limited(mut self, low: i64, high: i64) -> Self {
        let draft = self.0.last_mut().unwrap();
        draft.limits = Some((low as u64, high as u64));
        draft.entry.flags = draft.entry.flags.and(Flags::LIMITED);
        self
    }

    /// A PDO with eight places in its mapping, of which the given ones count.
    pub(super) fn pdo(mut self, communication: u16, cob_id: u32, transmission: u8, mapping: &[u32]) -> Self {
        let parameter = communication + 0x200;
        self = self
            .u8(communication, 0, Flags::READ, 6)
            .u32(communication, 1, COB_ID, cob_id)
            .u8(communication, 2, RW, transmission)
            .u16(communication, 3, RW, 0)
            .u16(communication, 5, RW, 0)
            .u8(communication, 6, RW, 0)
            .u8(parameter, 0, RW, mapping.len() as u8);
        for place in 0..8 {
            let entry = mapping.get(place).copied().unwrap_or_default();
            self = self.u32(parameter, place as u8 + 1, RW, entry);
        }
        self
    }

    /// Another value for an entry that is there.
    pub(super) fn with(mut self, index: u16, sub_index: u8, value: &[u8]) -> Self {
        let draft = self.draft(index, sub_index);
        draft.value = value[..draft.value.len()].to_vec();
        draft.entry.flags = RW;
        self
    }

    /// Other rights for an entry that is there.
    pub(super) fn rights(mut self, index: u16, sub_index: u8, flags: Flags) -> Self {
        self.draft(index, sub_index).entry.flags = flags;
        self
    }

    fn draft(&mut self, index: u16, sub_index: u8) -> &mut Draft {
        let is_it = |draft: &&mut Draft| (draft.entry.index.0, draft.entry.sub_index.0) == (index, sub_index);
        self.0.iter_mut().find(is_it).unwrap()
    }

    pub(super) fn build(mut self) -> Device {
        self.0.sort_by_key(|draft| (draft.entry.index, draft.entry.sub_index));
        let (mut constants, mut defaults, mut limits) = (Vec::new(), Vec::new(), Vec::new());
        let mut entries = Vec::new();
        for (position, mut draft) in self.0.into_iter().enumerate() {
            let is_text = draft.entry.data_type.is_string();
            let is_variable = draft.entry.flags.has(Flags::VARIABLE);
            let image = if is_variable { &mut defaults } else { &mut constants };
            draft.entry.offset = image.len() as u16;
            if is_text && is_variable {
                image.extend((draft.value.len() as u16).to_le_bytes());
                draft.value.resize(draft.value.len().max(200), 0);
            }
            draft.entry.size = draft.value.len() as u16;
            image.extend(draft.value);
            if let Some((low, high)) = draft.limits {
                limits.push(Limits { position: Position(position as u16), low, high });
            }
            entries.push(draft.entry);
        }
        let values = defaults.clone();
        let numbers = |entry: &Entry| {
            let group = entry.flags.group().map_or(0, |group| u32::from(group.0));
            [u32::from(entry.index.0), entry.sub_index.0.into(), entry.size.into(), group]
        };
        let fingerprint =
            entries.iter().flat_map(numbers).fold(1, |hash: u32, number| hash.wrapping_mul(31) ^ number);
        let table = Table {
            entries: Box::leak(entries.into_boxed_slice()),
            constants: Box::leak(constants.into_boxed_slice()),
            defaults: Box::leak(defaults.into_boxed_slice()),
            limits: Box::leak(limits.into_boxed_slice()),
            dummies: 0b1111_1100,
            fingerprint,
        };
        Device {
            table,
            values,
            // Room for any device of these tests.
            rpdos: vec![Rpdo::NEW; 4],
            tpdos: vec![Tpdo::NEW; 100],
            mapped: vec![Mapped::NEW; 1000],
            servers: vec![SdoServer::NEW; 2],
            consumers: vec![HeartbeatConsumer::NEW; 40],
            buffers: vec![0; 2 * 200],
        }
    }
}

pub(super) struct Device {
    table: Table<'static>,
    values: Vec<u8>,
    rpdos: Vec<Rpdo>,
    tpdos: Vec<Tpdo>,
    mapped: Vec<Mapped>,
    servers: Vec<SdoServer>,
    consumers: Vec<HeartbeatConsumer>,
    buffers: Vec<u8>,
}

impl Dictionary for Device {
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

/// What every device has.
pub(super) fn plain() -> Builder {
    Builder(Vec::new())
        .u32(0x1000, 0, Flags::READ, 0x0001_0191)
        .u8(0x1001, 0, RO.and(Flags::TPDO), 0)
        .add(0x1008, 0, DataType::VisibleString, Flags::READ, "A device of many words")
        .u16(0x1017, 0, RW.stored_in(StorageGroup::COMMUNICATION), 0)
        .u8(0x1018, 0, Flags::READ, 4)
        .u32(0x1018, 1, Flags::READ, 0x360)
        .u32(0x1018, 2, Flags::READ, 0x11)
        .u32(0x1018, 3, Flags::READ, 0x0001_0002)
        .u32(0x1018, 4, RO, 0x99)
}

/// A device with values of several types at 2000h and above.
pub(super) fn with_values() -> Builder {
    let both = RW.and(Flags::TPDO).and(Flags::RPDO);
    plain()
        .u16(0x2000, 0, both.stored_in(StorageGroup::MANUFACTURER), 0x1234)
        .add(0x2001, 0, DataType::Integer8, both, [7])
        .limited(-10, 10)
        .u32(0x2002, 0, both, 0)
        .add(0x2003, 0, DataType::VisibleString, RW, "a text that can change")
        .u16(0x2004, 0, WO.and(Flags::RPDO), 0)
        .u16(0x2005, 0, RO.and(Flags::TPDO), 0x55AA)
        .add(0x2006, 0, DataType::Domain, Flags::READ.and(Flags::WRITE), "")
        .add(0x2007, 0, DataType::Integer24, RW, [1, 2, 3])
        .add(0x2008, 0, DataType::Boolean, both, [0])
        .add(0x2009, 0, DataType::Unsigned64, RW, [1, 2, 3, 4, 5, 6, 7, 8])
        .add(0x200A, 0, DataType::Unsigned64, RO.and(Flags::TPDO), [9; 8])
}
