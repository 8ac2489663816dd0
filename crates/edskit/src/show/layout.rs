//! The picture of a PDO: one row for each mapped entry, one mark for each bit.

use super::view::{MappedView, titled};
use std::io::{self, Write};

/// Bits of a PDO.
const PDO_BITS: u32 = 64;

pub(super) fn write(mapped: &[MappedView], total: u32, out: &mut dyn Write) -> io::Result<()> {
    let bytes = total.div_ceil(8).clamp(1, PDO_BITS / 8);
    let header: Vec<String> = (0..bytes).map(|byte| format!("{:<8}", format!("byte {byte}"))).collect();
    writeln!(out, "    {}", header.join(" ").trim_end())?;
    for entry in mapped {
        let places: Vec<String> =
            (0..bytes).map(|byte| (byte * 8..byte * 8 + 8).map(|bit| mark(entry, bit)).collect()).collect();
        let place = format!("{:04X}:{:02X}", entry.index, entry.sub_index);
        let name = titled(&entry.name, entry.denotation.as_deref());
        writeln!(out, "    {}  {place}  {:>2} bits  {name}", places.join(" "), entry.bits)?;
    }
    if total > PDO_BITS {
        writeln!(out, "    {total} bits are mapped, but a PDO holds {PDO_BITS}")?;
    }
    Ok(())
}

/// The mark for one bit, bit 0 of a byte on the left as it is sent last but counted first.
fn mark(entry: &MappedView, bit: u32) -> char {
    let last_bit = entry.first_bit + u32::from(entry.bits);
    if (entry.first_bit..last_bit).contains(&bit) { '█' } else { '·' }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn single_bits_and_words_are_drawn() {
        let entry = |index, first_bit, bits, name: &str| MappedView {
            index,
            sub_index: 0,
            name: name.to_owned(),
            denotation: None,
            first_bit,
            bits,
        };
        let mapped = [entry(0x6000, 0, 1, "flag"), entry(0x0005, 1, 7, "gap"), entry(0x6041, 8, 16, "word")];
        let mut out = Vec::new();
        write(&mapped, 24, &mut out).unwrap();
        let expected = "    byte 0   byte 1   byte 2\n    █······· ········ ········  6000:00   1 bits  flag\n    ·███████ ········ ········  0005:00   7 bits  gap\n    ········ ████████ ████████  6041:00  16 bits  word\n";
        assert_eq!(String::from_utf8(out).unwrap(), expected);
    }
}
