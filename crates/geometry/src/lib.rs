//! Rays, boxes, transforms, shapes and triangle meshes: the ground that the rest of ombra stands on.
//!
//! Everything here is scalar and says what it means; speed comes from the crates above, which are
//! held against this one.
//!
//! ```
//! use ombra_geometry::shape::{Sphere, Surface};
//! use ombra_geometry::{Point3, Ray, Vector3};
//!
//! let ball = Sphere::new(Point3::new(0.0, 0.0, -3.0), 1.0);
//! let ray = Ray::new(Point3::ORIGIN, Vector3::new(0.0, 0.0, -1.0));
//! let first = ball.crossings(&ray.into())[0];
//! assert_eq!(first.t, 2.0);
//! ```
//!
//! # Units
//! Lengths are in whatever unit the scene is in; nothing here knows of metres. Angles are
//! [`Angle`]s. Single precision unless a type says otherwise: `Point3` is `Point3<f32>`.

pub mod mesh;
pub mod sampling;
pub mod shape;
pub mod triangle;

mod aabb;
mod angle;
mod crossing;
mod hit;
mod id;
mod polynomial;
mod ray;
mod transform;
mod vector;

pub use aabb::Aabb;
pub use angle::Angle;
pub use crossing::{Crossing, Crossings, EdgeRule, MAX_CROSSINGS};
pub use hit::Hit;
pub use id::{GeometryId, InstanceId, PrimitiveId};
pub use mesh::{MeshError, TriangleMesh};
pub use ray::Ray;
pub use transform::{Camera, Object, Transform, TransformError, World};
pub use vector::{Axis, Normal3, Point3, Real, Vector3};
