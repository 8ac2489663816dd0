//! How large the objects with process data are.

use super::table::PdoTable;

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
            digital_outputs: self.highest_sub_index(0x2000).max(6),
            unsigned_analog_outputs: self.highest_sub_index(0x2001),
            signed_analog_outputs: self.highest_sub_index(0x2002),
            digital_inputs: self.highest_sub_index(0x2003),
            analog_inputs: self.highest_sub_index(0x2004),
        }
    }

    fn highest_sub_index(&self, index: u16) -> u8 {
        let mapped = self.iter().flat_map(|pdo| pdo.words()).map(|word| word.object);
        mapped
            .filter(|object| object.index().0 == index)
            .map(|object| object.sub_index().0)
            .max()
            .unwrap_or(0)
    }
}
