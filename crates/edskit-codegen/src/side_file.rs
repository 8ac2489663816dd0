//! What an EDS cannot say: a TOML file beside it (`docs/generating.md`).

mod places;

use crate::Problem;
use crate::identifier::words;
use crate::names::{MOST_CHARACTERS, is_place_name};
use core::ops::Range;
use edskit_lint::Severity;
use edskit_model::Span;
use edskit_runtime::StorageGroup;
use edskit_types::{AccessType, DataType, Index, SubIndex};
pub(crate) use places::Places;
use serde::Deserialize;
use std::collections::BTreeMap;
use toml::Spanned;

/// What a side-file says about the entries of an EDS.
///
/// ```
/// use edskit_codegen::SideFile;
/// let side_file = SideFile::parse("[unit]\n'1017' = 'ms'\n").unwrap();
/// assert_eq!(side_file.unit(edskit_types::Index(0x1017), edskit_types::SubIndex(0)), Some("ms"));
/// ```
#[derive(Clone, Default, Debug)]
pub struct SideFile {
    pub(crate) text: String,
    storage: Vec<Said<Option<StorageGroup>>>,
    capacity: Vec<Said<u16>>,
    unit: Vec<Said<String>>,
    optional: Vec<Said<()>>,
    variable: Vec<Said<()>>,
    rpdo: Vec<Said<()>>,
    given: Vec<Said<()>>,
    names: Vec<Said<String>>,
    extra: Vec<Extra>,
}

/// Something said about some entries, and where.
#[derive(Clone, Debug)]
pub(crate) struct Said<T> {
    pub(crate) places: Places,
    pub(crate) span: Span,
    pub(crate) what: T,
}

/// A key that says something about entries.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Key {
    Optional,
    Variable,
    Rpdo,
    Given,
    Storage(Option<StorageGroup>),
    Capacity(u16),
    Unit,
    Name,
}

/// Entries that the EDS does not describe.
#[derive(Clone, Debug)]
pub(crate) struct Extra {
    places: Places,
    pub(crate) span: Span,
    pub(crate) name: String,
    pub(crate) data_type: DataType,
    pub(crate) access: AccessType,
    pub(crate) is_mappable: bool,
    /// In the notation of an EDS, with its place.
    pub(crate) default: Option<(String, Span)>,
}

impl Extra {
    /// The entries that it adds, in ascending order.
    pub(crate) fn entries(&self) -> impl Iterator<Item = (Index, SubIndex)> + '_ {
        self.places.entries()
    }

    /// Whether it adds several sub-objects to an object.
    pub(crate) fn has_several_sub_objects(&self) -> bool {
        self.places.sub_indices() > 1
    }
}

impl SideFile {
    /// Reads a side-file.
    ///
    /// # Errors
    /// What is wrong, and where.
    pub fn parse(text: &str) -> Result<Self, Problem> {
        let error = |span: Range<usize>, message: String| {
            Problem::in_side_file(text, Severity::Error, span_of(&span), message)
        };
        let raw: Raw = toml::from_str(text).map_err(|wrong| {
            error(wrong.span().unwrap_or_default(), wrong.message().trim().replace('\n', ", "))
        })?;
        raw.check(text).map_err(|(span, message)| error(span, message))
    }

    /// In which group an entry is stored: `Some(None)` where it is said to be stored in none, `None` where nothing is
    /// said.
    #[must_use]
    pub fn storage(&self, index: Index, sub_index: SubIndex) -> Option<Option<StorageGroup>> {
        narrowest(&self.storage, index, sub_index).copied()
    }

    /// How many bytes a text can have.
    #[must_use]
    pub fn capacity(&self, index: Index, sub_index: SubIndex) -> Option<u16> {
        narrowest(&self.capacity, index, sub_index).copied()
    }

    /// The unit of an entry.
    #[must_use]
    pub fn unit(&self, index: Index, sub_index: SubIndex) -> Option<&str> {
        narrowest(&self.unit, index, sub_index).map(String::as_str)
    }

    /// Whether an entry exists only in some configurations.
    #[must_use]
    pub fn is_optional(&self, index: Index, sub_index: SubIndex) -> bool {
        narrowest(&self.optional, index, sub_index).is_some()
    }

    /// Whether the device changes the value of an entry, whatever the EDS says.
    #[must_use]
    pub fn is_variable(&self, index: Index, sub_index: SubIndex) -> bool {
        narrowest(&self.variable, index, sub_index).is_some()
    }

    /// Whether RPDOs write an entry, though clients may not.
    #[must_use]
    pub fn is_received(&self, index: Index, sub_index: SubIndex) -> bool {
        narrowest(&self.rpdo, index, sub_index).is_some()
    }

    /// Whether the device is given the value of an entry at start, and no reset changes it.
    #[must_use]
    pub fn is_given(&self, index: Index, sub_index: SubIndex) -> bool {
        narrowest(&self.given, index, sub_index).is_some()
    }

    /// What the handle of an entry is called, and what those of the other entries of its object begin with.
    pub(crate) fn names(&self, index: Index, sub_index: SubIndex) -> (Option<&str>, Option<&str>) {
        let fitting = |is_of_object: bool| {
            let is_it = |said: &&Said<String>| {
                said.places.contain(index, sub_index) && (said.places.sub_indices() > 1) == is_of_object
            };
            self.names.iter().find(is_it).map(|said| &*said.what)
        };
        (fitting(false), fitting(true))
    }

    /// Entries that the EDS does not describe.
    pub(crate) fn extras(&self) -> &[Extra] {
        &self.extra
    }

    /// Everything that is said about entries.
    pub(crate) fn statements(&self) -> Vec<Said<Key>> {
        let flags = [
            (&self.optional, Key::Optional),
            (&self.variable, Key::Variable),
            (&self.rpdo, Key::Rpdo),
            (&self.given, Key::Given),
        ];
        let flags = flags.into_iter().flat_map(|(all, key)| all.iter().map(move |said| said.with(key)));
        let storage = self.storage.iter().map(|said| said.with(Key::Storage(said.what)));
        let capacity = self.capacity.iter().map(|said| said.with(Key::Capacity(said.what)));
        let unit = self.unit.iter().map(|said| said.with(Key::Unit));
        let names = self.names.iter().map(|said| said.with(Key::Name));
        flags.chain(storage).chain(capacity).chain(unit).chain(names).collect()
    }
}

impl<T> Said<T> {
    fn with(&self, key: Key) -> Said<Key> {
        Said { places: self.places.clone(), span: self.span, what: key }
    }
}

/// What is said with the places that name the fewest entries, the first such in the order of their spelling.
fn narrowest<T>(said: &[Said<T>], index: Index, sub_index: SubIndex) -> Option<&T> {
    let fitting = said.iter().filter(|said| said.places.contain(index, sub_index));
    fitting.min_by_key(|said| said.places.size()).map(|said| &said.what)
}

fn span_of(range: &Range<usize>) -> Span {
    Span::new(range.start as u32, range.end as u32)
}

/// What names are.
const NAMES: &str = "names begin with a letter, have at most 60 capitals, digits and single underscores, and do not look like \
    `OBJECT_2001_01`";

/// What is wrong, and at which bytes.
type Complaint = (Range<usize>, String);

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct Raw {
    #[serde(default)]
    optional: Vec<Spanned<String>>,
    #[serde(default)]
    variable: Vec<Spanned<String>>,
    #[serde(default)]
    rpdo: Vec<Spanned<String>>,
    #[serde(default)]
    given: Vec<Spanned<String>>,
    #[serde(default)]
    names: BTreeMap<Spanned<String>, Spanned<String>>,
    #[serde(default)]
    storage: BTreeMap<Spanned<String>, Spanned<RawGroup>>,
    #[serde(default)]
    capacity: BTreeMap<Spanned<String>, u16>,
    #[serde(default)]
    unit: BTreeMap<Spanned<String>, String>,
    #[serde(default)]
    extra: Vec<RawExtra>,
}

#[derive(Deserialize)]
#[serde(untagged)]
enum RawGroup {
    Number(u8),
    Word(String),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct RawExtra {
    entries: Spanned<String>,
    name: String,
    data_type: Spanned<String>,
    access: Spanned<String>,
    #[serde(default)]
    pdo_mapping: bool,
    default: Option<Spanned<String>>,
}

impl Raw {
    fn check(self, text: &str) -> Result<SideFile, Complaint> {
        let flags = |places: &[Spanned<String>]| {
            places.iter().map(|places| said(places, ())).collect::<Result<Vec<_>, _>>()
        };
        let storage = self.storage.iter().map(|(places, group)| said(places, check_group(group)?));
        let capacity = self.capacity.into_iter().map(|(places, capacity)| said(&places, capacity));
        let unit = self.unit.into_iter().map(|(places, unit)| said(&places, unit));
        Ok(SideFile {
            text: text.to_owned(),
            optional: flags(&self.optional)?,
            variable: flags(&self.variable)?,
            rpdo: flags(&self.rpdo)?,
            given: flags(&self.given)?,
            names: check_names(&self.names)?,
            storage: storage.collect::<Result<_, _>>()?,
            capacity: capacity.collect::<Result<_, _>>()?,
            unit: unit.collect::<Result<_, _>>()?,
            extra: self.extra.into_iter().map(RawExtra::check).collect::<Result<_, _>>()?,
        })
    }
}

impl RawExtra {
    fn check(self) -> Result<Extra, Complaint> {
        let word = self.data_type.get_ref();
        let data_type = DataType::ALL.iter().copied().find(|data_type| data_type.name() == word);
        let wrong = || (self.data_type.span(), format!("`{word}` is no data type"));
        let data_type = data_type.ok_or_else(wrong)?;
        let word = self.access.get_ref();
        let access = AccessType::parse(word.as_bytes());
        let access = access.ok_or_else(|| (self.access.span(), format!("`{word}` is no access type")))?;
        Ok(Extra {
            places: check_places(&self.entries)?,
            span: span_of(&self.entries.span()),
            name: self.name,
            data_type,
            access,
            is_mappable: self.pdo_mapping,
            default: self.default.map(|default| {
                let span = span_of(&default.span());
                (default.into_inner(), span)
            }),
        })
    }
}

fn said<T>(places: &Spanned<String>, what: T) -> Result<Said<T>, Complaint> {
    Ok(Said { places: check_places(places)?, span: span_of(&places.span()), what })
}

fn check_places(places: &Spanned<String>) -> Result<Places, Complaint> {
    Places::parse(places.get_ref()).ok_or_else(|| {
        let text = places.get_ref();
        (
            places.span(),
            format!("`{text}` names no entries; write them as `2000`, `1018sub4` or `2000-20FFsub1-3`"),
        )
    })
}

fn check_group(group: &Spanned<RawGroup>) -> Result<Option<StorageGroup>, Complaint> {
    match group.get_ref() {
        RawGroup::Word(word) if word == "none" => Ok(None),
        RawGroup::Word(word) if word == "communication" => Ok(Some(StorageGroup::COMMUNICATION)),
        RawGroup::Word(word) if word == "application" => Ok(Some(StorageGroup::APPLICATION)),
        RawGroup::Word(word) if word == "manufacturer" => Ok(Some(StorageGroup::MANUFACTURER)),
        RawGroup::Number(number @ 2..=0x7F) => Ok(Some(StorageGroup(*number))),
        _ => Err((
            group.span(),
            "a group is `none`, `communication`, `application`, `manufacturer`, or a sub-index of 1010h, 2 to 127"
                .to_owned(),
        )),
    }
}

/// What the side-file calls things: each name is one that can be written as it stands, and stands there once.
fn check_names(names: &BTreeMap<Spanned<String>, Spanned<String>>) -> Result<Vec<Said<String>>, Complaint> {
    let mut checked: Vec<Said<String>> = Vec::new();
    // In the order of the file: the second of two equal names is the one too many.
    let mut in_order: Vec<_> = names.iter().collect();
    in_order.sort_by_key(|(places, _)| places.span().start);
    for (places, name) in in_order {
        let text = name.get_ref();
        let said = said(places, text.clone())?;
        if !said.places.are_one() {
            let message =
                format!("`{}` is more than one entry, and each has a name of its own", places.get_ref());
            return Err((places.span(), message));
        }
        let usual = words(text).to_ascii_uppercase();
        let begins_as_name = text.starts_with(|first: char| first.is_ascii_uppercase());
        if *text != usual || !begins_as_name || text.len() > MOST_CHARACTERS || is_place_name(text) {
            let is_usual = usual.starts_with(|first: char| first.is_ascii_uppercase())
                && usual.len() <= MOST_CHARACTERS
                && !is_place_name(&usual);
            let instead =
                if is_usual && *text != usual { format!("write `{usual}`") } else { NAMES.to_owned() };
            return Err((name.span(), format!("`{text}` cannot be the name of a handle: {instead}")));
        }
        if checked.iter().any(|other| other.what == *text) {
            return Err((name.span(), format!("`{text}` is the name of another entry already")));
        }
        checked.push(said);
    }
    Ok(checked)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(text: &str) -> String {
        SideFile::parse(text).unwrap_err().line("a.eds", "a.toml").to_string()
    }

    #[test]
    fn the_narrowest_places_count() {
        let text = "[storage]\n'2000-2FFF' = 'none'\n'2010' = 'application'\n'2010sub1' = 9\n";
        let side_file = SideFile::parse(text).unwrap();
        let group = |index, sub_index| side_file.storage(Index(index), SubIndex(sub_index));
        assert_eq!(group(0x2000, 0), Some(None));
        assert_eq!(group(0x2010, 0), Some(Some(StorageGroup::APPLICATION)));
        assert_eq!(group(0x2010, 1), Some(Some(StorageGroup(9))));
        assert_eq!(group(0x3000, 0), None);
    }

    #[test]
    fn what_is_wrong_is_named_and_placed() {
        assert_eq!(
            line("[unit]\n'20000' = 'V'\n"),
            "a.toml:2:1: GEN `20000` names no entries; write them as `2000`, `1018sub4` or `2000-20FFsub1-3`"
        );
        for key in ["optional", "variable", "rpdo", "given"] {
            assert_eq!(
                line(&format!("{key} = [\n'2000', '2000sub1-'\n]\n")),
                "a.toml:2:9: GEN `2000sub1-` names no entries; write them as `2000`, `1018sub4` or `2000-20FFsub1-3`"
            );
        }
        assert_eq!(
            line("[storage]\n'2000' = 1\n"),
            "a.toml:2:10: GEN a group is `none`, `communication`, `application`, `manufacturer`, or a sub-index of \
             1010h, 2 to 127"
        );
        for (name, instead) in [
            ("inlet pressure", "write `INLET_PRESSURE`"),
            ("Größe", "write `GROESSE`"),
            ("A__B", "write `A_B`"),
            ("OBJECT_2001", NAMES),
            ("2", NAMES),
            ("", NAMES),
        ] {
            let message = format!("a.toml:2:10: GEN `{name}` cannot be the name of a handle: {instead}");
            assert_eq!(line(&format!("[names]\n'2001' = '{name}'\n")), message);
        }
        assert!(line(&format!("[names]\n'2001' = '{}'\n", "A".repeat(61))).ends_with(NAMES));
        assert_eq!(
            line("[names]\n'2002' = 'A'\n'2001' = 'A'\n"),
            "a.toml:3:10: GEN `A` is the name of another entry already"
        );
        assert_eq!(
            line("[names]\n'2001sub1-2' = 'A'\n"),
            "a.toml:2:1: GEN `2001sub1-2` is more than one entry, and each has a name of its own"
        );
        assert!(line("[units]\n").starts_with("a.toml:1:2: GEN unknown field `units`"));
        let extra = "[[extra]]\nentries = '2000sub1'\nname = 'x'\naccess = 'rw'\ndata-type = ";
        assert_eq!(line(&format!("{extra}'u8'\n")), "a.toml:5:13: GEN `u8` is no data type");
    }
}
