//! What a scene is made of: a mesh or a list of shapes.

use std::ops::ControlFlow;

use ombra_geometry::triangle::PreparedTriangleTest;
use ombra_geometry::{Aabb, EdgeRule, TriangleMesh};

use super::{AnyHit, Candidate, Mesh, Primitives, Shapes};
use crate::{Counter, TraversalRay};

/// One geometry of a scene.
#[derive(Clone, Debug)]
pub enum Geometry {
    /// Triangles.
    Mesh(Mesh),
    /// Shapes.
    Shapes(Shapes),
}

impl Primitives for Geometry {
    type Prepared = Option<PreparedTriangleTest>;

    fn len(&self) -> usize {
        match self {
            Self::Mesh(mesh) => mesh.len(),
            Self::Shapes(shapes) => shapes.len(),
        }
    }

    #[inline]
    fn bounds(&self, primitive: u32) -> Aabb {
        match self {
            Self::Mesh(mesh) => mesh.bounds(primitive),
            Self::Shapes(shapes) => shapes.bounds(primitive),
        }
    }

    #[inline]
    fn prepare(&self, ray: &TraversalRay, rule: EdgeRule) -> Self::Prepared {
        match self {
            Self::Mesh(mesh) => Some(mesh.prepare(ray, rule)),
            Self::Shapes(_) => None,
        }
    }

    #[inline]
    fn crossings<C: Counter, F: FnMut(&Candidate) -> AnyHit>(
        &self,
        prepared: &Self::Prepared,
        ray: &TraversalRay,
        t_max: f64,
        primitive: u32,
        counter: &mut C,
        report: &mut F,
    ) -> ControlFlow<()> {
        match (self, prepared) {
            (Self::Mesh(mesh), Some(test)) => {
                mesh.crossings(test, ray, t_max, primitive, counter, report)
            }
            (Self::Mesh(_), None) => ControlFlow::Continue(()),
            (Self::Shapes(shapes), _) => {
                shapes.crossings(&(), ray, t_max, primitive, counter, report)
            }
        }
    }

    fn bytes(&self) -> usize {
        match self {
            Self::Mesh(mesh) => mesh.bytes(),
            Self::Shapes(shapes) => shapes.bytes(),
        }
    }

    fn watertight(&self) -> Option<&TriangleMesh> {
        match self {
            Self::Mesh(mesh) => mesh.watertight(),
            Self::Shapes(_) => None,
        }
    }

    #[inline]
    fn plain(&self) -> Option<&Shapes> {
        match self {
            Self::Mesh(_) => None,
            Self::Shapes(shapes) => Some(shapes),
        }
    }
}
