//! One triangle in the picture: clipped at the near plane, with depth and attributes.

use super::outline::Outline;
use super::view::Projected;

/// A triangle in the picture.
#[derive(Clone, Copy, Debug)]
pub(super) struct Facet {
    corners: [Projected; 3],
    /// What is seen of it.
    outline: Outline,
}

/// What a triangle is like at a place in the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Fragment {
    /// Along the direction of the camera.
    pub(super) depth: f64,
    /// The weights of the second and the third corner on the triangle itself: with them whatever
    /// belongs to the corners is interpolated, correct in perspective.
    pub(super) weights: [f64; 2],
}

impl Facet {
    /// `None` if nothing is in front of the near plane, a number is not finite, or the triangle is
    /// seen edge on.
    pub(super) fn new(corners: [Projected; 3], near: f64) -> Option<Self> {
        if !corners.iter().all(Projected::is_finite) {
            return None;
        }
        let mut places = [[0.0; 2]; 4];
        let count = clip(&corners, near, &mut places);
        Some(Self {
            corners,
            outline: Outline::new(&places[..count])?,
        })
    }

    pub(super) const fn outline(&self) -> &Outline {
        &self.outline
    }

    /// What the triangle is like at a place that it covers; `None` where rounding leaves nothing of
    /// it.
    ///
    /// Seen from a place in the picture, the corners are at (x − p_x w, y − p_y w). Of each the
    /// weight on the triangle is the area that the other two span with the origin: the edge function
    /// of a side, before any division by w. Of corners that were divided by w, as in the textbook, it
    /// is the edge function over the product of their two w: the same numbers but for a common
    /// factor.
    #[inline]
    pub(super) fn at(&self, [px, py]: [f64; 2]) -> Option<Fragment> {
        let [a, b, c] = self
            .corners
            .map(|corner| [corner.x - px * corner.w, corner.y - py * corner.w]);
        let area = |p: [f64; 2], q: [f64; 2]| p[0] * q[1] - p[1] * q[0];
        let areas = [area(b, c), area(c, a), area(a, b)];
        let sum = areas[0] + areas[1] + areas[2];
        // At an edge rounding may leave a weight on the other side of 0.
        let [u, v, w] = [areas[1], areas[2], areas[0]].map(|area| (area / sum).clamp(0.0, 1.0));
        let [a, b, c] = self.corners.map(|corner| corner.depth);
        let depth = a * w + b * u + c * v;
        depth.is_finite().then_some(Fragment {
            depth,
            weights: [u, v],
        })
    }
}

/// The corners in the picture of what is in front of the near plane: Sutherland, Hodgman, "Reentrant
/// Polygon Clipping", CACM 17(1), 1974, in homogeneous coordinates and so before the division that
/// would bring what is behind the eye to the front of it.
fn clip(corners: &[Projected; 3], near: f64, places: &mut [[f64; 2]; 4]) -> usize {
    let mut count = 0;
    let mut keep = |corner: Projected| {
        places[count] = corner.place();
        count += 1;
    };
    for (i, corner) in corners.iter().enumerate() {
        let next = &corners[(i + 1) % 3];
        let (here, there) = (corner.depth - near, next.depth - near);
        if here >= 0.0 {
            keep(*corner);
        }
        // From the side that is seen to the other one, whichever triangle asks: so two that share
        // the edge cut it at the same point, to the last bit.
        if here >= 0.0 && there < 0.0 {
            keep(corner.toward(next, here / (here - there), near));
        } else if here < 0.0 && there >= 0.0 {
            keep(next.toward(corner, there / (there - here), near));
        }
    }
    count
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Crop;

    const NEAR: f64 = 1e-9;

    /// With perspective, the picture plane at distance 1 in pixels.
    fn at(x: f64, y: f64, depth: f64) -> Projected {
        let w = depth;
        Projected { x, y, w, depth }
    }

    #[test]
    fn attributes_are_interpolated_on_the_triangle_and_not_in_the_picture() {
        // From (0, 0) at depth 1 to (10, 0) at depth 3: half way on the triangle is depth 2.
        let facet = Facet::new(
            [at(0.0, 0.0, 1.0), at(30.0, 0.0, 3.0), at(0.0, 10.0, 1.0)],
            NEAR,
        );
        let facet = facet.unwrap();
        let half_way = facet.at([15.0 / 2.0, 0.0]).unwrap();
        assert!((half_way.weights[0] - 0.5).abs() < 1e-15, "{half_way:?}");
        assert!((half_way.depth - 2.0).abs() < 1e-15);
        let corner = facet.at([0.0, 10.0]).unwrap();
        assert_eq!((corner.weights, corner.depth), ([0.0, 1.0], 1.0));
    }

    #[test]
    fn what_is_behind_the_eye_does_not_come_to_its_front() {
        let behind = [at(0.0, 0.0, -1.0), at(5.0, 0.0, -2.0), at(0.0, 5.0, -3.0)];
        assert!(Facet::new(behind, NEAR).is_none());
        // One corner behind: what is seen is between the two sides that leave it, and goes on
        // without end. Two corners behind: a triangle again.
        let crossing = |a, b, c| Facet::new([a, b, c], NEAR).unwrap();
        let one = crossing(at(0.0, 0.0, 1.0), at(8.0, 0.0, 1.0), at(4.0, 8.0, -1.0));
        assert!(one.outline().covers([1000.0, 1000.0]));
        assert!(one.outline().covers([4.0, 1.0]) && !one.outline().covers([4.0, -1.0]));
        let two = crossing(at(0.0, 0.0, 1.0), at(-8.0, 1.0, -1.0), at(-8.0, -1.0, -1.0));
        assert!(two.outline().covers([-1000.0, 0.0]) && !two.outline().covers([1.0, 0.0]));
        let cells = two.outline().cells(&Crop::all(4, 4), true);
        assert_eq!(cells.count(), 0, "it is on the left of the picture");
    }

    #[test]
    fn triangles_that_share_an_edge_through_the_near_plane_share_its_pixels() {
        let (front, behind) = (at(3.7, 2.1, 1.3), at(1.0, 9.0, -0.9));
        let (left, right) = (at(-20.0, 3.0, 0.7), at(33.0, 5.0, 0.4));
        let pair = [
            Facet::new([front, behind, left], NEAR).unwrap(),
            Facet::new([right, behind, front], NEAR).unwrap(),
        ];
        // Points of the line along which they meet, and next to it.
        let [x, y] = front.place();
        let [dx, dy] = [x - behind.x / behind.w, y - behind.y / behind.w];
        let mut covered = 0;
        for i in 0..2000 {
            let s = f64::from(i) / 10.0;
            for off in [0.0, 1e-12, -1e-12, 1e-3, -1e-3] {
                let p = [x + s * dx + off, y + s * dy];
                let count = pair
                    .iter()
                    .filter(|facet| facet.outline().covers(p))
                    .count();
                assert!(count <= 1, "{p:?} is covered twice");
                covered += count;
            }
        }
        assert!(covered > 5000, "{covered}");
    }

    #[test]
    fn what_is_no_triangle_is_left_out() {
        let p = at(1.0, 2.0, 3.0);
        assert!(Facet::new([p, p, at(2.0, 2.0, 3.0)], NEAR).is_none());
        assert!(Facet::new([p, at(f64::NAN, 0.0, 1.0), at(2.0, 2.0, 3.0)], NEAR).is_none());
        assert!(Facet::new([p, at(9.0, 0.0, f64::INFINITY), at(2.0, 2.0, 3.0)], NEAR).is_none());
    }
}
