//! What a rule is, and how one is declared.

use crate::{Context, Peer, Report, Severity, Variable};
use core::fmt;
use edskit_model::{Entry, Line, Object, Section};

/// A group of rules: the letters of their codes.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Group {
    /// SYN: the text of the file.
    Syntax,
    /// FIL: `[FileInfo]`.
    FileInfo,
    /// DEV: `[DeviceInfo]`.
    DeviceInfo,
    /// LST: the lists of objects.
    Lists,
    /// OBJ: the attributes of objects.
    Objects,
    /// VAL: data types and values.
    Values,
    /// COM: the communication profile of CiA 301.
    Communication,
    /// PDO: PDO communication and mapping.
    Pdo,
    /// COB: COB-IDs and CAN-IDs.
    CobId,
    /// DCF: device configuration files.
    Configuration,
    /// MOD: modular devices.
    Modules,
    /// CPJ: nodelist.cpj.
    NodeList,
    /// PRF: device profiles.
    Profile,
    /// STY: style.
    Style,
}

impl Group {
    /// Every group, in the order of the catalogue.
    pub const ALL: [Group; 14] = [
        Self::Syntax,
        Self::FileInfo,
        Self::DeviceInfo,
        Self::Lists,
        Self::Objects,
        Self::Values,
        Self::Communication,
        Self::Pdo,
        Self::CobId,
        Self::Configuration,
        Self::Modules,
        Self::NodeList,
        Self::Profile,
        Self::Style,
    ];

    /// The letters that the codes of the group begin with.
    pub const fn prefix(self) -> &'static str {
        match self {
            Self::Syntax => "SYN",
            Self::FileInfo => "FIL",
            Self::DeviceInfo => "DEV",
            Self::Lists => "LST",
            Self::Objects => "OBJ",
            Self::Values => "VAL",
            Self::Communication => "COM",
            Self::Pdo => "PDO",
            Self::CobId => "COB",
            Self::Configuration => "DCF",
            Self::Modules => "MOD",
            Self::NodeList => "CPJ",
            Self::Profile => "PRF",
            Self::Style => "STY",
        }
    }

    /// What the group is about.
    pub const fn title(self) -> &'static str {
        match self {
            Self::Syntax => "Syntax",
            Self::FileInfo => "File information",
            Self::DeviceInfo => "Device information",
            Self::Lists => "Lists of objects",
            Self::Objects => "Objects and their attributes",
            Self::Values => "Data types and values",
            Self::Communication => "Communication profile",
            Self::Pdo => "PDO mapping",
            Self::CobId => "COB-IDs",
            Self::Configuration => "Device configuration files",
            Self::Modules => "Modular devices",
            Self::NodeList => "Node lists",
            Self::Profile => "Device profiles",
            Self::Style => "Style",
        }
    }
}

/// What kind of file is linted.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum FileKind {
    /// An electronic data sheet.
    Eds,
    /// A device configuration file.
    Dcf,
    /// A nodelist.cpj.
    Cpj,
}

impl FileKind {
    /// The kind by the ending of a file name, in any case; an EDS where the ending says nothing.
    pub fn of(name: &str) -> Self {
        let ending = name.rsplit_once('.').map_or("", |(_, ending)| ending);
        if ending.eq_ignore_ascii_case("dcf") {
            Self::Dcf
        } else if ending.eq_ignore_ascii_case("cpj") {
            Self::Cpj
        } else {
            Self::Eds
        }
    }
}

/// Which files a rule looks at.
pub type FileKinds = &'static [FileKind];

/// Files that describe a device.
pub const DEVICE_FILES: FileKinds = &[FileKind::Eds, FileKind::Dcf];
/// Files that list the nodes of networks.
pub const NODE_LISTS: FileKinds = &[FileKind::Cpj];
/// Every file.
pub const ALL_FILES: FileKinds = &[FileKind::Eds, FileKind::Dcf, FileKind::Cpj];

/// The check of a rule, with the level it is called at. The engine walks the file once.
#[derive(Clone, Copy)]
pub enum Check {
    /// Once for the file.
    File(FileCheck),
    /// For every line.
    Line(LineCheck),
    /// For every section, doubled ones too.
    Section(SectionCheck),
    /// For every `key=value` entry, doubled ones too.
    Entry(EntryCheck),
    /// For every described object of the device.
    Object(ObjectCheck),
    /// For every described object or sub-object of the device, with its attributes read.
    Variable(VariableCheck),
}

/// A check of the whole file.
pub type FileCheck = fn(&Context<'_>, &mut Report);
/// A check of a line.
pub type LineCheck = fn(&Context<'_>, &Line, &mut Report);
/// A check of a section.
pub type SectionCheck = fn(&Context<'_>, Section<'_>, &mut Report);
/// A check of an entry.
pub type EntryCheck = fn(&Context<'_>, Entry<'_>, &mut Report);
/// A check of an object.
pub type ObjectCheck = fn(&Context<'_>, Object<'_>, &mut Report);
/// A check of an object or a sub-object.
pub type VariableCheck = fn(&Context<'_>, &Variable<'_>, &mut Report);

/// One rule: what it is called, what it means, and its check.
pub struct Rule {
    /// The stable code, three letters and three digits: `SYN013`.
    pub code: &'static str,
    /// The readable name: `duplicate-section`.
    pub name: &'static str,
    /// The group, which the code begins with.
    pub group: Group,
    /// How bad its findings are, where the check does not say otherwise.
    pub severity: Severity,
    /// Whether it runs where nobody selects it.
    pub enabled: bool,
    /// The first release that has it.
    pub since: &'static str,
    /// Which files it looks at.
    pub files: FileKinds,
    /// The findings of other tools that it covers: the tool and the [`PeerFinding::id`](crate::PeerFinding::id).
    pub peers: &'static [(Peer, &'static str)],
    /// Documentation in Markdown, one blank before each line.
    pub(crate) raw_docs: &'static str,
    /// The check.
    pub check: Check,
}

impl Rule {
    /// The documentation in Markdown: a summary, then the headings "What it does", "Why is this bad", "Example",
    /// "Use instead" and "References".
    pub fn docs(&self) -> String {
        let lines = self.raw_docs.lines().map(|line| line.strip_prefix(' ').unwrap_or(line));
        lines.collect::<Vec<_>>().join("\n")
    }

    /// The first line of the documentation.
    pub fn summary(&self) -> &'static str {
        self.raw_docs.lines().next().unwrap_or_default().trim()
    }

    /// The text under a heading of the documentation.
    pub fn section(&self, heading: &str) -> Option<String> {
        let docs = self.docs();
        let mut parts = docs.split("\n## ").skip(1);
        let text = parts.find_map(|part| part.strip_prefix(heading)?.strip_prefix('\n'));
        text.map(|text| text.trim().to_owned())
    }
}

impl fmt::Debug for Rule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.code, self.name)
    }
}

impl PartialEq for Rule {
    fn eq(&self, other: &Self) -> bool {
        self.code == other.code
    }
}

impl Eq for Rule {}

/// Declares a rule: its documentation, its metadata, its check.
macro_rules! rule {
    (
        $(#[doc = $doc:literal])*
        pub(crate) static $rule:ident = {
            code: $code:literal,
            name: $name:literal,
            group: $group:ident,
            severity: $severity:ident,
            $(enabled: $enabled:literal,)?
            since: $since:literal,
            files: $files:ident,
            $(peers: [$($peer:ident($id:literal)),* $(,)?],)?
            check: $level:ident($check:path),
        }
    ) => {
        #[doc = concat!("`", $code, "` ", $name)]
        pub(crate) static $rule: $crate::Rule = $crate::Rule {
            code: $code,
            name: $name,
            group: $crate::Group::$group,
            severity: $crate::Severity::$severity,
            enabled: [$($enabled,)? true][0],
            since: $since,
            files: $crate::rule::$files,
            peers: &[$($(($crate::Peer::$peer, $id)),*)?],
            raw_docs: concat!($($doc, "\n"),*),
            check: $crate::Check::$level($check),
        };
    };
}

pub(crate) use rule;
