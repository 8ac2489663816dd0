//! PDO: communication parameters, and what the device information says about PDOs.

use super::base::Section;
use super::defect::{Defect, once, value};
use super::dictionary::without_object;
use super::mutant::Mutant;

pub(super) fn defects() -> Vec<Defect> {
    [pairs(), types(), timers(), information()].into_iter().flatten().collect()
}

fn pairs() -> Vec<Defect> {
    vec![
        Defect::new("PDO001", "no mapping parameter", |base| {
            let objects = base.sections_where(is_communication).into_iter();
            let gone = objects.filter_map(|section| {
                Some(without_object(base, section.index()? + 0x200)?.expect(section.header))
            });
            gone.collect()
        }),
        Defect::new("PDO001", "no communication parameter", |base| {
            let objects = base.sections_where(is_mapping).into_iter();
            let gone = objects.filter_map(|section| {
                let index = section.index()? - 0x200;
                let key = if index < 0x1800 { "NrOfRXPDO" } else { "NrOfTXPDO" };
                let described = base.sections_where(|other| {
                    other.is_object() && other.is_within(index & 0xFE00, index | 0x1FF)
                });
                let count = base.entry("DeviceInfo", key)?;
                let mutant = without_object(base, index)?.set_too(count, &(described.len() - 1).to_string());
                Some(mutant.expect(section.header))
            });
            gone.collect()
        }),
        lost("no COB-ID", 1),
        lost("no transmission type", 2),
    ]
}

/// A communication parameter without one of its entries.
fn lost(kind: &'static str, sub_index: u8) -> Defect {
    Defect::new("PDO026", kind, move |base| {
        let objects = base.sections_where(is_communication).into_iter();
        let gone = objects.filter_map(|section| {
            let index = section.index()?;
            let number = section.entry("SubNumber")?;
            let fewer = base.sub_objects(index).len() - 1;
            let mutant = Mutant::of(base).delete_section(base.sub_object(index, sub_index)?);
            Some(mutant.set_too(number, &fewer.to_string()).expect(section.header))
        });
        gone.collect()
    })
}

fn types() -> Vec<Defect> {
    vec![
        value("PDO010", "a transmission type of 241", "DefaultValue", is_type, "241"),
        value("PDO010", "a transmission type of 251", "DefaultValue", is_type, "0xFB"),
        value("PDO010", "a transmission type of 252 at an RPDO", "DefaultValue", is_rpdo_type, "252"),
        value("PDO010", "a transmission type of 253 at an RPDO", "DefaultValue", is_rpdo_type, "253"),
        Defect::new("PDO011", "a TPDO on request that allows no request", |base| {
            let types = base.sections_where(|section| {
                section.sub_index() == Some(2) && section.is_within(0x1800, 0x19FF)
            });
            let wrong = types.into_iter().filter_map(|section| {
                let id = base.sub_object(section.index()?, 1)?.value("DefaultValue");
                let forbids = id.contains("0x4") || id.contains("0xC");
                let value = section.entry("DefaultValue").filter(|_| forbids)?;
                Some(Mutant::of(base).set(value, "253"))
            });
            wrong.collect()
        }),
    ]
}

fn timers() -> Vec<Defect> {
    vec![
        value("PDO015", "a SYNC start value of 241", "DefaultValue", is_sync_start, "241"),
        Defect::new("PDO015", "a SYNC start value without effect", |base| {
            let types = base
                .sections_where(|section| is_tpdo_type(section) && section.number("DefaultValue") == Some(1));
            let wrong = types.into_iter().filter_map(|section| {
                base.sub_object(section.index()?, 6)?;
                Some(Mutant::of(base).set(section.entry("DefaultValue")?, "254"))
            });
            wrong.collect()
        })
        .by_label(),
        Defect::new("PDO016", "an event timer of a synchronous TPDO", |base| {
            let types = base
                .sections_where(|section| is_tpdo_type(section) && section.number("DefaultValue") == Some(1));
            let wrong = types.into_iter().filter_map(|section| {
                let timer = base.sub_object(section.index()?, 5)?.entry("DefaultValue")?;
                Some(Mutant::of(base).set(timer, "100"))
            });
            wrong.collect()
        }),
        Defect::new("PDO016", "an event timer of a TPDO on request", |base| {
            let types = base.sections_where(is_tpdo_type);
            let wrong = types.into_iter().filter_map(|section| {
                let timer = base.sub_object(section.index()?, 5)?.entry("DefaultValue")?;
                let id = base.sub_object(section.index()?, 1)?.value("DefaultValue");
                let allows = !id.contains("0x4") && !id.contains("0xC");
                let kind = section.entry("DefaultValue").filter(|_| allows)?;
                Some(Mutant::of(base).set(timer, "100").set_too(kind, "253"))
            });
            wrong.collect()
        }),
    ]
}

fn information() -> Vec<Defect> {
    vec![
        Defect::new("PDO017", "objects for PDOs, but no PDO", |base| {
            let is_pdo = |section: &Section| section.is_object() && section.is_within(0x1400, 0x1BFF);
            let has_pdos = !base.sections_where(is_pdo).is_empty();
            let variables = base.sections_where(|section| !has_pdos && section.is_of_manufacturer());
            let entries = variables.into_iter().filter_map(|section| section.entry("PDOMapping"));
            entries.map(|entry| Mutant::of(base).set(entry, "1")).collect()
        }),
        value("PDO022", "group messaging without a multiplexed PDO", "GroupMessaging", |_| true, "1"),
        once("PDO022", "a multiplexed PDO without group messaging", |base| {
            let count = base.sub_object(0x1A00, 0)?.entry("DefaultValue")?;
            Some(Mutant::of(base).set(count, "255"))
        })
        .by_label(),
        once("PDO024", "CompactPDO for PDOs that are described one by one", |base| {
            let info = base.section("DeviceInfo").filter(|info| info.entry("CompactPDO").is_none())?;
            Some(Mutant::of(base).insert(info.behind_entries(), "CompactPDO=0x17"))
        }),
        once("PDO024", "CompactPDO, but as many PDOs as described", |base| {
            let compact = base.entry("DeviceInfo", "CompactPDO")?;
            let count = |key, first| {
                let described = base
                    .sections_where(|section| section.is_object() && section.is_within(first, first + 0x1FF));
                Some((base.entry("DeviceInfo", key)?, described.len().to_string()))
            };
            let (rpdos, tpdos) = (count("NrOfRXPDO", 0x1400)?, count("NrOfTXPDO", 0x1800)?);
            let mutant = Mutant::of(base).set_too(rpdos.0, &rpdos.1).set_too(tpdos.0, &tpdos.1);
            Some(mutant.expect(compact.line))
        }),
        Defect::new("PDO025", "a COB-ID that cannot be switched off", |base| {
            let ids = base
                .sections_where(|section| is_communication_entry(section) && section.sub_index() == Some(1));
            let used = ids.into_iter().filter(|section| super::cob_id::is_used(section));
            let fixed = used.filter_map(|section| {
                let access = section.entry("AccessType").filter(|access| access.value == "rw")?;
                Some(Mutant::of(base).set(access, "ro"))
            });
            fixed.collect()
        }),
    ]
}

fn is_communication(section: &Section) -> bool {
    section.is_object() && (section.is_within(0x1400, 0x15FF) || section.is_within(0x1800, 0x19FF))
}

fn is_communication_entry(section: &Section) -> bool {
    section.is_within(0x1400, 0x15FF) || section.is_within(0x1800, 0x19FF)
}

fn is_mapping(section: &Section) -> bool {
    section.is_object() && (section.is_within(0x1600, 0x17FF) || section.is_within(0x1A00, 0x1BFF))
}

fn is_type(section: &Section) -> bool {
    is_communication_entry(section) && section.sub_index() == Some(2)
}

fn is_rpdo_type(section: &Section) -> bool {
    is_type(section) && section.is_within(0x1400, 0x15FF)
}

fn is_tpdo_type(section: &Section) -> bool {
    is_type(section) && section.is_within(0x1800, 0x19FF)
}

fn is_sync_start(section: &Section) -> bool {
    section.sub_index() == Some(6) && section.is_within(0x1800, 0x19FF)
}
