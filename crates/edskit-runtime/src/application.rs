//! What a device adds to CiA 301, and where it differs.

use crate::{
    Commissioning, EmcyError, Emergency, Entry, LssAnswer, LssRequest, Microseconds, Record, Services,
};
use edskit_types::{
    AbortCode, Bitrate, Index, NmtState, NodeId, PdoDirection, SubIndex, Transmission, TransmissionType,
};

/// The device behind a node. Every method has the behaviour of CiA 301 as its default, so a device implements what it
/// adds, and what its manual does differently.
///
/// The methods are called from within [`Node::receive`](crate::Node::receive) and [`Node::poll`](crate::Node::poll) and
/// should return soon. They may read and write the dictionary.
pub trait Application {
    /// An SDO client or a TPDO is about to read an entry: the place to bring its value up to date.
    ///
    /// # Errors
    /// The abort code that an SDO client gets instead of the value; a TPDO carries the value that is there.
    fn before_read(&mut self, node: &mut Services<'_>, entry: &Entry) -> Result<(), AbortCode> {
        let _ = (node, entry);
        Ok(())
    }

    /// An SDO client or an RPDO is about to write an entry; rights, length and limits are checked already. So a rule of the
    /// device holds for both.
    ///
    /// # Errors
    /// The abort code that the client gets, and that [`rpdo_value_refused`](Self::rpdo_value_refused) is told; the value
    /// then stays as it is.
    fn before_write(&mut self, node: &mut Services<'_>, entry: &Entry, data: &[u8]) -> Result<(), AbortCode> {
        let _ = (node, entry, data);
        Ok(())
    }

    /// A number that an SDO client or an RPDO brings to an entry of 1000h to 1FFFh, before any check: what it counts as, low
    /// byte first. The place for a manual that takes some bits of a COB-ID only, say, or rounds a time.
    fn adapt(&mut self, node: &Services<'_>, entry: &Entry, data: &mut [u8]) {
        let _ = (node, entry, data);
    }

    /// An SDO client has written an entry.
    fn after_write(&mut self, node: &mut Services<'_>, entry: &Entry) {
        let _ = (node, entry);
    }

    /// Whether a value that an SDO client or an RPDO writes is an event of the TPDOs that carry it, as the transmission types
    /// 00h, FEh and FFh send them; it is none where the value is the same as before. CiA 301 leaves that open. By default
    /// it is none: the device knows which of its values are events, and says so by
    /// [`Services::changed`].
    fn write_is_event(&mut self, node: &Services<'_>, entry: &Entry) -> bool {
        let _ = (node, entry);
        false
    }

    /// The entry at a place where the dictionary has none, or none in the present configuration: the device may have it
    /// itself. So thousands of forwarded parameters need no entry each, and a sub-index can be a set of bits. Such an entry
    /// is read and written by [`read_value`](Self::read_value) and [`write_value`](Self::write_value); it can be mapped into
    /// PDOs as its flags say, and is not stored by the node.
    ///
    /// # Errors
    /// The abort code that a client gets, `absence` by default: what the dictionary says.
    fn find(
        &mut self,
        node: &mut Services<'_>,
        index: Index,
        sub_index: SubIndex,
        absence: AbortCode,
    ) -> Result<Entry, AbortCode> {
        let _ = (node, index, sub_index);
        Err(absence)
    }

    /// Puts the value of an entry that the device has itself into `buffer`, low byte first, and says how many bytes it has.
    /// The buffer is that of the SDO server, or of a PDO.
    ///
    /// # Errors
    /// The abort code that a client gets, by default [`AbortCode::NO_DATA`]; a PDO carries 0 then.
    fn read_value(
        &mut self,
        node: &mut Services<'_>,
        entry: &Entry,
        buffer: &mut [u8],
    ) -> Result<usize, AbortCode> {
        let _ = (node, entry, buffer);
        Err(AbortCode::NO_DATA)
    }

    /// A client or an RPDO brings a value of the right length to an entry that the device has itself.
    ///
    /// # Errors
    /// The abort code that a client gets, by default [`AbortCode::CANNOT_TRANSFER`].
    fn write_value(&mut self, node: &mut Services<'_>, entry: &Entry, data: &[u8]) -> Result<(), AbortCode> {
        let _ = (node, entry, data);
        Err(AbortCode::CANNOT_TRANSFER)
    }

    /// Whether an SDO client may read an entry that exists.
    ///
    /// # Errors
    /// The abort code that the client gets; by default those of [`Services::check_read`].
    fn check_read(&mut self, node: &Services<'_>, entry: &Entry) -> Result<(), AbortCode> {
        node.check_read(entry)
    }

    /// Whether an SDO client may write so many bytes of an entry that exists; `None` while it has not said how many. The
    /// place for a manual that checks in another order than CiA 301 servers do.
    ///
    /// # Errors
    /// The abort code that the client gets; by default those of [`Objects::check_write`](crate::Objects::check_write).
    fn check_write(
        &mut self,
        node: &Services<'_>,
        entry: &Entry,
        length: Option<usize>,
    ) -> Result<(), AbortCode> {
        node.objects.check_write(entry, length)
    }

    /// Whether an entry with [`Flags::OPTIONAL`](crate::Flags::OPTIONAL) exists in the present configuration.
    fn is_present(&mut self, node: &Services<'_>, entry: &Entry) -> bool {
        let _ = (node, entry);
        true
    }

    /// The abort code for a request that is refused with `code`: the place for a manual that prescribes another one.
    fn abort_code(&mut self, code: AbortCode, index: Index, sub_index: SubIndex) -> AbortCode {
        let _ = (index, sub_index);
        code
    }

    /// How many bytes a DOMAIN has; `None` where that is known only at its end.
    ///
    /// # Errors
    /// The abort code that a client gets who wants to read it; by default [`AbortCode::NO_DATA`].
    fn domain_length(&mut self, node: &mut Services<'_>, entry: &Entry) -> Result<Option<u32>, AbortCode> {
        let _ = (node, entry);
        Err(AbortCode::NO_DATA)
    }

    /// Puts the bytes of a DOMAIN from `offset` on into `buffer` and says how many; fewer than fit only at its end.
    ///
    /// # Errors
    /// The abort code that ends the transfer.
    fn read_domain(
        &mut self,
        node: &mut Services<'_>,
        entry: &Entry,
        offset: u32,
        buffer: &mut [u8],
    ) -> Result<usize, AbortCode> {
        let _ = (node, entry, offset, buffer);
        Err(AbortCode::NO_DATA)
    }

    /// Takes the bytes of a DOMAIN from `offset` on. A transfer begins with `offset` 0, which ends any transfer that was
    /// broken off before; `is_last` says that it is complete and, where the client sent a checksum, right.
    ///
    /// # Errors
    /// The abort code that ends the transfer; by default [`AbortCode::CANNOT_TRANSFER`].
    fn write_domain(
        &mut self,
        node: &mut Services<'_>,
        entry: &Entry,
        offset: u32,
        data: &[u8],
        is_last: bool,
    ) -> Result<(), AbortCode> {
        let _ = (node, entry, offset, data, is_last);
        Err(AbortCode::CANNOT_TRANSFER)
    }

    /// An SDO client has begun to write a DOMAIN, and the transfer has ended before its time after `offset` bytes: by an
    /// abort of either side, a wrong checksum, silence, another request, or a change of the NMT state. What
    /// [`write_domain`](Self::write_domain) has got is not complete.
    fn domain_broken_off(&mut self, node: &mut Services<'_>, entry: &Entry, offset: u32) {
        let _ = (node, entry, offset);
    }

    /// A stored value has no place any more, since an update has changed the dictionary: there is no such entry, it is not
    /// stored now, or it cannot have this value. The last of these is an error of the device too
    /// ([`EmcyError::LOST_PARAMETERS`](crate::EmcyError::LOST_PARAMETERS)), and the entry has its default.
    fn stored_value_dropped(&mut self, node: &mut Services<'_>, index: Index, sub_index: SubIndex) {
        let _ = (node, index, sub_index);
    }

    /// The NMT state has changed.
    fn state_changed(&mut self, node: &mut Services<'_>, from: NmtState, to: NmtState) {
        let _ = (node, from, to);
    }

    /// Node-ID and bit rate that count from now on: asked at power-on and with every reset, before the dictionary gets its
    /// values. `configured` is what LSS has configured, or at power-on what it has stored, or else the settings; a device
    /// that keeps them elsewhere, in switches or objects of its own, says so here. A bit rate other than the configured one
    /// is brought by [`activate_bit_rate`](Self::activate_bit_rate) at once.
    fn commissioning(
        &mut self,
        node: &mut Services<'_>,
        configured: Commissioning,
        reset: Reset,
    ) -> Commissioning {
        let _ = (node, reset);
        configured
    }

    /// An LSS master asks for something: who does it, or whether it is refused. By default the node does everything that
    /// CiA 305 describes.
    fn lss(&mut self, node: &mut Services<'_>, request: LssRequest) -> LssAnswer {
        let _ = (node, request);
        LssAnswer::ByNode
    }

    /// Whether the node goes to operational by itself after it has booted up; `prescribed` is what 1F80h says, or else the
    /// settings.
    fn starts_by_itself(&mut self, node: &mut Services<'_>, prescribed: bool) -> bool {
        let _ = node;
        prescribed
    }

    /// A client has written the signature into a sub-index of 1010h or 1011h: whether the node carries the command out. A
    /// device whose manual wants it otherwise does it here, by [`Services::save`] and [`Services::forget`] say, and returns
    /// false.
    ///
    /// # Errors
    /// The abort code that the client gets.
    fn storage_command(&mut self, node: &mut Services<'_>, entry: &Entry) -> Result<bool, AbortCode> {
        let _ = (node, entry);
        Ok(true)
    }

    /// The memory has failed, or a record in it is torn: at power-on and resets, with 1010h and 1011h, or with LSS.
    fn storage_failed(&mut self, node: &mut Services<'_>, record: Record) {
        let _ = (node, record);
    }

    /// What follows from a serious error of communication: the guarding by the master or the heartbeat of another node is
    /// missing ([`EmcyError::HEARTBEAT`]), or the bus is off ([`EmcyError::BUS_OFF`]). `prescribed` is what 1029h sub-index 01h says.
    fn reaction(
        &mut self,
        node: &mut Services<'_>,
        error: EmcyError,
        prescribed: Option<NmtState>,
    ) -> Option<NmtState> {
        let _ = (node, error);
        prescribed
    }

    /// The node is being reset; the values are those of power-on already, for communication resets those of 1000h to
    /// 1FFFh.
    fn reset(&mut self, node: &mut Services<'_>, reset: Reset) {
        let _ = (node, reset);
    }

    /// Whether the node may boot up after a reset. Until the device is ready the node stays in initialising, sends and
    /// takes nothing, and asks again at each [`Node::poll`](crate::Node::poll), whose time is then up to the device.
    ///
    /// It is asked right after [`reset`](Self::reset), and it is the place to give the dictionary what the services are
    /// to be configured with.
    fn is_ready(&mut self, node: &mut Services<'_>) -> bool {
        let _ = node;
        true
    }

    /// The time between two heartbeats that a value of 1017h leads to: the place for timers that are coarser than 1 ms.
    fn heartbeat_time(&mut self, configured: Microseconds) -> Microseconds {
        configured
    }

    /// Whether a TPDO, numbered from 1, is sent when it begins: when the node enters operational, or a client makes the PDO
    /// valid. By default it is, unless it waits for a SYNC message or a request.
    fn sends_at_start(&mut self, number: u16) -> bool {
        let _ = number;
        true
    }

    /// What a transmission type means for the PDOs of a direction, by default as CiA 301 says
    /// ([`TransmissionType::meaning`]). A PDO whose type is [`Transmission::Reserved`] does not exist, and no client can
    /// write such a type.
    fn transmission(&mut self, direction: PdoDirection, transmission: TransmissionType) -> Transmission {
        transmission.meaning(direction)
    }

    /// A SYNC message has arrived, with its counter where it has one.
    fn sync_received(&mut self, node: &mut Services<'_>, counter: Option<u8>) {
        let _ = (node, counter);
    }

    /// The values of an RPDO, numbered from 1, are in the dictionary, except those that were refused.
    fn rpdo_received(&mut self, node: &mut Services<'_>, number: u16) {
        let _ = (node, number);
    }

    /// A value of an RPDO, numbered from 1, was left out with the abort code that a client would get: by the limits of its
    /// entry, by a rule of CiA 301, or by [`before_write`](Self::before_write). There is no EMCY message for it; the node
    /// counts them ([`Node::refused_rpdo_values`](crate::Node::refused_rpdo_values)).
    fn rpdo_value_refused(&mut self, node: &mut Services<'_>, number: u16, entry: &Entry, code: AbortCode) {
        let _ = (node, number, entry, code);
    }

    /// An RPDO, numbered from 1, has not come within its event time.
    fn rpdo_timed_out(&mut self, node: &mut Services<'_>, number: u16) {
        let _ = (node, number);
    }

    /// A TPDO, numbered from 1, is about to be built from the dictionary.
    fn tpdo_due(&mut self, node: &mut Services<'_>, number: u16) {
        let _ = (node, number);
    }

    /// A TIME message has arrived.
    fn time_received(&mut self, node: &mut Services<'_>, time: TimeOfDay) {
        let _ = (node, time);
    }

    /// Another node has told its state by a heartbeat; `None` once it has not for too long.
    fn remote_state(&mut self, node: &mut Services<'_>, node_id: NodeId, state: Option<NmtState>) {
        let _ = (node, node_id, state);
    }

    /// Whether an error that the services of the node find ([`EmcyError`]'s constants) is one of the device: it is told by EMCY,
    /// and is in 1001h and 1003h. The place for a manual whose error register follows the device alone. The answer for an
    /// error is always the same.
    fn counts(&mut self, error: EmcyError) -> bool {
        let _ = error;
        true
    }

    /// A service of the node has found that an error has occurred, or has gone: what the EMCY message is about to say,
    /// whether or not it can be sent. The place for a manual that fills the message in its own way. What the device raises
    /// and clears itself does not come here.
    fn emergency(&mut self, node: &mut Services<'_>, emergency: &mut Emergency) {
        let _ = (node, emergency);
    }

    /// LSS wants a bit rate to be used: after `delay` milliseconds of silence change it, and be silent as long again. At
    /// power-on this is the stored one with a delay of 0, before the boot-up message; where the CAN controller needs it
    /// earlier, [`Commissioning::stored`](crate::Commissioning::stored) gives it.
    fn activate_bit_rate(&mut self, bit_rate: Bitrate, delay: u16) {
        let _ = (bit_rate, delay);
    }
}

/// A device that adds nothing.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct NoApplication;

impl Application for NoApplication {}

/// What is reset.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Reset {
    /// Power-on, or the command reset node: everything.
    Node,
    /// The command reset communication: 1000h to 1FFFh and all services.
    Communication,
}

/// A time of day, as a TIME message tells it (CiA 301 v4.2, 7.1.6.5).
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct TimeOfDay {
    /// Milliseconds after midnight, in 28 bits.
    pub milliseconds: u32,
    /// Days since 1 January 1984.
    pub days: u16,
}
