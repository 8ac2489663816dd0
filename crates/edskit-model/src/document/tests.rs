use super::*;
use proptest::prelude::*;

fn kinds(text: &str) -> Vec<LineKind> {
    Document::parse(text.as_bytes()).lines().iter().map(Line::kind).collect()
}

/// The lines must tile the file: the invariant that makes a document lossless.
fn assert_tiles(document: &Document) {
    let mut offset = document.byte_order_mark().map_or(0, |mark| mark.end);
    for line in document.lines() {
        assert_eq!(line.full_span().start, offset);
        offset = line.full_span().end;
        assert_eq!(document.slice(line.ending_span()), line.ending().as_str().as_bytes());
    }
    assert_eq!(offset as usize, document.to_bytes().len());
}

#[test]
fn every_kind_of_line_is_recognised() {
    use LineKind::*;
    let text = "[A]\n  [B]\n[C] x\n[D\nkey=value\n key = value\n;c\n  ; c\n#c\n#a=b\n\n \t\n=x\ntext\n=======\n<<<<<<< HEAD\n>>>>>>> a=b\n\u{1a}";
    assert_eq!(
        kinds(text),
        [
            Section, Section, Section, Section, Entry, Entry, Comment, Comment, Comment, Comment, Blank,
            Blank, Other, Other, Other, Other, Other, Other
        ]
    );
}

#[test]
fn parts_of_lines_have_spans() {
    let document = Document::parse(b"  [1018sub1] ; id\n\tDataType = 0x0007 \nDefaultValue=");
    let source = document.to_bytes();
    let [header, entry, empty] = document.lines() else { panic!("three lines") };
    assert_eq!(document.text(header.section_name(source)), "1018sub1");
    assert_eq!(document.text(header.after_header(source)), "; id");
    assert_eq!(document.text(header.closing_bracket().unwrap()), "]");
    assert_eq!(document.text(entry.key(source)), "DataType");
    assert_eq!(document.text(entry.value(source)), "0x0007");
    assert_eq!(entry.indentation(source).len(), 1);
    assert_eq!(entry.trailing_blanks(source).len(), 1);
    assert!(empty.value(source).is_empty());
}

#[test]
fn brackets_missing_and_doubled() {
    let document = Document::parse(b"[1018\n[a]b]\n[]\n[");
    let source = document.to_bytes();
    let names: Vec<_> =
        document.lines().iter().map(|line| document.text(line.section_name(source))).collect();
    assert_eq!(names, ["1018", "a", "", ""]);
    assert_eq!(document.lines()[0].closing_bracket(), None);
    assert_eq!(document.text(document.lines()[1].after_header(source)), "b]");
}

#[test]
fn line_endings_are_counted_and_the_majority_is_known() {
    let document = Document::parse(b"a=1\r\nb=2\nc=3\r\nd=4\re=5");
    assert_eq!(document.line_ending(), LineEnding::CrLf);
    assert_eq!(document.count_of(LineEnding::CrLf), 2);
    assert_eq!(document.count_of(LineEnding::Lf), 1);
    assert_eq!(document.count_of(LineEnding::Cr), 1);
    assert_eq!(document.lines().last().unwrap().ending(), LineEnding::None);
    assert_tiles(&document);
}

#[test]
fn a_byte_order_mark_is_not_part_of_the_first_line() {
    let document = Document::parse(b"\xEF\xBB\xBF[FileInfo]\n");
    assert_eq!(document.byte_order_mark(), Some(Span::new(0, 3)));
    assert_eq!(document.lines()[0].kind(), LineKind::Section);
    assert_eq!(document.position(3), Position { line: 1, column: 1 });
    assert_tiles(&document);
}

#[test]
fn columns_count_characters_in_either_encoding() {
    let utf8 = Document::parse("a=ü€x\nb=1".as_bytes());
    assert_eq!(utf8.encoding(), Encoding::Utf8);
    assert_eq!(utf8.position(7), Position { line: 1, column: 5 });
    let latin = Document::parse(b"a=\xFCx");
    assert_eq!(latin.encoding(), Encoding::Windows1252);
    assert_eq!(latin.position(3), Position { line: 1, column: 4 });
    assert_eq!(latin.text(latin.lines()[0].value(latin.to_bytes())), "üx");
    assert_eq!(latin.to_bytes(), b"a=\xFCx");
}

#[test]
fn a_span_can_be_made_to_hold_whole_characters() {
    let document = Document::parse("a=\u{20AC}x".as_bytes());
    assert_eq!(document.whole_characters(Span::new(3, 4)), Span::new(2, 5));
    assert_eq!(document.whole_characters(Span::new(2, 5)), Span::new(2, 5));
    assert_eq!(document.whole_characters(Span::at(6)), Span::at(6));
    assert_eq!(Document::parse(b"a=\x80\x80").whole_characters(Span::new(3, 4)), Span::new(3, 4));
}

#[test]
fn text_is_encoded_as_the_file_is() {
    assert_eq!(Encoding::Windows1252.encode("a€ü→"), b"a\x80\xFC?");
    assert_eq!(Encoding::Utf8.encode("ü"), "ü".as_bytes());
}

#[test]
fn positions_at_the_end_of_the_file_exist() {
    assert_eq!(Document::parse(b"").position(0), Position { line: 1, column: 1 });
    assert_eq!(Document::parse(b"a=1").position(3), Position { line: 1, column: 4 });
}

proptest! {
    #[test]
    fn any_bytes_round_trip(bytes in proptest::collection::vec(any::<u8>(), 0..300)) {
        let document = Document::parse(&bytes);
        prop_assert_eq!(document.to_bytes(), &bytes[..]);
        assert_tiles(&document);
    }

    #[test]
    fn anything_ini_like_round_trips(text in "([\\[\\]=;#a-c \t\r\n\u{0}\u{1a}ü<>]|=======){0,200}") {
        let document = Document::parse(text.as_bytes());
        prop_assert_eq!(document.to_bytes(), text.as_bytes());
        assert_tiles(&document);
        let source = document.to_bytes();
        for line in document.lines() {
            for part in [line.key(source), line.section_name(source), line.after_header(source), line.trimmed(source)] {
                prop_assert!(part.start <= part.end);
            }
        }
    }
}

#[test]
fn a_document_knows_which_kinds_of_lines_it_has() {
    let document = Document::parse(b"[1000]\na=1\n;b\n");
    let has = |kind| document.has_line(kind);
    assert!(has(LineKind::Section) && has(LineKind::Entry) && has(LineKind::Comment));
    assert!(!has(LineKind::Blank) && !has(LineKind::Other));
    assert!(Document::parse(b"<<<<<<< HEAD\n\n").has_line(LineKind::Other));
}
