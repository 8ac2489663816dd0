//! The numbers of lists, which begin with 1 and leave none out.

/// The only key of a list that is not the number of its place: that place, counted from 0, and the number that is due
/// there. `None` where all keys are right, or several are not.
pub(crate) fn one_wrong(keys: impl IntoIterator<Item = u16>) -> Option<(usize, u16)> {
    let due = |(place, _): &(usize, u16)| u16::try_from(place + 1).unwrap_or(u16::MAX);
    let mut wrong = keys.into_iter().enumerate().filter(|item| item.1 != due(item));
    let only = wrong.next()?;
    wrong.next().is_none().then(|| (only.0, due(&only)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_key_is_wrong_or_it_is_not_clear() {
        assert_eq!(one_wrong([1, 2, 99, 4]), Some((2, 3)));
        assert_eq!(one_wrong([1, 2, 2, 4]), Some((2, 3)));
        assert_eq!(one_wrong([1, 2, 9]), Some((2, 3)));
        for keys in [&[1, 2, 3][..], &[], &[1, 3, 4], &[0, 1], &[2, 1]] {
            assert_eq!(one_wrong(keys.iter().copied()), None, "{keys:?}");
        }
    }
}
