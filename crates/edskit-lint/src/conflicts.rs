//! Conflicts that a version control system left in a file: two texts in the place of one.

use crate::Finding;
use edskit_model::{Datasheet, Document, Line, LineKind, Span, is_merge_marker};

/// A conflict, by the numbers of its markers' lines: `<<<<<<<`, `|||||||` in the style of diff3, `=======`, `>>>>>>>`.
pub(crate) struct Conflict {
    start: usize,
    base: Option<usize>,
    separator: usize,
    end: usize,
}

/// One of the two texts that a conflict leaves to choose from.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Side {
    Ours,
    Theirs,
}

/// The conflicts of a file.
#[derive(Default)]
pub(crate) struct Conflicts {
    whole: Vec<Conflict>,
    /// The lines of markers that belong to no whole conflict.
    stray: Vec<usize>,
}

impl Conflicts {
    /// Finds them.
    pub(crate) fn of(document: &Document) -> Self {
        let mut found = Self::default();
        if !document.has_line(LineKind::Other) {
            return found;
        }
        // The markers of the conflict that is open: where it starts, its base, its separator.
        let mut open: Option<(usize, Option<usize>, Option<usize>)> = None;
        for (number, line) in document.lines().iter().enumerate() {
            let Some(mark) = marker(document, line) else { continue };
            match (mark, open) {
                (b'|', Some((start, None, None))) => open = Some((start, Some(number), None)),
                (b'=', Some((start, base, None))) => open = Some((start, base, Some(number))),
                (b'>', Some((start, base, Some(separator)))) => {
                    found.whole.push(Conflict { start, base, separator, end: number });
                    open = None;
                }
                (b'<', before) => {
                    found.leave(before);
                    open = Some((number, None, None));
                }
                _ => found.stray.push(number),
            }
        }
        found.leave(open);
        found.stray.sort_unstable();
        found
    }

    /// The markers of a conflict that does not end.
    fn leave(&mut self, open: Option<(usize, Option<usize>, Option<usize>)>) {
        if let Some((start, base, separator)) = open {
            self.stray.extend([Some(start), base, separator].into_iter().flatten());
        }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.whole.is_empty() && self.stray.is_empty()
    }

    pub(crate) fn whole(&self) -> &[Conflict] {
        &self.whole
    }

    pub(crate) fn stray(&self) -> &[usize] {
        &self.stray
    }

    /// The file as it is read once either side is taken everywhere. What is left out is blank, so that every place
    /// stays where it is.
    pub(crate) fn sides(&self, document: &Document) -> [Datasheet; 2] {
        [Side::Ours, Side::Theirs].map(|side| {
            let mut bytes = document.to_bytes().to_vec();
            let left_out = self.whole.iter().flat_map(|conflict| conflict.left_out(side));
            for number in left_out.chain(self.stray.iter().copied()) {
                let span = document.lines()[number].span();
                bytes[span.start as usize..span.end as usize].fill(b' ');
            }
            Datasheet::new(Document::from_vec(bytes))
        })
    }

    /// What is found whichever side is taken, and outside of all conflicts; both come in the order of the file. A fix
    /// stays if it is the same for both sides and touches no conflict. Where it is not even clear which lines belong to
    /// one, no fix does.
    pub(crate) fn common(&self, document: &Document, ours: Vec<Finding>, theirs: &[Finding]) -> Vec<Finding> {
        let mut common = Vec::new();
        let mut from = 0;
        for mut finding in ours {
            while theirs.get(from).is_some_and(|other| other.place() < finding.place()) {
                from += 1;
            }
            let mut alike = theirs[from..].iter().take_while(|other| other.place() == finding.place());
            let is_same =
                |other: &&Finding| (other.severity, &other.message) == (finding.severity, &finding.message);
            let Some(other) = alike.find(is_same) else { continue };
            if self.touches(document, finding.span()) && !self.begins_one(document, finding.span()) {
                continue;
            }
            finding.fix = finding.fix.filter(|fix| {
                self.stray.is_empty()
                    && other.fix.as_ref() == Some(fix)
                    && fix.edits.iter().all(|edit| !self.touches(document, edit.span))
            });
            common.push(finding);
        }
        common
    }

    /// Whether a place is the first marker of a conflict, where the conflict itself is reported.
    fn begins_one(&self, document: &Document, span: Span) -> bool {
        self.whole.binary_search_by_key(&span.start, |conflict| conflict.span(document).start).is_ok()
    }

    /// Whether a place is in a conflict, or directly at its edge.
    fn touches(&self, document: &Document, span: Span) -> bool {
        let end = span.end.max(span.start + 1);
        let begun = self.whole.partition_point(|conflict| conflict.span(document).start < end);
        self.whole[..begun].last().is_some_and(|conflict| span.start < conflict.span(document).end)
    }
}

impl Conflict {
    /// From the first marker to the end of the last one's line.
    pub(crate) fn span(&self, document: &Document) -> Span {
        let lines = document.lines();
        Span::new(lines[self.start].span().start, lines[self.end].full_span().end)
    }

    /// The lines of the markers, in the order of the file.
    pub(crate) fn markers(&self) -> impl Iterator<Item = usize> {
        [Some(self.start), self.base, Some(self.separator), Some(self.end)].into_iter().flatten()
    }

    /// The lines that are gone once a side is taken, the markers among them.
    fn left_out(&self, side: Side) -> impl Iterator<Item = usize> {
        let kept = match side {
            Side::Ours => self.start + 1..self.base.unwrap_or(self.separator),
            Side::Theirs => self.separator + 1..self.end,
        };
        (self.start..=self.end).filter(move |number| !kept.contains(number))
    }
}

/// The character of a marker, which stands seven times at the start of its line.
fn marker(document: &Document, line: &Line) -> Option<u8> {
    if line.kind() != LineKind::Other {
        return None;
    }
    let text = document.slice(line.span());
    // A conflict between ancestors has longer markers and belongs to the base as a whole.
    (is_merge_marker(text) && text.get(7) != Some(&text[0])).then(|| text[0])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn conflicts(text: &str) -> (Vec<Vec<usize>>, Vec<usize>) {
        let found = Conflicts::of(&Document::parse(text.as_bytes()));
        (found.whole.iter().map(|conflict| conflict.markers().collect()).collect(), found.stray)
    }

    #[test]
    fn both_styles_are_found_and_what_is_not_whole_is_stray() {
        let merge = "<<<<<<< HEAD\na=1\n=======\na=2\n>>>>>>> b=c\n";
        let diff3 = "<<<<<<< HEAD\na=1\n||||||| base\na=0\n=======\na=2\n>>>>>>> b\n";
        assert_eq!(conflicts(merge), (vec![vec![0, 2, 4]], vec![]));
        assert_eq!(conflicts(&diff3.replace('\n', "\r\n")), (vec![vec![0, 2, 4, 6]], vec![]));
        assert_eq!(conflicts(&format!("{diff3}x=1\n{merge}")).0.len(), 2);
        assert_eq!(conflicts("<<<<<<< HEAD\na=1\n=======\na=2\n"), (vec![], vec![0, 2]));
        assert_eq!(conflicts("a=1\n=======\na=2\n>>>>>>> b\n"), (vec![], vec![1, 3]));
        assert_eq!(conflicts(&format!("<<<<<<< lost\n{merge}")), (vec![vec![1, 3, 5]], vec![0]));
        assert_eq!(conflicts("[Comments]\nLine1=<<<<<<< HEAD\n;=======\n"), (vec![], vec![]));
    }

    #[test]
    fn a_conflict_of_ancestors_belongs_to_the_base() {
        let text = "<<<<<<< HEAD\na=1\n||||||| base\n<<<<<<<<< one\na=3\n=========\na=4\n>>>>>>>>> two\n=======\na=2\n>>>>>>> b\n";
        assert_eq!(conflicts(text), (vec![vec![0, 2, 8, 10]], vec![]));
    }

    #[test]
    fn a_side_has_its_own_lines_at_their_place() {
        let text =
            "x=1\r\n<<<<<<< HEAD\r\na=1\r\n||||||| base\r\na=0\r\n=======\r\na=2\r\n>>>>>>> b\r\ny=1\r\n";
        let document = Document::parse(text.as_bytes());
        let sides = Conflicts::of(&document).sides(&document);
        let shown = sides.map(|sheet| String::from_utf8(sheet.document().to_bytes().to_vec()).unwrap());
        assert!(shown.iter().all(|side| side.len() == text.len()));
        let lines = shown.map(|side| side.split_whitespace().map(str::to_owned).collect::<Vec<_>>());
        assert_eq!(
            lines,
            [["x=1", "a=1", "y=1"], ["x=1", "a=2", "y=1"]].map(|side| side.map(str::to_owned).to_vec())
        );
    }
}
