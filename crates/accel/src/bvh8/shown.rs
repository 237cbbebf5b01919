//! Which triangles a program was asked about.

use ombra_geometry::PrimitiveId;

use crate::{AnyHit, Candidate};

/// Remembers them for the length of one search, where a tree names some more than once.
#[derive(Debug, Default)]
pub(crate) struct Shown {
    /// In the order in which they were found while they are few, sorted when they are many.
    triangles: Vec<PrimitiveId>,
}

impl Shown {
    /// From here on the list is kept in order.
    const MANY: usize = 32;

    /// What a program says to a triangle that it did not see yet; a second time the triangle is not
    /// there. If the first answer was that it counts, nothing changes by that.
    pub(crate) fn ask(
        &mut self,
        candidate: &Candidate,
        any_hit: &mut dyn FnMut(&Candidate) -> AnyHit,
    ) -> AnyHit {
        let triangle = candidate.primitive;
        let shown = &mut self.triangles;
        if shown.len() < Self::MANY {
            if shown.contains(&triangle) {
                return AnyHit::Ignore;
            }
            shown.push(triangle);
            if shown.len() == Self::MANY {
                shown.sort_unstable();
            }
        } else {
            match shown.binary_search(&triangle) {
                Ok(_) => return AnyHit::Ignore,
                Err(place) => shown.insert(place, triangle),
            }
        }
        any_hit(candidate)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ombra_geometry::Crossing;

    #[test]
    fn each_triangle_is_asked_about_once() {
        let (mut shown, mut asked) = (Shown::default(), Vec::new());
        for round in 0..3 {
            for k in 0..100 {
                let triangle = 37 * k % 101;
                let crossing = Crossing {
                    t: f64::from(k),
                    u: 0.0,
                    v: 0.0,
                };
                let answer = shown.ask(&Candidate::new(crossing, triangle), &mut |candidate| {
                    asked.push(candidate.primitive.0);
                    AnyHit::Accept
                });
                assert_eq!(answer == AnyHit::Accept, round == 0);
            }
        }
        asked.sort_unstable();
        asked.dedup();
        assert_eq!(asked.len(), 100);
    }
}
