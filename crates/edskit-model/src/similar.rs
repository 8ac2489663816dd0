//! Which word was meant.

/// The candidate that differs least from `word` (in any case), if it differs little enough to be a slip.
pub fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let word = word.to_ascii_lowercase();
    let allowed = (word.len() / 4).clamp(1, 4);
    let distance = |candidate: &str| distance(word.as_bytes(), candidate.to_ascii_lowercase().as_bytes());
    // A difference in length is a distance already; most candidates need no closer look.
    let alike = candidates.into_iter().filter(|candidate| candidate.len().abs_diff(word.len()) <= allowed);
    let scored = alike.map(|candidate| (distance(candidate), candidate));
    scored
        .filter(|&(distance, _)| distance > 0 && distance <= allowed)
        .min_by_key(|&(distance, _)| distance)
        .map(|(_, c)| c)
}

/// Edit distance with insertions, deletions, replacements and swaps of neighbours.
fn distance(a: &[u8], b: &[u8]) -> usize {
    // Longer words are never slips of the short names looked for, and this bounds the work.
    if a.len().abs_diff(b.len()) > 4 || a.len() > 64 {
        return usize::MAX;
    }
    let mut before = vec![0; b.len() + 1];
    let mut above: Vec<usize> = (0..=b.len()).collect();
    for i in 1..=a.len() {
        let mut row = vec![i; b.len() + 1];
        for j in 1..=b.len() {
            let replaced = above[j - 1] + usize::from(a[i - 1] != b[j - 1]);
            row[j] = replaced.min(above[j] + 1).min(row[j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                row[j] = row[j].min(before[j - 2] + 1);
            }
        }
        before = std::mem::replace(&mut above, row);
    }
    above[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_are_recognised_and_other_words_are_not() {
        let keys = ["AccessType", "DataType", "ObjectType"];
        assert_eq!(nearest("AcessType", keys), Some("AccessType"));
        assert_eq!(nearest("DatatYpe_", keys), Some("DataType"));
        assert_eq!(nearest("ObejctType", keys), Some("ObjectType"));
        assert_eq!(nearest("DataType", keys), None);
        assert_eq!(nearest("Colour", keys), None);
    }
}
