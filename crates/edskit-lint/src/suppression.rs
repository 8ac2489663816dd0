//! Comments in a file that silence findings: `;edskit: allow(OBJ016) why`.

use crate::rules::syntax::unused_suppression::UNUSED_SUPPRESSION;
use crate::{Context, Edit, Finding, Report, Rule, RuleSet, find};
use edskit_model::{Line, LineKind, Span};

/// What such a comment begins with, behind its `;` and blanks.
const MARK: &str = "edskit:";

/// One rule that one comment silences.
struct Suppression {
    /// The comment's line, counted from 0.
    line: usize,
    /// The rule's name or code in the comment.
    selector: Span,
    /// What it names; empty for an unknown rule.
    rules: Vec<&'static Rule>,
    /// Where findings are silenced.
    scope: Span,
    used: bool,
}

/// Takes out the findings that comments of the file silence, and reports comments that silence nothing.
pub(crate) fn apply(context: &Context<'_>, rules: &RuleSet, findings: &mut Vec<Finding>) {
    let Comments { mut suppressions, misread } = read(context);
    if suppressions.is_empty() && misread.is_empty() {
        return;
    }
    findings.retain(|finding| {
        let silences = |suppression: &Suppression| {
            suppression.rules.contains(&finding.rule)
                && suppression.scope.contains(Span::at(finding.span().start))
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
    // Almost no file has one, and this is faster than a look at every line.
    if memchr::memmem::find(source, MARK.as_bytes()).is_none() {
        return Comments::default();
    }
    let lines = context.document().lines();
    let mut comments = Comments::default();
    for (number, line) in lines.iter().enumerate().filter(|(_, line)| line.kind() == LineKind::Comment) {
        let Some(order) = after_mark(source, line) else { continue };
        let Some((keyword, selectors)) = parse(source, order) else {
            comments.misread.push(line.trimmed(source));
            continue;
        };
        let scope = match keyword {
            Keyword::File => Span::new(0, source.len() as u32),
            Keyword::Next => next_scope(lines, number),
        };
        for selector in selectors {
            let rules = find(&String::from_utf8_lossy(selector.slice(source))).unwrap_or_default();
            comments.suppressions.push(Suppression { line: number, selector, rules, scope, used: false });
        }
    }
    comments
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Keyword {
    /// `allow(..)`: the next entry, or the next section with all its entries.
    Next,
    /// `allow-file(..)`: the file.
    File,
}

/// What a comment says behind the mark, where it has it.
fn after_mark(source: &[u8], line: &Line) -> Option<Span> {
    let span = line.trimmed(source);
    let text = span.slice(source).get(1..)?;
    let lead = text.len() - text.trim_ascii_start().len();
    let start = 1 + lead + MARK.len();
    text[lead..].starts_with(MARK.as_bytes()).then(|| span.sub(start, span.len() - start))
}

/// The keyword of such an order and the spans of the rules in its parentheses, at least one.
fn parse(source: &[u8], order: Span) -> Option<(Keyword, Vec<Span>)> {
    let text = order.slice(source);
    let lead = text.len() - text.trim_ascii_start().len();
    let forms = [("allow-file(", Keyword::File), ("allow(", Keyword::Next)];
    let (prefix, keyword) =
        forms.into_iter().find(|(prefix, _)| text[lead..].starts_with(prefix.as_bytes()))?;
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
fn next_scope(lines: &[Line], comment: usize) -> Span {
    let is_next = |line: &&Line| !matches!(line.kind(), LineKind::Comment | LineKind::Blank);
    let start = lines[comment].span().start;
    let Some(offset) = lines[comment..].iter().position(|line| is_next(&line)) else {
        return Span::at(start);
    };
    let next = comment + offset;
    if lines[next].kind() != LineKind::Section {
        return Span::new(start, lines[next].full_span().end);
    }
    let behind = lines[next + 1..].iter().position(|line| line.kind() == LineKind::Section);
    let last = behind.map_or(lines.len() - 1, |offset| next + offset);
    Span::new(start, lines[last].full_span().end)
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
    fn other_comments_mean_nothing() {
        let text = "[2000sub0]\n;edskit\n; see edskit: allow(OBJ013)\n;\nDataType=0x0007\n";
        assert_eq!(codes(text).len(), 1);
    }

    #[test]
    fn what_cannot_be_read_is_reported() {
        let orders = ["allow OBJ013", "alow(OBJ013)", "allow(OBJ013", "allow()", "Allow(OBJ013)", ""];
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
