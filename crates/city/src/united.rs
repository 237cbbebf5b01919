//! Polygons taken together: what any of them covers, once.

use i_overlay::core::fill_rule::FillRule;
use i_overlay::float::simplify::SimplifyShape;

/// What any of some polygons covers, as polygons that neither cross nor overlap. A polygon is its rings, the outer one first; a ring
/// may repeat its first corner, and those that come out do not. As in a [`StudyArea`](crate::StudyArea), what the rings of one polygon
/// go around an odd number of times is in it.
#[must_use]
pub fn united(polygons: &[Vec<Vec<[f64; 2]>>]) -> Vec<Vec<Vec<[f64; 2]>>> {
    // Turned as they should be, so that holes of one do not count where another lies.
    let own = |rings: &Vec<Vec<[f64; 2]>>| rings.simplify_shape(FillRule::EvenOdd);
    let all: Vec<Vec<[f64; 2]>> = polygons.iter().flat_map(own).flatten().collect();
    all.simplify_shape(FillRule::NonZero)
}

/// How much of the plane any of some polygons covers, read as by [`united`]; 0 where they enclose nothing.
#[must_use]
pub fn area_of(polygons: &[Vec<Vec<[f64; 2]>>]) -> f64 {
    let rings = united(polygons).into_iter().flatten();
    // Holes are turned the other way.
    rings.map(|ring| signed_area(&ring)).sum::<f64>().abs()
}

fn signed_area(ring: &[[f64; 2]]) -> f64 {
    let Some(&[x, y]) = ring.first() else {
        return 0.0;
    };
    // About a corner, so that no digits are lost far from the origin.
    let cross = |pair: &[[f64; 2]]| {
        let [a, b] = [pair[0], pair[1]].map(|at| [at[0] - x, at[1] - y]);
        a[0] * b[1] - a[1] * b[0]
    };
    0.5 * ring.windows(2).map(cross).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(at: f64, side: f64) -> Vec<[f64; 2]> {
        let corners = [
            [0.0, 0.0],
            [side, 0.0],
            [side, side],
            [0.0, side],
            [0.0, 0.0],
        ];
        corners.map(|[x, y]| [x + at, y + at]).to_vec()
    }

    fn is_area(polygons: &[Vec<Vec<[f64; 2]>>], expected: f64) {
        let found = area_of(polygons);
        assert!((found - expected).abs() < 1e-4, "{found} and {expected}");
    }

    #[test]
    fn areas_are_those_of_rings_less_holes() {
        is_area(&[vec![square(1e4, 10.0)]], 100.0);
        let mut hole = square(1e4 + 1.0, 2.0);
        is_area(&[vec![square(1e4, 10.0), hole.clone()]], 96.0);
        hole.reverse();
        is_area(&[vec![square(1e4, 10.0), hole]], 96.0);
        for nothing in [
            vec![],
            vec![vec![]],
            vec![vec![vec![]]],
            vec![vec![vec![[0.0, 0.0], [9.0, 9.0], [0.0, 0.0]]]],
            // A hole as large as its outline.
            vec![vec![square(0.0, 4.0), square(0.0, 4.0)]],
        ] {
            assert_eq!(area_of(&nothing), 0.0, "{nothing:?}");
        }
    }

    #[test]
    fn what_several_polygons_cover_counts_once() {
        let both = [vec![square(0.0, 10.0)], vec![square(5.0, 10.0)]];
        is_area(&both, 175.0);
        is_area(&[both[0].clone(), both[0].clone()], 100.0);
        // In the hole of one lies another, in part.
        let with_hole = vec![square(0.0, 10.0), square(2.0, 6.0)];
        is_area(&[with_hole, vec![square(4.0, 2.0)]], 68.0);
        // Side by side they are one.
        let beside = [
            vec![square(0.0, 10.0)],
            vec![
                square(0.0, 10.0)
                    .iter()
                    .map(|at| [at[0] + 10.0, at[1]])
                    .collect(),
            ],
        ];
        is_area(&beside, 200.0);
        assert_eq!(united(&beside).len(), 1);
    }

    #[test]
    fn a_ring_that_crosses_itself_covers_what_it_goes_around_once() {
        // A bow tie, of which the halves are turned against one another.
        let bow = vec![
            [0.0, 0.0],
            [10.0, 10.0],
            [10.0, 0.0],
            [0.0, 10.0],
            [0.0, 0.0],
        ];
        is_area(&[vec![bow]], 50.0);
        // Twice around is out.
        let twice: Vec<_> = [square(0.0, 10.0), square(0.0, 4.0)].concat();
        is_area(&[vec![twice]], 84.0);
    }
}
