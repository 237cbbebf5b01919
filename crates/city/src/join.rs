//! Triangles of different faces that lie in one plane, joined to quadrilaterals.

use std::collections::HashMap;

use ombra_geometry::{Point3, Vector3};

use crate::city::Plane;

/// Corners may lie off the plane of a joined facet by so much, in metres.
const COPLANAR: f64 = 1e-3;

/// How much farther each corner must stand out of the line between its neighbours than the fourth lies off
/// the plane of the others. A quadrilateral that is bent and has a corner on an edge is not convex for who
/// sees it aslant, and would not cover what its triangles do.
const CLEAR: f64 = 100.0;

/// Joins pairs of triangles (their last corner repeats) that share an edge, lie in one plane and
/// make up a convex whole. Whatever has four corners stays as it is.
pub(crate) fn joined(pieces: Vec<[Point3; 4]>) -> Vec<[Point3; 4]> {
    let mut behind = HashMap::new();
    for (t, &[a, b, c, d]) in pieces.iter().enumerate() {
        if c == d {
            for (a, b, c) in [(a, b, c), (b, c, a), (c, a, b)] {
                behind.insert((key(a), key(b)), (t, c));
            }
        }
    }
    let mut is_used = vec![false; pieces.len()];
    let mut found = Vec::with_capacity(pieces.len());
    for (t, &[a, b, c, d]) in pieces.iter().enumerate() {
        if is_used[t] {
            continue;
        }
        is_used[t] = true;
        let plane = if c == d { Plane::of(&[a, b, c]) } else { None };
        let Some(plane) = plane else {
            found.push([a, b, c, d]);
            continue;
        };
        let candidates = [[a, b, c], [b, c, a], [c, a, b]].map(|[a, b, c]| {
            let &(other, d) = behind.get(&(key(b), key(a)))?;
            let quad = [a, d, b, c];
            let bend = plane.distance(d).abs();
            let fits = !is_used[other]
                && bend <= COPLANAR
                && is_convex(quad, plane.normal(), CLEAR * bend);
            fits.then(|| ((b - a).length(), other, quad))
        });
        let longest = (candidates.into_iter().flatten()).max_by(|a, b| a.0.total_cmp(&b.0));
        match longest {
            Some((_, other, quad)) => {
                is_used[other] = true;
                found.push(quad);
            }
            None => found.push([a, b, c, d]),
        }
    }
    found
}

/// Whether all corners turn left about the normal by more than rounding, and stand out by more than so many
/// metres.
fn is_convex([a, b, c, d]: [Point3; 4], normal: Vector3<f64>, clear: f64) -> bool {
    [[a, b, c], [b, c, d], [c, d, a], [d, a, b]]
        .into_iter()
        .all(|[a, b, c]| {
            let (u, v) = (b.wide() - a.wide(), c.wide() - b.wide());
            let turn = u.cross(v).dot(normal);
            turn > 1e-6 * u.length() * v.length() && turn > clear * (u + v).length()
        })
}

/// Adding 0 makes −0 and 0 the same.
pub(crate) fn key(p: Point3) -> [u32; 3] {
    p.to_array().map(|x| (x + 0.0).to_bits())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_is_flat_and_convex_is_joined() {
        let p = |x, y, z| Point3::new(x, y, z);
        let [a, b, c] = [p(0.0, 0.0, 0.0), p(4.0, 0.0, 4.0), p(4.0, 4.0, 4.0)];
        let with = |d: Point3| joined(vec![[a, b, c, c], [a, c, d, d]]);
        assert_eq!(with(p(0.0, 4.0, 0.0)), [[c, p(0.0, 4.0, 0.0), a, b]]);
        assert_eq!(with(p(0.0, 4.0, 0.1)).len(), 2, "bent");
        assert_eq!(with(p(3.0, 3.5, 3.0)).len(), 1);
        assert_eq!(with(p(5.0, 7.0, 5.0)).len(), 2, "not convex at c");
        let on_the_edge = |bend: f32| with(p(1.999, 2.001, 1.999 + bend));
        assert_eq!(on_the_edge(0.0).len(), 1);
        assert_eq!(on_the_edge(5e-4).len(), 2, "not convex from everywhere");
        let quad = [a, b, c, p(0.0, 4.0, 0.0)];
        assert_eq!(joined(vec![quad, [a, b, c, c]]), [quad, [a, b, c, c]]);
        assert!(joined(Vec::new()).is_empty());
    }
}
