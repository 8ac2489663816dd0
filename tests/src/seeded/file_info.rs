//! FIL: `[FileInfo]`.

use super::base::{Kind, Section};
use super::defect::{Defect, missing, once, value, value_of};
use super::mutant::Mutant;

pub(super) fn defects() -> Vec<Defect> {
    [sections(), versions(), times(), dates(), names()].into_iter().flatten().collect()
}

fn sections() -> Vec<Defect> {
    vec![
        once("FIL001", "no `[FileInfo]`", |base| {
            let section = base.section("FileInfo")?;
            Some(Mutant::of(base).delete_section(section).delete(section.end).expect_first())
        }),
        lost("FileName"),
        lost("FileVersion"),
        lost("FileRevision"),
        lost("Description"),
        lost("CreationDate"),
        lost("ModifiedBy"),
        value("FIL002", "an empty CreationTime", "CreationTime", is_info, ""),
    ]
}

fn lost(key: &'static str) -> Defect {
    missing("FIL002", format!("no {key}"), key, is_info)
}

fn versions() -> Vec<Defect> {
    vec![
        value("FIL003", "a file version with a dot", "FileVersion", is_info, "1.0"),
        value("FIL003", "a file revision above 255", "FileRevision", is_info, "256"),
        value("FIL003", "a file revision as a letter", "FileRevision", is_info, "B"),
        value("FIL004", "an edition without a dot", "EDSVersion", is_info, "4"),
        value("FIL004", "an edition of three digits", "EDSVersion", is_info, "4.02"),
        value("FIL004", "an old edition", "EDSVersion", is_info, "3.0"),
        missing("FIL004", "no EDSVersion", "EDSVersion", is_info),
    ]
}

fn times() -> Vec<Defect> {
    vec![
        value("FIL005", "a time of 24 hours", "CreationTime", is_info, "17:24"),
        value("FIL005", "a blank before AM", "CreationTime", is_info, "09:45 AM"),
        value("FIL005", "an hour 00", "ModificationTime", is_info, "00:10AM"),
        value("FIL005", "an hour of one digit", "ModificationTime", is_info, "9:45AM"),
        value("FIL005", "a minute 60", "ModificationTime", is_info, "09:60AM"),
    ]
}

fn dates() -> Vec<Defect> {
    vec![
        value("FIL006", "a date as of ISO 8601", "CreationDate", is_info, "2016-03-25"),
        value("FIL006", "a date with dots", "CreationDate", is_info, "03.25.2004"),
        value("FIL006", "the day before the month", "CreationDate", is_info, "25-03-2004"),
        value("FIL006", "a year of two digits", "ModificationDate", is_info, "03-25-26"),
        value("FIL007", "a date that is on no calendar", "CreationDate", is_info, "02-30-2004"),
        value("FIL007", "a leap day of a common year", "CreationDate", is_info, "02-29-2003"),
        value("FIL007", "modified before it was created", "ModificationDate", is_info, "01-01-1999"),
    ]
}

fn names() -> Vec<Defect> {
    vec![
        value_of("FIL008", "the name of another file", "FileName", is_info, |_, old| {
            Some(format!("old-{old}"))
        }),
        value_of(
            "FIL009",
            "a ParameterName of 242 characters",
            "ParameterName",
            |_| true,
            |_, old| Some(format!("{old:.<242}")),
        ),
        value_of("FIL009", "a Description of 244 characters", "Description", is_info, |_, old| {
            Some(format!("{old:.<244}"))
        }),
        value_of(
            "FIL009",
            "an OrderCode of 246 characters",
            "OrderCode",
            |_| true,
            |_, old| Some(format!("{old:.<246}")),
        ),
        once("FIL010", "LastEDS in an EDS", |base| {
            let info = base.section("FileInfo").filter(|_| base.kind == Kind::Eds)?;
            Some(Mutant::of(base).insert(info.behind_entries(), "LastEDS=older.eds"))
        }),
        missing("FIL010", "no LastEDS in a DCF", "LastEDS", is_info),
    ]
}

fn is_info(section: &Section) -> bool {
    section.name == "FileInfo"
}
