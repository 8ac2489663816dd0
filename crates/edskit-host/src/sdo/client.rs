//! Transfers over a bus, from beginning to end.

use super::{SdoChannel, SdoError, SdoMode, SdoOptions, SdoValue, Transfer};
use crate::{Bus, SendError};
use edskit_runtime::{Instant, Microseconds};
use edskit_types::{Index, NodeId, SubIndex};

/// How long to wait where the bus has no room.
const PAUSE: Microseconds = Microseconds(1_000);

/// Reads and writes the object dictionary of a node, and waits for the answer. Frames that belong to others are taken from
/// the bus and dropped; who wants them drives a [`Transfer`] by hand.
///
/// ```no_run
/// use edskit_host::sdo::SdoClient;
/// use edskit_types::{Index, NodeId, SubIndex};
///
/// let mut bus = edskit_host::open(&"socketcand:127.0.0.1:29536/can0".parse()?)?;
/// let client = SdoClient::new(NodeId::new(5)?);
/// let device_type = client.read(&mut bus, Index::DEVICE_TYPE, SubIndex(0))?;
/// client.write(&mut bus, Index::PRODUCER_HEARTBEAT, SubIndex(0), &500_u16.to_le_bytes())?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct SdoClient {
    /// Where the server is.
    pub channel: SdoChannel,
    /// How transfers go.
    pub options: SdoOptions,
}

impl SdoClient {
    /// A client of the default channel of a node, with the usual options.
    #[must_use]
    pub fn new(node: NodeId) -> Self {
        Self { channel: SdoChannel::of_node(node), options: SdoOptions::default() }
    }

    /// The same with this kind of transfer.
    #[must_use]
    pub fn mode(mut self, mode: SdoMode) -> Self {
        self.options.mode = mode;
        self
    }

    /// The same with this time-out.
    #[must_use]
    pub fn time_out(mut self, time_out: Microseconds) -> Self {
        self.options.time_out = time_out;
        self
    }

    /// Reads an entry: its bytes as they come, low byte first for numbers, and whether the server has said their number.
    ///
    /// # Errors
    ///
    /// What the server has against it, or what keeps the transfer from going through.
    pub fn read(
        &self,
        bus: &mut (impl Bus + ?Sized),
        index: Index,
        sub_index: SubIndex,
    ) -> Result<SdoValue, SdoError> {
        let transfer = Transfer::read(self.channel, index, sub_index, self.options, bus.now());
        drive(transfer, bus)
    }

    /// Writes an entry.
    ///
    /// # Errors
    ///
    /// As [`read`](Self::read).
    pub fn write(
        &self,
        bus: &mut (impl Bus + ?Sized),
        index: Index,
        sub_index: SubIndex,
        data: &[u8],
    ) -> Result<(), SdoError> {
        let transfer = Transfer::write(self.channel, index, sub_index, data, self.options, bus.now());
        drive(transfer, bus).map(|_| ())
    }
}

fn drive(mut transfer: Transfer, bus: &mut (impl Bus + ?Sized)) -> Result<SdoValue, SdoError> {
    let start = bus.now();
    loop {
        let mut pause = Instant::NEVER;
        // One frame at a time: the server may have something to say before a block is out.
        let is_sent = match transfer.pending().map(|frame| bus.send(&frame)) {
            None => false,
            Some(Err(SendError::Full)) if !transfer.has_ended() => {
                pause = bus.now() + PAUSE;
                false
            }
            // Once the result is known, nobody needs to hear of a last word that cannot be said.
            Some(Err(error)) if !transfer.has_ended() => return Err(error.into()),
            Some(_) => {
                transfer.sent(bus.now());
                true
            }
        };
        if transfer.pending().is_none()
            && let Some(result) = transfer.result()
        {
            return result;
        }
        match bus.receive()? {
            // What was there before the first request cannot be an answer.
            Some(received) if received.time < start => {}
            Some(received) => transfer.receive(bus.now(), &received.frame),
            None if is_sent => {}
            None => bus.wait(transfer.next_deadline().min(pause))?,
        }
        transfer.poll(bus.now());
    }
}
