//! From the world to the picture: what the camera does to a point.

use ombra_geometry::{Camera as CameraSpace, Object, Point3, Ray, Transform, Vector3, World};
use ombra_scene::camera::{Camera, Projection};

use crate::{RenderError, Settings};

/// Of the largest coordinate in a scene, the part at which triangles are cut off: 2⁻⁴⁰⁰. Places in the
/// picture stay below 2⁴⁸⁰ then, whatever the angle and the size of the picture, and the product of
/// two of them, which an edge function takes, below the largest number that there is, 2¹⁰²³.
const NEAR: f64 = 3.872_591_914_849_318e-121;

/// A camera as a map of points.
///
/// It is the inverse of [`Camera::ray`]: of all points on the ray through a place in the picture it
/// makes that place. A thin lens counts as a pinhole in its middle.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    camera_from_world: Transform<World, CameraSpace>,
    /// Half of what the picture shows across and down: of the plane at distance 1 for a camera with
    /// perspective, in units of the scene otherwise.
    half: [f64; 2],
    /// Half of the picture, in pixels.
    middle: [f64; 2],
    /// Where the direction of the camera is seen, in units of `middle`: 1 unless it has a shift.
    ahead: [f64; 2],
    perspective: bool,
    near: f64,
}

/// A point in homogeneous coordinates of the picture: it is seen at (x / w, y / w), in pixels from
/// the upper left corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Projected {
    pub(super) x: f64,
    pub(super) y: f64,
    /// The same as `depth` with perspective, 1 without.
    pub(super) w: f64,
    /// How far the point is along the direction of the camera.
    pub(super) depth: f64,
}

impl Projected {
    pub(super) const fn is_finite(&self) -> bool {
        self.x.is_finite() && self.y.is_finite() && self.w.is_finite() && self.depth.is_finite()
    }

    /// Where in the picture.
    pub(super) fn place(&self) -> [f64; 2] {
        [self.x / self.w, self.y / self.w]
    }

    /// A part of the way to another point.
    pub(super) fn between(&self, other: &Self, part: f64) -> Self {
        let lerp = |a: f64, b: f64| a + (b - a) * part;
        Self {
            x: lerp(self.x, other.x),
            y: lerp(self.y, other.y),
            w: lerp(self.w, other.w),
            depth: lerp(self.depth, other.depth),
        }
    }

    /// Where the way to another point meets the near plane, after this part of it.
    pub(super) fn toward(&self, other: &Self, part: f64, near: f64) -> Self {
        let lerp = |a: f64, b: f64| a + (b - a) * part;
        Self {
            x: lerp(self.x, other.x),
            y: lerp(self.y, other.y),
            // With perspective the two differ, on either side of the plane. What rounding would make of
            // it could be 0, or behind the eye.
            w: if self.w == other.w { self.w } else { near },
            depth: near,
        }
    }
}

impl View {
    /// `reach` is the largest coordinate in the scene.
    pub(super) fn new(
        camera: &Camera,
        settings: &Settings,
        reach: f64,
    ) -> Result<Self, RenderError> {
        let (half_height, shift, perspective) = match &camera.projection {
            Projection::Perspective(p) => ((p.fov * 0.5).tan(), p.shift, true),
            Projection::ThinLens(p) => ((p.fov * 0.5).tan(), p.shift, true),
            Projection::Orthographic(p) => (p.height * 0.5, [0.0; 2], false),
            _ => return Err(RenderError::NotRasterizable),
        };
        let half = f64::from(half_height);
        let half = [half * f64::from(settings.aspect()), half];
        let middle = [settings.width, settings.height].map(|pixels| f64::from(pixels) / 2.0);
        let pose = &camera.pose;
        let axes = [Vector3::X, Vector3::Y, Vector3::Z].map(|axis| pose.world_from_camera(axis));
        let [x, y, z] = axes.map(|axis| axis.wide().to_array());
        let eye = pose.position().wide().to_array();
        let rows = [0, 1, 2].map(|i| [x[i], y[i], z[i], eye[i]]);
        // The axes are of unit length and perpendicular but for rounding; the inverse, and not the
        // transpose, undoes exactly what a ray went through.
        let world_from_camera = Transform::<CameraSpace, World>::from_rows(rows)
            .map_err(|_| RenderError::NotRasterizable)?;
        let reach = eye.iter().fold(reach, |reach, x| reach.max(x.abs()));
        Ok(Self {
            camera_from_world: world_from_camera.inverse(),
            half,
            middle,
            ahead: shift.map(|shift| 1.0 - 2.0 * f64::from(shift)),
            perspective,
            near: if perspective {
                (reach * NEAR).max(f64::MIN_POSITIVE)
            } else {
                0.0
            },
        })
    }

    /// The depth at which triangles are cut off.
    ///
    /// Rays see whatever is in front of the eye, however near, so the plane is as near as numbers
    /// allow (see [`NEAR`]): with perspective a point at depth 0 is nowhere in the picture. Without
    /// perspective it is the camera's own plane, where rays begin.
    pub(super) const fn near(&self) -> f64 {
        self.near
    }

    /// The way from the space of an object to that of the camera.
    pub(super) fn camera_from_object(
        &self,
        world_from_object: &Transform<Object, World>,
    ) -> Transform<Object, CameraSpace> {
        world_from_object.then(&self.camera_from_world)
    }

    /// The way from the world to the camera.
    pub(super) const fn camera_from_world(&self) -> &Transform<World, CameraSpace> {
        &self.camera_from_world
    }

    /// Where a point of the camera's space is seen.
    #[inline]
    pub(super) fn project(&self, p: Point3<f64>) -> Projected {
        let depth = -p.z;
        let w = if self.perspective { depth } else { 1.0 };
        Projected {
            x: (p.x / self.half[0] + w * self.ahead[0]) * self.middle[0],
            y: (w * self.ahead[1] - p.y / self.half[1]) * self.middle[1],
            w,
            depth,
        }
    }

    /// The width and height of the picture, in pixels.
    pub(super) fn pixels(&self) -> [f64; 2] {
        self.middle.map(|half| 2.0 * half)
    }

    /// The size of a pixel at some depth, in units of the scene.
    pub(super) fn pixel_at(&self, depth: f64) -> f64 {
        let at_one = self.half[1] / self.middle[1];
        if self.perspective {
            at_one * depth.max(self.near)
        } else {
            at_one
        }
    }

    /// Where on a ray of the camera a depth is: its t.
    pub(super) fn along(&self, ray: &Ray, depth: f64) -> f64 {
        depth / -self.camera_from_world.vector(ray.direction.wide()).z
    }

    /// The plane through `point` across `normal`, both in the camera's space, as a function of the
    /// place in the picture: its [`Horizon`]; `None` where it is seen edge on.
    pub(super) fn horizon(&self, point: Point3<f64>, normal: Vector3<f64>) -> Option<Horizon> {
        let offset = point.to_vector().dot(normal);
        // The direction of a ray is (x across, y up, −1), and its origin without perspective the
        // same with 0.
        let (across, up) = (normal.x * self.half[0], normal.y * self.half[1]);
        let slope = [across / self.middle[0], -up / self.middle[1]];
        let constant = up * self.ahead[1] - across * self.ahead[0];
        let [divisor, rest] = if self.perspective {
            [offset, constant - normal.z]
        } else {
            [normal.z, constant - offset]
        };
        let coefficients = [slope[0], slope[1], rest].map(|x| x / divisor);
        coefficients
            .iter()
            .all(|x| x.is_finite())
            .then_some(Horizon {
                coefficients,
                reciprocal: self.perspective,
                near: self.near,
            })
    }
}

/// An endless plane as the picture shows it: one edge function, whose value is 1 / depth with
/// perspective and depth without. Where it is 0 is the horizon, and the plane is on its positive
/// side: it needs no vertices, and so none that are far away.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Horizon {
    /// Of x, of y, and the constant one.
    coefficients: [f64; 3],
    reciprocal: bool,
    near: f64,
}

impl Horizon {
    #[inline]
    fn value(&self, [x, y]: [f64; 2]) -> f64 {
        let [a, b, c] = self.coefficients;
        a * x + b * y + c
    }

    /// The depth of the plane at a place in the picture; `None` where it is not seen.
    #[inline]
    pub(super) fn depth(&self, place: [f64; 2]) -> Option<f64> {
        let value = self.value(place);
        let depth = if self.reciprocal { 1.0 / value } else { value };
        (depth >= self.near && depth.is_finite()).then_some(depth)
    }

    /// The corners of the box around what is seen of the plane in a rectangle: its corners on the
    /// positive side, and where its sides cross the horizon. Empty where nothing is.
    pub(super) fn bounds(&self, low: [f64; 2], high: [f64; 2]) -> ([f64; 2], [f64; 2]) {
        let corners = [low, [high[0], low[1]], high, [low[0], high[1]]];
        let mut found = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        let mut hold = |p: [f64; 2]| {
            found.0 = [found.0[0].min(p[0]), found.0[1].min(p[1])];
            found.1 = [found.1[0].max(p[0]), found.1[1].max(p[1])];
        };
        for (i, &a) in corners.iter().enumerate() {
            let b = corners[(i + 1) % 4];
            let (at_a, at_b) = (self.value(a), self.value(b));
            if at_a >= 0.0 {
                hold(a);
            }
            if (at_a >= 0.0) != (at_b >= 0.0) {
                let part = at_a / (at_a - at_b);
                hold([0, 1].map(|k| a[k] + (b[k] - a[k]) * part));
            }
        }
        found
    }
}
