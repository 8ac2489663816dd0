use crate::rule::rule;
use crate::{Context, Report};
use edskit_model::{Entry, KeyName, Shape};

rule! {
    /// A text is a placeholder
    ///
    /// ## What it does
    /// Reports texts such as names and order codes that begin with `TODO`, `TBD` or `FIXME`, that are nothing but
    /// `unknown`, `undefined`, `placeholder`, `xxx` or `???`, or that are the blank of a form: `<name>`, `${name}`.
    ///
    /// ## Why is this bad
    /// The file was not finished. Its users see the text in their tools.
    ///
    /// ## Example
    /// ```eds
    /// [DeviceInfo]
    /// VendorName=Example drives
    /// OrderCode=TODO
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [DeviceInfo]
    /// VendorName=Example drives
    /// OrderCode=ED-400
    /// ```
    ///
    /// ## References
    /// Engineering judgement: such texts are never meant to stay.
    pub(crate) static PLACEHOLDER_TEXT = {
        code: "STY004",
        name: "placeholder-text",
        group: Style,
        severity: Info,
        since: "0.1.0",
        files: ALL_FILES,
        check: Entry(check),
    }
}

fn check(_: &Context<'_>, entry: Entry<'_>, report: &mut Report) {
    let name = entry.key().name;
    if !matches!(name.shape(), Shape::Text(_))
        || matches!(name, KeyName::Unknown | KeyName::Line | KeyName::Command)
    {
        return;
    }
    if is_placeholder(entry.raw()) {
        report
            .add(entry.value_span(), format!("{} is still `{}`", entry.key_text(), entry.text()))
            .help("write what belongs here");
    }
}

fn is_placeholder(text: &[u8]) -> bool {
    match text {
        [b'<', .., b'>'] | [b'$', b'{', .., b'}'] => true,
        [b'?', rest @ ..] => rest.iter().all(|&byte| byte == b'?'),
        [b'x' | b'X', rest @ ..] => {
            rest.len() >= 2 && rest.iter().all(|byte| byte.eq_ignore_ascii_case(&b'x'))
        }
        [b't' | b'T' | b'f' | b'F', ..] => {
            let word = text.split(|byte| !byte.is_ascii_alphanumeric()).next().unwrap_or_default();
            ["todo", "tbd", "fixme"].iter().any(|known| word.eq_ignore_ascii_case(known.as_bytes()))
        }
        [b'u' | b'U' | b'p' | b'P', ..] => ["unknown", "undefined", "placeholder"]
            .iter()
            .any(|known| text.eq_ignore_ascii_case(known.as_bytes())),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn placeholders_and_texts() {
        for text in
            ["TODO", "todo: name", "TBD.", "Unknown", "xxx", "XXXX", "?", "<!date>", "${name}", "FIXME"]
        {
            assert!(is_placeholder(text.as_bytes()), "{text}");
        }
        for text in ["", "x", "xx", "Todor", "Unknown device", "Total", "a<b>", "<", "Position X", "Figure"] {
            assert!(!is_placeholder(text.as_bytes()), "{text}");
        }
    }

    #[test]
    fn only_texts_are_read() {
        let text = "[2000]\nParameterName=TODO\nAccessType=unknown\nDefaultValue=TODO\nMyKey=TODO\n[Comments]\nLine1=TODO\n";
        assert_eq!(findings(&PLACEHOLDER_TEXT, text), ["2:15 info: ParameterName is still `TODO`"]);
    }
}
