//! OBJ: objects and their attributes.

use super::base::{Base, Section, number};
use super::defect::{Defect, added, header, missing, once, value, value_of};
use super::dictionary::without_last_sub_object;
use super::mutant::Mutant;

pub(super) fn defects() -> Vec<Defect> {
    [attributes(), structure(), numbers(), compact(), flags(), links(), mapping()]
        .into_iter()
        .flatten()
        .collect()
}

fn attributes() -> Vec<Defect> {
    vec![
        missing("OBJ001", "no ParameterName", "ParameterName", is_description),
        value("OBJ001", "an empty ParameterName", "ParameterName", is_description, ""),
        value("OBJ002", "a reserved object code", "ObjectType", is_description, "0x3"),
        value_of("OBJ002", "an object code in words", "ObjectType", is_description, |section, _| {
            let words = [(2, "DOMAIN"), (7, "VAR"), (8, "ARRAY"), (9, "RECORD")];
            words.into_iter().find(|(code, _)| section.is_code(*code)).map(|(_, word)| word.to_owned())
        }),
        value("OBJ002", "a sub-object that is a RECORD", "ObjectType", Section::is_sub_object, "0x9"),
        missing("OBJ003", "no DataType", "DataType", is_described_value),
        value("OBJ003", "an empty DataType", "DataType", is_described_value, ""),
        missing("OBJ004", "no AccessType", "AccessType", is_described_value),
        missing("OBJ004", "no AccessType of compact sub-objects", "AccessType", is_compact),
        missing("OBJ003", "no DataType of compact sub-objects", "DataType", is_compact),
        value_of("OBJ005", "a misspelt access type", "AccessType", is_described_value, |_, old| {
            (old == "ro").then(|| "read".to_owned())
        }),
        value("OBJ005", "an access type in two words", "AccessType", is_described_value, "r/w"),
        value_of("OBJ005", "an access type in capitals", "AccessType", is_described_value, |_, old| {
            Some(old.to_ascii_uppercase())
        }),
        added("OBJ006", "SubNumber of a VAR", is_object_variable, "SubNumber=2"),
        added("OBJ006", "SubNumber of a sub-object", Section::is_sub_object, "SubNumber=1"),
        added("OBJ006", "a data type of an ARRAY or RECORD", Section::has_sub_objects, "DataType=0x0006"),
        added("OBJ006", "access to an ARRAY or RECORD", Section::has_sub_objects, "AccessType=rw"),
        added("OBJ006", "limits of an ARRAY or RECORD", Section::has_sub_objects, "HighLimit=100"),
    ]
}

fn structure() -> Vec<Defect> {
    vec![
        missing("OBJ007", "no SubNumber", "SubNumber", Section::has_sub_objects),
        value_of("OBJ008", "SubNumber one too large", "SubNumber", Section::is_object, |_, old| {
            Some((old.parse::<u16>().ok()? + 1).to_string())
        }),
        value_of("OBJ008", "SubNumber one too small", "SubNumber", Section::is_object, |_, old| {
            Some((old.parse::<u16>().ok()? - 1).to_string())
        }),
        Defect::new("OBJ008", "a sub-object is lost", |base| {
            let subs = base.sections_where(|section| section.is_sub_object() && is_free(section));
            let lost =
                subs.into_iter().filter(|section| section.sub_index() > Some(1)).filter_map(|section| {
                    let number = base.object(section.index()?)?.entry("SubNumber")?;
                    Some(Mutant::of(base).delete_section(section).expect(number.line))
                });
            lost.collect()
        }),
        Defect::new("OBJ010", "the section of an ARRAY or RECORD is lost", |base| {
            let objects = base.sections_where(|section| is_free_object(base, section));
            let lost = objects.into_iter().filter_map(|section| {
                let first = base.sub_object(section.index()?, 0)?;
                Some(Mutant::of(base).delete_section(section).expect(first.header))
            });
            lost.collect()
        }),
        Defect::new("OBJ010", "sub-objects of an object that is not there", |base| {
            let lists = base.sections_where(|section| section.name == "ManufacturerObjects");
            lists.into_iter().map(|_| Mutant::of(base).append_section("5FF0sub0", HIGHEST)).collect()
        }),
        Defect::new("OBJ011", "a VAR with sub-objects", |base| {
            let objects = base.sections_where(|section| is_free_object(base, section));
            let wrong = objects.into_iter().filter_map(|section| {
                let first = base.sub_object(section.index()?, 0)?;
                let mutant = Mutant::of(base).set(section.entry("ObjectType")?, "0x7");
                let mutant = mutant.insert_too(section.behind_entries(), "DataType=0x0007");
                Some(mutant.insert_too(section.behind_entries(), "AccessType=ro").expect(first.header))
            });
            wrong.collect()
        }),
        Defect::new("OBJ012", "no sub-index 00h", |base| {
            let objects = base.sections_where(Section::has_sub_objects);
            let lost = objects.into_iter().filter_map(|section| {
                let index = section.index()?;
                let subs = base.sub_objects(index).len();
                let mutant =
                    Mutant::of(base).delete_section(base.sub_object(index, 0)?).expect(section.header);
                Some(mutant.set_too(section.entry("SubNumber")?, &(subs - 1).to_string()))
            });
            lost.collect()
        }),
        value("OBJ013", "sub-index 00h of 32 bits", "DataType", is_highest, "0x0007"),
        value("OBJ013", "sub-index 00h with a sign", "DataType", is_highest, "0x0002"),
    ]
}

fn numbers() -> Vec<Defect> {
    vec![
        value_of("OBJ014", "sub-index 00h is too small", "DefaultValue", is_fixed_highest, |_, old| {
            Some((number(old)?.checked_sub(1)?).to_string()).filter(|new| new != "-1")
        }),
        value_of("OBJ014", "sub-index 00h is too large", "DefaultValue", is_full_highest, |_, old| {
            Some((number(old)? + 1).to_string()).filter(|_| old != "0")
        }),
        Defect::new("OBJ028", "sub-objects numbered in decimal", |base| {
            let objects = base.sections_where(Section::has_sub_objects).into_iter();
            objects.filter_map(|object| in_decimal(base, object.index()?)).collect()
        }),
        missing("OBJ029", "a DOMAIN without its data type", "DataType", |section| section.is_code(2)),
        missing("OBJ029", "a DOMAIN without its access", "AccessType", |section| section.is_code(2)),
        Defect::new("OBJ014", "the last sub-object is gone, but sub-index 00h counts it", |base| {
            let objects = base.sections_where(Section::has_sub_objects);
            let lost = objects.into_iter().filter_map(|section| {
                let index = section.index()?;
                let highest = base.sub_object(index, 0).filter(|highest| is_full_highest(highest))?;
                let value = highest.entry("DefaultValue")?;
                let last = base.sub_objects(index).last()?.value("PDOMapping") == "0";
                last.then(|| Some(without_last_sub_object(base, index)?.set(value, &value.value)))?
            });
            lost.collect()
        }),
        Defect::new("OBJ015", "an element of an ARRAY with another type", |base| {
            let subs =
                base.sections_where(|section| section.sub_index() > Some(1) && is_element(base, section));
            let entries = subs.into_iter().filter_map(|section| section.entry("DataType"));
            let other = |old: Option<i64>| if old == Some(6) { "0x0003" } else { "0x0006" };
            entries.map(|entry| Mutant::of(base).set(entry, other(entry.number()))).collect()
        }),
        value("OBJ016", "a RECORD that is an ARRAY", "ObjectType", is_record_of_cia301, "0x8"),
        value("OBJ016", "an ARRAY that is a RECORD", "ObjectType", is_array_of_cia301, "0x9"),
        added("OBJ026", "more entries possible than described", is_unlimited_highest, "HighLimit=200"),
        value("OBJ026", "a limit above the last described entry", "HighLimit", is_plain_highest, "200"),
        Defect::new("OBJ027", "a sub-index counted in decimal", |base| {
            let objects = base.sections_where(|section| section.has_sub_objects() && is_free(section));
            let lasts =
                objects.into_iter().filter_map(|section| base.sub_objects(section.index()?).last().copied());
            let free = lasts.filter(|last| last.value("PDOMapping") == "0");
            free.map(|last| Mutant::of(base).rewrite(last.header, format!("[{}sub100]", &last.name[..4])))
                .collect()
        }),
    ]
}

fn compact() -> Vec<Defect> {
    vec![
        added("OBJ009", "SubNumber besides CompactSubObj", is_compact, "SubNumber=5"),
        Defect::new("OBJ009", "a section for a compact sub-object", |base| {
            let objects = base.sections_where(is_compact);
            let entries = ["ParameterName=One", "ObjectType=0x7", "DataType=0x0006", "AccessType=rw"];
            let name = |section: &Section| format!("{}sub1", section.name);
            let more =
                |section: &Section| Mutant::of(base).insert_section(section.end, &name(section), &entries);
            objects.into_iter().map(more).collect()
        })
        .by_label(),
        value("OBJ017", "a wrong number of compact names", "NrOfEntries", is_compact_list, "7"),
        missing("OBJ017", "no number of compact names", "NrOfEntries", is_compact_list),
        value("OBJ017", "fewer compact sub-objects than names", "CompactSubObj", is_compact, "1").by_label(),
        Defect::new("OBJ017", "names of an object that is not compact", |base| {
            let objects =
                base.sections_where(|section| section.has_sub_objects() && section.is_of_manufacturer());
            let name = |section: &Section| format!("{}Name", section.name);
            let list = |section: &Section| {
                Mutant::of(base).append_section(&name(section), &["NrOfEntries=1", "1=One"])
            };
            objects.into_iter().map(list).collect()
        }),
        once("OBJ017", "names of an object that is not described", |base| {
            base.section("ManufacturerObjects")?;
            Some(Mutant::of(base).append_section("5FF0Name", &["NrOfEntries=1", "1=One"]))
        }),
    ]
}

fn flags() -> Vec<Defect> {
    vec![
        added("OBJ018", "reserved bits in ObjFlags", is_without_flags, "ObjFlags=0x11"),
        value("OBJ018", "ObjFlags with bit 31", "ObjFlags", |_| true, "0x80000001"),
        added("OBJ019", "ObjFlags of 0", is_without_flags, "ObjFlags=0x0"),
        missing("OBJ020", "store or restore without ObjFlags", "ObjFlags", Section::is_sub_object),
        Defect::new("OBJ025", "an object with the name of another", |base| {
            let objects =
                base.sections_where(|section| section.is_object() && !section.is_within(0x1200, 0x1BFF));
            let pairs = objects.windows(2).filter_map(|pair| {
                let name = pair[1].entry("ParameterName")?;
                Some(Mutant::of(base).set(name, pair[0].value("ParameterName")))
            });
            pairs.collect()
        })
        .by_label(),
    ]
}

fn links() -> Vec<Defect> {
    vec![
        value("OBJ021", "a link to an object that is not described", "1", is_links, "0x5FF0"),
        value("OBJ021", "a wrong number of links", "ObjectLinks", is_links, "5"),
        missing("OBJ021", "no number of links", "ObjectLinks", is_links),
        header("OBJ021", "links of an object that is not described", is_links, |_| {
            "[5FF0ObjectLinks]".to_owned()
        }),
    ]
}

fn mapping() -> Vec<Defect> {
    vec![
        value("OBJ022", "a word for PDOMapping", "PDOMapping", is_description, "yes"),
        value("OBJ022", "a PDOMapping of 2", "PDOMapping", is_description, "2"),
        added("OBJ022", "an SRDOMapping of 3", Section::is_variable, "SRDOMapping=3"),
        value("OBJ023", "a DOMAIN that can be mapped", "PDOMapping", |section| section.is_code(2), "1"),
        value("OBJ023", "a long text that can be mapped", "PDOMapping", is_long_text, "1"),
        value("OBJ023", "sub-index 00h that can be mapped", "PDOMapping", is_highest, "1"),
        value("OBJ024", "an access of process data without a mapping", "AccessType", is_unmapped, "rww"),
        value("OBJ024", "process data that cannot be mapped any more", "PDOMapping", is_process_data, "0")
            .by_label()
            .with_consequence("PDO006", "a PDO may map it"),
    ]
}

const HIGHEST: &[&str] = &[
    "ParameterName=Highest sub-index",
    "ObjectType=0x7",
    "DataType=0x0005",
    "AccessType=ro",
    "DefaultValue=1",
];

fn is_description(section: &Section) -> bool {
    section.index().is_some()
}

/// Not of a module: there the same object may have to be described twice alike.
fn is_described_value(section: &Section) -> bool {
    section.is_variable()
}

fn is_object_variable(section: &Section) -> bool {
    section.is_object() && section.is_code(7)
}

fn is_compact(section: &Section) -> bool {
    section.entry("CompactSubObj").is_some()
}

fn is_compact_list(section: &Section) -> bool {
    section.name.len() > 4 && section.name.ends_with("Name")
}

fn is_links(section: &Section) -> bool {
    section.name.ends_with("ObjectLinks")
}

/// Sub-index 00h.
fn is_highest(section: &Section) -> bool {
    section.sub_index() == Some(0)
}

/// Sub-index 00h that always has the same value.
fn is_fixed_highest(section: &Section) -> bool {
    is_highest(section)
        && section.value("AccessType") != "rw"
        && section.value("HighLimit").is_empty()
        && !section.is_within(0x1003, 0x1003)
        && !section.is_within(0x1600, 0x17FF)
        && !section.is_within(0x1A00, 0x1BFF)
}

/// The same of no ARRAY of the communication profile, which may leave elements out.
fn is_full_highest(section: &Section) -> bool {
    let is_record = section.is_within(0x1018, 0x1018) || section.is_within(0x1200, 0x1BFF);
    is_fixed_highest(section) && (is_record || !section.is_within(0x1000, 0x1FFF))
}

fn is_unlimited_highest(section: &Section) -> bool {
    is_plain_highest(section) && section.entry("HighLimit").is_none()
}

/// Sub-index 00h of an object of the manufacturer or of a device profile.
fn is_plain_highest(section: &Section) -> bool {
    is_highest(section) && section.is_within(0x2000, 0x9FFF)
}

/// An object on which no other rule depends.
fn is_free(section: &Section) -> bool {
    section.is_of_manufacturer() && section.value("PDOMapping") != "1"
}

/// An ARRAY or RECORD on which no other rule depends.
fn is_free_object(base: &Base, section: &Section) -> bool {
    let is_mapped = |index| base.sub_objects(index).iter().any(|sub| sub.value("PDOMapping") == "1");
    section.has_sub_objects()
        && section.is_of_manufacturer()
        && section.index().is_some_and(|index| !is_mapped(index))
}

fn is_element(base: &Base, section: &Section) -> bool {
    let array = section.index().and_then(|index| base.object(index));
    array.is_some_and(|array| array.is_code(8) && array.is_of_manufacturer())
        && section.value("PDOMapping") == "1"
}

fn is_record_of_cia301(section: &Section) -> bool {
    section.is_object()
        && section.is_code(9)
        && (section.is_within(0x1018, 0x1018) || section.is_within(0x1200, 0x1BFF))
}

fn is_array_of_cia301(section: &Section) -> bool {
    let arrays = [0x1003, 0x1010, 0x1011, 0x1016, 0x1029];
    section.is_object() && section.index().is_some_and(|index| arrays.contains(&index))
}

fn is_long_text(section: &Section) -> bool {
    section.is_type(9) && section.value("DefaultValue").len() > 8
}

fn is_unmapped(section: &Section) -> bool {
    section.is_of_manufacturer() && section.value("AccessType") == "rw" && section.value("PDOMapping") == "0"
}

fn is_process_data(section: &Section) -> bool {
    section.is_variable() && section.value("AccessType") == "rww"
}

/// An object whose sub-objects are named by decimal numbers; `None` where there are too few, or a gap.
fn in_decimal(base: &Base, index: u16) -> Option<Mutant> {
    let subs = base.sub_objects(index);
    let count = base.sub_object(index, 0)?;
    let counts = ["DefaultValue", "HighLimit"].map(|key| count.number(key));
    let is_whole = subs.iter().enumerate().all(|(due, sub)| sub.sub_index().map(usize::from) == Some(due));
    if subs.len() <= 10 || !is_whole || !counts.contains(&i64::try_from(subs.len() - 1).ok()) {
        return None;
    }
    let named = subs.iter().enumerate().skip(10).fold(Mutant::of(base), |mutant, (number, sub)| {
        mutant.rewrite_too(sub.header, format!("[{index:X}sub{number}]"))
    });
    Some(named.expect(subs[10].header))
}

/// An object that is a variable and says nothing of downloads.
fn is_without_flags(section: &Section) -> bool {
    is_object_variable(section) && section.value("ObjFlags").is_empty()
}
