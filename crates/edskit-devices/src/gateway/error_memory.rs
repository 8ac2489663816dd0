//! The errors that are present, and the memory that counts them (9.1, 9.2, 9.4).

use super::error::GatewayError;
use edskit_runtime::{Record, Storage, StorageError};

/// The record that keeps the counters without power.
const COUNTERS: Record = Record::Device(1);
/// How many errors there are.
const COUNT: usize = GatewayError::ALL.len();

/// Which errors of the gateway are present, and how often each has occurred.
///
/// The counters only count: the gateway reacts to present errors alone (9.1; GW-APP-36).
#[derive(Clone, Debug)]
pub(super) struct ErrorMemory {
    present: u16,
    counters: [u8; COUNT],
}

impl ErrorMemory {
    /// What a start finds: no error (9.1; GW-APP-37), and the counters that were kept.
    pub(super) fn load(storage: &mut impl Storage) -> Self {
        let mut counters = [0; COUNT];
        let read = storage.read(COUNTERS, 0, &mut counters);
        if read != Ok(COUNT) {
            counters = [0; COUNT];
        }
        Self { present: 0, counters }
    }

    pub(super) fn is_present(&self, error: GatewayError) -> bool {
        self.present & 1 << error.position() != 0
    }

    /// The errors that are present, in the order of their numbers.
    pub(super) fn present(&self) -> impl Iterator<Item = GatewayError> {
        let present = self.present;
        GatewayError::ALL.into_iter().filter(move |error| present & 1 << error.position() != 0)
    }

    /// How often an error has occurred, up to 255 (11.3; GW-APP-30).
    pub(super) fn count(&self, error: GatewayError) -> u8 {
        self.counters.get(error.position()).copied().unwrap_or_default()
    }

    /// Makes an error present or not; whether that is new. A new one is counted.
    ///
    /// # Errors
    /// [`StorageError`] if the counter cannot be kept.
    pub(super) fn set(
        &mut self,
        error: GatewayError,
        is_present: bool,
        storage: &mut impl Storage,
    ) -> Result<bool, StorageError> {
        let is_new = self.is_present(error) != is_present;
        let bit = 1 << error.position();
        self.present = if is_present { self.present | bit } else { self.present & !bit };
        if is_new && is_present {
            self.count_up(error, storage)?;
        }
        Ok(is_new)
    }

    fn count_up(&mut self, error: GatewayError, storage: &mut impl Storage) -> Result<(), StorageError> {
        let Some(counter) = self.counters.get_mut(error.position()) else { return Ok(()) };
        if *counter == u8::MAX {
            return Ok(());
        }
        *counter += 1;
        self.keep(storage)
    }

    /// Forgets how often errors have occurred (9.4; GW-APP-35).
    ///
    /// # Errors
    /// [`StorageError`] if that cannot be kept.
    pub(super) fn clear_counters(&mut self, storage: &mut impl Storage) -> Result<(), StorageError> {
        self.counters = [0; COUNT];
        self.keep(storage)
    }

    fn keep(&self, storage: &mut impl Storage) -> Result<(), StorageError> {
        storage.begin(COUNTERS)?;
        storage.write(COUNTERS, &self.counters)?;
        storage.commit(COUNTERS)
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::OneRecord;
    use super::*;
    use std::vec::Vec;

    // GW-APP-30, GW-APP-36, GW-APP-37
    #[test]
    fn counters_are_kept_and_present_errors_are_not() {
        let mut storage = OneRecord::default();
        let mut memory = ErrorMemory::load(&mut storage);
        for is_present in [true, true, false, true] {
            memory.set(GatewayError::CanBus1, is_present, &mut storage).unwrap();
        }
        memory.set(GatewayError::Intern, true, &mut storage).unwrap();
        assert_eq!(memory.present().collect::<Vec<_>>(), [GatewayError::CanBus1, GatewayError::Intern]);
        let memory = ErrorMemory::load(&mut storage);
        assert_eq!(memory.present().count(), 0);
        let counts = GatewayError::ALL.map(|error| memory.count(error));
        assert_eq!(counts, [2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1]);
    }

    // GW-APP-30
    #[test]
    fn counters_end_at_255() {
        let mut storage = OneRecord::default();
        let mut memory = ErrorMemory::load(&mut storage);
        for _ in 0..300 {
            memory.set(GatewayError::Data, true, &mut storage).unwrap();
            memory.set(GatewayError::Data, false, &mut storage).unwrap();
        }
        assert_eq!(memory.count(GatewayError::Data), 255);
    }
}
