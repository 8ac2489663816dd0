//! What a device does with its PDOs otherwise than CiA 301.

/// How the parameters of PDOs are treated. The default is CiA 301 v4.2, 7.5.2.35 to 7.5.2.38.
///
/// Who may change which parameter, and when, the device says in
/// [`Application::before_write`](crate::Application::before_write); what a transmission type means, in
/// [`Application::transmission`](crate::Application::transmission).
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct PdoPolicy {
    /// What a write to the mapping of a PDO that exists does.
    pub remapping: Remapping,
    /// Whether inhibit time and SYNC start value of a PDO that exists can be written; by default the client is told
    /// [`AbortCode::DEVICE_STATE`](edskit_types::AbortCode::DEVICE_STATE).
    pub times_change_live: bool,
    /// Whether TPDOs answer remote requests that bit 30 of their COB-ID allows.
    pub answers_requests: bool,
}

impl PdoPolicy {
    /// What CiA 301 says.
    pub const CIA_301: Self =
        Self { remapping: Remapping::WhileInvalid, times_change_live: false, answers_requests: true };
}

/// What a write to the mapping of a PDO that exists does, or to an entry of a mapping whose number of entries is not 0.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Remapping {
    /// It is refused with [`AbortCode::UNSUPPORTED_ACCESS`](edskit_types::AbortCode::UNSUPPORTED_ACCESS). Each entry is
    /// checked when it is written, the mapping as a whole when its number of entries is.
    WhileInvalid,
    /// It makes the PDO invalid: bit 31 of its COB-ID becomes 1. The mapping is checked when a client makes the PDO valid
    /// again, who gets the abort code of what is wrong with it.
    Invalidates,
}
