//! Without storing: 1010h answers that nothing is saved, and 1011h has nothing to forget.

use crate::Application;
use crate::context::Context;
use crate::records::{Record, StorageError};
use crate::services::Services;
use crate::{Entry, StorageGroup};
use edskit_types::{AbortCode, Index};

impl Services<'_> {
    /// Would save a group of values, but the crate is built without its feature `storage`.
    ///
    /// # Errors
    /// [`StorageError`] always.
    pub fn save(&mut self, _: StorageGroup) -> Result<(), StorageError> {
        Err(StorageError)
    }

    /// Forgets what is stored of a group of values: there is nothing, as the crate is built without its feature `storage`.
    ///
    /// # Errors
    /// None.
    pub fn forget(&mut self, _: StorageGroup) -> Result<(), StorageError> {
        Ok(())
    }
}

impl<A: Application + ?Sized> Context<'_, A> {
    /// 1010h or 1011h is written. The device may store the values itself.
    pub(crate) fn do_command(&mut self, entry: &Entry) -> Result<(), AbortCode> {
        let is_left = self.app.storage_command(&mut self.node, entry)?;
        if is_left && entry.index == Index::STORE_PARAMETERS {
            self.app.storage_failed(&mut self.node, Record::Values(StorageGroup(entry.sub_index.0)));
            return Err(AbortCode::HARDWARE_ERROR);
        }
        Ok(())
    }

    pub(crate) fn load_parameters(&mut self, _: impl Fn(Index) -> bool) {}
}
