use crate::pdos::{self, Target};
use crate::rule::rule;
use crate::{Context, Report, Severity};
use edskit_model::Span;
use edskit_types::DataType;

rule! {
    /// Something smaller than the granularity is mapped or can be mapped
    ///
    /// ## What it does
    /// Compares `Granularity`, the smallest unit that can be mapped, with the lengths of all mapped entries, and as an
    /// information with those of all objects with `PDOMapping=1`. The first one that is not a multiple is shown.
    ///
    /// ## Why is this bad
    /// A tool that builds a mapping rounds up to the granularity or refuses the object, so it disagrees with the
    /// device.
    ///
    /// ## Example
    /// ```eds
    /// [DeviceInfo]
    /// Granularity=8
    ///
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
    /// DefaultValue=0x22000001
    ///
    /// [2200]
    /// ParameterName=Limit switch
    /// DataType=0x0001
    /// PDOMapping=1
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [DeviceInfo]
    /// Granularity=1
    ///
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
    /// DefaultValue=0x22000001
    ///
    /// [2200]
    /// ParameterName=Limit switch
    /// DataType=0x0001
    /// PDOMapping=1
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.5.
    pub(crate) static GRANULARITY_VIOLATED = {
        code: "PDO021",
        name: "granularity-violated",
        group: Pdo,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("69, 70, 75, 76")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let granularity = context.sheet.device_info().and_then(|info| info.granularity());
    let Some((field, unit)) = granularity.and_then(|field| Some((field, field.known()?))) else { return };
    // 0 means a fixed mapping, and more than 64 is the matter of DEV008.
    if !(2..=64).contains(&unit) {
        return;
    }
    let Some(broken) = mapped(context, unit).or_else(|| mappable(context, unit)) else { return };
    report
        .add(field.span(), format!("Granularity is {unit} bits, but {}", broken.what))
        .severity(broken.severity)
        .label(broken.span, broken.label)
        .help(format!(
            "write `Granularity={}`, the greatest unit that all lengths are multiples of",
            broken.better
        ));
}

struct Broken {
    severity: Severity,
    what: String,
    span: Span,
    label: &'static str,
    better: u16,
}

/// The first mapped entry that is no multiple of the unit.
fn mapped(context: &Context<'_>, unit: u8) -> Option<Broken> {
    let mut first = None;
    let mut better = unit.into();
    for pdo in context.pdos() {
        for mapped in pdo.mapped() {
            let Target::Entry(entry) = mapped.target else { continue };
            let bits = mapped.entry.bits();
            // Another length than the object has is the matter of PDO005.
            let is_own = entry.data_type().and_then(DataType::bits).is_none_or(|own| own == u16::from(bits));
            if bits % unit == 0 || !is_own {
                continue;
            }
            better = common(better, bits.into());
            first.get_or_insert((pdo, mapped, entry));
        }
    }
    let (pdo, mapped, entry) = first?;
    let what =
        format!("{pdo} maps {} of {}", pdos::bits(mapped.entry.bits()), pdos::place_of(context.sheet, entry));
    Some(Broken {
        severity: Severity::Warning,
        what,
        span: mapped.value.span(),
        label: "the mapping entry",
        better,
    })
}

/// The first object that can be mapped and is no multiple of the unit.
fn mappable(context: &Context<'_>, unit: u8) -> Option<Broken> {
    let mut first: Option<(String, DataType, Span)> = None;
    let mut better = unit.into();
    let objects = context.sheet.objects().map(|object| (object.index(), None, object.description()));
    let subs = context.sheet.sub_objects().map(|sub| (sub.index(), Some(sub.sub_index()), sub.description()));
    for (index, sub_index, description) in objects.chain(subs) {
        let Some(flag) = description.pdo_mapping().filter(|flag| flag.known() == Some(true)) else {
            continue;
        };
        let Some(data_type) = description.standard_type() else { continue };
        let Some(bits) = data_type.bits().filter(|bits| bits % u16::from(unit) != 0) else { continue };
        better = common(better, bits);
        if first.is_none() {
            let place = match sub_index {
                None => index.to_string(),
                Some(sub_index) => format!("{index} sub-index {sub_index}"),
            };
            first = Some((place, data_type, flag.span()));
        }
    }
    let (place, data_type, span) = first?;
    let what = format!("{place}, {data_type}, can be mapped");
    Some(Broken { severity: Severity::Info, what, span, label: "can be mapped", better })
}

/// The greatest unit that both are multiples of.
fn common(mut a: u16, mut b: u16) -> u16 {
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    fn found(unit: u8, bits: u8, object: &str) -> Vec<String> {
        let text = format!(
            "[DeviceInfo]\nGranularity={unit}\n[1A00]\nObjectType=9\n[1A00sub0]\nDataType=5\nDefaultValue=1\n[1A00sub1]\nDataType=7\nDefaultValue=0x200000{bits:02X}\n[2000]\n{object}\n"
        );
        findings(&GRANULARITY_VIOLATED, &text)
    }

    #[test]
    fn lengths_are_multiples() {
        assert_eq!(
            found(64, 16, "DataType=6"),
            ["2:13 warning: Granularity is 64 bits, but TPDO1 maps 16 bits of 2000h"]
        );
        assert!(found(8, 16, "DataType=6").is_empty() && found(1, 1, "DataType=1").is_empty());
        assert!(found(0, 1, "DataType=1").is_empty() && found(128, 8, "DataType=5").is_empty());
        assert!(found(8, 4, "DataType=5").is_empty());
        assert_eq!(
            found(8, 8, "DataType=1\nPDOMapping=1"),
            ["2:13 info: Granularity is 8 bits, but 2000h, BOOLEAN, can be mapped"]
        );
        assert_eq!([common(8, 1), common(64, 16), common(24, 16)], [1, 16, 8]);
    }
}
