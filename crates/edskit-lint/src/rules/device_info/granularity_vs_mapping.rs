use super::pdos;
use crate::rule::rule;
use crate::{Context, Edit, Report};
use edskit_model::{Entry, Field, Object, Span};
use edskit_types::AccessType;

rule! {
    /// Granularity and the access to the mapping contradict each other
    ///
    /// ## What it does
    /// Reports a `Granularity` of 0, which means a fixed mapping, if an entry of a PDO mapping can be written, and one
    /// above 0 if no entry of any described mapping can.
    ///
    /// ## Why is this bad
    /// A configuration tool takes from the entry whether it may offer to change the mapping. So it hides what the
    /// device can do, or offers what the device refuses.
    ///
    /// ## Example
    /// ```eds
    /// [DeviceInfo]
    /// Granularity=8
    ///
    /// [1A00]
    /// ParameterName=TPDO 1 mapping
    /// ObjectType=0x9
    /// SubNumber=1
    ///
    /// [1A00sub0]
    /// ParameterName=Number of entries
    /// DataType=0x0005
    /// AccessType=const
    /// DefaultValue=0
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [DeviceInfo]
    /// Granularity=0
    ///
    /// [1A00]
    /// ParameterName=TPDO 1 mapping
    /// ObjectType=0x9
    /// SubNumber=1
    ///
    /// [1A00sub0]
    /// ParameterName=Number of entries
    /// DataType=0x0005
    /// AccessType=const
    /// DefaultValue=0
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.5.
    pub(crate) static GRANULARITY_VS_MAPPING = {
        code: "DEV009",
        name: "granularity-vs-mapping",
        group: DeviceInfo,
        severity: Info,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("69, 70, 75, 76")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let granularity = context.sheet.device_info().and_then(|info| info.granularity());
    let Some((field, bits)) = granularity.and_then(|field| Some((field, field.known()?))) else { return };
    match access(context) {
        Access::Writable(entry) if bits == 0 => {
            report
                .add(field.span(), "Granularity is 0, a fixed mapping, but a mapping can be written")
                .label(entry.span(), format!("{} can be written", place(entry)))
                .help("write `Granularity=8` if whole bytes can be mapped, 1 for single bits");
        }
        Access::Fixed(mapping) if bits > 0 => {
            report
                .add(field.span(), format!("Granularity is {bits}, but no mapping can be written"))
                .label(mapping, "like every described mapping, this one is read-only")
                .help("write `Granularity=0` for a fixed mapping")
                .unsafe_fix("Write 0", vec![Edit::replace(field.span(), "0")]);
        }
        _ => {}
    }
}

/// What can be done with the mappings.
enum Access<'a> {
    /// This entry, an AccessType, lets something be written.
    Writable(Entry<'a>),
    /// Nothing can be written in any of them; the first one is shown.
    Fixed(Span),
    /// There is none, or one says nothing.
    Unknown,
}

fn access<'a>(context: &Context<'a>) -> Access<'a> {
    let mut result = Access::Unknown;
    let mut is_known = true;
    for mapping in pdos::mappings(context.sheet) {
        for access in accesses(mapping) {
            match access.and_then(|field| Some((field.known()?, field.entry))) {
                Some((access, entry)) if access.is_writable() => return Access::Writable(entry),
                Some(_) => {}
                None => is_known = false,
            }
            if let Access::Unknown = result {
                result = Access::Fixed(mapping.span());
            }
        }
    }
    if is_known { result } else { Access::Unknown }
}

/// What each entry of a mapping says about its access.
fn accesses<'a>(mapping: Object<'a>) -> impl Iterator<Item = Option<Field<'a, AccessType>>> {
    let compact = (mapping.compact_count() > 0).then(|| mapping.access_type());
    mapping.sub_objects().map(|sub| sub.access_type()).chain(compact)
}

/// The section of an entry, as the file names it.
fn place(entry: Entry<'_>) -> String {
    entry.section().map_or_else(String::new, |section| format!("`[{}]`", section.name()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    fn found(granularity: u8, accesses: &[&str]) -> Vec<String> {
        let mut text = format!("[DeviceInfo]\nGranularity={granularity}\n[1600]\nObjectType=9\n");
        for (sub, access) in accesses.iter().enumerate() {
            text.push_str(&format!("[1600sub{sub}]\nAccessType={access}\n"));
        }
        findings(&GRANULARITY_VS_MAPPING, &text)
    }

    #[test]
    fn a_fixed_mapping_cannot_be_written() {
        assert_eq!(
            found(0, &["ro", "rw"]),
            ["2:13 info: Granularity is 0, a fixed mapping, but a mapping can be written"]
        );
        assert_eq!(
            found(8, &["ro", "const"]),
            ["2:13 info: Granularity is 8, but no mapping can be written"]
        );
        for (granularity, accesses) in
            [(0, ["ro", "const"]), (8, ["ro", "rw"]), (8, ["ro", ""]), (8, ["ro", "x"])]
        {
            assert!(found(granularity, &accesses).is_empty(), "{granularity} {accesses:?}");
        }
        assert!(found(8, &[]).is_empty());
    }

    #[test]
    fn compact_mappings_count() {
        let text = "[DeviceInfo]\nGranularity=0\n[1A00]\nObjectType=9\nAccessType=rw\nCompactSubObj=8\n";
        assert_eq!(findings(&GRANULARITY_VS_MAPPING, text).len(), 1);
    }
}
