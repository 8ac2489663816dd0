//! One `key=value` line, and what its value means.

use super::{Datasheet, Section};
use crate::key::{Key, KeyName};
use crate::meant::{self, Slip, Wanted};
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

    /// The same without a comment behind it; for values that are no free text.
    pub fn text_before_comment(self) -> Cow<'a, str> {
        let span = self.value_span();
        let length = meant::value_length(self.raw()).unwrap_or(span.len());
        self.sheet.document.text(span.sub(0, length))
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
        let field = self.read(|raw| match data_type {
            Some(data_type) => Value::parse(data_type, raw),
            None => Value::parse_untyped(raw),
        });
        Field { data_type, ..field }
    }

    /// What the value, which is none by CiA 306, was meant to be; `None` where nobody can know. `wanted` is what has to
    /// stand there.
    pub fn slip(self, wanted: Wanted) -> Option<Slip> {
        meant::of(self.raw(), wanted)
    }

    /// The text that was certainly meant in the place of the value.
    #[cold]
    fn meant(self, wanted: Wanted) -> Option<String> {
        self.slip(wanted).filter(|slip| slip.certain).map(|slip| slip.text)
    }

    /// What a number of this entry is.
    pub(super) fn wanted_number(self) -> Wanted {
        match self.key().name {
            KeyName::DataType => Wanted::DataType,
            KeyName::Item => Wanted::Index,
            _ => Wanted::Number,
        }
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
        Field { entry: self, value, data_type: None }
    }
}

impl fmt::Debug for Entry<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}={}", self.key_text(), self.text())
    }
}

/// A value of the file: where it stands, and what it means, or why it means nothing.
///
/// There are three answers: a value that is written as CiA 306 wants it ([`Field::value`] has it), one that is written
/// wrongly but can have been meant in one way only ([`Field::known`] gives it too, see [`meant`]), and one that nobody can
/// read.
#[derive(Clone, Copy, Debug)]
pub struct Field<'a, T> {
    /// The entry that holds the value.
    pub entry: Entry<'a>,
    /// The meaning by CiA 306, or the reason why the text has none.
    pub value: Result<T, ValueError>,
    /// What the value was read by, where it is a typed one.
    pub(super) data_type: Option<DataType>,
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

    /// Where in the file the text goes wrong.
    pub fn error_span(&self) -> Option<Span> {
        let error = self.value.as_ref().err()?;
        Some(self.span().sub(error.span.start as usize, error.span.len()))
    }
}

impl<'a, T: Meant<'a>> Field<'a, T> {
    /// The meaning: what the text says or, where it is written wrongly, what was certainly meant.
    ///
    /// ```
    /// use edskit_model::Datasheet;
    /// let sheet = Datasheet::parse(b"[1017]\nDataType=0x0006 ; UNSIGNED16\n");
    /// let field = sheet.objects().next().unwrap().data_type().unwrap();
    /// assert!(field.value.is_err());
    /// assert_eq!(field.known(), Some(6));
    /// ```
    #[inline]
    pub fn known(self) -> Option<T> {
        match self.value {
            Ok(value) => Some(value),
            Err(error) => self.meant(error),
        }
    }

    #[cold]
    fn meant(self, error: ValueError) -> Option<T> {
        if error.kind == ValueErrorKind::Empty { None } else { T::meant(self.entry, self.data_type) }
    }
}

/// What values can be meant, though they are written wrongly.
pub trait Meant<'a>: Sized {
    /// What was certainly meant in the place of a malformed value of `data_type`, which only typed values have.
    fn meant(entry: Entry<'a>, data_type: Option<DataType>) -> Option<Self>;
}

impl Meant<'_> for Number {
    fn meant(entry: Entry<'_>, _: Option<DataType>) -> Option<Self> {
        Number::parse(entry.meant(entry.wanted_number())?.as_bytes()).ok()
    }
}

impl Meant<'_> for bool {
    fn meant(entry: Entry<'_>, _: Option<DataType>) -> Option<Self> {
        let number = Number::parse(entry.meant(Wanted::Flag)?.as_bytes()).ok()?;
        number.to::<u64>().map(|flag| flag == 1)
    }
}

impl Meant<'_> for AccessType {
    fn meant(entry: Entry<'_>, _: Option<DataType>) -> Option<Self> {
        AccessType::parse(entry.meant(Wanted::Access)?.as_bytes())
    }
}

impl Meant<'_> for ObjectCode {
    fn meant(entry: Entry<'_>, _: Option<DataType>) -> Option<Self> {
        let number = Number::parse(entry.meant(Wanted::ObjectCode)?.as_bytes()).ok()?;
        ObjectCode::from_code(number.to()?)
    }
}

impl<'a> Meant<'a> for Value<'a> {
    fn meant(entry: Entry<'a>, data_type: Option<DataType>) -> Option<Self> {
        let text = entry.meant(Wanted::Value(data_type))?;
        let value = match data_type {
            Some(data_type) => Value::parse(data_type, text.as_bytes()).ok()?,
            None => Value::parse_untyped(text.as_bytes())
                .or_else(|_| Value::parse(DataType::Unsigned64, text.as_bytes()))
                .ok()?,
        };
        Some(match value {
            Value::Boolean(value) => Value::Boolean(value),
            Value::Integer(number) => Value::Integer(number),
            Value::Formula(formula) => Value::Formula(formula),
            Value::Real(real) => Value::Real(real),
            Value::RealBits(bits) => Value::RealBits(bits),
            Value::Time { days, milliseconds } => Value::Time { days, milliseconds },
            // The digits as they stand in the file, with what stands between them.
            Value::Octets(_) => Value::Octets(meant::before_comment(entry.raw())),
            Value::Text(_) | Value::Bits(_) => return None,
        })
    }
}

/// Integers with a largest value, for messages.
pub trait Bounded {
    /// The largest value.
    const MAXIMUM: u64;
}

macro_rules! unsigned {
    ($($integer:ident)*) => {
        $(
            impl Bounded for $integer {
                const MAXIMUM: u64 = $integer::MAX as u64;
            }

            impl Meant<'_> for $integer {
                fn meant(entry: Entry<'_>, _: Option<DataType>) -> Option<Self> {
                    Number::parse(entry.meant(entry.wanted_number())?.as_bytes()).ok()?.to()
                }
            }
        )*
    };
}

unsigned! { u8 u16 u32 }
