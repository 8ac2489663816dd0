//! Node-ID and bit rate at power-on.

use crate::Settings;
use crate::lss::Lss;
use crate::records::{Reader, Record, Storage};
use edskit_types::{Bitrate, NodeId};

/// What tells the error of a lost record apart from those of groups of parameters.
pub(crate) const SOURCE: u16 = 0;

/// Node-ID and bit rate of a device: what LSS stores together, and what counts from power-on.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Commissioning {
    /// The node-ID; `None` where the node waits for one.
    pub node_id: Option<NodeId>,
    /// The bit rate; `None` where LSS has stored none, so that it is up to the device.
    pub bit_rate: Option<Bitrate>,
}

impl Commissioning {
    /// What a node with this storage and these settings will have at power-on. A firmware needs the bit rate before its CAN
    /// controller, and so its node, can begin.
    ///
    /// What LSS has stored counts, a bit rate only if it is one of the settings. The node-ID is that of the settings where
    /// nothing is stored or the record is torn, and where the device has no LSS.
    ///
    /// ```
    /// use edskit_runtime::{Commissioning, NoStorage, Settings};
    ///
    /// let commissioning = Commissioning::stored(&mut NoStorage, &Settings::default());
    /// assert_eq!((commissioning.node_id, commissioning.bit_rate), (Settings::default().node_id, None));
    /// ```
    pub fn stored(storage: &mut dyn Storage, settings: &Settings) -> Self {
        Self::read(storage, settings).0
    }

    /// The same, and whether something was stored that cannot be read.
    pub(crate) fn read(storage: &mut dyn Storage, settings: &Settings) -> (Self, bool) {
        let none = Self { node_id: settings.node_id, bit_rate: None };
        if !Lss::exists(settings) {
            return (none, false);
        }
        let mut record = [0; 6];
        let length = Reader::new(storage, Record::Lss).read(&mut record);
        let [node_id, not_node_id, low, high, not_low, not_high] = record;
        if length == Ok(0) {
            return (none, false);
        }
        if length != Ok(record.len()) || node_id != !not_node_id || low != !not_low || high != !not_high {
            return (none, true);
        }
        let bit_rate = Bitrate::from_kbit_per_s(u16::from_le_bytes([low, high]).into());
        let bit_rate = bit_rate.filter(|bit_rate| settings.bit_rates.has(*bit_rate));
        (Self { node_id: NodeId::new(node_id).ok(), bit_rate }, false)
    }
}

/// What an LSS master asks a node for that the device may do, or refuse, itself (CiA 305 v2.2).
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum LssRequest {
    /// To enter the configuration state: switch mode global or selective. A refusal is not told to the master.
    Configuration,
    /// To have this node-ID from the next reset on; `None` for none (255).
    NodeId(Option<NodeId>),
    /// To have a bit rate: its index in a table of bit rates, 0 for that of CiA 305, others for those of the manufacturer.
    BitRate {
        /// The table.
        table: u8,
        /// The index.
        index: u8,
    },
    /// To use the configured bit rate after so many milliseconds, and to be silent as long again. There is no answer.
    ActivateBitRate(u16),
    /// To store what is configured.
    Store(Commissioning),
}

/// Who does what an LSS master asks for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum LssAnswer {
    /// The node, as CiA 305 says.
    ByNode,
    /// The device has done it; the master is told success.
    Done,
    /// Nobody: the master is told this error code, 1 for a value that is out of range or not supported, 2 for a failure of
    /// the memory, 255 for an error of the manufacturer.
    Refused(u8),
}
