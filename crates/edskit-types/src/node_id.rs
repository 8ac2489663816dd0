//! Addresses of devices.

use core::fmt;

/// Node-ID of a CANopen device, 1 to 127.
///
/// 0 addresses all devices in NMT commands, and CiA 305 uses 255 for "not configured"; neither is a node-ID.
///
/// ```
/// use edskit_types::{InvalidNodeId, NodeId};
///
/// let node = NodeId::new(5)?;
/// assert_eq!(0x180 + u16::from(node.get()), 0x185);
/// assert_eq!(NodeId::new(128), Err(InvalidNodeId(128)));
/// # Ok::<(), InvalidNodeId>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct NodeId(u8);

impl NodeId {
    /// The lowest node-ID, 1.
    pub const MIN: NodeId = NodeId(1);
    /// The highest node-ID, 127.
    pub const MAX: NodeId = NodeId(127);

    /// Checks a number.
    ///
    /// # Errors
    ///
    /// [`InvalidNodeId`] if `value` is not in 1 to 127.
    pub const fn new(value: u8) -> Result<NodeId, InvalidNodeId> {
        match value {
            1..=127 => Ok(NodeId(value)),
            _ => Err(InvalidNodeId(value)),
        }
    }

    /// The number, 1 to 127.
    #[must_use]
    pub const fn get(self) -> u8 {
        self.0
    }
}

impl TryFrom<u8> for NodeId {
    type Error = InvalidNodeId;

    fn try_from(value: u8) -> Result<Self, Self::Error> {
        NodeId::new(value)
    }
}

impl From<NodeId> for u8 {
    fn from(node_id: NodeId) -> Self {
        node_id.0
    }
}

/// Decimal, as node-IDs are printed on devices.
impl fmt::Display for NodeId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.0, f)
    }
}

/// A number that is no node-ID: 0, or above 127.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct InvalidNodeId(pub u8);

impl fmt::Display for InvalidNodeId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} is not a node-ID (1 to 127)", self.0)
    }
}

impl core::error::Error for InvalidNodeId {}

#[cfg(test)]
mod tests {
    use super::*;
    use std::string::ToString;

    #[test]
    fn exactly_1_to_127_are_accepted() {
        for value in 0..=u8::MAX {
            let expected = (1..=127).contains(&value);
            assert_eq!(NodeId::new(value).is_ok(), expected, "{value}");
            assert_eq!(NodeId::try_from(value), NodeId::new(value));
            if let Ok(node_id) = NodeId::new(value) {
                assert_eq!(node_id.get(), value);
                assert_eq!(u8::from(node_id), value);
            }
        }
        assert_eq!(NodeId::new(1), Ok(NodeId::MIN));
        assert_eq!(NodeId::new(127), Ok(NodeId::MAX));
    }

    #[test]
    fn notation() {
        assert_eq!(NodeId::MAX.to_string(), "127");
        assert_eq!(InvalidNodeId(0).to_string(), "0 is not a node-ID (1 to 127)");
    }
}
