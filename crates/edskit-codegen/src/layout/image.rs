//! The images that hold the values: constants in flash, and what the others are at power-on.

use super::gather::Item;
use super::{MOST_BYTES, fixed_size};
use crate::SideFile;
use edskit_runtime::{Entry, Flags};
use edskit_types::{AccessType, DataType, Index, SubIndex};
use std::collections::BTreeMap;

/// How many bytes a text can have that clients may write, where nobody says more.
const CAPACITY: usize = 32;

#[derive(Default)]
pub(super) struct Images {
    pub(super) constants: Vec<u8>,
    pub(super) defaults: Vec<u8>,
    /// Where each sequence of bytes lies in the constants: equal ones lie there once.
    places: BTreeMap<Vec<u8>, usize>,
}

impl Images {
    /// Gives the value of an entry its place; false where the image is full.
    pub(super) fn place(&mut self, item: &Item, side_file: &SideFile) -> (Entry, bool) {
        let capacity = side_file.capacity(item.index, item.sub_index).filter(|_| item.data_type.is_string());
        let is_received = side_file.is_received(item.index, item.sub_index) && can_be_carried(item);
        let is_given = side_file.is_given(item.index, item.sub_index);
        let is_changed = side_file.is_variable(item.index, item.sub_index) || is_given;
        let is_said = is_changed || is_received || capacity.is_some();
        let is_variable = is_variable(item, is_said);
        let mut flags = rights(item);
        if is_received {
            flags = flags.and(Flags::RPDO);
        }
        let default = item.default.as_ref().map_or(&[][..], |default| &default.bytes);
        let (offset, size, is_within);
        if is_variable {
            flags = flags.and(Flags::VARIABLE);
            offset = self.defaults.len();
            let own = if item.access.is_writable() { CAPACITY } else { 0 };
            let of_text = || capacity.map_or(own, usize::from).max(default.len());
            size = fixed_size(item.data_type).map_or_else(of_text, usize::from);
            if item.data_type.is_string() {
                self.defaults.extend_from_slice(&(default.len() as u16).to_le_bytes());
            }
            let start = self.defaults.len();
            self.defaults.extend_from_slice(default);
            self.defaults.resize(start + size, 0);
            is_within = self.defaults.len() <= MOST_BYTES;
        } else {
            let mut bytes = default.to_vec();
            if let Some(size) = fixed_size(item.data_type) {
                bytes.resize(size.into(), 0);
            }
            size = bytes.len();
            offset = self.constant(bytes);
            is_within = self.constants.len() <= MOST_BYTES;
        }
        if item.default.as_ref().is_some_and(|default| default.is_node_relative) {
            flags = flags.and(Flags::NODE_RELATIVE);
        }
        if is_given {
            flags = flags.and(Flags::GIVEN);
        }
        if side_file.is_optional(item.index, item.sub_index) {
            flags = flags.and(Flags::OPTIONAL);
        }
        let entry = Entry {
            index: item.index,
            sub_index: item.sub_index,
            data_type: item.data_type,
            flags,
            offset: offset as u16,
            size: size as u16,
        };
        (entry, is_within)
    }

    /// Where these bytes lie among the constants.
    fn constant(&mut self, bytes: Vec<u8>) -> usize {
        if bytes.is_empty() {
            return 0;
        }
        let end = self.constants.len();
        *self.places.entry(bytes).or_insert_with_key(|bytes| {
            self.constants.extend_from_slice(bytes);
            end
        })
    }
}

fn rights(item: &Item) -> Flags {
    let may_be_mapped = item.is_mappable && can_be_carried(item);
    [
        (Flags::READ, item.access.is_readable()),
        (Flags::WRITE, item.access.is_writable()),
        (Flags::TPDO, may_be_mapped && item.access.allows_tpdo()),
        (Flags::RPDO, may_be_mapped && item.access.allows_rpdo()),
    ]
    .into_iter()
    .filter(|(_, has)| *has)
    .fold(Flags::NONE, |flags, (flag, _)| flags.and(flag))
}

/// Whether a value of this type fits into a PDO; a text does where it is short enough.
fn can_be_carried(item: &Item) -> bool {
    item.data_type.is_mappable() || item.data_type.is_string()
}

/// Whether the value can change: clients may write it, or the device does, or the side-file says so.
fn is_variable(item: &Item, is_said: bool) -> bool {
    if item.data_type == DataType::Domain {
        return false;
    }
    // Error register, manufacturer status register, and the history of errors: the node itself writes them.
    let is_of_node = matches!(item.index.0, 0x1001..=0x1003);
    let is_of_device = item.access == AccessType::Ro
        && !item.is_count
        && (item.default.is_none() || item.is_mappable || item.index >= Index(0x2000));
    let is_node_relative = item.default.as_ref().is_some_and(|default| default.is_node_relative);
    item.access.is_writable()
        || is_of_node
        || is_of_device
        || is_node_relative
        || is_said
        || (item.sub_index == SubIndex(0) && item.is_extended)
}
