//! Shapes: one file each, all answering the same questions.
//!
//! The set is closed: [`Shape`] lists them, and dispatch is a `match`. A shape of your own goes
//! through the intersection program of a ray pipeline instead.
//!
//! Parameters are single precision, arithmetic is double precision, so that a sphere seen from a
//! thousand radii away is still round.
//!
//! [`Sphere`] and [`Triangle`] are plain data: any numbers will do, a degenerate one is never hit,
//! and [`Shape::validate`] says what is wrong with it. The others work something out once, and their
//! constructors refuse what makes no shape. Both say so with a [`ShapeError`].
//!
//! A closed shape has an even number of crossings with a line, unless the line touches it: at a rim,
//! an edge or a corner it is entered once and left once.

mod cone;
mod cuboid;
mod cylinder;
mod disk;
mod error;
mod faces;
mod frame;
mod frustum;
mod interval;
mod oriented_box;
mod plane;
mod polyhedron;
mod polyhedron_face;
mod rectangle;
mod revolved;
mod slabs;
mod sphere;
mod tessellate;
mod torus;
mod triangle;
mod turn;

use std::ops::ControlFlow;

use crate::{Aabb, Crossing, Crossings, Normal3, Point3, Ray, Vector3};

pub use cone::Cone;
pub use cuboid::Cuboid;
pub use cylinder::Cylinder;
pub use disk::Disk;
pub use error::ShapeError;
pub use frustum::{Frustum, FrustumView};
pub use oriented_box::OrientedBox;
pub use plane::Plane;
pub use polyhedron::{ConvexPolyhedron, HalfSpace};
pub use rectangle::Rectangle;
pub use sphere::Sphere;
pub use tessellate::{MAX_TRIANGLES, TessellationError, tessellate, triangle_count};
pub use torus::Torus;
pub use triangle::Triangle;

/// What every shape answers.
pub trait Surface {
    /// Its crossings with a ray whose t lies in `[t_min, t_max]`, near to far, each once. A line
    /// that only touches the surface crosses it once or not at all. Invalid rays have none.
    fn crossings(&self, ray: &Ray<f64>) -> Crossings;

    /// The box around it, rounded outward; unbounded where the shape is.
    fn bounds(&self) -> Aabb;

    /// Shows the [`crossings`](Self::crossings) to `visit`, near to far, until it breaks off: what is
    /// not asked for need not be worked out.
    ///
    /// # Errors
    /// `Break` if `visit` broke off.
    #[inline]
    fn visit_crossings(
        &self,
        ray: &Ray<f64>,
        visit: &mut impl FnMut(Crossing) -> ControlFlow<()>,
    ) -> ControlFlow<()>
    where
        Self: Sized,
    {
        self.crossings(ray).into_iter().try_for_each(visit)
    }

    /// From a point to the point of the surface that is nearest to it; if there are several, to one of
    /// them. A closed shape is its surface here too: inside it, the way out is meant. For the point
    /// and the shape to have one they must be finite and not degenerate.
    fn to_nearest(&self, point: Point3<f64>) -> Vector3<f64>;

    /// What the surface is like at a point on it. A point that is off by rounding is answered as
    /// the nearest one on the surface.
    fn surface_at(&self, point: Point3<f64>) -> SurfacePoint;

    /// The normal of [`surface_at`](Self::surface_at) alone, which may be cheaper.
    #[inline]
    fn normal_at(&self, point: Point3<f64>) -> Normal3<f64> {
        self.surface_at(point).normal
    }

    /// Whether a direction leads out through the surface at a point on it: to the side that the normal
    /// there points to.
    #[inline]
    fn leads_out(&self, point: Point3<f64>, direction: Vector3<f64>) -> bool {
        self.normal_at(point).dot(direction) > 0.0
    }

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

/// What the ends of a cylinder or a cone are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Ends {
    /// Flat disks: the shape is closed.
    #[default]
    Capped,
    /// Nothing: one looks into the shape.
    Open,
}

/// Answers as the shape inside does, for a shape that is a special case of another one.
macro_rules! delegate_surface {
    ($shape:ident) => {
        impl $crate::shape::Surface for $shape {
            #[inline]
            fn crossings(&self, ray: &$crate::Ray<f64>) -> $crate::Crossings {
                self.0.crossings(ray)
            }

            fn bounds(&self) -> $crate::Aabb {
                self.0.bounds()
            }

            fn to_nearest(&self, point: $crate::Point3<f64>) -> $crate::Vector3<f64> {
                self.0.to_nearest(point)
            }

            fn surface_at(&self, point: $crate::Point3<f64>) -> $crate::shape::SurfacePoint {
                self.0.surface_at(point)
            }

            fn area(&self) -> f64 {
                self.0.area()
            }

            fn sample(&self, xi: [f32; 2]) -> Option<$crate::shape::SurfaceSample> {
                self.0.sample(xi)
            }
        }
    };
}
use delegate_surface;

/// Every shape there is, from one list.
macro_rules! shapes {
    ($($name:ident),*) => {
        /// Every shape there is.
        #[derive(Clone, Debug, PartialEq)]
        #[non_exhaustive]
        pub enum Shape {
            $(#[doc = concat!("See [`", stringify!($name), "`].")] $name($name),)*
        }

        /// Asks the shape inside.
        macro_rules! each {
            ($shape:expr, $inner:ident => $answer:expr) => {
                match $shape { $(Shape::$name($inner) => $answer,)* }
            };
        }

        $(impl From<$name> for Shape {
            fn from(shape: $name) -> Self {
                Self::$name(shape)
            }
        })*
    };
}

shapes!(
    Sphere,
    Triangle,
    Plane,
    Disk,
    Rectangle,
    Cylinder,
    Cone,
    Cuboid,
    OrientedBox,
    Frustum,
    ConvexPolyhedron,
    Torus
);

impl Shape {
    /// Whether the shape can be hit.
    ///
    /// # Errors
    /// When it is a degenerate sphere or triangle; other shapes cannot be made degenerate.
    pub fn validate(&self) -> Result<(), ShapeError> {
        match self {
            Self::Sphere(sphere) => sphere.validate(),
            Self::Triangle(triangle) => triangle.validate(),
            _ => Ok(()),
        }
    }

    /// The crossings, by a call: compiled into a traversal, the tests of all shapes would make a stack
    /// frame of 10 KB for every test of a sphere.
    #[inline(never)]
    fn called(&self, ray: &Ray<f64>) -> Crossings {
        self.crossings(ray)
    }
}

impl Surface for Shape {
    #[inline]
    fn crossings(&self, ray: &Ray<f64>) -> Crossings {
        each!(self, shape => shape.crossings(ray))
    }

    #[inline]
    fn visit_crossings(
        &self,
        ray: &Ray<f64>,
        visit: &mut impl FnMut(Crossing) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        match self {
            Self::Sphere(sphere) => sphere.visit_crossings(ray, visit),
            Self::Plane(plane) => plane.visit_crossings(ray, visit),
            other => other.called(ray).into_iter().try_for_each(visit),
        }
    }

    fn bounds(&self) -> Aabb {
        each!(self, shape => shape.bounds())
    }

    fn to_nearest(&self, point: Point3<f64>) -> Vector3<f64> {
        each!(self, shape => shape.to_nearest(point))
    }

    fn surface_at(&self, point: Point3<f64>) -> SurfacePoint {
        each!(self, shape => shape.surface_at(point))
    }

    #[inline]
    fn normal_at(&self, point: Point3<f64>) -> Normal3<f64> {
        each!(self, shape => shape.normal_at(point))
    }

    #[inline]
    fn leads_out(&self, point: Point3<f64>, direction: Vector3<f64>) -> bool {
        each!(self, shape => shape.leads_out(point, direction))
    }

    fn area(&self) -> f64 {
        each!(self, shape => shape.area())
    }

    fn sample(&self, xi: [f32; 2]) -> Option<SurfaceSample> {
        each!(self, shape => shape.sample(xi))
    }
}
