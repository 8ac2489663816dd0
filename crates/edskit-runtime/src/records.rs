//! Memory that keeps its content without power: what a device gives to the services that store something.

use crate::crc::Crc;
use crate::dictionary::StorageGroup;
use crate::services::Services;

/// Memory that keeps its content without power. It holds one record for each group of values.
///
/// A record is written by [`begin`](Storage::begin), any number of [`write`](Storage::write) and one
/// [`commit`](Storage::commit). Until the commit the old record should stay; where power fails in between or the memory
/// tears the record, its checksum tells, and the defaults are used.
pub trait Storage {
    /// Reads from a record into `buffer` and says how many bytes; 0 at its end, or where there is none.
    ///
    /// # Errors
    /// [`StorageError`] if the memory does not answer.
    fn read(&mut self, record: Record, offset: u32, buffer: &mut [u8]) -> Result<usize, StorageError>;

    /// Begins a new record.
    ///
    /// # Errors
    /// [`StorageError`] if it cannot be written.
    fn begin(&mut self, record: Record) -> Result<(), StorageError>;

    /// Appends to the record that was begun.
    ///
    /// # Errors
    /// [`StorageError`] if it cannot be written.
    fn write(&mut self, record: Record, data: &[u8]) -> Result<(), StorageError>;

    /// Puts the new record in the place of the old one.
    ///
    /// # Errors
    /// [`StorageError`] if it cannot be written.
    fn commit(&mut self, record: Record) -> Result<(), StorageError>;

    /// Removes a record.
    ///
    /// # Errors
    /// [`StorageError`] if that fails.
    fn erase(&mut self, record: Record) -> Result<(), StorageError>;
}

impl<T: Storage + ?Sized> Storage for &mut T {
    fn read(&mut self, record: Record, offset: u32, buffer: &mut [u8]) -> Result<usize, StorageError> {
        (**self).read(record, offset, buffer)
    }

    fn begin(&mut self, record: Record) -> Result<(), StorageError> {
        (**self).begin(record)
    }

    fn write(&mut self, record: Record, data: &[u8]) -> Result<(), StorageError> {
        (**self).write(record, data)
    }

    fn commit(&mut self, record: Record) -> Result<(), StorageError> {
        (**self).commit(record)
    }

    fn erase(&mut self, record: Record) -> Result<(), StorageError> {
        (**self).erase(record)
    }
}

/// The memory did not do what it should.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct StorageError;

/// What a record holds.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Record {
    /// What LSS has configured: node-ID and bit rate.
    Lss,
    /// The values of a group.
    Values(StorageGroup),
    /// What a device keeps besides its dictionary, by a number of its own. The node knows nothing of it.
    Device(u8),
}

/// A device without such memory: nothing is ever stored, and saving fails.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct NoStorage;

impl Storage for NoStorage {
    fn read(&mut self, _: Record, _: u32, _: &mut [u8]) -> Result<usize, StorageError> {
        Ok(0)
    }

    fn begin(&mut self, _: Record) -> Result<(), StorageError> {
        Err(StorageError)
    }

    fn write(&mut self, _: Record, _: &[u8]) -> Result<(), StorageError> {
        Err(StorageError)
    }

    fn commit(&mut self, _: Record) -> Result<(), StorageError> {
        Err(StorageError)
    }

    fn erase(&mut self, _: Record) -> Result<(), StorageError> {
        Ok(())
    }
}

impl Services<'_> {
    /// Keeps bytes over power-off in a record of the device ([`Record::Device`]): what a manual stores when it is written,
    /// without 1010h. A checksum is kept with them.
    ///
    /// # Errors
    /// [`StorageError`] if the memory does not take them.
    pub fn keep(&mut self, record: u8, data: &[u8]) -> Result<(), StorageError> {
        let record = Record::Device(record);
        let length = u16::try_from(data.len()).map_err(|_| StorageError)?;
        let mut writer = Writer { storage: self.storage, record, crc: Crc::new() };
        writer.storage.begin(record)?;
        writer.write(&length.to_le_bytes())?;
        writer.write(data)?;
        let crc = writer.crc.value().to_le_bytes();
        writer.storage.write(record, &crc)?;
        writer.storage.commit(record)
    }

    /// The bytes that were kept in a record of the device; `None` where there are none.
    ///
    /// # Errors
    /// [`StorageError`] if the memory does not answer, the record is torn, or it holds more than `buffer`.
    pub fn kept<'b>(&mut self, record: u8, buffer: &'b mut [u8]) -> Result<Option<&'b [u8]>, StorageError> {
        let mut reader = Reader::new(self.storage, Record::Device(record));
        let mut crc = Crc::new();
        let mut two = [0; 2];
        match reader.read(&mut two)? {
            0 => return Ok(None),
            2 => crc.update(&two),
            _ => return Err(StorageError),
        }
        let data = buffer.get_mut(..usize::from(u16::from_le_bytes(two))).ok_or(StorageError)?;
        let is_whole = reader.read(data)? == data.len();
        crc.update(data);
        let is_right = is_whole && reader.read(&mut two)? == 2 && u16::from_le_bytes(two) == crc.value();
        if is_right { Ok(Some(data)) } else { Err(StorageError) }
    }
}

/// Writes a record with the checksum over it.
pub(crate) struct Writer<'a> {
    pub(crate) storage: &'a mut dyn Storage,
    pub(crate) record: Record,
    pub(crate) crc: Crc,
}

impl Writer<'_> {
    pub(crate) fn write(&mut self, data: &[u8]) -> Result<(), StorageError> {
        self.crc.update(data);
        self.storage.write(self.record, data)
    }
}

/// Reads a record from any place on.
pub(crate) struct Reader<'a> {
    pub(crate) storage: &'a mut dyn Storage,
    pub(crate) record: Record,
    pub(crate) offset: u32,
}

impl<'a> Reader<'a> {
    /// Reads a record from its beginning.
    pub(crate) fn new(storage: &'a mut dyn Storage, record: Record) -> Self {
        Self { storage, record, offset: 0 }
    }

    /// Fills the buffer as far as the record goes.
    pub(crate) fn read(&mut self, buffer: &mut [u8]) -> Result<usize, StorageError> {
        let mut done = 0;
        while let Some(rest) = buffer.get_mut(done..).filter(|rest| !rest.is_empty()) {
            match self.storage.read(self.record, self.offset, rest)? {
                0 => break,
                count => {
                    let count = count.min(rest.len());
                    done += count;
                    self.offset += count as u32;
                }
            }
        }
        Ok(done)
    }
}
