//! What `show` knows of a device, ready to be printed or turned into JSON.

use edskit_model::{
    Datasheet, Description, DictionaryEntry, Entry, Field, KeyName, Object, Pdo, SectionKind, Value, octets,
};
use edskit_types::{DataType, Index, MappingEntry, NodeId, PdoDirection};
use serde::{Serialize, Serializer};
use std::borrow::Cow;

/// Reads a datasheet for people.
#[derive(Clone, Copy)]
pub(super) struct Viewer<'a> {
    pub(super) sheet: &'a Datasheet,
    /// Evaluates formulas where there is one.
    pub(super) node_id: Option<NodeId>,
}

#[derive(Serialize)]
pub(super) struct DeviceView<'a> {
    pub(super) vendor_name: Option<String>,
    pub(super) vendor_number: Option<String>,
    pub(super) product_name: Option<String>,
    pub(super) product_number: Option<String>,
    pub(super) revision_number: Option<String>,
    pub(super) order_code: Option<String>,
    pub(super) file_name: Option<String>,
    pub(super) file_description: Option<String>,
    pub(super) eds_version: Option<String>,
    /// kbit/s
    pub(super) bit_rates: Vec<u16>,
    pub(super) granularity: Option<u8>,
    pub(super) lss_supported: Option<bool>,
    pub(super) node_id: Option<u8>,
    pub(super) node_name: Option<String>,
    /// kbit/s, of a DCF
    pub(super) bit_rate: Option<u16>,
    /// Module types that the file describes
    pub(super) modules: Vec<String>,
    pub(super) objects: Objects<'a>,
    pub(super) pdos: Vec<PdoView>,
    /// PDOs that exist only through CompactPDO: received, transmitted
    pub(super) implicit_pdos: (usize, usize),
}

/// The objects of a device, made one after the other: a short file can claim millions of compact entries.
pub(super) struct Objects<'a> {
    viewer: Viewer<'a>,
    lists: Vec<(u16, &'static str)>,
}

impl Objects<'_> {
    pub(super) fn len(&self) -> usize {
        self.viewer.sheet.objects().len()
    }

    /// Each object with the entries that differ from others.
    pub(super) fn differing(&self) -> impl Iterator<Item = ObjectView> {
        self.viewed(|entry| !entry.is_like_others())
    }

    fn viewed(&self, wanted: fn(&DictionaryEntry<'_>) -> bool) -> impl Iterator<Item = ObjectView> {
        self.viewer.sheet.objects().map(move |object| self.viewer.listed_object(object, &self.lists, wanted))
    }
}

impl Serialize for Objects<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.viewed(|_| true))
    }
}

#[derive(Serialize)]
pub(super) struct ObjectView {
    pub(super) index: u16,
    pub(super) name: String,
    pub(super) object_code: Option<&'static str>,
    /// Which list names the object
    pub(super) list: Option<&'static str>,
    /// How many equal entries CompactSubObj stands for
    pub(super) compact: u8,
    #[serde(flatten)]
    pub(super) further: Further,
    pub(super) entries: Vec<EntryView>,
}

/// What few sections say, as written.
#[derive(Serialize, Default)]
pub(super) struct Further {
    /// The file of a DCF that takes what is read from a DOMAIN
    upload_file: Option<String>,
    /// The file of a DCF that is written to a DOMAIN
    download_file: Option<String>,
    /// The reference designator
    param_refd: Option<String>,
    obj_flags: Option<String>,
    srdo_mapping: Option<String>,
    inverted_srad: Option<String>,
}

impl Further {
    fn of(description: Description<'_>) -> Self {
        let written = |key| description.filled(key).map(|entry| entry.text().into_owned());
        Self {
            upload_file: written(KeyName::UploadFile),
            download_file: written(KeyName::DownloadFile),
            param_refd: written(KeyName::ParamRefd),
            obj_flags: written(KeyName::ObjFlags),
            srdo_mapping: written(KeyName::SrdoMapping),
            inverted_srad: written(KeyName::InvertedSrad),
        }
    }

    /// Keys with their values.
    pub(super) fn lines(&self) -> impl Iterator<Item = (&'static str, &str)> {
        let all = [
            (KeyName::UploadFile, &self.upload_file),
            (KeyName::DownloadFile, &self.download_file),
            (KeyName::ParamRefd, &self.param_refd),
            (KeyName::ObjFlags, &self.obj_flags),
            (KeyName::SrdoMapping, &self.srdo_mapping),
            (KeyName::InvertedSrad, &self.inverted_srad),
        ];
        all.into_iter().filter_map(|(key, value)| Some((key.spelling(), value.as_deref()?)))
    }
}

#[derive(Serialize)]
pub(super) struct EntryView {
    pub(super) index: u16,
    pub(super) sub_index: u8,
    pub(super) name: String,
    pub(super) denotation: Option<String>,
    pub(super) data_type: Option<String>,
    pub(super) access: Option<String>,
    pub(super) mappable: bool,
    /// As written
    pub(super) default: Option<String>,
    /// As written, of a DCF
    pub(super) value: Option<String>,
    /// The value with the node-ID put in, where it depends on it and one is known
    pub(super) evaluated: Option<i128>,
    pub(super) low_limit: Option<String>,
    pub(super) high_limit: Option<String>,
    #[serde(flatten)]
    pub(super) further: Further,
}

#[derive(Serialize)]
pub(super) struct PdoView {
    /// `RPDO1`
    pub(super) name: String,
    pub(super) communication: u16,
    pub(super) mapping: u16,
    /// As written, or evaluated where a node-ID is known
    pub(super) cob_id: Option<String>,
    /// Bit 31 of the COB-ID is 0; unknown where the COB-ID is
    pub(super) valid: Option<bool>,
    pub(super) transmission_type: Option<u8>,
    pub(super) transmission: Option<String>,
    /// Multiples of 100 µs
    pub(super) inhibit_time: Option<u16>,
    /// ms
    pub(super) event_timer: Option<u16>,
    pub(super) mapped: Vec<MappedView>,
    pub(super) bits: u32,
}

#[derive(Serialize)]
pub(super) struct MappedView {
    pub(super) index: u16,
    pub(super) sub_index: u8,
    pub(super) name: String,
    pub(super) denotation: Option<String>,
    pub(super) first_bit: u32,
    pub(super) bits: u8,
}

const LISTS: [(SectionKind, &str); 3] = [
    (SectionKind::MandatoryObjects, "mandatory"),
    (SectionKind::OptionalObjects, "optional"),
    (SectionKind::ManufacturerObjects, "manufacturer"),
];

impl<'a> Viewer<'a> {
    pub(super) fn device(&self) -> DeviceView<'a> {
        let sheet = self.sheet;
        let text = |entry: Option<Entry<'_>>| entry.map(|entry| entry.text().into_owned());
        let info = sheet.device_info();
        let file = sheet.file_info();
        let commissioning = sheet.commissioning();
        let directions = [PdoDirection::Receive, PdoDirection::Transmit];
        let module_name = |module: edskit_model::Module<'_>| {
            let name = module.info().and_then(|info| info.filled(KeyName::ProductName));
            text(name).unwrap_or_else(|| format!("module {}", module.number()))
        };
        DeviceView {
            vendor_name: text(info.and_then(|info| info.vendor_name())),
            vendor_number: info.and_then(|info| info.vendor_number()).map(|field| field.text().into_owned()),
            product_name: text(info.and_then(|info| info.product_name())),
            product_number: info
                .and_then(|info| info.product_number())
                .map(|field| field.text().into_owned()),
            revision_number: info
                .and_then(|info| info.revision_number())
                .map(|field| field.text().into_owned()),
            order_code: text(info.and_then(|info| info.order_code())),
            file_name: text(file.and_then(|file| file.file_name())),
            file_description: text(file.and_then(|file| file.description())),
            eds_version: text(file.and_then(|file| file.eds_version())),
            bit_rates: info
                .map(|info| info.bitrates().map(|bitrate| bitrate.kbit_per_s()).collect())
                .unwrap_or_default(),
            granularity: info.and_then(|info| info.granularity()?.known()),
            lss_supported: info.and_then(|info| info.lss_supported()?.known()),
            node_id: self.node_id.map(NodeId::get),
            node_name: text(commissioning.and_then(|commissioning| commissioning.node_name())),
            bit_rate: commissioning.and_then(|commissioning| commissioning.baudrate()?.known()),
            modules: sheet.modules().map(module_name).collect(),
            objects: Objects { viewer: *self, lists: self.lists() },
            pdos: directions
                .iter()
                .flat_map(|&direction| sheet.pdos(direction))
                .map(|pdo| self.pdo(pdo))
                .collect(),
            implicit_pdos: (
                sheet.implicit_pdos(PdoDirection::Receive).count(),
                sheet.implicit_pdos(PdoDirection::Transmit).count(),
            ),
        }
    }

    /// One object with every entry, compact ones too.
    pub(super) fn object(&self, object: Object<'_>) -> ObjectView {
        self.listed_object(object, &self.lists(), |_| true)
    }

    /// The PDO that a communication or mapping parameter belongs to.
    pub(super) fn pdo_of(&self, index: Index) -> Option<PdoView> {
        let direction = if index.is_rpdo_communication() || index.is_rpdo_mapping() {
            PdoDirection::Receive
        } else if index.is_tpdo_communication() || index.is_tpdo_mapping() {
            PdoDirection::Transmit
        } else {
            return None;
        };
        let number = (index.0 & 0x1FF) + 1;
        let pdo = self.sheet.pdos(direction).find(|pdo| pdo.number == number)?;
        Some(self.pdo(pdo))
    }

    /// The list that names each index, sorted by index.
    fn lists(&self) -> Vec<(u16, &'static str)> {
        let named = LISTS.iter().filter_map(|&(kind, name)| Some((self.sheet.section(kind)?, name)));
        let items = named.flat_map(|(section, name)| {
            section.items().filter_map(move |item| Some((item.meant()?.0, name)))
        });
        let mut lists: Vec<_> = items.collect();
        lists.sort_unstable();
        lists
    }

    /// An object with those of its entries that are wanted.
    fn listed_object(
        &self,
        object: Object<'_>,
        lists: &[(u16, &'static str)],
        wanted: fn(&DictionaryEntry<'_>) -> bool,
    ) -> ObjectView {
        let index = object.index().0;
        let compact = object.compact_count();
        let entries: Vec<EntryView> =
            object.dictionary_entries().filter(wanted).map(|entry| self.entry(entry)).collect();
        ObjectView {
            index,
            name: name_of(object.description()),
            object_code: object.object_code().map(|code| code.name()),
            list: lists
                .binary_search_by_key(&index, |&(index, _)| index)
                .ok()
                .map(|position| lists[position].1),
            compact,
            further: Further::of(object.description()),
            entries,
        }
    }

    fn entry(&self, entry: DictionaryEntry<'_>) -> EntryView {
        let data_type = entry.data_type();
        let description = entry.description();
        let written = |key| {
            let entry = description?.filled(key)?;
            Some(entry.text().into_owned())
        };
        // A value that is written wrongly is shown as it is read.
        let typed = |field: Option<Field<'_, Value<'_>>>| {
            let field = field?;
            Some(match (field.value, field.known()) {
                (Err(_), Some(value)) => plain(value, data_type),
                _ => field.text().into_owned(),
            })
        };
        let [low_limit, high_limit] = entry.limits().map(typed);
        let from_compact = |value: Option<Value<'_>>| value.map(|value| plain(value, data_type));
        let (default, value) = match description {
            Some(description) => (typed(description.default_value()), typed(description.parameter_value())),
            None => {
                let listed = entry.value_field().filter(|field| field.entry.key().name == KeyName::Item);
                (from_compact(entry.default_value()), typed(listed))
            }
        };
        let evaluated = match (entry.value(), data_type) {
            (Some(value @ Value::Formula(_)), Some(data_type)) => value.integer(data_type, self.node_id).ok(),
            _ => None,
        };
        let data_type_text = match data_type {
            Some(data_type) => Some(data_type.name().to_owned()),
            None => written(KeyName::DataType),
        };
        EntryView {
            index: entry.index.0,
            sub_index: entry.sub_index.0,
            name: entry.name().into_owned(),
            denotation: entry.denotation().map(|text| text.into_owned()),
            data_type: data_type_text,
            access: entry.access().map(|access| access.to_string()).or_else(|| written(KeyName::AccessType)),
            mappable: entry.is_mappable(),
            default,
            value,
            evaluated,
            low_limit,
            high_limit,
            further: description.map(Further::of).unwrap_or_default(),
        }
    }

    fn pdo(&self, pdo: Pdo<'_>) -> PdoView {
        let (letter, communication, mapping) = match pdo.direction {
            PdoDirection::Receive => ('R', Index::RPDO_COMMUNICATION, Index::RPDO_MAPPING),
            PdoDirection::Transmit => ('T', Index::TPDO_COMMUNICATION, Index::TPDO_MAPPING),
        };
        let cob_id = pdo.cob_id();
        let evaluated = cob_id.and_then(|value| value.integer(DataType::Unsigned32, self.node_id).ok());
        // The node-ID never reaches the flags, so any one tells them.
        let flags = cob_id.and_then(|value| value.integer(DataType::Unsigned32, Some(NodeId::MIN)).ok());
        let mut first_bit = 0;
        let mapped: Vec<MappedView> = pdo
            .mapped(self.node_id)
            .map(|(_, entry)| {
                let mapped = self.mapped(entry.unwrap_or(MappingEntry(0)), first_bit);
                first_bit += u32::from(mapped.bits);
                mapped
            })
            .collect();
        PdoView {
            name: format!("{letter}PDO{}", pdo.number),
            communication: communication.0 + pdo.number - 1,
            mapping: mapping.0 + pdo.number - 1,
            cob_id: match evaluated {
                Some(value) => Some(format!("{value:X}h")),
                None => cob_id.map(|value| plain(value, Some(DataType::Unsigned32))),
            },
            valid: flags.map(|value| value >> 31 & 1 == 0),
            transmission_type: pdo.transmission_type().map(|kind| kind.0),
            transmission: pdo.transmission_type().map(|kind| transmission(kind, pdo.direction)),
            inhibit_time: pdo.inhibit_time(),
            event_timer: pdo.event_timer(),
            mapped,
            bits: first_bit,
        }
    }

    fn mapped(&self, entry: MappingEntry, first_bit: u32) -> MappedView {
        let (index, sub_index) = (entry.index(), entry.sub_index());
        let described = self.sheet.dictionary_entry(index, sub_index);
        let name = if entry.0 == 0 {
            "(nothing)".to_owned()
        } else if entry.is_dummy() {
            let data_type = DataType::from_index(index);
            format!(
                "dummy {}",
                data_type.map_or_else(|| index.to_string(), |data_type| data_type.name().to_owned())
            )
        } else {
            described.map_or_else(|| "(not described)".to_owned(), |entry| entry.name().into_owned())
        };
        MappedView {
            index: index.0,
            sub_index: sub_index.0,
            name,
            denotation: described.and_then(DictionaryEntry::denotation).map(Cow::into_owned),
            first_bit,
            bits: entry.bits(),
        }
    }
}

/// A name, and what the entry is called in this device.
pub(super) fn titled(name: &str, denotation: Option<&str>) -> String {
    denotation.map_or_else(|| name.to_owned(), |denotation| format!("{name} \"{denotation}\""))
}

fn name_of(description: Description<'_>) -> String {
    description.parameter_name().map(|entry| entry.text().into_owned()).unwrap_or_default()
}

/// A value without the text it came from.
fn plain(value: Value<'_>, data_type: Option<DataType>) -> String {
    match value {
        Value::Boolean(value) => u8::from(value).to_string(),
        Value::Integer(number) => number.to_string(),
        Value::Formula(formula) => formula.to_string(),
        Value::Real(_) | Value::RealBits(_) => data_type
            .and_then(|data_type| value.real(data_type))
            .map(|value| value.to_string())
            .unwrap_or_default(),
        Value::Octets(digits) => octets(digits).map(|octet| format!("{octet:02X}")).collect(),
        Value::Text(bytes) | Value::Bits(bytes) => String::from_utf8_lossy(bytes).into_owned(),
        Value::Time { days, milliseconds } => format!("{days} days, {milliseconds} ms"),
    }
}

/// A transmission type in words.
fn transmission(kind: edskit_types::TransmissionType, direction: PdoDirection) -> String {
    use edskit_types::Transmission;
    match kind.meaning(direction) {
        Transmission::SynchronousAcyclic => "synchronous, acyclic".to_owned(),
        Transmission::Synchronous => "synchronous".to_owned(),
        Transmission::SynchronousCyclic(1) => "every SYNC".to_owned(),
        Transmission::SynchronousCyclic(count) => format!("every {count} SYNCs"),
        Transmission::RtrSynchronous => "on RTR, sampled at SYNC".to_owned(),
        Transmission::RtrEvent => "on RTR".to_owned(),
        Transmission::EventManufacturer => "event-driven, manufacturer specific".to_owned(),
        Transmission::EventProfile => "event-driven, by the profile".to_owned(),
        Transmission::Reserved => "reserved".to_owned(),
    }
}
