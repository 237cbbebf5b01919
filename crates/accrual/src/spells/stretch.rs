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
            let before = all.list.len();
            all.list.extend(&part.list);
            all.ends.extend(part.ends.iter().map(|end| before + end));
        }
        all
    }
}
