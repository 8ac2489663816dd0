//! Which entries a side-file means.

use core::ops::RangeInclusive;
use edskit_types::{Index, SubIndex};

/// Entries by index and sub-index: `2000`, `1018sub4`, `2000-20FFsub1-3`, all numbers hexadecimal as in section names.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Places {
    indices: RangeInclusive<u16>,
    sub_indices: RangeInclusive<u8>,
}

impl Places {
    pub(crate) fn parse(text: &str) -> Option<Self> {
        let lower = text.to_ascii_lowercase();
        let (indices, sub_indices) = match lower.split_once("sub") {
            Some((indices, sub_indices)) => (indices, range(sub_indices, 2)?),
            None => (&*lower, 0..=0xFF),
        };
        let indices = range(indices, 4)?;
        Some(Self { indices, sub_indices: *sub_indices.start() as u8..=*sub_indices.end() as u8 })
    }

    pub(crate) fn contain(&self, index: Index, sub_index: SubIndex) -> bool {
        self.indices.contains(&index.0) && self.sub_indices.contains(&sub_index.0)
    }

    /// Every one of them in ascending order.
    pub(crate) fn entries(&self) -> impl Iterator<Item = (Index, SubIndex)> + '_ {
        let sub_indices = || self.sub_indices.clone().map(SubIndex);
        self.indices.clone().flat_map(move |index| sub_indices().map(move |sub| (Index(index), sub)))
    }

    /// How many sub-indices of each object they are.
    pub(crate) fn sub_indices(&self) -> usize {
        self.sub_indices.len()
    }

    /// Whether they are all entries of one object, or one entry.
    pub(crate) fn are_one(&self) -> bool {
        self.indices.len() == 1 && matches!(self.sub_indices.len(), 1 | 256)
    }

    /// How many entries they could be.
    pub(crate) fn size(&self) -> usize {
        self.indices.len() * self.sub_indices.len()
    }
}

/// One or two numbers of at most so many hexadecimal digits.
fn range(text: &str, digits: usize) -> Option<RangeInclusive<u16>> {
    let number = |text: &str| {
        let is_number =
            (1..=digits).contains(&text.len()) && text.bytes().all(|byte| byte.is_ascii_hexdigit());
        is_number.then(|| u16::from_str_radix(text, 16).ok()).flatten()
    };
    let (first, last) = text.split_once('-').unwrap_or((text, text));
    let range = number(first)?..=number(last)?;
    (!range.is_empty()).then_some(range)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_of_indices_and_sub_indices() {
        let places = Places::parse("1A00-1a03sub5-8").unwrap();
        assert!(places.contain(Index(0x1A03), SubIndex(8)) && !places.contain(Index(0x1A03), SubIndex(9)));
        assert_eq!((places.size(), places.entries().count()), (16, 16));
        assert_eq!(Places::parse("2000").unwrap().size(), 256);
        assert_eq!(Places::parse("1018sub4").unwrap().entries().next(), Some((Index(0x1018), SubIndex(4))));
        for wrong in ["", "0x2000", "20000", "2001-2000", "2000sub", "2000sub100", "2000-", "sub1", "+200"] {
            assert_eq!(Places::parse(wrong), None, "{wrong}");
        }
    }
}
