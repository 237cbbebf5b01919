//! The triangles of a mesh, as primitives.

use std::ops::ControlFlow;
use std::sync::Arc;

use ombra_geometry::triangle::{PreparedTriangleTest, TriangleTest};
use ombra_geometry::{Aabb, EdgeRule, TriangleMesh};

use super::{AnyHit, Candidate, Primitives};
use crate::{Counter, TraversalRay};

/// The triangles of a mesh and how to test them.
#[derive(Clone, Debug)]
pub struct Mesh {
    mesh: Arc<TriangleMesh>,
    test: TriangleTest,
}

impl Mesh {
    /// With the default test, the watertight one.
    #[must_use]
    pub fn new(mesh: impl Into<Arc<TriangleMesh>>) -> Self {
        Self::with_test(mesh, TriangleTest::default())
    }

    /// With a test by name.
    #[must_use]
    pub fn with_test(mesh: impl Into<Arc<TriangleMesh>>, test: TriangleTest) -> Self {
        Self {
            mesh: mesh.into(),
            test,
        }
    }

    /// The mesh.
    #[must_use]
    pub const fn mesh(&self) -> &Arc<TriangleMesh> {
        &self.mesh
    }
}

impl Primitives for Mesh {
    type Prepared = PreparedTriangleTest;

    fn len(&self) -> usize {
        self.mesh.triangles().len()
    }

    #[inline]
    fn bounds(&self, primitive: u32) -> Aabb {
        self.mesh.triangle_bounds(primitive as usize)
    }

    #[inline]
    fn prepare(&self, ray: &TraversalRay, rule: EdgeRule) -> Self::Prepared {
        self.test.prepare(&ray.ray, ray.single(), rule)
    }

    #[inline]
    fn crossings<C: Counter, F: FnMut(&Candidate) -> AnyHit>(
        &self,
        prepared: &Self::Prepared,
        _ray: &TraversalRay,
        _t_max: f64,
        primitive: u32,
        counter: &mut C,
        report: &mut F,
    ) -> ControlFlow<()> {
        counter.test();
        if let Some(crossing) = prepared.crossing(self.mesh.corners(primitive as usize))
            && report(&Candidate::new(crossing, primitive)) == AnyHit::Terminate
        {
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    }

    fn bytes(&self) -> usize {
        self.mesh.bytes()
    }

    fn watertight(&self) -> Option<&TriangleMesh> {
        (self.test == TriangleTest::Watertight).then_some(&*self.mesh)
    }
}
