//! Rights on objects.

use core::fmt;

/// Access attribute of an object (`AccessType` in an EDS, CiA 306-1).
///
/// SDO access is seen from the bus. `rwr` and `rww` exist only in EDS and DCF files; they are `rw` with one
/// PDO direction.
///
/// | word | SDO | PDO |
/// |---|---|---|
/// | `ro` | read | TPDO |
/// | `wo` | write | RPDO |
/// | `rw` | read and write | TPDO and RPDO |
/// | `rwr` | read and write | TPDO |
/// | `rww` | read and write | RPDO |
/// | `const` | read, constant value | TPDO |
///
/// ```
/// use edskit_types::AccessType;
///
/// let access = AccessType::parse(b"RWW").unwrap();
/// assert_eq!(access, AccessType::Rww);
/// assert!(access.allows_rpdo() && !access.allows_tpdo());
/// assert_eq!(AccessType::parse(b"r/w"), None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum AccessType {
    /// `ro`: read only.
    Ro,
    /// `wo`: write only.
    Wo,
    /// `rw`: read and write.
    Rw,
    /// `rwr`: read and write; in PDOs, only read (TPDO).
    Rwr,
    /// `rww`: read and write; in PDOs, only written (RPDO).
    Rww,
    /// `const`: read only, and the value does not change.
    Const,
}

impl AccessType {
    /// All access attributes.
    pub const ALL: &'static [AccessType] = &[
        AccessType::Ro,
        AccessType::Wo,
        AccessType::Rw,
        AccessType::Rwr,
        AccessType::Rww,
        AccessType::Const,
    ];

    /// The attribute of a word. ASCII case does not matter; surrounding white space does, and gives `None`.
    #[must_use]
    pub fn parse(word: &[u8]) -> Option<Self> {
        Self::ALL.iter().copied().find(|access| access.as_str().as_bytes().eq_ignore_ascii_case(word))
    }

    /// The word in lower case.
    #[must_use]
    pub const fn as_str(self) -> &'static str {
        match self {
            AccessType::Ro => "ro",
            AccessType::Wo => "wo",
            AccessType::Rw => "rw",
            AccessType::Rwr => "rwr",
            AccessType::Rww => "rww",
            AccessType::Const => "const",
        }
    }

    /// Whether an SDO client may read the object.
    #[must_use]
    pub const fn is_readable(self) -> bool {
        !matches!(self, AccessType::Wo)
    }

    /// Whether an SDO client may write the object.
    #[must_use]
    pub const fn is_writable(self) -> bool {
        matches!(self, AccessType::Wo | AccessType::Rw | AccessType::Rwr | AccessType::Rww)
    }

    /// Whether the object may be mapped into a TPDO, if it may be mapped at all.
    #[must_use]
    pub const fn allows_tpdo(self) -> bool {
        matches!(self, AccessType::Ro | AccessType::Rw | AccessType::Rwr | AccessType::Const)
    }

    /// Whether the object may be mapped into an RPDO, if it may be mapped at all.
    #[must_use]
    pub const fn allows_rpdo(self) -> bool {
        matches!(self, AccessType::Wo | AccessType::Rw | AccessType::Rww)
    }
}

/// The word in lower case.
impl fmt::Display for AccessType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.as_str())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::string::ToString;

    #[test]
    fn rights() {
        // Attribute, SDO read, SDO write, TPDO, RPDO.
        let table = [
            (AccessType::Ro, true, false, true, false),
            (AccessType::Wo, false, true, false, true),
            (AccessType::Rw, true, true, true, true),
            (AccessType::Rwr, true, true, true, false),
            (AccessType::Rww, true, true, false, true),
            (AccessType::Const, true, false, true, false),
        ];
        assert_eq!(table.map(|row| row.0), AccessType::ALL);
        for (access, read, write, tpdo, rpdo) in table {
            assert_eq!(access.is_readable(), read, "{access}");
            assert_eq!(access.is_writable(), write, "{access}");
            assert_eq!(access.allows_tpdo(), tpdo, "{access}");
            assert_eq!(access.allows_rpdo(), rpdo, "{access}");
        }
    }

    #[test]
    fn words_are_exact_except_for_case() {
        for &access in AccessType::ALL {
            let word = access.to_string();
            assert_eq!(AccessType::parse(word.as_bytes()), Some(access));
            assert_eq!(AccessType::parse(word.to_ascii_uppercase().as_bytes()), Some(access));
        }
        for word in [&b""[..], b" ro", b"ro ", b"r", b"constant", b"wr", b"rwx", b"r\xF6"] {
            assert_eq!(AccessType::parse(word), None);
        }
    }
}
