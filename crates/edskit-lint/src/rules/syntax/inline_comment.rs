use super::typed;
use crate::rule::rule;
use crate::{Context, Edit, Report};
use edskit_model::meant::value_length;
use edskit_model::{Entry, KeyName, Number, Shape, Span};

rule! {
    /// A comment stands behind a value
    ///
    /// ## What it does
    /// Reports a blank and `;` or `#` behind a number, a flag, an access type, a date or whatever else is no free text.
    /// In a text, such as a name, both characters are allowed.
    ///
    /// ## Why is this bad
    /// CiA 306 knows no comment at the end of a line: it belongs to the value. Some readers cut it off, the others see
    /// no number.
    ///
    /// ## Example
    /// ```eds
    /// [1000]
    /// ParameterName=Device type
    /// DataType=0x0007 ; UNSIGNED32
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1000]
    /// ParameterName=Device type
    /// ; UNSIGNED32
    /// DataType=0x0007
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.2.
    pub(crate) static INLINE_COMMENT = {
        code: "SYN012",
        name: "inline-comment",
        group: Syntax,
        severity: Error,
        since: "0.1.0",
        files: ALL_FILES,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for entry in context.odd_entries() {
        let raw = entry.raw();
        let Some(length) = value_length(raw) else { continue };
        if !is_no_text(entry, &raw[..length]) {
            continue;
        }
        let value = entry.value_span();
        let comment = Span::new(value.start + length as u32, value.end);
        let mark = raw[length..].iter().position(|byte| !byte.is_ascii_whitespace()).unwrap_or(0);
        let place = comment.sub(mark, comment.len());
        let text = context.sheet.text(place.sub(1, place.len()));
        let value_text = context.sheet.text(value.sub(0, length));
        let line = entry.line();
        let line_break = context.document().line_ending().as_str();
        let edits = vec![
            Edit::insert(line.span().start, format!(";{text}{line_break}")),
            Edit::delete(Span::new(comment.start, line.span().end)),
        ];
        report
            .add(place, format!("what follows `{value_text}` is no comment but belongs to the value"))
            .help(format!("write `;{text}` in a line of its own above"))
            .safe_fix("Write the comment above", edits);
    }
}

/// Whether the value of an entry is anything but free text; `value` is what stands before the mark.
fn is_no_text(entry: Entry<'_>, value: &[u8]) -> bool {
    match typed::shape(entry) {
        Shape::Text(_) => false,
        Shape::Value => {
            let data_type = entry.section().and_then(typed::data_type);
            let is_short = data_type.is_some_and(|known| known.is_numeric() || known.bits() == Some(1));
            is_short || (data_type.is_none() && Number::parse(value).is_ok())
        }
        // `0;8` has a meaning of its own there.
        Shape::Special => entry.key().name != KeyName::Count,
        _ => true,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn numbers_flags_and_words_have_no_comments() {
        let text = "[1000]\nDataType=7 ;a\nAccessType=ro\t# b\nDefaultValue=5 ; c\nPDOMapping= ;d\n";
        assert_eq!(
            findings(&INLINE_COMMENT, text),
            [
                "2:12 error: what follows `7` is no comment but belongs to the value",
                "3:15 error: what follows `ro` is no comment but belongs to the value",
                "4:16 error: what follows `5` is no comment but belongs to the value",
            ]
        );
        assert_eq!(
            fixed(&INLINE_COMMENT, text),
            "[1000]\n;a\nDataType=7\n; b\nAccessType=ro\n; c\nDefaultValue=5\nPDOMapping= ;d\n"
        );
    }

    #[test]
    fn texts_may_hold_both_marks() {
        for text in [
            "[1000]\nParameterName=Object #1 ; x\n",
            "[1000]\nDataType=0x9\nDefaultValue=5 #1\n",
            "[1000]\nDefaultValue=five #1\n",
            "[1000Name]\n1=Object #1\n",
            "[M1SubExt6000]\nCount=0 ;2\n",
            "[x]\na=1 ; b\n",
            "[1000]\n;DataType=7 ;a\n",
        ] {
            assert_eq!(findings(&INLINE_COMMENT, text), [""; 0], "{text}");
        }
        assert_eq!(findings(&INLINE_COMMENT, "[MandatoryObjects]\n1=0x1000 ; a\n").len(), 1);
    }
}
