//! What checks see, and where they report.

use crate::listing::Listing;
use crate::odd_lines::{self, OddLine};
use crate::pdos::{self, DescribedPdo};
use crate::profile::{Applied, Prescribed, Prescription, Profile};
use crate::rules::cob_id::JudgedCobId;
use crate::rules::syntax::lost_header;
use crate::{FileKind, Finding, Label, Neighbours, Rule};
use core::cell::{OnceCell, RefCell};
use edskit_model::{
    Datasheet, Description, Document, Entry, Field, KeyName, Section, SectionKind, Span, Value,
    ValueErrorKind,
};
use edskit_types::{AccessType, DataType, Index, ObjectCode, SubIndex};

/// The file that is linted.
pub struct Context<'a> {
    /// The typed reading.
    pub sheet: &'a Datasheet,
    /// What kind of file it is.
    pub kind: FileKind,
    /// The file's own name without folders, where it has one.
    pub file_name: Option<&'a str>,
    /// The files beside it, where the caller knows them.
    pub neighbours: Option<&'a dyn Neighbours>,
    /// The profiles that the device follows.
    pub(crate) profiles: Applied<'a>,
    /// The lists of objects, once a rule has asked for them.
    listing: OnceCell<Listing>,
    /// The odd lines, once a rule has asked for them.
    odd_lines: OnceCell<Vec<OddLine>>,
    /// The PDOs, once a rule has asked for them.
    pdos: OnceCell<Vec<DescribedPdo<'a>>>,
    /// The COB-IDs, once a rule has asked for them.
    cob_ids: OnceCell<Vec<JudgedCobId<'a>>>,
    /// Rules that have said once for the whole file what they find.
    said: RefCell<Vec<&'static Rule>>,
    /// The sections whose headers stand behind other text, sorted, once a rule has asked for them.
    hidden_sections: OnceCell<Vec<SectionKind>>,
    /// Whether there are modules, once a rule has asked.
    modular: OnceCell<bool>,
}

impl<'a> Context<'a> {
    /// A file to be linted, held to the profiles of CiA.
    pub fn new(sheet: &'a Datasheet, kind: FileKind, file_name: Option<&'a str>) -> Self {
        Self {
            sheet,
            kind,
            file_name,
            neighbours: None,
            profiles: Applied::new(sheet),
            listing: OnceCell::new(),
            odd_lines: OnceCell::new(),
            pdos: OnceCell::new(),
            cob_ids: OnceCell::new(),
            said: RefCell::default(),
            hidden_sections: OnceCell::new(),
            modular: OnceCell::new(),
        }
    }

    /// The same, held to these profiles too.
    pub fn with_profiles(mut self, profiles: &'a [Profile]) -> Self {
        self.profiles.add(self.sheet, profiles);
        self
    }

    /// The lists of objects, read once for all rules.
    pub(crate) fn listing(&self) -> &Listing {
        self.listing.get_or_init(|| Listing::of(self.sheet))
    }

    /// The lines that hold something a correct file hardly ever holds, found once for all rules.
    pub(crate) fn odd_lines(&self) -> &[OddLine] {
        self.odd_lines.get_or_init(|| odd_lines::find(self.sheet))
    }

    /// The entries on those lines.
    pub(crate) fn odd_entries(&self) -> impl Iterator<Item = Entry<'a>> {
        self.odd_lines().iter().filter_map(|line| line.entry(self.sheet))
    }

    /// The described PDOs, read once for all rules.
    pub(crate) fn pdos(&self) -> &[DescribedPdo<'a>] {
        self.pdos.get_or_init(|| pdos::read(self.sheet))
    }

    /// The COB-IDs of messages besides SYNC and the default SDO channel, judged once for all rules.
    pub(crate) fn cob_ids(&self) -> &[JudgedCobId<'a>] {
        self.cob_ids.get_or_init(|| JudgedCobId::all(self))
    }

    /// Whether a rule asks this for the first time: for checks of single variables that report once for the file.
    pub(crate) fn is_first(&self, rule: &'static Rule) -> bool {
        let mut said = self.said.borrow_mut();
        let is_first = !said.contains(&rule);
        if is_first {
            said.push(rule);
        }
        is_first
    }

    /// The sections whose headers stand behind other text, sorted: SYN008 reports the lost line break, so that other
    /// rules do not report its consequences.
    pub(crate) fn hidden_sections(&self) -> &[SectionKind] {
        self.hidden_sections.get_or_init(|| lost_header::hidden(self))
    }

    /// The text.
    pub fn document(&self) -> &'a Document {
        self.sheet.document()
    }

    /// The bytes.
    pub fn source(&self) -> &'a [u8] {
        self.sheet.document().to_bytes()
    }

    /// The start of the file, for findings that have no other place.
    pub fn start(&self) -> Span {
        self.sheet.document().lines().first().map_or(Span::at(0), |line| line.trimmed(self.source()))
    }

    /// `PDOMapping` for mapping entries and so on may name objects that only modules bring.
    pub fn is_modular(&self) -> bool {
        let is_of_module = |section: Section<'_>| matches!(section.kind(), SectionKind::Module(..));
        *self.modular.get_or_init(|| {
            self.sheet.supported_modules().is_some() || self.sheet.other_sections().any(is_of_module)
        })
    }
}

/// An object or sub-object with its attributes read once for all rules.
///
/// Attributes are `None` where the entry is missing or empty, which is the same.
pub struct Variable<'a> {
    /// The index.
    pub index: Index,
    /// The sub-index; `None` for the object's own section.
    pub sub_index: Option<SubIndex>,
    /// The section.
    pub description: Description<'a>,
    /// The object code as written.
    pub object_type: Option<Field<'a, ObjectCode>>,
    /// The object code that counts (VAR where none is written); `None` where it cannot be read.
    pub code: Option<ObjectCode>,
    /// The data type's index as written.
    pub data_type: Option<Field<'a, u16>>,
    /// The data type of CiA 301: the one that is named, or the one behind a type that the file defines.
    pub standard_type: Option<DataType>,
    /// Whether the data type is none of CiA 301, so that only the file can define it.
    pub(crate) has_own_type: bool,
    /// The access as written.
    pub access_type: Option<Field<'a, AccessType>>,
    /// The mapping right as written.
    pub pdo_mapping: Option<Field<'a, bool>>,
    /// The right to be mapped into an SRDO as written.
    pub srdo_mapping: Option<Field<'a, bool>>,
    /// The flags for downloads and scans as written.
    pub obj_flags: Option<Field<'a, u32>>,
    /// The default value, read by the data type.
    pub default_value: Option<Field<'a, Value<'a>>>,
    /// The value of a DCF, read by the data type.
    pub parameter_value: Option<Field<'a, Value<'a>>>,
    /// The lower limit, read by the data type.
    pub low_limit: Option<Field<'a, Value<'a>>>,
    /// The upper limit, read by the data type.
    pub high_limit: Option<Field<'a, Value<'a>>>,
    /// What profiles prescribe for the object; nothing for most.
    pub(crate) prescriptions: &'a [Prescription<'a>],
}

impl<'a> Variable<'a> {
    pub(crate) fn new(
        index: Index,
        sub_index: Option<SubIndex>,
        description: Description<'a>,
        prescriptions: &'a [Prescription<'a>],
    ) -> Self {
        // One walk over the entries instead of a search for each key: this runs for every section of every file.
        let [mut object_type, mut data_type, mut access_type] = [None; 3];
        let [mut pdo_mapping, mut srdo_mapping, mut obj_flags] = [None; 3];
        let [mut default_value, mut parameter_value, mut low_limit, mut high_limit] = [None; 4];
        for entry in description.entries() {
            let first = match entry.key().name {
                KeyName::ObjectType => &mut object_type,
                KeyName::DataType => &mut data_type,
                KeyName::AccessType => &mut access_type,
                KeyName::PdoMapping => &mut pdo_mapping,
                KeyName::SrdoMapping => &mut srdo_mapping,
                KeyName::ObjFlags => &mut obj_flags,
                KeyName::DefaultValue => &mut default_value,
                KeyName::ParameterValue => &mut parameter_value,
                KeyName::LowLimit => &mut low_limit,
                KeyName::HighLimit => &mut high_limit,
                _ => continue,
            };
            first.get_or_insert(entry);
        }
        let object_type = object_type.map(Entry::object_code).filter(is_filled);
        let code = object_type.map_or(Some(ObjectCode::Var), Field::known);
        let data_type = data_type.map(Entry::unsigned::<u16>).filter(is_filled);
        let mut has_own_type = false;
        let standard_type = match data_type {
            Some(field) => field.known().and_then(|index| {
                let known = DataType::from_index(Index(index));
                has_own_type = known.is_none();
                known.or_else(|| Some(description.sheet().resolve_type(Index(index))?.data_type))
            }),
            None => (code == Some(ObjectCode::Domain)).then_some(DataType::Domain),
        };
        let value =
            |first: Option<Entry<'a>>| first.map(|entry| entry.value(standard_type)).filter(is_filled);
        Self {
            index,
            sub_index,
            description,
            object_type,
            code,
            data_type,
            standard_type,
            has_own_type,
            access_type: access_type.map(Entry::access_type).filter(is_filled),
            pdo_mapping: pdo_mapping.map(Entry::flag).filter(is_filled),
            srdo_mapping: srdo_mapping.map(Entry::flag).filter(is_filled),
            obj_flags: obj_flags.map(Entry::unsigned).filter(is_filled),
            default_value: value(default_value),
            parameter_value: value(parameter_value),
            low_limit: value(low_limit),
            high_limit: value(high_limit),
            prescriptions,
        }
    }

    /// The limits of the range type that it has, read by the data type.
    #[inline]
    pub fn range(&self) -> [Option<Field<'a, Value<'a>>>; 2] {
        if !self.has_own_type {
            return [None, None];
        }
        self.description.resolved_type().map_or([None, None], |resolved| [resolved.low, resolved.high])
    }

    /// What profiles prescribe for the variable.
    #[inline]
    pub(crate) fn prescribed(&self) -> impl Iterator<Item = Prescribed<'a>> {
        self.prescriptions.iter().filter_map(|prescription| prescription.of(self))
    }

    /// Whether the section describes equal sub-objects by CompactSubObj.
    pub(crate) fn is_compact(&self) -> bool {
        self.sub_index.is_none()
            && self.description.compact_sub_obj().and_then(Field::known).is_some_and(|count| count > 0)
    }

    /// Whether it holds a value of its own: a sub-object, a VAR, a DOMAIN, a DEFTYPE. Not an ARRAY or RECORD.
    pub fn holds_value(&self) -> bool {
        self.sub_index.is_some() || self.code.is_some_and(|code| !code.has_sub_objects())
    }

    /// `1018h` or `1018h sub-index 01h`.
    pub fn place(&self) -> String {
        match self.sub_index {
            None => self.index.to_string(),
            Some(sub_index) => format!("{} sub-index {sub_index}", self.index),
        }
    }
}

/// Whether an entry has a value; an empty one counts as missing (CiA 306 v1.3, 4.2).
#[inline]
fn is_filled<T>(field: &Field<'_, T>) -> bool {
    !matches!(&field.value, Err(error) if error.kind == ValueErrorKind::Empty)
}

/// Of one rule, a file gets at most this many findings: a file of a megabyte has room for half a million, and nobody
/// reads even these.
pub const MOST_FINDINGS: usize = 2_000;

/// Where the rule that runs puts its findings.
pub struct Report {
    rule: &'static Rule,
    /// Position of the rule in `counts`.
    slot: usize,
    pub(crate) findings: Vec<Finding>,
    /// For each rule how many it reported, and where its last finding is that was kept.
    counts: Vec<Count>,
    /// The last finding that is not kept.
    surplus: Option<Finding>,
}

#[derive(Clone, Copy, Default)]
struct Count {
    reported: usize,
    last: usize,
}

impl Report {
    pub(crate) fn new(rule: &'static Rule) -> Self {
        Self { rule, slot: 0, findings: Vec::new(), counts: Vec::new(), surplus: None }
    }

    /// Says which rule runs from now on, and its position among the rules of the run.
    #[inline]
    pub(crate) fn enter(&mut self, rule: &'static Rule, slot: usize) {
        self.rule = rule;
        self.slot = slot;
    }

    /// Adds a finding at `span`; labels, help and a fix follow on what is returned.
    pub fn add(&mut self, span: Span, message: impl Into<String>) -> &mut Finding {
        let finding = Finding {
            rule: self.rule,
            severity: self.rule.severity,
            message: message.into(),
            labels: vec![Label { span, text: String::new() }],
            help: None,
            fix: None,
            omitted: 0,
        };
        if self.counts.len() <= self.slot {
            self.counts.resize(self.slot + 1, Count::default());
        }
        let count = &mut self.counts[self.slot];
        count.reported += 1;
        if count.reported > MOST_FINDINGS {
            return self.surplus.insert(finding);
        }
        count.last = self.findings.len();
        self.findings.push(finding);
        &mut self.findings[count.last]
    }

    /// The findings; where a rule reported too many, its last one says so.
    pub(crate) fn into_findings(mut self) -> Vec<Finding> {
        for count in self.counts {
            if let Some(more) = count.reported.checked_sub(MOST_FINDINGS).filter(|&more| more > 0) {
                let last = &mut self.findings[count.last];
                last.omitted = more;
                last.message.push_str(&format!("; {more} more findings of this rule are left out"));
            }
        }
        self.findings
    }
}
