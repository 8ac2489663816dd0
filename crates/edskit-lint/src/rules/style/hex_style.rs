use crate::rule::rule;
use crate::{Context, Edit, Report};
use edskit_model::{Entry, KeyName, Number, Shape, Span};

rule! {
    /// Hexadecimal numbers are written in several ways
    ///
    /// ## What it does
    /// Reports a file that writes hexadecimal digits both as `a` to `f` and as `A` to `F`, and one that writes `0X` for
    /// `0x`. There is one finding of each kind, at the first number that differs from most. Text is left alone. Off by
    /// default: it makes no difference to readers.
    ///
    /// ## Why is this bad
    /// A search for a number finds only some of its places.
    ///
    /// ## Example
    /// ```eds
    /// [1018sub1]
    /// ParameterName=Vendor-ID
    /// DataType=0x0007
    /// DefaultValue=0X161
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1018sub1]
    /// ParameterName=Vendor-ID
    /// DataType=0x0007
    /// DefaultValue=0x161
    /// ```
    ///
    /// ## References
    /// Engineering judgement: CiA 306 v1.3, 4.3 leaves both to the author.
    pub(crate) static HEX_STYLE = {
        code: "STY002",
        name: "hex-style",
        group: Style,
        severity: Info,
        enabled: false,
        since: "0.1.0",
        files: ALL_FILES,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let (mut lower, mut upper, mut prefix) = (Vec::new(), Vec::new(), Vec::new());
    for entry in context.sheet.entries() {
        let [b'0', x @ (b'x' | b'X'), digits @ ..] = entry.raw() else { continue };
        if !is_number(entry) {
            continue;
        }
        if *x == b'X' {
            prefix.push(entry.value_span().sub(1, 1));
        }
        if digits.iter().any(u8::is_ascii_lowercase) {
            lower.push(entry.value_span());
        }
        if digits.iter().any(u8::is_ascii_uppercase) {
            upper.push(entry.value_span());
        }
    }
    if let [first, ..] = prefix[..] {
        report
            .add(first, format!("{} with `0X`", numbers(prefix.len())))
            .help("write `0x`")
            .safe_fix("Write 0x", prefix.iter().map(|span| Edit::replace(*span, "x")).collect());
    }
    let (few, many, is_upper) =
        if lower.len() > upper.len() { (upper, lower, false) } else { (lower, upper, true) };
    let ([first, ..], [usual, ..]) = (&few[..], &many[..]) else { return };
    let (these, those) = if is_upper { ("lower", "upper") } else { ("upper", "lower") };
    let changed = |span: &Span| {
        let text = context.sheet.text(*span);
        let digits = &text[2..];
        let digits = if is_upper { digits.to_ascii_uppercase() } else { digits.to_ascii_lowercase() };
        Edit::replace(span.sub(2, digits.len()), digits)
    };
    report
        .add(*first, format!("{} in {these} case, {} in {those} case", numbers(few.len()), many.len()))
        .label(*usual, format!("{those} case"))
        .help(format!("write all of them in {those} case"))
        .safe_fix(format!("Write {those} case"), few.iter().map(changed).collect());
}

fn numbers(count: usize) -> String {
    match count {
        1 => "1 hexadecimal number is written".to_owned(),
        _ => format!("{count} hexadecimal numbers are written"),
    }
}

/// Whether a value that begins like a hexadecimal number is one, and no text.
fn is_number(entry: Entry<'_>) -> bool {
    let name = entry.key().name;
    let may_be = match name.shape() {
        Shape::Unsigned(_) | Shape::Flag | Shape::ObjectCode => true,
        Shape::Special => {
            name == KeyName::Item && entry.section().is_some_and(|section| section.kind().is_object_list())
        }
        Shape::Value => {
            let description = entry.section().and_then(|section| section.description());
            description
                .and_then(|description| description.standard_type())
                .is_some_and(|kind| kind.is_integer())
        }
        Shape::Text(_) | Shape::Edition | Shape::Time | Shape::Date | Shape::Access => false,
    };
    may_be && Number::parse(entry.raw()).is_ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn the_majority_decides() {
        let text = "[1018]\nDataType=0x001a\nObjFlags=0x0A\nDefaultValue=0xB\nSubNumber=0x1b\n[OptionalObjects]\n1=0x100C\n";
        assert_eq!(
            findings(&HEX_STYLE, text),
            ["2:10 info: 2 hexadecimal numbers are written in lower case, 3 in upper case"]
        );
        assert_eq!(fixed(&HEX_STYLE, text), text.replace("1a", "1A").replace("1b", "1B"));
        let text = "[2000]\nDataType=0x001a\nObjFlags=0x0a\n[2001]\nDataType=0X001C\n";
        assert_eq!(
            findings(&HEX_STYLE, text),
            [
                "5:10 info: 1 hexadecimal number is written in upper case, 2 in lower case",
                "5:11 info: 1 hexadecimal number is written with `0X`"
            ]
        );
    }

    #[test]
    fn text_is_left_alone() {
        let text = "[2000]\nDataType=0x0009\nDefaultValue=0xab\nParameterName=0xCD\nObjFlags=0xA\n[2001]\nDataType=9\nDefaultValue=0Xff\n[2100Name]\n1=0xab\n";
        assert!(findings(&HEX_STYLE, text).is_empty());
    }
}
