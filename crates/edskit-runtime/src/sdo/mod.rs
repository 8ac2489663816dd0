//! SDO server: expedited, segmented and block transfer (CiA 301 v4.2, 7.2.4).

#[cfg_attr(not(feature = "block-transfer"), path = "../off/block_download.rs")]
mod block_download;
#[cfg_attr(not(feature = "block-transfer"), path = "../off/block_upload.rs")]
mod block_upload;
mod download;
#[cfg_attr(not(feature = "further-sdo-servers"), path = "../off/further_servers.rs")]
mod further;
mod item;
mod upload;

use crate::Application;
use crate::context::Context;
use crate::time::Timer;
use crate::{Entry, Frame, Instant, MOST_DATA, Microseconds};
use block_download::BlockDownload;
use block_upload::BlockUpload;
use edskit_types::{AbortCode, CanId, Index, NodeId, SubIndex};
use further::further_servers;
use item::Item;

/// How long a client may be silent during a transfer.
const TIME_OUT: Microseconds = Microseconds::from_milliseconds(1000);
/// The most bytes of an expedited transfer.
const EXPEDITED: usize = 4;
/// How many data bytes a segment has.
const SEGMENT: usize = 7;
/// The bit of a segment's command that alternates.
const TOGGLE: u8 = 0x10;
/// The most segments of a block.
const MOST_SEGMENTS: u8 = 127;
/// In the sequence number of a block's segment: it is the last one of all.
const LAST_SEGMENT: u8 = 0x80;
/// Whether a side knows checksums, in the commands that begin a block transfer.
const BLOCK_CRC: u8 = 4;
/// Command specifier and abort of a transfer.
const ABORT: u8 = 0x80;
/// The bits of a command that name the service.
const COMMAND: u8 = 0xE0;
/// The first server, which every node has.
const DEFAULT: Index = Index::SDO_SERVER;

/// An SDO server with its transfer.
#[derive(Clone, Copy, Debug)]
pub struct SdoServer {
    /// The object that configures it.
    index: Index,
    /// The identifiers of requests and responses; `None` while it is not in use.
    can_ids: Option<(CanId, CanId)>,
    session: Session,
    /// A response for which the queue has had no room yet, or whose time has not come.
    response: Option<Request>,
    /// When it may be sent: runs while the device works on the request.
    held: Timer,
}

impl SdoServer {
    /// A place for a server.
    pub const NEW: Self =
        Self { index: DEFAULT, can_ids: None, session: Session::NONE, response: None, held: Timer::OFF };

    pub(crate) fn takes(&self, can_id: CanId) -> bool {
        self.can_ids.is_some_and(|(request, _)| request == can_id)
    }

    pub(crate) fn deadline(&self, has_room: bool) -> Instant {
        if self.held.is_running() {
            return self.held.deadline();
        }
        if has_room && (self.session.is_sending() || self.response.is_some()) {
            return Instant::default();
        }
        self.session.time_out.deadline()
    }
}

/// What a server is in the middle of.
#[derive(Clone, Copy, Debug)]
struct Session {
    transfer: Transfer,
    /// The value that the transfer is about.
    item: Item,
    /// Runs while a transfer does.
    time_out: Timer,
}

impl Session {
    const NONE: Self = Self { transfer: Transfer::None, item: Item::NONE, time_out: Timer::OFF };

    /// Nothing runs any more.
    fn end(&mut self) {
        self.transfer = Transfer::None;
        self.time_out = Timer::OFF;
    }

    /// Whether it is the server's turn, not the client's.
    fn is_sending(&self) -> bool {
        matches!(&self.transfer, Transfer::BlockUpload(upload) if upload.is_sending())
    }
}

#[derive(Clone, Copy, Debug)]
enum Transfer {
    None,
    Upload { toggle: u8 },
    Download { toggle: u8 },
    BlockUpload(BlockUpload),
    BlockDownload(BlockDownload),
}

/// What comes after a request.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Next {
    /// Another request of the same transfer.
    Request,
    /// Nothing: the transfer is over.
    End,
}

/// What a request leads to: what comes next, or an abort.
type Step = Result<Next, AbortCode>;

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

/// Whether the toggle bit of a command is the one that has to come, and which one comes next.
fn take_toggle(toggle: &mut u8, command: u8) -> Result<(), AbortCode> {
    if command & TOGGLE != *toggle {
        return Err(AbortCode::TOGGLE_BIT);
    }
    *toggle ^= TOGGLE;
    Ok(())
}

impl<A: Application + ?Sized> Context<'_, A> {
    /// Takes the servers from 1200h to 127Fh; the default server works without any object.
    pub(crate) fn configure_servers(&mut self) {
        self.node.servers.fill(SdoServer::NEW);
        let first = [DEFAULT].into_iter();
        let others = further_servers(self.node.objects.table);
        for (server, index) in self.node.servers.iter_mut().zip(first.chain(others)) {
            server.index = index;
        }
        for place in 0..self.node.servers.len() {
            if let Some(index) = self.node.servers.get(place).map(|server| server.index)
                && (place == 0 || index != DEFAULT)
            {
                self.configure_server(index);
            }
        }
    }

    /// What follows from the parameters of a server: with other identifiers, its transfer ends without a word.
    pub(crate) fn configure_server(&mut self, index: Index) {
        let can_ids = if index == DEFAULT {
            self.node.core.node_id.and_then(default_can_ids)
        } else {
            self.can_ids(index)
        };
        let Some(number) = self.node.servers.iter().position(|server| server.index == index) else { return };
        if self.node.servers.get(number).is_some_and(|server| server.can_ids != can_ids) {
            self.end_transfer(number);
        }
        if let Some(server) = self.node.servers.get_mut(number) {
            server.can_ids = can_ids;
        }
    }

    /// A frame for a server.
    pub(crate) fn sdo_request(&mut self, number: usize, frame: &Frame) {
        let (true, Some(request)) = (self.node.is_communicating(), frame.eight()) else { return };
        let Some(server) = self.node.servers.get(number) else { return };
        if server.held.is_running() {
            return;
        }
        let mut session = server.session;
        // What another call has left is not about this request.
        self.node.core.answer_delay = Microseconds(0);
        let step = self.answer_request(number, &mut session, &request);
        self.settle(number, session, step);
    }

    fn answer_request(&mut self, number: usize, session: &mut Session, request: &Request) -> Step {
        let [command, ..] = *request;
        // The low bits of an abort are reserved, but in a block they number a segment.
        let is_segment =
            matches!(&session.transfer, Transfer::BlockDownload(download) if download.is_in_block());
        if command == ABORT || (command & COMMAND == ABORT && !is_segment) {
            self.break_off(session);
            return Ok(Next::End);
        }
        let Session { item, transfer, .. } = session;
        match (command & COMMAND, transfer) {
            // In a block of a download the first byte is a sequence number and not a command.
            (_, Transfer::BlockDownload(download)) if is_segment => {
                self.block_download_segment(number, item, download, request)
            }
            (0x00, Transfer::Download { toggle }) => self.download_segment(number, item, toggle, request),
            (0x60, Transfer::Upload { toggle }) => self.upload_segment(number, item, toggle, command),
            (0xA0, Transfer::BlockUpload(upload)) if command & 3 != 0 => {
                self.block_upload_request(number, item, upload, request)
            }
            (0xC0, Transfer::BlockDownload(download)) if command & 1 == 1 => {
                self.end_block_download(number, item, download, request)
            }
            _ => {
                self.break_off(session);
                session.transfer = Transfer::None;
                (session.item.entry.index, session.item.entry.sub_index) = place_of(request);
                self.begin_transfer(number, session, request)
            }
        }
    }

    /// A request that does not belong to a running transfer: it begins one, and ends the one that runs without a word.
    fn begin_transfer(&mut self, number: usize, session: &mut Session, request: &Request) -> Step {
        let [command, ..] = *request;
        let has_blocks = self.node.core.settings.has_block_transfer;
        match command & COMMAND {
            0x20 => self.begin_download(number, session, request),
            0x40 => self.begin_upload(number, session),
            0xA0 if command & 3 == 0 && has_blocks => self.begin_block_upload(number, session, request),
            0xC0 if command & 1 == 0 && has_blocks => self.begin_block_download(number, session, request),
            _ => Err(AbortCode::UNKNOWN_COMMAND),
        }
    }

    /// Goes on with what a request has led to: the transfer goes on or ends, or is aborted.
    fn settle(&mut self, number: usize, mut session: Session, step: Step) {
        if let Err(code) = step {
            self.break_off(&session);
            let Entry { index, sub_index, .. } = session.item.entry;
            let code = self.app.abort_code(code, index, sub_index);
            self.answer_about(number, ABORT, &session.item, code.0.to_le_bytes());
        }
        let Some(server) = self.node.servers.get_mut(number) else { return };
        if step == Ok(Next::Request) {
            session.time_out = Timer::after(self.node.now, TIME_OUT);
            server.session = session;
        } else {
            server.session.end();
        }
    }

    /// Sends a response, as soon as the queue has room. One that a client no longer waits for, having asked again, is lost.
    fn respond(&mut self, number: usize, data: Request) {
        let Some(server) = self.node.servers.get_mut(number) else { return };
        if server.response.replace(data).is_some() {
            self.node.core.queue.note_loss();
        }
        server.held = Timer::after(self.node.now, core::mem::take(&mut self.node.core.answer_delay));
        self.send_response(number);
    }

    fn send_response(&mut self, number: usize) {
        let Some(server) = self.node.servers.get_mut(number) else { return };
        if self.node.core.queue.room() == 0 || server.held.is_running() && !server.held.is_due(self.node.now)
        {
            return;
        }
        server.held = Timer::OFF;
        if let (Some(data), Some((_, can_id))) = (server.response.take(), server.can_ids) {
            self.node.core.queue.send(can_id, &data);
        }
    }

    /// Answers with a message that names the value and holds four more bytes.
    #[inline(never)]
    fn answer_about(&mut self, number: usize, command: u8, item: &Item, data: [u8; 4]) {
        let [low, high] = item.entry.index.0.to_le_bytes();
        let [a, b, c, d] = data;
        self.respond(number, [command, low, high, item.entry.sub_index.0, a, b, c, d]);
    }

    /// Sends what is left of responses and blocks, and ends transfers whose client is silent.
    pub(crate) fn poll_servers(&mut self) {
        for number in 0..self.node.servers.len() {
            self.send_response(number);
            let Some(server) = self.node.servers.get(number) else { continue };
            let is_late = server.session.time_out.is_due(self.node.now);
            if !is_late && !server.session.is_sending() {
                continue;
            }
            let mut session = server.session;
            let step = match &mut session.transfer {
                Transfer::BlockUpload(upload) if !is_late => self.send_block(number, &session.item, upload),
                _ => Err(AbortCode::TIME_OUT),
            };
            self.settle(number, session, step);
        }
    }

    /// All transfers end without a word: the node stops, or is reset.
    pub(crate) fn end_transfers(&mut self) {
        for number in 0..self.node.servers.len() {
            self.end_transfer(number);
        }
    }

    fn end_transfer(&mut self, number: usize) {
        let Some(server) = self.node.servers.get_mut(number) else { return };
        let session = core::mem::replace(&mut server.session, Session::NONE);
        server.response = None;
        server.held = Timer::OFF;
        self.break_off(&session);
    }

    /// A transfer ends before its time: the application is told where it has got a part of a DOMAIN.
    fn break_off(&mut self, session: &Session) {
        let is_download = matches!(session.transfer, Transfer::Download { .. } | Transfer::BlockDownload(_));
        if is_download && session.item.is_domain() {
            self.app.domain_broken_off(&mut self.node, &session.item.entry, session.item.offset);
        }
    }
}

/// The identifiers of the default server: 600h and 580h with the node-ID.
fn default_can_ids(node_id: NodeId) -> Option<(CanId, CanId)> {
    let with_node_id = |base: u16| CanId::standard(base + u16::from(node_id.get()));
    Some((with_node_id(0x600)?, with_node_id(0x580)?))
}
