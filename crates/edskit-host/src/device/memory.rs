//! A device without a process behind it: it keeps what it is told.

use edskit_runtime::{Application, Emergency, Entry, Objects};
use edskit_types::{AbortCode, Index, NmtState, SubIndex};
use std::collections::BTreeMap;

/// The most bytes of a DOMAIN that are kept.
const MOST_BYTES: usize = 1 << 20;

/// Something that a person who watches the device wants to hear of.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum DeviceEvent {
    /// The node is in another NMT state.
    State(NmtState),
    /// The node has sent an EMCY message.
    Emergency(Emergency),
}

/// A device without a process: what is written into a DOMAIN can be read again, up to 1 MiB each.
#[derive(Clone, Default, Debug)]
pub struct MemoryDevice {
    domains: BTreeMap<(Index, SubIndex), Vec<u8>>,
    events: Vec<DeviceEvent>,
}

impl MemoryDevice {
    /// What has happened since the last call.
    #[must_use]
    pub fn take_events(&mut self) -> Vec<DeviceEvent> {
        std::mem::take(&mut self.events)
    }
}

impl Application for MemoryDevice {
    fn state_changed(&mut self, _: &mut Objects<'_>, _: NmtState, to: NmtState) {
        self.events.push(DeviceEvent::State(to));
    }

    fn emergency(&mut self, _: &mut Objects<'_>, emergency: &Emergency) {
        self.events.push(DeviceEvent::Emergency(*emergency));
    }

    fn domain_length(&mut self, _: &mut Objects<'_>, entry: &Entry) -> Result<Option<u32>, AbortCode> {
        let length = self.domains.get(&(entry.index, entry.sub_index)).map_or(0, Vec::len);
        Ok(Some(length as u32))
    }

    fn read_domain(
        &mut self,
        _: &mut Objects<'_>,
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
        _: &mut Objects<'_>,
        entry: &Entry,
        offset: u32,
        data: &[u8],
        _: bool,
    ) -> Result<(), AbortCode> {
        let domain = self.domains.entry((entry.index, entry.sub_index)).or_default();
        domain.truncate(offset as usize);
        if domain.len() + data.len() > MOST_BYTES {
            return Err(AbortCode::OUT_OF_MEMORY);
        }
        domain.extend_from_slice(data);
        Ok(())
    }
}
