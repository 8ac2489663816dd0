//! What `[DeviceInfo]` says to a node.

use super::Mapping;
use crate::Problem;
use edskit_lint::Severity;
use edskit_model::{Datasheet, DeviceInfo, Entry as TextEntry, KeyName};
use edskit_runtime::{Entry, Flags, Settings};
use edskit_types::{BitRates, Bitrate, DataType};

/// The settings of a node over a datasheet, with a node-ID of 1. What the file does not say is as in
/// [`Settings::DEFAULT`].
pub(super) fn read(
    sheet: &Datasheet,
    entries: &[Entry],
    mappings: &[Mapping],
    notes: &mut Vec<Problem>,
) -> Settings {
    let Some(info) = sheet.device_info() else { return Settings::DEFAULT };
    let said = info.granularity().and_then(|field| Some((field.entry.value_span(), field.known()?)));
    let mut granularity = said.map_or(1, |(_, granularity)| granularity);
    if let Some((span, bits)) = said.filter(|(_, bits)| *bits > 1)
        && let Some(what) = shorter_value(bits, entries, mappings)
    {
        granularity = 1;
        let message = format!("Granularity {bits} counts as 1, because {what}");
        notes.push(Problem::in_eds(sheet.document(), Severity::Warning, span, message));
    }
    let is_set = |key| info.filled(key).map(TextEntry::flag).and_then(|field| field.known());
    Settings {
        bit_rates: bit_rates(info),
        has_lss: info.lss_supported().and_then(|field| field.known()).unwrap_or(true),
        // Nobody starts a device that is nothing but a boot-up master.
        starts_by_itself: is_set(KeyName::SimpleBootUpMaster) == Some(true)
            && is_set(KeyName::SimpleBootUpSlave) == Some(false),
        granularity,
        ..Settings::DEFAULT
    }
}

/// The bit rates whose flag is 1; all, where the file says nothing of any.
fn bit_rates(info: DeviceInfo<'_>) -> BitRates {
    let is_said = |bit_rate: &Bitrate| info.supports(*bit_rate).and_then(|field| field.known()).is_some();
    if !Bitrate::ALL.iter().any(is_said) {
        return BitRates::ALL;
    }
    info.bitrates().fold(BitRates::NONE, BitRates::and)
}

/// What is mapped or can be, and does not have a multiple of so many bits: then the file contradicts itself.
fn shorter_value(granularity: u8, entries: &[Entry], mappings: &[Mapping]) -> Option<String> {
    let is_shorter = |bits: u16| !bits.is_multiple_of(granularity.into());
    let mapped =
        mappings.iter().flat_map(|mapping| mapping.entries.iter().map(move |mapped| (mapping, mapped.entry)));
    let mut mapped = mapped.filter(|(_, entry)| is_shorter(entry.bits().into()));
    if let Some((mapping, entry)) = mapped.next() {
        return Some(format!("{mapping} carries {} bits of {}", entry.bits(), entry.index()));
    }
    let can_be_mapped = |entry: &&Entry| {
        let is_number = entry.data_type != DataType::Boolean && !entry.data_type.is_string();
        is_number && (entry.flags.has(Flags::TPDO) || entry.flags.has(Flags::RPDO))
    };
    let mut bits =
        entries.iter().filter(can_be_mapped).filter_map(|entry| Some((entry, entry.data_type.bits()?)));
    let (entry, bits) = bits.find(|(_, bits)| is_shorter(*bits))?;
    let Entry { index, sub_index, .. } = entry;
    Some(format!("{index} sub-index {sub_index} with its {bits} bits can be mapped"))
}
