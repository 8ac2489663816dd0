//! SYN: lines, sections and keys.

use super::base::{Base, Entry, Section};
use super::defect::{Defect, added, header, line_before, missing, once, value_of};
use super::mutant::Mutant;

pub(super) fn defects() -> Vec<Defect> {
    [foreign_files(), characters(), headers(), lines(), comments(), doubles(), names()]
        .into_iter()
        .flatten()
        .collect()
}

fn foreign_files() -> Vec<Defect> {
    vec![
        once("SYN000", "an XML file with this ending", |base| {
            Some(Mutant::other_file(base, "<?xml version=\"1.0\"?>\n<ISO15745ProfileContainer/>\n"))
        }),
        once("SYN000", "an archive with this ending", |base| {
            Some(Mutant::other_file(base, "PK\u{3}\u{4}\u{14}\u{0}\u{0}\u{0}\u{8}\u{0}"))
        }),
        once("SYN000", "an empty file", |base| Some(Mutant::other_file(base, ""))),
        once("SYN000", "text in UTF-16", |base| {
            let encoded = |text: &str| text.encode_utf16().flat_map(u16::to_le_bytes).collect();
            Some(Mutant::other_file(base, &format!("\u{FEFF}{}", base.text())).encode(encoded))
        }),
    ]
}

fn characters() -> Vec<Defect> {
    vec![
        value_of(
            "SYN001",
            "a letter in UTF-8 beyond ASCII",
            "ParameterName",
            Section::is_object,
            |_, old| Some(format!("{old} \u{FC}")),
        ),
        Defect::new("SYN001", "a letter in Latin-1 beyond ASCII", |base| {
            let latin1 = |text: &str| text.chars().map(|letter| letter as u8).collect();
            let names = base.sections_where(|section| section.entry("VendorName").is_some());
            let entries = names.iter().filter_map(|section| section.entry("VendorName"));
            entries.map(|entry| Mutant::of(base).set(entry, "Fr\u{E4}se").encode(latin1)).collect()
        }),
        once("SYN002", "a byte order mark", |base| {
            Some(Mutant::of(base).rewrite(0, format!("\u{FEFF}{}", base.lines[0].text)))
        }),
        Defect::new("SYN003", "a comment of 300 characters", |base| {
            let comment = format!(";{}", "-".repeat(299));
            let sections = base.sections().iter();
            sections.map(|section| Mutant::of(base).insert(section.header, &comment)).collect()
        }),
        Defect::new("SYN004", "one line that ends with LF or CR LF, unlike the others", |base| {
            at_lines(base, if base.lines[0].ending == "\n" { "\r\n" } else { "\n" })
        }),
        Defect::new("SYN004", "a lone CR", |base| at_lines(base, "\r")),
        value_of("SYN025", "a NUL in a name", "ParameterName", |_| true, |_, old| Some(format!("{old}\0"))),
        line_before("SYN025", "an escape character in a comment", |_| true, "; \u{1B}[1m"),
        once("SYN025", "the end mark of DOS", |base| {
            Some(Mutant::of(base).insert(base.lines.len(), "\u{1A}"))
        }),
    ]
}

fn headers() -> Vec<Defect> {
    vec![
        header("SYN005", "blanks before a header", |_| true, |section| format!("  [{}]", section.name)),
        header("SYN005", "a tab before a header", |_| true, |section| format!("\t[{}]", section.name)),
        header("SYN006", "a header without `]`", |_| true, |section| format!("[{}", section.name)),
        header("SYN006", "text behind a header", |_| true, |section| format!("[{}] old", section.name)),
        header("SYN006", "blanks inside the brackets", |_| true, |section| format!("[ {} ]", section.name)),
        line_before("SYN006", "a header without a name", |section| section.header > 0, "[]"),
        once("SYN007", "an entry before the first section", |base| {
            Some(Mutant::of(base).insert(0, "FileName=other.eds"))
        }),
        once("SYN007", "the first header is lost", |base| {
            let first = &base.sections()[0];
            Some(Mutant::of(base).delete(first.header).expect(first.header + 1))
        }),
    ]
}

fn lines() -> Vec<Defect> {
    vec![
        added("SYN008", "a line of text", |_| true, "not used any more"),
        added("SYN008", "a value without a key", |_| true, "=0x10"),
        added("SYN008", "a mark of a merge conflict", |_| true, "<<<<<<< HEAD"),
        Defect::new("SYN008", "a merge conflict", |base| {
            let entries = base.sections().iter().filter_map(|section| section.entries.last());
            let conflict = entries.map(|entry| {
                let behind = entry.line + 1;
                let mutant =
                    Mutant::of(base).insert(entry.line, "<<<<<<< HEAD").insert_too(behind, "=======");
                let mutant = mutant.insert_too(behind, format!("{}={}1", entry.key, entry.value));
                mutant.insert_too(behind, ">>>>>>> theirs")
            });
            conflict.collect()
        }),
        Defect::new("SYN008", "a merge conflict in the style of diff3", |base| {
            let sections = base.sections_where(|section| section.is_object()).into_iter();
            let conflict = sections.map(|section| {
                let mutant = Mutant::of(base).insert(section.header, "<<<<<<< HEAD");
                ["||||||| base", "[2FFF]", "ParameterName=old", "=======", "[2FFE]", ">>>>>>> theirs"]
                    .into_iter()
                    .fold(mutant, |mutant, line| mutant.insert_too(section.header, line))
            });
            conflict.collect()
        }),
        Defect::new("SYN008", "a lost `=`", |base| {
            let entries = base.sections().iter().filter_map(|section| section.entry("PDOMapping"));
            entries.map(|entry| Mutant::of(base).rewrite(entry.line, "PDOMapping 0")).collect()
        }),
        Defect::new("SYN008", "a lost line break before a header", |base| {
            let pairs = base.sections().windows(2).filter(|pair| pair[0].is_variable());
            let joined = pairs.map(|pair| {
                let last = &base.lines[pair[0].end - 1].text;
                let mutant = Mutant::of(base).rewrite(pair[0].end - 1, format!("{last}[{}]", pair[1].name));
                mutant.delete(pair[1].header)
            });
            joined.collect()
        })
        .with_consequence("PDO018", SWALLOWED)
        .with_consequence("SYN017", SWALLOWED)
        .with_consequence("VAL002", SWALLOWED),
        Defect::new("SYN009", "a blank before the `=`", |base| {
            entries(base, |key, value| format!("{key} = {value}"))
        }),
        Defect::new("SYN009", "a tab before the `=`", |base| {
            entries(base, |key, value| format!("{key}\t={value}"))
        }),
        Defect::new("SYN026", "blanks before a key", |base| {
            entries(base, |key, value| format!("  {key}={value}"))
        }),
    ]
}

const SWALLOWED: &str =
    "until the line break is back, a section is gone and its values belong to another one";

fn comments() -> Vec<Defect> {
    vec![
        line_before("SYN010", "blanks before a comment", |_| true, "  ; the next one"),
        line_before("SYN011", "a comment with `#`", |_| true, "# the next one"),
        Defect::new("SYN011", "an entry that is switched off with `#`", |base| {
            let entries = base.sections().iter().filter_map(|section| section.entry("PDOMapping"));
            entries.map(|entry| Mutant::of(base).rewrite(entry.line, "#PDOMapping=0")).collect()
        }),
        line_before("SYN027", "a suppression without a finding", |_| true, ";edskit: allow(SYN013) copied"),
        line_before(
            "SYN027",
            "a suppression in capitals without a finding",
            |_| true,
            ";EDSKIT: allow(SYN013)",
        ),
        line_before("SYN027", "a suppression without its colon", |_| true, ";edskit allow(SYN013) copied"),
        line_before("SYN027", "a suppression of an unknown rule", |_| true, ";edskit: allow(OBJ999) copied"),
        value_of(
            "SYN012",
            "a comment behind a data type",
            "DataType",
            |_| true,
            |_, old| Some(format!("{old} ; as measured")),
        ),
        value_of(
            "SYN012",
            "a comment behind an access type",
            "AccessType",
            |_| true,
            |_, old| Some(format!("{old} # by SDO")),
        ),
        value_of(
            "SYN012",
            "a comment behind a flag",
            "PDOMapping",
            |_| true,
            |_, old| Some(format!("{old} ;no")),
        ),
        value_of(
            "SYN012",
            "a comment behind a number",
            "SubNumber",
            |_| true,
            |_, old| Some(format!("{old}\t; with sub0")),
        ),
        value_of("SYN012", "a comment behind a default value", "DefaultValue", is_integer, |_, old| {
            Some(format!("{old} ; factory setting"))
        }),
        value_of(
            "SYN012",
            "a comment behind a date",
            "CreationDate",
            |_| true,
            |_, old| Some(format!("{old} ; a Monday")),
        ),
    ]
}

fn doubles() -> Vec<Defect> {
    vec![
        Defect::new("SYN013", "a section that stands twice", |base| {
            let sections = base.sections_where(|section| !section.entries.is_empty());
            sections.into_iter().map(|section| again(base, section, section.name.clone())).collect()
        }),
        Defect::new("SYN013", "a section that stands twice, in other case", |base| {
            let sections = base.sections_where(|section| !is_digits(&section.name));
            sections.into_iter().map(|section| again(base, section, other_case(&section.name))).collect()
        }),
        Defect::new("SYN014", "a key that stands twice", |base| {
            let keys = ["ParameterName", "DefaultValue", "NrOfEntries", "NodeID", "Nodes", "Granularity"];
            doubled(base, &keys, |key, value| format!("{key}={value}1"))
        }),
        Defect::new("SYN014", "a key that stands twice with the same value", |base| {
            doubled(base, &["AccessType", "ObjectType", "NetName"], |key, value| format!("{key}={value}"))
        }),
        Defect::new("SYN014", "a number of a list that stands twice", |base| {
            let lists = base.sections_where(|section| section.items().len() > 2).into_iter();
            let twice = lists.filter(|list| list.items()[1].key == "2").map(|list| {
                let item = list.items()[2].clone();
                Mutant::of(base).rewrite(item.line, format!("2={}", item.value))
            });
            twice.collect()
        }),
        Defect::new("SYN014", "a key that stands twice, in other case", |base| {
            let keys = ["AccessType", "VendorName", "NetName"];
            doubled(base, &keys, |key, value| format!("{}={value}x", key.to_ascii_uppercase()))
        }),
        Defect::new("SYN015", "a sub-object again with a zero more", |base| {
            let sections = base.sections_where(is_below_16);
            sections.into_iter().map(|section| again(base, section, padded(section))).collect()
        }),
        Defect::new("SYN015", "an object again with `0x`", |base| {
            let sections = base.sections_where(Section::is_object);
            let name = |section: &Section| format!("0x{}", section.name);
            sections.into_iter().map(|section| again(base, section, name(section))).collect()
        }),
        header("SYN016", "a sub-index with a zero too many", is_below_16, |section| {
            format!("[{}]", padded(section))
        }),
        header("SYN016", "an index with `0x`", Section::is_object, |section| format!("[0x{}]", section.name)),
        header("SYN016", "an index with a zero too many", Section::is_object, |section| {
            format!("[0{}]", section.name)
        }),
        header("SYN016", "an index with the `h` of the manuals", Section::is_object, |section| {
            format!("[{}h]", section.name)
        }),
        header("SYN016", "a sub-index with a blank before `sub`", is_below_16, |section| {
            format!("[{}]", section.name.replacen("sub", " sub", 1))
        }),
    ]
}

fn names() -> Vec<Defect> {
    vec![
        Defect::new("SYN023", "a section that CiA 306 does not know", |base| {
            let sections = base.sections().iter();
            let mutant = |line| Mutant::of(base).insert_section(line, "ToolState", &["Window=3"]);
            sections.skip(1).map(|section| mutant(section.header)).collect()
        }),
        header(
            "SYN023",
            "letters in the place of digits",
            |section| section.is_of_manufacturer() && section.is_object() && section.name.contains('0'),
            |section| format!("[{}]", section.name.replace('0', "O")),
        ),
        header(
            "SYN023",
            "a letter in the place of a digit of a mapping parameter",
            |section| {
                section.is_object()
                    && (section.is_within(0x1600, 0x17FF) || section.is_within(0x1A00, 0x1BFF))
            },
            |section| format!("[l{}]", &section.name[1..]),
        ),
        header(
            "SYN029",
            "a section in another case",
            |section| matches!(&*section.name, "FileInfo" | "DeviceInfo" | "DummyUsage" | "Comments"),
            |section| format!("[{}]", section.name.to_ascii_lowercase()),
        ),
        header("SYN029", "sub-objects in capitals", Section::is_sub_object, |section| {
            format!("[{}]", section.name.replace("sub", "SUB"))
        }),
        Defect::new("SYN029", "a key in another case", |base| {
            let keys = ["ParameterName", "DataType", "AccessType", "Line1", "Dummy0001", "Granularity"];
            let entries = base.sections().iter().flat_map(|section| keys.map(|key| section.entry(key)));
            let other = entries.flatten().map(|entry| {
                Mutant::of(base).rewrite(entry.line, format!("{}={}", other_case(&entry.key), entry.value))
            });
            other.collect()
        }),
        counted("more lines than there are", "Lines", 1),
        counted("fewer lines than there are", "Lines", -1),
        counted("more segments than there are", "NrOfSeg", 1),
        counted("fewer segments than there are", "NrOfSeg", -1),
        counted("more tools than there are", "Items", 1),
        counted("fewer tools than there are", "Items", -1),
        missing("SYN028", "comments without a count", "Lines", |section| section.name == "Comments"),
        header(
            "SYN023",
            "a misspelt section",
            |section| MISSPELT_SECTIONS.contains(&&*section.name),
            |section| format!("[{}]", section.name.replacen('m', "n", 1)),
        ),
        added("SYN024", "a key that CiA 306 does not know", |section| !section.is_list(), "Colour=red"),
        misspelt("LowLimit", "LowLimt"),
        misspelt("DefaultValue", "DefualtValue"),
        misspelt("PDOMapping", "PDOMaping"),
        misspelt("AccessType", "AcessType")
            .with_consequence("OBJ004", "what is misspelt is not there for those who look for it"),
        misspelt("ParameterName", "ParamterName")
            .with_consequence("OBJ001", "what is misspelt is not there for those who look for it"),
        misspelt("NodeName", "NodName"),
        misspelt("Granularity", "Granularty"),
        misspelt("Description", "Descripton"),
    ]
}

/// A section that counts something else than there is.
fn counted(kind: &'static str, key: &'static str, by: i64) -> Defect {
    value_of("SYN028", kind, key, |_| true, move |_, old| Some((old.parse::<i64>().ok()? + by).to_string()))
}

/// Optional sections, so that none is missing.
const MISSPELT_SECTIONS: &[&str] = &["Comments", "DummyUsage"];

fn misspelt(key: &'static str, wrong: &'static str) -> Defect {
    Defect::new("SYN024", format!("the misspelt key {wrong}"), move |base| {
        let entries = base.sections().iter().filter_map(|section| section.entry(key));
        let mutant = |entry: &Entry| Mutant::of(base).rewrite(entry.line, format!("{wrong}={}", entry.value));
        entries.map(mutant).collect()
    })
}

fn is_integer(section: &Section) -> bool {
    matches!(section.number("DataType"), Some(2..=7)) && section.number("DefaultValue").is_some()
}

fn is_below_16(section: &Section) -> bool {
    section.sub_index().is_some_and(|sub| sub < 16)
}

fn padded(section: &Section) -> String {
    section.name.replace("sub", "sub0")
}

fn other_case(name: &str) -> String {
    let lower = name.to_ascii_lowercase();
    if lower == name { name.to_ascii_uppercase() } else { lower }
}

fn is_digits(name: &str) -> bool {
    name.bytes().all(|byte| byte.is_ascii_digit())
}

/// The section once more behind the last line, under this name.
fn again(base: &Base, section: &Section, name: String) -> Mutant {
    let lines: Vec<&str> = section.entries.iter().map(|entry| &*base.lines[entry.line].text).collect();
    Mutant::of(base).append_section(&name, &lines)
}

/// Entries with these keys once more, directly behind.
fn doubled(base: &Base, keys: &[&str], second: fn(&str, &str) -> String) -> Vec<Mutant> {
    let entries = base.sections().iter().flat_map(|section| &section.entries);
    let wanted = entries.filter(|entry| keys.contains(&&*entry.key));
    wanted.map(|entry| Mutant::of(base).insert(entry.line + 1, second(&entry.key, &entry.value))).collect()
}

/// Every entry, written otherwise.
fn entries(base: &Base, new: fn(&str, &str) -> String) -> Vec<Mutant> {
    let entries = base.sections().iter().flat_map(|section| &section.entries);
    entries.map(|entry| Mutant::of(base).rewrite(entry.line, new(&entry.key, &entry.value))).collect()
}

/// Some lines, with another ending.
fn at_lines(base: &Base, ending: &str) -> Vec<Mutant> {
    let headers = base.sections().iter().skip(1).map(|section| section.header);
    headers.map(|line| Mutant::of(base).end_line(line, ending)).collect()
}
