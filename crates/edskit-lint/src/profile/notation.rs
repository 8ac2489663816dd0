//! How the values of a profile are written in TOML.
//!
//! A visitor's complaint gets the place of what it was shown, so everything is checked inside visitors.

use super::Expected;
use core::fmt;
use core::marker::PhantomData;
use core::ops::RangeInclusive;
use edskit_model::Formula;
use edskit_model::nearest;
use edskit_types::{AccessType, DataType, Index, NodeId, ObjectCode};
use serde::de::value::{I64Deserializer, StrDeserializer};
use serde::de::{self, Deserialize, Deserializer, SeqAccess, Visitor};

/// An object code by its name.
pub(super) struct Code(pub(super) ObjectCode);
/// A data type by its name or its index.
pub(super) struct Type(pub(super) Index);
/// An access type.
pub(super) struct Access(pub(super) AccessType);
/// A number, or a formula with the node-ID.
#[derive(Clone, Copy)]
pub(super) struct Constant(pub(super) Expected);

/// One of the words that `known` things are called by.
struct WordVisitor<T: 'static> {
    what: &'static str,
    known: &'static [T],
    name: fn(T) -> &'static str,
}

impl<T: Copy> Visitor<'_> for WordVisitor<T> {
    type Value = T;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the name of an {}", self.what)
    }

    fn visit_str<E: de::Error>(self, word: &str) -> Result<T, E> {
        let known = self.known.iter().find(|known| (self.name)(**known) == word);
        let names = self.known.iter().map(|known| (self.name)(*known));
        known.copied().ok_or_else(|| unknown(self.what, word, names))
    }
}

impl<'de> Deserialize<'de> for Code {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let words = WordVisitor { what: "object code", known: ObjectCode::ALL, name: ObjectCode::name };
        deserializer.deserialize_any(words).map(Self)
    }
}

impl<'de> Deserialize<'de> for Access {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let words = WordVisitor { what: "access type", known: AccessType::ALL, name: AccessType::as_str };
        deserializer.deserialize_any(words).map(Self)
    }
}

fn unknown<'a, E: de::Error>(what: &str, word: &str, known: impl Iterator<Item = &'a str>) -> E {
    E::custom(match nearest(word, known) {
        Some(nearest) => format!("`{word}` is no {what}; did you mean `{nearest}`?"),
        None => format!("`{word}` is no {what}"),
    })
}

impl<'de> Deserialize<'de> for Type {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct TypeVisitor;
        impl Visitor<'_> for TypeVisitor {
            type Value = Type;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("the name or the index of a data type")
            }

            fn visit_str<E: de::Error>(self, word: &str) -> Result<Type, E> {
                let known = DataType::ALL.iter().find(|known| known.name() == word);
                let names = DataType::ALL.iter().map(|known| known.name());
                known.map(|known| Type(known.index())).ok_or_else(|| unknown("data type", word, names))
            }

            fn visit_i64<E: de::Error>(self, index: i64) -> Result<Type, E> {
                let index = u16::try_from(index).ok().filter(|index| (1..=0x25F).contains(index));
                let index = index.ok_or_else(|| E::custom("data types have the indices 0001h to 025Fh"))?;
                Ok(Type(Index(index)))
            }
        }
        deserializer.deserialize_any(TypeVisitor)
    }
}

impl<'de> Deserialize<'de> for Constant {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct ConstantVisitor;
        impl Visitor<'_> for ConstantVisitor {
            type Value = Constant;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number or a formula such as \"$NODEID+0x80\"")
            }

            fn visit_str<E: de::Error>(self, text: &str) -> Result<Constant, E> {
                let formula = Formula::parse(text.as_bytes()).map_err(E::custom)?;
                Ok(Constant(Expected::Formula(formula)))
            }

            fn visit_i64<E: de::Error>(self, number: i64) -> Result<Constant, E> {
                Ok(Constant(Expected::Number(number)))
            }
        }
        deserializer.deserialize_any(ConstantVisitor)
    }
}

/// One thing, or a list of things that are all right.
pub(super) struct OneOrMany<T>(pub(super) Vec<T>);

impl<T> Default for OneOrMany<T> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for OneOrMany<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ListVisitor(PhantomData)).map(Self)
    }
}

/// One number, or the first and the last one of a range.
pub(super) struct OneOrRange<T>(pub(super) RangeInclusive<T>);

impl<'de, T: Deserialize<'de> + Clone + Ordered> Deserialize<'de> for OneOrRange<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(RangeVisitor(PhantomData)).map(Self)
    }
}

struct RangeVisitor<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de> + Clone + Ordered> Visitor<'de> for RangeVisitor<T> {
    type Value = RangeInclusive<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number or a range `[first, last]`")
    }

    fn visit_str<E: de::Error>(self, word: &str) -> Result<Self::Value, E> {
        let only = T::deserialize(StrDeserializer::new(word))?;
        Ok(only.clone()..=only)
    }

    fn visit_i64<E: de::Error>(self, number: i64) -> Result<Self::Value, E> {
        let only = T::deserialize(I64Deserializer::new(number))?;
        Ok(only.clone()..=only)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Self::Value, A::Error> {
        match <[T; 2]>::try_from(ListVisitor(PhantomData).visit_seq(list)?) {
            Ok([first, last]) if first.is_at_most(&last) => Ok(first..=last),
            Ok(_) => Err(de::Error::custom("the last one of the range lies before the first one")),
            Err(_) => Err(de::Error::custom("a range is written `[first, last]`")),
        }
    }
}

/// What can be the bounds of a range.
pub(super) trait Ordered {
    /// Whether `last` can be the end of a range that begins here.
    fn is_at_most(&self, last: &Self) -> bool;
}

impl Ordered for u8 {
    fn is_at_most(&self, last: &Self) -> bool {
        self <= last
    }
}

impl Ordered for u16 {
    fn is_at_most(&self, last: &Self) -> bool {
        self <= last
    }
}

impl Ordered for Constant {
    fn is_at_most(&self, last: &Self) -> bool {
        let at = |constant: &Self| constant.0.at(NodeId::MIN);
        at(self) <= at(last)
    }
}

/// Reads one `T` or a list of them, and leaves the place of an error to the reader of the `T`.
struct ListVisitor<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for ListVisitor<T> {
    type Value = Vec<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a word, a number or a list")
    }

    fn visit_str<E: de::Error>(self, word: &str) -> Result<Vec<T>, E> {
        Ok(vec![T::deserialize(StrDeserializer::new(word))?])
    }

    fn visit_i64<E: de::Error>(self, number: i64) -> Result<Vec<T>, E> {
        Ok(vec![T::deserialize(I64Deserializer::new(number))?])
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Vec<T>, A::Error> {
        let mut items = Vec::new();
        while let Some(item) = list.next_element()? {
            items.push(item);
        }
        Ok(items)
    }
}
