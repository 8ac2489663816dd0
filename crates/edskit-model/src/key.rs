//! The keys that CiA 306 knows: spelling, where they stand, what their values are.

use crate::section::{ModuleSection, SectionKind, decimal};

/// What the value of a key is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Shape {
    /// Text of at most this many characters (CiA 306 v1.3, 4.4 to 6.3); 0 where there is no limit but the line's.
    Text(u16),
    /// An unsigned integer of this many bits.
    Unsigned(u8),
    /// `0` or `1`.
    Flag,
    /// `x.y`, the edition of CiA 306.
    Edition,
    /// `hh:mmAM` or `hh:mmPM`.
    Time,
    /// `mm-dd-yyyy`.
    Date,
    /// An access type.
    Access,
    /// An object code.
    ObjectCode,
    /// A value of the object's data type.
    Value,
    /// A number of its own form, such as `0;2` of Count and `0x6000-0x60FF` of Range.
    Special,
}

/// A kind of section that shares one set of keys.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum KeyGroup {
    /// `[FileInfo]`
    FileInfo,
    /// `[DeviceInfo]`
    DeviceInfo,
    /// `[DummyUsage]`
    DummyUsage,
    /// `[Comments]` and `[M1Comments]`
    Comments,
    /// `[Tools]`
    Tools,
    /// `[Tool1]`
    Tool,
    /// `[DynamicChannels]`
    DynamicChannels,
    /// The three lists of objects
    ObjectList,
    /// Objects and sub-objects
    Description,
    /// `[1000ObjectLinks]`
    ObjectLinks,
    /// `[1600Name]`, `[1600Value]`, `[1600Denotation]`
    CompactList,
    /// `[DeviceComissioning]`
    Commissioning,
    /// `[SupportedModules]`
    SupportedModules,
    /// `[ConnectedModules]`, `[M1FixedObjects]`, `[M1SubExtends]`
    CountedList,
    /// `[M1ModuleInfo]`
    ModuleInfo,
    /// `[M1SubExt6000]`
    SubExtension,
    /// `[Topology]`
    Topology,
    /// A section that CiA 306 does not know
    Unknown,
}

impl KeyGroup {
    /// The set of keys that a section has.
    pub fn of(section: SectionKind) -> Self {
        match section {
            SectionKind::FileInfo => Self::FileInfo,
            SectionKind::DeviceInfo => Self::DeviceInfo,
            SectionKind::DeviceCommissioning => Self::Commissioning,
            SectionKind::DummyUsage => Self::DummyUsage,
            SectionKind::Comments | SectionKind::Module(_, ModuleSection::Comments) => Self::Comments,
            SectionKind::Tools => Self::Tools,
            SectionKind::Tool(_) => Self::Tool,
            SectionKind::DynamicChannels => Self::DynamicChannels,
            SectionKind::SupportedModules => Self::SupportedModules,
            SectionKind::ConnectedModules
            | SectionKind::Module(_, ModuleSection::FixedObjects | ModuleSection::SubExtends) => {
                Self::CountedList
            }
            SectionKind::Module(_, ModuleSection::Info) => Self::ModuleInfo,
            SectionKind::Module(_, ModuleSection::SubExtension(_)) => Self::SubExtension,
            SectionKind::Module(_, ModuleSection::Fixed(_) | ModuleSection::FixedSub(..))
            | SectionKind::Object(_)
            | SectionKind::SubObject(..) => Self::Description,
            SectionKind::Topology(_) => Self::Topology,
            SectionKind::MandatoryObjects
            | SectionKind::OptionalObjects
            | SectionKind::ManufacturerObjects => Self::ObjectList,
            SectionKind::ObjectLinks(_) => Self::ObjectLinks,
            SectionKind::CompactNames(_)
            | SectionKind::CompactValues(_)
            | SectionKind::CompactDenotations(_) => Self::CompactList,
            SectionKind::Unknown => Self::Unknown,
        }
    }

    /// The keys of the group, the frequent ones first. A numbered key stands once for all its numbers.
    pub fn keys(self) -> &'static [KeyName] {
        use KeyName::*;
        match self {
            Self::FileInfo => &[
                FileName,
                FileVersion,
                FileRevision,
                EdsVersion,
                Description,
                CreationTime,
                CreationDate,
                CreatedBy,
                ModificationTime,
                ModificationDate,
                ModifiedBy,
                LastEds,
            ],
            Self::DeviceInfo => &[
                VendorName,
                VendorNumber,
                ProductName,
                ProductNumber,
                RevisionNumber,
                OrderCode,
                BaudRate10,
                BaudRate20,
                BaudRate50,
                BaudRate125,
                BaudRate250,
                BaudRate500,
                BaudRate800,
                BaudRate1000,
                SimpleBootUpMaster,
                SimpleBootUpSlave,
                Granularity,
                DynamicChannelsSupported,
                CompactPdo,
                GroupMessaging,
                NrOfRxPdo,
                NrOfTxPdo,
                LssSupported,
                CanopenSafetySupported,
                ProductVersion,
                ProductRevision,
                LmtManufacturerName,
                LmtProductName,
                ExtendedBootUpMaster,
                ExtendedBootUpSlave,
            ],
            Self::DummyUsage => &[Dummy],
            Self::Comments => &[Lines, Line],
            Self::Tools => &[Items],
            Self::Tool => &[Name, Command],
            Self::DynamicChannels => &[NrOfSeg, Type, Dir, Range, PpOffset],
            Self::ObjectList => &[SupportedObjects, Item],
            Self::Description => DESCRIPTION,
            Self::SubExtension => SUB_EXTENSION,
            Self::ObjectLinks => &[ObjectLinks, Item],
            Self::CompactList | Self::CountedList => &[NrOfEntries, Item],
            Self::SupportedModules => &[NrOfEntries],
            Self::Commissioning => &[
                NodeId,
                NodeName,
                Baudrate,
                NetNumber,
                NetworkName,
                CanopenManager,
                LssSerialNumber,
                NodeRefd,
                NetRefd,
            ],
            Self::ModuleInfo => &[ProductName, ProductVersion, ProductRevision, OrderCode],
            Self::Topology => {
                &[NetName, NetRefd, Nodes, EdsBaseName, NodePresent, NodeItemName, NodeItemRefd, NodeDcfName]
            }
            Self::Unknown => &[],
        }
    }
}

const DESCRIPTION: &[KeyName] = {
    use KeyName::*;
    &[
        ParameterName,
        ObjectType,
        DataType,
        AccessType,
        DefaultValue,
        PdoMapping,
        LowLimit,
        HighLimit,
        SubNumber,
        ParameterValue,
        ObjFlags,
        Denotation,
        CompactSubObj,
        ParamRefd,
        UploadFile,
        DownloadFile,
        SrdoMapping,
        InvertedSrad,
    ]
};

const SUB_EXTENSION: &[KeyName] = {
    use KeyName::*;
    &[
        ParameterName,
        ObjectType,
        DataType,
        AccessType,
        DefaultValue,
        PdoMapping,
        LowLimit,
        HighLimit,
        SubNumber,
        ParameterValue,
        ObjFlags,
        Denotation,
        CompactSubObj,
        ParamRefd,
        UploadFile,
        DownloadFile,
        SrdoMapping,
        InvertedSrad,
        Count,
        ObjExtend,
    ]
};

macro_rules! key_names {
    ($($variant:ident $spelling:literal $shape:expr, $form:ident;)*) => {
        /// A key of CiA 306, without the number that some keys carry.
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
        #[repr(u8)]
        pub enum KeyName {
            /// A key that CiA 306 does not know in this section; such keys are allowed as extensions.
            Unknown,
            $(#[doc = concat!("`", $spelling, "`")] $variant,)*
        }

        /// Spelling, shape and form of every key, in the order of [`KeyName`].
        const ROWS: &[(&str, Shape, Form)] = {
            use Shape::*;
            &[("", Text(0), Form::Fixed), $(($spelling, $shape, Form::$form),)*]
        };

        /// How many keys there are, [`KeyName::Unknown`] counted.
        pub(crate) const KEY_NAMES: usize = ROWS.len();
    };
}

/// How a key is put together.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Form {
    /// Just the spelling.
    Fixed,
    /// The spelling and a decimal number: `Line1`.
    Numbered,
    /// The spelling and four hexadecimal digits: `Dummy0001`.
    HexNumbered,
    /// `Node`, a decimal number, and the spelling: `Node1Present`.
    Node,
}

key_names! {
    FileName "FileName" Text(0), Fixed;
    FileVersion "FileVersion" Unsigned(8), Fixed;
    FileRevision "FileRevision" Unsigned(8), Fixed;
    EdsVersion "EDSVersion" Edition, Fixed;
    Description "Description" Text(243), Fixed;
    CreationTime "CreationTime" Time, Fixed;
    CreationDate "CreationDate" Date, Fixed;
    CreatedBy "CreatedBy" Text(245), Fixed;
    ModificationTime "ModificationTime" Time, Fixed;
    ModificationDate "ModificationDate" Date, Fixed;
    ModifiedBy "ModifiedBy" Text(244), Fixed;
    LastEds "LastEDS" Text(0), Fixed;
    VendorName "VendorName" Text(244), Fixed;
    VendorNumber "VendorNumber" Unsigned(32), Fixed;
    ProductName "ProductName" Text(243), Fixed;
    ProductNumber "ProductNumber" Unsigned(32), Fixed;
    RevisionNumber "RevisionNumber" Unsigned(32), Fixed;
    OrderCode "OrderCode" Text(245), Fixed;
    BaudRate10 "BaudRate_10" Flag, Fixed;
    BaudRate20 "BaudRate_20" Flag, Fixed;
    BaudRate50 "BaudRate_50" Flag, Fixed;
    BaudRate125 "BaudRate_125" Flag, Fixed;
    BaudRate250 "BaudRate_250" Flag, Fixed;
    BaudRate500 "BaudRate_500" Flag, Fixed;
    BaudRate800 "BaudRate_800" Flag, Fixed;
    BaudRate1000 "BaudRate_1000" Flag, Fixed;
    SimpleBootUpMaster "SimpleBootUpMaster" Flag, Fixed;
    SimpleBootUpSlave "SimpleBootUpSlave" Flag, Fixed;
    Granularity "Granularity" Unsigned(8), Fixed;
    DynamicChannelsSupported "DynamicChannelsSupported" Unsigned(8), Fixed;
    CompactPdo "CompactPDO" Unsigned(8), Fixed;
    GroupMessaging "GroupMessaging" Flag, Fixed;
    NrOfRxPdo "NrOfRXPDO" Unsigned(16), Fixed;
    NrOfTxPdo "NrOfTXPDO" Unsigned(16), Fixed;
    LssSupported "LSS_Supported" Flag, Fixed;
    CanopenSafetySupported "CANopenSafetySupported" Flag, Fixed;
    ProductVersion "ProductVersion" Unsigned(8), Fixed;
    ProductRevision "ProductRevision" Unsigned(8), Fixed;
    LmtManufacturerName "LMT_ManufacturerName" Text(0), Fixed;
    LmtProductName "LMT_ProductName" Text(0), Fixed;
    ExtendedBootUpMaster "ExtendedBootUpMaster" Flag, Fixed;
    ExtendedBootUpSlave "ExtendedBootUpSlave" Flag, Fixed;
    Dummy "Dummy" Flag, HexNumbered;
    Lines "Lines" Unsigned(16), Fixed;
    Line "Line" Text(249), Numbered;
    Items "Items" Unsigned(8), Fixed;
    Name "Name" Text(0), Fixed;
    Command "Command" Text(0), Fixed;
    NrOfSeg "NrOfSeg" Unsigned(8), Fixed;
    Type "Type" Unsigned(16), Numbered;
    Dir "Dir" Access, Numbered;
    Range "Range" Special, Numbered;
    PpOffset "PPOffset" Special, Numbered;
    SupportedObjects "SupportedObjects" Unsigned(16), Fixed;
    Item "" Special, Numbered;
    ParameterName "ParameterName" Text(241), Fixed;
    ObjectType "ObjectType" ObjectCode, Fixed;
    DataType "DataType" Unsigned(16), Fixed;
    AccessType "AccessType" Access, Fixed;
    DefaultValue "DefaultValue" Value, Fixed;
    PdoMapping "PDOMapping" Flag, Fixed;
    LowLimit "LowLimit" Value, Fixed;
    HighLimit "HighLimit" Value, Fixed;
    SubNumber "SubNumber" Unsigned(8), Fixed;
    ObjFlags "ObjFlags" Unsigned(32), Fixed;
    CompactSubObj "CompactSubObj" Unsigned(8), Fixed;
    SrdoMapping "SRDOMapping" Flag, Fixed;
    InvertedSrad "InvertedSRAD" Unsigned(32), Fixed;
    ParameterValue "ParameterValue" Value, Fixed;
    Denotation "Denotation" Text(0), Fixed;
    UploadFile "UploadFile" Text(244), Fixed;
    DownloadFile "DownloadFile" Text(242), Fixed;
    ParamRefd "ParamRefd" Text(249), Fixed;
    Count "Count" Special, Fixed;
    ObjExtend "ObjExtend" Unsigned(8), Fixed;
    ObjectLinks "ObjectLinks" Unsigned(16), Fixed;
    NrOfEntries "NrOfEntries" Unsigned(16), Fixed;
    NodeId "NodeID" Unsigned(8), Fixed;
    NodeName "NodeName" Text(246), Fixed;
    Baudrate "Baudrate" Unsigned(16), Fixed;
    NetNumber "NetNumber" Unsigned(32), Fixed;
    NetworkName "NetworkName" Text(243), Fixed;
    CanopenManager "CANopenManager" Flag, Fixed;
    LssSerialNumber "LSS_SerialNumber" Unsigned(32), Fixed;
    NodeRefd "NodeRefd" Text(249), Fixed;
    NetRefd "NetRefd" Text(249), Fixed;
    NetName "NetName" Text(0), Fixed;
    Nodes "Nodes" Unsigned(8), Fixed;
    EdsBaseName "EDSBaseName" Text(0), Fixed;
    NodePresent "Present" Unsigned(8), Node;
    NodeItemName "Name" Text(0), Node;
    NodeItemRefd "Refd" Text(249), Node;
    NodeDcfName "DCFName" Text(0), Node;
}

impl KeyName {
    /// The key as CiA 306 spells it, without its number.
    pub fn spelling(self) -> &'static str {
        ROWS[self as usize].0
    }

    /// What its values are.
    #[inline]
    pub fn shape(self) -> Shape {
        ROWS[self as usize].1
    }

    /// Whether the spelling is the whole key, without a number.
    #[inline]
    pub(crate) fn is_fixed(self) -> bool {
        self.form() == Form::Fixed
    }

    #[inline]
    fn form(self) -> Form {
        ROWS[self as usize].2
    }
}

/// A key with its number, if it has one.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Key {
    /// Which key.
    pub name: KeyName,
    /// The number that the key carries, 0 for none: 3 of `Line3`, 5 of `Dummy0005`, 12 of `Node12Name`.
    pub number: u16,
}

impl Key {
    /// A key without a number.
    pub const fn fixed(name: KeyName) -> Self {
        Self { name, number: 0 }
    }

    /// Which key of `group` the text `key` is. Case does not matter; a number may have leading zeros.
    #[inline]
    pub fn of(group: KeyGroup, key: &[u8]) -> Self {
        Self::spelled(group, key).0
    }

    /// The same, and whether the case is that of CiA 306.
    #[inline]
    pub(crate) fn spelled(group: KeyGroup, key: &[u8]) -> (Self, bool) {
        for &name in group.keys() {
            let spelling = name.spelling().as_bytes();
            let number = match name.form() {
                Form::Fixed => {
                    if key.len() == spelling.len() {
                        let is_usual = key == spelling;
                        if is_usual || key.eq_ignore_ascii_case(spelling) {
                            return (Self::fixed(name), is_usual);
                        }
                    }
                    None
                }
                Form::Numbered => without_prefix(key, spelling).and_then(decimal),
                Form::HexNumbered => without_prefix(key, spelling).and_then(hexadecimal),
                Form::Node => without_prefix(key, b"Node").and_then(|rest| {
                    let digits = rest.len().checked_sub(spelling.len())?;
                    rest[digits..].eq_ignore_ascii_case(spelling).then(|| decimal(&rest[..digits]))?
                }),
            };
            if let Some(number) = number {
                let is_usual = match name.form() {
                    Form::Node => key.starts_with(b"Node") && key.ends_with(spelling),
                    _ => key.starts_with(spelling),
                };
                return (Self { name, number }, is_usual);
            }
        }
        (Self::fixed(KeyName::Unknown), true)
    }

    /// The key as CiA 306 spells it; `None` for one that it does not know.
    ///
    /// ```
    /// use edskit_model::{Key, KeyGroup};
    /// assert_eq!(Key::of(KeyGroup::DummyUsage, b"dummy0005").canonical().as_deref(), Some("Dummy0005"));
    /// ```
    pub fn canonical(self) -> Option<String> {
        let spelling = self.name.spelling();
        match self.name.form() {
            _ if self.name == KeyName::Unknown => None,
            Form::Fixed => Some(spelling.to_owned()),
            Form::Numbered => Some(format!("{spelling}{}", self.number)),
            Form::HexNumbered => Some(format!("{spelling}{:04X}", self.number)),
            Form::Node => Some(format!("Node{}{spelling}", self.number)),
        }
    }
}

fn without_prefix<'a>(key: &'a [u8], prefix: &[u8]) -> Option<&'a [u8]> {
    let head = key.get(..prefix.len())?;
    head.eq_ignore_ascii_case(prefix).then(|| &key[prefix.len()..])
}

fn hexadecimal(text: &[u8]) -> Option<u16> {
    if text.is_empty() {
        return None;
    }
    text.iter().try_fold(0u16, |value, &byte| {
        let digit = (byte as char).to_digit(16)? as u16;
        (value <= 0xFFF).then_some(value << 4 | digit)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const GROUPS: [KeyGroup; 17] = [
        KeyGroup::FileInfo,
        KeyGroup::DeviceInfo,
        KeyGroup::DummyUsage,
        KeyGroup::Comments,
        KeyGroup::Tools,
        KeyGroup::Tool,
        KeyGroup::DynamicChannels,
        KeyGroup::ObjectList,
        KeyGroup::Description,
        KeyGroup::ObjectLinks,
        KeyGroup::CompactList,
        KeyGroup::Commissioning,
        KeyGroup::SupportedModules,
        KeyGroup::CountedList,
        KeyGroup::ModuleInfo,
        KeyGroup::SubExtension,
        KeyGroup::Topology,
    ];

    #[test]
    fn every_key_of_every_group_reads_back_in_any_case() {
        for group in GROUPS {
            for &name in group.keys() {
                let number = if name.form() == Form::Fixed { 0 } else { 12 };
                let key = Key { name, number };
                let text = key.canonical().unwrap();
                assert_eq!(Key::of(group, text.as_bytes()), key, "{text}");
                assert_eq!(Key::of(group, text.to_ascii_uppercase().as_bytes()), key, "{text}");
            }
        }
    }

    #[test]
    fn every_key_belongs_to_a_group() {
        for (row, (spelling, ..)) in ROWS.iter().enumerate().skip(1) {
            let named = |group: &KeyGroup| group.keys().iter().any(|&key| key as usize == row);
            assert!(GROUPS.iter().any(named), "{spelling}");
        }
    }

    #[test]
    fn keys_of_other_sections_are_unknown() {
        assert_eq!(Key::of(KeyGroup::FileInfo, b"DataType").name, KeyName::Unknown);
        assert_eq!(Key::of(KeyGroup::ObjectList, b"0x1").name, KeyName::Unknown);
        assert_eq!(Key::of(KeyGroup::ObjectList, b"").name, KeyName::Unknown);
        assert_eq!(Key::of(KeyGroup::Topology, b"NodePresent").name, KeyName::Unknown);
    }
}
