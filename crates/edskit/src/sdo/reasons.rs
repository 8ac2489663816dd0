//! Why a request may have failed, and what to do.

use super::silence::on_silence;
use crate::cli::TransferKind;
use crate::live::KnownDevice;
use crate::value::size;
use edskit_host::sdo::SdoError;
use edskit_model::{DictionaryEntry, Field, Value};
use edskit_types::{AbortCode, AccessType, CobId, DataType, Index, NodeId, SubIndex};

/// What was asked for.
pub(super) struct Request<'a> {
    pub(super) node: NodeId,
    pub(super) device: Option<&'a KnownDevice>,
    pub(super) index: Index,
    pub(super) sub_index: SubIndex,
    /// The bytes that were to be written; `None` for a read.
    pub(super) written: Option<&'a [u8]>,
    pub(super) data_type: Option<DataType>,
    pub(super) transfer: TransferKind,
}

/// Where the user has asked for blocks.
pub(super) const WITHOUT_BLOCKS: &str =
    "The node may not know this kind of transfer; --transfer segmented is what most nodes know.";

/// What helps to understand an error, in whole sentences.
pub(super) fn reasons(request: &Request<'_>, error: &SdoError) -> Vec<String> {
    match error {
        SdoError::Aborted(code) => on_abort(request, *code),
        SdoError::TimedOut { heard } => on_silence(request, heard),
        SdoError::GivenUp { .. } if request.transfer == TransferKind::Block => {
            vec![WITHOUT_BLOCKS.to_owned()]
        }
        _ => Vec::new(),
    }
}

fn on_abort(request: &Request<'_>, code: AbortCode) -> Vec<String> {
    let Request { device, index, sub_index, .. } = *request;
    let entry = device.and_then(|device| device.entry(index, sub_index));
    let file = device.map_or("the EDS", |device| &device.file);
    let reason = match code {
        AbortCode::OBJECT_DOES_NOT_EXIST => on_missing_object(request, file),
        AbortCode::SUB_INDEX_DOES_NOT_EXIST => on_missing_sub_index(request, file),
        AbortCode::READ_ONLY | AbortCode::WRITE_ONLY | AbortCode::UNSUPPORTED_ACCESS => {
            on_order(request).or_else(|| on_access(entry?, request.written.is_some(), file))
        }
        AbortCode::LENGTH_MISMATCH | AbortCode::LENGTH_TOO_HIGH | AbortCode::LENGTH_TOO_LOW => {
            on_length(request, entry, file)
        }
        AbortCode::INVALID_VALUE | AbortCode::VALUE_TOO_HIGH | AbortCode::VALUE_TOO_LOW => {
            on_order(request).or_else(|| on_limits(entry?, file))
        }
        AbortCode::LOCAL_CONTROL => {
            Some("What operates the device on the spot, a key or a panel say, keeps this from the bus.".to_owned())
        }
        AbortCode::CANNOT_TRANSFER | AbortCode::DEVICE_STATE => {
            on_signature(request).or_else(|| Some(on_state(request)))
        }
        AbortCode::UNKNOWN_COMMAND
        | AbortCode::INVALID_BLOCK_SIZE
        | AbortCode::INVALID_SEQUENCE_NUMBER
        | AbortCode::CRC_ERROR
            if request.transfer == TransferKind::Block =>
        {
            Some(WITHOUT_BLOCKS.to_owned())
        }
        AbortCode::UNKNOWN_COMMAND => Some(
            "This kind of transfer is what every node knows; perhaps the node was in the midst of another one: try again."
                .to_owned(),
        ),
        _ => None,
    };
    reason.into_iter().collect()
}

fn on_missing_object(request: &Request<'_>, file: &str) -> Option<String> {
    let device = request.device?;
    Some(if device.sheet.object(request.index).is_some() {
        format!("{file} describes it, so the device is another one or of another revision; compare 1018h.")
    } else {
        format!("{file} does not describe it either.")
    })
}

fn on_missing_sub_index(request: &Request<'_>, file: &str) -> Option<String> {
    let object = request.device?.sheet.object(request.index)?;
    if object.dictionary_entry(request.sub_index).is_some() {
        return Some(format!(
            "{file} describes it, so the device is another one or of another revision; compare 1018h."
        ));
    }
    let subs: Vec<String> =
        object.dictionary_entries().take(17).map(|entry| entry.sub_index.to_string()).collect();
    let (more, subs) = (if subs.len() > 16 { " and more" } else { "" }, &subs[..subs.len().min(16)]);
    Some(format!("{file} describes {} with {}{more}.", request.index, subs.join(", ")))
}

/// Parameters of PDOs can be written in one order only (CiA 301 v4.2, 7.5.2.36).
fn on_order(request: &Request<'_>) -> Option<String> {
    let (index, sub_index) = (request.index, request.sub_index);
    request.written?;
    if (index.is_rpdo_mapping() || index.is_tpdo_mapping()) && sub_index.0 > 0 {
        return Some(format!(
            "The mapping can change only while the PDO is not valid (bit 31 of {}:01h is 1) and {index}:00h is 0.",
            Index(index.0 - 0x200)
        ));
    }
    let is_communication = index.is_rpdo_communication() || index.is_tpdo_communication();
    if is_communication && sub_index.0 > 0 {
        return Some(format!(
            "While the PDO is valid, only bit 31 of {index}:01h can change: write the COB-ID with {} added, then the \
             rest, then the COB-ID without it.",
            CobId(CobId::BIT_31)
        ));
    }
    None
}

fn on_access(entry: DictionaryEntry<'_>, is_write: bool, file: &str) -> Option<String> {
    let access = entry.access()?;
    let is_allowed = if is_write { access.is_writable() } else { !matches!(access, AccessType::Wo) };
    Some(if is_allowed {
        format!(
            "{file} says `{}`, so the device differs from its EDS, or refuses it in its present state.",
            access.as_str()
        )
    } else {
        format!("{file} says `{}` too.", access.as_str())
    })
}

fn on_length(request: &Request<'_>, entry: Option<DictionaryEntry<'_>>, file: &str) -> Option<String> {
    let sent = request.written?.len();
    let count = |bytes: usize| if bytes == 1 { "1 byte".to_owned() } else { format!("{bytes} bytes") };
    match entry.and_then(|entry| entry.data_type()) {
        Some(data_type) => match size(data_type) {
            Some(size) if size != sent => Some(format!(
                "{file} says {}, which has {}; {} sent.",
                data_type.name(),
                count(size),
                were(sent)
            )),
            _ => Some(format!(
                "{} sent, as {file} says with {}; the device wants another length.",
                were(sent),
                data_type.name()
            )),
        },
        None => {
            let data_type = request.data_type.map_or_else(String::new, |kind| format!(" as {}", kind.name()));
            Some(format!("{} sent{data_type}; --eds knows the type, --type gives it.", were(sent)))
        }
    }
}

/// `1 byte was`, `2 bytes were`
fn were(bytes: usize) -> String {
    if bytes == 1 { "1 byte was".to_owned() } else { format!("{bytes} bytes were") }
}

fn on_limits(entry: DictionaryEntry<'_>, file: &str) -> Option<String> {
    let data_type = entry.data_type()?;
    let limit = |value: Option<Value<'_>>| {
        let value = value?;
        value
            .integer(data_type, None)
            .map(|value| value.to_string())
            .ok()
            .or_else(|| value.real(data_type).map(|value| value.to_string()))
    };
    let [low, high] = entry.limits().map(|limit| limit.and_then(Field::known));
    match (limit(low), limit(high)) {
        (Some(low), Some(high)) => Some(format!("{file} allows {low} to {high}.")),
        (Some(low), None) => Some(format!("{file} allows {low} and more.")),
        (None, Some(high)) => Some(format!("{file} allows up to {high}.")),
        (None, None) => None,
    }
}

/// Storing and restoring need a word (CiA 301 v4.2, 7.5.2.13).
fn on_signature(request: &Request<'_>) -> Option<String> {
    request.written?;
    let word = match request.index {
        Index::STORE_PARAMETERS => "0x65766173 (`save`)",
        Index::RESTORE_PARAMETERS => "0x64616F6C (`load`)",
        _ => return None,
    };
    Some(format!("The value that is taken is {word}."))
}

fn on_state(request: &Request<'_>) -> String {
    format!(
        "The device allows it in another state only; parameters are often taken in pre-operational: `edskit nmt {} preop`.",
        request.node
    )
}
