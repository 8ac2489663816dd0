use crate::rule::rule;
use crate::{Context, Edit, Report};
use edskit_model::Number;

rule! {
    /// An index in a list lacks its `0x`
    ///
    /// ## What it does
    /// Reports an item without `0x` whose value names no described object, but would if it were hexadecimal. A correct
    /// decimal index, such as 4096 for 1000h, is legal.
    ///
    /// ## Why is this bad
    /// Without `0x` the number is decimal. The list names an object that does not exist, and the one that was meant
    /// is in no list.
    ///
    /// ## Example
    /// ```eds
    /// [MandatoryObjects]
    /// SupportedObjects=1
    /// 1=1000
    ///
    /// [1000]
    /// ParameterName=Device type
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [MandatoryObjects]
    /// SupportedObjects=1
    /// 1=0x1000
    ///
    /// [1000]
    /// ParameterName=Device type
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.3 and 4.6.3.1.
    pub(crate) static DECIMAL_INDEX = {
        code: "LST011",
        name: "decimal-index",
        group: Lists,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [EdsDcfCheck("LST006"), Dcfchk("invalid object index for entry")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for item in context.listing().items().iter().filter(|item| item.lacks_prefix) {
        let span = item.value_span(context.document());
        let raw = span.slice(context.source());
        // `100C` is no number at all, which is the matter of SYN017.
        let (Some(index), Ok(number)) = (item.index, Number::parse(raw)) else { continue };
        let text = context.sheet.text(span);
        let fixed = format!("0x{index:04X}");
        report
            .add(span, format!("`{text}` is not {index}: without `0x` it is {}", number.value()))
            .help(format!("write `{fixed}`"))
            .unsafe_fix("Make it hexadecimal", vec![Edit::replace(span, fixed)]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn a_decimal_that_names_an_object_is_legal() {
        let text = "[OptionalObjects]\n1=4119\n2=1005\n3=1006\n4=100C\n[1017]\n[1005]\n[100C]\n";
        assert_eq!(
            findings(&DECIMAL_INDEX, text),
            ["3:3 warning: `1005` is not 1005h: without `0x` it is 1005"]
        );
        assert_eq!(fixed(&DECIMAL_INDEX, text), text.replace("2=1005", "2=0x1005"));
    }
}
