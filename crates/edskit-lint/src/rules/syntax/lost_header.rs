//! Section headers at the end of another line, because the line break between them was lost: `50[FileInfo]`.

use super::{typed, unknown_section};
use crate::Context;
use edskit_model::{Entry, Key, KeyGroup, KeyName, LineKind, SectionKind, Shape, Span};

/// The header at the end of a line, counted from 0, that is no header line itself.
pub(super) fn on_line(context: &Context<'_>, number: usize) -> Option<Span> {
    let source = context.source();
    let line = context.document().lines().get(number)?;
    if !matches!(line.kind(), LineKind::Entry | LineKind::Other) {
        return None;
    }
    let content = line.trimmed(source);
    let text = content.slice(source);
    let name = text.strip_suffix(b"]")?;
    let open = name.iter().rposition(|&byte| byte == b'[').filter(|&open| open > 0)?;
    let kind = SectionKind::of(&name[open + 1..]);
    let header = Span::new(content.start + open as u32, content.end);
    if kind == SectionKind::Unknown {
        return None;
    }
    let entry = context.sheet.entry_on_line(number);
    let is_number = entry.is_some_and(|entry| !matches!(typed::shape(entry), Shape::Text(_) | Shape::Value));
    (is_number || is_missed(context, number, kind)).then_some(header)
}

/// Whether any line hides a header.
pub(super) fn is_anywhere(context: &Context<'_>) -> bool {
    (0..context.document().lines().len()).any(|number| on_line(context, number).is_some())
}

/// The sections whose headers stand behind other text, sorted.
pub(crate) fn hidden(context: &Context<'_>) -> Vec<SectionKind> {
    let headers = (0..context.document().lines().len()).filter_map(|number| on_line(context, number));
    let name = |header: Span| header.sub(1, header.len() - 2).slice(context.source());
    let mut hidden: Vec<SectionKind> = headers.map(|header| SectionKind::of(name(header))).collect();
    hidden.extend(unknown_section::meant(context));
    hidden.sort_unstable();
    hidden
}

/// Whether the header of a section stands behind other text, which SYN008 reports, or is misspelt, which SYN023 reports:
/// the section is not missing.
pub(crate) fn hides(context: &Context<'_>, kind: SectionKind) -> bool {
    context.hidden_sections().binary_search(&kind).is_ok()
}

/// Whether a section is nowhere else, and the next entry is one that belongs into it. A text may well name an object:
/// `Target [6081]`.
fn is_missed(context: &Context<'_>, number: usize, kind: SectionKind) -> bool {
    let lines = context.document().lines();
    let mut following = (number + 1..lines.len())
        .filter(|&next| !matches!(lines[next].kind(), LineKind::Blank | LineKind::Comment));
    let next = following.next().and_then(|next| context.sheet.entry_on_line(next));
    let group = KeyGroup::of(kind);
    let belongs = |entry: Entry<'_>| {
        let key = Key::of(group, entry.key_span().slice(context.source())).name;
        if kind.is_description() { key == KeyName::ParameterName } else { key != KeyName::Unknown }
    };
    next.is_some_and(belongs) && context.sheet.section(kind).is_none()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::FileKind;
    use edskit_model::Datasheet;

    fn found(text: &str) -> Vec<String> {
        let sheet = Datasheet::parse(text.as_bytes());
        let context = Context::new(&sheet, FileKind::Eds, None);
        let headers = (0..sheet.document().lines().len()).filter_map(|number| on_line(&context, number));
        headers.map(|header| sheet.text(header).into_owned()).collect()
    }

    #[test]
    fn a_header_behind_a_number_is_lost() {
        assert_eq!(found("[1000]\nPDOMapping=0[1001]\n[1001]\n"), ["[1001]"]);
        assert_eq!(found("50[FileInfo]\n\nFileName=a\n"), ["[FileInfo]"]);
        assert_eq!(found("[1000]\nDefaultValue=5[1001] \nParameterName=a\n"), ["[1001]"]);
    }

    #[test]
    fn a_hidden_section_is_known_by_its_kind() {
        let sheet = Datasheet::parse(b"50[FileInfo]\nFileName=a\n[1000]\n");
        let context = Context::new(&sheet, FileKind::Eds, None);
        assert!(hides(&context, SectionKind::FileInfo) && !hides(&context, SectionKind::DeviceInfo));
    }

    #[test]
    fn a_text_may_name_a_section() {
        for text in [
            "[1000]\nParameterName=Target [6081]\nDataType=7\n",
            "[1000]\nParameterName=Target [6081]\n[6081]\nParameterName=a\n",
            "[1000]\nParameterName=Speed [rpm]\nParameterName=a\n",
            "[1000]\n[1001]\n;a [1002]\nParameterName=a\n",
        ] {
            assert_eq!(found(text), [""; 0], "{text}");
        }
        assert_eq!(found("[1000]\nParameterName=Target[6081]\n; a\nParameterName=b\n"), ["[6081]"]);
    }
}
