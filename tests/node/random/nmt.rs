//! Which NMT state a node must be in, worked out without the node.

use edskit_runtime::Frame;
use edskit_types::NmtState;

/// What is known of a node from the frames it has got and the answers it has given.
pub(super) struct Nmt {
    pub(super) state: NmtState,
    pub(super) node_id: Option<u8>,
    /// The node-ID from the next reset on.
    pending: Option<u8>,
    /// Whether LSS configures it.
    is_in_configuration: bool,
    pub(super) serial_number: [u8; 4],
}

impl Nmt {
    /// A node that has booted up.
    pub(super) fn new(node_id: Option<u8>, serial_number: [u8; 4]) -> Self {
        let mut nmt = Self {
            state: NmtState::Initialising,
            node_id: None,
            pending: node_id,
            is_in_configuration: false,
            serial_number,
        };
        nmt.reset();
        nmt
    }

    /// The node has got a frame, and has sent these at once.
    pub(super) fn received(&mut self, frame: &Frame, sent: &[Frame]) -> Result<(), String> {
        let lss: Vec<&Frame> = sent.iter().filter(|frame| frame.can_id().raw() == 0x7E4).collect();
        let can_id = frame.can_id();
        let is_lss = !can_id.is_extended() && can_id.raw() == 0x7E5;
        if lss.len() > usize::from(is_lss) {
            return Err(format!("{frame:?} is answered by LSS with {lss:?}"));
        }
        if can_id.is_extended() {
            return Ok(());
        }
        match (can_id.raw(), frame.data()) {
            (0, &[command, addressee]) => self.command(command, addressee),
            (0x7E5, data) if data.len() == 8 => {
                return self.lss(data, lss.first().map(|answer| answer.data()));
            }
            _ => {}
        }
        Ok(())
    }

    fn command(&mut self, command: u8, addressee: u8) {
        let Some(own) = self.node_id else { return };
        if addressee != 0 && addressee != own {
            return;
        }
        match command {
            1 => self.state = NmtState::Operational,
            2 => self.state = NmtState::Stopped,
            128 => self.state = NmtState::PreOperational,
            129 | 130 => self.reset(),
            _ => {}
        }
    }

    fn lss(&mut self, request: &[u8], answer: Option<&[u8]>) -> Result<(), String> {
        match (request[0], answer) {
            (0x04, None) => match request[1] {
                0 => {
                    self.is_in_configuration = false;
                    if self.node_id.is_none() && self.pending.is_some() {
                        self.reset();
                    }
                }
                1 => self.is_in_configuration = true,
                _ => {}
            },
            (0x11, Some([0x11, 0, ..]))
                if self.is_in_configuration && matches!(request[1], 1..=127 | 255) =>
            {
                self.pending = (request[1] != 255).then_some(request[1]);
            }
            (0x11, Some([0x11, 1, ..]))
                if self.is_in_configuration && !matches!(request[1], 1..=127 | 255) => {}
            // Who answers has been selected; who does not has not, and that is checked where the whole identity is sent.
            (0x43, Some([0x44, ..])) if !self.is_in_configuration && request[1..5] == self.serial_number => {
                self.is_in_configuration = true;
            }
            (0x51, Some([0x4F, ..])) if self.pending.is_none() && !self.is_in_configuration => {
                self.is_in_configuration = request[5..8] == [0, 3, 0];
            }
            (0x4B, Some([0x4F, ..])) => {}
            (0x4C, Some([0x50, ..])) if self.pending.is_none() => {}
            (0x13 | 0x17 | 0x5A..=0x5E, Some([echo, ..]))
                if self.is_in_configuration && *echo == request[0] => {}
            (0x11 | 0x13 | 0x17 | 0x5A..=0x5E, None) if !self.is_in_configuration => {}
            (0x11 | 0x13 | 0x17 | 0x5A..=0x5E, answer) | (_, answer @ Some(_)) => {
                return Err(format!("LSS request {request:02X?} is answered with {answer:02X?}"));
            }
            _ => {}
        }
        Ok(())
    }

    /// The node has missed a heartbeat, or its guarding, and its error behaviour is this.
    pub(super) fn lost_heartbeat(&mut self, behaviour: u8) {
        match (behaviour, self.state) {
            (_, NmtState::Initialising) => {}
            (0, NmtState::Operational) => self.state = NmtState::PreOperational,
            (2, _) => self.state = NmtState::Stopped,
            _ => {}
        }
    }

    /// A node boots up where it has a node-ID.
    fn reset(&mut self) {
        self.node_id = self.pending;
        self.is_in_configuration = false;
        let has_booted = self.node_id.is_some();
        self.state = if has_booted { NmtState::PreOperational } else { NmtState::Initialising };
    }
}
