//! The cylinder.

use super::error::{ShapeError, positive};
use super::revolved::Revolved;
use super::{Ends, delegate_surface};
use crate::Point3;

/// A cylinder between two points, with caps or open.
///
/// u runs around the axis. On the side v runs from the first end (0) to the second (1), on a cap from
/// its centre (0) to the rim (1). The normal points away from the axis, on a cap out of the solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cylinder(pub(super) Revolved);

impl Cylinder {
    /// From the centres of its two ends and its radius.
    ///
    /// # Errors
    /// When a number is not finite, the ends are the same point or the radius is not above 0.
    pub fn new(from: Point3, to: Point3, radius: f32, ends: Ends) -> Result<Self, ShapeError> {
        let radius = positive("radius", radius)?;
        let axis = [("first end", from), ("second end", to)];
        Ok(Self(Revolved::new(axis, [radius; 2], ends)?))
    }
}

delegate_surface!(Cylinder);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::Surface;
    use crate::{Ray, Vector3};

    fn upright(ends: Ends) -> Cylinder {
        Cylinder::new(Point3::ORIGIN, Point3::new(0.0, 0.0, 2.0), 1.0, ends).unwrap()
    }

    fn ts(cylinder: &Cylinder, ray: Ray<f64>) -> Vec<f64> {
        cylinder.crossings(&ray).iter().map(|c| c.t).collect()
    }

    #[test]
    fn a_cylinder_needs_length_and_radius() {
        let (a, b) = (Point3::ORIGIN, Point3::new(0.0, 0.0, 1.0));
        let parameter = "axis";
        assert_eq!(
            Cylinder::new(a, a, 1.0, Ends::Open),
            Err(ShapeError::NoDirection { parameter })
        );
        for radius in [0.0, -1.0, f32::NAN, f32::INFINITY] {
            assert!(Cylinder::new(a, b, radius, Ends::Open).is_err(), "{radius}");
        }
    }

    #[test]
    fn a_ray_along_the_axis_meets_the_caps_if_there_are_any() {
        let down = Ray::new(Point3::new(0.5, 0.0, 5.0), Vector3::new(0.0, 0.0, -1.0));
        assert_eq!(ts(&upright(Ends::Capped), down), [3.0, 5.0]);
        assert!(ts(&upright(Ends::Open), down).is_empty());
    }

    #[test]
    fn through_a_rim_it_is_entered_once() {
        let rim = Ray::new(Point3::new(2.0, 0.0, 2.5), Vector3::new(-1.0, 0.0, -0.5));
        let found = ts(&upright(Ends::Capped), rim);
        assert_eq!(found.len(), 2);
        for (t, expected) in found.iter().zip([1.0, 3.0]) {
            assert!((t - expected).abs() < 1e-14, "{t}");
        }
    }

    #[test]
    fn along_a_cap_it_is_crossed_twice() {
        let along = Ray::new(Point3::new(-3.0, 0.0, 2.0), Vector3::new(1.0, 0.0, 0.0));
        assert_eq!(ts(&upright(Ends::Capped), along), [2.0, 4.0]);
        let above = Ray::new(Point3::new(-3.0, 0.0, 2.1), Vector3::new(1.0, 0.0, 0.0));
        assert!(ts(&upright(Ends::Capped), above).is_empty());
    }
}
