//! Parts of sentences.

/// How many things of a kind a message or its labels show.
pub(crate) const FEW: usize = 4;

/// `a`, `a and b`, `a, b and c`; the conjunction is `and` or `or`.
pub(crate) fn series(items: &[String], conjunction: &str) -> String {
    match items {
        [] => String::new(),
        [only] => only.clone(),
        [before @ .., last] => format!("{} {conjunction} {last}", before.join(", ")),
    }
}

/// The same with `and`, but no more than a few of them: `a, b, c, d and 17 more`.
pub(crate) fn few<T: ToString>(items: impl ExactSizeIterator<Item = T>) -> String {
    let count = items.len();
    let mut shown: Vec<String> = items.take(FEW).map(|item| item.to_string()).collect();
    if count > FEW {
        shown.push(format!("{} more", count - FEW));
    }
    series(&shown, "and")
}

/// `1 object`, `2 objects`.
pub(crate) fn count(number: usize, noun: &str) -> String {
    format!("{number} {noun}{}", if number == 1 { "" } else { "s" })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn series_read_like_sentences() {
        let items: Vec<String> = ["a", "b", "c"].map(String::from).to_vec();
        assert_eq!(series(&items, "or"), "a, b or c");
        assert_eq!(series(&items[..1], "and"), "a");
        assert_eq!(few((1..=4).collect::<Vec<_>>().into_iter()), "1, 2, 3 and 4");
        assert_eq!(few((1..=6).collect::<Vec<_>>().into_iter()), "1, 2, 3, 4 and 2 more");
        assert_eq!([count(1, "object"), count(0, "object")], ["1 object", "0 objects"]);
    }
}
