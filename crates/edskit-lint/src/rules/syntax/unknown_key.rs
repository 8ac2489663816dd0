use crate::rule::rule;
use crate::{Context, Edit, Report, Severity};
use edskit_model::nearest;
use edskit_model::{Entry, Key, KeyGroup, KeyName, Section};
use edskit_types::Index;
use std::collections::HashMap;

rule! {
    /// A key is not one of CiA 306
    ///
    /// ## What it does
    /// Lists the keys that CiA 306 does not know in their section, and those that it only reserves. Keys that differ
    /// only in their digits are listed once for the file and kind of section. A key that looks like a known one is a
    /// warning.
    ///
    /// ## Why is this bad
    /// Extensions are allowed, and other tools skip them. But a misspelt key is skipped in the same way, so the entry
    /// that was meant is missing.
    ///
    /// ## Example
    /// ```eds
    /// [1000]
    /// ParameterName=Device type
    /// AcessType=ro
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1000]
    /// ParameterName=Device type
    /// AccessType=ro
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.2.
    pub(crate) static UNKNOWN_KEY = {
        code: "SYN024",
        name: "unknown-key",
        group: Syntax,
        severity: Info,
        since: "0.1.0",
        files: ALL_FILES,
        peers: [
            CanChkEds("24"), CanChkEds("unused key"), CanChkEds("reserved legacy key"),
            Dcfchk("invalid entry in"),
        ],
        check: File(check),
    }
}

/// How many different keys are compared with the known ones, and how many entries a section may have for that. A file
/// with more unknown ones is not full of slips.
const MOST_COMPARED: usize = 1_000;

fn check(context: &Context<'_>, report: &mut Report) {
    let is_listed = |name: KeyName| name == KeyName::Unknown || is_reserved(name);
    if !context.sheet.entries().any(|entry| is_listed(entry.key().name)) {
        return;
    }
    let mut suggestions: HashMap<(KeyGroup, String), Option<String>> = HashMap::new();
    let mut groups: HashMap<(KeyGroup, String), usize> = HashMap::new();
    let mut listed: Vec<(Section<'_>, Entry<'_>, usize)> = Vec::new();
    for section in context.sheet.sections() {
        let group = KeyGroup::of(section.kind());
        if group == KeyGroup::Unknown {
            continue;
        }
        for entry in section.entries() {
            let name = entry.key().name;
            if name != KeyName::Unknown && !(group == KeyGroup::DeviceInfo && is_reserved(name)) {
                continue;
            }
            let text = entry.key_text();
            if is_owned_elsewhere(group, &text) || is_list_item(section, entry) {
                continue;
            }
            if name == KeyName::Unknown {
                let compare = suggestions.len() < MOST_COMPARED;
                let known = suggestions.entry((group, text.to_string()));
                let known = known.or_insert_with(|| compare.then(|| suggestion(group, &text)).flatten());
                if let Some(known) = known.as_deref().filter(|known| is_missing(section, known)) {
                    misspelt(entry, known, report);
                    continue;
                }
            }
            let stem = text.chars().filter(|c| !c.is_ascii_digit()).collect::<String>().to_ascii_lowercase();
            let position = *groups.entry((group, stem)).or_insert(listed.len());
            match listed.get_mut(position) {
                Some((.., count)) => *count += 1,
                None => listed.push((section, entry, 1)),
            }
        }
    }
    for (section, entry, count) in listed {
        unknown(section, entry, count, report);
    }
}

/// Keys of `[DeviceInfo]` that CiA 306 keeps for files of older editions.
fn is_reserved(name: KeyName) -> bool {
    use KeyName::*;
    matches!(
        name,
        ProductVersion
            | ProductRevision
            | LmtManufacturerName
            | LmtProductName
            | ExtendedBootUpMaster
            | ExtendedBootUpSlave
    )
}

/// Bit rates that CiA 306 does not know are the matter of DEV005.
fn is_owned_elsewhere(group: KeyGroup, text: &str) -> bool {
    let prefix = "BaudRate_";
    group == KeyGroup::DeviceInfo
        && text.get(..prefix.len()).is_some_and(|start| start.eq_ignore_ascii_case(prefix))
}

/// A key in a list of objects that stands for the number of an item, such as `Index0`, is the matter of LST003.
fn is_list_item(section: Section<'_>, entry: Entry<'_>) -> bool {
    let index = || entry.unsigned::<u16>().known().map(Index);
    section.kind().is_object_list() && index().is_some_and(|index| section.sheet().object(index).is_some())
}

/// The key that was meant.
fn suggestion(group: KeyGroup, text: &str) -> Option<String> {
    // Of a comment in another language the key behind the mark is not missing but left out on purpose.
    if is_comment(text) {
        return None;
    }
    let tail = text.trim_start_matches(|c: char| !c.is_ascii_digit());
    let number = tail.chars().take_while(char::is_ascii_digit).collect::<String>().parse().unwrap_or(0);
    let keys = group.keys().iter().filter(|name| **name != KeyName::Item);
    let spelt: Vec<String> = keys.filter_map(|&name| Key { name, number }.canonical()).collect();
    let digits = |text: &str| text.chars().filter(char::is_ascii_digit).collect::<String>();
    let known = nearest(text, spelt.iter().map(String::as_str));
    known.filter(|known| digits(known) == digits(text)).map(str::to_owned)
}

/// Whether the section does not have the key yet.
fn is_missing(section: Section<'_>, known: &str) -> bool {
    let key = Key::of(KeyGroup::of(section.kind()), known.as_bytes());
    let mut keys = section.keys();
    keys.len() <= MOST_COMPARED && keys.all(|other| other != key)
}

fn is_comment(text: &str) -> bool {
    ["//", "/*", "--", "'", "!", "%"].iter().any(|mark| text.starts_with(mark))
}

fn misspelt(entry: Entry<'_>, known: &str, report: &mut Report) {
    let message = format!("`{}` is not a key of this section; it looks like `{known}`", entry.key_text());
    report
        .add(entry.key_span(), message)
        .severity(Severity::Warning)
        .help(format!("write `{known}` if that is meant"))
        .unsafe_fix(format!("Write `{known}`"), vec![Edit::replace(entry.key_span(), known)]);
}

fn unknown(section: Section<'_>, entry: Entry<'_>, count: usize, report: &mut Report) {
    let text = entry.key_text();
    let others = match count {
        1 => String::new(),
        2 => ", and there is one more of the kind".to_owned(),
        _ => format!(", and there are {} more of the kind", count - 1),
    };
    if entry.key().name != KeyName::Unknown {
        report
            .add(
                entry.key_span(),
                format!("the key `{text}` is only reserved, for files of older editions{others}"),
            )
            .help("delete the entry; no reader needs it");
        return;
    }
    let message = format!("`{text}` is not a key of CiA 306 in `[{}]`{others}", section.name());
    let finding = report.add(entry.key_span(), message);
    if is_comment(&text) {
        finding.help("a comment begins with `;` in column 1");
    } else if is_of_editor(&text) {
        finding.help("it is an extension of CANopenEditor; other tools skip it");
    } else if let Some(place) = place(text.as_bytes()) {
        finding.help(format!("it belongs into {place}; is a section header missing above?"));
    } else {
        finding.help("extensions are allowed, but other tools skip them");
    }
}

fn is_of_editor(text: &str) -> bool {
    ["NG_Slave", "NG_Master", "NrOfNG_MonitoredNodes"].iter().any(|key| text.eq_ignore_ascii_case(key))
}

/// Where CiA 306 has a key that stands in the wrong section.
fn place(text: &[u8]) -> Option<&'static str> {
    let places = [
        (KeyGroup::Description, "the section of an object"),
        (KeyGroup::FileInfo, "`[FileInfo]`"),
        (KeyGroup::DeviceInfo, "`[DeviceInfo]`"),
        (KeyGroup::Commissioning, "`[DeviceComissioning]`"),
        (KeyGroup::ObjectList, "a list of objects"),
        (KeyGroup::DummyUsage, "`[DummyUsage]`"),
    ];
    // A description is an extension that suggests itself.
    let is_common = |name: KeyName| matches!(name, KeyName::Unknown | KeyName::Item | KeyName::Description);
    let has = |group: KeyGroup| !is_common(Key::of(group, text).name);
    places.iter().find(|(group, _)| has(*group)).map(|(_, place)| *place)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed, lint};
    use edskit_model::Datasheet;

    #[test]
    fn keys_are_listed_once_for_each_kind_of_section() {
        let text = "[DeviceInfo]\nNG_Slave=0\nLMT_ProductName=x\nBaudRate_100=1\n\
                    [1000]\nUnit=a\nSub1Name=b\nSub2Name=c\n[1001]\nunit=d\n[FileInfo]\nUnit=e\n[x]\nUnit=f\n";
        assert_eq!(
            findings(&UNKNOWN_KEY, text),
            [
                "2:1 info: `NG_Slave` is not a key of CiA 306 in `[DeviceInfo]`",
                "3:1 info: the key `LMT_ProductName` is only reserved, for files of older editions",
                "6:1 info: `Unit` is not a key of CiA 306 in `[1000]`, and there is one more of the kind",
                "7:1 info: `Sub1Name` is not a key of CiA 306 in `[1000]`, and there is one more of the kind",
                "12:1 info: `Unit` is not a key of CiA 306 in `[FileInfo]`",
            ]
        );
    }

    #[test]
    fn misspelt_keys_are_recognised() {
        for (section, wrong, right) in [
            ("1000", "AcessType", "AccessType"),
            ("1000", "Low_Limit", "LowLimit"),
            ("DummyUsage", "Dumy0005", "Dummy0005"),
            ("Comments", "Lin12", "Line12"),
            ("Topology", "Node12DCFNam", "Node12DCFName"),
            ("MandatoryObjects", "SupportedObject", "SupportedObjects"),
        ] {
            let text = |key: &str| format!("[{section}]\n{key}=1\n");
            assert_eq!(fixed(&UNKNOWN_KEY, &text(wrong)), text(right));
        }
        for (section, other) in [
            ("1000", "Unit"),
            ("1000", "Sub1DefaultValue"),
            ("1000", "Description"),
            ("MandatoryObjects", "1x"),
            ("FileInfo", "//FileName"),
        ] {
            let text = format!("[{section}]\n{other}=1\n");
            assert_eq!(fixed(&UNKNOWN_KEY, &text), text);
        }
        assert_eq!(
            findings(&UNKNOWN_KEY, "[1000]\nAccessType=ro\nAcessType=rw\nDatType=7\n"),
            [
                "3:1 info: `AcessType` is not a key of CiA 306 in `[1000]`",
                "4:1 warning: `DatType` is not a key of this section; it looks like `DataType`",
            ]
        );
    }

    #[test]
    fn a_key_of_another_section_is_recognised() {
        let sheet = Datasheet::parse(b"[FileInfo]\nVendorName=a\nPDOMapping=0\n");
        let helps: Vec<_> = lint(&UNKNOWN_KEY, "a.eds", &sheet).into_iter().filter_map(|f| f.help).collect();
        assert_eq!(
            helps,
            [
                "it belongs into `[DeviceInfo]`; is a section header missing above?",
                "it belongs into the section of an object; is a section header missing above?"
            ]
        );
    }

    #[test]
    fn keys_of_items_are_left_to_their_rule() {
        let text = "[OptionalObjects]\nIndex0=0x1017\nIndex1=0x1018\n[1017]\n";
        assert_eq!(
            findings(&UNKNOWN_KEY, text),
            ["3:1 info: `Index1` is not a key of CiA 306 in `[OptionalObjects]`"]
        );
    }
}
