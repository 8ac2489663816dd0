//! A bounded queue, first in, first out.

/// At most `N` items that wait.
#[derive(Debug)]
pub(crate) struct Ring<T, const N: usize> {
    /// From `first` on, round the end, `count` places are taken.
    places: [T; N],
    first: usize,
    count: usize,
}

impl<T: Copy, const N: usize> Ring<T, N> {
    /// An empty one. `filler` stands where nothing waits, and never comes out.
    pub(crate) const fn new(filler: T) -> Self {
        Self { places: [filler; N], first: 0, count: 0 }
    }

    /// Appends an item; false where there is no room, and the item is lost.
    pub(crate) fn push(&mut self, item: T) -> bool {
        match self.places.get_mut((self.first + self.count) % N) {
            Some(place) if self.count < N => {
                *place = item;
                self.count += 1;
                true
            }
            _ => false,
        }
    }

    /// Appends an item, in the place of the newest one where there is no room.
    pub(crate) fn push_over(&mut self, item: T) {
        self.count = self.count.min(N.saturating_sub(1));
        self.push(item);
    }

    /// Forgets all but the newest item.
    pub(crate) fn keep_newest(&mut self) {
        let older = self.count.saturating_sub(1);
        self.first = (self.first + older) % N;
        self.count -= older;
    }

    /// Takes the item that has waited longest.
    pub(crate) fn pop(&mut self) -> Option<T> {
        let item = *self.places.get(self.first).filter(|_| self.count > 0)?;
        self.first = (self.first + 1) % N;
        self.count -= 1;
        Some(item)
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// How many more items fit.
    pub(crate) fn room(&self) -> usize {
        N - self.count
    }

    pub(crate) fn clear(&mut self) {
        self.count = 0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::collections::VecDeque;

    proptest! {
        #[test]
        fn what_fits_comes_out_in_order(steps in proptest::collection::vec(any::<Option<u8>>(), 0..100)) {
            let (mut ring, mut model) = (Ring::<u8, 3>::new(0), VecDeque::new());
            // `None` takes an item out.
            for step in steps {
                match step {
                    Some(item @ 0..=9) => {
                        ring.keep_newest();
                        model.drain(..model.len().saturating_sub(1));
                        ring.push_over(item);
                        model.push_back(item);
                    }
                    Some(item @ 10..=99) => {
                        ring.push_over(item);
                        model.truncate(2);
                        model.push_back(item);
                    }
                    Some(item) => {
                        let fits = model.len() < 3;
                        prop_assert_eq!(ring.push(item), fits);
                        model.extend(fits.then_some(item));
                    }
                    None => prop_assert_eq!(ring.pop(), model.pop_front()),
                }
                prop_assert_eq!((ring.is_empty(), ring.room()), (model.is_empty(), 3 - model.len()));
            }
            ring.clear();
            prop_assert_eq!((ring.pop(), ring.room()), (None, 3));
        }
    }
}
