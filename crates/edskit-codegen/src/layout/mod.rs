//! From a datasheet to the plain data that a dictionary consists of.

mod assumptions;
mod cob_ids;
mod counts;
mod gather;
mod groups;
mod image;
mod limits;
mod mappings;
mod settings;
mod statements;
mod value;

#[cfg(test)]
mod tests;

pub use cob_ids::CobIdParameter;
pub use counts::Counts;
pub use mappings::{Mapped, Mapping, Place};

use crate::{InputFile, Problem, SideFile};
use edskit_lint::Severity;
use edskit_model::{Datasheet, KeyName, Position as TextPosition, SectionKind, Span};
use edskit_runtime::{Entry, Flags, Limits, Position, Settings, Table};
use edskit_types::{AccessType, DataType};
use image::Images;

/// The most entries that a dictionary can have: positions are 16 bits wide.
pub const MOST_ENTRIES: usize = u16::MAX as usize;
/// The most bytes that its values can have, and its constants: offsets are 16 bits wide.
pub const MOST_BYTES: usize = u16::MAX as usize;

/// An object dictionary as data: what is rendered as Rust, and what a node can be run with at once.
///
/// ```
/// use edskit_codegen::{SideFile, lay_out};
/// use edskit_model::Datasheet;
/// use edskit_types::{Index, SubIndex};
/// let text = b"[1017]\nParameterName=Heartbeat\nDataType=6\nAccessType=rw\nDefaultValue=1000\n";
/// let layout = lay_out(&Datasheet::parse(text), &SideFile::default()).unwrap();
/// let heartbeat = layout.table().find(Index(0x1017), SubIndex(0)).unwrap();
/// assert_eq!(layout.default_of(&layout.entries[usize::from(heartbeat.0)]), 1000_u16.to_le_bytes());
/// assert_eq!(layout.assumptions.len(), 3, "1000h, 1001h and 1018h are missing");
/// ```
#[derive(Clone, Debug)]
pub struct Layout {
    /// Every entry, in ascending order of index and sub-index.
    pub entries: Vec<Entry>,
    /// Where each entry comes from.
    pub sources: Vec<Source>,
    /// The values that cannot change.
    pub constants: Vec<u8>,
    /// What the values are at power-on.
    pub defaults: Vec<u8>,
    /// The limits of entries with [`Flags::LIMITED`], in ascending order of position.
    pub limits: Vec<Limits>,
    /// Which data types may fill gaps of RPDOs: bit i stands for the type at index i.
    pub dummies: u32,
    /// A number that differs between dictionaries of different structure.
    pub fingerprint: u32,
    /// How much working memory a node needs.
    pub counts: Counts,
    /// What `[DeviceInfo]` says to a node, with a node-ID of 1.
    pub settings: Settings,
    /// The mappings of power-on, in ascending order.
    pub mappings: Vec<Mapping>,
    /// The name of the product, where the file has one.
    pub product: Option<String>,
    /// The COB-IDs of power-on, in ascending order of their entries.
    pub cob_ids: Vec<CobIdParameter>,
    /// What was read otherwise than it is written, and what the file leaves out and CiA 301 gives.
    pub assumptions: Vec<Problem>,
    /// What the file says of an entry, and the dictionary cannot have: types, accesses and values that nobody can read.
    pub lost: Vec<Problem>,
    /// What else is worth knowing about the dictionary, but does not stand against it.
    pub notes: Vec<Problem>,
}

/// Where an entry comes from, and what people call it.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Source {
    /// The file that describes it.
    pub file: InputFile,
    /// The section that describes it, without brackets: `1018sub1`.
    pub section: String,
    /// The bytes of that section's name.
    pub span: Span,
    /// The line and column of that.
    pub position: TextPosition,
    /// The ParameterName; as the file has it, so it can hold anything.
    pub name: String,
    /// The ParameterName of the whole object, where the entry is a sub-object.
    pub object: Option<String>,
    /// The access.
    pub access: AccessType,
    /// The unit, where the side-file names one.
    pub unit: Option<String>,
    /// The array that the entry belongs to.
    pub array: Option<Array>,
    /// What the side-file calls the entry.
    pub given_name: Option<String>,
    /// What the side-file calls the whole object, where the entry is a sub-object.
    pub given_object_name: Option<String>,
}

/// An array of sub-objects, which are numbered rather than named.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Array {
    /// The whole object: it is an ARRAY, or its sub-objects are compact.
    Object,
    /// Several sub-objects that one statement of the side-file adds, which stands there.
    Added(Span),
}

impl Layout {
    /// The fixed part of the dictionary.
    #[must_use]
    pub fn table(&self) -> Table<'_> {
        Table {
            entries: &self.entries,
            constants: &self.constants,
            defaults: &self.defaults,
            limits: &self.limits,
            dummies: self.dummies,
            fingerprint: self.fingerprint,
        }
    }

    /// The default of an entry: the bytes of its value, of a text as many as it has.
    #[must_use]
    pub fn default_of(&self, entry: &Entry) -> &[u8] {
        let start = usize::from(entry.offset);
        let is_variable = entry.flags.has(Flags::VARIABLE);
        let image = if is_variable { &self.defaults } else { &self.constants };
        let whole = image.get(start..).unwrap_or_default();
        if is_variable && entry.data_type.is_string() {
            let Some((length, text)) = whole.split_first_chunk() else { return &[] };
            return text.get(..u16::from_le_bytes(*length).into()).unwrap_or_default();
        }
        whole.get(..entry.size.into()).unwrap_or_default()
    }
}

/// Lays out the object dictionary of a datasheet.
///
/// What is written wrongly is read as it was meant, where that is certain; what nobody can read counts as not said
/// ([`Layout::lost`]). What the file of a device leaves out in 1000h to 1FFFh has the default of CiA 301, and the mandatory
/// objects that it lacks are added ([`Layout::assumptions`]); a DCF says what is configured, and gets neither.
///
/// # Errors
/// What makes a dictionary impossible: more entries or bytes than can be addressed, and a side-file that contradicts the
/// EDS.
pub fn lay_out(sheet: &Datasheet, side_file: &SideFile) -> Result<Layout, Vec<Problem>> {
    let gather::Gathered { mut items, mut notes, mut lost, mut assumptions, mut errors } =
        gather::items(sheet, side_file);
    assumptions.extend(assumptions::misspelt(sheet));
    for problems in [&mut lost, &mut assumptions] {
        in_order(problems);
    }
    if items.len() > MOST_ENTRIES {
        let message = format!("this is one entry more than the {MOST_ENTRIES} that a dictionary can have");
        errors.extend(items.last().map(|item| problem_at(sheet, side_file, &item.source, message)));
        return Err(errors);
    }
    for item in &mut items {
        let (name, object_name) = side_file.names(item.index, item.sub_index);
        // The name of a variable's object is its own.
        let is_sub_object = item.source.object.is_some();
        item.source.given_name = name.or(object_name.filter(|_| !is_sub_object)).map(str::to_owned);
        item.source.given_object_name = object_name.filter(|_| is_sub_object).map(str::to_owned);
    }
    let groups = groups::Groups::of(&items);
    let mut images = Images::default();
    let mut entries = Vec::with_capacity(items.len());
    let mut limits = Vec::new();
    for item in &items {
        let position = Position(entries.len() as u16);
        let (mut entry, is_within) = images.place(item, side_file);
        if !is_within {
            let message =
                format!("the values of this entry and those before it take more than {MOST_BYTES} bytes");
            errors.push(problem_at(sheet, side_file, &item.source, message));
            return Err(errors);
        }
        if let Some((low, high)) = item.limits {
            entry.flags = entry.flags.and(Flags::LIMITED);
            limits.push(Limits { position, low, high });
        }
        if let Some(group) = groups.group(item, &entry, side_file) {
            entry.flags = entry.flags.stored_in(group);
        }
        entries.push(entry);
    }
    let statements = statements::check(&items, &entries, side_file);
    notes.extend(statements.without_effect);
    errors.extend(statements.contradictions);
    in_order(&mut notes);
    if !errors.is_empty() {
        return Err(errors);
    }
    let Images { constants, defaults, .. } = images;
    let mappings = mappings::read(&items, sheet.document());
    let settings = settings::read(sheet, &entries, &mappings, &mut assumptions);
    in_order(&mut assumptions);
    Ok(Layout {
        counts: Counts::of(&entries),
        settings,
        fingerprint: fingerprint(&entries),
        entries,
        mappings,
        cob_ids: cob_ids::read(&items, sheet.document()),
        constants,
        defaults,
        limits,
        dummies: dummies(sheet),
        product: product(sheet),
        assumptions,
        lost,
        notes,
        sources: items.into_iter().map(|item| item.source).collect(),
    })
}

/// In the order of the files, and once where many compact sub-objects are described together.
fn in_order(problems: &mut Vec<Problem>) {
    problems.sort_by(|a, b| (a.file, a.span, &a.message).cmp(&(b.file, b.span, &b.message)));
    problems.dedup();
}

fn problem_at(sheet: &Datasheet, side_file: &SideFile, source: &Source, message: String) -> Problem {
    match source.file {
        InputFile::Eds => Problem::in_eds(sheet.document(), Severity::Error, source.span, message),
        InputFile::SideFile => Problem::in_side_file(&side_file.text, Severity::Error, source.span, message),
    }
}

fn product(sheet: &Datasheet) -> Option<String> {
    Some(sheet.device_info()?.product_name()?.text().into_owned())
}

fn dummies(sheet: &Datasheet) -> u32 {
    let section = sheet.section(SectionKind::DummyUsage);
    let flags = section.into_iter().flat_map(|section| section.all_numbered(KeyName::Dummy));
    let allowed = flags.filter(|entry| entry.flag().known() == Some(true));
    allowed.fold(0, |bits, entry| bits | 1_u32.checked_shl(entry.key().number.into()).unwrap_or(0))
}

/// FNV-1a over what stored values depend on: the place, type, size and group of each entry. Defaults do not count, so that
/// stored values outlive a change of them.
fn fingerprint(entries: &[Entry]) -> u32 {
    let bytes = entries.iter().flat_map(|entry| {
        let group = entry.flags.group().map_or(0, |group| u16::from(group.0));
        let place = u16::from(entry.sub_index.0) | group << 8;
        let numbers = [entry.index.0, place, entry.data_type.index().0, entry.size];
        numbers.into_iter().flat_map(u16::to_le_bytes)
    });
    bytes.fold(0x811C_9DC5, |hash: u32, byte| (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193))
}

/// How many bytes a value of this type has, where it is always the same.
fn fixed_size(data_type: DataType) -> Option<u16> {
    data_type.bits().map(|bits| bits.div_ceil(8))
}
