//! DEV: `[DeviceInfo]`.

use super::base::{Base, Section};
use super::defect::{Defect, added, missing, once, value, value_of};
use super::mutant::Mutant;

pub(super) fn defects() -> Vec<Defect> {
    [entries(), bit_rates(), identity(), pdos(), others()].into_iter().flatten().collect()
}

fn entries() -> Vec<Defect> {
    vec![
        once("DEV001", "no `[DeviceInfo]`", |base| {
            let section = base.section("DeviceInfo")?;
            Some(Mutant::of(base).delete_section(section).expect_first())
        }),
        missing("DEV002", "no VendorNumber", "VendorNumber", is_info),
        missing("DEV002", "no VendorName", "VendorName", is_info),
        missing("DEV002", "no Granularity", "Granularity", is_info),
        missing("DEV002", "no NrOfRXPDO", "NrOfRXPDO", is_info),
        missing("DEV002", "no LSS_Supported", "LSS_Supported", is_info),
        missing("DEV002", "no SimpleBootUpSlave", "SimpleBootUpSlave", is_info),
        value("DEV002", "an empty OrderCode", "OrderCode", is_info, ""),
        value("DEV003", "a word for a flag", "LSS_Supported", is_info, "yes"),
        value("DEV003", "a flag of 2", "GroupMessaging", is_info, "2"),
        value("DEV003", "a flag of -1", "SimpleBootUpMaster", is_info, "-1"),
        value("DEV003", "a bit rate with a word", "BaudRate_250", is_info, "true"),
        value("DEV003", "a dummy with a word", "Dummy0005", |_| true, "on"),
        value("DEV003", "a manager with a word", "CANopenManager", |_| true, "no"),
    ]
}

fn bit_rates() -> Vec<Defect> {
    vec![
        once("DEV004", "no bit rate at all", |base| {
            let info = base.section("DeviceInfo")?;
            let rates = info.entries.iter().filter(|entry| entry.key.starts_with("BaudRate_"));
            let mutant = Mutant::of(base).expect(info.header);
            Some(rates.fold(mutant, |mutant, rate| mutant.set(rate, "0")))
        }),
        added("DEV005", "a bit rate of 100 kbit/s", is_info, "BaudRate_100=1"),
        added("DEV005", "a bit rate of 83 kbit/s", is_info, "BaudRate_83=0"),
    ]
}

fn identity() -> Vec<Defect> {
    vec![
        value("DEV006", "another vendor-ID than in 1018h", "VendorNumber", is_info, "0x00000400"),
        value("DEV006", "another product code than in 1018h", "ProductNumber", is_info, "0x00000400"),
        once("DEV006", "another revision than in 1018h", |base| {
            base.sub_object(0x1018, 3)?.entry("DefaultValue")?;
            Some(Mutant::of(base).set(base.entry("DeviceInfo", "RevisionNumber")?, "0x00000400"))
        }),
        identity_value("DEV006", "another vendor-ID than in `[DeviceInfo]`", 1).by_label(),
        identity_value("DEV006", "another product code than in `[DeviceInfo]`", 2).by_label(),
        once("DEV007", "a vendor-ID of 0", |base| {
            let value = base.sub_object(0x1018, 1)?.entry("DefaultValue")?;
            Some(Mutant::of(base).set(base.entry("DeviceInfo", "VendorNumber")?, "0").set_too(value, "0"))
        }),
        once("DEV013", "LSS without a serial number", |base| {
            let mutant = without_serial_number(base)?;
            Some(mutant.set(base.entry("DeviceInfo", "LSS_Supported")?, "1"))
        }),
    ]
}

fn identity_value(rule: &'static str, kind: &'static str, sub_index: u8) -> Defect {
    once(rule, kind, move |base| {
        let value = base.sub_object(0x1018, sub_index)?.entry("DefaultValue")?;
        Some(Mutant::of(base).set(value, "0x00000400"))
    })
}

fn without_serial_number(base: &Base) -> Option<Mutant> {
    let serial = base.sub_object(0x1018, 4)?;
    let mutant = Mutant::of(base).delete_section(serial);
    let mutant = mutant.set_too(base.object(0x1018)?.entry("SubNumber")?, "4");
    Some(mutant.set_too(base.sub_object(0x1018, 0)?.entry("DefaultValue")?, "3"))
}

fn pdos() -> Vec<Defect> {
    vec![
        value("DEV010", "more PDOs than CANopen has", "NrOfTXPDO", is_info, "513"),
        counted("DEV010", "a TPDO less than described", "NrOfTXPDO", 0x1800),
        counted("DEV010", "an RPDO less than described", "NrOfRXPDO", 0x1400),
        value_of("DEV010", "a TPDO more than described", "NrOfTXPDO", is_info, |section, old| {
            let more = old.parse::<u16>().ok()? + 1;
            (section.value("CompactPDO").is_empty()).then(|| more.to_string())
        }),
        value("DEV011", "CompactPDO with a reserved bit", "CompactPDO", is_info, "0x57"),
        value("DEV011", "CompactPDO without COB-IDs", "CompactPDO", is_info, "0x16"),
        value("DEV011", "CompactPDO without transmission types", "CompactPDO", is_info, "0x15"),
    ]
}

/// A count of PDOs one below what is described from `first` on.
fn counted(rule: &'static str, kind: &'static str, key: &'static str, first: u16) -> Defect {
    once(rule, kind, move |base| {
        let described =
            base.sections_where(|section| section.is_object() && section.is_within(first, first + 0x1FF));
        let fewer = described.len().checked_sub(1)?;
        Some(Mutant::of(base).set(base.entry("DeviceInfo", key)?, &fewer.to_string()))
    })
}

fn others() -> Vec<Defect> {
    vec![
        value("DEV008", "a granularity above 64", "Granularity", is_info, "65"),
        value("DEV008", "a granularity of 128", "Granularity", is_info, "128"),
        once("DEV009", "a granularity of 0, but mappings can be written", |base| {
            let access = base.sub_object(0x1A00, 0)?.value("AccessType");
            let granularity = base.entry("DeviceInfo", "Granularity")?;
            (access == "rw").then(|| Mutant::of(base).set(granularity, "0"))
        }),
        Defect::new("DEV009", "a granularity above 0, but no mapping can be written", |base| {
            let is_fixed = base.sub_object(0x1A00, 0).is_some_and(|count| count.value("AccessType") != "rw");
            let granularity = base.entry("DeviceInfo", "Granularity").filter(|_| is_fixed);
            let values = ["1", "8", "16"].into_iter();
            values.filter_map(|value| Some(Mutant::of(base).set(granularity?, value))).collect()
        }),
        value_of("DEV012", "dynamic channels without their section", DYNAMIC, is_info, |_, old| {
            (old == "0").then(|| "1".to_owned())
        }),
        value_of("DEV012", "segments of channels, but no dynamic channels", DYNAMIC, is_info, |_, old| {
            (old == "1").then(|| "0".to_owned())
        }),
        once("DEV012", "no `[DynamicChannels]`, but dynamic channels", |base| {
            let section = base.section("DynamicChannels")?;
            let supported = base.entry("DeviceInfo", DYNAMIC)?;
            Some(Mutant::of(base).delete_section(section).expect(supported.line))
        }),
    ]
}

const DYNAMIC: &str = "DynamicChannelsSupported";

fn is_info(section: &Section) -> bool {
    section.name == "DeviceInfo"
}
