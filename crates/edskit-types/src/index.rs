//! Places in the object dictionary.

use core::fmt;

/// Index of an object in the object dictionary, 0000h to FFFFh (CiA 301, 7.4.1).
///
/// Every value is accepted; [`Index::area`] tells what the value is reserved for.
/// [`Display`](fmt::Display) writes the notation of the standards: four upper-case digits and `h`.
///
/// ```
/// use edskit_types::{Index, ObjectArea};
///
/// assert_eq!(Index(0x1018).to_string(), "1018h");
/// assert_eq!(Index(0x6040).area(), ObjectArea::Profile);
/// assert!(Index(0x1A03).is_tpdo_mapping());
/// ```
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Index(pub u16);

impl Index {
    /// 1000h: device profile number and additional information.
    pub const DEVICE_TYPE: Index = Index(0x1000);
    /// 1001h: error register, one bit per class of error.
    pub const ERROR_REGISTER: Index = Index(0x1001);
    /// 1003h: pre-defined error field, the history of emergency codes.
    pub const PREDEFINED_ERROR_FIELD: Index = Index(0x1003);
    /// 1005h: COB-ID of the SYNC message.
    pub const SYNC_COB_ID: Index = Index(0x1005);
    /// 1010h: store parameters.
    pub const STORE_PARAMETERS: Index = Index(0x1010);
    /// 1011h: restore default parameters.
    pub const RESTORE_PARAMETERS: Index = Index(0x1011);
    /// 1014h: COB-ID of the emergency message.
    pub const EMCY_COB_ID: Index = Index(0x1014);
    /// 1016h: consumer heartbeat times, in ms.
    pub const CONSUMER_HEARTBEAT: Index = Index(0x1016);
    /// 1017h: producer heartbeat time, in ms; 0 switches it off.
    pub const PRODUCER_HEARTBEAT: Index = Index(0x1017);
    /// 1018h: identity object (vendor-ID, product code, revision, serial number).
    pub const IDENTITY: Index = Index(0x1018);
    /// 1200h: first of the SDO server parameters, 1200h to 127Fh.
    pub const SDO_SERVER: Index = Index(0x1200);
    /// 1280h: first of the SDO client parameters, 1280h to 12FFh.
    pub const SDO_CLIENT: Index = Index(0x1280);
    /// 1400h: first of the RPDO communication parameters, 1400h to 15FFh.
    pub const RPDO_COMMUNICATION: Index = Index(0x1400);
    /// 1600h: first of the RPDO mapping parameters, 1600h to 17FFh.
    pub const RPDO_MAPPING: Index = Index(0x1600);
    /// 1800h: first of the TPDO communication parameters, 1800h to 19FFh.
    pub const TPDO_COMMUNICATION: Index = Index(0x1800);
    /// 1A00h: first of the TPDO mapping parameters, 1A00h to 1BFFh.
    pub const TPDO_MAPPING: Index = Index(0x1A00);

    /// The area of the object dictionary that holds this index (CiA 301, 7.4.1).
    #[must_use]
    pub const fn area(self) -> ObjectArea {
        match self.0 {
            0x0001..=0x001F => ObjectArea::StaticDataType,
            0x0020..=0x003F => ObjectArea::ComplexDataType,
            0x0040..=0x005F => ObjectArea::ManufacturerDataType,
            0x0060..=0x025F => ObjectArea::ProfileDataType,
            0x1000..=0x1FFF => ObjectArea::Communication,
            0x2000..=0x5FFF => ObjectArea::Manufacturer,
            0x6000..=0x9FFF => ObjectArea::Profile,
            0xA000..=0xAFFF => ObjectArea::NetworkVariable,
            0xB000..=0xBFFF => ObjectArea::SystemVariable,
            0x0000 | 0x0260..=0x0FFF | 0xC000..=0xFFFF => ObjectArea::Reserved,
        }
    }

    /// Whether this is the communication parameter of an RPDO, 1400h to 15FFh.
    #[must_use]
    pub const fn is_rpdo_communication(self) -> bool {
        matches!(self.0, 0x1400..=0x15FF)
    }

    /// Whether this is the mapping parameter of an RPDO, 1600h to 17FFh.
    #[must_use]
    pub const fn is_rpdo_mapping(self) -> bool {
        matches!(self.0, 0x1600..=0x17FF)
    }

    /// Whether this is the communication parameter of a TPDO, 1800h to 19FFh.
    #[must_use]
    pub const fn is_tpdo_communication(self) -> bool {
        matches!(self.0, 0x1800..=0x19FF)
    }

    /// Whether this is the mapping parameter of a TPDO, 1A00h to 1BFFh.
    #[must_use]
    pub const fn is_tpdo_mapping(self) -> bool {
        matches!(self.0, 0x1A00..=0x1BFF)
    }
}

impl From<u16> for Index {
    fn from(value: u16) -> Self {
        Index(value)
    }
}

impl fmt::Display for Index {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:04X}h", self.0)
    }
}

/// `Index(1018h)`: a decimal index helps nobody.
impl fmt::Debug for Index {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Index({self})")
    }
}

/// Bare digits; width, zero padding and `#` work as on `u16`.
impl fmt::LowerHex for Index {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::LowerHex::fmt(&self.0, f)
    }
}

/// Bare digits; width, zero padding and `#` work as on `u16`.
impl fmt::UpperHex for Index {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::UpperHex::fmt(&self.0, f)
    }
}

/// Sub-index of an entry of an object, 00h to FFh (CiA 301).
///
/// In arrays and records 00h holds the highest sub-index in use and FFh, if present, the structure of the
/// object.
///
/// ```
/// assert_eq!(edskit_types::SubIndex(0x0A).to_string(), "0Ah");
/// ```
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SubIndex(pub u8);

impl From<u8> for SubIndex {
    fn from(value: u8) -> Self {
        SubIndex(value)
    }
}

impl fmt::Display for SubIndex {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:02X}h", self.0)
    }
}

/// `SubIndex(0Ah)`, in the notation of [`Index`].
impl fmt::Debug for SubIndex {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "SubIndex({self})")
    }
}

/// Bare digits; width, zero padding and `#` work as on `u8`.
impl fmt::LowerHex for SubIndex {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::LowerHex::fmt(&self.0, f)
    }
}

/// Bare digits; width, zero padding and `#` work as on `u8`.
impl fmt::UpperHex for SubIndex {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::UpperHex::fmt(&self.0, f)
    }
}

/// Areas of the object dictionary (CiA 301, 7.4.1).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ObjectArea {
    /// 0000h (not used), 0260h to 0FFFh and C000h to FFFFh.
    Reserved,
    /// 0001h to 001Fh: static data types, such as UNSIGNED8.
    StaticDataType,
    /// 0020h to 003Fh: complex data types, such as IDENTITY.
    ComplexDataType,
    /// 0040h to 005Fh: complex data types of the manufacturer.
    ManufacturerDataType,
    /// 0060h to 025Fh: data types of device profiles.
    ProfileDataType,
    /// 1000h to 1FFFh: communication profile.
    Communication,
    /// 2000h to 5FFFh: manufacturer-specific objects.
    Manufacturer,
    /// 6000h to 9FFFh: standardised device profiles, eight logical devices of 800h objects each.
    Profile,
    /// A000h to AFFFh: network variables (CiA 302-4, CiA 405).
    NetworkVariable,
    /// B000h to BFFFh: system variables.
    SystemVariable,
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::format;

    #[test]
    fn areas_change_exactly_at_their_borders() {
        let borders = [
            (0x0000, 0x0000, ObjectArea::Reserved),
            (0x0001, 0x001F, ObjectArea::StaticDataType),
            (0x0020, 0x003F, ObjectArea::ComplexDataType),
            (0x0040, 0x005F, ObjectArea::ManufacturerDataType),
            (0x0060, 0x025F, ObjectArea::ProfileDataType),
            (0x0260, 0x0FFF, ObjectArea::Reserved),
            (0x1000, 0x1FFF, ObjectArea::Communication),
            (0x2000, 0x5FFF, ObjectArea::Manufacturer),
            (0x6000, 0x9FFF, ObjectArea::Profile),
            (0xA000, 0xAFFF, ObjectArea::NetworkVariable),
            (0xB000, 0xBFFF, ObjectArea::SystemVariable),
            (0xC000, 0xFFFF, ObjectArea::Reserved),
        ];
        let mut next = 0u32;
        for (first, last, area) in borders {
            assert_eq!(u32::from(first), next, "the table has a gap");
            for index in first..=last {
                assert_eq!(Index(index).area(), area, "{index:04X}h");
            }
            next = u32::from(last) + 1;
        }
        assert_eq!(next, 0x1_0000);
    }

    #[test]
    fn every_pdo_index_is_one_kind_of_parameter() {
        for index in 0..=u16::MAX {
            let i = Index(index);
            let kinds = [
                i.is_rpdo_communication(),
                i.is_rpdo_mapping(),
                i.is_tpdo_communication(),
                i.is_tpdo_mapping(),
            ];
            let expected = match index {
                0x1400..=0x1BFF => {
                    let mut expected = [false; 4];
                    expected[usize::from((index - 0x1400) / 0x200)] = true;
                    expected
                }
                _ => [false; 4],
            };
            assert_eq!(kinds, expected, "{i}");
        }
    }

    #[test]
    fn constants_open_their_blocks() {
        assert!(Index::RPDO_COMMUNICATION.is_rpdo_communication());
        assert!(Index::RPDO_MAPPING.is_rpdo_mapping());
        assert!(Index::TPDO_COMMUNICATION.is_tpdo_communication());
        assert!(Index::TPDO_MAPPING.is_tpdo_mapping());
    }

    #[test]
    fn notation() {
        assert_eq!(format!("{}", Index(0xA)), "000Ah");
        assert_eq!(format!("{:?}", Index(0x1A00)), "Index(1A00h)");
        assert_eq!(
            format!("{:x} {:04X} {:#06x}", Index(0x1a0), Index(0x1a0), Index(0x1a0)),
            "1a0 01A0 0x01a0"
        );
        assert_eq!(
            format!("{} {:?} {:x} {:02X}", SubIndex(1), SubIndex(0xFE), SubIndex(10), SubIndex(10)),
            { "01h SubIndex(FEh) a 0A" }
        );
        assert_eq!(Index::from(0x1000), Index::DEVICE_TYPE);
        assert_eq!(SubIndex::from(3), SubIndex(3));
    }
}
