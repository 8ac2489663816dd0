//! STY: style.

use super::base::{Base, Section};
use super::defect::{Defect, once, value};
use super::mutant::Mutant;

pub(super) fn defects() -> Vec<Defect> {
    vec![
        Defect::new("STY001", "an object before the one with the lower index", |base| {
            let sections = base.sections();
            let pairs = sections.windows(2).filter(|pair| {
                pair.iter().all(|section| section.is_object() && section.is_code(7))
                    && pair[0].end + 1 == pair[1].header
            });
            pairs.map(|pair| swapped(base, &pair[0], &pair[1])).collect()
        }),
        Defect::new("STY001", "a sub-object before the one with the lower sub-index", |base| {
            let sections = base.sections();
            let pairs = sections.windows(2).filter(|pair| {
                pair.iter().all(|section| section.is_sub_object()) && pair[0].index() == pair[1].index()
            });
            pairs.map(|pair| swapped(base, &pair[0], &pair[1])).collect()
        }),
        once("STY001", "`[DeviceInfo]` behind the objects", |base| {
            let info = base.section("DeviceInfo")?;
            let lines: Vec<&str> = info.entries.iter().map(|entry| &*base.lines[entry.line].text).collect();
            Some(Mutant::of(base).delete_section(info).append_section(&info.name, &lines))
        }),
        Defect::new("STY002", "small hexadecimal digits among capital ones", |base| {
            let values = base.sections().iter().filter_map(|section| section.entry("DefaultValue"));
            let hexadecimal = values.filter(|entry| {
                entry.value.starts_with("0x")
                    && entry.value.bytes().skip(2).any(|byte| byte.is_ascii_uppercase())
            });
            hexadecimal.map(|entry| Mutant::of(base).set(entry, &entry.value.to_ascii_lowercase())).collect()
        }),
        Defect::new("STY002", "`0X` for `0x`", |base| {
            let types = base.sections().iter().filter_map(|section| section.entry("DataType"));
            types.map(|entry| Mutant::of(base).set(entry, &entry.value.replace("0x", "0X"))).collect()
        }),
        Defect::new("STY003", "blanks at the end of a line", |base| {
            let entries = base.sections().iter().flat_map(|section| &section.entries);
            entries
                .map(|entry| Mutant::of(base).rewrite(entry.line, format!("{}={}  ", entry.key, entry.value)))
                .collect()
        }),
        once("STY003", "no line break at the end", |base| {
            Some(Mutant::of(base).end_line(base.lines.len() - 1, ""))
        }),
        value("STY004", "an order code that is still to do", "OrderCode", |_| true, "TBD"),
        value("STY004", "a vendor's name from a form", "VendorName", |_| true, "<vendor name>"),
        value("STY004", "a name that is still to do", "ParameterName", Section::is_object, "unknown"),
        value("STY004", "a description that is still to do", "Description", |_| true, "TODO"),
    ]
}

/// The second section before the first; the finding is expected at the one that comes too late.
fn swapped(base: &Base, first: &Section, second: &Section) -> Mutant {
    let mutant = Mutant::of(base).delete_section(first);
    let lines = (first.header..first.end).map(|line| base.lines[line].text.clone());
    let mutant = mutant.insert_too(second.end, "");
    lines.enumerate().fold(mutant, |mutant, (number, line)| {
        if number == 0 { mutant.insert(second.end, line) } else { mutant.insert_too(second.end, line) }
    })
}
