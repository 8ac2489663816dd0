//! SYN: numbers, texts and formulas.

use super::base::{Section, number};
use super::defect::{Defect, item, value, value_of};

pub(super) fn defects() -> Vec<Defect> {
    [numbers(), texts(), formulas()].into_iter().flatten().collect()
}

fn numbers() -> Vec<Defect> {
    let any = |_: &Section| true;
    vec![
        value_of("SYN017", "the name of a data type for its number", "DataType", any, |section, _| {
            let names =
                [(2, "INTEGER8"), (3, "INTEGER16"), (5, "UNSIGNED8"), (6, "UNSIGNED16"), (7, "UNSIGNED32")];
            names.into_iter().find(|(index, _)| section.is_type(*index)).map(|(_, name)| name.to_owned())
        }),
        value("SYN017", "a word for SubNumber", "SubNumber", any, "two"),
        value_of("SYN017", "a doubled `0x`", "DefaultValue", is_integer, |_, old| {
            old.starts_with("0x").then(|| format!("0x{old}"))
        }),
        value_of(
            "SYN017",
            "a hexadecimal number in the style of `1Fh`",
            "DefaultValue",
            is_integer,
            |_, old| Some(format!("{}h", old.strip_prefix("0x")?)),
        ),
        value("SYN017", "a letter beyond F in a hexadecimal number", "DefaultValue", is_integer, "0x1G"),
        value("SYN017", "a decimal comma at an integer", "DefaultValue", is_integer, "1,5"),
        value_of("SYN017", "the letter O for a zero", "DefaultValue", is_integer, |_, old| {
            (old == "0").then(|| "O".to_owned())
        }),
        value("SYN017", "a thousands separator", "DefaultValue", is_long_of_manufacturer, "1 000"),
        value("SYN017", "the digit 8 in an octal number", "DefaultValue", is_long_of_manufacturer, "08"),
        value("SYN017", "a value configured as a word", "ParameterValue", is_integer, "on"),
        value("SYN017", "a unit behind a limit", "HighLimit", is_integer, "100 ms"),
        value("SYN017", "a word for a lower limit", "LowLimit", is_integer, "none"),
        value("SYN017", "a vendor-ID without digits", "VendorNumber", any, "0x"),
        value("SYN017", "a product number as text", "ProductNumber", any, "BD-400"),
        value("SYN017", "a count of PDOs above 65535", "NrOfRXPDO", any, "65536"),
        value("SYN017", "a SubNumber above 255", "SubNumber", any, "256"),
        value("SYN017", "a word for SupportedObjects", "SupportedObjects", any, "three"),
        value("SYN017", "an item of a list as text", "1", Section::is_list, "Device type"),
        value("SYN017", "a word for CompactSubObj", "CompactSubObj", any, "many"),
        value("SYN017", "a word for the node-ID", "NodeID", any, "five"),
        value("SYN017", "a unit behind the bit rate", "Baudrate", any, "250k"),
        value("SYN017", "a word for the number of comments", "Lines", any, "two"),
        item("SYN017", "a connected module in words", |section| section.name == "ConnectedModules", "DI-8"),
        value("SYN017", "a word for the number of nodes", "Nodes", any, "three"),
        value_of("SYN018", "a leading zero at a default value", "DefaultValue", is_integer, |section, _| {
            (section.is_of_manufacturer() && section.sub_index() != Some(0)).then(|| "010".to_owned())
        }),
        value("SYN018", "a leading zero at a vendor-ID", "VendorNumber", any, "01751"),
        value("SYN018", "a leading zero at a bit rate", "Baudrate", any, "0250"),
        value_of("SYN018", "a leading zero at a limit", "HighLimit", is_integer, |section, old| {
            let decimal = section.is_of_manufacturer() && section.sub_index() != Some(0);
            // A single digit is the same number in both readings.
            let decimal = decimal && old.len() > 1;
            (decimal && old.bytes().all(|byte| (b'0'..b'8').contains(&byte))).then(|| format!("0{old}"))
        }),
    ]
}

/// An integer of at least 16 bits whose value nothing else prescribes.
fn is_long_of_manufacturer(section: &Section) -> bool {
    let has_type = [3, 4, 6, 7].into_iter().any(|data_type| section.is_type(data_type));
    is_integer(section) && has_type && section.is_of_manufacturer() && section.sub_index() != Some(0)
}

fn texts() -> Vec<Defect> {
    vec![
        value_of(
            "SYN019",
            "a name in quotes",
            "ParameterName",
            |_| true,
            |_, old| Some(format!("\"{old}\"")),
        ),
        value_of(
            "SYN019",
            "the vendor's name in quotes",
            "VendorName",
            |_| true,
            |_, old| Some(format!("\"{old}\"")),
        ),
        value_of(
            "SYN019",
            "a text value in quotes",
            "DefaultValue",
            |section| section.is_type(9),
            |_, old| Some(format!("\"{old}\"")),
        ),
    ]
}

fn formulas() -> Vec<Defect> {
    vec![
        formula("SYN020", "a formula that begins with the number", |offset| format!("{offset}+$NODEID")),
        formula("SYN021", "`$NODEID` in lower case", |offset| format!("$nodeid+{offset}")),
        formula("SYN021", "blanks around the `+` of a formula", |offset| format!("$NODEID + {offset}")),
        formula("SYN021", "a decimal offset in a formula", |offset| {
            format!("$NODEID+{}", number(offset).unwrap_or_default())
        }),
        formula("SYN022", "a misspelt `$NODEID`", |offset| format!("$NODE_ID+{offset}")),
        formula("SYN022", "a difference for a formula", |offset| format!("$NODEID-{offset}")),
        formula("SYN022", "a product for a formula", |offset| format!("$NODEID*2+{offset}")),
        formula("SYN022", "`$NODEID` twice", |offset| format!("$NODEID+{offset}+$NODEID")),
        formula("SYN022", "`NODEID` without `$`", |offset| format!("NODEID+{offset}")),
        value("SYN022", "`$NODEID` for a plain number", "SubNumber", |_| true, "$NODEID"),
        value("SYN022", "`$NODEID` for the number of PDOs", "NrOfTXPDO", |_| true, "$NODEID"),
    ]
}

/// Formulas, written otherwise.
fn formula(rule: &'static str, kind: &'static str, new: fn(&str) -> String) -> Defect {
    value_of(rule, kind, "DefaultValue", |_| true, move |_, old| old.strip_prefix("$NODEID+").map(new))
}

fn is_integer(section: &Section) -> bool {
    matches!(section.number("DataType"), Some(2..=7)) && !section.value("DefaultValue").contains('$')
}
