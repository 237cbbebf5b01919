//! Primitives of a program's own that distances can be asked of, and how few are.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use ombra_accel::{
    Accel, AnyHit, Candidate, Counter, Instance, Instances, Measured, Mesh, Nearby, NoDistance,
    Place, Primitives, StructureKind, TraversalRay,
};
use ombra_geometry::{Aabb, EdgeRule, GeometryId, Object, Transform, World};

use crate::distances::{at, scaled, turned};
use crate::meshes;
use crate::numbers::Numbers;

/// A mesh that counts how many of its triangles are measured.
#[derive(Clone)]
struct Counted(Mesh, Arc<AtomicUsize>);

impl Primitives for Counted {
    type Prepared = <Mesh as Primitives>::Prepared;

    fn len(&self) -> usize {
        self.0.len()
    }

    fn bounds(&self, primitive: u32) -> Aabb {
        self.0.bounds(primitive)
    }

    fn prepare(&self, ray: &TraversalRay, rule: EdgeRule) -> Self::Prepared {
        self.0.prepare(ray, rule)
    }

    fn crossings<C: Counter, F: FnMut(&Candidate) -> AnyHit>(
        &self,
        prepared: &Self::Prepared,
        ray: &TraversalRay,
        t_max: f64,
        primitive: u32,
        counter: &mut C,
        report: &mut F,
    ) -> ControlFlow<()> {
        self.0
            .crossings(prepared, ray, t_max, primitive, counter, report)
    }

    fn bytes(&self) -> usize {
        self.0.bytes()
    }
}

impl Measured for Counted {
    fn check(&self, placed: Option<&Transform<Object, World>>) -> Result<(), NoDistance> {
        self.0.check(placed)
    }

    fn measure(&self, primitive: u32, place: &Place<'_>, near: &mut Nearby) -> ControlFlow<()> {
        self.1.fetch_add(1, Ordering::Relaxed);
        self.0.measure(primitive, place, near)
    }
}

#[test]
fn the_tree_measures_a_few_of_many() {
    let mesh = meshes::icosphere(5);
    let all = mesh.triangles().len();
    let measured = Arc::new(AtomicUsize::new(0));
    let counted = Counted(Mesh::new(mesh), Arc::clone(&measured));
    let kind = StructureKind::default();
    let alone = Arc::new(Accel::build(counted, kind));
    let place = scaled(1.0, 0.5, 2.0)
        .then(&turned(0.7))
        .then(&at(5.0, 0.0, 0.0));
    let placed = vec![Instance::new(GeometryId(0), place)];
    let placed = Accel::build(Instances::new(vec![Arc::clone(&alone)], placed), kind);
    let mut numbers = Numbers::new(63);
    let queries = 200;
    for placed_too in [false, true] {
        for _ in 0..queries {
            let point = numbers.point(2.0).wide();
            let found = if placed_too {
                let there = placed.distances().unwrap();
                there.closest_point(place.point(point), f64::INFINITY)
            } else {
                alone
                    .distances()
                    .unwrap()
                    .closest_point(point, f64::INFINITY)
            };
            assert!(found.is_some());
        }
        // Most points are outside. From its middle a ball is equally far away everywhere.
        let cost = measured.swap(0, Ordering::Relaxed) / queries;
        assert!(cost < all / 40, "{cost} of {all}, {placed_too}");
    }
}
