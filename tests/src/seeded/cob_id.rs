//! COB: COB-IDs.

use super::base::{Base, Entry, Kind, Section};
use super::defect::{Defect, once};
use super::mutant::Mutant;

pub(super) fn defects() -> Vec<Defect> {
    vec![
        pdo("COB001", "a PDO at the CAN-ID of NMT", |_| Some("0x0".to_owned())),
        pdo("COB001", "a PDO at the base 180h", |_| Some("0x180".to_owned())),
        pdo("COB001", "a PDO at the CAN-ID of an SDO", |_| Some("$NODEID+0x580".to_owned())),
        emcy("COB001", "EMCY at a heartbeat's CAN-ID", "$NODEID+0x700"),
        pdo_of_eds("COB002", "a PDO with the bare base", |section| {
            let base = predefined(section).filter(|base| *base > 0x180)?;
            Some(format!("0x{base:X}"))
        }),
        emcy("COB002", "EMCY with the bare base", "0x80"),
        once("COB003", "two TPDOs with one CAN-ID", |base| {
            let first = base.sub_object(0x1800, 1)?;
            let second = base.sub_object(0x1801, 1)?;
            (is_used(first) && is_used(second)).then(|| {
                Some(Mutant::of(base).set(second.entry("DefaultValue")?, first.value("DefaultValue")))
            })?
        })
        .by_label(),
        once("COB003", "a TPDO at the CAN-ID of EMCY", |base| {
            base.object(0x1014)?;
            let id = base.sub_object(0x1800, 1).filter(|section| is_used(section))?;
            let id = id.entry("ParameterValue").or(id.entry("DefaultValue"))?;
            let new = if id.key == "DefaultValue" { "$NODEID+0x80".to_owned() } else { own(base, 0x80)? };
            Some(Mutant::of(base).set(id, &new))
        })
        .by_label(),
        pdo("COB004", "bits above 11 without the frame bit", |section| {
            Some(format!("0x{:08X}", 0x1000 + predefined(section)? + 5))
        }),
        emcy("COB004", "EMCY with bit 30", "$NODEID+0x40000080"),
        emcy("COB004", "EMCY with bits above 11", "$NODEID+0x00010080"),
        pdo("COB005", "a PDO with an extended frame", |section| {
            Some(format!("0x{:08X}", 0x2000_0000 + predefined(section)? + 5))
        }),
        emcy("COB005", "EMCY with an extended frame", "$NODEID+0x20000080"),
        pdo_of_eds("COB006", "a PDO of a certain node", |section| {
            Some(format!("0x{:X}", predefined(section)? + 5))
        }),
        emcy_of_eds("COB006", "EMCY of a certain node", "0x85"),
        pdo_of_eds("COB007", "a PDO at another predefined CAN-ID", |section| {
            let other = if section.is_within(0x1400, 0x15FF) { "$NODEID+0x500" } else { "$NODEID+0x480" };
            Some(other.to_owned())
        }),
        Defect::new("COB007", "a PDO from the fifth on that is in use", |base| {
            let is_id =
                |section: &Section| section.sub_index() == Some(1) && section.is_within(0x1804, 0x19FF);
            let ids =
                base.sections_where(is_id).into_iter().filter_map(|section| section.entry("DefaultValue"));
            ids.map(|id| Mutant::of(base).set(id, "$NODEID+0x1C0")).collect()
        }),
        sender("COB008", "a TPDO of two nodes with one CAN-ID", |base| {
            let id = base.sub_object(0x1800, 1)?;
            id.entry("ParameterValue")
        })
        .by_label(),
    ]
}

/// The COB-ID of each PDO in use becomes something else.
fn pdo(rule: &'static str, kind: &'static str, new: fn(&Section) -> Option<String>) -> Defect {
    Defect::new(rule, kind, move |base| {
        let ids = base.sections_where(is_pdo_id).into_iter().filter(|section| is_used(section));
        let changed = ids.filter_map(|section| {
            let entry = section.entry("ParameterValue").or(section.entry("DefaultValue"))?;
            Some(Mutant::of(base).set(entry, &new(section)?))
        });
        changed.collect()
    })
}

/// The same in data sheets only.
fn pdo_of_eds(rule: &'static str, kind: &'static str, new: fn(&Section) -> Option<String>) -> Defect {
    Defect::new(rule, kind, move |base| {
        let ids =
            base.sections_where(|section| base.kind == Kind::Eds && is_pdo_id(section) && is_used(section));
        let changed = ids
            .into_iter()
            .filter_map(|section| Some(Mutant::of(base).set(section.entry("DefaultValue")?, &new(section)?)));
        changed.collect()
    })
}

fn emcy(rule: &'static str, kind: &'static str, new: &'static str) -> Defect {
    once(rule, kind, move |base| Some(Mutant::of(base).set(base.entry("1014", "DefaultValue")?, new)))
}

fn emcy_of_eds(rule: &'static str, kind: &'static str, new: &'static str) -> Defect {
    once(rule, kind, move |base| {
        let entry = base.entry("1014", "DefaultValue").filter(|_| base.kind == Kind::Eds)?;
        Some(Mutant::of(base).set(entry, new))
    })
}

/// A DCF beside a nodelist gets the COB-ID of another one; the finding is expected at its name in the nodelist.
fn sender(rule: &'static str, kind: &'static str, id: fn(&Base) -> Option<&Entry>) -> Defect {
    Defect::new(rule, kind, move |base| {
        super::node_list::with_changed_dcf(base, |dcf| {
            let entry = id(dcf)?;
            let node = dcf.section("DeviceComissioning")?.number("NodeID")?;
            Some(Mutant::of(dcf).set(entry, if node == 5 { "0x40000186" } else { "0x185" }))
        })
    })
}

fn is_pdo_id(section: &Section) -> bool {
    section.sub_index() == Some(1) && (section.is_within(0x1400, 0x1403) || section.is_within(0x1800, 0x1803))
}

/// Whether bit 31 is not set.
pub(super) fn is_used(section: &Section) -> bool {
    let value = section.value("DefaultValue").trim_start_matches("$NODEID+");
    super::base::number(value).is_some_and(|number| number & 0x8000_0000 == 0)
}

/// The CAN-ID of the pre-defined connection set, without the node-ID.
fn predefined(section: &Section) -> Option<u32> {
    let index = u32::from(section.index()?);
    let first = if index < 0x1800 { 0x200 } else { 0x180 };
    Some(first + (index & 0xF) * 0x100)
}

/// A CAN-ID with the node-ID of a DCF.
fn own(base: &Base, first: i64) -> Option<String> {
    let node = base.section("DeviceComissioning")?.number("NodeID")?;
    Some(format!("0x{:X}", first + node))
}
