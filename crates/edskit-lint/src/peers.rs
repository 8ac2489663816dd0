//! Findings of other tools, so that their users know which rule to look at: the base of `docs/cross-reference.md`.
//!
//! A rule names those that it covers (`Rule::peers`). What is known of CANchkEDS comes from its published lists of errors and
//! warnings; its warnings have no numbers here, and a few numbers are not public.

/// Another tool that checks EDS files.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Peer {
    /// Vector's CANchkEDS, the check that CiA offers.
    CanChkEds,
    /// `edsdcf-check` of EdsDcfNet.
    EdsDcfCheck,
    /// `dcfchk` of dcf-tools, which belong to lely-core.
    Dcfchk,
}

impl Peer {
    /// Every tool.
    pub const ALL: [Self; 3] = [Self::CanChkEds, Self::EdsDcfCheck, Self::Dcfchk];

    /// What the tool is called.
    pub const fn name(self) -> &'static str {
        match self {
            Self::CanChkEds => "CANchkEDS",
            Self::EdsDcfCheck => "edsdcf-check",
            Self::Dcfchk => "dcfchk",
        }
    }
}

/// One thing that another tool finds.
#[derive(Clone, Copy, Debug)]
pub struct PeerFinding {
    /// The tool.
    pub peer: Peer,
    /// Its number, its code, or the words its message begins with.
    pub id: &'static str,
    /// What it finds, in our words.
    pub what: &'static str,
    /// Why no rule covers it; `None` where one does.
    pub reason: Option<&'static str>,
}

/// Everything that the other tools find, in the order of their documentation.
pub const PEER_FINDINGS: &[PeerFinding] = &[
    some(CanChkEds, "1", "A section is missing"),
    some(CanChkEds, "2", "The brackets of a section header are wrong"),
    some(CanChkEds, "3", "A section header does not begin in column 1"),
    some(CanChkEds, "4", "A section stands twice"),
    some(CanChkEds, "5", "A list has fewer entries than it counts"),
    some(CanChkEds, "6", "An object has fewer sub-objects than SubNumber says"),
    some(CanChkEds, "7", "The object that links belong to is missing"),
    some(CanChkEds, "8", "The access of a mapped object contradicts the direction of the PDO"),
    some(CanChkEds, "9", "A mandatory object of the profile is missing"),
    some(CanChkEds, "10", "An object is fixed in a module and described for the device"),
    some(CanChkEds, "11", "The entries of a mapping have gaps"),
    some(CanChkEds, "12", "A section header has a leading zero or `0x`"),
    some(CanChkEds, "13", "The target of a link is missing"),
    some(CanChkEds, "14", "Sub-index 00h is missing"),
    some(CanChkEds, "21", "A number has a wrong format"),
    some(CanChkEds, "22", "A value is out of range"),
    some(CanChkEds, "23", "A line is longer than 255 characters"),
    some(CanChkEds, "24", "A key of the file or device information is unknown"),
    some(CanChkEds, "25", "A key stands twice"),
    some(CanChkEds, "26", "A mandatory key is missing"),
    some(CanChkEds, "27", "A key is not allowed for the object code"),
    some(CanChkEds, "28", "An object is in the wrong list"),
    some(CanChkEds, "29", "A value is none of those allowed"),
    some(CanChkEds, "30", "An object differs from the profile"),
    some(CanChkEds, "31", "A data structure of CiA 301 is described in another way"),
    some(CanChkEds, "32", "A data type is reserved"),
    some(CanChkEds, "33, 34", "The description of a sub-object is missing"),
    some(CanChkEds, "35", "A mapped object does not have PDOMapping=1"),
    some(CanChkEds, "36", "Sub-index 00h differs from the last sub-index"),
    some(CanChkEds, "37", "An index is listed twice"),
    some(CanChkEds, "38, 39", "The number of sub-objects differs from the profile"),
    some(CanChkEds, "40", "A sub-object has a name in a list, but does not exist"),
    some(CanChkEds, "41", "EDSVersion is missing or below 4.0"),
    some(CanChkEds, "42", "The elements of an ARRAY have different types"),
    some(
        CanChkEds,
        "51-55",
        "Modules: objects fixed and extended, without description, with differing descriptions; 1027h against `[SupportedModules]`",
    ),
    some(CanChkEds, "61", "There is no PDO that could carry a mappable object"),
    some(CanChkEds, "62", "The number of PDOs differs from those described"),
    some(CanChkEds, "63", "A PDO lacks one of its objects"),
    some(CanChkEds, "64", "A mapping has more than 8 bytes"),
    some(CanChkEds, "65", "A mapping entry has another length than the object"),
    some(CanChkEds, "66", "A data type cannot be mapped"),
    some(CanChkEds, "67, 68", "The access of mapping entries contradicts that of sub-index 00h"),
    some(CanChkEds, "69, 70, 75, 76", "Granularity contradicts the mapping"),
    some(CanChkEds, "71, 72", "1004h differs from the number of PDOs"),
    some(CanChkEds, "73", "GroupMessaging contradicts the multiplexed PDOs"),
    some(CanChkEds, "74", "A TPDO maps a dummy"),
    some(CanChkEds, "130", "`[DeviceInfo]` and 1018h differ"),
    some(CanChkEds, "unused section", "A section is used by nothing"),
    some(CanChkEds, "redundant sub-object", "A sub-object is described, but not counted"),
    some(CanChkEds, "enumeration gap", "The numbers of a list have a gap"),
    some(CanChkEds, "mappable without direction", "A mappable object is `rw` and not `rwr` or `rww`"),
    some(
        CanChkEds,
        "DynamicChannels unsupported",
        "`[DynamicChannels]` in a device without dynamic channels",
    ),
    some(CanChkEds, "unused key", "A key is used by nothing"),
    some(CanChkEds, "reserved legacy key", "A key is kept for older editions"),
    some(CanChkEds, "type not checkable", "A value has a data type that the file does not describe"),
    some(CanChkEds, "recommended key missing", "A recommended key is missing"),
    some(CanChkEds, "sub-index 00h", "Sub-index 00h differs from the last sub-index"),
    some(CanChkEds, "COB-ID const", "A mapping can be written, but the COB-ID of its PDO cannot"),
    some(CanChkEds, "default differs", "A default value differs from that of the profile"),
    some(CanChkEds, "CompactPDO", "CompactPDO without PDOs"),
    some(CanChkEds, "mapping without object", "A mapping names an object that is not described"),
    some(EdsDcfCheck, "INI001", "A header is malformed, or a line is no entry"),
    some(EdsDcfCheck, "INI002", "A section stands twice, or in two spellings"),
    some(EdsDcfCheck, "INI003", "A key stands twice"),
    some(EdsDcfCheck, "INI004", "An entry stands outside of any section"),
    some(EdsDcfCheck, "OBJ001", "ObjectType is no object code"),
    some(EdsDcfCheck, "OBJ002", "DataType is not a number"),
    some(EdsDcfCheck, "OBJ003", "DataType is not defined"),
    some(EdsDcfCheck, "OBJ004", "DataType is missing"),
    some(EdsDcfCheck, "OBJ005", "AccessType is missing or none of the words"),
    some(EdsDcfCheck, "OBJ006", "SubNumber and CompactSubObj do not fit the sub-objects"),
    some(EdsDcfCheck, "OBJ007", "Sub-index 00h differs from the highest sub-index"),
    some(EdsDcfCheck, "OBJ008", "A sub-object belongs to no object"),
    some(EdsDcfCheck, "OBJ009", "SubNumber or CompactSubObj is no UNSIGNED8, or PDOMapping is not 0 or 1"),
    some(EdsDcfCheck, "OBJ010", "ParameterName is missing or too long"),
    some(EdsDcfCheck, "OBJ011", "A section name has zeros too many"),
    some(EdsDcfCheck, "VAL001", "A value is invalid or does not fit its data type"),
    some(EdsDcfCheck, "VAL002", "LowLimit is above HighLimit"),
    some(EdsDcfCheck, "VAL003", "DefaultValue is outside the limits"),
    some(EdsDcfCheck, "VAL004", "ParameterValue is outside the limits"),
    some(EdsDcfCheck, "VAL005", "A leading zero makes a number octal"),
    some(EdsDcfCheck, "VAL006", "A limit stands on a type that is not numeric"),
    some(EdsDcfCheck, "VAL007", "A real number is written in hexadecimal"),
    some(EdsDcfCheck, "FRM001", "A formula is invalid"),
    some(EdsDcfCheck, "FRM002", "`$NODEID` does not stand first"),
    some(EdsDcfCheck, "FRM003", "A formula stands on a type that is no integer"),
    some(EdsDcfCheck, "FRM004", "A formula exceeds its data type for some node-ID"),
    some(EdsDcfCheck, "FRM005", "A formula subtracts"),
    some(EdsDcfCheck, "STD001", "An object of CiA 301 has the wrong data type"),
    some(EdsDcfCheck, "LST001", "SupportedObjects is missing or not the number of entries"),
    some(EdsDcfCheck, "LST002", "A list names an object without a section"),
    some(EdsDcfCheck, "LST003", "A described object is in no list"),
    some(EdsDcfCheck, "LST004", "An object is listed twice"),
    some(EdsDcfCheck, "LST005", "A mandatory object is missing or in another list"),
    some(EdsDcfCheck, "LST006", "An entry of a list is invalid"),
    some(EdsDcfCheck, "LST007", "An object is in the wrong list"),
    some(EdsDcfCheck, "PDO001", "A mapping names a missing object or an invalid dummy"),
    some(EdsDcfCheck, "PDO002", "A mapped object cannot be mapped, or not in this direction"),
    some(EdsDcfCheck, "PDO003", "A mapping entry has another length than the object"),
    some(EdsDcfCheck, "PDO004", "A mapping has more than 64 bits"),
    some(EdsDcfCheck, "MND001", "A mandatory section is missing"),
    some(EdsDcfCheck, "MND002", "A mandatory entry of an information section is missing"),
    some(EdsDcfCheck, "MND003", "An entry of an information section has the wrong format"),
    some(EdsDcfCheck, "MND004", "The device supports no bit rate"),
    some(EdsDcfCheck, "MND005", "`[DeviceInfo]` contradicts 1018h or the number of PDOs"),
    some(EdsDcfCheck, "DCF001", "A DCF has no NodeID"),
    some(EdsDcfCheck, "DCF002", "A NodeID is not 1 to 127"),
    some(
        EdsDcfCheck,
        "LIB001",
        "What its reader tolerates: encodings, unknown words, counts, keys that do not apply",
    ),
    some(EdsDcfCheck, "LIB002", "What its reader refuses"),
    some(EdsDcfCheck, "LIB003", "What its model refuses"),
    some(Dcfchk, "invalid entry in", "A key is unknown, also in a list"),
    some(
        Dcfchk,
        "unknown section in DCF",
        "A section is unknown (also `[Tools]`, `[DynamicChannels]` and modules, which are valid)",
    ),
    some(Dcfchk, "invalid value for", "A number of a list, of an object or of `[DummyUsage]` cannot be read"),
    some(Dcfchk, "SupportedObjects entry missing", "SupportedObjects is missing"),
    some(Dcfchk, "too many entries in", "A list has more entries than it counts"),
    some(Dcfchk, "too few entries in", "A compact list has fewer entries than it counts"),
    some(Dcfchk, "entry missing in", "A number of a list is missing"),
    some(Dcfchk, "object not found", "A list names an object without a section"),
    none(
        Dcfchk,
        "data type objects are not supported",
        "A list names a data type, which CiA 306 allows",
        "no defect: CiA 306 allows data types in the lists",
    ),
    some(Dcfchk, "object is not mandatory", "`[MandatoryObjects]` holds another object"),
    some(Dcfchk, "object is manufacturer-specific", "An object is in the wrong list"),
    some(Dcfchk, "object is not manufacturer-specific", "An object is in the wrong list"),
    some(Dcfchk, "invalid object index for entry", "An index in a list cannot be read"),
    some(Dcfchk, "ParameterName not specified", "ParameterName is missing"),
    some(Dcfchk, "DataType not specified", "DataType is missing"),
    some(Dcfchk, "AccessType not supported", "A RECORD or ARRAY has an AccessType"),
    some(Dcfchk, "AccessType not specified", "AccessType is missing"),
    some(Dcfchk, "SubNumber and CompactSubObj specified", "An object is described compactly and one by one"),
    some(
        Dcfchk,
        "ObjectType should be 0x08 or 0x09",
        "Something else than an ARRAY or RECORD has sub-objects",
    ),
    some(Dcfchk, "DataType should be UNSIGNED8", "Sub-index 00h has another type"),
    some(Dcfchk, "missing sub-object(s)", "SubNumber counts more than there is"),
    some(Dcfchk, "extra sub-object(s)", "SubNumber counts less than there is"),
    some(Dcfchk, "object not defined", "A sub-object or a compact list belongs to no object"),
    some(Dcfchk, "invalid sub-index", "A sub-index is above FEh, or above the compact ones"),
    some(
        Dcfchk,
        "object does not support compact storage",
        "A compact list belongs to an object without CompactSubObj",
    ),
    some(Dcfchk, "NrOfEntries entry missing", "A compact list does not count its entries"),
    some(Dcfchk, "invalid DataType", "DataType is not a number"),
    some(Dcfchk, "LowLimit not supported", "A limit stands on a type without an order"),
    some(Dcfchk, "HighLimit not supported", "A limit stands on a type without an order"),
    some(Dcfchk, "invalid DefaultValue, ParameterValue, LowLimit or HighLimit", "A value cannot be read"),
    some(Dcfchk, "underflow", "A value is below its data type or its limit"),
    some(Dcfchk, "overflow", "A value is above its data type or its limit"),
    some(Dcfchk, "invalid AccessType", "AccessType is none of the words"),
    some(Dcfchk, "invalid node-ID specified", "A node-ID is not 1 to 127"),
    some(Dcfchk, "VendorNumber differs", "`[DeviceInfo]` and 1018h differ"),
    some(Dcfchk, "ProductNumber differs", "`[DeviceInfo]` and 1018h differ"),
    some(Dcfchk, "RevisionNumber differs", "`[DeviceInfo]` and 1018h differ"),
    some(Dcfchk, "LSS_SerialNumber differs", "`[DeviceComissioning]` and 1018h differ"),
];

use Peer::{CanChkEds, Dcfchk, EdsDcfCheck};

const fn some(peer: Peer, id: &'static str, what: &'static str) -> PeerFinding {
    PeerFinding { peer, id, what, reason: None }
}

const fn none(peer: Peer, id: &'static str, what: &'static str, reason: &'static str) -> PeerFinding {
    PeerFinding { peer, id, what, reason: Some(reason) }
}
