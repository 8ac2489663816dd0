//! One line for each frame: for people, and as JSON.

use super::decode::{Lss, Message, PdoValue, Sdo};
use crate::value;
use edskit_runtime::Frame;
use edskit_types::{EmergencyCode, Index, SubIndex};
use serde::{Serialize, Serializer};

/// Below it are the data types, which fill gaps in PDOs and mean nothing.
const FIRST_OBJECT: u16 = 0x1000;

/// A frame with its time and what it says.
pub(super) struct Report<'a> {
    /// Microseconds since 1970.
    pub(super) time: u64,
    pub(super) frame: &'a Frame,
    pub(super) message: Message,
}

/// The same as JSON.
#[derive(Serialize)]
struct Json<'a> {
    /// Microseconds since 1970.
    time: u64,
    can_id: u32,
    extended: bool,
    remote: bool,
    data: String,
    #[serde(flatten)]
    message: &'a Message,
}

impl Serialize for Report<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let json = Json {
            time: self.time,
            can_id: self.frame.can_id().raw(),
            extended: self.frame.can_id().is_extended(),
            remote: self.frame.is_remote(),
            data: value::digits(self.frame.data()),
            message: &self.message,
        };
        json.serialize(serializer)
    }
}

impl Report<'_> {
    /// `07:30:00.123456  605h  40 18 10 01 00 00 00 00  node 5 SDO >  read 1018h:01h Identity object/Vendor-ID`
    pub(super) fn text(&self) -> String {
        let data = if self.frame.is_remote() {
            let length = self.frame.length();
            format!("remote, {length} byte{}", if length == 1 { "" } else { "s" })
        } else {
            value::hex(self.frame.data())
        };
        let can_id = self.frame.can_id().to_string();
        let line =
            format!("{}  {can_id:>4}  {data:<23}  {}", value::clock(self.time), meaning(&self.message));
        line.trim_end().to_owned()
    }
}

fn meaning(message: &Message) -> String {
    let of_node = |node: u8, service: &str, text: &str| format!("node {node:<3} {service:<9} {text}");
    match message {
        Message::Nmt { command, node: Some(node) } => of_node(*node, "NMT", command),
        Message::Nmt { command, node: None } => format!("all nodes {:<8} {command}", "NMT"),
        Message::Sync { counter: None } => "SYNC".to_owned(),
        Message::Sync { counter: Some(counter) } => format!("SYNC {counter}"),
        Message::Time { time } => format!("TIME {time}"),
        Message::Emcy { node, code, error_register, errors, info, .. } => {
            let register = match errors[..] {
                [] => format!("error register {error_register:02X}h"),
                _ => format!("error register {error_register:02X}h ({})", errors.join(", ")),
            };
            of_node(*node, "EMCY", &format!("{}; {register}; {info}", EmergencyCode(*code)))
        }
        Message::BootUp { node } => of_node(*node, "boot-up", ""),
        Message::Heartbeat { node, state } => of_node(*node, "heartbeat", state),
        Message::GuardRequest { node } => of_node(*node, "guarding", "asked for its state"),
        Message::Guarding { node, state, toggle } => {
            of_node(*node, "guarding", &format!("{state}, toggle {}", u8::from(*toggle)))
        }
        Message::Sdo(sdo) => {
            of_node(sdo.node, if sdo.is_request { "SDO >" } else { "SDO <" }, &sdo_text(sdo))
        }
        Message::Pdo { node, pdo, values, note } => of_node(*node, pdo, &pdo_text(values, note.as_deref())),
        Message::PdoRequest { node, pdo } => of_node(*node, pdo, "asked for"),
        Message::Lss(Lss { is_request, what }) => {
            format!("LSS {} {what}", if *is_request { ">" } else { "<" })
        }
        Message::Malformed { expected } => format!("(expected {expected})"),
        Message::Unknown => String::new(),
    }
}

/// `1017h:00h Producer heartbeat time: value 1000 (03E8h)`
fn sdo_text(sdo: &Sdo) -> String {
    let mut text = String::new();
    if let (Some(index), Some(sub_index)) = (sdo.index, sdo.sub_index) {
        text += &format!("{}:{}", Index(index), SubIndex(sub_index));
        if let Some(name) = &sdo.name {
            text += &format!(" {name}");
        }
        text += ": ";
    }
    text += &sdo.step;
    match (&sdo.shown, &sdo.step[..]) {
        (Some(shown), "value" | "write") => text += &format!(" {}", shown.text),
        (Some(shown), _) if sdo.is_written => text += &format!("; written {}", shown.text),
        (Some(shown), _) => text += &format!("; value {}", shown.text),
        (None, _) => {}
    }
    if let Some(code) = sdo.abort {
        text += &format!(" {code}");
    }
    text
}

fn pdo_text(values: &[PdoValue], note: Option<&str>) -> String {
    let place = |value: &PdoValue| format!("{}:{}", Index(value.index), SubIndex(value.sub_index));
    let parts = values.iter().filter(|value| value.index >= FIRST_OBJECT).map(|value| {
        let name = value.name.clone().unwrap_or_else(|| place(value));
        format!("{name} = {}", value.shown.text)
    });
    let text = parts.collect::<Vec<_>>().join(", ");
    match note {
        Some(note) if text.is_empty() => format!("({note})"),
        Some(note) => format!("{text} ({note})"),
        None => text,
    }
}
