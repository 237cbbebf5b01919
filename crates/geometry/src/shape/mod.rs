//! Shapes: one file each, all answering the same questions.
//!
//! The set is closed: [`Shape`] lists them, and dispatch is a `match`. A shape of your own goes
//! through the intersection program of a ray pipeline instead.
//!
//! Parameters are single precision, arithmetic is double precision, so that a sphere seen from a
//! thousand radii away is still round.

mod sphere;

use crate::{Aabb, Crossings, Normal3, Point3, Ray};

pub use sphere::Sphere;

/// What every shape answers.
pub trait Surface {
    /// Its crossings with a ray whose t lies in `[t_min, t_max]`, near to far, each once. A line
    /// that only touches the surface crosses it once or not at all. Invalid rays have none.
    fn crossings(&self, ray: &Ray<f64>) -> Crossings;

    /// The box around it, rounded outward; unbounded where the shape is.
    fn bounds(&self) -> Aabb;

    /// What the surface is like at a point on it. A point that is off by rounding is answered as
    /// the nearest one on the surface.
    fn surface_at(&self, point: Point3<f64>) -> SurfacePoint;

    /// The area of the surface; infinite where the shape is.
    fn area(&self) -> f64;

    /// A point on the surface, uniform by area, from two numbers in `[0, 1)`; `None` where there
    /// is no such density: an endless shape, or one without area.
    fn sample(&self, xi: [f32; 2]) -> Option<SurfaceSample>;
}

/// The surface at one point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// Unit normal, outward where there is an outside.
    pub normal: Normal3<f64>,
    /// Surface parameters in `[0, 1]²`.
    pub uv: [f32; 2],
}

/// A point chosen on a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceSample {
    /// Where.
    pub point: Point3<f64>,
    /// Unit normal there, outward where there is an outside.
    pub normal: Normal3<f64>,
    /// The density with which it was chosen, per unit of area.
    pub pdf: f64,
}

/// Every shape there is.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Shape {
    /// See [`Sphere`].
    Sphere(Sphere),
}

/// Asks the shape inside.
macro_rules! each {
    ($shape:expr, $inner:ident => $answer:expr) => {
        match $shape {
            Shape::Sphere($inner) => $answer,
        }
    };
}

impl Surface for Shape {
    #[inline]
    fn crossings(&self, ray: &Ray<f64>) -> Crossings {
        each!(self, shape => shape.crossings(ray))
    }

    fn bounds(&self) -> Aabb {
        each!(self, shape => shape.bounds())
    }

    fn surface_at(&self, point: Point3<f64>) -> SurfacePoint {
        each!(self, shape => shape.surface_at(point))
    }

    fn area(&self) -> f64 {
        each!(self, shape => shape.area())
    }

    fn sample(&self, xi: [f32; 2]) -> Option<SurfaceSample> {
        each!(self, shape => shape.sample(xi))
    }
}

impl From<Sphere> for Shape {
    fn from(shape: Sphere) -> Self {
        Self::Sphere(shape)
    }
}
