//! Polygons into triangles: a fan where the polygon is convex, ear clipping where it is not.
//!
//! Meisters, "Polygons Have Ears", American Mathematical Monthly 82(6), 1975. All arithmetic is in
//! double precision on the polygon's projection along the largest axis of its normal (Newell's, as
//! in Sutherland, Sproull and Schumacker, "A Characterization of Ten Hidden-Surface Algorithms",
//! 1974), so slightly bent polygons are cut well, too.

use ombra_geometry::Point3;

/// Concave polygons with more corners are cut as fans: clipping ears takes time quadratic in them.
pub(crate) const MOST_CLIPPED_CORNERS: usize = 4096;

/// Cuts the polygon with these corners; `emit` gets the positions of three corners at a time, in
/// the polygon's own sense of winding. Self-crossing polygons are cut somehow, into n − 2
/// triangles like any other.
///
/// Returns whether it was cut as a fan although it is concave.
pub(crate) fn triangulate(corners: &[Point3], mut emit: impl FnMut([usize; 3])) -> bool {
    if corners.len() < 3 {
        return false;
    }
    let flat = if corners.len() == 3 {
        None
    } else {
        projected(corners).filter(|flat| !is_convex(flat))
    };
    match flat {
        Some(flat) if flat.len() <= MOST_CLIPPED_CORNERS => {
            Clipping::new(&flat).run(&mut emit);
            false
        }
        concave => {
            for i in 2..corners.len() {
                emit([0, i - 1, i]);
            }
            concave.is_some()
        }
    }
}

type Point2 = [f64; 2];

/// The corners in a plane, winding counter-clockwise; `None` if they span no area.
fn projected(corners: &[Point3]) -> Option<Vec<Point2>> {
    let mut normal = [0.0_f64; 3];
    // Relative to one corner, so that a small polygon far from the origin keeps its digits.
    let local = |p: Point3| {
        let (p, o) = (p.wide().to_array(), corners[0].wide().to_array());
        [p[0] - o[0], p[1] - o[1], p[2] - o[2]]
    };
    for (i, &corner) in corners.iter().enumerate() {
        let (a, b) = (local(corner), local(corners[(i + 1) % corners.len()]));
        for (axis, sum) in normal.iter_mut().enumerate() {
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            *sum += a[u] * b[v] - a[v] * b[u];
        }
    }
    let axis = (0..3).max_by(|&a, &b| normal[a].abs().total_cmp(&normal[b].abs()))?;
    if normal[axis] == 0.0 {
        return None;
    }
    let (mut u, mut v) = ((axis + 1) % 3, (axis + 2) % 3);
    if normal[axis] < 0.0 {
        std::mem::swap(&mut u, &mut v);
    }
    Some(
        corners
            .iter()
            .map(|&c| [local(c)[u], local(c)[v]])
            .collect(),
    )
}

/// Twice the signed area of a triangle: positive if it winds counter-clockwise.
fn turn(a: Point2, b: Point2, c: Point2) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

fn is_convex(flat: &[Point2]) -> bool {
    let n = flat.len();
    (0..n).all(|i| turn(flat[i], flat[(i + 1) % n], flat[(i + 2) % n]) >= 0.0)
}

/// The ring of corners that are not cut off yet.
struct Clipping<'a> {
    flat: &'a [Point2],
    before: Vec<usize>,
    after: Vec<usize>,
    is_ear: Vec<bool>,
    left: usize,
}

impl<'a> Clipping<'a> {
    fn new(flat: &'a [Point2]) -> Self {
        let n = flat.len();
        let mut clipping = Self {
            flat,
            before: (0..n).map(|i| (i + n - 1) % n).collect(),
            after: (0..n).map(|i| (i + 1) % n).collect(),
            is_ear: vec![false; n],
            left: n,
        };
        clipping.find_ears(0);
        clipping
    }

    fn run(mut self, emit: &mut impl FnMut([usize; 3])) {
        // Whether a corner is an ear is looked at again only where a neighbour was cut. Cutting can
        // free others; they are found when no known ear is left, and the number of such searches is
        // bounded so that hostile polygons cost no more than quadratic time.
        let mut searches = 32;
        let mut corner = 0;
        while self.left > 3 {
            let mut steps = 0;
            while !self.is_ear[corner] && steps < self.left {
                corner = self.after[corner];
                steps += 1;
            }
            if !self.is_ear[corner] && searches > 0 {
                searches -= 1;
                self.find_ears(corner);
                // None at all: the polygon crosses itself, and any corner is as good.
                let none = !self.ring(corner).any(|i| self.is_ear[i]);
                self.is_ear[corner] |= none;
                continue;
            }
            let (before, after) = (self.before[corner], self.after[corner]);
            emit([before, corner, after]);
            self.after[before] = after;
            self.before[after] = before;
            self.left -= 1;
            self.is_ear[before] = self.check_ear(before);
            self.is_ear[after] = self.check_ear(after);
            // Going on two corners further makes plumper triangles than a fan about one corner.
            corner = self.after[after];
        }
        emit([self.before[corner], corner, self.after[corner]]);
    }

    fn ring(&self, from: usize) -> impl Iterator<Item = usize> + '_ {
        std::iter::successors(Some(from), |&i| Some(self.after[i])).take(self.left)
    }

    fn find_ears(&mut self, from: usize) {
        let ears: Vec<_> = self.ring(from).map(|i| (i, self.check_ear(i))).collect();
        for (corner, is_ear) in ears {
            self.is_ear[corner] = is_ear;
        }
    }

    fn turn_at(&self, corner: usize) -> f64 {
        let [a, b, c] = [self.before[corner], corner, self.after[corner]].map(|i| self.flat[i]);
        turn(a, b, c)
    }

    /// Whether a corner is convex and no reflex corner lies in the triangle that it would cut off.
    fn check_ear(&self, corner: usize) -> bool {
        if !(self.turn_at(corner) > 0.0) {
            return false;
        }
        let own = [self.before[corner], corner, self.after[corner]];
        let [a, b, c] = own.map(|i| self.flat[i]);
        !self.ring(corner).any(|i| {
            let p = self.flat[i];
            // Corners in the same place as the ear's own do not block it: holes that were joined
            // to an outline by a bridge have such.
            !own.contains(&i)
                && ![a, b, c].contains(&p)
                && turn(a, b, p) >= 0.0
                && turn(b, c, p) >= 0.0
                && turn(c, a, p) >= 0.0
                && !(self.turn_at(i) > 0.0)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn cut(corners: &[Point3]) -> Vec<[usize; 3]> {
        let mut triangles = Vec::new();
        assert!(!triangulate(corners, |t| triangles.push(t)));
        triangles
    }

    fn areas(corners: &[Point3], triangles: &[[usize; 3]]) -> Vec<f64> {
        let flat = projected(corners).unwrap();
        let area = |t: &[usize; 3]| turn(flat[t[0]], flat[t[1]], flat[t[2]]) / 2.0;
        triangles.iter().map(area).collect()
    }

    fn upright(flat: &[[f32; 2]]) -> Vec<Point3> {
        flat.iter().map(|p| Point3::new(p[0], 7.0, -p[1])).collect()
    }

    #[test]
    fn fewer_than_three_corners_make_nothing() {
        assert!(cut(&[]).is_empty());
        assert!(cut(&upright(&[[0.0, 0.0], [1.0, 0.0]])).is_empty());
    }

    #[test]
    fn a_convex_polygon_becomes_a_fan() {
        let square = upright(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
        assert_eq!(cut(&square), [[0, 1, 2], [0, 2, 3]]);
    }

    #[test]
    fn an_arrow_is_cut_inside_itself_in_either_winding() {
        let mut arrow = upright(&[[0.0, 0.0], [2.0, 1.0], [4.0, 0.0], [2.0, 4.0]]);
        for _ in 0..2 {
            let triangles = cut(&arrow);
            let areas = areas(&arrow, &triangles);
            assert!(areas.iter().all(|&a| a > 0.0), "{areas:?}");
            assert_eq!(areas.iter().sum::<f64>(), 6.0);
            arrow.reverse();
        }
    }

    #[test]
    fn a_comb_is_cut_into_its_own_area() {
        let teeth = 200;
        let mut comb = vec![[0.0, -1.0], [2.0 * teeth as f32, -1.0]];
        for tooth in (0..teeth).rev() {
            let x = 2.0 * tooth as f32;
            comb.extend([[x + 2.0, 0.0], [x + 1.0, 5.0]]);
        }
        comb.push([0.0, 0.0]);
        let corners = upright(&comb);
        let triangles = cut(&corners);
        let areas = areas(&corners, &triangles);
        assert_eq!(triangles.len(), corners.len() - 2);
        assert!(areas.iter().all(|&a| a >= 0.0));
        let whole = f64::from(teeth) * (2.0 + 5.0);
        assert!((areas.iter().sum::<f64>() - whole).abs() < 1e-9);
    }

    #[test]
    fn polygons_without_area_and_bow_ties_still_come_apart() {
        let line = upright(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0]]);
        assert_eq!(cut(&line).len(), 2);
        let bow_tie = upright(&[[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 1.0]]);
        assert_eq!(cut(&bow_tie).len(), 2);
        assert_eq!(cut(&[Point3::ORIGIN; 9]).len(), 7);
    }

    #[test]
    fn a_huge_concave_polygon_is_fanned_and_said_so() {
        let n = MOST_CLIPPED_CORNERS + 2;
        let star: Vec<_> = (0..n)
            .map(|i| {
                let angle = i as f32 / n as f32 * std::f32::consts::TAU;
                let radius = if i % 2 == 0 { 1.0 } else { 0.5 };
                Point3::new(radius * angle.cos(), radius * angle.sin(), 0.0)
            })
            .collect();
        let mut count = 0;
        assert!(triangulate(&star, |_| count += 1));
        assert_eq!(count, n - 2);
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 256, failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn any_corners_make_two_triangles_fewer(
            corners in prop::collection::vec(prop::array::uniform3(-4_i8..4), 3..24),
        ) {
            let corners: Vec<_> = corners
                .iter()
                .map(|c| Point3::from(c.map(f32::from)))
                .collect();
            let triangles = cut(&corners);
            prop_assert_eq!(triangles.len(), corners.len() - 2);
            prop_assert!(triangles.iter().flatten().all(|&i| i < corners.len()));
        }
    }
}
