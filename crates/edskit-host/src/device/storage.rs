//! Memory for parameters that lasts as long as the process.

use edskit_runtime::{Record, Storage, StorageError};
use std::collections::BTreeMap;

/// Records in memory: saved parameters survive a reset of the node, not the end of the program.
#[derive(Clone, Default, Debug)]
pub struct MemoryStorage {
    records: BTreeMap<Record, Vec<u8>>,
    begun: Vec<u8>,
}

impl Storage for MemoryStorage {
    fn read(&mut self, record: Record, offset: u32, buffer: &mut [u8]) -> Result<usize, StorageError> {
        let bytes = self.records.get(&record).and_then(|bytes| bytes.get(offset as usize..));
        let bytes = bytes.unwrap_or_default();
        let count = bytes.len().min(buffer.len());
        buffer[..count].copy_from_slice(&bytes[..count]);
        Ok(count)
    }

    fn begin(&mut self, _: Record) -> Result<(), StorageError> {
        self.begun.clear();
        Ok(())
    }

    fn write(&mut self, _: Record, data: &[u8]) -> Result<(), StorageError> {
        self.begun.extend_from_slice(data);
        Ok(())
    }

    fn commit(&mut self, record: Record) -> Result<(), StorageError> {
        self.records.insert(record, std::mem::take(&mut self.begun));
        Ok(())
    }

    fn erase(&mut self, record: Record) -> Result<(), StorageError> {
        self.records.remove(&record);
        Ok(())
    }
}
