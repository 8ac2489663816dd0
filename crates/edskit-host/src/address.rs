//! How people name a bus.

use crate::virtual_time;
use std::fmt;
use std::str::FromStr;
use thiserror::Error;

/// Which bus to open.
///
/// ```
/// use edskit_host::Address;
///
/// let address: Address = "socketcand:192.168.1.5:29536/can1".parse().unwrap();
/// assert_eq!(address.to_string(), "socketcand:192.168.1.5:29536/can1");
/// assert_eq!("hub".parse(), Ok(Address::Hub));
/// assert_eq!("virtual".parse(), Ok(Address::Virtual));
///
/// let mistake = "slcan:localhost".parse::<Address>().unwrap_err();
/// assert_eq!(mistake.to_string(), "`slcan:localhost` lacks the port, expected slcan:HOST:PORT, usually port 29537");
/// ```
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Address {
    /// `hub`: a hub in this process, on loopback with the usual ports.
    Hub,
    /// `virtual`: a bus in virtual time that this process makes and others attach to.
    Virtual,
    /// `virtual:HOST:PORT`: a bus in virtual time that another process has made.
    VirtualAt {
        /// A name or an IP address; IPv6 without brackets.
        host: String,
        /// The TCP port, usually 29538.
        port: u16,
    },
    /// `socketcand:HOST:PORT` or `socketcand:HOST:PORT/CHANNEL`: a hub or a socketcand daemon.
    Socketcand {
        /// A name or an IP address; IPv6 without brackets.
        host: String,
        /// The TCP port, usually 29536.
        port: u16,
        /// The interface that the daemon shall open, `can0` unless told otherwise. A hub takes any.
        channel: String,
    },
    /// `slcan:HOST:PORT`: a hub or an SLCAN adapter that speaks TCP.
    Slcan {
        /// A name or an IP address; IPv6 without brackets.
        host: String,
        /// The TCP port, 29537 for a hub.
        port: u16,
    },
    /// `socketcan:INTERFACE`: an interface of the Linux kernel.
    SocketCan {
        /// Its name, up to 15 characters.
        interface: String,
    },
}

/// What is wrong with an address.
#[derive(Clone, PartialEq, Eq, Debug, Error)]
#[non_exhaustive]
pub enum AddressError {
    /// Not one of the kinds of buses.
    #[error(
        "`{0}` names no bus, expected hub, socketcand:HOST:PORT[/CHANNEL], slcan:HOST:PORT, socketcan:INTERFACE, virtual or \
         virtual:HOST:PORT"
    )]
    UnknownKind(String),
    /// Something behind `hub`.
    #[error("`{0}`: hub takes nothing behind it; attach to another hub with slcan:HOST:PORT")]
    HubWithRest(String),
    /// No host.
    #[error("`{0}` lacks the host, expected {1}")]
    NoHost(String, AddressForm),
    /// No port.
    #[error("`{0}` lacks the port, expected {1}, usually port {port}", port = .1.port())]
    NoPort(String, AddressForm),
    /// A port that is none.
    #[error("`{0}`: `{2}` is no port, expected {1} with a port from 1 to 65535")]
    BadPort(String, AddressForm, String),
    /// An IPv6 address without brackets.
    #[error("`{0}`: an IPv6 address needs brackets, as in {kind}:[::1]:{port}", kind = .1.kind(), port = .1.port())]
    NoBrackets(String, AddressForm),
    /// A channel or an interface that cannot be one.
    #[error("`{0}`: `{1}` is no name of an interface, expected 1 to 15 letters, digits, `_`, `-` or `.`")]
    BadInterface(String, String),
    /// A serial line.
    #[error(
        "`{0}`: serial lines are not supported, expected slcan:HOST:PORT; \
         on Linux, slcand makes a SocketCAN interface of a serial line, then socketcan:slcan0 works"
    )]
    SerialLine(String),
}

/// The forms with host and port.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum AddressForm {
    /// `socketcand:HOST:PORT[/CHANNEL]`
    Socketcand,
    /// `slcan:HOST:PORT`
    Slcan,
    /// `virtual:HOST:PORT`
    Virtual,
}

impl AddressForm {
    fn kind(self) -> &'static str {
        match self {
            Self::Socketcand => "socketcand",
            Self::Slcan => "slcan",
            Self::Virtual => "virtual",
        }
    }

    fn port(self) -> u16 {
        match self {
            Self::Socketcand => 29536,
            Self::Slcan => 29537,
            Self::Virtual => virtual_time::USUAL_PORT,
        }
    }
}

impl fmt::Display for AddressForm {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Socketcand => "socketcand:HOST:PORT[/CHANNEL]",
            Self::Slcan => "slcan:HOST:PORT",
            Self::Virtual => "virtual:HOST:PORT",
        })
    }
}

impl FromStr for Address {
    type Err = AddressError;

    fn from_str(text: &str) -> Result<Self, AddressError> {
        let (kind, rest) = text.split_once(':').map_or((text, None), |(kind, rest)| (kind, Some(rest)));
        match (kind, rest) {
            ("hub", None) => Ok(Self::Hub),
            ("hub", Some(_)) => Err(AddressError::HubWithRest(text.to_owned())),
            ("virtual", None) => Ok(Self::Virtual),
            ("virtual", Some(place)) => {
                let (host, port) = host_and_port(text, place, AddressForm::Virtual)?;
                Ok(Self::VirtualAt { host, port })
            }
            ("socketcand", rest) => {
                let rest = rest.unwrap_or_default();
                let (place, channel) = rest.split_once('/').unwrap_or((rest, "can0"));
                let (host, port) = host_and_port(text, place, AddressForm::Socketcand)?;
                Ok(Self::Socketcand { host, port, channel: interface(text, channel)? })
            }
            ("slcan", rest) => {
                let rest = rest.unwrap_or_default();
                if rest.starts_with('/')
                    || rest.to_ascii_uppercase().starts_with("COM") && !rest.contains(':')
                {
                    return Err(AddressError::SerialLine(text.to_owned()));
                }
                let (host, port) = host_and_port(text, rest, AddressForm::Slcan)?;
                Ok(Self::Slcan { host, port })
            }
            ("socketcan", rest) => {
                Ok(Self::SocketCan { interface: interface(text, rest.unwrap_or_default())? })
            }
            _ => Err(AddressError::UnknownKind(text.to_owned())),
        }
    }
}

impl fmt::Display for Address {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Hub => f.write_str("hub"),
            Self::Virtual => f.write_str("virtual"),
            Self::VirtualAt { host, port } => write!(f, "virtual:{}", place(host, *port)),
            Self::Socketcand { host, port, channel } => {
                write!(f, "socketcand:{}/{channel}", place(host, *port))
            }
            Self::Slcan { host, port } => write!(f, "slcan:{}", place(host, *port)),
            Self::SocketCan { interface } => write!(f, "socketcan:{interface}"),
        }
    }
}

/// `HOST:PORT`, with brackets around an IPv6 address.
pub(crate) fn place(host: &str, port: u16) -> String {
    if host.contains(':') { format!("[{host}]:{port}") } else { format!("{host}:{port}") }
}

fn host_and_port(text: &str, place: &str, form: AddressForm) -> Result<(String, u16), AddressError> {
    let no_port = || AddressError::NoPort(text.to_owned(), form);
    let (host, port) = match place.strip_prefix('[') {
        Some(rest) => {
            let (host, behind) = rest.split_once(']').ok_or_else(no_port)?;
            (host, behind.strip_prefix(':').ok_or_else(no_port)?)
        }
        None if place.matches(':').count() > 1 => {
            return Err(AddressError::NoBrackets(text.to_owned(), form));
        }
        None => place.split_once(':').unwrap_or((place, "")),
    };
    if host.is_empty() {
        return Err(AddressError::NoHost(text.to_owned(), form));
    }
    if port.is_empty() {
        return Err(no_port());
    }
    match port.parse() {
        Ok(number) if number > 0 && port.bytes().all(|byte| byte.is_ascii_digit()) => {
            Ok((host.to_owned(), number))
        }
        _ => Err(AddressError::BadPort(text.to_owned(), form, port.to_owned())),
    }
}

/// The rules of the Linux kernel, and nothing that has a meaning in socketcand's commands.
fn interface(text: &str, name: &str) -> Result<String, AddressError> {
    let is_fine = |byte: u8| byte.is_ascii_alphanumeric() || b"_-.".contains(&byte);
    if (1..16).contains(&name.len()) && name.bytes().all(is_fine) && name != "." && name != ".." {
        Ok(name.to_owned())
    } else {
        Err(AddressError::BadInterface(text.to_owned(), name.to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn mistake(text: &str) -> String {
        text.parse::<Address>().unwrap_err().to_string()
    }

    #[test]
    fn all_kinds() {
        let (host, channel) = ("::1".to_owned(), "can0".to_owned());
        assert_eq!("hub".parse(), Ok(Address::Hub));
        assert_eq!("virtual".parse(), Ok(Address::Virtual));
        assert_eq!("virtual:[::1]:9".parse(), Ok(Address::VirtualAt { host: host.clone(), port: 9 }));
        assert_eq!(
            "socketcand:[::1]:7".parse(),
            Ok(Address::Socketcand { host: host.clone(), port: 7, channel })
        );
        assert_eq!("slcan:[::1]:65535".parse(), Ok(Address::Slcan { host, port: 65535 }));
        assert_eq!("socketcan:vcan0".parse(), Ok(Address::SocketCan { interface: "vcan0".to_owned() }));
    }

    #[test]
    fn each_mistake_says_what_is_wrong_and_what_is_expected() {
        let mistakes = [
            ("", "names no bus, expected hub, socketcand:HOST:PORT[/CHANNEL]"),
            ("can0", "`can0` names no bus, expected hub"),
            ("hub:5", "hub takes nothing behind it"),
            ("socketcand", "`socketcand` lacks the host, expected socketcand:HOST:PORT[/CHANNEL]"),
            ("socketcand::29536", "lacks the host"),
            (
                "socketcand:box/can0",
                "lacks the port, expected socketcand:HOST:PORT[/CHANNEL], usually port 29536",
            ),
            (
                "socketcand:box:can0",
                "`can0` is no port, expected socketcand:HOST:PORT[/CHANNEL] with a port from 1",
            ),
            ("slcan:box:0", "`0` is no port"),
            ("virtual:", "`virtual:` lacks the host, expected virtual:HOST:PORT"),
            ("virtual:box", "lacks the port, expected virtual:HOST:PORT, usually port 29538"),
            ("slcan:box:+5", "`+5` is no port"),
            ("slcan:box:65536", "`65536` is no port"),
            ("slcan:::1:5", "needs brackets, as in slcan:[::1]:29537"),
            ("slcan:[::1]", "lacks the port"),
            ("slcan:[::1", "lacks the port"),
            ("slcan:/dev/ttyUSB0@115200", "serial lines are not supported, expected slcan:HOST:PORT"),
            ("slcan:COM3", "serial lines are not supported"),
            ("socketcand:box:5/can 0", "`can 0` is no name of an interface"),
            ("socketcan:", "`` is no name of an interface, expected 1 to 15 letters"),
        ];
        for (text, wanted) in mistakes {
            assert!(mistake(text).contains(wanted), "{text}: {}", mistake(text));
        }
    }

    proptest! {
        #[test]
        fn what_is_shown_can_be_read(
            text in "(hub|virtual|socketcand|slcan|socketcan)(:[a-z\\[\\]:0-9]{0,12}){0,2}:?[0-9]{0,6}(/[a-z]{0,5})?|\\PC*"
        ) {
            if let Ok(address) = text.parse::<Address>() {
                prop_assert_eq!(address.to_string().parse(), Ok(address));
            }
        }
    }
}
