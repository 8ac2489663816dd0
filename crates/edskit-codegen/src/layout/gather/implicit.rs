//! The parameters of PDOs that exist only through CompactPDO (CiA 306 v1.3, 4.6.3.4.1).

use super::Item;
use crate::layout::Source;
use crate::layout::value::Bytes;
use crate::{InputFile, SideFile};
use edskit_model::{Datasheet, ImplicitPdo, KeyName, SectionKind};
use edskit_types::{AccessType, CobId, DataType, Index, PdoDirection, SubIndex};

/// A PDO that is not valid.
const INVALID: u32 = CobId::BIT_31;
/// How many PDOs of each direction have an identifier in the pre-defined connection set.
const PREDEFINED: u16 = 4;
/// The transmission type "event of the device profile".
const EVENT: u8 = 0xFF;

pub(super) fn add(sheet: &Datasheet, side_file: &SideFile, items: &mut Vec<Item>) {
    // In a DCF, PDOs that are not described are not in use.
    let is_configured = sheet.section(SectionKind::DeviceCommissioning).is_some();
    let granularity = sheet.device_info().and_then(|info| info.granularity()?.known());
    let mapped = granularity.filter(|bits| *bits > 0).map_or(8, |bits| 64 / bits.min(64));
    let info = sheet.section(SectionKind::DeviceInfo);
    let span = info.and_then(|info| info.filled(KeyName::CompactPdo)).map(|entry| entry.span());
    let span = span.unwrap_or_default();
    for direction in [PdoDirection::Receive, PdoDirection::Transmit] {
        for pdo in sheet.implicit_pdos(direction) {
            let mut entry = |index: Index, sub_index, data_type, access, default: Bytes, name: &str| {
                let sub_index = SubIndex(sub_index);
                items.push(Item {
                    index,
                    sub_index,
                    data_type,
                    access,
                    is_mappable: false,
                    is_count: sub_index == SubIndex(0),
                    is_extended: false,
                    default: Some(default),
                    limits: None,
                    value_span: span,
                    source: Source {
                        file: InputFile::Eds,
                        section: "DeviceInfo".to_owned(),
                        span,
                        position: sheet.document().position(span.start),
                        name: name.to_owned(),
                        object: Some(object_name(pdo, index)),
                        access,
                        unit: side_file.unit(index, sub_index).map(str::to_owned),
                        array: None,
                        given_name: None,
                        given_object_name: None,
                    },
                });
            };
            add_communication(pdo, is_configured, &mut entry);
            let index = pdo.mapping();
            if sheet.object(index).is_none() {
                add_mapping(index, mapped, &mut entry);
            }
        }
    }
}

type Add<'a> = &'a mut dyn FnMut(Index, u8, DataType, AccessType, Bytes, &str);

fn add_communication(pdo: ImplicitPdo, is_configured: bool, add: Add<'_>) {
    let index = pdo.communication();
    let exists = |sub_index: u8| pdo.has_sub_index(SubIndex(sub_index));
    let highest = (1..=8).rev().find(|sub_index| exists(*sub_index)).unwrap_or(0);
    let byte = |value: u8| Bytes::fixed([value]);
    let word = || Bytes::fixed([0, 0]);
    add(index, 0, DataType::Unsigned8, AccessType::Const, byte(highest), "Highest sub-index supported");
    let parameters = [
        (1, DataType::Unsigned32, cob_id(pdo, is_configured), "COB-ID"),
        (2, DataType::Unsigned8, byte(EVENT), "Transmission type"),
        (3, DataType::Unsigned16, word(), "Inhibit time"),
        (4, DataType::Unsigned8, byte(0), "Reserved"),
        (5, DataType::Unsigned16, word(), "Event timer"),
        (6, DataType::Unsigned8, byte(0), "SYNC start value"),
    ];
    for (sub_index, data_type, default, name) in parameters {
        if exists(sub_index) {
            add(index, sub_index, data_type, AccessType::Rw, default, name);
        }
    }
}

fn add_mapping(index: Index, count: u8, add: Add<'_>) {
    let (none, unused) = (Bytes::fixed([0]), Bytes::fixed([0; 4]));
    add(index, 0, DataType::Unsigned8, AccessType::Rw, none, "Number of mapped objects");
    for number in 1..=count {
        let name = format!("Mapped object {number}");
        add(index, number, DataType::Unsigned32, AccessType::Rw, unused.clone(), &name);
    }
}

/// The identifier of the pre-defined connection set, where there is one and the file does not configure a device.
fn cob_id(pdo: ImplicitPdo, is_configured: bool) -> Bytes {
    if is_configured || pdo.number > PREDEFINED {
        return Bytes::fixed(INVALID.to_le_bytes());
    }
    let first = match pdo.direction {
        PdoDirection::Receive => 0x200,
        PdoDirection::Transmit => 0x180,
    };
    let base = first + 0x100 * (u32::from(pdo.number) - 1);
    Bytes { bytes: base.to_le_bytes().to_vec(), is_node_relative: true }
}

fn object_name(pdo: ImplicitPdo, index: Index) -> String {
    let noun = match pdo.direction {
        PdoDirection::Receive => "RPDO",
        PdoDirection::Transmit => "TPDO",
    };
    let what = if index == pdo.mapping() { "mapping" } else { "communication" };
    format!("{noun} {} {what} parameter", pdo.number)
}
