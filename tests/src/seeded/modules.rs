//! MOD: modular devices.

use super::base::Section;
use super::defect::{Defect, item, missing, once, value, value_of};
use super::dictionary::without_object;
use super::mutant::Mutant;

pub(super) fn defects() -> Vec<Defect> {
    [numbers(), values(), objects()].into_iter().flatten().collect()
}

fn numbers() -> Vec<Defect> {
    vec![
        value_of("MOD001", "more modules than described", "NrOfEntries", is_supported, |_, old| more(old)),
        value_of("MOD001", "fewer modules than described", "NrOfEntries", is_supported, |_, old| fewer(old))
            .by_label(),
        missing("MOD001", "no number of modules", "NrOfEntries", is_supported),
        Defect::new("MOD001", "a module without `[MxModuleInfo]`", |base| {
            let infos = base.sections_where(|section| section.name.ends_with("ModuleInfo"));
            let gone = infos.into_iter().filter_map(|info| {
                let module = info.name.trim_end_matches("ModuleInfo");
                let is_other =
                    |section: &&Section| section.name.starts_with(module) && section.name != info.name;
                let next = base.sections().iter().find(is_other)?;
                Some(Mutant::of(base).delete_section(info).expect(next.header))
            });
            gone.collect()
        }),
        once("MOD001", "modules without `[SupportedModules]`", |base| {
            let section = base.section("SupportedModules")?;
            let first = base.section("M1ModuleInfo")?.header;
            Some(Mutant::of(base).delete_section(section).expect(first))
        }),
        value_of(
            "MOD007",
            "an object of a module more than listed",
            "NrOfEntries",
            is_module_list,
            |_, old| more(old),
        ),
        value_of(
            "MOD007",
            "an object of a module less than listed",
            "NrOfEntries",
            is_module_list,
            |_, old| fewer(old),
        ),
        missing("MOD007", "no number of a module's objects", "NrOfEntries", is_module_list),
        Defect::new("MOD007", "a gap in a module's list", |base| {
            let lists = base.sections_where(is_module_list).into_iter();
            let changed = lists.filter_map(|list| {
                let last = list.items().last().copied()?;
                Some(
                    Mutant::of(base)
                        .rewrite(last.line, format!("{}={}", last.key.parse::<u16>().ok()? + 3, last.value)),
                )
            });
            changed.collect()
        }),
        once("MOD009", "modules without a module list", |base| {
            Some(without_object(base, 0x1027)?.expect(base.section("SupportedModules")?.header))
        }),
        once("MOD009", "a module list without modules", |base| {
            if base.section("SupportedModules").is_some() {
                return None;
            }
            let line = base.section("1F80").or(base.section("1200"))?.header;
            let mutant =
                super::dictionary::also_listed(Mutant::of(base), base.section("OptionalObjects")?, 0x1027)?;
            let mutant = mutant.insert_section(
                line,
                "1027",
                &["ParameterName=Module list", "ObjectType=0x8", "SubNumber=2", ""],
            );
            let lines = [
                "[1027sub0]",
                "ParameterName=Modules",
                "ObjectType=0x7",
                "DataType=0x0005",
                "AccessType=ro",
                "DefaultValue=1",
                "",
                "[1027sub1]",
                "ParameterName=Module 1",
                "ObjectType=0x7",
                "DataType=0x0006",
                "AccessType=ro",
                "",
            ];
            Some(lines.iter().fold(mutant, |mutant, text| mutant.insert_too(line, *text)))
        }),
    ]
}

fn values() -> Vec<Defect> {
    vec![
        value("MOD002", "a Count of two numbers", "Count", |_| true, "2,8"),
        value("MOD002", "a Count in words", "Count", |_| true, "one"),
        value("MOD002", "a Count of sub-indices and bits", "Count", |_| true, "1;4"),
        missing("MOD002", "no Count", "Count", |_| true),
        item("MOD002", "a connected module that does not exist", is_connected, "9"),
        value(
            "MOD008",
            "a module with another data type of the object",
            "DataType",
            |section| section.name == "M2SubExt6000",
            "0x0006",
        ),
        value(
            "MOD008",
            "a module with another access to the object",
            "AccessType",
            |section| section.name == "M2SubExt6000",
            "rw",
        ),
        value(
            "MOD008",
            "a module that excludes the object from PDOs",
            "PDOMapping",
            |section| section.name == "M2SubExt6000",
            "0",
        ),
    ]
}

fn objects() -> Vec<Defect> {
    vec![
        Defect::new("MOD003", "an object of the device that a module brings", |base| {
            let lists = base.sections_where(|section| section.name.ends_with("FixedObjects")).into_iter();
            let more = lists.filter_map(|list| {
                let item = list.items().last().copied()?;
                let fixed =
                    base.section(&format!("{}{}", list.name.trim_end_matches("Objects"), &item.value[2..]))?;
                let mutant = Mutant::of(base).set(item, "0x2000");
                let name = format!("[{}2000]", list.name.trim_end_matches("Objects"));
                let subs =
                    base.sections_where(|section| section.name.starts_with(&format!("{}sub", fixed.name)));
                let mutant = mutant.rewrite_too(fixed.header, name);
                Some(subs.into_iter().fold(mutant, |mutant, sub| {
                    mutant.rewrite_too(
                        sub.header,
                        format!(
                            "[{}2000{}]",
                            list.name.trim_end_matches("Objects"),
                            &sub.name[fixed.name.len()..]
                        ),
                    )
                }))
            });
            more.collect()
        }),
        Defect::new("MOD004", "an object that one module brings and another extends", |base| {
            let lists = base.sections_where(|section| section.name.ends_with("SubExtends")).into_iter();
            let more = lists.filter_map(|list| {
                let item = list.items().last().copied()?;
                let module = list.name.trim_end_matches("Extends");
                let extension = base.section(&format!("{module}Ext{}", &item.value[2..]))?;
                let mutant = Mutant::of(base).set(item, "0x2100");
                Some(mutant.rewrite_too(extension.header, format!("[{module}Ext2100]")))
            });
            more.collect()
        }),
        Defect::new("MOD005", "a listed object of a module without a section", |base| {
            let items = base.sections_where(|section| {
                section.name.ends_with("FixedObjects") || section.name.ends_with("SubExtends")
            });
            let items = items.into_iter().flat_map(|list| list.items());
            items.map(|item| Mutant::of(base).set(item, "0x5FF0")).collect()
        }),
        Defect::new("MOD005", "the section of a module's object is lost", |base| {
            let sections =
                base.sections_where(|section| is_of_module(section) && section.entry("SubNumber").is_none());
            let gone = sections.into_iter().filter_map(|section| {
                let (kind, index) = section.name.split_at(section.name.len().checked_sub(4)?);
                let list =
                    base.section(&kind.replace("Fixed", "FixedObjects").replace("SubExt", "SubExtends"))?;
                let item = list.items().into_iter().find(|item| item.value == format!("0x{index}"))?;
                Some(Mutant::of(base).delete_section(section).expect(item.line))
            });
            gone.collect()
        }),
        Defect::new("MOD006", "an object of a module that is not listed", |base| {
            let lists = base.sections_where(|section| {
                section.name.ends_with("FixedObjects") || section.name.ends_with("SubExtends")
            });
            let gone = lists.into_iter().filter_map(|list| {
                let item = list.items().last().copied()?;
                let kind = list.name.replace("FixedObjects", "Fixed").replace("SubExtends", "SubExt");
                let section = base.section(&format!("{kind}{}", &item.value[2..]))?;
                let mutant = Mutant::of(base).delete(item.line);
                let mutant =
                    mutant.set_too(list.entry("NrOfEntries")?, &(list.items().len() - 1).to_string());
                Some(mutant.expect(section.header))
            });
            gone.collect()
        }),
    ]
}

fn more(count: &str) -> Option<String> {
    Some((count.parse::<u16>().ok()? + 1).to_string())
}

fn fewer(count: &str) -> Option<String> {
    Some((count.parse::<u16>().ok()? - 1).to_string())
}

fn is_supported(section: &Section) -> bool {
    section.name == "SupportedModules"
}

fn is_connected(section: &Section) -> bool {
    section.name == "ConnectedModules"
}

fn is_module_list(section: &Section) -> bool {
    section.name.ends_with("FixedObjects") || section.name.ends_with("SubExtends") || is_connected(section)
}

fn is_of_module(section: &Section) -> bool {
    let is_named = section.name.contains("Fixed") || section.name.contains("SubExt");
    is_named && section.entry("ParameterName").is_some() && !section.name.contains("sub")
}
