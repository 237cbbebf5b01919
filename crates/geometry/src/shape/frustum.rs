//! The frustum: what a camera with a near and a far plane sees.

use super::delegate_surface;
use super::error::{ShapeError, direction, finite, positive};
use super::polyhedron::ConvexPolyhedron;
use crate::{Angle, Point3, Vector3};

/// The parameters of a [`Frustum`]: those of a view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrustumView {
    /// The eye: where the four sides would meet.
    pub eye: Point3,
    /// Where the eye looks; of any length.
    pub direction: Vector3,
    /// What is up; its part perpendicular to the direction counts.
    pub up: Vector3,
    /// The angle between the lower and the upper side: above 0° and below 180°.
    pub vertical_fov: Angle,
    /// Width by height.
    pub aspect: f32,
    /// From the eye to the near face, along the direction; above 0.
    pub near: f32,
    /// From the eye to the far face, along the direction; above `near`.
    pub far: f32,
}

/// A pyramid with a rectangular base and its tip cut off: the part of space that a view shows.
///
/// Its surface parameters are those of a [`ConvexPolyhedron`].
#[derive(Clone, Debug, PartialEq)]
pub struct Frustum(ConvexPolyhedron);

impl Frustum {
    /// What a view shows.
    ///
    /// # Errors
    /// When a number is not finite or out of the range that [`FrustumView`] gives, the direction or
    /// up is 0, or the two are parallel.
    pub fn new(view: &FrustumView) -> Result<Self, ShapeError> {
        finite("eye", view.eye.is_finite())?;
        let ahead = direction("direction", view.direction.wide())?;
        let up = direction("up", view.up.wide())?;
        let parameter = "direction and up";
        let right = ahead.cross(up).normalized();
        let right = right.ok_or(ShapeError::Parallel { parameter })?;
        let up = right.cross(ahead);
        let slope = half_angle_tangent("vertical fov", view.vertical_fov)?;
        let aspect = positive("aspect", view.aspect)?;
        let (near, far) = (positive("near", view.near)?, positive("far", view.far)?);
        if near >= far {
            return Err(ShapeError::NotBelow {
                parameter: "near",
                value: view.near,
                other: "far",
                limit: view.far,
            });
        }
        let eye = view.eye.wide();
        let middle = f64::midpoint(near, far);
        // A side goes through the eye and through a point at the middle of the frustum.
        let side = |out: Vector3<f64>, slope: f64| {
            let normal = (out - ahead * slope) / slope.hypot(1.0);
            (eye + (ahead + out * slope) * middle, normal)
        };
        let planes = [
            (eye + ahead * near, -ahead),
            (eye + ahead * far, ahead),
            side(right, slope * aspect),
            side(-right, slope * aspect),
            side(up, slope),
            side(-up, slope),
        ];
        Ok(Self(ConvexPolyhedron::from_planes(&planes)?))
    }

    /// The same solid as a polyhedron.
    #[must_use]
    pub const fn polyhedron(&self) -> &ConvexPolyhedron {
        &self.0
    }
}

delegate_surface!(Frustum);

fn half_angle_tangent(parameter: &'static str, angle: Angle) -> Result<f64, ShapeError> {
    let degrees = angle.degrees();
    finite(parameter, degrees.is_finite())?;
    let tangent = (f64::from(angle.radians()) / 2.0).tan();
    if degrees > 0.0 && degrees < 180.0 && tangent > 0.0 {
        Ok(tangent)
    } else {
        Err(ShapeError::AngleOutOfRange { parameter, degrees })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Ray;
    use crate::shape::Surface;

    const VIEW: FrustumView = FrustumView {
        eye: Point3::ORIGIN,
        direction: Vector3::new(0.0, 0.0, -1.0),
        up: Vector3::new(0.0, 1.0, 0.0),
        vertical_fov: Angle::from_degrees(90.0),
        aspect: 2.0,
        near: 1.0,
        far: 3.0,
    };

    #[test]
    fn a_view_that_shows_nothing_is_refused() {
        for bad in [
            FrustumView { near: 3.0, ..VIEW },
            FrustumView { near: 0.0, ..VIEW },
            FrustumView {
                far: f32::INFINITY,
                ..VIEW
            },
            FrustumView {
                aspect: -1.0,
                ..VIEW
            },
            FrustumView {
                up: VIEW.direction,
                ..VIEW
            },
            FrustumView {
                direction: Vector3::ZERO,
                ..VIEW
            },
            FrustumView {
                vertical_fov: Angle::from_degrees(180.0),
                ..VIEW
            },
            FrustumView {
                vertical_fov: Angle::from_degrees(f32::NAN),
                ..VIEW
            },
        ] {
            assert!(Frustum::new(&bad).is_err(), "{bad:?}");
        }
    }

    #[test]
    fn it_has_the_corners_and_the_area_of_the_view() {
        let frustum = Frustum::new(&VIEW).unwrap();
        let bounds = frustum.bounds();
        for (found, expected) in [
            (bounds.min, [-6.0, -3.0, -3.0]),
            (bounds.max, [6.0, 3.0, -1.0]),
        ] {
            let off = found - Point3::from(expected);
            assert!(off.max_norm() < 1e-5, "{found:?}");
        }
        // Near 4 × 2, far 12 × 6, two trapezes of height √8, two of height √20.
        let sides =
            2.0 * (2.0 + 6.0) / 2.0 * 20.0_f64.sqrt() + 2.0 * (4.0 + 12.0) / 2.0 * 8.0_f64.sqrt();
        assert!((frustum.area() - (8.0 + 72.0 + sides)).abs() < 1e-4);
    }

    #[test]
    fn ahead_of_the_eye_it_begins_at_near_and_ends_at_far() {
        let ahead = Ray::new(Point3::new(0.0, 0.0, 0.0), Vector3::new(0.0, 0.0, -1.0));
        let frustum = Frustum::new(&VIEW).unwrap();
        let ts: Vec<_> = frustum.crossings(&ahead).iter().map(|c| c.t).collect();
        assert!((ts[0] - 1.0).abs() < 1e-14 && (ts[1] - 3.0).abs() < 1e-14);
    }
}
