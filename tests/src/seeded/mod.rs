//! Defects that are put into clean files, to see that the linter notices each of them.
//!
//! A [`Defect`] is one kind of mistake with the rule that has to report it. It finds its places in every [`Base`] by
//! itself, so that a new file in `eds/` is covered without a change here.

mod base;
mod defect;
mod dictionary;
mod mutant;

mod cob_id;
mod communication;
mod configuration;
mod device_info;
mod file_info;
mod lists;
mod modules;
mod node_list;
mod objects;
mod pdo;
mod pdo_mapping;
mod profile;
mod style;
mod syntax;
mod syntax_values;
mod values;

pub use base::{Base, Entry, Kind, Section, bases};
pub use defect::{Defect, MOST_PLACES};
pub use mutant::Mutant;

/// Every kind of defect, in the order of the rules' groups.
pub fn defects() -> Vec<Defect> {
    let groups = [
        syntax::defects,
        syntax_values::defects,
        file_info::defects,
        device_info::defects,
        lists::defects,
        objects::defects,
        values::defects,
        communication::defects,
        pdo::defects,
        pdo_mapping::defects,
        cob_id::defects,
        configuration::defects,
        modules::defects,
        node_list::defects,
        profile::defects,
        style::defects,
    ];
    groups.iter().flat_map(|group| group()).collect()
}
