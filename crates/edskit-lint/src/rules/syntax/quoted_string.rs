use super::typed;
use crate::rule::rule;
use crate::{Context, Edit, Report};
use edskit_model::{Entry, KeyName, Shape};
use edskit_types::DataTypeKind;

rule! {
    /// A text stands in quotes
    ///
    /// ## What it does
    /// Reports texts that begin and end with `"`: names, and values of string types.
    ///
    /// ## Why is this bad
    /// CiA 306 knows no quotes, so they belong to the text. The device gets them too, two characters more than meant.
    ///
    /// ## Example
    /// ```eds
    /// [1008]
    /// DataType=0x0009
    /// DefaultValue="Example"
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1008]
    /// DataType=0x0009
    /// DefaultValue=Example
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.3.
    pub(crate) static QUOTED_STRING = {
        code: "SYN019",
        name: "quoted-string",
        group: Syntax,
        severity: Info,
        since: "0.1.0",
        files: ALL_FILES,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for entry in context.odd_entries() {
        let [b'"', inner @ .., b'"'] = entry.raw() else { continue };
        if inner.contains(&b'"') || !is_text(entry) {
            continue;
        }
        let span = entry.value_span();
        let text = context.sheet.text(span.sub(1, inner.len()));
        let edits = vec![Edit::delete(span.sub(0, 1)), Edit::delete(span.sub(span.len() - 1, 1))];
        report
            .add(span, format!("the quotes belong to the text of `{}`", entry.key_text()))
            .help(format!("write `{}={text}`", entry.key_text()))
            .unsafe_fix("Delete the quotes", edits);
    }
}

fn is_text(entry: Entry<'_>) -> bool {
    match typed::shape(entry) {
        Shape::Text(_) => entry.key().name != KeyName::Unknown,
        Shape::Value => {
            let kind = entry.section().and_then(typed::data_type).map(|known| known.kind());
            matches!(kind, None | Some(DataTypeKind::VisibleString | DataTypeKind::UnicodeString))
        }
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn only_whole_texts_in_quotes_are_meant() {
        let text = "[DeviceInfo]\nVendorName=\"\"\nProductName=\"A\" and \"B\"\nOrderCode=\"\nGranularity=\"8\"\n\
                    [2000]\nDataType=0x9\nDefaultValue= \"x y\"\n[2001]\nDataType=0x7\nDefaultValue=\"5\"\n\
                    [Tool]\nName=\"z\"\n";
        assert_eq!(
            findings(&QUOTED_STRING, text),
            [
                "2:12 info: the quotes belong to the text of `VendorName`",
                "8:15 info: the quotes belong to the text of `DefaultValue`",
            ]
        );
        let mended = fixed(&QUOTED_STRING, text);
        assert!(mended.contains("VendorName=\n") && mended.contains("DefaultValue= x y\n"), "{mended}");
    }
}
