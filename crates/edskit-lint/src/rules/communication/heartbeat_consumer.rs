use crate::evaluate::{Effective, commissioned};
use crate::rule::rule;
use crate::{Context, Report, Severity};
use edskit_types::{Index, NodeId};
use std::collections::HashMap;

rule! {
    /// A heartbeat cannot be monitored
    ///
    /// ## What it does
    /// Reports an entry of 1016h with one of the bits 24 to 31 set, and, as a warning, one with a time but without a node-ID of
    /// 1 to 127, one for a node that an earlier entry monitors already, and in a DCF one for the node itself.
    ///
    /// ## Why is this bad
    /// The bits are reserved. An entry without a node-ID monitors nothing, although its time says that it should; of two entries
    /// for one node the device refuses the second (abort code 0604 0043h).
    ///
    /// ## Example
    /// ```eds
    /// [1016]
    /// ParameterName=Consumer heartbeat time
    /// ObjectType=0x8
    /// SubNumber=2
    ///
    /// [1016sub0]
    /// DataType=0x0005
    /// DefaultValue=1
    ///
    /// [1016sub1]
    /// DataType=0x0007
    /// DefaultValue=0x050003E8
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1016]
    /// ParameterName=Consumer heartbeat time
    /// ObjectType=0x8
    /// SubNumber=2
    ///
    /// [1016sub0]
    /// DataType=0x0005
    /// DefaultValue=1
    ///
    /// [1016sub1]
    /// DataType=0x0007
    /// DefaultValue=0x000503E8
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.5.2.19.
    pub(crate) static HEARTBEAT_CONSUMER = {
        code: "COM012",
        name: "heartbeat-consumer",
        group: Communication,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let Some(object) = context.sheet.object(Index::CONSUMER_HEARTBEAT) else { return };
    let own = commissioned(context);
    let mut monitored = HashMap::new();
    for entry in object.dictionary_entries().filter(|entry| (1..0xFF).contains(&entry.sub_index.0)) {
        let Some(value) = Effective::of(object, entry.sub_index.0) else { continue };
        let Some(bits) = value.constant::<u32>() else { continue };
        let place = format!("1016h sub-index {}", entry.sub_index);
        let (reserved, node, time) = (bits >> 24, (bits >> 16) as u8, bits as u16);
        if reserved != 0 {
            report
                .add(value.span(), format!("{place} is {bits:08X}h, but its bits 24 to 31 are reserved"))
                .help("the node-ID stands in bits 16 to 23, the time in ms in bits 0 to 15");
            continue;
        }
        if time == 0 {
            continue;
        }
        let Ok(node_id) = NodeId::new(node) else {
            let message = format!("{place} has a time of {time} ms, but {node} is not a node-ID");
            let finding = report.add(value.span(), message).severity(Severity::Warning);
            finding
                .help("write a node-ID of 1 to 127 into bits 16 to 23, or 0 for an entry that is not used");
            continue;
        };
        // All elements of a compact object take the same default, which is one defect.
        let first = *monitored.entry(node_id).or_insert(value);
        if first.entry.id() != value.entry.id() {
            report
                .add(value.span(), format!("{place} monitors node {node_id} a second time"))
                .severity(Severity::Warning)
                .here("the second entry")
                .label(first.span(), "the first entry")
                .help("keep one of the two, and write 0 into the other one");
        } else if own == Some(node_id) {
            report
                .add(value.span(), format!("{place} monitors node {node_id}, which is this device itself"))
                .severity(Severity::Warning)
                .help("write the node-ID of another device, or 0 for an entry that is not used");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, findings_in};

    fn text(values: &[&str]) -> String {
        let mut text = "[DeviceComissioning]\nNodeID=9\n[1016]\nObjectType=8\n".to_owned();
        for (position, value) in values.iter().enumerate() {
            text.push_str(&format!("[1016sub{}]\nDataType=7\nDefaultValue={value}\n", position + 1));
        }
        text
    }

    #[test]
    fn each_part_of_the_value_is_checked() {
        assert_eq!(
            findings(
                &HEARTBEAT_CONSUMER,
                &text(&["0x000503E8", "0x80000000", "1000", "0x8003E8", "0x50001", "0x50000", "0xFF0000"])
            ),
            [
                "10:14 error: 1016h sub-index 02h is 80000000h, but its bits 24 to 31 are reserved",
                "13:14 warning: 1016h sub-index 03h has a time of 1000 ms, but 0 is not a node-ID",
                "16:14 warning: 1016h sub-index 04h has a time of 1000 ms, but 128 is not a node-ID",
                "19:14 warning: 1016h sub-index 05h monitors node 5 a second time"
            ]
        );
    }

    #[test]
    fn a_commissioned_node_does_not_monitor_itself() {
        let text = text(&["0x000903E8"]);
        assert!(findings(&HEARTBEAT_CONSUMER, &text).is_empty());
        assert_eq!(
            findings_in(&HEARTBEAT_CONSUMER, "a.dcf", text.as_bytes()),
            ["7:14 warning: 1016h sub-index 01h monitors node 9, which is this device itself"]
        );
    }

    #[test]
    fn compact_entries_are_told_apart() {
        let text = "[1016]\nObjectType=8\nDataType=7\nDefaultValue=0\nCompactSubObj=127\n[1016Value]\nNrOfEntries=2\n1=0x503E8\n7=0x503E8\n";
        assert_eq!(
            findings_in(&HEARTBEAT_CONSUMER, "a.dcf", text.as_bytes()),
            ["9:3 warning: 1016h sub-index 07h monitors node 5 a second time"]
        );
        let all_alike = "[1016]\nObjectType=8\nDataType=7\nDefaultValue=0x503E8\nCompactSubObj=9\n";
        assert!(findings(&HEARTBEAT_CONSUMER, all_alike).is_empty());
    }
}
