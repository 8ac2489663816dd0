use super::structure::{counted_subs, sub0};
use crate::rule::rule;
use crate::{Context, Report};
use edskit_model::{Object, Value};
use edskit_types::{ObjectCode, SubIndex};

rule! {
    /// Sub-index 00h may name entries that are not described
    ///
    /// ## What it does
    /// Reports an ARRAY or RECORD whose sub-index 00h has a `HighLimit` above the highest described sub-index, while
    /// its default value fits. Objects without a described element, objects of the communication profile, whose limits
    /// CiA 301 gives, and limits beyond the last sub-index (FEh) are left alone.
    ///
    /// ## Why is this bad
    /// The limit says that the device can have more entries than the file describes. A tool that meets such an entry on
    /// the bus knows neither its type nor its name.
    ///
    /// ## Example
    /// ```eds
    /// [2010]
    /// ParameterName=Ramps
    /// ObjectType=0x8
    /// SubNumber=2
    ///
    /// [2010sub0]
    /// ParameterName=Highest sub-index
    /// DataType=0x0005
    /// DefaultValue=1
    /// HighLimit=2
    ///
    /// [2010sub1]
    /// ParameterName=Ramp up
    /// DataType=0x0006
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [2010]
    /// ParameterName=Ramps
    /// ObjectType=0x8
    /// SubNumber=3
    ///
    /// [2010sub0]
    /// ParameterName=Highest sub-index
    /// DataType=0x0005
    /// DefaultValue=1
    /// HighLimit=2
    ///
    /// [2010sub1]
    /// ParameterName=Ramp up
    /// DataType=0x0006
    ///
    /// [2010sub2]
    /// ParameterName=Ramp down
    /// DataType=0x0006
    /// ```
    ///
    /// ## References
    /// Engineering judgement: CiA 306 v1.3, 4.6.3.2 asks for the description of all sub-objects, also of those that
    /// exist only in some configurations.
    pub(crate) static SUB0_LIMIT_UNDESCRIBED = {
        code: "OBJ026",
        name: "sub0-limit-undescribed",
        group: Objects,
        severity: Info,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: Object(check),
    }
}

fn check(_: &Context<'_>, object: Object<'_>, report: &mut Report) {
    if (0x1000..=0x1FFF).contains(&object.index().0) {
        return;
    }
    let Some(sub0) = sub0(object) else { return };
    let Some(last) = counted_subs(object).next_back().filter(|last| last.sub_index().0 > 0) else { return };
    let Some(limit) = sub0.high_limit() else { return };
    let Some(Value::Integer(number)) = limit.known() else { return };
    // FEh is the last sub-index there can be, and 7Fh and FFh are ends of data types: they mean no limit.
    let Some(possible) = number.to::<u8>().filter(|&possible| possible < 0xFE && possible != 0x7F) else {
        return;
    };
    let highest = last.sub_index().0;
    let default = sub0.default_value().and_then(|field| field.known());
    let default_fits = default.is_none_or(|value| match value {
        Value::Integer(number) => number.value() <= i128::from(highest),
        _ => true,
    });
    if possible <= highest || !default_fits || object.compact_count() > 0 {
        return;
    }
    let Some(ObjectCode::Array | ObjectCode::Record) = object.object_code() else { return };
    let message = format!(
        "{} can have entries up to {}, but they are described only up to {}",
        object.index(),
        SubIndex(possible),
        last.sub_index()
    );
    let next = SubIndex(highest + 1);
    report
        .add(limit.span(), message)
        .label(last.section().span(), "the last one described")
        .help(format!("describe the entries from {next} on too, or write `HighLimit={highest}`"));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    fn finding(index: &str, sub0: &str, subs: &[u8]) -> String {
        let mut text = format!("[{index}]\nObjectType=8\n[{index}sub0]\nDataType=5\n{sub0}\n");
        for sub in subs {
            text += &format!("[{index}sub{sub:X}]\nDataType=5\n");
        }
        findings(&SUB0_LIMIT_UNDESCRIBED, &text).join("|")
    }

    #[test]
    fn limits_above_what_is_described() {
        assert_eq!(
            finding("2000", "HighLimit=7\nDefaultValue=6", &[1, 2, 3, 4, 5, 6]),
            "5:11 info: 2000h can have entries up to 07h, but they are described only up to 06h"
        );
        assert_eq!(finding("2000", "HighLimit=7", &[1, 7]), "");
        assert_eq!(finding("2000", "HighLimit=52", &[]), "", "no element is described");
        assert_eq!(finding("2000", "HighLimit=0xFF", &[1]), "", "the whole range of the type");
        assert_eq!(finding("2000", "HighLimit=7\nDefaultValue=7", &[1]), "", "the matter of OBJ014");
        assert_eq!(finding("1400", "HighLimit=5\nDefaultValue=2", &[1, 2]), "", "a limit of CiA 301");
    }
}
