//! What holds for trees of every care.

use ombra_geometry::{Aabb, Point3, TriangleMesh};

use super::validate::{Valid, validate};
use super::{Balanced, Body, Bvh8, Care, Compact, Effort, Fast, High, Items, Leaves, Wide};
use crate::bvh::tests::{bounded, hostile, scattered};
use crate::{Bounded, Mesh, Primitives, Reach, Structure};

/// A triangle in each box: from corner to corner.
fn triangles(boxes: &[Bounded]) -> TriangleMesh {
    let corners = boxes.iter().flat_map(|own| {
        let Aabb { min, max } = own.bounds;
        [min, max, Point3::new(max.x, min.y, max.z)]
    });
    let indices = (0..boxes.len() as u32).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]);
    TriangleMesh::new(corners.collect(), indices.collect()).unwrap()
}

/// Small boxes, and some that are long and thin.
fn uneven(count: u32) -> Vec<Bounded> {
    let long = |(k, mut own): (usize, Aabb)| {
        if k % 10 == 0 {
            own.max.x += 0.3;
            own.max[[ombra_geometry::Axis::Y, ombra_geometry::Axis::Z][k % 20 / 10]] += 0.3;
        }
        own
    };
    bounded(scattered(count).enumerate().map(long))
}

fn around(boxes: &[Aabb]) -> Reach {
    let all = boxes.iter().filter(|own| !own.is_empty());
    Reach::of(&all.fold(Aabb::EMPTY, |all, own| all.union(*own)))
}

fn over_boxes<C: Care>(list: &[Bounded]) -> (Bvh8<C>, Valid) {
    let boxes: Vec<Aabb> = list.iter().map(|own| own.bounds).collect();
    let bvh = <Bvh8<C> as Structure>::build(list, &around(&boxes));
    let valid = validate(&bvh.tree, &boxes);
    (bvh, valid)
}

fn over_triangles<C: Care>(mesh: &TriangleMesh) -> (Bvh8<C>, Valid) {
    let primitives = Mesh::new(mesh.clone());
    let boxes: Vec<Aabb> = (0..primitives.len() as u32)
        .map(|k| primitives.bounds(k))
        .collect();
    let bounds_of = |k: u32| boxes[k as usize];
    let items = Items::of(&primitives);
    let bvh = Bvh8::<C>::new(items, &around(&boxes), Some(mesh), &bounds_of);
    let valid = validate(&bvh.tree, &boxes);
    (bvh, valid)
}

fn every_hostile_list_makes_a_valid_tree<C: Care>() {
    for (name, list) in hostile() {
        let (_, valid) = over_boxes::<C>(&list);
        assert_eq!(valid.named, list.len(), "{name}");
        let mesh = triangles(&list);
        let (_, valid) = over_triangles::<C>(&mesh);
        let most = if C::EFFORT == Effort::Most {
            list.len() * 3 / 2
        } else {
            list.len()
        };
        assert!(
            (list.len()..=most).contains(&valid.named),
            "{name}: {valid:?}"
        );
    }
}

#[test]
fn every_hostile_list_makes_a_valid_fast_tree() {
    every_hostile_list_makes_a_valid_tree::<Fast>();
}

#[test]
fn every_hostile_list_makes_a_valid_balanced_tree() {
    every_hostile_list_makes_a_valid_tree::<Balanced>();
}

#[test]
fn every_hostile_list_makes_a_valid_high_tree() {
    every_hostile_list_makes_a_valid_tree::<High>();
}

#[test]
fn every_hostile_list_makes_a_valid_compact_tree() {
    every_hostile_list_makes_a_valid_tree::<Compact>();
}

/// Everything that a tree over triangles is made of.
fn parts(tree: &Wide) -> String {
    match &tree.body {
        Body::Full(_, Leaves::Lists(_) | Leaves::Places(_)) => panic!("there is a mesh"),
        Body::Full(tree, Leaves::Quads(quads)) => {
            let numbers: Vec<_> = (quads.iter())
                .flat_map(|quad| quad.numbers.map(f32::to_bits))
                .collect();
            format!("{tree:?} {numbers:?}")
        }
        Body::Compact(tree, blocks) => format!("{tree:?} {blocks:?}"),
    }
}

fn the_tree_is_the_same_for_any_number_of_threads<C: Care>() {
    let mesh = triangles(&uneven(100_000));
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.unwrap().install(|| over_triangles::<C>(&mesh).0.tree)
    };
    let (one, four) = (with(1), with(4));
    assert!(parts(&one) == parts(&four));
}

#[test]
fn trees_are_the_same_for_any_number_of_threads() {
    the_tree_is_the_same_for_any_number_of_threads::<Fast>();
    the_tree_is_the_same_for_any_number_of_threads::<Balanced>();
    the_tree_is_the_same_for_any_number_of_threads::<High>();
    the_tree_is_the_same_for_any_number_of_threads::<Compact>();
}

#[test]
fn space_is_cut_among_uneven_triangles_and_the_list_stays_bounded() {
    let mesh = triangles(&uneven(20_000));
    let (bvh, valid) = over_triangles::<High>(&mesh);
    assert!(bvh.tree.repeats() && valid.named > 20_000, "{valid:?}");
    assert!(valid.named <= 30_000, "{valid:?}");
}

#[test]
fn what_is_not_a_triangle_is_in_one_leaf() {
    let (bvh, valid) = over_boxes::<High>(&uneven(20_000));
    assert!(!bvh.tree.repeats() && valid.named == 20_000);
}

#[test]
fn leaves_are_filled() {
    // Each place of a leaf takes 40 bytes.
    let (_, valid) = over_triangles::<Balanced>(&triangles(&bounded(scattered(50_000))));
    assert!(valid.named > 5 * valid.leaves, "{valid:?}");
}
