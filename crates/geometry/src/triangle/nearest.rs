//! The point of a triangle that is nearest to another point.

use crate::{Point3, Vector3};

/// The nearest point of something to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// From the point that was asked about to the nearest one. Not the nearest point itself: where
    /// both are far from the origin and near each other, their difference has more digits.
    pub offset: Vector3<f64>,
    /// What a hit there would have as its [`u`](crate::Hit::u).
    pub u: f32,
    /// What a hit there would have as its [`v`](crate::Hit::v).
    pub v: f32,
}

/// The point of a triangle nearest to another point: the foot of the perpendicular on its plane if
/// that lies in the triangle, else the nearest point of its edges. Ericson, "Real-Time Collision
/// Detection", 2005, section 5.1.5.
///
/// Of the two ways there this is the first. The second one sorts points by products of four
/// differences, which lose digits with the square of the distance; here it is with the distance.
/// A triangle without area has no number for the foot and so is its edges; an edge without length is
/// a point. Corners must be finite.
///
/// The answer lies in the box around the corners to the last bit: so what a box is away is never more
/// than what is in it, rounding or not.
#[must_use]
pub fn nearest(point: Point3<f64>, corners: [Point3<f64>; 3]) -> Nearest {
    let [a, b, c] = corners.map(|corner| corner - point);
    let (ab, ac) = (b - a, c - a);
    let normal = ab.cross(ac);
    let whole = normal.length_squared();
    let v = ac.cross(a).dot(normal) / whole;
    let w = a.cross(ab).dot(normal) / whole;
    if v > 0.0 && w > 0.0 && v + w < 1.0 {
        return found(a + ab * v + ac * w, [a, b, c], [v, w]);
    }
    let edges = [
        (a, ab, [[0.0, 0.0], [1.0, 0.0]]),
        (a, ac, [[0.0, 0.0], [0.0, 1.0]]),
        (b, c - b, [[1.0, 0.0], [0.0, 1.0]]),
    ];
    let on_edges = edges.map(|(from, along, [start, end])| {
        let s = share(from, along);
        let weight = |k: usize| start[k] + (end[k] - start[k]) * s;
        (from + along * s, [weight(0), weight(1)])
    });
    let mut nearest = on_edges[0];
    for other in &on_edges[1..] {
        if other.0.length_squared() < nearest.0.length_squared() {
            nearest = *other;
        }
    }
    found(nearest.0, [a, b, c], nearest.1)
}

/// How far along a segment its nearest point lies, 0 to 1; `from` is its start relative to the point.
pub(crate) fn share(from: Vector3<f64>, along: Vector3<f64>) -> f64 {
    let s = -from.dot(along) / along.length_squared();
    // A segment without length has no number here.
    if s.is_nan() { 0.0 } else { s.clamp(0.0, 1.0) }
}

fn found(offset: Vector3<f64>, [a, b, c]: [Vector3<f64>; 3], [v, w]: [f64; 2]) -> Nearest {
    let within = |x: f64, a: f64, b: f64, c: f64| x.max(a.min(b).min(c)).min(a.max(b).max(c));
    Nearest {
        offset: Vector3::new(
            within(offset.x, a.x, b.x, c.x),
            within(offset.y, a.y, b.y, c.y),
            within(offset.z, a.z, b.z, c.z),
        ),
        u: v as f32,
        v: w as f32,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn distance(point: [f64; 3], corners: [[f64; 3]; 3]) -> f64 {
        let nearest = nearest(Point3::from(point), corners.map(Point3::from));
        nearest.offset.length()
    }

    const RIGHT: [[f64; 3]; 3] = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];

    #[test]
    fn every_region_has_its_nearest_point() {
        for (point, expected, uv) in [
            ([1.0, 2.0, 3.0], [1.0, 2.0, 0.0], [0.25, 0.5]),
            ([-1.0, -2.0, 3.0], [0.0, 0.0, 0.0], [0.0, 0.0]),
            ([6.0, -1.0, 1.0], [4.0, 0.0, 0.0], [1.0, 0.0]),
            ([-1.0, 7.0, 1.0], [0.0, 4.0, 0.0], [0.0, 1.0]),
            ([1.0, -2.0, 0.0], [1.0, 0.0, 0.0], [0.25, 0.0]),
            ([-2.0, 1.0, 5.0], [0.0, 1.0, 0.0], [0.0, 0.25]),
            ([4.0, 4.0, -1.0], [2.0, 2.0, 0.0], [0.5, 0.5]),
        ] {
            let point = Point3::from(point);
            let found = nearest(point, RIGHT.map(Point3::from));
            assert_eq!(point + found.offset, Point3::from(expected), "{point:?}");
            assert_eq!([found.u, found.v], uv, "{point:?}");
        }
    }

    #[test]
    fn without_area_it_is_its_edges_and_without_edges_a_point() {
        let needle = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [1.0, 0.0, 0.0]];
        assert_eq!(distance([2.0, 3.0, 4.0], needle), 5.0);
        assert_eq!(distance([8.0, 3.0, 0.0], needle), 5.0);
        assert_eq!(distance([-3.0, 4.0, 0.0], needle), 5.0);
        let there_and_back = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 0.0, 0.0]];
        assert_eq!(distance([3.0, 0.0, 2.0], there_and_back), 2.0);
        assert_eq!(distance([3.0, 4.0, 0.0], [[0.0; 3]; 3]), 5.0);
    }

    #[test]
    fn far_out_and_close_by_no_digits_are_lost() {
        let far = RIGHT.map(|[x, y, z]| [x + 1e7, y - 1e7, z + 1e7]);
        let height = 1.0 / f64::from(1 << 20);
        assert_eq!(distance([1e7 + 1.0, -1e7 + 1.0, 1e7 + height], far), height);
    }

    #[test]
    fn from_far_away_the_foot_is_found_as_well() {
        let found = nearest(Point3::new(1.0, 2.0, 1e9), RIGHT.map(Point3::from));
        assert!((found.u - 0.25).abs() < 1e-6 && (found.v - 0.5).abs() < 1e-6);
    }
}
