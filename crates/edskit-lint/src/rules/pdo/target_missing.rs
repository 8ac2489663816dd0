use crate::pdos::{DescribedPdo, Mapped, Target};
use crate::rule::rule;
use crate::rules::syntax::lost_header;
use crate::{Context, Report};
use edskit_model::{Object, SectionKind};
use edskit_types::{Index, ObjectArea, SubIndex};

rule! {
    /// A mapped object does not exist
    ///
    /// ## What it does
    /// Reports a mapping entry that names an object or a sub-index that the file does not describe. Files of modular
    /// devices may do so, and network variables that `[DynamicChannels]` announces are never described.
    ///
    /// ## Why is this bad
    /// The device refuses the mapping with abort code 0602 0000h, and a tool cannot decode the PDO.
    ///
    /// ## Example
    /// ```eds
    /// [1A00]
    /// ParameterName=TPDO 1 mapping parameter
    /// ObjectType=0x9
    /// SubNumber=2
    ///
    /// [1A00sub0]
    /// DataType=0x0005
    /// DefaultValue=1
    ///
    /// [1A00sub1]
    /// DataType=0x0007
    /// DefaultValue=0x22000210
    ///
    /// [2200]
    /// ParameterName=Speed
    /// ObjectType=0x7
    /// DataType=0x0006
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1A00]
    /// ParameterName=TPDO 1 mapping parameter
    /// ObjectType=0x9
    /// SubNumber=2
    ///
    /// [1A00sub0]
    /// DataType=0x0005
    /// DefaultValue=1
    ///
    /// [1A00sub1]
    /// DataType=0x0007
    /// DefaultValue=0x22000010
    ///
    /// [2200]
    /// ParameterName=Speed
    /// ObjectType=0x7
    /// DataType=0x0006
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.5.2.36 and 7.5.2.38; CiA 306 v1.3, 6.2.2 for modular devices.
    pub(crate) static TARGET_MISSING = {
        code: "PDO004",
        name: "target-missing",
        group: Pdo,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("mapping without object"), EdsDcfCheck("PDO001")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    if context.is_modular() {
        return;
    }
    for pdo in context.pdos() {
        for mapped in pdo.mapped() {
            check_entry(context, pdo, mapped, report);
        }
    }
}

fn check_entry(context: &Context<'_>, pdo: &DescribedPdo<'_>, mapped: &Mapped<'_>, report: &mut Report) {
    let (index, sub_index) = (mapped.entry.index(), mapped.entry.sub_index());
    match mapped.target {
        // One that a list names is the matter of LST004, one whose header is misspelt that of SYN008 or SYN023.
        Target::NoObject
            if !is_dynamic(context, index)
                && !context.listing().is_listed(index)
                && !lost_header::hides(context, SectionKind::Object(index)) =>
        {
            report
                .add(mapped.value.span(), format!("{pdo} maps {index}, which is not described"))
                .here(format!("entry {} of the mapping", mapped.sub_index.0))
                .help(format!("describe {index}, or map another object"));
        }
        // Of an object whose code cannot be read, nobody knows what it has.
        Target::NoSubIndex(object)
            if object.object_code().is_some() && !is_named_otherwise(context, object, sub_index) =>
        {
            let help = match object.sub_objects().next_back() {
                Some(last) => format!("the highest described sub-index is {}", last.sub_index()),
                None if object.object_code().is_some_and(|code| code.has_sub_objects()) => {
                    format!("no sub-index of {index} is described")
                }
                None => format!(
                    "{index} has sub-index 00h alone: write `0x{:04X}00{:02X}`",
                    index.0,
                    mapped.entry.bits()
                ),
            };
            report
                .add(
                    mapped.value.span(),
                    format!("{pdo} maps {index} sub-index {sub_index}, which is not described"),
                )
                .here(format!("entry {} of the mapping", mapped.sub_index.0))
                .label(object.span(), "the object")
                .help(help);
        }
        _ => {}
    }
}

/// Whether the sub-object is described under a misspelt name, which another rule reports.
fn is_named_otherwise(context: &Context<'_>, object: Object<'_>, sub_index: SubIndex) -> bool {
    lost_header::hides(context, SectionKind::SubObject(object.index(), sub_index))
}

/// Whether an index belongs to network variables, which a programming system makes and no EDS describes.
fn is_dynamic(context: &Context<'_>, index: Index) -> bool {
    let in_channel = || {
        let ranges = context.sheet.dynamic_channels().filter_map(|channel| channel.indices());
        ranges.into_iter().any(|(first, last)| (first..=last).contains(&index))
    };
    let supported = || {
        let info = context.sheet.device_info();
        info.and_then(|info| info.dynamic_channels_supported()).is_some_and(|field| field.known() != Some(0))
    };
    index.area() == ObjectArea::NetworkVariable && supported() || in_channel()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    fn found(entry: &str, rest: &str) -> Vec<String> {
        let text = format!(
            "[1600]\nObjectType=9\n[1600sub0]\nDataType=5\nDefaultValue=1\n[1600sub1]\nDataType=7\nDefaultValue={entry}\n{rest}"
        );
        findings(&TARGET_MISSING, &text)
    }

    #[test]
    fn objects_and_sub_indices_must_be_there() {
        assert_eq!(found("0x20000010", ""), ["8:14 error: RPDO1 maps 2000h, which is not described"]);
        assert_eq!(
            found("0x20000110", "[2000]\nDataType=6\n"),
            ["8:14 error: RPDO1 maps 2000h sub-index 01h, which is not described"]
        );
        assert!(found("0x20000010", "[2000]\nDataType=6\n").is_empty());
        assert!(found("0x20000310", "[2000]\nObjectType=8\nDataType=6\nCompactSubObj=3\n").is_empty());
        assert!(found("0x20000310", "[2000]\nObjectType=x\n").is_empty());
        assert!(found("0x00050008", "").is_empty() && found("0", "").is_empty());
    }

    #[test]
    fn modules_and_channels_bring_objects() {
        assert!(found("0x20000010", "[SupportedModules]\nNrOfEntries=1\n").is_empty());
        assert!(found("0x20000010", "[M1ModuleInfo]\n").is_empty(), "MOD001");
        let channels = "[DynamicChannels]\nNrOfSeg=1\nRange1=0xA080-0xA0BF\n";
        assert!(found("0xA0800108", channels).is_empty());
        assert_eq!(found("0xA0C00108", channels).len(), 1);
        assert!(found("0xA0C00108", "[DeviceInfo]\nDynamicChannelsSupported=1\n").is_empty());
    }
}
