//! Handles: entries that are known when the device is compiled.

use super::table::Position;
use core::marker::PhantomData;
use edskit_types::{Index, SubIndex};

/// Where an entry is in the object dictionary: its index and sub-index.
///
/// Generated dictionaries have a constant for each entry, so that a device can `match` on
/// [`Entry::key`](crate::Entry::key) without numbers.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Key {
    /// The index.
    pub index: Index,
    /// The sub-index; 00h for a VAR.
    pub sub_index: SubIndex,
}

impl Key {
    /// The key of these numbers.
    #[must_use]
    pub const fn new(index: u16, sub_index: u8) -> Self {
        Self { index: Index(index), sub_index: SubIndex(sub_index) }
    }
}

/// A [`Handle`] or a [`Constant`]: what an entry is read by.
pub trait Readable: sealed::Sealed + Copy {
    /// The type of its value.
    type Value;
}

pub(super) mod sealed {
    use super::{Key, Position};

    pub trait Sealed {
        fn entry_position(&self) -> Position;
        fn entry_key(&self) -> Key;
    }
}

macro_rules! handles {
    ($($(#[$doc:meta])* $name:ident;)*) => {
        $(
            $(#[$doc])*
            #[derive(Debug)]
            pub struct $name<T> {
                position: Position,
                key: Key,
                value: PhantomData<fn() -> T>,
            }

            impl<T> $name<T> {
                /// The entry at this position, whose key and type must be these; generated code calls it.
                #[must_use]
                pub const fn new(position: Position, key: Key) -> Self {
                    Self { position, key, value: PhantomData }
                }

                /// The entries from this one on, whose sub-indices have no gap and whose type is the same; generated code
                /// calls it.
                #[must_use]
                pub const fn run<const COUNT: usize>(first: Position, key: Key) -> [Self; COUNT] {
                    let mut handles = [Self::new(first, key); COUNT];
                    let mut place = 0;
                    while place < COUNT {
                        handles[place].position.0 = first.0.wrapping_add(place as u16);
                        handles[place].key.sub_index.0 = key.sub_index.0.wrapping_add(place as u8);
                        place += 1;
                    }
                    handles
                }

                /// Its index and sub-index.
                #[must_use]
                pub const fn key(&self) -> Key {
                    self.key
                }
            }

            impl<T> Clone for $name<T> {
                fn clone(&self) -> Self {
                    *self
                }
            }

            impl<T> Copy for $name<T> {}

            impl<T> sealed::Sealed for $name<T> {
                fn entry_position(&self) -> Position {
                    self.position
                }

                fn entry_key(&self) -> Key {
                    self.key
                }
            }

            impl<T> Readable for $name<T> {
                type Value = T;
            }
        )*
    };
}

handles! {
    /// An entry that can change: reading and writing it needs no look-up.
    ///
    /// `T` is the type of its values, or one of [`VisibleString`](crate::VisibleString),
    /// [`OctetString`](crate::OctetString) and [`UnicodeString`](crate::UnicodeString). An object whose sub-objects have one
    /// type and no gap is an array of handles: sub-index 01h is at place 0.
    ///
    /// ```
    /// use edskit_runtime::{Handle, Key, Objects, Position, VisibleString, WriteError};
    ///
    /// const SPEED: Handle<u32> = Handle::new(Position(4), Key::new(0x2000, 0));
    /// const LOCATION: Handle<VisibleString> = Handle::new(Position(2), Key::new(0x1008, 0));
    ///
    /// fn begin(objects: &mut Objects<'_>) -> Result<(), WriteError> {
    ///     objects.set(SPEED, 4711);
    ///     objects.store(LOCATION, b"Pump")
    /// }
    /// ```
    Handle;

    /// An entry that cannot change, since it lies in flash: it can be read as with a [`Handle`], but not written.
    ///
    /// ```compile_fail,E0308
    /// use edskit_runtime::{Constant, Key, Objects, Position};
    ///
    /// const SERIAL_NUMBER: Constant<u32> = Constant::new(Position(4), Key::new(0x1018, 4));
    ///
    /// fn begin(objects: &mut Objects<'_>) {
    ///     objects.set(SERIAL_NUMBER, 4711);
    /// }
    /// ```
    ///
    /// Nor can its bytes:
    ///
    /// ```compile_fail,E0308
    /// # use edskit_runtime::{Constant, Key, Objects, Position, VisibleString};
    /// const DEVICE_NAME: Constant<VisibleString> = Constant::new(Position(2), Key::new(0x1008, 0));
    ///
    /// fn begin(objects: &mut Objects<'_>) {
    ///     objects.store(DEVICE_NAME, b"Pump").unwrap();
    /// }
    /// ```
    ///
    /// Where the device gives an entry its value at start, the side-file of the EDS says so (`given`), and the entry is a
    /// [`Handle`].
    Constant;
}

impl<T> Handle<T> {
    /// Where the entry is in the table.
    #[must_use]
    pub const fn position(&self) -> Position {
        self.position
    }
}

impl<T> From<Handle<T>> for Position {
    fn from(handle: Handle<T>) -> Self {
        handle.position
    }
}

/// A DOMAIN, whose data the [`Application`](crate::Application) has: it can be recognised by its handle, and neither read
/// nor written.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Domain {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dictionary::testing::entry;

    const TORQUES: [Handle<u16>; 3] = Handle::run(Position(7), Key::new(0x2003, 1));
    const SPEED: Constant<u8> = Constant::new(Position(1), SPEED_KEY);
    const SPEED_KEY: Key = Key::new(0x2000, 0);
    const SECOND_KEY: Key = TORQUES[1].key();

    #[test]
    fn a_run_counts_positions_and_sub_indices() {
        let places = TORQUES.map(|torque| (torque.position().0, torque.key().sub_index.0));
        assert_eq!(places, [(7, 1), (8, 2), (9, 3)]);
    }

    #[test]
    fn an_entry_is_compared_without_numbers() {
        let (speed, second) = (entry(0x2000, 0), entry(0x2003, 2));
        assert!(speed.is(SPEED) && !second.is(SPEED) && !speed.is(TORQUES[1]));
        assert_eq!((second.place_in(&TORQUES), speed.place_in(&TORQUES)), (Some(1), None));
        let name = |entry: &crate::Entry| match entry.key() {
            SPEED_KEY => "speed",
            SECOND_KEY => "second",
            _ => "none",
        };
        assert_eq!([name(&speed), name(&second), name(&entry(0x2003, 1))], ["speed", "second", "none"]);
    }
}
