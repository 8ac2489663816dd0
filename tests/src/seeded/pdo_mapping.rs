//! PDO: mappings.

use super::base::{Base, Entry, Section};
use super::defect::{Defect, missing, once, value, value_of};
use super::mutant::Mutant;

pub(super) fn defects() -> Vec<Defect> {
    [counts(), dummy_usage(), entries(), targets(), dummies(), rights()].into_iter().flatten().collect()
}

fn counts() -> Vec<Defect> {
    vec![
        value("PDO002", "a count of 65 mapped objects", "DefaultValue", is_count, "65"),
        value("PDO002", "a count of 100 mapped objects", "DefaultValue", is_count, "100"),
        mapping("PDO018", "more mapped objects than entries", |base, map| {
            let more = base.sub_objects(map.index).len();
            (more == map.entries.len() + 1).then(|| Mutant::of(base).set(map.count, &more.to_string()))
        }),
        Defect::new("PDO018", "a gap in the entries", |base| {
            let counts = base.sections_where(is_count).into_iter();
            let gaps = counts.filter_map(|section| {
                let index = section.index()?;
                let object = base.object(index)?;
                let fewer = base.sub_objects(index).len() - 1;
                base.sub_object(index, 3)?;
                let mutant = Mutant::of(base).delete_section(base.sub_object(index, 2)?);
                let mutant = mutant.set_too(object.entry("SubNumber")?, &fewer.to_string());
                Some(mutant.expect(base.sub_object(index, 3)?.header))
            });
            gaps.collect()
        }),
        mapping("PDO013", "a counted entry of 0", |base, map| {
            Some(Mutant::of(base).set(map.entries.first()?, "0x00000000"))
        }),
        mapping("PDO013", "a counted entry without a value", |base, map| {
            let entry = map.entries.last()?;
            let section =
                base.sections_where(|section| section.entries.iter().any(|own| own.line == entry.line));
            Some(Mutant::of(base).delete(entry.line).expect(section.first()?.header))
        }),
        mapping("PDO013", "a compact mapping without values", |base, map| {
            let number = base.object(map.index)?.entry("SubNumber")?;
            let compact = format!("CompactSubObj={}\nDataType=0x0007\nAccessType=rw", map.entries.len());
            let subs = base.sub_objects(map.index).into_iter();
            let without_subs = subs.fold(Mutant::of(base), Mutant::delete_section);
            Some(without_subs.rewrite(number.line, compact))
        }),
        mapping("PDO012", "an entry behind the counted ones", |base, map| {
            let free = base.sub_object(map.index, map.entries.len() as u8 + 1)?.entry("DefaultValue")?;
            Some(Mutant::of(base).set(free, &map.entries[0].value))
        }),
        mapping("PDO012", "one mapped object less", |base, map| {
            let is_dummy = |entry: &Entry| entry.value.starts_with("0x000");
            let last = map.entries.last().filter(|last| map.entries.len() > 1 && !is_dummy(last))?;
            Some(Mutant::of(base).set_too(map.count, &(map.entries.len() - 1).to_string()).expect(last.line))
        }),
    ]
}

fn dummy_usage() -> Vec<Defect> {
    let is_usage = |section: &Section| section.name == "DummyUsage";
    vec![
        missing("PDO027", "DummyUsage without the BOOLEAN", "Dummy0001", is_usage),
        missing("PDO027", "DummyUsage without the INTEGER32", "Dummy0004", is_usage),
        value_of("PDO027", "DummyUsage in hexadecimal", "Dummy0003", is_usage, |_, old| {
            Some(format!("0x{old}"))
        }),
        value_of("PDO027", "DummyUsage with an empty entry", "Dummy0002", is_usage, |_, _| {
            Some(String::new())
        })
        .by_label(),
    ]
}

fn entries() -> Vec<Defect> {
    vec![
        mapping("PDO003", "more than 64 bits", |base, map| {
            let free = base.sub_object(map.index, map.entries.len() as u8 + 1)?.entry("DefaultValue")?;
            let last = map.entries.last()?;
            let wide = map.entries.iter().all(|entry| entry.value.ends_with("20"));
            let other = if map.index < 0x1800 { "0x20100110" } else { "0x20110110" };
            let count = (map.entries.len() + 1).to_string();
            (wide && last.value.len() == 10)
                .then(|| Mutant::of(base).set_too(map.count, &count).set(free, other))
        }),
        mapping("PDO005", "a length in bytes", |base, map| {
            let entry = map.entries.iter().find(|entry| entry.value.ends_with("10"))?;
            Some(Mutant::of(base).set(entry, &format!("{}02", &entry.value[..8])))
        }),
        mapping("PDO005", "another length than the object has", |base, map| {
            let entry = map.entries.first().filter(|entry| mapped_object(base, entry).is_some())?;
            let other = if entry.value.ends_with("08") { "10" } else { "08" };
            Some(Mutant::of(base).set(entry, &format!("{}{other}", &entry.value[..8])))
        }),
        mapping("PDO014", "an object that is mapped twice", |base, map| {
            let free = base.sub_object(map.index, map.entries.len() as u8 + 1)?.entry("DefaultValue")?;
            let short = map.entries.iter().find(|entry| entry.value.ends_with("08"))?;
            let count = (map.entries.len() + 1).to_string();
            Some(Mutant::of(base).set_too(map.count, &count).set(free, &short.value))
        }),
    ]
}

fn targets() -> Vec<Defect> {
    vec![
        target("PDO004", "a mapped object that is not described", |_, base| {
            base.section("SupportedModules").is_none().then(|| "0x5FF00010".to_owned())
        }),
        target("PDO004", "a mapped sub-index that is not described", |_, base| {
            let array =
                base.sections_where(|section| section.has_sub_objects() && section.is_of_manufacturer());
            let array = array.first().filter(|_| base.section("SupportedModules").is_none())?;
            Some(format!("0x{}FE08", array.name))
        }),
        target("PDO006", "a mapped object with PDOMapping=0", |_, base| {
            entry_for(base, |section| section.value("AccessType") == "rw" && section.is_type(6))
        }),
        mapping("PDO006", "PDOMapping=0 of a mapped object", |base, map| {
            changed_target(base, map, true, "PDOMapping", "0")
        })
        .by_label(),
        target("PDO007", "an object to be read in an RPDO", |index, base| {
            let is_input =
                |section: &Section| is_process_data(section) && section.value("AccessType") == "ro";
            entry_for(base, is_input).filter(|_| index < 0x1800)
        }),
        target("PDO007", "an object to be written in a TPDO", |index, base| {
            let is_output =
                |section: &Section| is_process_data(section) && section.value("AccessType") == "rww";
            entry_for(base, is_output).filter(|_| index >= 0x1800)
        }),
        mapping("PDO007", "access `ro` of an object in an RPDO", |base, map| {
            changed_target(base, map, map.index < 0x1800, "AccessType", "ro")
        })
        .by_label(),
        mapping("PDO007", "access `wo` of an object in a TPDO", |base, map| {
            changed_target(base, map, map.index >= 0x1800, "AccessType", "wo")
        })
        .by_label(),
        target("PDO019", "a mapped DOMAIN", |_, base| {
            let domain = base.sections_where(|section| section.is_code(2));
            Some(format!("0x{}0008", domain.first()?.name))
        }),
        mapping("PDO021", "a bit where bytes can be mapped", |base, map| {
            let flag =
                base.sections_where(|section| section.is_object() && section.is_type(1)).first().copied()?;
            let mapped = map.entries.last().filter(|_| map.index >= 0x1800)?;
            let mutant = Mutant::of(base).set_too(flag.entry("PDOMapping")?, "1");
            Some(mutant.set(mapped, &format!("0x{}0001", flag.name)))
        })
        .by_label(),
    ]
}

/// A mapping entry that names the first object that `wanted` picks.
fn entry_for(base: &Base, wanted: fn(&Section) -> bool) -> Option<String> {
    let sections = base
        .sections_where(|section| section.is_variable() && section.sub_index() != Some(0) && wanted(section));
    let section = sections.iter().find(|section| section.is_within(0x2000, 0x9FFF))?;
    let bits = match section.number("DataType")? {
        1 => 1,
        2 | 5 => 8,
        3 | 6 => 16,
        _ => 32,
    };
    Some(format!("0x{:04X}{:02X}{bits:02X}", section.index()?, section.sub_index().unwrap_or(0)))
}

fn changed_target(base: &Base, map: &Map<'_>, wanted: bool, key: &str, new: &str) -> Option<Mutant> {
    let section = mapped_object(base, map.entries.first().filter(|_| wanted)?)?;
    Some(Mutant::of(base).set(section.entry(key)?, new))
}

/// The section of the object that an entry of a mapping names.
fn mapped_object<'a>(base: &'a Base, entry: &Entry) -> Option<&'a Section> {
    let place = entry.number()?;
    let (index, sub_index) = ((place >> 16) as u16, (place >> 8) as u8);
    base.sub_object(index, sub_index).or(base.object(index))
}

fn dummies() -> Vec<Defect> {
    vec![
        target("PDO008", "a dummy that is not allowed", |index, _| {
            (index < 0x1800).then(|| "0x00070020".to_owned())
        }),
        once("PDO008", "a dummy that is not allowed any more", |base| {
            let used = base.sections().iter().any(|section| section.value("DefaultValue") == "0x00050008");
            let allowed = base.entry("DummyUsage", "Dummy0005").filter(|_| used)?;
            Some(Mutant::of(base).set(allowed, "0"))
        })
        .by_label(),
        target("PDO009", "a dummy in a TPDO", |index, _| (index >= 0x1800).then(|| "0x00050008".to_owned())),
        target("PDO009", "a dummy with a sub-index", |index, _| {
            (index < 0x1800).then(|| "0x00050108".to_owned())
        }),
        target("PDO009", "a dummy of another length", |index, _| {
            (index < 0x1800).then(|| "0x00050010".to_owned())
        }),
    ]
}

fn rights() -> Vec<Defect> {
    vec![
        value(
            "PDO020",
            "entries that can be written, but not their number",
            "AccessType",
            is_writable_count,
            "ro",
        ),
        Defect::new("PDO020", "a number that can be written, but no entry", |base| {
            let counts =
                base.sections_where(|section| is_count(section) && section.value("AccessType") == "ro");
            let entries = counts.into_iter().filter_map(|section| section.entry("AccessType"));
            entries.map(|entry| Mutant::of(base).set(entry, "rw")).collect()
        }),
        value("PDO023", "a mappable object with access `rw`", "AccessType", is_process_data, "rw"),
    ]
}

/// The mapping of a PDO: what is counted and set.
struct Map<'a> {
    index: u16,
    count: &'a Entry,
    entries: Vec<&'a Entry>,
}

/// One change at each mapping that maps something.
fn mapping(rule: &'static str, kind: &'static str, change: fn(&Base, &Map<'_>) -> Option<Mutant>) -> Defect {
    Defect::new(rule, kind, move |base| {
        let maps = base.sections_where(is_count).into_iter().filter_map(|section| map(base, section));
        maps.filter_map(|map| change(base, &map)).collect()
    })
}

fn map<'a>(base: &'a Base, section: &'a Section) -> Option<Map<'a>> {
    let index = section.index()?;
    let count = section.entry("DefaultValue")?;
    let counted = u8::try_from(count.number()?).ok().filter(|count| *count > 0)?;
    let entry = |sub_index| base.sub_object(index, sub_index)?.entry("DefaultValue");
    Some(Map { index, count, entries: (1..=counted).map(entry).collect::<Option<_>>()? })
}

/// Each counted entry becomes what `new` makes of the index of the mapping parameter.
fn target(rule: &'static str, kind: &'static str, new: fn(u16, &Base) -> Option<String>) -> Defect {
    Defect::new(rule, kind, move |base| {
        let maps = base.sections_where(is_count).into_iter().filter_map(|section| map(base, section));
        let changed = maps.filter_map(|map| Some((new(map.index, base)?, map.entries)));
        let mutants = changed.flat_map(|(new, entries)| {
            entries.into_iter().map(move |entry| Mutant::of(base).set(entry, &new)).collect::<Vec<_>>()
        });
        mutants.collect()
    })
}

fn is_count(section: &Section) -> bool {
    section.sub_index() == Some(0) && (section.is_within(0x1600, 0x17FF) || section.is_within(0x1A00, 0x1BFF))
}

fn is_writable_count(section: &Section) -> bool {
    is_count(section) && section.value("AccessType") == "rw"
}

fn is_process_data(section: &Section) -> bool {
    section.value("PDOMapping") == "1" && section.is_variable()
}
