//! Finding the hit among millions.
//!
//! A [`Structure`] sorts boxes in space and, given a ray, names those primitives that it may hit.
//! [`Primitives`] know how to test one. [`Accel`] puts the two together and answers the questions
//! of [`Traversable`]: the closest hit, any hit, all hits. Every structure gives the same answers,
//! bit for bit; [`BruteForce`] is the judge.
//!
//! ```
//! use ombra_accel::{Accel, Mesh, StructureKind, Traversable};
//! use ombra_geometry::{Point3, Ray, TriangleMesh, Vector3};
//!
//! let corners = vec![
//!     Point3::new(0.0, 0.0, 0.0),
//!     Point3::new(1.0, 0.0, 0.0),
//!     Point3::new(0.0, 1.0, 0.0),
//! ];
//! let mesh = TriangleMesh::new(corners, vec![[0, 1, 2]])?;
//! let accel = Accel::build(Mesh::new(mesh), StructureKind::default());
//! let ray = Ray::new(Point3::new(0.25, 0.25, 1.0), -Vector3::Z);
//! assert_eq!(accel.intersect(&ray).unwrap().t, 1.0);
//! # Ok::<(), ombra_geometry::MeshError>(())
//! ```
//!
//! # How all structures come to agree
//! Single precision rounds, so a triangle test can report a point that lies a little outside the
//! triangle's box, and a structure that trusted boxes would then lose a hit that the brute-force
//! loop finds. Here a hit counts only if its point lies in its primitive's box, padded by a bound
//! on that rounding; and every structure is built or traversed with boxes padded by more. So what
//! counts is found, whichever way one looks. The bound is in [`TraversalRay`], the only place.

pub mod bvh;
pub mod bvh8;

mod accel;
mod alias;
mod bih;
mod box_tree;
mod brute_force;
mod cells;
mod distance;
mod grid;
mod grid2;
mod instance;
mod kd_tree;
mod kind;
mod lattice;
mod mask;
mod octree;
mod partition;
mod primitives;
mod refit;
mod search;
mod statistics;
mod structure;
mod traversable;
mod traversal_ray;
mod triangle_tree;

pub use accel::Accel;
pub use alias::StructureAlias;
pub use bih::Bih;
pub use box_tree::{BoxChild, BoxNode, BoxTree};
pub use brute_force::BruteForce;
pub use bvh8::file::{OtherMesh, Part as StructurePart, StructureFault, StructureFileError};
pub use bvh8::{Level, prefetch};
pub use distance::{ClosestPoint, Distances, Measured, Nearby, NoDistance, Place};
pub use grid::Grid;
pub use grid2::Grid2;
pub use instance::{Instance, Instances};
pub use kd_tree::{KdRestart, KdRopes, KdShortStack, KdStack};
pub use kind::{AnyStructure, StructureKind, UnknownStructure};
pub use mask::Masked;
pub use octree::Octree;
pub use primitives::{AnyHit, Candidate, Geometry, Mesh, Primitives, Shapes};
pub use statistics::{Counter, Statistics};
pub use structure::{Bounded, Span, Structure, Visitor};
pub use traversable::Traversable;
pub use traversal_ray::{Reach, TraversalRay};
pub use triangle_tree::TriangleTree;
