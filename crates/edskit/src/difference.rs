//! Differences as patches.

use crate::paths;
use similar::TextDiff;
use std::path::Path;

/// A patch that makes a file what it would become, byte for byte. `git apply` and `patch -p1` take it in the folder where
/// the command runs.
pub(crate) fn patch(name: &str, before: &[u8], after: &[u8]) -> Vec<u8> {
    // A text has one character for each byte, so that no encoding stands between the file and its patch.
    let wide = |bytes: &[u8]| bytes.iter().copied().map(char::from).collect::<String>();
    let (before, after) = (wide(before), wide(after));
    let lines = |text: &'_ str| text.split_inclusive('\n').map(str::to_owned).collect::<Vec<_>>();
    let (before, after) = (lines(&before), lines(&after));
    let (before, after): (Vec<&str>, Vec<&str>) =
        (before.iter().map(String::as_str).collect(), after.iter().map(String::as_str).collect());
    let difference = TextDiff::configure().newline_terminated(true).diff_slices(&before, &after);
    let hunks = difference.unified_diff().context_radius(3).to_string();
    let mut patch = format!("--- {}\n+++ {}\n", quoted("a/", name), quoted("b/", name)).into_bytes();
    patch.extend(hunks.chars().map(|character| character as u8));
    patch
}

/// The name of a file as patches write it: from the folder of the command, in quotes where it has odd characters.
fn quoted(side: &str, name: &str) -> String {
    let here = paths::folder(Path::new(""));
    let from_here = paths::relative(&here, &paths::whole(Path::new(name)));
    let path = if from_here.starts_with("..") { name.to_owned() } else { paths::text(&from_here) };
    let is_odd = |character: char| character.is_ascii_control() || matches!(character, '"' | '\\');
    if !path.contains(is_odd) {
        return format!("{side}{path}");
    }
    let escaped = path.chars().map(|character| match character {
        '"' | '\\' => format!("\\{character}"),
        _ if character.is_ascii_control() => format!("\\{:03o}", character as u32),
        _ => character.to_string(),
    });
    format!("\"{side}{}\"", escaped.collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_and_line_endings_stay() {
        let patch = patch("a.eds", b"x=\xFC\r\ny = 1\r\nz\rw", b"x=\xFC\r\ny=1\r\nz\rw");
        assert_eq!(
            patch,
            b"--- a/a.eds\n+++ b/a.eds\n@@ -1,3 +1,3 @@\n x=\xFC\r\n-y = 1\r\n+y=1\r\n z\rw\n\\ No newline at end of file\n"
        );
    }

    #[test]
    fn odd_names_are_quoted() {
        assert_eq!(quoted("a/", "my file.eds"), "a/my file.eds");
        assert_eq!(quoted("b/", "a\"b\n.eds"), "\"b/a\\\"b\\012.eds\"");
    }
}
