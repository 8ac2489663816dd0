//! The digital governor behind the gateway.

use super::inputs::Inputs;
use super::signal::Signals;

/// A digital governor, DC, as the gateway needs it: what it measures, and what it does with what comes from CANopen.
///
/// The initialisation of the gateway, the times of the PDOs and their monitoring are not its business here: they follow
/// from the parameters, and [`Gateway`](super::Gateway) does them for both units. [`Engine`](super::Engine) is a simple
/// model for computers.
pub trait Governor: Signals {
    /// Its control unit starts.
    fn start(&mut self);

    /// A main cycle, every 15.625 ms (7.1.3; GW-TIMING-03).
    fn main_cycle(&mut self, inputs: &Inputs<'_>);

    /// The value of a parameter that [`Signals`] knows, in its internal range (7.1.2.2; GW-PDO-07), as the 16 bits that
    /// a TPDO carries: 8 bits are widened by their sign (4.1.2; GW-PDO-05).
    fn value(&self, number: u16) -> u16;

    /// The engine status (5.1.1; GW-NOTE-04): 8 bits, whose meaning is left to the governor.
    fn engine_status(&self) -> u8;

    /// Errors of the engine, bit k for error 3000 + k. Those of CANopen sensors and of the governor's CAN bus are added
    /// to them by the gateway.
    fn errors(&self) -> u128;
}
