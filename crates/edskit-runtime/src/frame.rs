//! A frame on the bus.

use edskit_types::CanId;
use embedded_can::{ExtendedId, Id, StandardId};

/// The most data bytes of a frame.
pub const MOST_DATA: usize = 8;

/// A classic CAN frame. It implements [`embedded_can::Frame`], as those of any HAL do; [`Frame::of`] turns one into
/// the other.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Frame {
    can_id: CanId,
    is_remote: bool,
    length: u8,
    data: [u8; MOST_DATA],
}

impl Frame {
    /// What stands where there is no frame.
    pub(crate) const NONE: Self =
        Self { can_id: CanId::NMT, is_remote: false, length: 0, data: [0; MOST_DATA] };

    /// A data frame; bytes beyond the eighth are left out.
    #[must_use]
    pub fn new(can_id: CanId, data: &[u8]) -> Self {
        // Most frames are full, and a full one is copied at once.
        if let Ok(data) = data.try_into() {
            return Self { can_id, is_remote: false, length: MOST_DATA as u8, data };
        }
        let mut frame = Self { can_id, is_remote: false, length: 0, data: [0; MOST_DATA] };
        for (place, byte) in frame.data.iter_mut().zip(data) {
            *place = *byte;
            frame.length += 1;
        }
        frame
    }

    /// A remote frame that asks for `length` bytes, at most 8.
    #[must_use]
    pub fn remote(can_id: CanId, length: u8) -> Self {
        Self { can_id, is_remote: true, length: length.min(MOST_DATA as u8), data: [0; MOST_DATA] }
    }

    /// The same frame of another type, that of a HAL say.
    #[must_use]
    pub fn of(other: &impl embedded_can::Frame) -> Self {
        let can_id = can_id_of(other.id());
        if other.is_remote_frame() {
            Self::remote(can_id, other.dlc().min(MOST_DATA) as u8)
        } else {
            Self::new(can_id, other.data())
        }
    }

    /// The identifier.
    #[must_use]
    pub fn can_id(&self) -> CanId {
        self.can_id
    }

    /// Whether the frame asks for data instead of holding some.
    #[must_use]
    pub fn is_remote(&self) -> bool {
        self.is_remote
    }

    /// The data; none for a remote frame.
    #[must_use]
    pub fn data(&self) -> &[u8] {
        let length = if self.is_remote { 0 } else { usize::from(self.length) };
        self.data.get(..length).unwrap_or_default()
    }

    /// The data length code.
    #[must_use]
    pub fn length(&self) -> u8 {
        self.length
    }

    /// The data, if there are exactly eight bytes of them, as SDO and LSS demand.
    pub(crate) fn eight(&self) -> Option<[u8; MOST_DATA]> {
        (!self.is_remote && usize::from(self.length) == MOST_DATA).then_some(self.data)
    }
}

/// The identifier of a HAL as one of CANopen.
fn can_id_of(id: Id) -> CanId {
    // Both kinds of identifiers are range-checked by their types, so the fallback is never taken.
    match id {
        Id::Standard(id) => CanId::standard(id.as_raw()),
        Id::Extended(id) => CanId::extended(id.as_raw()),
    }
    .unwrap_or(CanId::NMT)
}

impl embedded_can::Frame for Frame {
    fn new(id: impl Into<Id>, data: &[u8]) -> Option<Self> {
        (data.len() <= MOST_DATA).then(|| Self::new(can_id_of(id.into()), data))
    }

    fn new_remote(id: impl Into<Id>, dlc: usize) -> Option<Self> {
        (dlc <= MOST_DATA).then(|| Self::remote(can_id_of(id.into()), dlc as u8))
    }

    fn is_extended(&self) -> bool {
        self.can_id.is_extended()
    }

    fn is_remote_frame(&self) -> bool {
        self.is_remote
    }

    fn id(&self) -> Id {
        let raw = self.can_id.raw();
        if self.can_id.is_extended() {
            ExtendedId::new(raw).map_or(Id::Extended(ExtendedId::ZERO), Id::Extended)
        } else {
            StandardId::new(raw as u16).map_or(Id::Standard(StandardId::ZERO), Id::Standard)
        }
    }

    fn dlc(&self) -> usize {
        usize::from(self.length)
    }

    fn data(&self) -> &[u8] {
        self.data()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use embedded_can::Frame as _;

    fn standard(id: u16) -> CanId {
        CanId::standard(id).unwrap()
    }

    #[test]
    fn frames_go_through_embedded_can_unchanged() {
        let frames = [
            Frame::new(standard(0x581), &[1, 2, 3]),
            Frame::new(CanId::extended(0x1234_5678).unwrap(), &[9; 8]),
            Frame::remote(standard(0x701), 1),
            Frame::new(standard(0x80), &[]),
        ];
        for frame in frames {
            assert_eq!(Frame::of(&frame), frame);
            assert_eq!(frame.dlc(), usize::from(frame.length()));
        }
    }

    #[test]
    fn no_frame_is_longer_than_eight_bytes() {
        assert_eq!(Frame::new(standard(1), &[7; 12]).data(), [7; 8]);
        assert_eq!(Frame::remote(standard(1), 15).length(), 8);
        let id = StandardId::new(5).unwrap();
        assert_eq!(<Frame as embedded_can::Frame>::new(id, &[0; 9]), None);
        assert_eq!(<Frame as embedded_can::Frame>::new_remote(id, 9), None);
    }

    #[test]
    fn a_remote_frame_has_no_data() {
        assert!(Frame::remote(standard(1), 8).data().is_empty());
        assert_eq!(Frame::remote(standard(1), 8).eight(), None);
        assert_eq!(Frame::new(standard(1), &[3; 8]).eight(), Some([3; 8]));
    }
}
