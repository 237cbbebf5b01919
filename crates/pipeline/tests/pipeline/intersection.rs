//! Primitives of one's own, against the built-in ones.

use std::ops::ControlFlow;

use ombra_accel::{Accel, AnyHit, Shapes, StructureKind, Traversable};
use ombra_geometry::shape::Sphere;
use ombra_geometry::{Aabb, Crossing, Point3, Ray, Vector3};
use ombra_pipeline::{Custom, Intersection};
use proptest::prelude::*;

/// Spheres again, by the lecture's formula. Reports both roots whatever the ray's ends are.
struct Balls(Vec<Sphere>);

fn box_of(sphere: &Sphere) -> Aabb {
    Aabb::around([sphere.centre]).padded(sphere.radius)
}

impl Intersection for Balls {
    fn count(&self) -> usize {
        self.0.len()
    }

    fn bounds(&self, primitive: u32) -> Aabb {
        box_of(&self.0[primitive as usize])
    }

    fn intersect(
        &self,
        ray: &Ray<f64>,
        primitive: u32,
        mut report: impl FnMut(Crossing) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let Sphere { centre, radius } = self.0[primitive as usize];
        let from_centre = ray.origin - centre.wide();
        let a = ray.direction.length_squared();
        let b = 2.0 * ray.direction.dot(from_centre);
        let c = from_centre.length_squared() - f64::from(radius * radius);
        let discriminant = b * b - 4.0 * a * c;
        if discriminant >= 0.0 {
            for root in [-discriminant.sqrt(), discriminant.sqrt()] {
                let t = (root - b) / (2.0 * a);
                report(Crossing { t, u: 0.0, v: 0.0 })?;
            }
        }
        ControlFlow::Continue(())
    }
}

/// One sphere as a signed-distance field, marched: Hart, "Sphere Tracing", The Visual Computer
/// 12(10), 1996.
struct Field(Sphere);

impl Intersection for Field {
    fn count(&self) -> usize {
        1
    }

    fn bounds(&self, _primitive: u32) -> Aabb {
        box_of(&self.0).padded(1e-3)
    }

    fn intersect(
        &self,
        ray: &Ray<f64>,
        _primitive: u32,
        mut report: impl FnMut(Crossing) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let speed = ray.direction.length();
        let mut t = ray.t_min;
        for _ in 0..500 {
            let away = (ray.at(t) - self.0.centre.wide()).length() - f64::from(self.0.radius);
            if away < 1e-7 {
                return report(Crossing { t, u: 0.0, v: 0.0 });
            }
            t += away / speed;
            if t > ray.t_max {
                break;
            }
        }
        ControlFlow::Continue(())
    }
}

/// Reports what it should not, and goes on when it is told to stop.
struct Unruly;

impl Intersection for Unruly {
    fn count(&self) -> usize {
        1
    }

    fn bounds(&self, _primitive: u32) -> Aabb {
        Aabb::around([Point3::new(-1.0, -1.0, -1.0), Point3::new(9.0, 1.0, 1.0)])
    }

    fn intersect(
        &self,
        _ray: &Ray<f64>,
        _primitive: u32,
        mut report: impl FnMut(Crossing) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        for t in [f64::NAN, f64::INFINITY, -0.5, 1e9, 4.0, 3.0, 20.0, 2.0] {
            let _ = report(Crossing { t, u: 0.0, v: 0.0 });
        }
        ControlFlow::Continue(())
    }
}

fn scattered() -> Vec<Sphere> {
    let place = |i: i32, n: i32| (i * n % 17) as f32 / 2.0;
    let ball = |i| {
        let centre = Point3::new(place(i, 3), place(i, 5), place(i, 7));
        Sphere::new(centre, 0.3 + place(i, 11) / 20.0)
    };
    (1..40).map(ball).collect()
}

fn ray_at(from: [f32; 3], toward: [f32; 3]) -> Option<Ray> {
    let point = |[x, y, z]: [f32; 3]| Point3::new(x, y, z);
    let ray = Ray::new(point(from), point(toward) - point(from));
    ray.is_valid().then_some(ray)
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 200, ..ProptestConfig::default() })]

    #[test]
    fn a_sphere_of_ones_own_is_hit_where_the_built_in_one_is(
        from in prop::array::uniform3(-10.0_f32..20.0),
        toward in prop::array::uniform3(0.0_f32..8.0),
    ) {
        let Some(ray) = ray_at(from, toward) else { return Ok(()) };
        let shapes = Shapes(scattered().into_iter().map(Into::into).collect());
        let judge = Accel::build(shapes, StructureKind::BruteForce);
        for &kind in StructureKind::ALL {
            let own = Accel::build(Custom(Balls(scattered())), kind);
            match (own.intersect(&ray), judge.intersect(&ray)) {
                (Some(a), Some(b)) => {
                    prop_assert_eq!(a.primitive, b.primitive);
                    prop_assert!((a.t - b.t).abs() <= 1e-4 * b.t, "{} {}", a.t, b.t);
                }
                (a, b) => prop_assert_eq!(a.is_some(), b.is_some(), "{:?} {:?}", a, b),
            }
            prop_assert_eq!(own.occluded(&ray), judge.occluded(&ray));
        }
    }

    #[test]
    fn a_marched_field_is_hit_where_the_built_in_sphere_is(
        from in prop::array::uniform3(-10.0_f32..-2.0),
        toward in prop::array::uniform3(-0.9_f32..0.9),
    ) {
        let Some(ray) = ray_at(from, toward) else { return Ok(()) };
        let sphere = Sphere::new(Point3::ORIGIN, 1.5);
        let judge = Accel::build(Shapes(vec![sphere.into()]), StructureKind::BruteForce);
        let field = Accel::build(Custom(Field(sphere)), StructureKind::default());
        match (field.intersect(&ray), judge.intersect(&ray)) {
            (Some(a), Some(b)) => prop_assert!((a.t - b.t).abs() < 1e-3, "{} {}", a.t, b.t),
            // A ray that grazes within the tolerance of the march.
            (a, b) => prop_assert_eq!(a.is_some(), b.is_some(), "{:?} {:?}", a, b),
        }
    }
}

#[test]
fn none_of_ones_own_primitives_is_hit_by_nothing() {
    let none = Accel::build(Custom(Balls(vec![])), StructureKind::default());
    let ray = Ray::new(Point3::ORIGIN, Vector3::X);
    assert_eq!(none.intersect(&ray), None);
    assert_eq!(none.bytes(), none.structure_bytes());
}

#[test]
fn crossings_off_the_ray_or_outside_the_box_do_not_count() {
    let ray = Ray {
        t_min: 1.0,
        t_max: 15.0,
        ..Ray::new(Point3::ORIGIN, Vector3::X)
    };
    for &kind in StructureKind::ALL {
        let unruly = Accel::build(Custom(Unruly), kind);
        assert_eq!(unruly.intersect(&ray).unwrap().t, 2.0);
        let mut hits = Vec::new();
        unruly.all_hits(&ray, &mut hits);
        assert_eq!(
            hits.iter().map(|hit| hit.t).collect::<Vec<_>>(),
            [2.0, 3.0, 4.0]
        );
    }
}

#[test]
fn a_program_that_goes_on_after_the_end_is_not_heard() {
    let unruly = Accel::build(Custom(Unruly), StructureKind::default());
    let ray = Ray::new(Point3::ORIGIN, Vector3::X);
    let mut asked = Vec::new();
    let hit = unruly.trace(&ray, &mut |hit| {
        asked.push(hit.t);
        AnyHit::Terminate
    });
    assert_eq!(asked, [4.0]);
    assert_eq!(hit.unwrap().t, 4.0);
}
