//! The object dictionary of the gateway, generated from `eds/CANopenGateway.eds` and its side-file.

edskit_runtime::include_dictionary!("CANopenGateway");

#[cfg(test)]
mod tests {
    use super::canopen_gateway::{Dictionary, TABLE, objects};
    use core::ops::RangeInclusive;
    use edskit_runtime::{Dictionary as _, Entry, Flags};
    use std::vec::Vec;

    const READ: Flags = Flags::READ.and(Flags::VARIABLE);

    /// The entries of these objects and sub-indices.
    fn entries(indices: RangeInclusive<u16>, sub_indices: RangeInclusive<u8>) -> Vec<&'static Entry> {
        let is_meant =
            |entry: &&Entry| indices.contains(&entry.index.0) && sub_indices.contains(&entry.sub_index.0);
        TABLE.entries.iter().filter(is_meant).collect()
    }

    /// That there are so many of these entries, and what may be done with each.
    #[track_caller]
    fn assert_flags(
        indices: RangeInclusive<u16>,
        sub_indices: RangeInclusive<u8>,
        count: usize,
        flags: Flags,
    ) {
        let entries = entries(indices, sub_indices);
        assert_eq!(entries.len(), count);
        for entry in entries {
            assert_eq!(entry.flags, flags, "{entry:?}");
        }
    }

    // GW-EDS-16, GW-OD-09, GW-OD-12, GW-OD-13, GW-GAP-03
    #[test]
    fn what_a_configuration_may_lack_is_optional() {
        let optional = READ.and(Flags::OPTIONAL);
        let mapped = optional.and(Flags::TPDO);
        assert_flags(0x1600..=0x1603, 1..=0xFF, 3 + 3 * 4, optional);
        assert_flags(0x1A00..=0x1A0F, 1..=0xFF, 4 + 2 + 1 + 13 * 4, optional);
        assert_flags(0x2000..=0x2000, 1..=6, 6, READ.and(Flags::TPDO));
        assert_flags(0x2000..=0x2000, 7..=0xFF, 1, mapped);
        assert_flags(0x2001..=0x2002, 1..=0xFF, 2 * 52, mapped);
        assert_flags(0x2003..=0x2004, 1..=0xFF, 2 + 12, mapped.and(Flags::RPDO));
        let of_some = TABLE.entries.iter().filter(|entry| entry.flags.has(Flags::OPTIONAL));
        assert_eq!(of_some.count(), 15 + 59 + 1 + 104 + 14);
    }

    // GW-GAP-02, GW-OD-24
    #[test]
    fn rpdos_write_the_inputs_and_clients_write_nothing() {
        let received = TABLE.entries.iter().filter(|entry| entry.flags.has(Flags::RPDO));
        assert!(received.map(|entry| entry.index.0).eq([[0x2003; 2].as_slice(), &[0x2004; 12]].concat()));
        assert!(TABLE.entries.iter().all(|entry| !entry.flags.has(Flags::WRITE)));
    }

    // GW-GAP-04, GW-OD-04, GW-OD-05, GW-OD-08, GW-OD-11, GW-OD-19
    #[test]
    fn what_the_initialisation_changes_lies_in_ram() {
        let cob_id = READ.and(Flags::NODE_RELATIVE);
        assert_flags(0x1016..=0x1016, 1..=0xFF, 1, READ);
        assert_flags(0x1017..=0x1017, 0..=0xFF, 1, READ);
        assert_flags(0x1018..=0x1018, 4..=4, 1, READ);
        assert_flags(0x1400..=0x1403, 1..=1, 4, cob_id);
        assert_flags(0x1800..=0x180F, 1..=1, 16, cob_id);
        assert_flags(0x1600..=0x1603, 0..=0, 4, READ);
        assert_flags(0x1A00..=0x1A0F, 0..=0, 16, READ);
        assert_flags(0x2000..=0x2005, 0..=0, 6, READ);
    }

    // GW-OD-20
    #[test]
    fn counts_and_2005h_cannot_be_mapped() {
        for entry in TABLE.entries.iter().filter(|entry| entry.index.0 >= 0x2000) {
            let is_data = entry.sub_index.0 > 0;
            assert_eq!(entry.flags.has(Flags::TPDO), is_data, "{entry:?}");
        }
    }

    #[test]
    fn a_dictionary_takes_what_the_device_says() {
        let mut dictionary = Dictionary::new();
        let mut parts = dictionary.parts();
        assert_eq!((parts.rpdos.len(), parts.tpdos.len(), parts.consumers.len()), (4, 16, 1));
        parts.objects.set(objects::PRODUCER_HEARTBEAT_TIME, 500);
        assert_eq!(parts.objects.get(objects::PRODUCER_HEARTBEAT_TIME), 500);
    }
}
