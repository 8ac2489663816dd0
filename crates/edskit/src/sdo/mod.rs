//! `edskit sdo`: one entry of a node's object dictionary.

mod place;
mod reasons;
mod silence;

use crate::cli::{
    ReadFormat, SdoArguments, SdoCommand, SdoPlaceArguments, SdoReadArguments, SdoWriteArguments,
};
use crate::files::unreadable;
use crate::live::{KnownDevice, attach};
use crate::value::{self, ValueType};
use crate::{Exit, Streams};
use edskit_host::Bus;
use edskit_host::sdo::{SdoClient, SdoError};
use edskit_types::{DataType, Index, SubIndex};
use reasons::{Request, reasons};
use serde::Serialize;
use std::fs;
use std::io;

pub(crate) fn run(arguments: &SdoArguments, streams: &mut Streams) -> io::Result<Exit> {
    match &arguments.command {
        SdoCommand::Read(arguments) => read(arguments, streams),
        SdoCommand::Write(arguments) => write(arguments, streams),
    }
}

/// What is asked for, with what the EDS says about it.
struct Target<'a> {
    arguments: &'a SdoPlaceArguments,
    device: Option<KnownDevice>,
    index: Index,
    sub_index: SubIndex,
    /// The name of the entry, where the EDS has one.
    name: Option<String>,
    /// The type that was given, or that of the EDS.
    data_type: Option<DataType>,
}

impl<'a> Target<'a> {
    fn find(arguments: &'a SdoPlaceArguments) -> Result<Self, String> {
        let device = arguments.eds.as_deref().map(KnownDevice::read).transpose()?;
        let (index, sub_index) = place::find(&arguments.place, device.as_ref())?;
        let entry = device.as_ref().and_then(|device| device.entry(index, sub_index));
        let data_type = arguments.value_type.map(|ValueType(data_type)| data_type);
        let data_type = data_type.or_else(|| entry?.data_type());
        let name = device.as_ref().and_then(|device| device.name(index, sub_index));
        Ok(Self { arguments, device, index, sub_index, name, data_type })
    }

    fn client(&self) -> SdoClient {
        let connection = &self.arguments.connection;
        let client = SdoClient::new(self.arguments.node).time_out(connection.timeout);
        client.mode(self.arguments.transfer.mode())
    }

    /// `1018h:01h Identity object/Vendor-ID`
    fn heading(&self) -> String {
        let place = format!("{}:{}", self.index, self.sub_index);
        self.name.as_ref().map_or_else(|| place.clone(), |name| format!("{place} {name}"))
    }

    /// Says why it did not work.
    fn complain(&self, error: &SdoError, written: Option<&[u8]>, streams: &mut Streams) -> Exit {
        let Target { arguments, index, sub_index, .. } = *self;
        let what = if written.is_some() { "write" } else { "read" };
        let message = match error {
            SdoError::Aborted(code) => format!("the node answers {code}"),
            SdoError::TimedOut { .. } => {
                let milliseconds = arguments.connection.timeout.0 / 1_000;
                error.to_string().replacen("in time", &format!("within {milliseconds} ms"), 1)
            }
            _ => error.to_string(),
        };
        let heading = self.heading();
        streams.complain(format_args!("node {}: cannot {what} {heading}: {message}", arguments.node));
        let request = Request {
            node: arguments.node,
            device: self.device.as_ref(),
            index,
            sub_index,
            written,
            data_type: self.data_type,
            transfer: arguments.transfer,
        };
        for reason in reasons(&request, error) {
            // As `complain`: nothing is left to tell it to where even the error stream is gone.
            let _ = writeln!(streams.stderr, "  {reason}");
        }
        Exit::Failed
    }
}

/// What was read, as JSON.
#[derive(Serialize)]
struct Report<'a> {
    node_id: u8,
    index: u16,
    sub_index: u8,
    name: Option<&'a str>,
    data_type: Option<&'static str>,
    /// Hexadecimal digits, as they come.
    bytes: String,
    /// Whether the node has said how many bytes there are; else the data type says it, where it can.
    length_said: bool,
    /// By the data type, where it is known.
    value: Option<serde_json::Value>,
}

fn read(arguments: &SdoReadArguments, streams: &mut Streams) -> io::Result<Exit> {
    let target = Target::find(&arguments.place).map_err(io::Error::other)?;
    let mut bus = attach(&arguments.place.connection.bus).map_err(io::Error::other)?;
    read_over(&mut *bus, &target, arguments, streams)
}

fn read_over(
    bus: &mut dyn Bus,
    target: &Target<'_>,
    arguments: &SdoReadArguments,
    streams: &mut Streams,
) -> io::Result<Exit> {
    let value = match target.client().read(bus, target.index, target.sub_index) {
        Ok(value) => value,
        Err(error) => return Ok(target.complain(&error, None, streams)),
    };
    let bytes = value::counted(target.data_type, &value);
    if let Some(path) = &arguments.file {
        fs::write(path, bytes).map_err(|error| failed_on(path, &error))?;
        let (heading, path) = (target.heading(), path.display());
        write!(streams.stdout, "{heading}: {} bytes written to {path}", bytes.len())?;
        let is_settled = value::is_settled(target.data_type, &value);
        writeln!(streams.stdout, "{}", if is_settled { "" } else { value::NOT_SAID })?;
    } else {
        match arguments.format {
            ReadFormat::Text => {
                writeln!(streams.stdout, "{}: {}", target.heading(), value::said(target.data_type, &value))?;
            }
            ReadFormat::Json => {
                let report = Report {
                    node_id: arguments.place.node.get(),
                    index: target.index.0,
                    sub_index: target.sub_index.0,
                    name: target.name.as_deref(),
                    data_type: target.data_type.map(DataType::name),
                    bytes: value::digits(bytes),
                    length_said: value.is_length_said(),
                    value: target.data_type.map(|kind| value::json(kind, bytes)),
                };
                serde_json::to_writer_pretty(&mut streams.stdout, &report)?;
                writeln!(streams.stdout)?;
            }
        }
    }
    streams.stdout.flush()?;
    Ok(Exit::Clean)
}

fn write(arguments: &SdoWriteArguments, streams: &mut Streams) -> io::Result<Exit> {
    let target = Target::find(&arguments.place).map_err(io::Error::other)?;
    let bytes = match (&arguments.file, &arguments.value) {
        (Some(path), _) => {
            fs::read(path).map_err(|error| io::Error::other(unreadable(&path.to_string_lossy(), &error)))?
        }
        (None, text) => {
            let text = text.as_deref().unwrap_or_default();
            let data_type = target.data_type.ok_or_else(|| io::Error::other(untyped(&target)))?;
            value::bytes_of(data_type, text, arguments.place.node)
                .map_err(|reason| io::Error::other(format!("{}: {reason}", target.heading())))?
        }
    };
    let mut bus = attach(&arguments.place.connection.bus).map_err(io::Error::other)?;
    write_over(&mut *bus, &target, arguments, &bytes, streams)
}

fn write_over(
    bus: &mut dyn Bus,
    target: &Target<'_>,
    arguments: &SdoWriteArguments,
    bytes: &[u8],
    streams: &mut Streams,
) -> io::Result<Exit> {
    if let Err(error) = target.client().write(bus, target.index, target.sub_index, bytes) {
        return Ok(target.complain(&error, Some(bytes), streams));
    }
    let shown = match (&arguments.file, target.data_type) {
        (Some(path), _) => format!("{} bytes of {}", bytes.len(), path.display()),
        (None, Some(data_type)) => value::text(data_type, bytes),
        (None, None) => value::untyped(bytes),
    };
    writeln!(streams.stdout, "{} = {shown}", target.heading())?;
    streams.stdout.flush()?;
    Ok(Exit::Clean)
}

/// Why the bytes of a value are not known.
fn untyped(target: &Target<'_>) -> String {
    let heading = target.heading();
    match &target.device {
        None => {
            format!(
                "{heading}: the type of the value is not known; give it with --type (u16, string, hex), or --eds"
            )
        }
        Some(device) if target.name.is_none() => {
            format!("{}: there is no {heading}; give the type of the value with --type", device.file)
        }
        Some(device) => {
            format!("{}: {heading} has no data type of CiA 301; give one with --type", device.file)
        }
    }
}

fn failed_on(path: &std::path::Path, error: &io::Error) -> io::Error {
    io::Error::other(format!("{}: {error}", path.display()))
}

#[cfg(test)]
mod tests;
