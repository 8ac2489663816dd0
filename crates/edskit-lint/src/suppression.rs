//! Comments in a file that silence findings: `;edskit: allow(OBJ016) why`.

use crate::rules::syntax::unused_suppression::UNUSED_SUPPRESSION;
use crate::{Context, Edit, Finding, Report, Rule, RuleSet, find};
use edskit_model::{Line, LineKind, Object, Section, SectionKind, Span};
use std::rc::Rc;

/// What such a comment begins with, behind its `;` and blanks.
const MARK: &[u8] = b"edskit:";

/// One rule that one comment silences.
struct Suppression {
    /// The comment's line, counted from 0.
    line: usize,
    /// The rule's name or code in the comment.
    selector: Span,
    /// What it names; empty for an unknown rule.
    rules: Vec<&'static Rule>,
    /// Where findings are silenced: in one place or several, sorted.
    scope: Rc<[Span]>,
    used: bool,
}

impl Suppression {
    fn covers(&self, place: u32) -> bool {
        let begun = self.scope.partition_point(|scope| scope.start <= place);
        self.scope[..begun].last().is_some_and(|scope| scope.contains(Span::at(place)))
    }
}

/// Takes out the findings that comments of the file silence, and reports comments that silence nothing.
pub(crate) fn apply(context: &Context<'_>, rules: &RuleSet, findings: &mut Vec<Finding>) {
    let Comments { mut suppressions, misread } = read(context);
    if suppressions.is_empty() && misread.is_empty() {
        return;
    }
    findings.retain(|finding| {
        let silences = |suppression: &Suppression| {
            suppression.rules.contains(&finding.rule) && suppression.covers(finding.span().start)
        };
        let mut silenced = false;
        for suppression in suppressions.iter_mut().filter(|suppression| silences(suppression)) {
            suppression.used = true;
            silenced = true;
        }
        !silenced
    });
    if rules.is_enabled(&UNUSED_SUPPRESSION) {
        report_unused(context, rules, &suppressions, findings);
        report_misread(context, &misread, findings);
    }
}

fn report_misread(context: &Context<'_>, misread: &[Span], findings: &mut Vec<Finding>) {
    let mut report = Report::new(&UNUSED_SUPPRESSION);
    for &comment in misread {
        let text = context.sheet.text(comment);
        report
            .add(comment, format!("`{text}` allows nothing: it cannot be read"))
            .help("write `;edskit: allow(OBJ016) why` or `;edskit: allow-file(OBJ016) why`");
    }
    findings.append(&mut report.into_findings());
}

fn report_unused(
    context: &Context<'_>,
    rules: &RuleSet,
    suppressions: &[Suppression],
    findings: &mut Vec<Finding>,
) {
    let mut report = Report::new(&UNUSED_SUPPRESSION);
    for suppression in suppressions.iter().filter(|suppression| !suppression.used) {
        let selector = context.sheet.text(suppression.selector);
        if suppression.rules.is_empty() {
            let unknown = find(&selector).err().map(|error| error.to_string()).unwrap_or_default();
            report
                .add(suppression.selector, unknown)
                .help("write a code such as `OBJ016`, a name, or a prefix");
        } else if suppression.rules.iter().any(|rule| rules.is_enabled(rule)) {
            let line = context.document().lines()[suppression.line];
            let alone = suppressions.iter().filter(|other| other.line == suppression.line).count() == 1;
            let finding =
                report.add(suppression.selector, format!("`{selector}` finds nothing here to allow"));
            finding.help("take the comment out, so that it hides nothing later");
            if alone {
                finding.safe_fix("Take the comment out", vec![Edit::delete(line.full_span())]);
            }
        }
    }
    findings.append(&mut report.into_findings());
}

/// The comments of a file that are meant for this program.
#[derive(Default)]
struct Comments {
    suppressions: Vec<Suppression>,
    /// Those that are of no known form.
    misread: Vec<Span>,
}

fn read(context: &Context<'_>) -> Comments {
    let source = context.source();
    let mut comments = Comments::default();
    if !context.document().has_line(LineKind::Comment) {
        return comments;
    }
    let lines = context.document().lines();
    for (number, line) in lines.iter().enumerate().filter(|(_, line)| line.kind() == LineKind::Comment) {
        let Some(order) = after_mark(source, line) else { continue };
        let Some((keyword, selectors)) = parse(source, order) else {
            comments.misread.push(line.trimmed(source));
            continue;
        };
        let scope = match keyword {
            Keyword::File => [Span::new(0, source.len() as u32)].into(),
            Keyword::Next => next_scope(context, number),
        };
        for selector in selectors {
            let rules = find(&String::from_utf8_lossy(selector.slice(source))).unwrap_or_default();
            let scope = Rc::clone(&scope);
            comments.suppressions.push(Suppression { line: number, selector, rules, scope, used: false });
        }
    }
    comments
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Keyword {
    /// `allow(..)`: the next entry, or the next section with all that belongs to it.
    Next,
    /// `allow-file(..)`: the file.
    File,
}

/// Whether the text behind `;` is meant for this program: it has the mark, or nearly.
fn is_meant(comment: &[u8]) -> bool {
    let text = comment.trim_ascii_start();
    let Some((name, rest)) = text.split_at_checked(MARK.len() - 1) else { return false };
    if !name.eq_ignore_ascii_case(&MARK[..MARK.len() - 1]) {
        return false;
    }
    let rest = rest.trim_ascii_start();
    let begins = |word: &[u8]| rest.get(..word.len()).is_some_and(|start| start.eq_ignore_ascii_case(word));
    begins(b":") || begins(b"allow")
}

/// What a comment that is meant for this program says behind the mark; nothing where the mark is not whole.
fn after_mark(source: &[u8], line: &Line) -> Option<Span> {
    let comment = line.span().slice(source).trim_ascii_start().strip_prefix(b";")?;
    if !is_meant(comment) {
        return None;
    }
    let span = line.trimmed(source);
    let text = &span.slice(source)[1..];
    let lead = text.len() - text.trim_ascii_start().len();
    let start = 1 + lead + MARK.len();
    let has_mark = text[lead..].get(..MARK.len()).is_some_and(|mark| mark.eq_ignore_ascii_case(MARK));
    Some(if has_mark { span.sub(start, span.len() - start) } else { Span::at(span.end) })
}

/// The keyword of such an order and the spans of the rules in its parentheses, at least one.
fn parse(source: &[u8], order: Span) -> Option<(Keyword, Vec<Span>)> {
    let text = order.slice(source);
    let lead = text.len() - text.trim_ascii_start().len();
    let forms = [("allow-file(", Keyword::File), ("allow(", Keyword::Next)];
    let begins = |prefix: &str| {
        text[lead..].get(..prefix.len()).is_some_and(|start| start.eq_ignore_ascii_case(prefix.as_bytes()))
    };
    let (prefix, keyword) = forms.into_iter().find(|(prefix, _)| begins(prefix))?;
    let position = lead + prefix.len();
    let length = text[position..].iter().position(|&byte| byte == b')')?;
    let mut selectors = Vec::new();
    let mut start = position;
    for part in text[position..position + length].split(|&byte| byte == b',') {
        let lead = part.len() - part.trim_ascii_start().len();
        let selector = order.sub(start + lead, part.trim_ascii().len());
        if !selector.is_empty() {
            selectors.push(selector);
        }
        start += part.len() + 1;
    }
    (!selectors.is_empty()).then_some((keyword, selectors))
}

/// From the comment to the end of what stands next: an entry, any other line, or a section with all that belongs to it.
/// To an object belong its sub-objects and its lists, wherever they stand.
fn next_scope(context: &Context<'_>, comment: usize) -> Rc<[Span]> {
    let lines = context.document().lines();
    let is_next = |line: &&Line| !matches!(line.kind(), LineKind::Comment | LineKind::Blank);
    let start = lines[comment].span().start;
    let Some(offset) = lines[comment..].iter().position(|line| is_next(&line)) else {
        return [Span::at(start)].into();
    };
    let next = comment + offset;
    if lines[next].kind() != LineKind::Section {
        return [Span::new(start, lines[next].full_span().end)].into();
    }
    let mut scope = vec![Span::new(start, section_end(lines, next))];
    let section = context.sheet.section_at(lines[next].span().start);
    if let Some(SectionKind::Object(index)) = section.map(Section::kind) {
        let subs = context.sheet.object(index).into_iter().flat_map(Object::sub_objects);
        let lists = [
            SectionKind::ObjectLinks(index),
            SectionKind::CompactNames(index),
            SectionKind::CompactValues(index),
            SectionKind::CompactDenotations(index),
        ];
        let parts = subs.map(|sub| sub.section());
        let parts = parts.chain(lists.into_iter().filter_map(|kind| context.sheet.section(kind)));
        scope.extend(
            parts.map(|part| Span::new(part.line().span().start, section_end(lines, part.line_number()))),
        );
        scope.sort_unstable();
    }
    scope.into()
}

/// The end of the section with this header.
fn section_end(lines: &[Line], header: usize) -> u32 {
    let behind = lines[header + 1..].iter().position(|line| line.kind() == LineKind::Section);
    let last = behind.map_or(lines.len() - 1, |offset| header + offset);
    lines[last].full_span().end
}

#[cfg(test)]
mod tests {
    use crate::{FileKind, Linter, RuleSet};
    use edskit_model::Datasheet;

    fn codes(text: &str) -> Vec<String> {
        let mut rules = RuleSet::none();
        for rule in ["SYN013", "OBJ013", "unused-suppression"] {
            rules.select(rule).unwrap();
        }
        let sheet = Datasheet::parse(text.as_bytes());
        let findings = Linter::new(rules).lint(&sheet, FileKind::Eds, None);
        let place = |offset| sheet.document().position(offset);
        findings.iter().map(|f| format!("{} {} {}", place(f.span().start), f.rule.code, f.message)).collect()
    }

    #[test]
    fn the_next_entry_is_silenced() {
        let text = "[2000sub0]\n;edskit: allow(OBJ013) the device is old\n\nDataType=0x0007\n[2001sub0]\nDataType=0x0007\n";
        assert_eq!(codes(text), ["6:10 OBJ013 sub-index 00h of 2001h is UNSIGNED32 instead of UNSIGNED8"]);
    }

    #[test]
    fn the_next_section_is_silenced_whole() {
        let text = "; edskit: allow(sub0-not-u8)\n[2000sub0]\nParameterName=a\nDataType=0x0007\n[2001sub0]\nDataType=0x0007\n";
        assert_eq!(codes(text), ["6:10 OBJ013 sub-index 00h of 2001h is UNSIGNED32 instead of UNSIGNED8"]);
    }

    #[test]
    fn the_file_is_silenced_by_several_rules() {
        let text = "[2000]\n[2000]\n[2001sub0]\nDataType=0x0007\n;edskit: allow-file( SYN , OBJ013 )\n";
        assert_eq!(codes(text), Vec::<String>::new());
    }

    #[test]
    fn what_silences_nothing_is_reported() {
        let text = "[2000]\n;edskit: allow(SYN013)\nDataType=5\n;edskit: allow(no-such-thing, SYN000)\nx=1\n";
        let expected = [
            "2:16 SYN027 `SYN013` finds nothing here to allow",
            "4:16 SYN027 there is no rule `no-such-thing`",
        ];
        assert_eq!(codes(text), expected);
    }

    #[test]
    fn an_object_has_its_sub_objects_with_it() {
        let text = ";edskit: allow(OBJ013) why\n[2000]\nParameterName=a\n[2001sub0]\nDataType=0x0007\n[2000sub0]\nDataType=0x0007\n";
        assert_eq!(codes(text), ["5:10 OBJ013 sub-index 00h of 2001h is UNSIGNED32 instead of UNSIGNED8"]);
        let sub = text.replace("[2000]", "[2000sub1]");
        assert_eq!(codes(&sub).len(), 3, "a sub-object stands for itself");
    }

    #[test]
    fn case_does_not_matter_and_what_is_nearly_right_is_reported() {
        for comment in
            [";EDSKIT: allow(OBJ013)", "; EdsKit:ALLOW(obj013) why", " ;edskit: Allow-File(OBJ013)"]
        {
            let text = format!("[2000sub0]\n{comment}\nDataType=0x0007\n");
            assert_eq!(codes(&text), [""; 0], "{comment}");
        }
        for comment in [";edskit allow(OBJ013)", "; EDSKIT : allow(OBJ013)"] {
            let found = codes(&format!("[2000sub0]\n{comment}\nDataType=0x0007\n"));
            assert_eq!(found.len(), 2, "{comment}");
            assert!(found[0].contains("SYN027") && found[0].ends_with("cannot be read"), "{comment}");
        }
    }

    #[test]
    fn other_comments_mean_nothing() {
        let text = "[2000sub0]\n;edskit\n; see edskit: allow(OBJ013)\n;\nDataType=0x0007\n";
        assert_eq!(codes(text).len(), 1);
    }

    #[test]
    fn what_cannot_be_read_is_reported() {
        let orders = ["allow OBJ013", "alow(OBJ013)", "allow(OBJ013", "allow()", ""];
        for order in orders {
            let text = format!("[2000sub0]\n;edskit: {order}\nDataType=0x0007\n");
            let comment = format!(";edskit: {order}");
            let expected = [
                format!("2:1 SYN027 `{}` allows nothing: it cannot be read", comment.trim_end()),
                "3:10 OBJ013 sub-index 00h of 2000h is UNSIGNED32 instead of UNSIGNED8".to_owned(),
            ];
            assert_eq!(codes(&text), expected);
        }
    }
}
