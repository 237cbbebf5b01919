//! The cone, whole or truncated.

use super::error::{ShapeError, finite, positive};
use super::revolved::Revolved;
use super::{Ends, delegate_surface};
use crate::Point3;

/// A cone, whole or truncated, with caps or open.
///
/// u runs around the axis. On the side v runs from the base (0) to the apex or the top (1), on a cap
/// from its centre (0) to the rim (1). The normal points away from the axis, on a cap out of the
/// solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone(pub(super) Revolved);

impl Cone {
    /// From the centre of its base, its apex and the radius of the base.
    ///
    /// # Errors
    /// When a number is not finite, base and apex are the same point or the radius is not above 0.
    pub fn new(base: Point3, apex: Point3, radius: f32, ends: Ends) -> Result<Self, ShapeError> {
        let radius = positive("radius", radius)?;
        let axis = [("base", base), ("apex", apex)];
        Ok(Self(Revolved::new(axis, [radius, 0.0], ends)?))
    }

    /// From the centre of its base, the centre of its top and the radius of each. A radius may be 0,
    /// but not both; they may be the same.
    ///
    /// # Errors
    /// When a number is not finite, base and top are the same point, a radius is negative or both
    /// are 0.
    pub fn truncated(
        base: Point3,
        top: Point3,
        [base_radius, top_radius]: [f32; 2],
        ends: Ends,
    ) -> Result<Self, ShapeError> {
        for (parameter, value) in [("base radius", base_radius), ("top radius", top_radius)] {
            finite(parameter, value.is_finite())?;
            if value < 0.0 {
                return Err(ShapeError::Negative { parameter, value });
            }
        }
        positive("larger radius", base_radius.max(top_radius))?;
        let axis = [("base", base), ("top", top)];
        let radii = [base_radius, top_radius].map(f64::from);
        Ok(Self(Revolved::new(axis, radii, ends)?))
    }
}

delegate_surface!(Cone);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::Surface;
    use crate::{Ray, Vector3};

    fn upright(ends: Ends) -> Cone {
        Cone::new(Point3::ORIGIN, Point3::new(0.0, 0.0, 1.0), 1.0, ends).unwrap()
    }

    fn ts(cone: &Cone, origin: [f64; 3], direction: [f64; 3]) -> Vec<f64> {
        let ray = Ray::new(Point3::from(origin), Vector3::from(direction));
        cone.crossings(&ray).iter().map(|c| c.t).collect()
    }

    #[test]
    fn a_cone_needs_height_and_one_radius() {
        let (a, b) = (Point3::ORIGIN, Point3::new(0.0, 0.0, 1.0));
        assert!(Cone::new(a, a, 1.0, Ends::Capped).is_err());
        assert!(Cone::new(a, b, 0.0, Ends::Capped).is_err());
        assert!(Cone::truncated(a, b, [0.0, 0.0], Ends::Capped).is_err());
        let (parameter, value) = ("top radius", -1.0);
        assert_eq!(
            Cone::truncated(a, b, [1.0, -1.0], Ends::Capped),
            Err(ShapeError::Negative { parameter, value })
        );
        assert!(Cone::truncated(a, b, [0.0, 1.0], Ends::Capped).is_ok());
    }

    #[test]
    fn the_other_half_of_the_double_cone_is_not_there() {
        let cone = upright(Ends::Capped);
        assert!(ts(&cone, [-5.0, 0.0, 1.5], [1.0, 0.0, 0.0]).is_empty());
        assert_eq!(ts(&cone, [-5.0, 0.0, 0.5], [1.0, 0.0, 0.0]), [4.5, 5.5]);
    }

    #[test]
    fn through_the_apex_along_the_axis_it_is_entered_there() {
        let down = ([0.0, 0.0, 3.0], [0.0, 0.0, -1.0]);
        assert_eq!(ts(&upright(Ends::Capped), down.0, down.1), [2.0, 3.0]);
        assert_eq!(ts(&upright(Ends::Open), down.0, down.1), [2.0]);
    }

    #[test]
    fn parallel_to_its_side_it_is_crossed_once_there() {
        // The quadratic is linear here.
        let crossings = ts(&upright(Ends::Capped), [0.5, 0.0, -1.0], [-1.0, 0.0, 1.0]);
        assert_eq!(crossings, [1.0, 1.25]);
    }
}
