//! What the template shows, ready-made.

use super::handles::{Called, HandleRow, Handles, KeyRow, handles};
use super::{Naming, file_name};
use crate::text::{for_comment, for_docs, for_message};
use crate::{Counts, InputFile, Layout, Place, Source};
use askama::Template;
use edskit_runtime::{Entry, Flags, Settings, StorageGroup};
use edskit_types::{BitRates, Bitrate, DataType, MappingEntry, PdoDirection};
use std::collections::BTreeMap;

/// How many bytes stand in one line of an image.
const BYTES_IN_LINE: usize = 16;

#[derive(Template)]
#[template(path = "rust/dictionary.rs")]
pub(super) struct View<'a> {
    naming: &'a Naming,
    eds: String,
    eds_docs: String,
    product: Option<String>,
    counts: Counts,
    flags: Vec<FlagsRow>,
    has_groups: bool,
    entries: Vec<EntryRow>,
    values: usize,
    defaults: Vec<ImageRow>,
    constant_bytes: usize,
    constants: Vec<ImageRow>,
    limits: Vec<LimitsRow>,
    dummies: String,
    fingerprint: String,
    bit_rates: String,
    settings: Settings,
    checks: Vec<CheckRow>,
    keys: Vec<KeyRow>,
    imports: String,
    handles: Vec<HandleRow>,
}

/// A constant for a combination of rights.
struct FlagsRow {
    name: String,
    value: String,
}

struct EntryRow {
    code: String,
    comment: String,
}

struct ImageRow {
    bytes: String,
    comment: String,
}

struct LimitsRow {
    position: u16,
    low: String,
    high: String,
    comment: String,
}

struct CheckRow {
    condition: String,
    message: String,
}

impl<'a> View<'a> {
    pub(super) fn new(layout: &'a Layout, naming: &'a Naming, called: Vec<Called>) -> Self {
        let Handles { keys, rows, imports } = handles(layout, called);
        let eds = for_comment(file_name(&naming.eds));
        Self {
            naming,
            eds_docs: for_docs(file_name(&naming.eds)).unwrap_or_default(),
            eds,
            product: layout.product.as_deref().and_then(for_docs),
            counts: layout.counts,
            has_groups: layout.entries.iter().any(|entry| entry.flags.group().is_some()),
            flags: flags_rows(&layout.entries),
            entries: entry_rows(layout),
            values: layout.defaults.len(),
            defaults: image(layout, &layout.defaults, true),
            constant_bytes: layout.constants.len(),
            constants: image(layout, &layout.constants, false),
            limits: limits(layout),
            dummies: format!("0x{:02X}", layout.dummies),
            fingerprint: format!("0x{:04X}_{:04X}", layout.fingerprint >> 16, layout.fingerprint & 0xFFFF),
            bit_rates: bit_rates(layout.settings.bit_rates),
            settings: layout.settings,
            checks: checks(layout, naming),
            keys,
            imports: imports.into_iter().collect::<Vec<_>>().join(", "),
            handles: rows,
        }
    }
}

/// A set of bit rates as code.
fn bit_rates(bit_rates: BitRates) -> String {
    if bit_rates == BitRates::ALL {
        return "BitRates::ALL".to_owned();
    }
    let supported = Bitrate::ALL.iter().filter(|bit_rate| bit_rates.has(**bit_rate));
    let more: String = supported.map(|bit_rate| format!(".and(Bitrate::{bit_rate:?})")).collect();
    format!("BitRates::NONE{more}")
}

/// The entries, with their names in a column behind them.
fn entry_rows(layout: &Layout) -> Vec<EntryRow> {
    let code = |entry: &Entry| {
        let Entry { index, sub_index, data_type, offset, size, flags } = entry;
        let (index, sub_index, flags) = (index.0, sub_index.0, flags_name(*flags));
        format!(
            "entry(0x{index:04X}, 0x{sub_index:02X}, DataType::{data_type:?}, {flags}, {offset}, {size}),"
        )
    };
    let codes: Vec<String> = layout.entries.iter().map(code).collect();
    let width = codes.iter().map(String::len).max().unwrap_or(0);
    let row = |(code, source): (String, &Source)| {
        let comment = comment(&source.name);
        let padding = if comment.is_empty() { 0 } else { width };
        EntryRow { code: format!("{code:padding$}"), comment }
    };
    codes.into_iter().zip(&layout.sources).map(row).collect()
}

/// A comment behind something, with the blanks and slashes that it needs.
fn comment(text: &str) -> String {
    let text = for_comment(text);
    if text.is_empty() { text } else { format!(" // {text}") }
}

/// `CONST`, `RW`: what clients may do, and whether the value lies in the values.
fn base_name(flags: Flags) -> &'static str {
    match (flags.has(Flags::READ), flags.has(Flags::WRITE), flags.has(Flags::VARIABLE)) {
        (true, true, true) => "RW",
        (true, true, false) => "RW_DOMAIN",
        (true, false, true) => "RO",
        (true, false, false) => "CONST",
        (false, _, true) => "WO",
        (false, _, false) => "WO_DOMAIN",
    }
}

fn base_value(name: &str) -> &'static str {
    match name {
        "RW" => "Flags::READ.and(Flags::WRITE).and(Flags::VARIABLE)",
        "RW_DOMAIN" => "Flags::READ.and(Flags::WRITE)",
        "RO" => "Flags::READ.and(Flags::VARIABLE)",
        "CONST" => "Flags::READ",
        "WO" => "Flags::WRITE.and(Flags::VARIABLE)",
        _ => "Flags::WRITE",
    }
}

/// What the names of rights have behind the access.
const FURTHER: [(&str, Flags); 6] = [
    ("TPDO", Flags::TPDO),
    ("RPDO", Flags::RPDO),
    ("NODE_RELATIVE", Flags::NODE_RELATIVE),
    ("LIMITED", Flags::LIMITED),
    ("OPTIONAL", Flags::OPTIONAL),
    ("GIVEN", Flags::GIVEN),
];

/// `CONST`, `RW_TPDO_GROUP_2`.
fn flags_name(flags: Flags) -> String {
    let further = FURTHER.into_iter().filter(|(_, flag)| flags.has(*flag));
    let name = further.fold(base_name(flags).to_owned(), |name, (word, _)| name + "_" + word);
    flags.group().map_or(name.clone(), |group| format!("{name}_GROUP_{}", group.0))
}

/// The constants of all rights in use; each begins with that of its access.
fn flags_rows(entries: &[Entry]) -> Vec<FlagsRow> {
    let mut rows = BTreeMap::new();
    for flags in entries.iter().map(|entry| entry.flags) {
        let base = base_name(flags);
        rows.insert(base.to_owned(), base_value(base).to_owned());
        let further = FURTHER.into_iter().filter(|(_, flag)| flags.has(*flag));
        let value = further.fold(base.to_owned(), |value, (word, _)| format!("{value}.and(Flags::{word})"));
        let group = |group: StorageGroup| format!("{value}.stored_in(StorageGroup({}))", group.0);
        let value = flags.group().map_or(value.clone(), group);
        if value != base {
            rows.insert(flags_name(flags), value);
        }
    }
    rows.into_iter().map(|(name, value)| FlagsRow { name, value }).collect()
}

/// The bytes of an image, a new line for each entry.
fn image(layout: &Layout, bytes: &[u8], is_variable: bool) -> Vec<ImageRow> {
    let has_bytes = |entry: &Entry| is_variable || entry.size > 0;
    let lies_here = |entry: &&Entry| entry.flags.has(Flags::VARIABLE) == is_variable && has_bytes(entry);
    let mut starts: Vec<(usize, &Entry)> =
        layout.entries.iter().filter(lies_here).map(|entry| (entry.offset.into(), entry)).collect();
    // Equal constants share their bytes; the first one names them.
    starts.sort_by_key(|(start, _)| *start);
    starts.dedup_by_key(|(start, _)| *start);
    let ends = starts.iter().skip(1).map(|(start, _)| *start).chain([bytes.len()]);
    let mut rows = Vec::with_capacity(starts.len());
    for ((start, entry), end) in starts.iter().zip(ends) {
        let bytes = bytes.get(*start..end).unwrap_or_default();
        for (number, line) in bytes.chunks(BYTES_IN_LINE).enumerate() {
            let place = if number == 0 {
                format!(" // {:04X}h sub-index {:02X}h", entry.index.0, entry.sub_index.0)
            } else {
                String::new()
            };
            let bytes: Vec<String> = line.iter().map(|byte| format!("0x{byte:02X},")).collect();
            rows.push(ImageRow { bytes: bytes.join(" "), comment: place });
        }
    }
    rows
}

fn limits(layout: &Layout) -> Vec<LimitsRow> {
    let row = |limits: &edskit_runtime::Limits| {
        let entry = layout.entries.get(usize::from(limits.position.0));
        let number = |bits: u64| match entry.map(|entry| entry.data_type) {
            Some(data_type) if data_type.is_signed() && (bits as i64) < 0 => {
                format!("{}_i64 as u64", bits as i64)
            }
            Some(DataType::Real32) => {
                real(f32::from_bits(bits as u32), "f32", |text| format!("{text}.to_bits() as u64"))
            }
            Some(DataType::Real64) => real(f64::from_bits(bits), "f64", |text| format!("{text}.to_bits()")),
            _ => bits.to_string(),
        };
        LimitsRow {
            position: limits.position.0,
            low: number(limits.low),
            high: number(limits.high),
            comment: entry.map_or_else(String::new, |entry| {
                format!(" // {:04X}h sub-index {:02X}h", entry.index.0, entry.sub_index.0)
            }),
        }
    };
    layout.limits.iter().map(row).collect()
}

/// A real number as an expression for its bits.
fn real(
    value: impl Into<f64> + core::fmt::Debug + Copy,
    kind: &str,
    bits: impl Fn(String) -> String,
) -> String {
    match value.into() {
        f64::INFINITY => bits(format!("{kind}::INFINITY")),
        f64::NEG_INFINITY => bits(format!("{kind}::NEG_INFINITY")),
        number if number < 0.0 => bits(format!("({value:?}_{kind})")),
        _ => bits(format!("{value:?}_{kind}")),
    }
}

fn checks(layout: &Layout, naming: &Naming) -> Vec<CheckRow> {
    let check = |place: &Place, condition: String, text: String| {
        let file = match place.file {
            InputFile::Eds => file_name(&naming.eds),
            InputFile::SideFile => file_name(&naming.side_file),
        };
        CheckRow { condition, message: for_message(&format!("{file}:{}: {text}", place.position)) }
    };
    let number = |entry: MappingEntry| format!("0x{:04X}_{:04X}", entry.0 >> 16, entry.0 & 0xFFFF);
    let mut checks = Vec::new();
    for mapping in layout.mappings.iter().filter(|mapping| mapping.is_valid && !mapping.entries.is_empty()) {
        let right = match mapping.direction {
            PdoDirection::Receive => "RPDO",
            PdoDirection::Transmit => "TPDO",
        };
        for mapped in &mapping.entries {
            let entry = mapped.entry;
            let what =
                format!("{} sub-index {} with {} bits", entry.index(), entry.sub_index(), entry.bits());
            let condition = format!("can_carry({}, Flags::{right})", number(entry));
            checks.push(check(&mapped.place, condition, format!("{mapping} cannot carry {what}")));
        }
        let numbers: Vec<String> = mapping.entries.iter().map(|mapped| number(mapped.entry)).collect();
        let text = format!("{mapping} carries {} bits, and a PDO has 64", mapping.bits());
        checks.push(check(&mapping.place, format!("fit(&[{}])", numbers.join(", ")), text));
    }
    checks
}
