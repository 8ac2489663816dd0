//! A device without a process behind it: it keeps what it is told.

use edskit_runtime::{Application, Emergency, Entry, Services};
use edskit_types::{AbortCode, Bitrate, Index, NmtState, SubIndex};
use std::collections::{BTreeMap, BTreeSet};

/// The most bytes of a DOMAIN that are kept.
const MOST_BYTES: usize = 1 << 20;

/// Something that a person who watches the device wants to hear of.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum DeviceEvent {
    /// The node is in another NMT state.
    State(NmtState),
    /// The node has sent an EMCY message.
    Emergency(Emergency),
    /// A value of this RPDO, numbered from 1, was refused: told once for each entry while the node is in operational.
    ValueRefused {
        /// The number of the RPDO.
        rpdo: u16,
        /// The entry that it was for.
        index: Index,
        /// Its sub-index.
        sub_index: SubIndex,
        /// Why, as an SDO client would be told.
        code: AbortCode,
    },
    /// LSS wants this bit rate; a bus without a bit rate has no use for it.
    BitRate(Bitrate),
}

/// A device without a process: what is written into a DOMAIN can be read again, up to 1 MiB each. As nothing else changes a
/// value, a change by a client or an RPDO is an event of the TPDOs that carry it.
#[derive(Clone, Default, Debug)]
pub struct MemoryDevice {
    domains: BTreeMap<(Index, SubIndex), Vec<u8>>,
    /// What is on its way: the old content stays until the new one is complete.
    coming: BTreeMap<(Index, SubIndex), Vec<u8>>,
    events: Vec<DeviceEvent>,
    /// Which refused values were told.
    refused: BTreeSet<(u16, Index, SubIndex)>,
}

impl MemoryDevice {
    /// What has happened since the last call.
    #[must_use]
    pub fn take_events(&mut self) -> Vec<DeviceEvent> {
        std::mem::take(&mut self.events)
    }
}

impl Application for MemoryDevice {
    fn state_changed(&mut self, _: &mut Services<'_>, _: NmtState, to: NmtState) {
        self.events.push(DeviceEvent::State(to));
        self.refused.clear();
    }

    fn emergency(&mut self, _: &mut Services<'_>, emergency: &mut Emergency) {
        self.events.push(DeviceEvent::Emergency(*emergency));
    }

    fn domain_length(&mut self, _: &mut Services<'_>, entry: &Entry) -> Result<Option<u32>, AbortCode> {
        let length = self.domains.get(&(entry.index, entry.sub_index)).map_or(0, Vec::len);
        Ok(Some(length as u32))
    }

    fn read_domain(
        &mut self,
        _: &mut Services<'_>,
        entry: &Entry,
        offset: u32,
        buffer: &mut [u8],
    ) -> Result<usize, AbortCode> {
        let domain = self.domains.get(&(entry.index, entry.sub_index));
        let rest = domain.and_then(|bytes| bytes.get(offset as usize..)).unwrap_or_default();
        let count = rest.len().min(buffer.len());
        buffer[..count].copy_from_slice(&rest[..count]);
        Ok(count)
    }

    fn write_domain(
        &mut self,
        _: &mut Services<'_>,
        entry: &Entry,
        offset: u32,
        data: &[u8],
        is_last: bool,
    ) -> Result<(), AbortCode> {
        let place = (entry.index, entry.sub_index);
        let coming = self.coming.entry(place).or_default();
        if offset == 0 {
            coming.clear();
        }
        // Another client has begun meanwhile.
        if coming.len() != offset as usize {
            return Err(AbortCode::DEVICE_STATE);
        }
        if coming.len() + data.len() > MOST_BYTES {
            return Err(AbortCode::OUT_OF_MEMORY);
        }
        coming.extend_from_slice(data);
        if is_last {
            let complete = self.coming.remove(&place).unwrap_or_default();
            self.domains.insert(place, complete);
        }
        Ok(())
    }

    fn domain_broken_off(&mut self, _: &mut Services<'_>, entry: &Entry, offset: u32) {
        let place = (entry.index, entry.sub_index);
        if self.coming.get(&place).is_some_and(|coming| coming.len() == offset as usize) {
            self.coming.remove(&place);
        }
    }

    fn write_is_event(&mut self, _: &Services<'_>, _: &Entry) -> bool {
        true
    }

    fn rpdo_value_refused(&mut self, _: &mut Services<'_>, rpdo: u16, entry: &Entry, code: AbortCode) {
        let Entry { index, sub_index, .. } = *entry;
        if self.refused.insert((rpdo, index, sub_index)) {
            self.events.push(DeviceEvent::ValueRefused { rpdo, index, sub_index, code });
        }
    }

    fn activate_bit_rate(&mut self, bit_rate: Bitrate, _: u16) {
        self.events.push(DeviceEvent::BitRate(bit_rate));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use edskit_runtime::{Dictionary, Flags, Instant, Memory, NoStorage, Node, Parts, Settings, Table};
    use edskit_types::DataType;

    /// A dictionary without any entry.
    struct Empty(Memory<0, 0, 0, 0, 0, 0, 0>);

    impl Dictionary for Empty {
        fn parts(&mut self) -> Parts<'_> {
            const TABLE: Table<'_> = Table {
                entries: &[],
                constants: &[],
                defaults: &[],
                limits: &[],
                dummies: 0,
                fingerprint: 0,
            };
            self.0.parts(&TABLE)
        }
    }

    #[test]
    fn the_old_content_stays_until_the_new_one_is_complete() {
        let entry = Entry {
            index: Index(0x2000),
            sub_index: SubIndex(0),
            data_type: DataType::Domain,
            flags: Flags::READ.and(Flags::WRITE),
            offset: 0,
            size: 0,
        };
        let mut node = Node::new(Empty(Memory::new([])), Settings::DEFAULT, NoStorage);
        let mut node = node.services(Instant(0));
        let mut device = MemoryDevice::default();
        let content = |device: &mut MemoryDevice, node: &mut Services<'_>| {
            let mut buffer = [0; 20];
            let count = device.read_domain(node, &entry, 0, &mut buffer).unwrap();
            buffer[..count].to_vec()
        };
        device.write_domain(&mut node, &entry, 0, b"old", false).unwrap();
        assert_eq!(content(&mut device, &mut node), b"", "it is not complete");
        device.write_domain(&mut node, &entry, 3, b"", true).unwrap();
        assert_eq!(content(&mut device, &mut node), b"old");
        device.write_domain(&mut node, &entry, 0, b"newer", false).unwrap();
        device.domain_broken_off(&mut node, &entry, 5);
        assert_eq!(content(&mut device, &mut node), b"old");
        // Two clients: the second one begins, so the first one cannot go on, and its end does not harm the second one.
        device.write_domain(&mut node, &entry, 0, b"first", false).unwrap();
        device.write_domain(&mut node, &entry, 0, b"no", false).unwrap();
        let refused = device.write_domain(&mut node, &entry, 5, b"..", false);
        assert_eq!(refused, Err(AbortCode::DEVICE_STATE));
        device.domain_broken_off(&mut node, &entry, 5);
        device.write_domain(&mut node, &entry, 2, b"w", true).unwrap();
        assert_eq!(content(&mut device, &mut node), b"now");
    }
}
