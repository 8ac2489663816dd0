//! The comments and the test functions of a Rust source.

use proc_macro2::{Delimiter, LexError, TokenStream, TokenTree};
use std::ops::Range;

/// A Rust source, as far as IDs of statements go.
pub struct Source {
    /// The text of all comments.
    pub comments: String,
    /// The functions with the attribute `#[test]`, also those in macros such as `proptest!`.
    pub tests: Vec<TestFunction>,
}

/// A function that is a test.
pub struct TestFunction {
    /// Its name.
    pub name: String,
    /// The text of the comments directly above and inside it.
    pub comments: String,
}

impl Source {
    /// Reads a source.
    ///
    /// # Errors
    /// It does not consist of tokens of Rust.
    pub fn parse(text: &str) -> Result<Self, LexError> {
        let tokens: TokenStream = text.parse()?;
        let mut functions = Vec::new();
        find_tests(text, tokens.clone(), 0, &mut functions);
        let mut bytes = text.as_bytes().to_vec();
        blank_out(text, tokens, &mut bytes);
        let comments = String::from_utf8(bytes).expect("tokens end where characters do");
        let tests = functions
            .into_iter()
            .map(|(name, range)| TestFunction { name, comments: words(&comments[range]) })
            .collect();
        Ok(Self { comments: words(&comments), tests })
    }
}

/// Replaces all tokens by blanks, so that comments and white space stay.
fn blank_out(text: &str, tokens: TokenStream, bytes: &mut [u8]) {
    let mut blank = |range: Range<usize>| {
        for byte in bytes[range].iter_mut().filter(|byte| **byte != b'\n') {
            *byte = b' ';
        }
    };
    let mut streams = vec![tokens];
    while let Some(tokens) = streams.pop() {
        for tree in tokens {
            let range = tree.span().byte_range();
            // To the tokens a doc comment is an attribute.
            let is_doc_comment =
                text[range.clone()].starts_with("//") || text[range.clone()].starts_with("/*");
            match tree {
                _ if is_doc_comment => {}
                TokenTree::Group(group) => {
                    blank(group.span_open().byte_range());
                    blank(group.span_close().byte_range());
                    streams.push(group.stream());
                }
                _ => blank(range),
            }
        }
    }
}

/// The text of comments in one line, without what marks them as comments.
fn words(comments: &str) -> String {
    let is_mark = |c: char| c.is_whitespace() || "/*!".contains(c);
    let words = comments.lines().flat_map(|line| line.trim_matches(is_mark).split_whitespace());
    words.collect::<Vec<_>>().join(" ")
}

/// Finds the test functions of `tokens`, which begin behind `end`: their names, and where they are with the comments
/// directly above them.
fn find_tests(text: &str, tokens: TokenStream, mut end: usize, found: &mut Vec<(String, Range<usize>)>) {
    let trees: Vec<TokenTree> = tokens.into_iter().collect();
    let mut nth = 0;
    while let Some(tree) = trees.get(nth) {
        let attributes = attributes(&trees[nth..]);
        let item = nth + 2 * attributes.len();
        let is_test = attributes.iter().any(|attribute| attribute == "test");
        if let Some((name, body)) = is_test.then(|| function(&trees[item..])).flatten() {
            let start = end_of_gap(text, end, tree.span().byte_range().start);
            nth = item + body;
            found.push((name, start..trees[nth].span().byte_range().end));
        } else if attributes.is_empty() {
            if let TokenTree::Group(group) = tree {
                find_tests(text, group.stream(), group.span_open().byte_range().end, found);
            }
        } else {
            nth = item - 1;
        }
        end = trees[nth].span().byte_range().end;
        nth += 1;
    }
}

/// The attributes at the start of `trees`, two trees each.
fn attributes(trees: &[TokenTree]) -> Vec<String> {
    let attribute = |pair: &[TokenTree]| match pair {
        [TokenTree::Punct(hash), TokenTree::Group(group)] if hash.as_char() == '#' => {
            (group.delimiter() == Delimiter::Bracket).then(|| group.stream().to_string())
        }
        _ => None,
    };
    trees.chunks(2).map_while(attribute).collect()
}

/// The name of the function at the start of `trees`, and the place of its body.
fn function(trees: &[TokenTree]) -> Option<(String, usize)> {
    let is_brace =
        |tree: &TokenTree| matches!(tree, TokenTree::Group(group) if group.delimiter() == Delimiter::Brace);
    let body = trees.iter().position(is_brace)?;
    let keyword =
        trees[..body].iter().position(|tree| matches!(tree, TokenTree::Ident(word) if word == "fn"))?;
    match &trees[keyword + 1] {
        TokenTree::Ident(name) => Some((name.to_string(), body)),
        _ => None,
    }
}

/// Where the comment directly above an item at `item` begins: behind the line where the previous one ends, and behind
/// blank lines.
fn end_of_gap(text: &str, previous_end: usize, item: usize) -> usize {
    let mut start = previous_end;
    let mut offset = previous_end;
    for line in text[previous_end..item].split_inclusive('\n') {
        let is_rest_of_line = offset == previous_end && offset > 0;
        offset += line.len();
        if is_rest_of_line || (line.trim().is_empty() && line.ends_with('\n')) {
            start = offset;
        }
    }
    start
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tests(text: &str) -> Vec<(String, String)> {
        let source = Source::parse(text).unwrap();
        source.tests.into_iter().map(|test| (test.name, test.comments)).collect()
    }

    fn test(name: &str, comments: &str) -> (String, String) {
        (name.to_owned(), comments.to_owned())
    }

    #[test]
    fn comments_directly_above_and_inside_a_test() {
        let text = "
            fn before() {} // behind another item

            // apart

            // above,
            // in two lines
            /// A doc comment.
            #[test] // behind an attribute
            #[cfg(unix)]
            // above the function
            fn first() {
                let a = 1 / 2; // behind code
                /* a block */
                assert!(a == \"// no comment\".len(), r#\"
                    // none either
                \"#);
            }
            // behind
            #[test]
            fn second() -> Result<(), ()> { Ok(()) }
        ";
        let first =
            "above, in two lines A doc comment. behind an attribute above the function behind code a block";
        assert_eq!(tests(text), [test("first", first), test("second", "behind")]);
    }

    #[test]
    fn tests_in_modules_and_macros() {
        let text = "
            #[cfg(test)]
            mod tests {
                // of the first
                #[test]
                fn first() {}

                proptest! {
                    #![proptest_config(ProptestConfig::with_cases(1))]
                    // of the second
                    #[test]
                    fn second(x in 0..5) { /* x */ }
                }

                macro_rules! make { ($name:ident) => { #[test] fn $name() {} } }
                // of none
                #[inline]
                fn third() {}
                #[cfg(test)]
                // of none
                mod inner { #[test] fn fourth() {} }
            }
        ";
        let expected = [test("first", "of the first"), test("second", "of the second x"), test("fourth", "")];
        assert_eq!(tests(text), expected);
    }

    #[test]
    fn all_comments_of_a_source() {
        let text = "//! Of the module: ä.\n\n/** Of the item */\nconst A: char = 'ä'; // öffentlich\n";
        let source = Source::parse(text).unwrap();
        assert_eq!(source.comments, "Of the module: ä. Of the item öffentlich");
    }
}
