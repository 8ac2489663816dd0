//! From an address to a bus.

use crate::{
    Address, Bus, BusError, Client, Event, Hub, HubOptions, HubParticipant, Received, SendError,
    VirtualClient,
};
use edskit_runtime::{Frame, Instant};

/// Opens the bus that `address` names. [`Address::Hub`] starts a hub with the default [`HubOptions`] that lives as long as
/// the bus. [`Address::Virtual`] cannot be opened: a bus in virtual time needs somebody who lets its time pass
/// ([`VirtualServer`](crate::VirtualServer)).
///
/// # Errors
///
/// [`BusError`] says why not, in a way that helps a person to mend it.
///
/// ```
/// let address = "socketcan:can0".parse()?;
/// if let Err(error) = edskit_host::open(&address) {
///     assert!(error.to_string().contains("can0"));
/// }
/// # Ok::<(), edskit_host::AddressError>(())
/// ```
pub fn open(address: &Address) -> Result<Box<dyn Bus + Send>, BusError> {
    Ok(match address {
        Address::Hub => {
            let hub = Hub::start(&HubOptions::default())?;
            Box::new(OwnHub { participant: hub.attach(), _hub: hub })
        }
        Address::Virtual => return Err(BusError::NobodyThere),
        Address::VirtualAt { host, port } => Box::new(VirtualClient::connect(host, *port)?),
        Address::Socketcand { host, port, channel } => Box::new(Client::socketcand(host, *port, channel)?),
        Address::Slcan { host, port } => Box::new(Client::slcan(host, *port)?),
        Address::SocketCan { interface } => socketcan(interface)?,
    })
}

#[cfg(all(feature = "socketcan", target_os = "linux"))]
fn socketcan(interface: &str) -> Result<Box<dyn Bus + Send>, BusError> {
    Ok(Box::new(crate::SocketCan::open(interface)?))
}

#[cfg(not(all(feature = "socketcan", target_os = "linux")))]
fn socketcan(interface: &str) -> Result<Box<dyn Bus + Send>, BusError> {
    Err(BusError::NoSocketCan(interface.to_owned()))
}

/// A participant with the hub that it belongs to.
struct OwnHub {
    participant: HubParticipant,
    _hub: Hub,
}

impl Bus for OwnHub {
    fn now(&self) -> Instant {
        self.participant.now()
    }

    fn receive(&mut self) -> Result<Option<Received>, BusError> {
        self.participant.receive()
    }

    fn send(&mut self, frame: &Frame) -> Result<(), SendError> {
        self.participant.send(frame)
    }

    fn wait(&mut self, deadline: Instant) -> Result<(), BusError> {
        self.participant.wait(deadline)
    }

    fn event(&mut self) -> Option<Event> {
        self.participant.event()
    }
}
