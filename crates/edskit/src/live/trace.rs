//! Recording what goes over a bus into a file.

use edskit_host::{Candump, Pcap, Recorder};
use edskit_runtime::{Frame, Instant};
use std::ffi::OsStr;
use std::fs::File;
use std::io;
use std::path::Path;

/// A file that frames are recorded in. It is not buffered: a record is worth most where its program has ended in a way
/// that nobody has foreseen.
pub(crate) enum TraceFile {
    Candump(Candump<File>),
    Pcap(Pcap<File>),
}

impl TraceFile {
    /// Makes the file; its ending names the format.
    pub(crate) fn create(path: &Path) -> Result<Self, String> {
        let name = path.display();
        let failed = |error: io::Error| format!("{name}: {error}");
        let ending = path.extension().and_then(OsStr::to_str).map(str::to_ascii_lowercase);
        match ending.as_deref() {
            Some("log") => Ok(Self::Candump(Candump::new(File::create(path).map_err(failed)?, "can0"))),
            Some("pcap") => {
                let file = File::create(path).map_err(failed)?;
                Ok(Self::Pcap(Pcap::new(file).map_err(failed)?))
            }
            _ => Err(format!("{name}: a trace is a .log file (candump) or a .pcap file (Wireshark)")),
        }
    }
}

impl Recorder for TraceFile {
    fn record(&mut self, time: Instant, frame: &Frame) -> io::Result<()> {
        match self {
            Self::Candump(recorder) => recorder.record(time, frame),
            Self::Pcap(recorder) => recorder.record(time, frame),
        }
    }
}
