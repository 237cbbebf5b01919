//! The lecture's camera.

use ombra_geometry::{Angle, Point3, Vector3};

/// A pinhole camera, by the lecture's formula: with (p_x, p_y) in `[0, 1]²` from the upper left
/// corner of the picture, the ray goes through
///
/// ((2 p_x − 1) · aspect · tan(fov/2), (1 − 2 p_y) · tan(fov/2), −1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Perspective {
    /// The angle between the top and the bottom of the picture, above 0° and below 180°.
    pub fov: Angle,
    /// By how much the picture's cut-out of the plane of the image moves to the right and down, in
    /// widths and heights of the picture: the shift lens of architects, which keeps verticals
    /// vertical.
    pub shift: [f32; 2],
}

impl Perspective {
    /// Without a shift.
    #[must_use]
    pub const fn new(fov: Angle) -> Self {
        Self {
            fov,
            shift: [0.0; 2],
        }
    }

    #[inline]
    pub(super) fn local_ray(
        &self,
        half: f32,
        aspect: f32,
        [px, py]: [f32; 2],
    ) -> (Point3, Vector3) {
        let [dx, dy] = self.shift;
        (
            Point3::ORIGIN,
            image_point(half, aspect, [px + dx, py + dy]),
        )
    }
}

/// Where the ray of a place in the picture meets the plane z = −1; `half` is the tangent of half the
/// angle.
#[inline]
pub(super) fn image_point(half: f32, aspect: f32, [px, py]: [f32; 2]) -> Vector3 {
    Vector3::new(
        (2.0 * px - 1.0) * aspect * half,
        (1.0 - 2.0 * py) * half,
        -1.0,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_corners_are_where_the_lecture_has_them() {
        let camera = Perspective::new(Angle::from_degrees(90.0));
        let at = |screen| camera.local_ray(1.0, 2.0, screen).1;
        assert_eq!(at([0.5, 0.5]), -Vector3::Z);
        let close = |a: Vector3, b: Vector3| (a - b).length() < 1e-6;
        assert!(close(at([0.0, 0.0]), Vector3::new(-2.0, 1.0, -1.0)));
        assert!(close(at([1.0, 1.0]), Vector3::new(2.0, -1.0, -1.0)));
    }

    #[test]
    fn a_shift_of_half_a_height_looks_down_from_the_horizon() {
        let camera = Perspective {
            shift: [0.0, 0.5],
            ..Perspective::new(Angle::from_degrees(90.0))
        };
        assert_eq!(camera.local_ray(1.0, 1.0, [0.5, 0.0]).1, -Vector3::Z);
        let lowest = camera.local_ray(1.0, 1.0, [0.5, 1.0]).1;
        assert!((lowest - Vector3::new(0.0, -2.0, -1.0)).length() < 1e-6);
    }
}
