//! Reading bytes as text for display. The bytes themselves never change.

use std::borrow::Cow;

/// What some editors put in front of UTF-8 text.
pub(crate) const UTF8_BOM: &[u8] = b"\xEF\xBB\xBF";

/// How the bytes of a document are read as text.
///
/// CiA 306 v1.3, 4.2 allows 7-bit ISO/IEC 646 only; files in use are also UTF-8 and Windows-1252.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Encoding {
    /// Only bytes below 80h: what CiA 306 asks for.
    Ascii,
    /// Valid UTF-8 with characters beyond ASCII.
    Utf8,
    /// Not valid UTF-8: read as Windows-1252, a superset of Latin-1.
    Windows1252,
}

impl Encoding {
    /// The encoding that fits all of `bytes`.
    pub(super) fn of(bytes: &[u8]) -> Self {
        if bytes.is_ascii() {
            Self::Ascii
        } else if std::str::from_utf8(bytes).is_ok() {
            Self::Utf8
        } else {
            Self::Windows1252
        }
    }

    /// The name as IANA writes it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Ascii => "US-ASCII",
            Self::Utf8 => "UTF-8",
            Self::Windows1252 => "windows-1252",
        }
    }

    /// The bytes that stand for `text`. A character that Windows-1252 does not have becomes `?`.
    pub fn encode(self, text: &str) -> Vec<u8> {
        if self != Self::Windows1252 || text.is_ascii() {
            return text.as_bytes().to_vec();
        }
        let mut bytes = Vec::with_capacity(text.len());
        for character in text.chars() {
            let mut buffer = [0; 4];
            match encoding_rs::WINDOWS_1252.encode(character.encode_utf8(&mut buffer)) {
                (encoded, _, false) => bytes.extend_from_slice(&encoded),
                (_, _, true) => bytes.push(b'?'),
            }
        }
        bytes
    }

    /// Whether every character of `text` can be written without a change of the encoding.
    pub fn can_encode(self, text: &str) -> bool {
        match self {
            Self::Ascii => text.is_ascii(),
            Self::Utf8 => true,
            Self::Windows1252 => text.is_ascii() || !encoding_rs::WINDOWS_1252.encode(text).2,
        }
    }

    /// The text that `bytes` stand for.
    pub fn decode(self, bytes: &[u8]) -> Cow<'_, str> {
        match self {
            Self::Ascii | Self::Utf8 => String::from_utf8_lossy(bytes),
            Self::Windows1252 => encoding_rs::WINDOWS_1252.decode_without_bom_handling(bytes).0,
        }
    }
}

/// A text of the same length in which every byte beyond ASCII is a `?`.
///
/// The lexer wants UTF-8 and gives back only offsets, so a stand-in of equal length serves every other encoding.
pub(super) fn ascii_shadow(bytes: &[u8]) -> String {
    bytes.iter().map(|&byte| if byte.is_ascii() { byte as char } else { '?' }).collect()
}
