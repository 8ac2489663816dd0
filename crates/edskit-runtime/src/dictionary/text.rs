//! Texts: VISIBLE_STRING, OCTET_STRING and UNICODE_STRING by their handles.

use super::entry::{Entry, Flags};
use super::handle::{Handle, Key, Readable};
use super::objects::Objects;
use super::table::Position;
use super::value::copy;
use core::fmt;
use core::str::{Utf8Error, from_utf8};

/// The type of handles of a VISIBLE_STRING: [`Objects::text`], [`Objects::set_text`].
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum VisibleString {}

/// The type of handles of an OCTET_STRING: [`Objects::octets`], [`Objects::store`].
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum OctetString {}

/// The type of handles of a UNICODE_STRING: [`Objects::characters`], [`Objects::set_text`].
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum UnicodeString {}

/// A text of characters: [`VisibleString`] or [`UnicodeString`].
pub trait Text: sealed::Sealed {}

/// [`VisibleString`], [`OctetString`] or [`UnicodeString`].
pub trait Octets: any::Sealed {}

mod sealed {
    pub trait Sealed {
        /// Writes the characters into as many bytes as they take; how many that are where there is room.
        fn encode(text: &str, to: &mut [u8]) -> Option<usize>;
    }
}

mod any {
    pub trait Sealed {}
}

impl Text for VisibleString {}
impl Text for UnicodeString {}
impl Octets for VisibleString {}
impl Octets for OctetString {}
impl Octets for UnicodeString {}
impl any::Sealed for VisibleString {}
impl any::Sealed for OctetString {}
impl any::Sealed for UnicodeString {}

impl sealed::Sealed for VisibleString {
    fn encode(text: &str, to: &mut [u8]) -> Option<usize> {
        copy(to.get_mut(..text.len())?, text.as_bytes());
        Some(text.len())
    }
}

impl sealed::Sealed for UnicodeString {
    fn encode(text: &str, to: &mut [u8]) -> Option<usize> {
        let length = 2 * text.encode_utf16().count();
        for (pair, unit) in to.get_mut(..length)?.chunks_exact_mut(2).zip(text.encode_utf16()) {
            copy(pair, &unit.to_le_bytes());
        }
        Some(length)
    }
}

/// Why the device could not write an entry; nothing has changed then.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum WriteError {
    /// There is no such entry.
    NoEntry,
    /// The entry cannot change: it lies in flash, or is a DOMAIN.
    Constant,
    /// The value is longer than there is room for; or it is a number, and has another length.
    Length,
}

impl fmt::Display for WriteError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NoEntry => "there is no such entry",
            Self::Constant => "the entry cannot change",
            Self::Length => "the value does not have the length of the entry",
        })
    }
}

impl core::error::Error for WriteError {}

impl<'a> Objects<'a> {
    /// A text as it is now.
    ///
    /// # Errors
    /// [`Utf8Error`] where the bytes are no UTF-8, of which the characters of a VISIBLE_STRING are a part: clients can write
    /// any bytes. [`octets`](Self::octets) gives them.
    pub fn text(&self, handle: impl Readable<Value = VisibleString>) -> Result<&str, Utf8Error> {
        from_utf8(self.bytes(handle.entry_position()))
    }

    /// The characters of a text as it is now; U+FFFD for what is none.
    pub fn characters(
        &self,
        handle: impl Readable<Value = UnicodeString>,
    ) -> impl Iterator<Item = char> + '_ {
        let pairs = self.bytes(handle.entry_position()).chunks_exact(2);
        let units = pairs.map(|pair| pair.iter().rev().fold(0, |unit, byte| unit << 8 | u16::from(*byte)));
        char::decode_utf16(units).map(|unit| unit.unwrap_or(char::REPLACEMENT_CHARACTER))
    }

    /// The bytes of a text as it is now.
    pub fn octets<T: Octets>(&self, handle: impl Readable<Value = T>) -> &[u8] {
        self.bytes(handle.entry_position())
    }

    /// Gives a text these characters: a VISIBLE_STRING as UTF-8, a UNICODE_STRING as UTF-16.
    ///
    /// ```
    /// # use edskit_runtime::{Handle, Objects, VisibleString, WriteError};
    /// # fn name(objects: &mut Objects<'_>, location: Handle<VisibleString>) -> Result<(), WriteError> {
    /// objects.set_text(location, "Hall 3")?;
    /// assert_eq!(objects.text(location), Ok("Hall 3"));
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// [`WriteError::Length`] where they take more bytes than the text can have.
    pub fn set_text<T: Text>(&mut self, handle: Handle<T>, text: &str) -> Result<(), WriteError> {
        let (position, entry) = self.writable(handle.position())?;
        let start = usize::from(entry.offset) + 2;
        let room = self.values.get_mut(start..start + usize::from(entry.size)).unwrap_or_default();
        let length = T::encode(text, room).ok_or(WriteError::Length)?;
        self.set_length(position, length as u16);
        Ok(())
    }

    /// Gives an entry these bytes, in the order of the bus: of a text at most as many as it can have, of another type
    /// exactly as many as it has. Limits and rights are not looked at: they bind SDO clients.
    ///
    /// # Errors
    /// [`WriteError::Length`] where they are too many or, unless it is a text, too few.
    pub fn store<T>(&mut self, handle: Handle<T>, data: &[u8]) -> Result<(), WriteError> {
        self.store_at(handle.position(), data)
    }

    /// [`store`](Self::store) for an entry that is not known before the device runs.
    ///
    /// # Errors
    /// [`WriteError`]
    pub fn store_by_key(&mut self, key: Key, data: &[u8]) -> Result<(), WriteError> {
        let found = self.table.find(key.index, key.sub_index);
        self.store_at(found.map_err(|_| WriteError::NoEntry)?, data)
    }

    fn store_at(&mut self, position: Position, data: &[u8]) -> Result<(), WriteError> {
        let (position, entry) = self.writable(position)?;
        let size = usize::from(entry.size);
        if data.len() > size || (data.len() < size && !entry.has_length()) {
            return Err(WriteError::Length);
        }
        self.put(position, entry, data);
        Ok(())
    }

    fn writable(&self, position: Position) -> Result<(Position, &'a Entry), WriteError> {
        let entry = self.table.entry(position).ok_or(WriteError::NoEntry)?;
        if entry.flags.has(Flags::VARIABLE) { Ok((position, entry)) } else { Err(WriteError::Constant) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dictionary::testing::{entry, table};
    use crate::{Constant, Entry};
    use edskit_types::DataType;
    use std::string::String;

    const NAME: Handle<VisibleString> = Handle::new(Position(0), Key::new(0x2000, 0));
    const LABEL: Handle<UnicodeString> = Handle::new(Position(1), Key::new(0x2001, 0));
    const CODE: Handle<OctetString> = Handle::new(Position(2), Key::new(0x2002, 0));
    const SPEED: Handle<u16> = Handle::new(Position(3), Key::new(0x2003, 0));
    const MAKER: Constant<VisibleString> = Constant::new(Position(4), Key::new(0x2004, 0));

    /// Runs something over three texts of four bytes, a number and a constant.
    fn with_texts(run: impl FnOnce(&mut Objects<'_>)) {
        let variable = |index, data_type, offset, size| Entry {
            data_type,
            flags: Flags::READ.and(Flags::VARIABLE),
            offset,
            size,
            ..entry(index, 0)
        };
        let maker = Entry { data_type: DataType::VisibleString, size: 3, ..entry(0x2004, 0) };
        let entries = [
            variable(0x2000, DataType::VisibleString, 0, 4),
            variable(0x2001, DataType::UnicodeString, 6, 4),
            variable(0x2002, DataType::OctetString, 12, 4),
            variable(0x2003, DataType::Unsigned16, 18, 2),
            maker,
        ];
        let table = crate::Table { constants: b"we!", ..table(&entries) };
        let mut values = [0; 20];
        run(&mut Objects::new(&table, &mut values));
    }

    #[test]
    fn a_text_that_is_too_long_changes_nothing() {
        with_texts(|objects| {
            assert_eq!(objects.set_text(NAME, "ok"), Ok(()));
            assert_eq!(objects.set_text(NAME, "abcde"), Err(WriteError::Length));
            assert_eq!(objects.text(NAME), Ok("ok"));
            assert_eq!(objects.set_text(NAME, "four"), Ok(()));
            assert_eq!((objects.text(NAME), objects.octets(NAME)), (Ok("four"), &b"four"[..]));
            assert_eq!(objects.set_text(LABEL, "abc"), Err(WriteError::Length));
            assert_eq!(objects.set_text(LABEL, "\u{1F600}"), Ok(()));
            assert_eq!(objects.characters(LABEL).collect::<String>(), "\u{1F600}");
            assert_eq!(objects.set_text(LABEL, "\u{f6}"), Ok(()));
            assert_eq!((objects.octets(LABEL), objects.text(NAME)), (&[0xF6, 0][..], Ok("four")));
            assert_eq!(objects.store(CODE, &[1, 2, 3, 4, 5]), Err(WriteError::Length));
            assert_eq!(objects.store(CODE, &[0xFF]), Ok(()));
            assert_eq!(objects.octets(CODE), [0xFF]);
            assert_eq!(objects.text(MAKER), Ok("we!"));
        });
    }

    #[test]
    fn what_is_no_text_is_said() {
        with_texts(|objects| {
            assert_eq!(objects.store(NAME, &[0xFF]), Ok(()));
            assert!(objects.text(NAME).is_err());
            assert_eq!(objects.store(LABEL, &[0, 0xD8, 0x61]), Ok(()));
            assert_eq!(objects.characters(LABEL).collect::<String>(), "\u{FFFD}");
        });
    }

    #[test]
    fn bytes_have_the_length_of_their_entry() {
        with_texts(|objects| {
            assert_eq!(objects.store(SPEED, &[1]), Err(WriteError::Length));
            assert_eq!(objects.store(SPEED, &[1, 2, 3]), Err(WriteError::Length));
            assert_eq!(objects.store(SPEED, &[1, 2]), Ok(()));
            assert_eq!(objects.get(SPEED), 0x0201);
            assert_eq!(objects.store_by_key(MAKER.key(), b"you"), Err(WriteError::Constant));
            assert_eq!(objects.store_by_key(Key::new(0x2005, 0), b""), Err(WriteError::NoEntry));
            assert_eq!(objects.store_by_key(NAME.key(), b"me"), Ok(()));
            assert_eq!((objects.text(NAME), objects.text(MAKER)), (Ok("me"), Ok("we!")));
        });
    }
}
