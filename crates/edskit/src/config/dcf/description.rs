//! The text of the DCF: that of the data sheet, with what is otherwise on the device.

use super::start::Started;
use edskit_host::sdo::SdoError;
use edskit_lint::Edit;
use edskit_model::{
    Datasheet, Description, Field, KeyName, LineKind, Object, Radix, Section, SectionKind, Value, format,
};
use edskit_types::{DataType, Index, NodeId, SubIndex};

/// The first object whose entries change while the device runs: from here on are the data of PDOs.
const PROCESS_DATA: Index = Index(0x2000);

/// What stands before a file with active RPDOs. The linter is right that the objects should be `rww`; but who
/// reads that writes them, and the device refuses it (GW-GAP-02).
const ABOUT_RPDOS: &str = ";edskit: allow-file(PDO007) RPDOs write 2003h and 2004h, SDO requests cannot";

/// Instead of what the data sheet says of all configurations, in the third line of its comments.
const COMMENT: &str = "What the parameters of this device do not need is left out.";

/// The DCF of a started gateway, called `name`. `sheet` is the data sheet that edskit ships.
///
/// # Errors
/// What the device answers against its data sheet.
pub(super) fn describe(sheet: &Datasheet, name: &str, mut device: Started) -> Result<Vec<u8>, SdoError> {
    let mut text = Text { sheet, edits: Vec::new(), node_id: device.node_id() };
    for object in sheet.objects() {
        match object.sub_objects().len() {
            0 => text.variable(object, &mut device)?,
            _ => text.record(object, &mut device)?,
        }
    }
    text.about_the_device(&mut device)?;
    text.about_the_file(name, device.has_rpdos());
    Ok(format(&Datasheet::parse(&text.edited())))
}

/// The data sheet, and what is written otherwise.
struct Text<'a> {
    sheet: &'a Datasheet,
    edits: Vec<Edit>,
    node_id: NodeId,
}

impl<'a> Text<'a> {
    fn about_the_file(&mut self, name: &str, has_rpdos: bool) {
        if has_rpdos {
            self.edits.push(Edit::insert(0, format!("{ABOUT_RPDOS}{}", self.line_ending())));
        }
        if let Some(section) = self.sheet.section(SectionKind::FileInfo) {
            let data_sheet = text_of(section, KeyName::FileName);
            self.set(section, KeyName::FileName, name);
            self.add(section, &[format!("LastEDS={data_sheet}")]);
        }
        let comments = self.sheet.section(SectionKind::Comments);
        if let Some(line) = comments.and_then(|section| section.numbered(KeyName::Line, 3)) {
            self.edits.push(Edit::replace(line.value_span(), COMMENT));
        }
    }

    fn about_the_device(&mut self, device: &mut Started) -> Result<(), SdoError> {
        let Some(section) = self.sheet.section(SectionKind::DeviceInfo) else { return Ok(()) };
        if let Some(revision) = device.read(Index::IDENTITY, SubIndex(3))? {
            self.set(section, KeyName::RevisionNumber, &revision.to_string());
        }
        let serial_number = device.read(Index::IDENTITY, SubIndex(4))?.unwrap_or_default();
        // There is none with manual bit timing.
        let bit_rate =
            device.bit_rate().map(|bit_rate| bit_rate.kbit_per_s().to_string()).unwrap_or_default();
        self.add(
            section,
            &[
                String::new(),
                "[DeviceComissioning]".to_owned(),
                format!("NodeID={}", self.node_id),
                format!("NodeName={}", text_of(section, KeyName::ProductName)),
                format!("Baudrate={bit_rate}"),
                "NetNumber=0".to_owned(),
                "NetworkName=".to_owned(),
                "CANopenManager=0".to_owned(),
                format!("LSS_SerialNumber={serial_number}"),
            ],
        );
        Ok(())
    }

    fn variable(&mut self, object: Object<'_>, device: &mut Started) -> Result<(), SdoError> {
        let value = device.read(object.index(), SubIndex(0))?;
        if let Some(value) = value.filter(|_| object.index() < PROCESS_DATA) {
            self.set_default_value(object.description(), value);
        }
        Ok(())
    }

    /// An object with its entries. What counts them counts those that exist.
    fn record(&mut self, object: Object<'_>, device: &mut Started) -> Result<(), SdoError> {
        let mut count = 0;
        for sub_object in object.sub_objects() {
            let description = sub_object.description();
            match device.read(sub_object.index(), sub_object.sub_index())? {
                None => self.remove(description.section()),
                Some(value) => {
                    count += 1;
                    let is_number_of_entries = sub_object.sub_index() == SubIndex(0);
                    if is_number_of_entries || object.index() < PROCESS_DATA {
                        self.set_default_value(description, value);
                    }
                    if is_number_of_entries {
                        self.set(description.section(), KeyName::HighLimit, &value.to_string());
                    }
                    if let Some(content) = device.content(sub_object.index(), sub_object.sub_index()) {
                        self.add(description.section(), &[format!("Denotation={content}")]);
                    }
                }
            }
        }
        self.set(object.description().section(), KeyName::SubNumber, &count.to_string());
        Ok(())
    }

    /// What an entry holds, where the data sheet says another value or none.
    fn set_default_value(&mut self, description: Description<'_>, value: u32) {
        let data_type = description.standard_type().unwrap_or(DataType::Unsigned32);
        let stated = description.default_value();
        let meaning = stated.and_then(Field::known);
        let is_stated =
            |meaning: Value<'_>| meaning.integer(data_type, Some(self.node_id)) == Ok(value.into());
        if meaning.is_some_and(is_stated) {
            return;
        }
        let is_decimal = match meaning {
            Some(Value::Integer(number)) => number.radix() != Radix::Hexadecimal,
            _ => data_type != DataType::Unsigned32,
        };
        let digits = data_type.bits().unwrap_or_default() as usize / 4;
        let value = if is_decimal { value.to_string() } else { format!("0x{value:0digits$X}") };
        match stated {
            Some(stated) => self.edits.push(Edit::replace(stated.span(), value)),
            None => self.add(description.section(), &[format!("DefaultValue={value}")]),
        }
    }

    /// Writes another value, where the section has the entry.
    fn set(&mut self, section: Section<'_>, key: KeyName, value: &str) {
        if let Some(entry) = section.entry(key) {
            self.edits.push(Edit::replace(entry.value_span(), value));
        }
    }

    /// Adds lines behind the entries of a section.
    fn add(&mut self, section: Section<'_>, lines: &[String]) {
        let ending = self.line_ending();
        let text: String = lines.iter().flat_map(|line| [ending, line]).collect();
        self.edits.push(Edit::insert(section.end().start, text));
    }

    /// Takes a section out, with the empty lines behind it.
    fn remove(&mut self, section: Section<'_>) {
        let lines = self.sheet.document().lines();
        let last = section.entries().next_back().map_or(section.line_number(), |entry| entry.line_number());
        let empty = lines[last + 1..].iter().take_while(|line| line.kind() == LineKind::Blank).count();
        let (first, last) = (lines[section.line_number()].full_span(), lines[last + empty].full_span());
        let mut span = first;
        span.end = last.end;
        self.edits.push(Edit::delete(span));
    }

    fn line_ending(&self) -> &'static str {
        self.sheet.document().line_ending().as_str()
    }

    fn edited(mut self) -> Vec<u8> {
        self.edits.sort_by_key(|edit| edit.span.start);
        Edit::apply_all(&self.edits, self.sheet.document().to_bytes())
    }
}

fn text_of(section: Section<'_>, key: KeyName) -> String {
    section.entry(key).map(|entry| entry.text().into_owned()).unwrap_or_default()
}
