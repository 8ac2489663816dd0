//! Reading and writing values.

use super::entry::{Entry, Flags};
use super::handle::{Handle, Readable};
use super::table::{Position, Table};
use super::value::{Value, copy, raw};
use edskit_types::{AbortCode, DataType, Index, NodeId, SubIndex};

/// An object dictionary: what is fixed about it, and its values.
///
/// Rights are those of SDO clients. The device itself may write everything that can change, by [`Objects::set`] and
/// [`Objects::store`], which take a [`Handle`].
#[derive(Debug)]
pub struct Objects<'a> {
    pub(crate) table: &'a Table<'a>,
    pub(crate) values: &'a mut [u8],
}

impl<'a> Objects<'a> {
    /// A dictionary over these values, which are as long as the defaults of the table.
    pub fn new(table: &'a Table<'a>, values: &'a mut [u8]) -> Self {
        Self { table, values }
    }

    /// What is fixed about it.
    #[must_use]
    pub fn table(&self) -> &'a Table<'a> {
        self.table
    }

    /// The value of an entry.
    #[must_use]
    pub fn get<T: Value>(&self, handle: impl Readable<Value = T>) -> T {
        T::from_bytes(self.bytes(handle.entry_position()))
    }

    /// Gives an entry that can change a value. Limits and rights are not looked at: they bind SDO clients.
    pub fn set<T: Value>(&mut self, handle: Handle<T>, value: T) {
        value.to_bytes(self.bytes_mut(handle.position()));
    }

    /// The value at `index` and `sub_index`; `None` where there is no such entry.
    #[must_use]
    pub fn value<T: Value>(&self, index: Index, sub_index: u8) -> Option<T> {
        self.bytes_at(index, sub_index).map(T::from_bytes)
    }

    #[inline(never)]
    fn bytes_at(&self, index: Index, sub_index: u8) -> Option<&[u8]> {
        self.table.find(index, SubIndex(sub_index)).ok().map(|position| self.bytes(position))
    }

    /// Gives the entry at `index` and `sub_index` a value, and says whether there is one that can change.
    pub fn set_value<T: Value>(&mut self, index: Index, sub_index: u8, value: T) -> bool {
        let bytes = self.bytes_mut_at(index, sub_index);
        value.to_bytes(bytes);
        !bytes.is_empty()
    }

    #[inline(never)]
    fn bytes_mut_at(&mut self, index: Index, sub_index: u8) -> &mut [u8] {
        match self.table.find(index, SubIndex(sub_index)) {
            Ok(position) => self.bytes_mut(position),
            Err(_) => &mut [],
        }
    }

    /// The present bytes of an entry: of a text as many as it has; none for a DOMAIN.
    #[must_use]
    pub fn bytes(&self, position: Position) -> &[u8] {
        let Some(entry) = self.table.entry(position) else { return &[] };
        let place = self.place(entry);
        let source = if entry.flags.has(Flags::VARIABLE) { &*self.values } else { self.table.constants };
        source.get(place).unwrap_or_default()
    }

    /// The bytes of an entry that can change; none for one that cannot.
    fn bytes_mut(&mut self, position: Position) -> &mut [u8] {
        self.table.entry(position).map_or(&mut [], |entry| self.bytes_of(entry))
    }

    pub(crate) fn bytes_of(&mut self, entry: &Entry) -> &mut [u8] {
        if !entry.flags.has(Flags::VARIABLE) {
            return &mut [];
        }
        let place = self.place(entry);
        self.values.get_mut(place).unwrap_or_default()
    }

    /// Where the present bytes of an entry lie.
    fn place(&self, entry: &Entry) -> core::ops::Range<usize> {
        let offset = usize::from(entry.offset);
        if !entry.has_length() {
            return offset..offset + usize::from(entry.size);
        }
        let length = match self.values.get(offset..offset + 2) {
            Some(&[low, high]) => u16::from_le_bytes([low, high]),
            _ => 0,
        };
        let start = offset + 2;
        start..start + usize::from(length.min(entry.size))
    }

    /// Whether an SDO client may read the entry.
    ///
    /// # Errors
    /// [`AbortCode::WRITE_ONLY`].
    pub fn check_read(&self, entry: &Entry) -> Result<(), AbortCode> {
        if entry.flags.has(Flags::READ) { Ok(()) } else { Err(AbortCode::WRITE_ONLY) }
    }

    /// Whether an SDO client may write so many bytes; `None` while it has not said how many.
    ///
    /// # Errors
    /// [`AbortCode::READ_ONLY`], [`AbortCode::LENGTH_TOO_HIGH`] and [`AbortCode::LENGTH_TOO_LOW`].
    pub fn check_write(&self, entry: &Entry, length: Option<usize>) -> Result<(), AbortCode> {
        if !entry.flags.has(Flags::WRITE) {
            return Err(AbortCode::READ_ONLY);
        }
        let size = usize::from(entry.size);
        match length {
            _ if entry.data_type == DataType::Domain => Ok(()),
            Some(length) if length > size => Err(AbortCode::LENGTH_TOO_HIGH),
            Some(length) if length < size && !entry.data_type.is_string() => Err(AbortCode::LENGTH_TOO_LOW),
            _ => Ok(()),
        }
    }

    /// Whether a value of the right length is one that the entry may have.
    ///
    /// # Errors
    /// [`AbortCode::VALUE_TOO_HIGH`] and [`AbortCode::VALUE_TOO_LOW`] by the limits of the EDS, and
    /// [`AbortCode::INVALID_VALUE`] for a BOOLEAN that is neither 0 nor 1. What is not a number (NaN) is beyond any limit.
    pub fn check_value(&self, position: Position, entry: &Entry, data: &[u8]) -> Result<(), AbortCode> {
        if entry.data_type == DataType::Boolean && data.first().is_some_and(|byte| *byte > 1) {
            return Err(AbortCode::INVALID_VALUE);
        }
        // Most values have none, and each value of each RPDO is looked at.
        if entry.flags.has(Flags::LIMITED) { self.check_limits(position, entry, data) } else { Ok(()) }
    }

    #[inline(never)]
    fn check_limits(&self, position: Position, entry: &Entry, data: &[u8]) -> Result<(), AbortCode> {
        let Some(limits) = self.table.limits(position) else { return Ok(()) };
        let data_type = entry.data_type;
        let value = rank(data_type, raw(data, data_type.is_signed()));
        if value < rank(data_type, limits.low) {
            return Err(AbortCode::VALUE_TOO_LOW);
        }
        if value > rank(data_type, limits.high) {
            return Err(AbortCode::VALUE_TOO_HIGH);
        }
        Ok(())
    }

    /// Gives an entry these bytes, of a text as many as fit. Who calls it has checked the length.
    #[inline(never)]
    pub(crate) fn put(&mut self, position: Position, entry: &Entry, data: &[u8]) {
        if entry.has_length() {
            self.set_length(position, data.len().min(usize::from(entry.size)) as u16);
        }
        copy(self.bytes_of(entry), data);
    }

    /// Says how many bytes a text has; of other types nothing can be said.
    pub(crate) fn set_length(&mut self, position: Position, length: u16) {
        let Some(entry) = self.table.entry(position).filter(|entry| entry.has_length()) else { return };
        let offset = usize::from(entry.offset);
        if let Some(prefix) = self.values.get_mut(offset..offset + 2) {
            length.to_bytes(prefix);
        }
    }

    /// Gives all entries that `is_chosen` their values of power-on, for this node-ID; what the device has been given stays.
    pub(crate) fn restore(&mut self, node_id: Option<NodeId>, is_chosen: impl Fn(Index) -> bool) {
        for (position, entry) in self.table.all() {
            if entry.flags.is_restored() && is_chosen(entry.index) {
                self.restore_entry(position, entry, node_id);
            }
        }
    }

    /// Gives an entry that can change its value of power-on.
    pub(crate) fn restore_entry(&mut self, position: Position, entry: &Entry, node_id: Option<NodeId>) {
        let start = usize::from(entry.offset);
        let whole = start..start + usize::from(entry.size) + if entry.has_length() { 2 } else { 0 };
        if let (Some(value), Some(default)) =
            (self.values.get_mut(whole.clone()), self.table.defaults.get(whole))
        {
            copy(value, default);
        }
        if entry.flags.has(Flags::NODE_RELATIVE) {
            self.add_node_id(position, node_id);
        }
    }

    /// Adds the node-ID to a value that is an offset to it.
    pub(crate) fn add_node_id(&mut self, position: Position, node_id: Option<NodeId>) {
        let offset = u64::from_bytes(self.bytes(position));
        let own = node_id.map_or(0, |node_id| u64::from(node_id.get()));
        offset.wrapping_add(own).to_bytes(self.bytes_mut(position));
    }

    /// The default of an entry that can change, where its value is that default for this node-ID and follows the node-ID.
    pub(crate) fn node_relative(
        &self,
        position: Position,
        entry: &Entry,
        node_id: Option<NodeId>,
    ) -> Option<&[u8]> {
        if !entry.flags.has(Flags::NODE_RELATIVE) {
            return None;
        }
        let default = self.table.defaults.get(self.place(entry))?;
        let own = node_id.map_or(0, |node_id| u64::from(node_id.get()));
        let mut expected = [0; 8];
        let expected = expected.get_mut(..default.len())?;
        u64::from_bytes(default).wrapping_add(own).to_bytes(expected);
        (self.bytes(position) == expected).then_some(default)
    }
}

/// A number that is the higher the higher the value with these bits is. It orders reals without floating-point
/// instructions, which small processors do not have.
fn rank(data_type: DataType, bits: u64) -> u64 {
    const SIGN: u64 = 1 << 63;
    let signed = match data_type {
        DataType::Real32 => return rank(DataType::Real64, bits << 32),
        DataType::Real64 if bits & SIGN != 0 => (bits & !SIGN).wrapping_neg(),
        DataType::Real64 => bits,
        data_type if data_type.is_signed() => bits,
        _ => return bits,
    };
    signed ^ SIGN
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dictionary::{Key, Limits, testing::table};

    fn entry(data_type: DataType, flags: Flags, offset: u16, size: u16) -> Entry {
        Entry { index: Index(0x2000), sub_index: SubIndex(0), data_type, flags, offset, size }
    }

    const VARIABLE: Flags = Flags::READ.and(Flags::WRITE).and(Flags::VARIABLE);

    #[test]
    fn a_text_knows_its_length() {
        let entries = [entry(DataType::VisibleString, VARIABLE, 1, 4)];
        let defaults = [0xAA, 2, 0, b'o', b'k', 0, 0, 0xBB];
        let table = Table { defaults: &defaults, ..table(&entries) };
        let mut values = [0; 8];
        let mut objects = Objects::new(&table, &mut values);
        objects.restore(None, |_| true);
        assert_eq!(objects.bytes(Position(0)), b"ok");
        objects.put(Position(0), &entries[0], b"abcdef");
        assert_eq!(objects.bytes(Position(0)), b"abcd");
        objects.put(Position(0), &entries[0], b"");
        assert_eq!(objects.bytes(Position(0)), b"");
        assert_eq!((values[0], values[7]), (0, 0), "the neighbours are not touched");
    }

    #[test]
    fn constants_cannot_change() {
        let entries = [entry(DataType::Unsigned16, Flags::READ, 0, 2)];
        let table = Table { constants: &[0x34, 0x12], ..table(&entries) };
        let mut objects = Objects::new(&table, &mut []);
        let handle = Handle::<u16>::new(Position(0), Key::new(0x2000, 0));
        objects.set(handle, 7);
        assert_eq!(objects.get(handle), 0x1234);
        assert_eq!(objects.check_write(&entries[0], Some(2)), Err(AbortCode::READ_ONLY));
    }

    #[test]
    fn lengths() {
        let number = entry(DataType::Unsigned32, VARIABLE, 0, 4);
        let text = entry(DataType::OctetString, VARIABLE, 0, 4);
        let entries = [number, text];
        let table = table(&entries);
        let objects = Objects::new(&table, &mut []);
        let check = |entry, length| objects.check_write(entry, length);
        assert_eq!(check(&number, Some(5)), Err(AbortCode::LENGTH_TOO_HIGH));
        assert_eq!(check(&number, Some(3)), Err(AbortCode::LENGTH_TOO_LOW));
        assert_eq!([check(&number, Some(4)), check(&number, None), check(&text, Some(0))], [Ok(()); 3]);
        assert_eq!(check(&text, Some(5)), Err(AbortCode::LENGTH_TOO_HIGH));
    }

    #[test]
    fn limits_by_type() {
        let check = |data_type, low: u64, high: u64, data: &[u8]| {
            let entries = [entry(data_type, VARIABLE.and(Flags::LIMITED), 0, data.len() as u16)];
            let limits = [Limits { position: Position(0), low, high }];
            let table = Table { limits: &limits, ..table(&entries) };
            Objects::new(&table, &mut []).check_value(Position(0), &entries[0], data)
        };
        let minus = |number: i64| number as u64;
        assert_eq!(check(DataType::Integer8, minus(-5), 5, &[0xFA]), Err(AbortCode::VALUE_TOO_LOW));
        assert_eq!(check(DataType::Integer8, minus(-5), 5, &[6]), Err(AbortCode::VALUE_TOO_HIGH));
        assert_eq!(check(DataType::Integer8, minus(-5), 5, &[0xFB]), Ok(()));
        assert_eq!(check(DataType::Unsigned8, 0, 0xF0, &[0xFA]), Err(AbortCode::VALUE_TOO_HIGH));
        assert_eq!(
            check(DataType::Integer24, minus(-1), 1, &[0xFE, 0xFF, 0xFF]),
            Err(AbortCode::VALUE_TOO_LOW)
        );
        let real = |value: f32| u64::from(value.to_bits());
        assert_eq!(
            check(DataType::Real32, real(-1.0), real(1.0), &(-2.0_f32).to_le_bytes()),
            Err(AbortCode::VALUE_TOO_LOW)
        );
        assert_eq!(
            check(DataType::Real64, (-1.0_f64).to_bits(), 1.0_f64.to_bits(), &2.0_f64.to_le_bytes()),
            Err(AbortCode::VALUE_TOO_HIGH)
        );
        let within = |value: f32| check(DataType::Real32, real(0.0), real(1.5), &value.to_le_bytes());
        assert_eq!([within(-0.0), within(0.0), within(1.5), within(f32::MIN_POSITIVE)], [Ok(()); 4]);
        assert_eq!(
            [within(-f32::MIN_POSITIVE), within(1.500_001), within(f32::NAN)],
            [Err(AbortCode::VALUE_TOO_LOW), Err(AbortCode::VALUE_TOO_HIGH), Err(AbortCode::VALUE_TOO_HIGH)]
        );
    }

    #[test]
    fn defaults_follow_the_node_id() {
        let other = Entry { index: Index(0x2001), ..entry(DataType::Unsigned16, VARIABLE, 4, 2) };
        let entries = [entry(DataType::Unsigned32, VARIABLE.and(Flags::NODE_RELATIVE), 0, 4), other];
        let defaults = [0x80, 1, 0, 0x40, 0xE8, 3];
        let table = Table { defaults: &defaults, ..table(&entries) };
        let mut values = [0; 6];
        let mut objects = Objects::new(&table, &mut values);
        objects.restore(NodeId::new(5).ok(), |index| index == Index(0x2000));
        let cob_id = Handle::<u32>::new(Position(0), Key::new(0x2000, 0));
        let time = Handle::<u16>::new(Position(1), Key::new(0x2001, 0));
        assert_eq!((objects.get(cob_id), objects.get(time)), (0x4000_0185, 0));
        objects.restore(NodeId::new(6).ok(), |_| true);
        assert_eq!((objects.get(cob_id), objects.get(time)), (0x4000_0186, 1000));
    }
}
