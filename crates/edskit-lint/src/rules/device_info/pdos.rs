//! The PDOs that a file describes.

use core::ops::RangeInclusive;
use edskit_model::{Datasheet, Object};
use edskit_types::{Index, PdoDirection};

/// How many PDOs of each direction CANopen has.
pub(super) const MOST: u16 = 512;

/// The described communication parameters.
pub(super) fn communication(
    sheet: &Datasheet,
    direction: PdoDirection,
) -> impl ExactSizeIterator<Item = Object<'_>> {
    sheet.objects_in(block(direction))
}

/// Where communication parameters are.
pub(super) fn block(direction: PdoDirection) -> RangeInclusive<Index> {
    let first = match direction {
        PdoDirection::Receive => Index::RPDO_COMMUNICATION,
        PdoDirection::Transmit => Index::TPDO_COMMUNICATION,
    };
    first..=Index(first.0 + MOST - 1)
}

/// The described mapping parameters of both directions.
pub(super) fn mappings(sheet: &Datasheet) -> impl Iterator<Item = Object<'_>> {
    let block = |first: Index| sheet.objects_in(first..=Index(first.0 + MOST - 1));
    block(Index::RPDO_MAPPING).chain(block(Index::TPDO_MAPPING))
}
