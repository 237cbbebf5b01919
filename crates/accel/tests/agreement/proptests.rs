//! Small scenes on a lattice, where rays meet edges and vertices exactly and ties are common, and
//! which shrink well when something is wrong.

use ombra_accel::StructureKind;
use ombra_geometry::{Point3, Ray, Vector3};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

use crate::answers::assert_agreement;
use crate::meshes;

/// A coordinate on the lattice, or off it.
fn coordinate() -> impl Strategy<Value = f32> {
    prop_oneof![
        4 => (-4_i8..=4).prop_map(|i| f32::from(i) * 0.5),
        1 => -2.0_f32..2.0,
    ]
}

fn point() -> impl Strategy<Value = Point3> {
    [coordinate(), coordinate(), coordinate()].prop_map(Point3::from)
}

/// Where the scene lies and how large it is: (scale, offset).
fn placement() -> impl Strategy<Value = (f32, f32)> {
    prop_oneof![
        3 => Just((1.0, 0.0)),
        1 => Just((1e-6, 0.0)),
        1 => Just((1e6, 0.0)),
        1 => Just((4.0, 1e6)),
        1 => Just((64.0, 1e7)),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 300,
        rng_seed: RngSeed::Fixed(2024),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn every_structure_agrees_with_brute_force_on_a_lattice(
        triangles in proptest::collection::vec([point(), point(), point()], 0..40),
        rays in proptest::collection::vec((point(), point()), 1..12),
        (scale, offset) in placement(),
    ) {
        prop_assert!(StructureKind::ALL.len() > 1);
        let mesh = meshes::moved(&meshes::soup(triangles), scale, offset);
        let by = Vector3::new(offset, -offset, offset);
        let moved = |p: Point3| Point3::ORIGIN + p.to_vector() * scale + by;
        let rays: Vec<_> = rays
            .into_iter()
            .flat_map(|(from, to)| {
                let (from, to) = (moved(from), moved(to));
                [
                    Ray::new(from, to - from),
                    Ray::between(from, to),
                    Ray::new(from + (from - to) * 40.0, to - from),
                ]
            })
            .collect();
        assert_agreement("lattice", &meshes::geometry(mesh), &rays);
    }
}
