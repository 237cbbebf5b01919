//! Cameras: from a place in the picture to a ray.
//!
//! All but the lens are the same in one thing: a [`Pose`] says where the camera stands and which
//! way it looks; the projection says where the ray of a pixel goes in the camera's own space
//! (x right, y up, looking along −z).

mod orthographic;
mod panorama;
mod perspective;
mod pose;
mod thin_lens;

use ombra_geometry::{Aabb, Angle, Point3, Ray, Vector3};

pub use orthographic::Orthographic;
pub use panorama::Panorama;
pub use perspective::Perspective;
pub use pose::{Pose, PoseError};
pub use thin_lens::{Aperture, ThinLens};

/// How a camera makes a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Projection {
    /// See [`Perspective`].
    Perspective(Perspective),
    /// See [`ThinLens`].
    ThinLens(ThinLens),
    /// See [`Orthographic`].
    Orthographic(Orthographic),
    /// See [`Panorama`].
    Panorama(Panorama),
}

/// A place in the picture and on the lens: what one camera ray is made from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraSample {
    /// Where in the picture: (0, 0) is the upper left corner, (1, 1) the lower right one.
    pub screen: [f32; 2],
    /// Where on the lens: two uniform numbers in `[0, 1)`. Only a lens uses them.
    pub lens: [f32; 2],
}

impl CameraSample {
    /// Through the middle of the lens.
    #[must_use]
    pub const fn pinhole(screen: [f32; 2]) -> Self {
        Self {
            screen,
            lens: [0.5; 2],
        }
    }
}

/// A camera: where it stands and how it makes a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Where it stands and which way it looks.
    pub pose: Pose,
    /// How it makes a picture.
    pub projection: Projection,
}

impl Camera {
    /// The ray of a place in the picture; its direction has unit length. `aspect` is the width of
    /// the picture over its height.
    #[must_use]
    #[inline]
    pub fn ray(&self, aspect: f32, sample: CameraSample) -> Ray {
        self.rays(aspect).ray(sample)
    }

    /// The same for many places in one picture: what they share is worked out once.
    #[must_use]
    pub fn rays(&self, aspect: f32) -> CameraRays<'_> {
        let fov = match &self.projection {
            Projection::Perspective(p) => p.fov,
            Projection::ThinLens(p) => p.fov,
            Projection::Orthographic(_) | Projection::Panorama(_) => Angle::from_radians(0.0),
        };
        CameraRays {
            camera: self,
            aspect,
            half: (fov * 0.5).tan(),
        }
    }

    /// What is on the right and what faces the viewer of a model whose unit vector `up` points up:
    /// its front is +z where y is up and −y where z is up, as modellers have it.
    #[must_use]
    pub fn sides(up: Vector3) -> (Vector3, Vector3) {
        let nearly = if up.y.abs() >= up.z.abs() {
            Vector3::Z
        } else {
            -Vector3::Y
        };
        let right = up.cross(nearly).normalized().unwrap_or(Vector3::X);
        (right, right.cross(up))
    }

    /// A camera that sees all of a box, from a little above its front and to the right, for models
    /// that come without one. An empty or unbounded box is taken as the unit cube.
    #[must_use]
    pub fn framing(bounds: &Aabb, up: Vector3, aspect: f32) -> Self {
        let unit = Aabb::around([Point3::new(-0.5, -0.5, -0.5), Point3::new(0.5, 0.5, 0.5)]);
        let usable = !bounds.is_empty() && bounds.is_finite();
        let bounds = if usable { *bounds } else { unit };
        let fov = Angle::from_degrees(35.0);
        let up = up.normalized().unwrap_or(Vector3::Y);
        let (right, front) = Self::sides(up);
        let away = (front + right * 0.55 + up * 0.4)
            .normalized()
            .unwrap_or(front);
        // A single point is looked at from a distance that its coordinates can express.
        let least = bounds.centre().to_vector().max_norm() * 1e-4;
        let radius = (bounds.extent().length() * 0.5).max(least).max(1e-30);
        let half = (fov * 0.5).tan().min((fov * 0.5).tan() * aspect).atan();
        let centre = bounds.centre();
        let position = centre + away * (radius / half.sin());
        let pose = Pose::look_at(position, centre, up).unwrap_or_default();
        Self {
            pose,
            projection: Projection::Perspective(Perspective::new(fov)),
        }
    }
}

/// The rays of one picture.
#[derive(Clone, Copy, Debug)]
pub struct CameraRays<'a> {
    camera: &'a Camera,
    aspect: f32,
    /// The tangent of half the angle of view, if there is one.
    half: f32,
}

impl CameraRays<'_> {
    /// The ray of a place in the picture; its direction has unit length.
    #[must_use]
    #[inline]
    pub fn ray(&self, sample: CameraSample) -> Ray {
        let Self {
            camera: Camera { pose, projection },
            aspect,
            half,
        } = *self;
        let (origin, direction) = match projection {
            Projection::Perspective(p) => p.local_ray(half, aspect, sample.screen),
            Projection::ThinLens(p) => p.local_ray(half, aspect, sample),
            Projection::Orthographic(p) => p.local_ray(aspect, sample.screen),
            Projection::Panorama(p) => p.local_ray(sample.screen),
        };
        let direction = pose.world_from_camera(direction);
        Ray::new(
            pose.position() + pose.world_from_camera(origin.to_vector()),
            direction.normalized().unwrap_or(direction),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_framed_box_is_in_the_picture_whatever_its_shape() {
        let boxes = [
            Aabb::EMPTY,
            Aabb::around([Point3::ORIGIN]),
            Aabb::around([Point3::ORIGIN, Point3::new(100.0, 1.0, 1.0)]),
            Aabb::around([
                Point3::new(1e6, 1e6, 0.0),
                Point3::new(1e6 + 50.0, 1e6 + 20.0, 9.0),
            ]),
        ];
        for bounds in boxes {
            for aspect in [0.5, 1.0, 2.0] {
                for up in [Vector3::Y, Vector3::Z] {
                    let camera = Camera::framing(&bounds, up, aspect);
                    let ray = camera.ray(aspect, CameraSample::pinhole([0.5, 0.5]));
                    assert!(ray.is_valid());
                    for corner in bounds.corners().into_iter().filter(|c| c.is_finite()) {
                        let way = camera.pose.camera_from_world(corner - ray.origin);
                        let half = Angle::from_degrees(17.5).tan() * 1.01;
                        assert!(way.z <= 0.0, "{corner:?} is behind");
                        assert!((way.y / way.z).abs() <= half || way.length() == 0.0);
                        assert!((way.x / way.z).abs() <= half * aspect || way.length() == 0.0);
                    }
                }
            }
        }
    }
}
