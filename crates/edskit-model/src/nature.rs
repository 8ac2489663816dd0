//! What a file is, from its first bytes: an EDS, or something else with the same ending.

use crate::own_file::OwnFile;

/// What the bytes of a file look like.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Nature {
    /// Text that may be a CANopen file.
    Text,
    /// Nothing, or only blanks.
    Empty,
    /// UTF-16 text with or without a byte order mark.
    Utf16,
    /// An archive (zip), such as an EDS package.
    Zip,
    /// A gzip file.
    Gzip,
    /// A PDF document.
    Pdf,
    /// XML: a CiA 311 device description (XDD, XDC) where `canopen` is set.
    Xml {
        /// Whether the document speaks of CANopen or ISO 15745 profiles.
        canopen: bool,
    },
    /// An HTML page, as a failed download leaves it.
    Html,
    /// An EDS of EtherNet/IP, DeviceNet or another network of ODVA.
    EthernetIp,
    /// JSON.
    Json,
    /// A file of edskit itself, which another command takes.
    Own(OwnFile),
    /// Bytes that are no text.
    Binary,
}

/// How many bytes are looked at.
const WINDOW: usize = 4096;

impl Nature {
    /// What `bytes` look like.
    ///
    /// ```
    /// use edskit_model::nature::Nature;
    /// assert_eq!(Nature::of(b"PK\x03\x04rest"), Nature::Zip);
    /// assert_eq!(Nature::of(b"[FileInfo]\n"), Nature::Text);
    /// ```
    pub fn of(bytes: &[u8]) -> Self {
        let head = &bytes[..bytes.len().min(WINDOW)];
        if head.starts_with(b"PK\x03\x04") || head.starts_with(b"PK\x05\x06") {
            return Self::Zip;
        }
        if head.starts_with(b"\x1F\x8B") {
            return Self::Gzip;
        }
        if head.starts_with(b"%PDF") {
            return Self::Pdf;
        }
        if head.starts_with(b"\xFF\xFE") || head.starts_with(b"\xFE\xFF") || is_bare_utf16(head) {
            return Self::Utf16;
        }
        let text = head.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(head).trim_ascii_start();
        if text.is_empty() {
            return if bytes.trim_ascii().is_empty() { Self::Empty } else { Self::Text };
        }
        if has_prefix(text, b"<!doctype html") || has_prefix(text, b"<html") {
            return Self::Html;
        }
        if text.starts_with(b"<?xml") || text.starts_with(b"<!--") || text.starts_with(b"<ISO15745") {
            return Self::Xml { canopen: contains(text, b"ISO15745") || contains(text, b"CANopen") };
        }
        if let Some(own) = OwnFile::of(bytes) {
            return Self::Own(own);
        }
        if text.starts_with(b"{") {
            return Self::Json;
        }
        if is_binary(head) {
            return Self::Binary;
        }
        if is_ethernet_ip(bytes) {
            return Self::EthernetIp;
        }
        Self::Text
    }
}

/// ASCII characters with a zero byte beside each: UTF-16 without a byte order mark.
fn is_bare_utf16(head: &[u8]) -> bool {
    let pairs = head.len() / 2;
    if pairs < 4 {
        return false;
    }
    let zeros = |parity: usize| head.iter().skip(parity).step_by(2).filter(|&&byte| byte == 0).count();
    let (even, odd) = (zeros(0), zeros(1));
    (odd * 10 > pairs * 9 && even * 10 < pairs) || (even * 10 > pairs * 9 && odd * 10 < pairs)
}

/// More than one byte in ten that no text file holds.
fn is_binary(head: &[u8]) -> bool {
    let odd = |&&byte: &&u8| byte < 0x20 && !matches!(byte, b'\t' | b'\n' | b'\r' | 0x0C | 0x1A);
    head.iter().filter(odd).count() * 10 > head.len()
}

/// Sections that every ODVA electronic data sheet has and CiA 306 does not know.
fn is_ethernet_ip(bytes: &[u8]) -> bool {
    let mut file = false;
    let mut device = false;
    let headers = bytes.split(|&byte| byte == b'\n').map(|line| line.trim_ascii());
    for header in headers.filter(|line| line.first() == Some(&b'[')) {
        let is = |name: &[u8]| header.len() >= name.len() && header[..name.len()].eq_ignore_ascii_case(name);
        if is(b"[FileInfo]") || is(b"[DeviceInfo]") || is(b"[MandatoryObjects]") {
            return false;
        }
        file |= is(b"[File]");
        device |= is(b"[Device]");
    }
    file && device
}

fn has_prefix(text: &[u8], prefix: &[u8]) -> bool {
    text.len() >= prefix.len() && text[..prefix.len()].eq_ignore_ascii_case(prefix)
}

fn contains(text: &[u8], word: &[u8]) -> bool {
    text.windows(word.len()).any(|window| window.eq_ignore_ascii_case(word))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_that_are_something_else() {
        let utf16: Vec<u8> = "[FileInfo]\r\n".bytes().flat_map(|byte| [byte, 0]).collect();
        for (bytes, nature) in [
            (&b""[..], Nature::Empty),
            (b" \r\n\t\n", Nature::Empty),
            (b"\xFF\xFE[\0F\0", Nature::Utf16),
            (&utf16, Nature::Utf16),
            (b"PK\x03\x04", Nature::Zip),
            (b"\x1F\x8B\x08", Nature::Gzip),
            (b"%PDF-1.4", Nature::Pdf),
            (b"<?xml version=\"1.0\"?><ISO15745ProfileContainer>", Nature::Xml { canopen: true }),
            (b"<?xml version=\"1.0\"?><a/>", Nature::Xml { canopen: false }),
            (b"<!DOCTYPE html><html>", Nature::Html),
            (b"{\"message\": \"Not Found\"}", Nature::Json),
            (b"$ EZ-EDS\n[File]\nDescText = \"x\";\n[Device]\n", Nature::EthernetIp),
            (b"[gateway]\n427 = 5\n", Nature::Own(OwnFile::Parameters)),
            (b"\x7FELF\x02\x01\x01\0\0\0\0\0\0\0\0\0", Nature::Binary),
        ] {
            assert_eq!(Nature::of(bytes), nature, "{bytes:?}");
        }
    }

    #[test]
    fn files_that_may_be_canopen() {
        for bytes in [
            &b"[FileInfo]\n"[..],
            b"\xEF\xBB\xBF[FileInfo]\n",
            b"FileName=a.eds",
            b"<<<<<<< HEAD\n[FileInfo]",
            b"[DeviceInfo]\nVendorName=M\xFCller\n",
            b"[File]\n[Device]\n[DeviceInfo]\n",
            b"[FileInfo]\nFileName=a.eds\n\x1A\0\0",
            b"hello",
        ] {
            assert_eq!(Nature::of(bytes), Nature::Text, "{bytes:?}");
        }
    }
}
