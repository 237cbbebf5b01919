//! Where a camera stands and which way it looks.

use ombra_geometry::{Point3, Vector3};

/// A position and three unit vectors: right, up, and back (the camera looks along −back).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    position: Point3,
    right: Vector3,
    up: Vector3,
    back: Vector3,
}

/// Why there is no such pose.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PoseError {
    /// The direction has no length, or a number is not finite.
    #[error(
        "the camera has no direction to look in: position and target must be finite and differ"
    )]
    NoDirection,
    /// Up points along the direction, so right is nowhere.
    #[error("the camera's up vector must not be zero or parallel to its direction")]
    UpAlongDirection,
}

impl Default for Pose {
    /// At the origin, looking along −z with y up.
    fn default() -> Self {
        Self {
            position: Point3::ORIGIN,
            right: Vector3::X,
            up: Vector3::Y,
            back: Vector3::Z,
        }
    }
}

impl Pose {
    /// From a position, a direction to look in, and a vector that appears upright in the picture.
    /// Neither needs unit length, nor a right angle between them.
    ///
    /// # Errors
    /// When one of them has no direction or both have the same.
    pub fn new(position: Point3, direction: Vector3, up: Vector3) -> Result<Self, PoseError> {
        let forward = direction.normalized().ok_or(PoseError::NoDirection)?;
        if !position.is_finite() {
            return Err(PoseError::NoDirection);
        }
        let up = up.normalized().ok_or(PoseError::UpAlongDirection)?;
        let right = forward.cross(up);
        // Closer than a ten-thousandth of a radian is rounding, not a direction.
        if right.length() < 1e-4 {
            return Err(PoseError::UpAlongDirection);
        }
        let right = right.normalized().ok_or(PoseError::UpAlongDirection)?;
        Ok(Self {
            position,
            right,
            up: right.cross(forward),
            back: -forward,
        })
    }

    /// From a position and a point to look at.
    ///
    /// # Errors
    /// When the two are the same point, or `up` points from one to the other.
    pub fn look_at(position: Point3, target: Point3, up: Vector3) -> Result<Self, PoseError> {
        Self::new(position, target - position, up)
    }

    /// Where the camera stands.
    #[must_use]
    pub const fn position(&self) -> Point3 {
        self.position
    }

    /// Which way it looks, unit length.
    #[must_use]
    pub fn direction(&self) -> Vector3 {
        -self.back
    }

    /// Takes a vector from the camera's space to the world's.
    #[must_use]
    #[inline]
    pub fn world_from_camera(&self, v: Vector3) -> Vector3 {
        self.right * v.x + self.up * v.y + self.back * v.z
    }

    /// Takes a vector from the world's space to the camera's.
    #[must_use]
    #[inline]
    pub fn camera_from_world(&self, v: Vector3) -> Vector3 {
        Vector3::new(self.right.dot(v), self.up.dot(v), self.back.dot(v))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pose_needs_a_direction_and_another_one_up() {
        let o = Point3::ORIGIN;
        assert_eq!(Pose::look_at(o, o, Vector3::Y), Err(PoseError::NoDirection));
        assert_eq!(
            Pose::new(o, Vector3::Y, Vector3::Y),
            Err(PoseError::UpAlongDirection)
        );
        assert_eq!(
            Pose::new(o, Vector3::Y, Vector3::ZERO),
            Err(PoseError::UpAlongDirection)
        );
        assert!(Pose::new(o, Vector3::new(f32::NAN, 0.0, 1.0), Vector3::Y).is_err());
    }

    #[test]
    fn up_is_up_and_right_is_right() {
        let pose = Pose::look_at(Point3::new(0.0, 0.0, 5.0), Point3::ORIGIN, Vector3::Y).unwrap();
        assert_eq!(pose.direction(), -Vector3::Z);
        assert_eq!(pose.world_from_camera(Vector3::X), Vector3::X);
        assert_eq!(pose.camera_from_world(Vector3::Y), Vector3::Y);
    }
}
