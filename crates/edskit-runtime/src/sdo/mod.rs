//! SDO server: expedited, segmented and block transfer (CiA 301 v4.2, 7.2.4).

mod block_download;
mod block_upload;
mod download;
mod upload;

use crate::context::Context;
use crate::time::Timer;
use crate::{Frame, Instant, MOST_DATA, Microseconds};
use block_download::BlockDownload;
use block_upload::BlockUpload;
use core::ops::Range;
use download::Download;
use edskit_types::{AbortCode, CanId, CobId, Index, NmtState, NodeId, SubIndex};
use upload::Upload;

/// How long a client may be silent during a transfer.
const TIME_OUT: Microseconds = Microseconds::from_milliseconds(1000);
/// How many data bytes a segment has.
const SEGMENT: usize = 7;
/// Command specifier and abort of a transfer.
const ABORT: u8 = 0x80;
/// The bits of a command that name the service.
const COMMAND: u8 = 0xE0;
/// The first server, which every node has.
const DEFAULT: Index = Index::SDO_SERVER;
const REQUEST: u8 = 1;
const RESPONSE: u8 = 2;

/// An SDO server with its transfer.
#[derive(Clone, Copy, Debug)]
pub struct SdoServer {
    /// The object that configures it.
    index: Index,
    /// The identifiers of requests and responses; `None` while it is not in use.
    can_ids: Option<(CanId, CanId)>,
    transfer: Transfer,
    /// Runs while a transfer does.
    time_out: Timer,
}

impl SdoServer {
    /// A place for a server.
    pub const NEW: Self =
        Self { index: DEFAULT, can_ids: None, transfer: Transfer::None, time_out: Timer::OFF };

    pub(crate) fn takes(&self, can_id: CanId) -> bool {
        self.can_ids.is_some_and(|(request, _)| request == can_id)
    }

    pub(crate) fn deadline(&self, has_room: bool) -> Instant {
        match self.transfer {
            Transfer::BlockUpload(upload) if upload.is_sending() && has_room => Instant::default(),
            _ => self.time_out.deadline(),
        }
    }
}

/// What a server is in the middle of.
#[derive(Clone, Copy, Debug)]
enum Transfer {
    None,
    Upload(Upload),
    Download(Download),
    BlockUpload(BlockUpload),
    BlockDownload(BlockDownload),
}

/// Why a request is not answered as hoped: the abort code and the place that the abort message names.
#[derive(Clone, Copy, Debug)]
struct Refusal {
    code: AbortCode,
    index: Index,
    sub_index: SubIndex,
}

/// What a request leads to.
type Outcome = Result<Transfer, Refusal>;

/// The eight bytes of a request.
type Request = [u8; MOST_DATA];

/// The place in the dictionary that a request names.
fn place_of(request: &Request) -> (Index, SubIndex) {
    let [_, low, high, sub_index, ..] = *request;
    (Index(u16::from_le_bytes([low, high])), SubIndex(sub_index))
}

/// The number in the last four bytes of a request.
fn number_of(request: &Request) -> u32 {
    let [_, _, _, _, a, b, c, d] = *request;
    u32::from_le_bytes([a, b, c, d])
}

/// A message that names a place and holds four more bytes.
fn message(command: u8, index: Index, sub_index: SubIndex, data: [u8; 4]) -> Request {
    let [low, high] = index.0.to_le_bytes();
    let [a, b, c, d] = data;
    [command, low, high, sub_index.0, a, b, c, d]
}

impl Context<'_> {
    /// Takes the servers from 1200h to 127Fh; the default server works without any object.
    pub(crate) fn configure_servers(&mut self) {
        self.servers.fill(SdoServer::NEW);
        let first = [DEFAULT].into_iter();
        let table = self.objects.table;
        let others = table.entries_from(Index(DEFAULT.0 + 1));
        let others = others.take_while(|(_, entry)| entry.index.0 < Index::SDO_CLIENT.0);
        let others = others.filter(|(_, entry)| entry.sub_index.0 == REQUEST).map(|(_, entry)| entry.index);
        for (server, index) in self.servers.iter_mut().zip(first.chain(others)) {
            server.index = index;
        }
        for place in 0..self.servers.len() {
            if let Some(index) = self.servers.get(place).map(|server| server.index)
                && (place == 0 || index != DEFAULT)
            {
                self.configure_server(index);
            }
        }
    }

    /// The parameters of a server have been written.
    pub(crate) fn configure_server(&mut self, index: Index) {
        let can_ids =
            if index == DEFAULT { self.core.node_id.and_then(default_can_ids) } else { self.can_ids(index) };
        if let Some(server) = self.servers.iter_mut().find(|server| server.index == index) {
            if server.can_ids != can_ids {
                server.transfer = Transfer::None;
                server.time_out = Timer::OFF;
            }
            server.can_ids = can_ids;
        }
    }

    /// The identifiers that a parameter object names, where both are valid.
    fn can_ids(&self, index: Index) -> Option<(CanId, CanId)> {
        let cob_id =
            |sub_index| self.objects.value(index, sub_index).map(CobId).filter(|cob_id| cob_id.is_valid());
        Some((cob_id(REQUEST)?.can_id(), cob_id(RESPONSE)?.can_id()))
    }

    /// A parameter of a server is about to be written. A valid identifier has to be made invalid before it can change.
    pub(crate) fn check_server(
        &self,
        index: Index,
        sub_index: SubIndex,
        new: CobId,
    ) -> Result<(), AbortCode> {
        if ![REQUEST, RESPONSE].contains(&sub_index.0) {
            return Ok(());
        }
        // The identifiers of other nodes' default SDOs are what further channels are made of, although 7.3.5 restricts them.
        let is_default_sdo = matches!(new.can_id().raw(), 0x581..=0x5FF | 0x601..=0x67F);
        self.check_cob_id(if is_default_sdo { CobId(new.0 | CobId::BIT_31) } else { new })?;
        let old: u32 = self.objects.value(index, sub_index.0).unwrap_or(CobId::BIT_31);
        let old = CobId(old);
        if old.is_valid() && new.is_valid() && old.can_id() != new.can_id() {
            return Err(AbortCode::INVALID_VALUE);
        }
        Ok(())
    }

    /// A frame for a server.
    pub(crate) fn sdo_request(&mut self, number: usize, frame: &Frame) {
        let (true, Some(request)) = (self.is_communicating(), frame.eight()) else { return };
        let Some(transfer) = self.servers.get(number).map(|server| server.transfer) else { return };
        let [command, ..] = request;
        let outcome = if command == ABORT {
            Ok(Transfer::None)
        } else {
            self.answer_request(number, transfer, &request)
        };
        self.settle(number, outcome);
    }

    fn answer_request(&mut self, number: usize, transfer: Transfer, request: &Request) -> Outcome {
        let [command, ..] = *request;
        // In a block of a download the first byte is a sequence number and not a command.
        if let Transfer::BlockDownload(download) = transfer
            && download.is_in_block()
        {
            return self.block_download_segment(number, download, request);
        }
        match (command & COMMAND, transfer) {
            (0x20, _) => self.begin_download(number, request),
            (0x40, _) => self.begin_upload(number, request),
            (0x00, Transfer::Download(download)) => self.download_segment(number, download, request),
            (0x60, Transfer::Upload(upload)) => self.upload_segment(number, upload, command),
            (0xA0, Transfer::BlockUpload(upload)) if command & 3 != 0 => {
                self.block_upload_request(number, upload, request)
            }
            (0xA0, _) if command & 3 == 0 => self.begin_block_upload(number, request),
            (0xC0, Transfer::BlockDownload(download)) if command & 1 == 1 => {
                self.end_block_download(number, download, request)
            }
            (0xC0, _) if command & 1 == 0 => self.begin_block_download(number, request),
            _ => {
                let (index, sub_index) = place_of(request);
                Err(Refusal { code: AbortCode::UNKNOWN_COMMAND, index, sub_index })
            }
        }
    }

    /// Goes on with what a request has led to: another transfer or none, or an abort message.
    fn settle(&mut self, number: usize, outcome: Outcome) {
        let transfer = match outcome {
            Ok(transfer) => transfer,
            Err(refusal) => {
                self.refuse(number, refusal);
                Transfer::None
            }
        };
        let now = self.now;
        if let Some(server) = self.servers.get_mut(number) {
            server.transfer = transfer;
            server.time_out = match transfer {
                Transfer::None => Timer::OFF,
                _ => Timer::after(now, TIME_OUT),
            };
        }
    }

    fn refuse(&mut self, number: usize, refusal: Refusal) {
        let Refusal { code, index, sub_index } = refusal;
        let code = self.app.abort_code(code, index, sub_index);
        self.respond(number, message(ABORT, index, sub_index, code.0.to_le_bytes()));
    }

    fn respond(&mut self, number: usize, data: Request) {
        if let Some((_, response)) = self.servers.get(number).and_then(|server| server.can_ids) {
            self.core.queue.push(Frame::new(response, &data));
        }
    }

    /// Sends what is left of blocks, and ends transfers whose client is silent.
    pub(crate) fn poll_servers(&mut self) {
        for number in 0..self.servers.len() {
            let Some(server) = self.servers.get(number).copied() else { continue };
            let index_of = |transfer: Transfer| match transfer {
                Transfer::None => None,
                Transfer::Upload(upload) => Some(upload.place()),
                Transfer::Download(download) => Some(download.place()),
                Transfer::BlockUpload(upload) => Some(upload.place()),
                Transfer::BlockDownload(download) => Some(download.place()),
            };
            if server.time_out.is_due(self.now) {
                if let Some((index, sub_index)) = index_of(server.transfer) {
                    self.settle(number, Err(Refusal { code: AbortCode::TIME_OUT, index, sub_index }));
                }
            } else if let Transfer::BlockUpload(upload) = server.transfer
                && upload.is_sending()
            {
                let outcome = self.send_block(number, upload);
                self.settle(number, outcome);
            }
        }
    }

    /// The state stopped is entered: transfers end without a word.
    pub(crate) fn stop_transfers(&mut self) {
        debug_assert_eq!(self.core.state, NmtState::Stopped);
        for server in self.servers.iter_mut() {
            server.transfer = Transfer::None;
            server.time_out = Timer::OFF;
        }
    }

    /// Where in the buffers the part of a server lies: all parts are equal.
    fn share(&self, number: usize) -> Range<usize> {
        let size = self.buffers.len().checked_div(self.servers.len()).unwrap_or(0);
        number * size..(number + 1) * size
    }

    /// The part of the buffers that belongs to a server.
    fn buffer(&mut self, number: usize) -> &mut [u8] {
        let share = self.share(number);
        self.buffers.get_mut(share).unwrap_or_default()
    }
}

/// The identifiers of the default server: 600h and 580h with the node-ID.
fn default_can_ids(node_id: NodeId) -> Option<(CanId, CanId)> {
    let with_node_id = |base: u16| CanId::standard(base + u16::from(node_id.get()));
    Some((with_node_id(0x600)?, with_node_id(0x580)?))
}
