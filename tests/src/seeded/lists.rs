//! LST: the lists of objects.

use super::base::{Base, Section};
use super::defect::{Defect, missing, once, value_of};
use super::dictionary::{also_listed, items, unlisted, without_object};
use super::mutant::Mutant;

pub(super) fn defects() -> Vec<Defect> {
    [lists(), counts(), items_and_sections(), wrong_places(), indices()].into_iter().flatten().collect()
}

fn lists() -> Vec<Defect> {
    vec![
        list_gone("no list of mandatory objects", "MandatoryObjects"),
        list_gone("no list of optional objects", "OptionalObjects"),
        list_gone("no list of manufacturer objects", "ManufacturerObjects"),
    ]
}

fn list_gone(kind: &'static str, name: &'static str) -> Defect {
    once("LST001", kind, move |base| {
        let list = base.section(name)?;
        Some(Mutant::of(base).delete_section(list).expect_first())
    })
}

fn counts() -> Vec<Defect> {
    vec![
        count("SupportedObjects one too large", 1),
        count("SupportedObjects one too small", -1),
        missing("LST002", "no SupportedObjects", "SupportedObjects", Section::is_list),
        Defect::new("LST002", "the last item of a list is lost", |base| {
            let lists = base.lists().into_iter();
            let cut = lists.filter_map(|list| {
                let mutant = Mutant::of(base).delete(list.items().last()?.line);
                Some(mutant.expect(list.entry("SupportedObjects")?.line))
            });
            cut.collect()
        }),
        Defect::new("LST003", "an item left out of the numbering", |base| {
            renumbered(base, |number, last| (number == last).then(|| (last + 1).to_string()))
        }),
        Defect::new("LST003", "a list that begins with 0", |base| {
            let lists = base.lists().into_iter();
            let shifted = lists.filter(|list| !list.items().is_empty()).map(|list| {
                list.items().iter().fold(Mutant::of(base), |mutant, item| {
                    let number: usize = item.key.parse().unwrap_or_default();
                    let text = format!("{}={}", number - 1, item.value);
                    if number == 1 {
                        mutant.rewrite(item.line, text)
                    } else {
                        mutant.rewrite_too(item.line, text)
                    }
                })
            });
            shifted.collect()
        }),
        Defect::new("LST003", "a number in the midst that belongs elsewhere", |base| {
            renumbered(base, |number, last| (number > 1 && number < last).then(|| (number + 80).to_string()))
        }),
        Defect::new("LST003", "an item with a leading zero", |base| {
            renumbered(base, |number, last| (number == last).then(|| format!("0{number}")))
        }),
    ]
}

fn count(kind: &'static str, by: i64) -> Defect {
    value_of("LST002", kind, "SupportedObjects", Section::is_list, move |_, old| {
        let count = old.parse::<i64>().ok()? + by;
        (count >= 0).then(|| count.to_string())
    })
}

/// Items with another key, one at a time.
fn renumbered(base: &Base, new: fn(usize, usize) -> Option<String>) -> Vec<Mutant> {
    let items = items(base).into_iter();
    let changed = items.filter_map(|(list, item)| {
        let key = new(item.key.parse().ok()?, list.items().len())?;
        Some(Mutant::of(base).rewrite(item.line, format!("{key}={}", item.value)))
    });
    changed.collect()
}

fn items_and_sections() -> Vec<Defect> {
    vec![
        Defect::new("LST004", "a listed object without a section", |base| {
            let variables = base.sections_where(|section| is_plain_variable(base, section));
            let gone = variables.into_iter().filter_map(|section| {
                let (_, item) = base.listed(section.index()?)?;
                Some(Mutant::of(base).delete_section(section).expect(item.line))
            });
            gone.collect()
        }),
        Defect::new("LST004", "a listed index that does not exist", |base| {
            let lists = base.sections_where(|section| section.name == "ManufacturerObjects").into_iter();
            let more = lists.filter_map(|list| {
                let count = list.entry("SupportedObjects")?;
                let more = list.items().len() + 1;
                let mutant = Mutant::of(base).set_too(count, &more.to_string());
                Some(mutant.insert(list.behind_entries(), format!("{more}=0x5FF0")))
            });
            more.collect()
        }),
        Defect::new("LST005", "an object that is not listed", |base| {
            let objects = base.sections_where(|section| section.is_object() && !is_mandatory(section));
            let unlisted = objects
                .into_iter()
                .filter_map(|section| Some(unlisted(base, section.index()?)?.expect(section.header)));
            unlisted.collect()
        }),
        Defect::new("LST006", "an object that is listed twice", |base| {
            let listed = items(base).into_iter();
            let twice = listed.filter_map(|(list, item)| {
                let count = list.entry("SupportedObjects")?;
                let more = list.items().len() + 1;
                let mutant = Mutant::of(base).set_too(count, &more.to_string());
                Some(mutant.insert(list.behind_entries(), format!("{more}={}", item.value)))
            });
            twice.collect()
        }),
        mandatory_gone("no device type", 0x1000),
        mandatory_gone("no error register", 0x1001)
            .with_consequence("PDO004", "a PDO of the drive maps the error register"),
        mandatory_gone("no identity object", 0x1018),
    ]
}

fn mandatory_gone(kind: &'static str, index: u16) -> Defect {
    once("LST007", kind, move |base| {
        Some(without_object(base, index)?.expect(base.section("MandatoryObjects")?.header))
    })
}

fn wrong_places() -> Vec<Defect> {
    vec![
        moved("LST008", "a manufacturer object among the optional ones", 0x2000, "OptionalObjects"),
        moved("LST008", "an optional object among those of the manufacturer", 0x1017, "ManufacturerObjects"),
        moved("LST008", "the error register among the optional objects", 0x1001, "OptionalObjects"),
        moved("LST009", "the heartbeat among the mandatory objects", 0x1017, "MandatoryObjects"),
        moved("LST009", "the EMCY message among the mandatory objects", 0x1014, "MandatoryObjects"),
    ]
}

/// An object that is listed in another list; the finding is expected at the item there.
fn moved(rule: &'static str, kind: &'static str, index: u16, list: &'static str) -> Defect {
    once(rule, kind, move |base| {
        let list = base.section(list)?;
        let count = list.entry("SupportedObjects")?;
        let more = list.items().len() + 1;
        let mutant = unlisted(base, index)?.set_too(count, &more.to_string());
        Some(mutant.insert(list.behind_entries(), format!("{more}=0x{index:04X}")))
    })
}

fn indices() -> Vec<Defect> {
    vec![
        reserved("an object beyond the last index", "C100"),
        reserved("an object among reserved data types", "0300"),
        once("LST010", "an object of an old edition", |base| {
            let list = base.section("OptionalObjects")?;
            let line = base.sections().iter().find(|section| section.name == "1014")?.header;
            let mutant = also_listed(Mutant::of(base), list, 0x100F)?;
            let mutant = mutant.insert(line, "[100F]");
            Some(NEW_VARIABLE.iter().fold(mutant, |mutant, entry| mutant.insert_too(line, *entry)))
        }),
        Defect::new("LST011", "an index without its `0x`", |base| {
            let items = items(base)
                .into_iter()
                .filter(|(_, item)| item.value.bytes().skip(2).all(|byte| byte.is_ascii_digit()));
            items.map(|(_, item)| Mutant::of(base).set(item, &item.value[2..])).collect()
        }),
    ]
}

fn reserved(kind: &'static str, name: &'static str) -> Defect {
    once("LST010", kind, move |base| {
        base.section("DeviceInfo")?;
        Some(Mutant::of(base).append_section(name, NEW_VARIABLE))
    })
}

const NEW_VARIABLE: &[&str] =
    &["ParameterName=New", "ObjectType=0x7", "DataType=0x0007", "AccessType=ro", "DefaultValue=1"];

fn is_mandatory(section: &Section) -> bool {
    matches!(section.index(), Some(0x1000 | 0x1001 | 0x1018))
}

/// An object without sub-objects to which nothing else leads.
fn is_plain_variable(base: &Base, section: &Section) -> bool {
    let is_linked = || {
        let links = base.sections_where(|section| section.name.ends_with("ObjectLinks"));
        let name = format!("0x{}", section.name);
        links.iter().any(|links| links.entries.iter().any(|entry| entry.value == name))
    };
    section.is_object()
        && section.is_code(7)
        && !is_mandatory(section)
        && section.value("PDOMapping") == "0"
        && !is_linked()
}
