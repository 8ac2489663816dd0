//! One `key=value` line, and what its value means.

use super::{Datasheet, Section};
use crate::key::Key;
use crate::value::{Number, Value, ValueError, ValueErrorKind};
use crate::{Line, Span};
use core::fmt;
use edskit_types::{AccessType, DataType, ObjectCode};
use std::borrow::Cow;

/// One entry of the file.
#[derive(Clone, Copy)]
pub struct Entry<'a> {
    pub(super) sheet: &'a Datasheet,
    pub(super) id: u32,
}

impl<'a> Entry<'a> {
    /// Position among all entries of the file.
    pub fn id(self) -> u32 {
        self.id
    }

    /// Which key it is.
    #[inline]
    pub fn key(self) -> Key {
        self.sheet.entries[self.id as usize].key
    }

    /// Its line in the document, counted from 0.
    #[inline]
    pub fn line_number(self) -> usize {
        self.sheet.entries[self.id as usize].line as usize
    }

    /// Its line in the document.
    #[inline]
    pub fn line(self) -> &'a Line {
        &self.sheet.document.lines()[self.line_number()]
    }

    /// Where the key stands.
    pub fn key_span(self) -> Span {
        self.line().key(self.source())
    }

    /// Where the value stands, without blanks around it.
    #[inline]
    pub fn value_span(self) -> Span {
        self.line().value(self.source())
    }

    /// Key, `=` and value.
    pub fn span(self) -> Span {
        self.line().trimmed(self.source())
    }

    /// The key as written.
    pub fn key_text(self) -> Cow<'a, str> {
        self.sheet.document.text(self.key_span())
    }

    /// The bytes of the value.
    #[inline]
    pub fn raw(self) -> &'a [u8] {
        self.value_span().slice(self.source())
    }

    /// The value for display.
    pub fn text(self) -> Cow<'a, str> {
        self.sheet.document.text(self.value_span())
    }

    /// Whether there is no value, which counts as no entry (CiA 306 v1.3, 4.2).
    #[inline]
    pub fn is_empty(self) -> bool {
        self.value_span().is_empty()
    }

    /// The section that the entry stands in.
    pub fn section(self) -> Option<Section<'a>> {
        let after = self.sheet.sections.partition_point(|section| section.first_entry <= self.id);
        (after > 0).then(|| Section { sheet: self.sheet, id: after as u32 - 1 })
    }

    /// The value as an integer.
    #[inline]
    pub fn number(self) -> Field<'a, Number> {
        self.read(|raw| Number::parse(raw).map_err(|error| ValueError::number(error, raw)))
    }

    /// The value as an unsigned integer of type `T`.
    #[inline]
    pub fn unsigned<T: TryFrom<u64> + Bounded>(self) -> Field<'a, T> {
        self.read(|raw| {
            let number = Number::parse(raw).map_err(|error| ValueError::number(error, raw))?;
            number.to().ok_or(ValueError::whole(ValueErrorKind::AboveMaximum(T::MAXIMUM), raw))
        })
    }

    /// The value as a flag, `0` or `1`.
    #[inline]
    pub fn flag(self) -> Field<'a, bool> {
        self.read(|raw| {
            let number = Number::parse(raw).map_err(|error| ValueError::number(error, raw))?;
            match number.to::<u64>() {
                Some(0) => Ok(false),
                Some(1) => Ok(true),
                _ => Err(ValueError::whole(ValueErrorKind::NotBoolean, raw)),
            }
        })
    }

    /// The value as an access type.
    #[inline]
    pub fn access_type(self) -> Field<'a, AccessType> {
        self.read(|raw| AccessType::parse(raw).ok_or(ValueError::whole(ValueErrorKind::NotAccess, raw)))
    }

    /// The value as an object code.
    #[inline]
    pub fn object_code(self) -> Field<'a, ObjectCode> {
        self.read(|raw| {
            let number = Number::parse(raw).map_err(|error| ValueError::number(error, raw))?;
            let code = number.to::<u64>().and_then(ObjectCode::from_code);
            code.ok_or(ValueError::whole(ValueErrorKind::NotObjectCode, raw))
        })
    }

    /// The value as one of `data_type`; `None` for a type that CiA 301 does not define.
    #[inline]
    pub fn value(self, data_type: Option<DataType>) -> Field<'a, Value<'a>> {
        self.read(|raw| match data_type {
            Some(data_type) => Value::parse(data_type, raw),
            None => Value::parse_untyped(raw),
        })
    }

    #[inline]
    fn source(self) -> &'a [u8] {
        self.sheet.document.to_bytes()
    }

    #[inline]
    fn read<T>(self, parse: impl FnOnce(&'a [u8]) -> Result<T, ValueError>) -> Field<'a, T> {
        let raw = self.raw();
        let value =
            if raw.is_empty() { Err(ValueError::whole(ValueErrorKind::Empty, raw)) } else { parse(raw) };
        Field { entry: self, value }
    }
}

impl fmt::Debug for Entry<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}={}", self.key_text(), self.text())
    }
}

/// A value of the file: where it stands, and what it means, or why it means nothing.
#[derive(Clone, Copy, Debug)]
pub struct Field<'a, T> {
    /// The entry that holds the value.
    pub entry: Entry<'a>,
    /// The meaning, or the reason why the text has none.
    pub value: Result<T, ValueError>,
}

impl<'a, T> Field<'a, T> {
    /// Where the value stands.
    pub fn span(&self) -> Span {
        self.entry.value_span()
    }

    /// The value as written.
    pub fn text(&self) -> Cow<'a, str> {
        self.entry.text()
    }

    /// The meaning, if the text has one.
    #[inline]
    pub fn known(self) -> Option<T> {
        self.value.ok()
    }

    /// Where in the file the text goes wrong.
    pub fn error_span(&self) -> Option<Span> {
        let error = self.value.as_ref().err()?;
        Some(self.span().sub(error.span.start as usize, error.span.len()))
    }
}

/// Integers with a largest value, for messages.
pub trait Bounded {
    /// The largest value.
    const MAXIMUM: u64;
}

impl Bounded for u8 {
    const MAXIMUM: u64 = u8::MAX as u64;
}

impl Bounded for u16 {
    const MAXIMUM: u64 = u16::MAX as u64;
}

impl Bounded for u32 {
    const MAXIMUM: u64 = u32::MAX as u64;
}
