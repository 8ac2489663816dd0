//! Text behind a value that was meant as a comment. CiA 306 knows none: it belongs to the value.

/// The length of the value before a blank and `;` or `#`, where a value holds such a thing.
///
/// Only values that are no free text are asked; SYN012 reports them, and every other rule leaves them alone.
pub(crate) fn value_length(raw: &[u8]) -> Option<usize> {
    let start = raw.windows(2).position(|pair| matches!(pair, [b' ' | b'\t', b';' | b'#']))?;
    Some(raw[..start].trim_ascii_end().len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_blank_must_stand_before_the_mark() {
        assert_eq!(value_length(b"0x0005 ; U8"), Some(6));
        assert_eq!(value_length(b"5 \t# five"), Some(1));
        assert_eq!(value_length(b"0;2"), None);
        assert_eq!(value_length(b"rw"), None);
    }
}
