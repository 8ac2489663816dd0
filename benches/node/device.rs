//! What both sides of the benchmark are: a node that is driven frame in, frames out.

/// The node-ID of both.
pub(crate) const NODE_ID: u16 = 1;
/// An UNSIGNED32 that clients read and write.
pub(crate) const NUMBER: u16 = 0x2000;
/// An OCTET_STRING of [`LENGTH`] bytes that clients read.
pub(crate) const BYTES: u16 = 0x2001;
/// About 7 kB: not a multiple of 7, since zencan then says a wrong length at the end of a block upload.
pub(crate) const LENGTH: usize = 7010;

/// What the PDOs of the device carry.
#[derive(Clone, Copy)]
pub(crate) enum Mapping {
    /// The first PDO: 4 entries of 16 bits.
    Words,
    /// The second one: 64 entries of 1 bit.
    Bits,
    /// The third one: 8 entries of 8 bits.
    Bytes,
}

impl Mapping {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Words => "4 entries",
            Self::Bits => "64 entries",
            Self::Bytes => "8 entries",
        }
    }

    pub(crate) fn rpdo(self) -> u16 {
        NODE_ID
            + match self {
                Self::Words => 0x200,
                Self::Bits => 0x300,
                Self::Bytes => 0x400,
            }
    }

    pub(crate) fn tpdo(self) -> u16 {
        self.rpdo() - 0x80
    }
}

/// A node. Time goes on by itself with each call of [`Device::poll`].
pub(crate) trait Device {
    type Frame;

    const NAME: &'static str;

    /// Takes a frame from the bus.
    fn receive(&mut self, can_id: u16, data: &[u8]);
    /// Does what is due.
    fn poll(&mut self);
    /// The next frame to be sent.
    fn transmit(&mut self) -> Option<Self::Frame>;
    fn can_id(frame: &Self::Frame) -> u16;
    fn data(frame: &Self::Frame) -> &[u8];

    /// The device gives the first value of a TPDO and says that it has changed.
    fn change(&mut self, mapping: Mapping, value: u8);
    /// The values that an RPDO has brought, in the order and length of the mapping.
    fn received(&mut self, mapping: Mapping) -> Vec<u8>;
}

/// The contents of [`BYTES`].
pub(crate) fn bytes() -> [u8; LENGTH] {
    std::array::from_fn(|place| (place * 31 % 251) as u8)
}

/// Powers a node on and takes it to the state operational.
pub(crate) fn start<D: Device>(device: &mut D) {
    device.poll();
    device.receive(0, &[1, NODE_ID as u8]);
    device.poll();
    let mut can_ids = Vec::new();
    while let Some(frame) = device.transmit() {
        can_ids.push(D::can_id(&frame));
    }
    assert_eq!(can_ids.first(), Some(&(0x700 + NODE_ID)), "{} boots up", D::NAME);
}
