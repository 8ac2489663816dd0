//! A whole device, as its main loop drives it.

use crate::{Application, Dictionary, Frame, Instant, Node, Storage};

/// A CANopen device as its main loop sees it: it takes frames, does what is due, gives frames, and says when it wants to
/// be called again. The main loop of a firmware has a CAN controller on the other side, that of a computer a bus.
pub trait Device {
    /// Takes a frame from the bus.
    fn receive(&mut self, now: Instant, frame: &Frame);

    /// Does what is due.
    fn poll(&mut self, now: Instant);

    /// The next frame to be sent; `None` where there is none for now.
    fn transmit(&mut self) -> Option<Frame>;

    /// When [`poll`](Device::poll) has something to do, unless a frame comes before; `now` where it has already.
    fn next_deadline(&mut self, now: Instant) -> Instant;
}

/// A device that is a node and an application, and nothing else.
#[derive(Debug)]
pub struct NodeDevice<D, S, A> {
    /// The node.
    pub node: Node<D, S>,
    /// What the device adds.
    pub application: A,
}

impl<D: Dictionary, S: Storage, A: Application> Device for NodeDevice<D, S, A> {
    fn receive(&mut self, now: Instant, frame: &Frame) {
        self.node.receive(now, frame, &mut self.application);
    }

    fn poll(&mut self, now: Instant) {
        self.node.poll(now, &mut self.application);
    }

    fn transmit(&mut self) -> Option<Frame> {
        self.node.transmit()
    }

    fn next_deadline(&mut self, now: Instant) -> Instant {
        self.node.next_deadline(now)
    }
}
