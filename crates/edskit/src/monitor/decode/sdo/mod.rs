//! SDO: what each message says (CiA 301 v4.2, 7.2.4).

mod channel;
mod running;

pub(crate) use channel::Channel;

use crate::monitor::network::Shown;
use edskit_host::sdo::SdoValue;
use edskit_types::{AbortCode, Index, SdoMessage, SubIndex};
use serde::Serialize;

/// An SDO message.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub(crate) struct Sdo {
    pub(crate) node: u8,
    /// Whether it comes from the client.
    pub(crate) is_request: bool,
    pub(crate) step: String,
    pub(crate) index: Option<u16>,
    pub(crate) sub_index: Option<u8>,
    pub(crate) name: Option<String>,
    /// What has been read or written, with the message that completes it
    #[serde(flatten)]
    pub(crate) shown: Option<Shown>,
    /// Whether its length was said; else the data type says it, where it can.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) length_said: Option<bool>,
    /// Whether the value was written.
    #[serde(skip)]
    pub(crate) is_written: bool,
    pub(crate) abort_code: Option<u32>,
    #[serde(skip)]
    pub(crate) abort: Option<AbortCode>,
}

/// What a message is, before names are known.
pub(crate) struct Step {
    what: String,
    place: Option<(Index, SubIndex)>,
    /// The value that is complete now, and whether it is written.
    value: Option<(SdoValue, bool)>,
    /// What the entry holds, as a transfer shows that has come to its end with this message.
    pub(super) held: Option<Held>,
    abort: Option<AbortCode>,
}

/// What an entry of the node holds.
pub(super) struct Held {
    pub(super) place: (Index, SubIndex),
    /// `None` where it was not seen whole.
    pub(super) value: Option<SdoValue>,
    /// Whether it was written and the node has confirmed it, or it was read.
    pub(super) is_written: bool,
}

impl Sdo {
    /// The message with names and values, which `look_up` knows.
    pub(super) fn new(
        node: u8,
        message: SdoMessage,
        step: Step,
        look_up: impl FnOnce(Index, SubIndex, Option<&SdoValue>) -> (Option<String>, Option<Shown>),
    ) -> Self {
        let Step { what, place, value, abort, .. } = step;
        let held = value.as_ref().map(|(value, _)| value);
        let (name, shown) = place.map_or((None, None), |(index, sub_index)| look_up(index, sub_index, held));
        Self {
            node,
            is_request: message == SdoMessage::Request,
            step: what,
            index: place.map(|(index, _)| index.0),
            sub_index: place.map(|(_, sub_index)| sub_index.0),
            name,
            shown,
            length_said: held.map(SdoValue::is_length_said),
            is_written: value.is_some_and(|(_, is_written)| is_written),
            abort_code: abort.map(|code| code.0),
            abort,
        }
    }
}
