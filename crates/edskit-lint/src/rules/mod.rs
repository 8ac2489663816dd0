//! The rules, one file each, in a folder for each group.

pub mod cob_id;
pub mod communication;
pub mod configuration;
pub mod device_info;
pub mod file_info;
pub mod lists;
pub mod modules;
pub mod node_list;
pub mod objects;
pub mod pdo;
pub mod profile;
pub mod style;
pub mod syntax;
pub mod values;

use crate::Rule;
use std::sync::LazyLock;

/// Every rule, sorted by code within its group.
pub static ALL: LazyLock<Vec<&'static Rule>> = LazyLock::new(|| {
    let groups = [
        syntax::RULES,
        file_info::RULES,
        device_info::RULES,
        lists::RULES,
        objects::RULES,
        values::RULES,
        communication::RULES,
        pdo::RULES,
        cob_id::RULES,
        configuration::RULES,
        modules::RULES,
        node_list::RULES,
        profile::RULES,
        style::RULES,
    ];
    groups.concat()
});

#[cfg(test)]
mod tests;
