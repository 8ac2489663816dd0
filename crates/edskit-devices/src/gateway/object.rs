//! The objects with process data: where they are, and how large.

use super::dictionary::canopen_gateway::keys;
use super::table::PdoTable;
use edskit_types::Index;

/// The errors of governor and gateway, and the engine status (5.1.1; GW-OD-13).
pub(super) const DIGITAL_OUTPUTS: Index = keys::DIGITAL_OUTPUTS_NUMBER_OF_ENTRIES.index;
/// Analogue data without sign (5.1.2; GW-OD-15).
pub(super) const UNSIGNED_ANALOG_OUTPUTS: Index = keys::UNSIGNED_ANALOG_OUTPUTS_NUMBER_OF_ENTRIES.index;
/// Analogue data with sign (5.1.3; GW-OD-16).
pub(super) const SIGNED_ANALOG_OUTPUTS: Index = keys::SIGNED_ANALOG_OUTPUTS_NUMBER_OF_ENTRIES.index;
/// Switch functions and error flags of sensors (5.1.4; GW-OD-17).
pub(super) const DIGITAL_INPUTS: Index = keys::DIGITAL_INPUTS_NUMBER_OF_ENTRIES.index;
/// CANopen sensors (5.1.5; GW-OD-18).
pub(super) const ANALOG_INPUTS: Index = keys::ANALOG_INPUTS_NUMBER_OF_ENTRIES.index;

/// Sub-index 00h of 2000h to 2004h after the initialisation (5.1; GW-OD-13 to GW-OD-18).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ObjectSizes {
    /// 2000h: the six words of errors are always there, the engine status only if it is sent (GW-OD-13, GW-OD-14).
    pub digital_outputs: u8,
    /// 2001h.
    pub unsigned_analog_outputs: u8,
    /// 2002h.
    pub signed_analog_outputs: u8,
    /// 2003h.
    pub digital_inputs: u8,
    /// 2004h: the highest channel in use (GW-NOTE-13).
    pub analog_inputs: u8,
}

impl PdoTable {
    /// How many entries the objects with process data have.
    #[must_use]
    pub fn object_sizes(&self) -> ObjectSizes {
        ObjectSizes {
            digital_outputs: self.highest_sub_index(DIGITAL_OUTPUTS).max(6),
            unsigned_analog_outputs: self.highest_sub_index(UNSIGNED_ANALOG_OUTPUTS),
            signed_analog_outputs: self.highest_sub_index(SIGNED_ANALOG_OUTPUTS),
            digital_inputs: self.highest_sub_index(DIGITAL_INPUTS),
            analog_inputs: self.highest_sub_index(ANALOG_INPUTS),
        }
    }

    fn highest_sub_index(&self, index: Index) -> u8 {
        let mapped = self.iter().flat_map(|pdo| pdo.words()).map(|word| word.object);
        mapped.filter(|object| object.index() == index).map(|object| object.sub_index().0).max().unwrap_or(0)
    }
}
