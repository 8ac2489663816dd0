//! The parameters of both units as the PC tool edits them, as they are stored, and as they are in effect.

use super::configuration::{Configuration, OutOfRange};
use super::parameter::{Owner, Parameter, parameters};

/// The parameters of both units. A change takes effect only when its unit has stored it and starts again
/// (chapter 7; GW-CFG-30).
#[derive(Clone, Debug)]
pub(super) struct ParameterMemory {
    edited: Configuration,
    stored: Configuration,
    effective: Configuration,
}

impl ParameterMemory {
    /// A memory in which `stored` is stored.
    pub(super) fn new(stored: Configuration) -> Self {
        Self { edited: stored.clone(), effective: stored.clone(), stored }
    }

    /// What the PC tool shows.
    pub(super) fn edited(&self) -> &Configuration {
        &self.edited
    }

    /// What the units work with.
    pub(super) fn effective(&self) -> &Configuration {
        &self.effective
    }

    /// The PC tool changes a parameter.
    pub(super) fn set(&mut self, parameter: Parameter, value: i32) -> Result<(), OutOfRange> {
        self.edited.set(parameter, value)
    }

    /// The PC tool has a unit store its parameters.
    pub(super) fn store(&mut self, owner: Owner) {
        copy(&self.edited, &mut self.stored, owner);
    }

    /// A unit starts: what it has stored takes effect, and what was not stored is lost.
    pub(super) fn start(&mut self, owner: Owner) {
        copy(&self.stored, &mut self.edited, owner);
        copy(&self.stored, &mut self.effective, owner);
    }

    /// A unit starts and cannot read its memory: the defaults take effect (9.4; GW-APP-35).
    pub(super) fn start_with_defaults(&mut self, owner: Owner) {
        let defaults = Configuration::new();
        copy(&defaults, &mut self.edited, owner);
        copy(&defaults, &mut self.effective, owner);
    }
}

/// Copies the parameters of one unit.
fn copy(from: &Configuration, to: &mut Configuration, owner: Owner) {
    for parameter in parameters().filter(|parameter| parameter.owner() == owner) {
        to.copy(parameter, from);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    // GW-CFG-30
    #[test]
    fn a_change_needs_storing_and_a_start_of_its_unit() {
        let mut memory = ParameterMemory::new(Configuration::new());
        memory.set(Parameter::MY_NODE_ID, 9).unwrap();
        memory.set(Parameter::SEND_ERRORS, 1).unwrap();
        memory.store(Owner::Gateway);
        let node_id = |memory: &ParameterMemory| memory.effective().get(Parameter::MY_NODE_ID);
        assert_eq!((node_id(&memory), memory.edited().get(Parameter::MY_NODE_ID)), (1, 9));
        memory.start(Owner::Governor);
        assert_eq!(node_id(&memory), 1, "the other unit has started");
        assert_eq!(memory.edited().get(Parameter::SEND_ERRORS), 0, "not stored, so lost");
        memory.start(Owner::Gateway);
        assert_eq!(node_id(&memory), 9);
        memory.start_with_defaults(Owner::Gateway);
        assert_eq!(node_id(&memory), 1);
    }
}
