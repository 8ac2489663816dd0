//! What is forbidden besides using one CAN-ID twice.

use super::Claim;
use crate::{CanId, CobId};
use core::fmt;

/// Which CAN-IDs may not be used, and who may share one.
///
/// [`conflicts`](super::conflicts) compares all claims with each other in any case.
#[derive(Clone, Copy, Debug)]
pub struct IdentifierRules<'a> {
    /// Ranges that no party with a configurable CAN-ID may use ([`Party::is_configurable`](super::Party)).
    pub restricted: &'a [Restriction],
    /// CAN-IDs that belong to somebody even though the device does not use them. They are compared with each claim,
    /// not with each other.
    pub reserved: &'a [Claim],
    /// Whether two RPDOs may have one CAN-ID; both then take each frame.
    pub rpdos_may_share: bool,
}

/// A range of 11-bit CAN-IDs that is kept free for something.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Restriction {
    /// The first CAN-ID of the range.
    pub first: u16,
    /// The last CAN-ID of the range.
    pub last: u16,
    /// What the range is kept free for.
    pub purpose: &'static str,
}

impl Restriction {
    /// Whether an identifier lies in the range. Identifiers of 29 bits never do.
    #[must_use]
    pub const fn contains(&self, can_id: CanId) -> bool {
        !can_id.is_extended() && self.first as u32 <= can_id.raw() && can_id.raw() <= self.last as u32
    }
}

/// `581h to 5FFh (default SDO)`.
impl fmt::Display for Restriction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:03X}h", self.first)?;
        if self.last > self.first {
            write!(f, " to {:03X}h", self.last)?;
        }
        write!(f, " ({})", self.purpose)
    }
}

/// Why a COB-ID cannot be used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CobIdFault {
    /// It has 29 bits, which is not supported.
    Extended,
    /// Bits 28 to 11 are not 0, and bit 29 does not say that they belong to the identifier.
    StrayBits,
    /// A service that exists cannot have this identifier.
    Restricted(CanId, Restriction),
}

/// `the CAN-ID 000h is restricted: 000h (NMT)`.
impl fmt::Display for CobIdFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Extended => f.write_str("CAN-IDs of 29 bits are not supported"),
            Self::StrayBits => f.write_str("bits 28 to 11 are not 0"),
            Self::Restricted(can_id, restriction) => {
                write!(f, "the CAN-ID {can_id} is restricted: {restriction}")
            }
        }
    }
}

impl IdentifierRules<'static> {
    /// The restricted CAN-IDs of CiA 301 (7.3.5): no configurable SYNC, TIME, EMCY, PDO or additional SDO may use
    /// them. The standard does not forbid two RPDOs on one CAN-ID.
    pub const CIA_301: Self = Self {
        restricted: &[
            Restriction { first: 0x000, last: 0x000, purpose: "NMT" },
            Restriction { first: 0x001, last: 0x07F, purpose: "reserved" },
            Restriction { first: 0x101, last: 0x180, purpose: "reserved" },
            Restriction { first: 0x581, last: 0x5FF, purpose: "default SDO" },
            Restriction { first: 0x601, last: 0x67F, purpose: "default SDO" },
            Restriction { first: 0x6E0, last: 0x6FF, purpose: "reserved" },
            Restriction { first: 0x701, last: 0x77F, purpose: "NMT error control" },
            Restriction { first: 0x780, last: 0x7FF, purpose: "reserved" },
        ],
        reserved: &[],
        rpdos_may_share: true,
    };
}

impl IdentifierRules<'_> {
    /// The restricted range that an identifier lies in.
    ///
    /// ```
    /// use edskit_types::{CanId, IdentifierRules};
    /// let restriction = |id| IdentifierRules::CIA_301.restriction(CanId::standard(id).unwrap());
    /// assert_eq!(restriction(0x180).unwrap().to_string(), "101h to 180h (reserved)");
    /// assert_eq!(restriction(0x181), None);
    /// ```
    #[must_use]
    pub fn restriction(&self, can_id: CanId) -> Option<Restriction> {
        self.restricted.iter().find(|restriction| restriction.contains(can_id)).copied()
    }

    /// Why a device cannot use a COB-ID, whoever gives it: a client, a store, or the file. Restrictions hold where bit 31
    /// says that the service exists.
    ///
    /// ```
    /// use edskit_types::{CobId, CobIdFault, IdentifierRules};
    /// let fault = |cob_id| IdentifierRules::CIA_301.fault(CobId(cob_id));
    /// assert_eq!(fault(0).unwrap().to_string(), "the CAN-ID 000h is restricted: 000h (NMT)");
    /// assert_eq!(fault(0x1181), Some(CobIdFault::StrayBits));
    /// assert_eq!((fault(0x8000_0000), fault(0x181)), (None, None));
    /// ```
    #[must_use]
    pub fn fault(&self, cob_id: CobId) -> Option<CobIdFault> {
        if cob_id.is_extended() {
            return Some(CobIdFault::Extended);
        }
        if cob_id.has_stray_bits() {
            return Some(CobIdFault::StrayBits);
        }
        let can_id = cob_id.can_id();
        let restriction = self.restriction(can_id).filter(|_| cob_id.is_valid())?;
        Some(CobIdFault::Restricted(can_id, restriction))
    }
}
