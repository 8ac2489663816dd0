//! What CiA 301 knows about entries that a file leaves without a value.

use super::Expected;
use super::notation::{Constant, OneOrRange};
use core::fmt;
use core::ops::RangeInclusive;
use edskit_types::{Index, SubIndex};
use std::sync::LazyLock;

/// What an entry has where the file gives it no value.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct StandardDefault {
    /// The number, without the node-ID.
    pub number: u32,
    /// Whether the node-ID is added.
    pub adds_node_id: bool,
}

/// As in an EDS: `0x80`, `$NODEID+0x80`.
impl fmt::Display for StandardDefault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let variable = if self.adds_node_id { "$NODEID+" } else { "" };
        write!(f, "{variable}0x{:X}", self.number)
    }
}

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Raw {
    default: Vec<RawDefault>,
}

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct RawDefault {
    index: OneOrRange<u16>,
    sub: Option<OneOrRange<u8>>,
    value: Constant,
}

struct Row {
    indices: RangeInclusive<u16>,
    sub_indices: RangeInclusive<u8>,
    default: StandardDefault,
}

static ROWS: LazyLock<Vec<Row>> = LazyLock::new(|| {
    let raw: Raw = toml::from_str(include_str!("../../profiles/cia301-defaults.toml"))
        .expect("the defaults of the crate are tested");
    let row = |raw: RawDefault| {
        let (number, adds_node_id) = match raw.value.0 {
            Expected::Number(number) => (number.cast_unsigned(), false),
            Expected::Formula(formula) => (formula.offset(), true),
        };
        // A COB-ID has 32 bits.
        let default = StandardDefault { number: number as u32, adds_node_id };
        Row { indices: raw.index.0, sub_indices: raw.sub.map_or(0..=0, |sub| sub.0), default }
    };
    raw.default.into_iter().map(row).collect()
});

/// What CiA 301 gives an entry of 1000h to 1FFFh where the file has no value for it; `None` for 0 and an empty text.
///
/// ```
/// use edskit_lint::standard_default;
/// use edskit_types::{Index, SubIndex};
/// let default = |index, sub_index| standard_default(Index(index), SubIndex(sub_index)).unwrap().to_string();
/// assert_eq!(default(0x1014, 0), "$NODEID+0x80");
/// assert_eq!(default(0x1804, 1), "0x80000000");
/// ```
pub fn standard_default(index: Index, sub_index: SubIndex) -> Option<StandardDefault> {
    let is_it = |row: &&Row| row.indices.contains(&index.0) && row.sub_indices.contains(&sub_index.0);
    ROWS.iter().find(is_it).map(|row| row.default)
}

#[cfg(test)]
mod tests {
    use super::*;
    use edskit_types::{NodeId, Party, PdoDirection, SdoMessage, SdoRole};

    fn number(index: u16, sub_index: u8) -> Option<(u32, bool)> {
        let default = standard_default(Index(index), SubIndex(sub_index))?;
        Some((default.number, default.adds_node_id))
    }

    /// The CAN-ID that the pre-defined connection set adds to the node-ID.
    fn base(party: Party) -> Option<(u32, bool)> {
        let can_id = party.predefined_can_id(NodeId::MIN)?;
        Some((can_id.raw() - u32::from(NodeId::MIN.get()), true))
    }

    #[test]
    fn the_defaults_are_the_predefined_connection_set() {
        assert_eq!(number(0x1014, 0), base(Party::Emcy));
        let server = |message| Party::Sdo { role: SdoRole::Server, number: 1, message };
        assert_eq!(number(0x1200, 1), base(server(SdoMessage::Request)));
        assert_eq!(number(0x1200, 2), base(server(SdoMessage::Response)));
        for (first, direction) in [(0x1400, PdoDirection::Receive), (0x1800, PdoDirection::Transmit)] {
            for pdo in 1..=512_u16 {
                let predefined = base(Party::Pdo { direction, number: pdo });
                assert_eq!(number(first + pdo - 1, 1), predefined.or(Some((0x8000_0000, false))), "{pdo}");
            }
        }
        assert_eq!((number(0x1005, 0), number(0x1012, 0)), (Some((0x80, false)), Some((0x100, false))));
    }

    #[test]
    fn each_entry_has_one_default() {
        for (position, row) in ROWS.iter().enumerate() {
            for other in &ROWS[..position] {
                let apart = |a: u16, b: u16, c: u16, d: u16| b < c || d < a;
                let (own, theirs) = (&row.indices, &other.indices);
                let (own_subs, their_subs) = (&row.sub_indices, &other.sub_indices);
                assert!(
                    apart(*own.start(), *own.end(), *theirs.start(), *theirs.end())
                        || apart(
                            (*own_subs.start()).into(),
                            (*own_subs.end()).into(),
                            (*their_subs.start()).into(),
                            (*their_subs.end()).into()
                        )
                );
            }
            assert!((0x1000..=0x1FFF).contains(row.indices.start()) && *row.indices.end() <= 0x1FFF);
        }
        assert_eq!(number(0x1017, 0), None);
        assert_eq!(number(0x2000, 1), None);
    }
}
