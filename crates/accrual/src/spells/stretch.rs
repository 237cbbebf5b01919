//! Stretches of shadow.

use ombra_sun::Instant;

/// From when to when a place lies in the shadow of one building.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// When it begins.
    pub from: Instant,
    /// When it ends.
    pub to: Instant,
    /// What the ray toward the sun meets first, see [`Facet::owner`](ombra_city::Facet::owner).
    pub owner: u32,
    /// Whether no other building covers the sun as well: without this one, the place would lie in the sun.
    pub is_alone: bool,
}

impl Stretch {
    /// How long it is.
    #[must_use]
    pub fn seconds(&self) -> f64 {
        self.to - self.from
    }
}

/// The stretches of many places, one place after another, each in order of time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stretches {
    list: Vec<Stretch>,
    /// Where those of each place end.
    ends: Vec<usize>,
}

impl Stretches {
    /// Adds a place.
    pub fn push(&mut self, stretches: impl IntoIterator<Item = Stretch>) {
        self.list.extend(stretches);
        self.ends.push(self.list.len());
    }

    /// Adds the places of others.
    pub fn append(&mut self, others: &Self) {
        let before = self.list.len();
        self.list.extend(&others.list);
        self.ends.extend(others.ends.iter().map(|end| before + end));
    }

    /// Takes the first so many places away from the others, or all if there are fewer.
    #[must_use]
    pub fn take_first(&mut self, places: usize) -> Self {
        let places = places.min(self.len());
        let end = places.checked_sub(1).map_or(0, |last| self.ends[last]);
        let rest = Self {
            list: self.list.split_off(end),
            ends: self
                .ends
                .split_off(places)
                .into_iter()
                .map(|own| own - end)
                .collect(),
        };
        std::mem::replace(self, rest)
    }

    /// How many places there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Whether there is no place.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// The stretches of one place.
    ///
    /// # Panics
    /// If there are not as many places.
    #[must_use]
    pub fn of(&self, place: usize) -> &[Stretch] {
        let begin = place.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.list[begin..self.ends[place]]
    }

    /// The stretches of each place.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &[Stretch]> {
        (0..self.len()).map(|place| self.of(place))
    }

    pub(crate) fn concat(parts: &[Self]) -> Self {
        let mut all = Self {
            list: Vec::with_capacity(parts.iter().map(|part| part.list.len()).sum()),
            ends: Vec::with_capacity(parts.iter().map(|part| part.ends.len()).sum()),
        };
        for part in parts {
            all.append(part);
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_places_part_from_the_others() {
        let stretch = |owner| Stretch {
            from: Instant::from_seconds(0.0),
            to: Instant::from_seconds(1.0),
            owner,
            is_alone: true,
        };
        let of = |counts: &[u32]| {
            let mut all = Stretches::default();
            for &count in counts {
                all.push((0..count).map(stretch));
            }
            all
        };
        for first in 0..6 {
            let mut all = of(&[2, 0, 3, 1]);
            let own = all.take_first(first);
            let parts = [2, 0, 3, 1].split_at(first.min(4));
            assert_eq!([own.clone(), all.clone()], [of(parts.0), of(parts.1)]);
            let mut together = own;
            together.append(&all);
            assert_eq!(together, of(&[2, 0, 3, 1]));
        }
    }
}
