//! What a section header names.

use edskit_types::{Index, SubIndex};

/// What a section is, by its name. Case never matters.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum SectionKind {
    /// `[FileInfo]`
    FileInfo,
    /// `[DeviceInfo]`
    DeviceInfo,
    /// `[DeviceComissioning]`, or the same with two m (see [`SectionKind::is_alternative_spelling`]).
    DeviceCommissioning,
    /// `[DummyUsage]`
    DummyUsage,
    /// `[Comments]`
    Comments,
    /// `[Tools]`
    Tools,
    /// `[Tool1]`, by its number
    Tool(u16),
    /// `[DynamicChannels]`
    DynamicChannels,
    /// `[SupportedModules]`
    SupportedModules,
    /// `[ConnectedModules]`
    ConnectedModules,
    /// A section of module `.0`: `[M1ModuleInfo]` and so on
    Module(u16, ModuleSection),
    /// `[Topology]`, `[Topology2]` of nodelist.cpj, by its number
    Topology(u16),
    /// `[MandatoryObjects]`
    MandatoryObjects,
    /// `[OptionalObjects]`
    OptionalObjects,
    /// `[ManufacturerObjects]`
    ManufacturerObjects,
    /// An object: `[1000]`
    Object(Index),
    /// A sub-object: `[1018sub1]`
    SubObject(Index, SubIndex),
    /// `[1000ObjectLinks]`
    ObjectLinks(Index),
    /// `[1600Name]`: names of compact sub-objects
    CompactNames(Index),
    /// `[1600Value]`: values of compact sub-objects
    CompactValues(Index),
    /// `[1600Denotation]`: denotations of compact sub-objects
    CompactDenotations(Index),
    /// Not a section of CiA 306; such sections are allowed as extensions.
    Unknown,
}

/// A section of one module (CiA 306 v1.3, 6.3).
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum ModuleSection {
    /// `[M1ModuleInfo]`
    Info,
    /// `[M1Comments]`
    Comments,
    /// `[M1FixedObjects]`
    FixedObjects,
    /// `[M1Fixed2000]`
    Fixed(Index),
    /// `[M1Fixed2000sub1]`
    FixedSub(Index, SubIndex),
    /// `[M1SubExtends]`
    SubExtends,
    /// `[M1SubExt6000]`
    SubExtension(Index),
}

/// Sections with a fixed name, in canonical spelling.
const NAMED: &[(&str, SectionKind)] = &[
    ("FileInfo", SectionKind::FileInfo),
    ("DeviceInfo", SectionKind::DeviceInfo),
    ("DeviceComissioning", SectionKind::DeviceCommissioning),
    ("DeviceCommissioning", SectionKind::DeviceCommissioning),
    ("DummyUsage", SectionKind::DummyUsage),
    ("Comments", SectionKind::Comments),
    ("Tools", SectionKind::Tools),
    ("DynamicChannels", SectionKind::DynamicChannels),
    ("SupportedModules", SectionKind::SupportedModules),
    ("ConnectedModules", SectionKind::ConnectedModules),
    ("MandatoryObjects", SectionKind::MandatoryObjects),
    ("OptionalObjects", SectionKind::OptionalObjects),
    ("ManufacturerObjects", SectionKind::ManufacturerObjects),
];

impl SectionKind {
    /// The kind that `name`, without blanks around it, stands for.
    ///
    /// Indices with leading zeros or `0x` are understood although CiA 306 forbids them;
    /// [`SectionKind::canonical_name`] tells how they should look.
    pub fn of(name: &[u8]) -> Self {
        if name.first().is_some_and(u8::is_ascii_hexdigit)
            && let Some(kind) = object_section(name)
        {
            return kind;
        }
        for (known, kind) in NAMED {
            if name.eq_ignore_ascii_case(known.as_bytes()) {
                return *kind;
            }
        }
        if let Some(rest) = strip_prefix(name, "Tool") {
            return decimal(rest).map_or(Self::Unknown, Self::Tool);
        }
        if let Some(rest) = strip_prefix(name, "Topology") {
            return if rest.is_empty() {
                Self::Topology(1)
            } else {
                decimal(rest).map_or(Self::Unknown, Self::Topology)
            };
        }
        if let Some(section) = strip_prefix(name, "M").and_then(module_section) {
            return section;
        }
        misspelt_section(name).unwrap_or(Self::Unknown)
    }

    /// Whether a name that stands for this kind is misspelt: more than a leading zero, `0x` or a second m is wrong with it.
    pub fn is_misspelt(self, name: &[u8]) -> bool {
        self.is_alternative_spelling(name)
            && self.index().is_some()
            && object_section(name).is_none_or(|kind| kind != self)
    }

    /// The name as CiA 306 spells it, `None` for a section that CiA 306 does not know.
    ///
    /// ```
    /// use edskit_model::SectionKind;
    /// assert_eq!(SectionKind::of(b"1a00SUB0A").canonical_name().as_deref(), Some("1A00subA"));
    /// ```
    pub fn canonical_name(self) -> Option<String> {
        if let Some((name, _)) = NAMED.iter().find(|(_, kind)| *kind == self) {
            return Some((*name).to_owned());
        }
        Some(match self {
            Self::Object(index) => format!("{:X}", index.0),
            Self::SubObject(index, sub) => format!("{:X}sub{:X}", index.0, sub.0),
            Self::ObjectLinks(index) => format!("{:X}ObjectLinks", index.0),
            Self::CompactNames(index) => format!("{:X}Name", index.0),
            Self::CompactValues(index) => format!("{:X}Value", index.0),
            Self::CompactDenotations(index) => format!("{:X}Denotation", index.0),
            Self::Tool(number) => format!("Tool{number}"),
            Self::Topology(1) => "Topology".to_owned(),
            Self::Topology(number) => format!("Topology{number}"),
            Self::Module(module, section) => match section {
                ModuleSection::Info => format!("M{module}ModuleInfo"),
                ModuleSection::Comments => format!("M{module}Comments"),
                ModuleSection::FixedObjects => format!("M{module}FixedObjects"),
                ModuleSection::Fixed(index) => format!("M{module}Fixed{:X}", index.0),
                ModuleSection::FixedSub(index, sub) => format!("M{module}Fixed{:X}sub{:X}", index.0, sub.0),
                ModuleSection::SubExtends => format!("M{module}SubExtends"),
                ModuleSection::SubExtension(index) => format!("M{module}SubExt{:X}", index.0),
            },
            _ => return None,
        })
    }

    /// The names of the sections that have one fixed name each, as CiA 306 spells them.
    pub fn fixed_names() -> impl Iterator<Item = &'static str> {
        let normative = |(name, kind): &&(&str, SectionKind)| {
            NAMED.iter().find(|(_, other)| other == kind).is_some_and(|(first, _)| first == name)
        };
        NAMED.iter().filter(normative).map(|(name, _)| *name)
    }

    /// Whether `name` names this kind in a spelling that is more than a matter of case: a leading zero, `0x`, or
    /// `[DeviceCommissioning]` with two m.
    #[inline]
    pub fn is_alternative_spelling(self, name: &[u8]) -> bool {
        // A name that reads as an object is one in canonical spelling if it is no longer than that.
        match self {
            Self::Object(index) => name.len() > hex_digits(index.0),
            Self::SubObject(index, sub) => {
                name.len() > hex_digits(index.0) + "sub".len() + hex_digits(sub.0.into())
            }
            _ => self
                .canonical_name()
                .is_some_and(|canonical| !name.eq_ignore_ascii_case(canonical.as_bytes())),
        }
    }

    /// The index of the object that the section belongs to, of whatever part of it; not for modules.
    pub fn index(self) -> Option<Index> {
        match self {
            Self::Object(index)
            | Self::SubObject(index, _)
            | Self::ObjectLinks(index)
            | Self::CompactNames(index)
            | Self::CompactValues(index)
            | Self::CompactDenotations(index) => Some(index),
            _ => None,
        }
    }

    /// Whether the section describes an object or a sub-object, of the device or of a module.
    #[inline]
    pub fn is_description(self) -> bool {
        matches!(
            self,
            Self::Object(_)
                | Self::SubObject(..)
                | Self::Module(
                    _,
                    ModuleSection::Fixed(_) | ModuleSection::FixedSub(..) | ModuleSection::SubExtension(_)
                )
        )
    }

    /// Whether the section is one of the three lists of objects.
    pub fn is_object_list(self) -> bool {
        matches!(self, Self::MandatoryObjects | Self::OptionalObjects | Self::ManufacturerObjects)
    }
}

/// What may stand between the index, `sub` and the sub-index by a slip.
const SEPARATORS: &[u8] = b" \t_-.:/";

/// An index or sub-index in the notation of the manuals or of a language: `1018h`, `0x1018`, `$1018`, `x1018`.
fn spelt_otherwise(text: &[u8]) -> Option<(u16, &[u8])> {
    let prefixes = ["0x", "x", "$", "&H", "16#"];
    let digits = prefixes.iter().find_map(|prefix| strip_prefix(text, prefix)).unwrap_or(text);
    let (number, rest) = hex(digits)?;
    // `[Each]` and `[Add Value]` are words, and no EACh and ADDh.
    let is_number = digits[..digits.len() - rest.len()].iter().any(u8::is_ascii_digit);
    is_number.then(|| (number, strip_prefix(rest, "h").unwrap_or(rest)))
}

fn without_separators(text: &[u8]) -> &[u8] {
    let start = text.iter().position(|byte| !SEPARATORS.contains(byte)).unwrap_or(text.len());
    &text[start..]
}

/// What follows the word for an object, which stands apart from its index: `Index 1018`, `Object 0x1018`.
fn without_noun(name: &[u8]) -> &[u8] {
    let nouns = ["Index", "Idx", "Object", "Obj"].into_iter();
    let mut behind = nouns.filter_map(|noun| strip_prefix(name, noun));
    let index = behind.find(|rest| rest.first().is_some_and(|byte| SEPARATORS.contains(byte)));
    index.map_or(name, without_separators)
}

/// `1018h`, `$1018`, `1018 sub 1`, `1018hsub01h`, `1018subindex1`, `Index 1018`: names that are a sure step from that of an object or of a
/// part of it.
#[cold]
fn misspelt_section(name: &[u8]) -> Option<SectionKind> {
    let (index, behind) = spelt_otherwise(without_noun(name))?;
    let mut rest = without_separators(behind);
    if rest.len() < behind.len()
        && let Some(behind) = strip_prefix(rest, "h")
        && behind.first().is_none_or(|byte| SEPARATORS.contains(byte))
    {
        // `1018 h`
        rest = without_separators(behind);
    }
    let Some(rest) = strip_prefix(rest, "sub") else {
        return suffixed(Index(index), rest);
    };
    let rest = ["-index", "index", "idx"].iter().find_map(|word| strip_prefix(rest, word)).unwrap_or(rest);
    let (sub, rest) = spelt_sub_index(without_separators(rest))?;
    rest.is_empty().then_some(SectionKind::SubObject(Index(index), SubIndex(sub)))
}

/// A sub-index has at most two digits, so that `h` behind it is no part of a word.
fn spelt_sub_index(text: &[u8]) -> Option<(u8, &[u8])> {
    let digits = ["0x", "x", "$"].iter().find_map(|prefix| strip_prefix(text, prefix)).unwrap_or(text);
    let (number, rest) = hex(digits)?;
    Some((u8::try_from(number).ok()?, strip_prefix(rest, "h").unwrap_or(rest)))
}

/// `1018`, `1018sub1`, `1018Name` and so on.
#[inline]
fn object_section(name: &[u8]) -> Option<SectionKind> {
    let (index, rest) = hex(strip_prefix(name, "0x").unwrap_or(name))?;
    let index = Index(index);
    if rest.is_empty() {
        return Some(SectionKind::Object(index));
    }
    if let Some(digits) = strip_prefix(rest, "sub") {
        let (sub, rest) = hex(strip_prefix(digits, "0x").unwrap_or(digits))?;
        let sub = u8::try_from(sub).ok()?;
        return rest.is_empty().then_some(SectionKind::SubObject(index, SubIndex(sub)));
    }
    suffixed(index, rest)
}

/// What a section is that has this behind the index.
fn suffixed(index: Index, rest: &[u8]) -> Option<SectionKind> {
    if rest.is_empty() {
        return Some(SectionKind::Object(index));
    }
    type Suffix = (&'static str, fn(Index) -> SectionKind);
    const SUFFIXES: [Suffix; 4] = [
        ("ObjectLinks", SectionKind::ObjectLinks),
        ("Name", SectionKind::CompactNames),
        ("Value", SectionKind::CompactValues),
        ("Denotation", SectionKind::CompactDenotations),
    ];
    let suffix = SUFFIXES.iter().find(|(suffix, _)| rest.eq_ignore_ascii_case(suffix.as_bytes()));
    suffix.map(|(_, kind)| kind(index))
}

/// What follows the `M` of a module's section.
fn module_section(rest: &[u8]) -> Option<SectionKind> {
    let digits = rest.iter().take_while(|byte| byte.is_ascii_digit()).count();
    let module = decimal(&rest[..digits])?;
    let rest = &rest[digits..];
    let is = |name: &str| rest.eq_ignore_ascii_case(name.as_bytes());
    let section = if is("ModuleInfo") {
        ModuleSection::Info
    } else if is("Comments") {
        ModuleSection::Comments
    } else if is("FixedObjects") {
        ModuleSection::FixedObjects
    } else if is("SubExtends") {
        ModuleSection::SubExtends
    } else if let Some(SectionKind::Object(index)) = strip_prefix(rest, "SubExt").and_then(object_section) {
        ModuleSection::SubExtension(index)
    } else {
        match strip_prefix(rest, "Fixed").and_then(object_section)? {
            SectionKind::Object(index) => ModuleSection::Fixed(index),
            SectionKind::SubObject(index, sub) => ModuleSection::FixedSub(index, sub),
            _ => return None,
        }
    };
    Some(SectionKind::Module(module, section))
}

#[inline]
fn strip_prefix<'a>(text: &'a [u8], prefix: &str) -> Option<&'a [u8]> {
    let head = text.get(..prefix.len())?;
    head.eq_ignore_ascii_case(prefix.as_bytes()).then(|| &text[prefix.len()..])
}

/// Hexadecimal digits at the start of `text` as 16 bits, and what follows. The `D` of `Denotation` is a digit too,
/// so after four digits a number ends where the rest is one of the known suffixes.
#[inline]
fn hex(text: &[u8]) -> Option<(u16, &[u8])> {
    let mut value = 0u32;
    let mut length = 0;
    while let Some(digit) = text.get(length).and_then(|&byte| (byte as char).to_digit(16)) {
        if value > 0xFFF || strip_prefix(&text[length..], "Denotation").is_some() {
            break;
        }
        value = value << 4 | digit;
        length += 1;
    }
    (length > 0).then(|| (value as u16, &text[length..]))
}

/// How many hexadecimal digits `value` has.
#[inline]
fn hex_digits(value: u16) -> usize {
    (u16::BITS - (value | 1).leading_zeros()).div_ceil(4) as usize
}

/// A whole text of decimal digits as 16 bits.
pub(crate) fn decimal(text: &[u8]) -> Option<u16> {
    if text.is_empty() {
        return None;
    }
    text.iter().try_fold(0u16, |value, &byte| {
        let digit = byte.is_ascii_digit().then(|| u16::from(byte - b'0'))?;
        value.checked_mul(10)?.checked_add(digit)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn every_kind_has_a_name_and_reads_back() {
        let names = [
            "FileInfo",
            "DeviceInfo",
            "DeviceComissioning",
            "DummyUsage",
            "Comments",
            "Tools",
            "Tool12",
            "DynamicChannels",
            "SupportedModules",
            "ConnectedModules",
            "MandatoryObjects",
            "OptionalObjects",
            "ManufacturerObjects",
            "1000",
            "1A00subA",
            "6200subFF",
            "1000ObjectLinks",
            "1600Name",
            "2100Value",
            "2100Denotation",
            "M1ModuleInfo",
            "M2Comments",
            "M10FixedObjects",
            "M1Fixed2000",
            "M1Fixed2000sub1",
            "M1SubExtends",
            "M1SubExt6000",
            "Topology",
            "Topology2",
        ];
        for name in names {
            let kind = SectionKind::of(name.as_bytes());
            assert_eq!(kind.canonical_name().as_deref(), Some(name));
            assert_eq!(SectionKind::of(name.to_ascii_uppercase().as_bytes()), kind);
            assert_eq!(SectionKind::of(name.to_ascii_lowercase().as_bytes()), kind);
            assert!(!kind.is_alternative_spelling(name.as_bytes()));
        }
    }

    #[test]
    fn other_spellings_of_the_same_section() {
        for (name, canonical) in [
            ("0x1000", "1000"),
            ("01000", "1000"),
            ("1018sub01", "1018sub1"),
            ("1018sub0x1", "1018sub1"),
            ("1018sub00", "1018sub0"),
            ("01000ObjectLinks", "1000ObjectLinks"),
            ("M01ModuleInfo", "M1ModuleInfo"),
            ("DeviceCommissioning", "DeviceComissioning"),
            ("1000h", "1000"),
            ("1A00H", "1A00"),
            ("$1000", "1000"),
            ("1000 h", "1000"),
            ("1018 h sub1", "1018sub1"),
            ("Index 1000", "1000"),
            ("Object 0x1018 sub 1", "1018sub1"),
            ("x1000", "1000"),
            ("1018hsub1", "1018sub1"),
            ("1018sub01h", "1018sub1"),
            ("0x1018h sub 0x1", "1018sub1"),
            ("1018 sub1", "1018sub1"),
            ("1018_sub_A", "1018subA"),
            ("1018.sub1", "1018sub1"),
            ("1018subindex1", "1018sub1"),
            ("1018Sub-Index 1", "1018sub1"),
            ("1016hName", "1016Name"),
            ("1016 Value", "1016Value"),
            ("2100hDenotation", "2100Denotation"),
            ("A0h", "A0"),
        ] {
            let kind = SectionKind::of(name.as_bytes());
            assert_eq!(kind, SectionKind::of(canonical.as_bytes()), "{name}");
            assert!(kind.is_alternative_spelling(name.as_bytes()), "{name}");
        }
    }

    #[test]
    fn each_fixed_name_is_given_once() {
        let names: Vec<_> = SectionKind::fixed_names().collect();
        assert_eq!(names.len(), 12);
        assert!(
            names
                .iter()
                .all(|name| !SectionKind::of(name.as_bytes()).is_alternative_spelling(name.as_bytes()))
        );
    }

    #[test]
    fn what_is_not_a_section_of_cia_306() {
        for name in [
            "",
            "10000",
            "1000sub",
            "1018sub100",
            "1018subG",
            "M",
            "MFixed1000",
            "Toolbox",
            "FEED ME",
            "Each",
            "Beach",
            "Add Value",
            "1000Names",
            "1000hh",
            "1000 hours",
            "Index1000",
            "Object Dictionary",
            "1018sub1x",
            "1018 subway",
            "1018-1",
        ] {
            assert_eq!(SectionKind::of(name.as_bytes()), SectionKind::Unknown, "{name}");
        }
    }

    #[test]
    fn the_d_of_denotation_is_no_digit() {
        assert_eq!(SectionKind::of(b"2100Denotation"), SectionKind::CompactDenotations(Index(0x2100)));
        assert_eq!(SectionKind::of(b"210Denotation"), SectionKind::CompactDenotations(Index(0x210)));
        assert_eq!(SectionKind::of(b"D"), SectionKind::Object(Index(0xD)));
    }

    proptest! {
        #[test]
        fn never_panics(name in proptest::collection::vec(any::<u8>(), 0..30)) {
            let _ = SectionKind::of(&name).canonical_name();
        }

        #[test]
        fn object_names_read_back(index in any::<u16>(), sub in any::<u8>()) {
            let name = format!("{index:X}sub{sub:X}");
            let kind = SectionKind::of(name.as_bytes());
            prop_assert_eq!(kind, SectionKind::SubObject(Index(index), SubIndex(sub)));
            prop_assert!(!kind.is_alternative_spelling(name.as_bytes()));
            let padded = format!("{index:X}sub0{sub:X}");
            prop_assert!(kind.is_alternative_spelling(padded.as_bytes()));
        }
    }
}
