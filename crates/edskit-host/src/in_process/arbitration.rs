//! Which of several frames wins the bus.

use edskit_runtime::Frame;

/// The bits that are sent while participants compete, as a number: the smaller one wins. A standard frame wins against an
/// extended one with the same first 11 bits, a data frame against a remote frame with the same identifier.
pub(crate) fn priority(frame: &Frame) -> u32 {
    let id = frame.can_id().raw();
    let is_remote = u32::from(frame.is_remote());
    if frame.can_id().is_extended() {
        // 11 bits, SRR, IDE, 18 bits, RTR
        (id >> 18) << 21 | 0b11 << 19 | (id & 0x3_FFFF) << 1 | is_remote
    } else {
        // 11 bits, RTR, IDE
        id << 21 | is_remote << 20
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use edskit_types::CanId;

    #[test]
    fn the_order_on_the_bus() {
        let standard = |id| CanId::standard(id).unwrap();
        let extended = |id| CanId::extended(id).unwrap();
        let order = [
            Frame::new(standard(0), &[]),
            Frame::remote(standard(0), 0),
            Frame::new(extended(0), &[]),
            Frame::remote(extended(0), 0),
            Frame::new(extended(0x3_FFFF), &[]),
            Frame::new(standard(1), &[9]),
            Frame::new(extended(1 << 18), &[]),
            Frame::new(standard(0x7FF), &[]),
            Frame::remote(standard(0x7FF), 8),
            Frame::new(extended(0x1FFF_FFFF), &[]),
            Frame::remote(extended(0x1FFF_FFFF), 0),
        ];
        assert!(order.windows(2).all(|pair| priority(&pair[0]) < priority(&pair[1])));
    }
}
