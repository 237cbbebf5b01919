//! Many objects: what an acceleration structure is for.
//!
//! A loop over all n primitives finds the hit, and is always right. A structure sorts them in
//! space, so that a ray meets only those on its way. It must give the same answers: here every
//! structure is held against the loop, and its work is counted.

use ombra_accel::{Accel, Shapes, Statistics, StructureKind, Traversable};
use ombra_geometry::shape::{Shape, Sphere};
use ombra_geometry::{Hit, Point3, Ray, Vector3};

const SPHERES: usize = 2000;
const RAYS: usize = 1000;

/// Numbers from 0 to 1 that look random and are the same every time (a linear congruence).
fn numbers() -> impl FnMut() -> f32 {
    let mut state = 1_u32;
    move || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 8) as f32 / (1 << 24) as f32
    }
}

fn spheres() -> Vec<Shape> {
    let mut next = numbers();
    let mut sphere = |_| Sphere::new(Point3::new(next(), next(), next()), 0.02 * next()).into();
    (0..SPHERES).map(&mut sphere).collect()
}

fn rays() -> Vec<Ray> {
    let mut next = numbers();
    let eye = Point3::new(0.5, 0.5, 3.0);
    let mut ray = |_| Ray::new(eye, Vector3::new(next() - 0.5, next() - 0.5, -2.5));
    (0..RAYS).map(&mut ray).collect()
}

/// The hits of all rays, and what they cost.
fn ask(kind: StructureKind) -> (Vec<Option<Hit>>, Statistics) {
    let world = Accel::build(Shapes(spheres()), kind);
    let mut cost = Statistics::default();
    let mut ask = |ray: &Ray| {
        let (hit, own) = world.intersect_counted(ray);
        cost += own;
        hit
    };
    let hits = rays().iter().map(&mut ask).collect();
    (hits, cost)
}

fn main() {
    let (judge, _) = ask(StructureKind::BruteForce);
    let hits = judge.iter().flatten().count();
    println!("{RAYS} rays, {SPHERES} spheres, {hits} hits; per ray:");
    for &kind in StructureKind::ALL {
        let (answers, cost) = ask(kind);
        let per_ray = |count: u64| count as f64 / RAYS as f64;
        println!(
            "{:<16} {:>7.1} nodes {:>7.1} tests, {}",
            kind.name(),
            per_ray(cost.nodes_visited),
            per_ray(cost.tests_made),
            if answers == judge {
                "the same answers"
            } else {
                "OTHER ANSWERS"
            }
        );
    }
}

#[test]
fn every_structure_gives_the_answers_of_the_loop_for_less_work() {
    let (judge, loop_cost) = ask(StructureKind::BruteForce);
    assert_eq!(loop_cost.tests_made as usize, SPHERES * RAYS);
    assert!(judge.iter().flatten().count() > 100);
    for &kind in StructureKind::ALL {
        let (answers, cost) = ask(kind);
        assert_eq!(answers, judge, "{kind}");
        if kind != StructureKind::BruteForce {
            assert!(cost.tests_made * 4 < loop_cost.tests_made, "{kind}");
        }
    }
}
