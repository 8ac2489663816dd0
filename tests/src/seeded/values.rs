//! VAL: data types and values.

use super::base::Section;
use super::defect::{Defect, added, item, value, value_of};
use super::mutant::Mutant;

pub(super) fn defects() -> Vec<Defect> {
    [types(), ranges(), limits(), formulas(), texts()].into_iter().flatten().collect()
}

fn types() -> Vec<Defect> {
    vec![
        value("VAL001", "a reserved data type", "DataType", is_value, "0x0017"),
        value("VAL001", "a data type of 0", "DataType", is_value, "0x0000"),
        value("VAL001", "an index for a data type", "DataType", is_value, "0x6040"),
        value("VAL001", "a record type for a value", "DataType", is_value, "0x0021")
            .with_consequence("PDO019", "a PDO may map the value, and a record fits no PDO"),
        value(
            "VAL001",
            "a type of the manufacturer that is not described",
            "DataType",
            is_own_value,
            "0x0040",
        ),
        value("VAL001", "a reserved data type of compact sub-objects", "DataType", is_compact, "0x0017"),
    ]
}

fn ranges() -> Vec<Defect> {
    vec![
        value("VAL002", "256 in an UNSIGNED8", "DefaultValue", is_unsigned8, "256"),
        value("VAL002", "0x100 in an UNSIGNED8", "DefaultValue", is_unsigned8, "0x100"),
        value("VAL002", "-1 in an UNSIGNED8", "DefaultValue", is_unsigned8, "-1"),
        value(
            "VAL002",
            "256 in an UNSIGNED8, with a comment behind it",
            "DefaultValue",
            is_unsigned8,
            "256 ; too large",
        )
        .with_consequence("SYN012", "CiA 306 knows no comment behind a value"),
        Defect::new("VAL002", "256 in an UNSIGNED8, with a comment behind the type", |base| {
            let sections = base.sections_where(is_unsigned8).into_iter();
            let both = sections.filter_map(|section| {
                let mutant = Mutant::of(base).set(section.entry("DefaultValue")?, "256");
                Some(mutant.set_too(section.entry("DataType")?, "0x0005 ; UNSIGNED8"))
            });
            both.collect()
        })
        .with_consequence("SYN012", "CiA 306 knows no comment behind a value"),
        value("VAL002", "65536 in an UNSIGNED16", "DefaultValue", is_unsigned16, "65536"),
        value("VAL002", "nine digits in an UNSIGNED32", "DefaultValue", is_unsigned32, "0x100000000"),
        value("VAL002", "128 in an INTEGER8", "DefaultValue", is_integer8, "128"),
        value("VAL002", "-32769 in an INTEGER16", "DefaultValue", is_integer16, "-32769"),
        value("VAL002", "2147483648 in an INTEGER32", "DefaultValue", is_integer32, "2147483648"),
        value("VAL002", "a configured value beyond its type", "ParameterValue", is_unsigned16, "70000"),
        value(
            "VAL002",
            "a configured value of more than 32 bits",
            "ParameterValue",
            is_unsigned32,
            "0x1000000000",
        ),
        item("VAL002", "a compact value beyond its type", is_value_list, "70000"),
        item("VAL002", "a compact value that is negative", is_value_list, "-1"),
        added("VAL002", "an upper limit beyond the type", is_unlimited_unsigned16, "HighLimit=70000"),
        value(
            "VAL002",
            "a default of compact sub-objects beyond their type",
            "DefaultValue",
            is_compact,
            "70000",
        ),
        value_of(
            "VAL002",
            "a type without a sign for a negative value",
            "DataType",
            is_integer16,
            |section, _| section.value("DefaultValue").starts_with('-').then(|| "0x0006".to_owned()),
        )
        .by_label(),
        Defect::new("VAL011", "a constant without a value", |base| {
            let constants = base.sections_where(is_constant_number).into_iter();
            let lost = constants.filter_map(|section| {
                let mutant = Mutant::of(base).delete(section.entry("DefaultValue")?.line);
                Some(mutant.expect(section.entry("AccessType")?.line))
            });
            lost.collect()
        }),
        value("VAL011", "a constant with an empty value", "DefaultValue", is_constant_number, "").by_label(),
    ]
}

fn limits() -> Vec<Defect> {
    vec![
        value_of("VAL003", "a lower limit above the upper one", "LowLimit", has_limits, |section, _| {
            Some((section.number("HighLimit")? + 1).to_string())
        }),
        value_of("VAL003", "an upper limit below the lower one", "HighLimit", has_low_limit, |section, _| {
            Some((section.number("LowLimit")? - 1).to_string())
        })
        .by_label(),
        Defect::new("VAL003", "limits that no reading of a signed type has", |base| {
            let sections = base
                .sections_where(|section| has_limits(section) && section.number("DefaultValue") >= Some(0));
            let all = sections.into_iter().filter_map(|section| {
                let bits = [2, 3, 4].into_iter().position(|data_type| section.is_type(data_type))?;
                let most = ["0xFF", "0xFFFF", "0xFFFFFFFF"][bits];
                let mutant = Mutant::of(base).set_too(section.entry("LowLimit")?, "0x00");
                Some(mutant.set(section.entry("HighLimit")?, most))
            });
            all.collect()
        }),
        value_of(
            "VAL004",
            "a default above the upper limit",
            "DefaultValue",
            has_own_limits,
            |section, _| Some((section.number("HighLimit")? + 1).to_string()),
        ),
        value_of("VAL004", "a default below the lower limit", "DefaultValue", has_low_limit, |section, _| {
            Some((section.number("LowLimit")? - 1).to_string())
        }),
        value_of(
            "VAL004",
            "a configured value above the upper limit",
            "ParameterValue",
            has_limits,
            |section, _| Some((section.number("HighLimit")? + 1).to_string()),
        ),
        value_of("VAL004", "an upper limit below the default", "HighLimit", has_limits, |section, _| {
            let below = section.number("DefaultValue")? - 1;
            (below >= section.number("LowLimit")?).then(|| below.to_string())
        })
        .by_label(),
        Defect::new("VAL004", "a default above the upper limit of its range type", |base| {
            let sections = base.sections_where(|section| is_own_value(section) && section.is_type(6));
            let ranged = sections.into_iter().filter_map(|section| {
                let mutant = Mutant::of(base).set(section.entry("DefaultValue")?, "200");
                let mutant = mutant.set_too(section.entry("DataType")?, "0x00A0");
                // Limits of its own would come first.
                let own = ["LowLimit", "HighLimit"].into_iter().filter_map(|key| section.entry(key));
                let mutant = own.fold(mutant, |mutant, limit| mutant.delete(limit.line));
                Some(RANGE.iter().fold(mutant, |mutant, line| mutant.insert_too(base.lines.len(), *line)))
            });
            ranged.collect()
        }),
        added("VAL005", "a limit of a text", |section| section.is_type(9), "LowLimit=0"),
        added("VAL005", "a limit of an octet string", |section| section.is_type(0xA), "HighLimit=99"),
        added("VAL005", "a limit of a DOMAIN", |section| section.is_type(0xF), "HighLimit=99"),
        added("VAL005", "a limit of 5 of a BOOLEAN", |section| section.is_type(1), "HighLimit=5"),
        Defect::new("VAL012", "the limits of an UNSIGNED8", |base| {
            let sections = base.sections_where(|section| {
                section.is_variable() && section.is_type(5) && is_unlimited(section)
            });
            let limited = sections.into_iter().map(|section| {
                let mutant = Mutant::of(base).insert(section.behind_entries(), "LowLimit=0");
                mutant.insert(section.behind_entries(), "HighLimit=255")
            });
            limited.collect()
        }),
    ]
}

fn formulas() -> Vec<Defect> {
    vec![
        value("VAL006", "a formula at a BOOLEAN", "DefaultValue", |section| section.is_type(1), "$NODEID+1"),
        value("VAL006", "a formula at a REAL32", "DefaultValue", |section| section.is_type(8), "$NODEID+1"),
        value("VAL006", "a formula at a text", "DefaultValue", |section| section.is_type(9), "$NODEID"),
        value(
            "VAL006",
            "a formula at an octet string",
            "DefaultValue",
            |section| section.is_type(0xA),
            "$NODEID",
        ),
        value("VAL007", "a formula above 8 bits", "DefaultValue", is_own_unsigned8, "$NODEID+0xFF"),
        value("VAL007", "a formula above 16 bits", "DefaultValue", is_own_unsigned16, "$NODEID+0xFFFF"),
        value("VAL007", "a formula above 32 bits", "DefaultValue", is_own_unsigned32, "$NODEID+0xFFFFFFFF"),
        value(
            "VAL007",
            "a formula above the 8 bits of an INTEGER8",
            "DefaultValue",
            is_integer8,
            "$NODEID+0xFF",
        ),
    ]
}

fn texts() -> Vec<Defect> {
    vec![
        value("VAL008", "a word at a BOOLEAN", "DefaultValue", |section| section.is_type(1), "true"),
        value("VAL008", "a BOOLEAN of 2", "DefaultValue", |section| section.is_type(1), "2"),
        value("VAL009", "an odd number of digits", "DefaultValue", |section| section.is_type(0xA), "01A2F"),
        value("VAL009", "octets with `0x`", "DefaultValue", |section| section.is_type(0xA), "0x01 0xA2"),
        value("VAL009", "octets as text", "DefaultValue", |section| section.is_type(0xA), "secret"),
        added("VAL009", "a DOMAIN with a text", |section| section.is_type(0xF), "DefaultValue=none"),
        value("VAL010", "a negative INTEGER8 in hexadecimal", "DefaultValue", is_integer8, "0xFE"),
        value("VAL010", "a negative INTEGER16 in hexadecimal", "DefaultValue", is_integer16, "0xFFF0"),
        value("VAL010", "a negative INTEGER32 in hexadecimal", "DefaultValue", is_integer32, "0xFFFFFFF0"),
        value(
            "VAL010",
            "a REAL32 in hexadecimal",
            "DefaultValue",
            |section| section.is_type(8),
            "0x3FC00000",
        ),
        value("VAL013", "a decimal comma at a REAL32", "DefaultValue", |section| section.is_type(8), "1,5"),
        value("VAL013", "a unit behind a REAL64", "DefaultValue", |section| section.is_type(0x11), "0.02 s"),
        value("VAL013", "a limit of a REAL32 in words", "HighLimit", |section| section.is_type(8), "maximum"),
        added(
            "VAL013",
            "more days than a time of day has",
            |section| section.is_type(0xC),
            "DefaultValue=65536 43200000",
        ),
        added(
            "VAL013",
            "more milliseconds than a time difference has",
            |section| section.is_type(0xD),
            "DefaultValue=1 268435456",
        ),
        added("VAL013", "a time of day in words", |section| section.is_type(0xC), "DefaultValue=noon"),
        added("VAL013", "a time difference in words", |section| section.is_type(0xD), "DefaultValue=a day"),
    ]
}

/// The sections of a range type, as CANFestival's editor writes them: UNSIGNED16 from 0 to 100.
const RANGE: [&str; 29] = [
    "",
    "[A0]",
    "ParameterName=Range",
    "ObjectType=0x6",
    "SubNumber=4",
    "[A0sub0]",
    "ParameterName=Number of entries",
    "ObjectType=0x7",
    "DataType=0x0005",
    "AccessType=ro",
    "DefaultValue=3",
    "[A0sub1]",
    "ParameterName=Type",
    "ObjectType=0x7",
    "DataType=0x0005",
    "AccessType=ro",
    "DefaultValue=0x6",
    "[A0sub2]",
    "ParameterName=Minimum value",
    "ObjectType=0x7",
    "DataType=0x0006",
    "AccessType=ro",
    "DefaultValue=0",
    "[A0sub3]",
    "ParameterName=Maximum value",
    "ObjectType=0x7",
    "DataType=0x0006",
    "AccessType=ro",
    "DefaultValue=100",
];

/// A single value.
fn is_value(section: &Section) -> bool {
    section.is_variable() && section.sub_index() != Some(0)
}

/// A single value whose type nothing else prescribes.
fn is_own_value(section: &Section) -> bool {
    is_value(section)
        && section.is_of_manufacturer()
        && section.is_object()
        && section.value("PDOMapping") == "0"
}

fn is_compact(section: &Section) -> bool {
    section.entry("CompactSubObj").is_some()
}

fn is_value_list(section: &Section) -> bool {
    section.name.ends_with("Value")
}

fn is_unsigned8(section: &Section) -> bool {
    is_value(section) && section.is_type(5) && !section.value("DefaultValue").contains('$')
}

fn is_unsigned16(section: &Section) -> bool {
    is_value(section) && section.is_type(6)
}

fn is_unlimited_unsigned16(section: &Section) -> bool {
    is_unsigned16(section) && section.value("HighLimit").is_empty()
}

fn is_unsigned32(section: &Section) -> bool {
    is_value(section) && section.is_type(7) && !section.value("DefaultValue").contains('$')
}

fn is_integer8(section: &Section) -> bool {
    is_value(section) && section.is_type(2)
}

fn is_integer16(section: &Section) -> bool {
    is_value(section) && section.is_type(3)
}

fn is_integer32(section: &Section) -> bool {
    is_value(section) && section.is_type(4)
}

fn is_own_unsigned8(section: &Section) -> bool {
    is_unsigned8(section) && section.is_of_manufacturer()
}

fn is_own_unsigned16(section: &Section) -> bool {
    is_unsigned16(section) && section.is_of_manufacturer()
}

fn is_own_unsigned32(section: &Section) -> bool {
    is_value(section) && section.is_type(7) && section.is_of_manufacturer()
}

fn has_limits(section: &Section) -> bool {
    let is_own = section.is_variable() && section.sub_index() != Some(0);
    is_own && section.number("LowLimit").is_some() && section.number("HighLimit").is_some()
}

fn has_low_limit(section: &Section) -> bool {
    has_limits(section) && section.number("LowLimit") != Some(0)
}

fn is_constant_number(section: &Section) -> bool {
    section.is_variable()
        && section.value("AccessType") == "const"
        && matches!(section.number("DataType"), Some(2..=7))
}

/// One with limits whose values the standard does not limit besides.
fn has_own_limits(section: &Section) -> bool {
    has_limits(section) && !section.is_within(0x1029, 0x1029)
}

fn is_unlimited(section: &Section) -> bool {
    ["LowLimit", "HighLimit"].iter().all(|limit| section.value(limit).is_empty())
}
