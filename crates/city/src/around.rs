//! Lines at a distance around polygons.

use i_overlay::core::fill_rule::FillRule;
use i_overlay::float::simplify::SimplifyShape;
use i_overlay::mesh::float::outline::offset::OutlineOffset;
use i_overlay::mesh::float::style::{LineJoin, OutlineStyle};

/// The angle of a step of an arc around a corner, in radians: the chord of one is off by a 3000th of the distance.
const STEP: f64 = 0.05;

/// Rings of places, each so many metres from the nearest place of any of the polygons: around all of them, and within their holes where
/// there is room. Polygons are rings, the outer one first; a ring may repeat its first corner, and those here do not.
///
/// Corners are rounded: what counts is distance, not that sides are parallel.
#[must_use]
pub fn line_around(polygons: &[Vec<Vec<[f64; 2]>>], metres: f64) -> Vec<Vec<[f64; 2]>> {
    // Turned as they should be, and without crossings.
    let own = |rings: &Vec<Vec<[f64; 2]>>| rings.simplify_shape(FillRule::EvenOdd);
    let plain: Vec<_> = polygons.iter().flat_map(own).collect();
    let style = OutlineStyle::new(metres).line_join(LineJoin::Round(STEP));
    let wide: Vec<Vec<Vec<[f64; 2]>>> = plain
        .iter()
        .flat_map(|shape| shape.outline(&style))
        .collect();
    // Those of several polygons may meet.
    let all: Vec<Vec<[f64; 2]>> = wide.into_iter().flatten().collect();
    all.simplify_shape(FillRule::NonZero)
        .into_iter()
        .flatten()
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(x: f64, y: f64, side: f64) -> Vec<[f64; 2]> {
        vec![
            [x, y],
            [x + side, y],
            [x + side, y + side],
            [x, y + side],
            [x, y],
        ]
    }

    fn length(ring: &[[f64; 2]]) -> f64 {
        let next = ring.iter().skip(1).chain(ring.first());
        ring.iter()
            .zip(next)
            .map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1]))
            .sum()
    }

    #[test]
    fn a_square_has_a_line_with_round_corners() {
        // Either way round.
        let mut turned = square(1e4, 0.0, 20.0);
        turned.reverse();
        for ring in [square(1e4, 0.0, 20.0), turned] {
            let lines = line_around(&[vec![ring]], 5.0);
            assert_eq!(lines.len(), 1);
            let expected = 80.0 + 5.0 * std::f64::consts::TAU;
            assert!(
                (length(&lines[0]) - expected).abs() < 0.02,
                "{}",
                length(&lines[0])
            );
            let distance = |p: &[f64; 2]| {
                let beside = |x: f64, from: f64| (from - x).max(x - from - 20.0).max(0.0);
                beside(p[0], 1e4).hypot(beside(p[1], 0.0))
            };
            assert!(lines[0].iter().all(|p| (distance(p) - 5.0).abs() < 0.005));
        }
    }

    #[test]
    fn lines_of_several_polygons_become_one() {
        let near = [vec![square(0.0, 0.0, 10.0)], vec![square(14.0, 0.0, 10.0)]];
        assert_eq!(line_around(&near, 5.0).len(), 1);
        let far = [vec![square(0.0, 0.0, 10.0)], vec![square(40.0, 0.0, 10.0)]];
        assert_eq!(line_around(&far, 5.0).len(), 2);
        assert!(line_around(&[], 5.0).is_empty());
    }
}
