//! Where hours are limited: by how far it is from the site.

/// Which places.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Zone {
    /// Farther than 5 m from the boundary, and up to 10 m.
    Near,
    /// Farther than 10 m.
    Far,
}

impl Zone {
    pub(super) const BOTH: [Self; 2] = [Self::Near, Self::Far];

    /// Metres from the boundary of the site at which it begins.
    pub(super) const fn begins(self) -> f64 {
        match self {
            Self::Near => 5.0,
            Self::Far => 10.0,
        }
    }

    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Near => "more than 5 m, up to 10 m",
            Self::Far => "more than 10 m",
        }
    }

    /// Which one so many metres from the site are in.
    pub(super) fn of(distance: f64) -> Option<Self> {
        match distance {
            far if far > Self::Far.begins() => Some(Self::Far),
            near if near > Self::Near.begins() => Some(Self::Near),
            _ => None,
        }
    }
}

/// Metres from a place to the nearest side of any ring.
pub(super) fn to_sides(polygons: &[Vec<Vec<[f64; 2]>>], [x, y]: [f64; 2]) -> f64 {
    let to_side = |a: [f64; 2], b: [f64; 2]| {
        let ([u, v], [p, q]) = ([b[0] - a[0], b[1] - a[1]], [x - a[0], y - a[1]]);
        let square = u * u + v * v;
        let along = if square > 0.0 {
            ((p * u + q * v) / square).clamp(0.0, 1.0)
        } else {
            0.0
        };
        (p - along * u).hypot(q - along * v)
    };
    let rings = polygons.iter().flatten();
    let sides = rings.flat_map(|ring| {
        let next = ring.iter().skip(1).chain(ring.first());
        ring.iter().zip(next)
    });
    sides
        .map(|(&a, &b)| to_side(a, b))
        .fold(f64::INFINITY, f64::min)
}

/// Places along rings, no farther apart than so many metres: all corners, and what is between.
pub(super) fn along(rings: &[Vec<[f64; 2]>], apart: f64) -> Vec<[f64; 2]> {
    let mut places = Vec::new();
    for ring in rings {
        let next = ring.iter().skip(1).chain(ring.first());
        for (a, b) in ring.iter().zip(next) {
            let count = ((a[0] - b[0]).hypot(a[1] - b[1]) / apart).ceil().max(1.0);
            places.extend((0..count as u32).map(|k| {
                let share = f64::from(k) / count;
                [0, 1].map(|axis| a[axis] + share * (b[axis] - a[axis]))
            }));
        }
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zones_begin_beyond_their_lines() {
        assert_eq!(Zone::of(5.0), None);
        assert_eq!(Zone::of(5.001), Some(Zone::Near));
        assert_eq!(Zone::of(10.0), Some(Zone::Near));
        assert_eq!(Zone::of(10.001), Some(Zone::Far));
        assert_eq!(Zone::of(f64::NAN), None);
    }

    #[test]
    fn distances_are_to_the_nearest_side() {
        let square = vec![vec![vec![
            [0.0, 0.0],
            [10.0, 0.0],
            [10.0, 10.0],
            [0.0, 10.0],
            [0.0, 0.0],
        ]]];
        assert_eq!(to_sides(&square, [5.0, 15.0]), 5.0);
        assert_eq!(to_sides(&square, [13.0, 14.0]), 5.0);
        assert_eq!(to_sides(&square, [5.0, 4.0]), 4.0);
        assert_eq!(to_sides(&[], [0.0, 0.0]), f64::INFINITY);
    }

    #[test]
    fn places_along_a_ring_are_close() {
        let ring = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let places = along(&[ring], 0.3);
        assert_eq!(places.len(), 16);
        assert!(
            places
                .windows(2)
                .all(|p| (p[0][0] - p[1][0]).hypot(p[0][1] - p[1][1]) <= 0.3)
        );
    }
}
