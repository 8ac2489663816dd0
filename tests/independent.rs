//! What edskit reads from the corpus equals what two readers find that share no code with it.
//!
//! Their numbers are in `corpus/independent.tsv`, and `corpus/README.md` says how they read. Where python-canopen has
//! another number than edskit, `corpus/differences.tsv` says why, file by file.

use edskit_model::{Datasheet, Description, Entry, Formula, KeyName, Number, Object, Section, SectionKind};
use edskit_tests::root;
use edskit_types::{DataType, DataTypeKind, Index, NodeId, ObjectCode, SubIndex};
use std::collections::{BTreeMap, HashSet};
use std::fs;

/// Numbers by the names of their columns.
type Columns = BTreeMap<&'static str, i128>;

/// The four keys that are compared, and the plain reader's column for each.
const KEYS: [(KeyName, &str); 4] = [
    (KeyName::DefaultValue, "defaults"),
    (KeyName::ParameterValue, "values"),
    (KeyName::LowLimit, "lows"),
    (KeyName::HighLimit, "highs"),
];

/// The files that python-canopen does not read: how their names begin, its exception, and what it stumbles over.
const REFUSED: &[(&str, &str, &str)] = &[
    ("0239f91d", "ValueError", "VendorNumber is empty"),
    ("0e0a0985", "NoOptionError", "[Comments] has fewer lines than Lines says"),
    ("0fe71942", "NoOptionError", "[DummyUsage] lacks Dummy0001"),
    ("23aec5cc", "NoOptionError", "an object lacks ParameterName"),
    ("3fe32e32", "ValueError", "VendorNumber is empty"),
    ("5425e750", "ValueError", "VendorNumber is empty"),
    ("575f3165", "NoOptionError", "[DummyUsage] lacks Dummy0001"),
    ("62f4b2a4", "NoOptionError", "an object lacks DataType"),
    ("634aae4c", "UnicodeDecodeError", "the text is Latin-1"),
    ("63b7116b", "ValueError", "VendorNumber is empty"),
    ("6c6362e3", "ValueError", "VendorNumber is empty"),
    ("6f681ec4", "NoOptionError", "[Comments] has no Lines"),
    ("6fa7750c", "ParsingError", "a line has no `=`"),
    ("7246c9a1", "ValueError", "ProductNumber is text"),
    ("7c2e9803", "ValueError", "ObjectType is text"),
    ("981cef76", "DuplicateSectionError", "six sections stand twice"),
    ("ae43a523", "NoOptionError", "[Comments] has fewer lines than Lines says"),
    ("c0c06a69", "NoOptionError", "[Comments] has no Lines"),
    ("c374a51b", "ValueError", "VendorNumber is empty"),
    ("c5c831ca", "MissingSectionHeaderError", "text stands before the first header's `[`"),
    ("c7235148", "ParsingError", "a line has no `=`"),
    ("ca7d0e3c", "ValueError", "VendorNumber is text"),
    ("d0a39026", "ValueError", "VendorNumber is empty"),
    ("df4d60b6", "NoOptionError", "[DummyUsage] lacks Dummy0001"),
    ("e2b11f96", "ValueError", "VendorNumber is empty"),
];

/// Why python-canopen has something else than edskit.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
enum Reason {
    /// It makes members 0 and 1 of an array with CompactSubObj, and those that `[hhhhName]` counts.
    CompactMember,
    /// It gives a value in the section of such an array to member 1.
    CompactValue,
    /// Member 1 and its copies then have the value.
    CompactCopy,
    /// It drops a sub-object below a VAR.
    SubObjectOfVariable,
    /// It adds the node-ID wherever `$NODEID` stands; for CiA 306 it must be the first term.
    ReversedFormula,
    /// It takes `;` behind a blank for a comment.
    CommentBehindValue,
    /// It needs an offset in a formula.
    FormulaWithoutOffset,
    /// It knows no limits of signed integers of 24, 40, 48 and 56 bits.
    LimitOfOddWidth,
    /// It reads limits of signed integers as two's complement, decimal ones too.
    TwosComplementLimit,
    /// It reads REAL values from decimals, so that they are no integers.
    Real,
    /// It does not read the hexadecimal image of a REAL value.
    RealBits,
    /// It takes values of string types as they are.
    Text,
    /// It reads values of OCTET_STRING and DOMAIN as bytes.
    Bytes,
    /// A value of OCTET_STRING or DOMAIN is not made of bytes.
    NoBytes,
}

impl Reason {
    /// Its name in the table.
    fn name(self) -> &'static str {
        match self {
            Self::CompactMember => "compact-member",
            Self::CompactValue => "compact-value",
            Self::CompactCopy => "compact-copy",
            Self::SubObjectOfVariable => "sub-object-of-variable",
            Self::ReversedFormula => "reversed-formula",
            Self::CommentBehindValue => "comment-behind-value",
            Self::FormulaWithoutOffset => "formula-without-offset",
            Self::LimitOfOddWidth => "limit-of-odd-width",
            Self::TwosComplementLimit => "twos-complement-limit",
            Self::Real => "real",
            Self::RealBits => "real-bits",
            Self::Text => "text",
            Self::Bytes => "bytes",
            Self::NoBytes => "no-bytes",
        }
    }

    /// The column of python-canopen that it counts for.
    fn column(self) -> &'static str {
        match self {
            Self::CompactMember => "pc_subs_added",
            Self::SubObjectOfVariable => "pc_subs_lost",
            Self::TwosComplementLimit => "pc_differs",
            Self::Real | Self::Text | Self::Bytes => "pc_typed",
            Self::CompactCopy | Self::ReversedFormula | Self::CommentBehindValue => "pc_extra",
            Self::CompactValue
            | Self::FormulaWithoutOffset
            | Self::LimitOfOddWidth
            | Self::RealBits
            | Self::NoBytes => "pc_missing",
        }
    }
}

#[test]
fn the_plain_reader_finds_the_same() {
    let Some(corpus) = edskit_tests::corpus("the comparison with the plain reader") else { return };
    let table = Table::read("independent.tsv");
    assert!(table.names().eq(corpus.iter().map(|file| file.name.as_str())));
    for file in &corpus {
        for (column, ours) in plain_columns(&Datasheet::parse(&file.bytes)) {
            assert_eq!(table.number(&file.name, column), ours, "{}: {column}", file.name);
        }
    }
}

#[test]
fn python_canopen_finds_the_same_but_for_what_is_explained() {
    let Some(corpus) = edskit_tests::corpus("the comparison with python-canopen") else { return };
    let table = Table::read("independent.tsv");
    let mut found = Vec::new();
    for file in &corpus {
        if table.cell(&file.name, "pc_status") != "ok" {
            continue;
        }
        let sheet = Datasheet::parse(&file.bytes);
        let differences = differences(&sheet);
        for (column, ours) in canopen_columns(&sheet, &differences) {
            assert_eq!(table.number(&file.name, column), ours, "{}: {column}", file.name);
        }
        for (reason, count) in differences {
            found.push(vec![file.name.clone(), reason.name().to_owned(), count.to_string()]);
        }
    }
    assert_eq!(found, Table::read("differences.tsv").rows);
}

#[test]
fn python_canopen_refuses_the_files_that_are_known() {
    let table = Table::read("independent.tsv");
    for name in table.names() {
        let known = REFUSED.iter().find(|(start, ..)| name.starts_with(start));
        assert_eq!(table.cell(name, "pc_status"), known.map_or("ok", |(_, status, _)| status), "{name}");
    }
}

/// edskit's reading in the plain reader's columns.
fn plain_columns(sheet: &Datasheet) -> Columns {
    let mut columns = Columns::from([
        ("objects", sheet.objects().filter(|object| is_plain(object.section())).count() as i128),
        ("sub_objects", sheet.sub_objects().filter(|sub| is_plain(sub.section())).count() as i128),
    ]);
    for column in
        ["formulas", "reversed", "other_values", "sum"].into_iter().chain(KEYS.map(|(_, column)| column))
    {
        columns.insert(column, 0);
    }
    let mut count = |column, number| *columns.entry(column).or_default() += number;
    for description in descriptions(sheet) {
        for (key, column) in KEYS {
            let Some(entry) = description.filled(key) else { continue };
            match Plain::of(entry) {
                Plain::Integer(value) => {
                    count(column, 1);
                    count("sum", value);
                }
                Plain::Formula { value, .. } => {
                    count(column, 1);
                    count("sum", value);
                    count("formulas", 1);
                }
                Plain::Reversed => count("reversed", 1),
                Plain::Other => count("other_values", 1),
            }
        }
    }
    let described = |kind: SectionKind| matches!(kind, SectionKind::Object(_) | SectionKind::SubObject(..));
    let sections = sheet.sections().filter(|section| described(section.kind()) && is_plain(*section));
    let sections = sections.count() as i128;
    columns.insert("repeated_sections", sections - columns["objects"] - columns["sub_objects"]);
    columns.insert("repeated_keys", descriptions(sheet).map(repeated_keys).sum());
    columns
}

/// What edskit expects in python-canopen's columns.
fn canopen_columns(sheet: &Datasheet, differences: &BTreeMap<Reason, i128>) -> Columns {
    let plain = plain_columns(sheet);
    let mut columns = Columns::from([
        ("pc_dummies", dummies(sheet)),
        ("pc_objects", plain["objects"]),
        ("pc_objects_lost", 0),
        ("pc_subs_added", 0),
        ("pc_subs_lost", 0),
        ("pc_differs", 0),
        ("pc_typed", 0),
        ("pc_missing", 0),
        ("pc_extra", 0),
    ]);
    for (reason, count) in differences {
        *columns.entry(reason.column()).or_default() += count;
    }
    let all: i128 = KEYS.iter().map(|(_, column)| plain[column]).sum();
    let others = columns["pc_differs"] + columns["pc_typed"] + columns["pc_missing"];
    columns.insert("pc_same", all - others);
    columns.insert("pc_subs", plain["sub_objects"] + columns["pc_subs_added"] - columns["pc_subs_lost"]);
    columns
}

/// How often python-canopen has something else than edskit, by reason.
fn differences(sheet: &Datasheet) -> BTreeMap<Reason, i128> {
    let mut counts = BTreeMap::new();
    let mut count = |reason, number| *counts.entry(reason).or_default() += number;
    for object in sheet.objects() {
        if let Some(members) = compact_members(object) {
            let copies = members.iter().filter(|sub| sub.0 > 0).count() as i128;
            let integers = KEYS.iter().filter_map(|&(key, _)| object.filled(key));
            let integers = integers.filter(|&entry| Plain::of(entry).is_number()).count() as i128;
            for (reason, number) in [
                (Reason::CompactMember, members.len() as i128),
                (Reason::CompactValue, integers),
                (Reason::CompactCopy, integers * copies),
            ] {
                if number > 0 {
                    count(reason, number);
                }
            }
        } else {
            let values = KEYS.iter().filter_map(|&(key, _)| difference(object.description(), key));
            values.for_each(|reason| count(reason, 1));
        }
        if object.object_code() == Some(ObjectCode::Var) && object.sub_objects().len() > 0 {
            count(Reason::SubObjectOfVariable, object.sub_objects().len() as i128);
        }
    }
    for sub in sheet.sub_objects() {
        let values = KEYS.iter().filter_map(|&(key, _)| difference(sub.description(), key));
        values.for_each(|reason| count(reason, 1));
    }
    counts
}

/// Why python-canopen has something else for one entry, if it does.
fn difference(description: Description<'_>, key: KeyName) -> Option<Reason> {
    let entry = description.filled(key)?;
    let data_type = canopen_type(description);
    match (Plain::of(entry), key) {
        (Plain::Integer(value), KeyName::LowLimit | KeyName::HighLimit) => {
            let data_type = data_type.filter(|data_type| data_type.is_signed())?;
            let (_, maximum) = data_type.range()?;
            if !matches!(data_type.bits(), Some(8 | 16 | 32 | 64)) {
                Some(Reason::LimitOfOddWidth)
            } else {
                (value > maximum).then_some(Reason::TwosComplementLimit)
            }
        }
        (Plain::Integer(_), _) => typed_value(data_type?, entry),
        (Plain::Formula { has_offset, .. }, _) => (!has_offset).then_some(Reason::FormulaWithoutOffset),
        (Plain::Reversed, _) => Some(Reason::ReversedFormula),
        (Plain::Other, _) => {
            let raw = entry.raw();
            let end = raw.windows(2).position(|pair| matches!(pair, [b' ' | b'\t', b';']))?;
            Number::parse(raw[..end].trim_ascii()).is_ok().then_some(Reason::CommentBehindValue)
        }
    }
}

/// The data type that python-canopen takes: for one beyond the simple types of CiA 301 that which sub-index 01h of the
/// type's own object holds, or else DOMAIN.
fn canopen_type(description: Description<'_>) -> Option<DataType> {
    let simple = DataType::Unsigned64 as u16;
    let data_type = description.data_type()?.known()?;
    if data_type <= simple {
        return DataType::from_index(Index(data_type));
    }
    let Some(definition) = description.sheet().sub_object(Index(data_type), SubIndex(1)) else {
        return Some(DataType::Domain);
    };
    let number = definition.filled(KeyName::DefaultValue)?.unsigned::<u16>();
    DataType::from_index(Index(number.known()?))
}

/// What python-canopen has instead of an integer for a default or configured value.
fn typed_value(data_type: DataType, entry: Entry<'_>) -> Option<Reason> {
    let value = entry.value(Some(data_type));
    match data_type.kind() {
        DataTypeKind::Real if entry.raw().starts_with(b"0x") => Some(Reason::RealBits),
        DataTypeKind::Real => Some(Reason::Real),
        DataTypeKind::VisibleString | DataTypeKind::UnicodeString => Some(Reason::Text),
        DataTypeKind::OctetString | DataTypeKind::Domain => {
            Some(if value.value.is_ok() { Reason::Bytes } else { Reason::NoBytes })
        }
        _ => None,
    }
}

/// The members that python-canopen makes for an array with CompactSubObj and that have no section of their own.
fn compact_members(object: Object<'_>) -> Option<HashSet<SubIndex>> {
    object.entry(KeyName::CompactSubObj)?;
    if object.object_code() != Some(ObjectCode::Array) {
        return None;
    }
    let names = object.sheet().section(SectionKind::CompactNames(object.index()));
    let count = names.and_then(|names| names.filled(KeyName::NrOfEntries)?.unsigned::<u8>().known());
    let mut members: HashSet<SubIndex> = (0..=count.unwrap_or(0).max(1)).map(SubIndex).collect();
    members.retain(|&sub_index| object.sub_object(sub_index).is_none());
    Some(members)
}

/// How many of Dummy0001 to Dummy0007 are supported.
fn dummies(sheet: &Datasheet) -> i128 {
    let Some(section) = sheet.section(SectionKind::DummyUsage) else { return 0 };
    let is_supported = |number| {
        section.numbered(KeyName::Dummy, number).and_then(|entry| entry.flag().known()) == Some(true)
    };
    (1..=7).filter(|&number| is_supported(number)).count() as i128
}

/// How many keys of a section came before in any case.
fn repeated_keys(description: Description<'_>) -> i128 {
    let keys: HashSet<String> =
        description.entries().map(|entry| entry.key_text().to_ascii_lowercase()).collect();
    (description.entries().len() - keys.len()) as i128
}

fn descriptions(sheet: &Datasheet) -> impl Iterator<Item = Description<'_>> {
    let objects = sheet.objects().map(Object::description);
    let all = objects.chain(sheet.sub_objects().map(|sub| sub.description()));
    all.filter(|description| is_plain(description.section()))
}

/// Whether the plain reader takes a section for that of an object, too: it knows no slips in names, and no sub-index of three
/// decimal digits.
fn is_plain(section: Section<'_>) -> bool {
    let name = section.name();
    let kind = SectionKind::of(name.as_bytes());
    kind != SectionKind::Unknown && !kind.is_misspelt(name.as_bytes())
}

/// A value without regard to its data type, as the plain reader sees it.
#[derive(Clone, Copy)]
enum Plain {
    Integer(i128),
    Formula { value: i128, has_offset: bool },
    Reversed,
    Other,
}

impl Plain {
    fn of(entry: Entry<'_>) -> Self {
        let raw = entry.raw();
        if let Ok(number) = Number::parse(raw) {
            return Self::Integer(number.value());
        }
        let node_id = NodeId::new(10).expect("10 is a node-ID");
        match Formula::parse(raw) {
            Ok(formula) if formula.style().variable_not_first => Self::Reversed,
            Ok(formula) => match formula.evaluate(node_id) {
                Some(value) => Self::Formula { value: value.into(), has_offset: raw.contains(&b'+') },
                None => Self::Other,
            },
            Err(_) => Self::Other,
        }
    }

    fn is_number(self) -> bool {
        matches!(self, Self::Integer(_) | Self::Formula { .. })
    }
}

/// A table of tab-separated cells with the file's name first. The first line that is no comment names the columns.
struct Table {
    columns: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Table {
    fn read(name: &str) -> Self {
        let path = root().join("tests/corpus").join(name);
        let text = fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let lines = text.lines().filter(|line| !line.starts_with('#'));
        let mut rows = lines.map(|line| line.split('\t').map(str::to_owned).collect());
        let columns = rows.next().unwrap_or_default();
        Self { columns, rows: rows.collect() }
    }

    fn names(&self) -> impl Iterator<Item = &str> {
        self.rows.iter().map(|row| row[0].as_str())
    }

    fn cell(&self, file: &str, column: &str) -> &str {
        let row = self.rows.iter().find(|row| row[0] == file);
        let position = self.columns.iter().position(|name| name == column);
        let cell = row.zip(position).and_then(|(row, position)| row.get(position));
        cell.unwrap_or_else(|| panic!("the table has no {column} of {file}"))
    }

    fn number(&self, file: &str, column: &str) -> i128 {
        let cell = self.cell(file, column);
        cell.parse().unwrap_or_else(|error| panic!("{column} of {file} is {cell}: {error}"))
    }
}
