//! Where a line crosses a triangle, three ways.
//!
//! Each kernel is two steps: what can be worked out once a ray, and the test of one triangle. They
//! are chosen by name ([`TriangleTest`]); the watertight one is the default for meshes.

mod watertight;

use crate::{Crossing, EdgeRule, Point3, Ray, Real};

pub use watertight::Watertight;

/// A ray–triangle test. `T` is the precision that it works in.
pub trait TriangleKernel<T: Real>: Sized {
    /// Works out what only depends on the ray, which must be valid.
    fn new(ray: &Ray<T>) -> Self;

    /// Where the ray crosses a triangle, `u` and `v` being the barycentric weights of the second
    /// and third corner; `None` if it does not, or outside the ray's `[t_min, t_max]`. Both sides
    /// count. A triangle with a NaN corner or without area is never crossed.
    fn crossing(&self, ray: &Ray<T>, corners: [Point3<T>; 3], rule: EdgeRule) -> Option<Crossing>;
}

/// The ray–triangle tests, by name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum TriangleTest {
    /// [`Watertight`]: no ray escapes through an edge or a vertex.
    #[default]
    Watertight,
}

impl TriangleTest {
    /// All of them, the default first.
    pub const ALL: [Self; 1] = [Self::Watertight];

    /// The name that a person types.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Watertight => "watertight",
        }
    }

    /// Makes the test ready for one ray, which must be valid. `single` chooses single precision,
    /// which is enough where the triangles are not far away compared with their extent.
    #[must_use]
    #[inline]
    pub fn prepare(self, ray: &Ray<f64>, single: bool, rule: EdgeRule) -> PreparedTriangleTest {
        let near = Ray {
            origin: ray.origin.cast(),
            direction: ray.direction.cast(),
            t_min: ray.t_min as f32,
            t_max: ray.t_max as f32,
        };
        let kernel = match (self, single) {
            (Self::Watertight, true) => Kernel::WatertightSingle(near, Watertight::new(&near)),
            (Self::Watertight, false) => Kernel::WatertightDouble(*ray, Watertight::new(ray)),
        };
        PreparedTriangleTest { kernel, rule }
    }
}

/// A ray–triangle test that is ready for one ray.
#[derive(Clone, Copy, Debug)]
pub struct PreparedTriangleTest {
    kernel: Kernel,
    rule: EdgeRule,
}

#[derive(Clone, Copy, Debug)]
enum Kernel {
    WatertightSingle(Ray<f32>, Watertight<f32>),
    WatertightDouble(Ray<f64>, Watertight<f64>),
}

impl PreparedTriangleTest {
    /// See [`TriangleKernel::crossing`].
    #[must_use]
    #[inline]
    pub fn crossing(&self, corners: [Point3; 3]) -> Option<Crossing> {
        match &self.kernel {
            Kernel::WatertightSingle(ray, test) => test.crossing(ray, corners, self.rule),
            Kernel::WatertightDouble(ray, test) => {
                test.crossing(ray, corners.map(Point3::wide), self.rule)
            }
        }
    }
}
