//! Primitives that a program brings along.

use std::ops::ControlFlow;

use ombra_accel::{
    Accel, AnyHit, Candidate, Counter, Primitives, StructureKind, Traversable, TraversalRay,
};
use ombra_geometry::{Aabb, Crossing, EdgeRule, Point3, Ray, Vector3};

/// One thing with a box, met by every ray at t = 1.
#[derive(Clone)]
struct MetAtOne(Aabb);

impl Primitives for MetAtOne {
    type Prepared = ();

    fn len(&self) -> usize {
        1
    }

    fn bounds(&self, _primitive: u32) -> Aabb {
        self.0
    }

    fn prepare(&self, _ray: &TraversalRay, _rule: EdgeRule) {}

    fn crossings<C: Counter, F: FnMut(&Candidate) -> AnyHit>(
        &self,
        _prepared: &(),
        _ray: &TraversalRay,
        _t_max: f64,
        primitive: u32,
        counter: &mut C,
        report: &mut F,
    ) -> ControlFlow<()> {
        counter.test();
        let crossing = Crossing {
            t: 1.0,
            u: 0.0,
            v: 0.0,
        };
        report(&Candidate::new(crossing, primitive));
        ControlFlow::Continue(())
    }

    fn bytes(&self) -> usize {
        0
    }
}

#[test]
fn what_has_no_end_on_one_side_keeps_its_rounded_hits() {
    let mut half = Aabb::around([Point3::ORIGIN, Point3::new(1.0, 1.0, 1.0)]);
    let whole = half;
    half.max.x = f32::INFINITY;
    // At t = 1 this is a rounding above the box.
    let ray = Ray::new(
        Point3::new(0.5, 1.0_f32.next_up(), -1.0),
        Vector3::new(0.0, 0.0, 1.5),
    );
    let beside = Ray::new(Point3::new(0.5, 2.0, -1.0), Vector3::new(0.0, 0.0, 1.5));
    for &kind in StructureKind::ALL {
        let half = Accel::build(MetAtOne(half), kind);
        assert_eq!(half.bounds(), Aabb::UNBOUNDED);
        assert_eq!(half.intersect(&ray).map(|hit| hit.t), Some(1.0), "{kind}");
        let whole = Accel::build(MetAtOne(whole), kind);
        assert_eq!(whole.intersect(&ray).map(|hit| hit.t), Some(1.0), "{kind}");
        assert_eq!(whole.intersect(&beside), None, "{kind}");
    }
}
