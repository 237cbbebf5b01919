//! What is saved is what is loaded.
#![expect(unsafe_code, reason = "one test maps a file that it alone knows")]

use ombra_accel::{
    Accel, Geometry, Level, Mesh, Shapes, StructureKind, Traversable as _, TriangleTree,
};
use ombra_geometry::triangle::TriangleTest;
use ombra_geometry::{Aabb, Point3, TriangleMesh};

use crate::{answers, built, bytes, dish, rays, read};

#[test]
fn a_loaded_structure_gives_the_answers_of_the_one_that_was_saved() {
    for cells in [1, 2, 3, 20, 60] {
        let accel = built(dish(cells));
        let file = bytes(|path| accel.save(path));
        let tree = read(&file).unwrap();
        assert_eq!(tree.bounds(), accel.bounds());
        assert_eq!(tree.triangles(), 2 * (cells * cells) as usize);
        let expected = answers(&accel);
        assert!(expected.0.iter().flatten().count() > 100);
        assert_eq!(answers(&tree), expected, "{cells} cells");
        for level in Level::available() {
            assert_eq!(answers(&tree.clone().at_level(level)), expected);
        }
        for ray in &rays() {
            assert_eq!(tree.intersect_counted(ray), accel.intersect_counted(ray));
        }
    }
}

#[test]
fn a_loaded_structure_is_saved_again_byte_for_byte() {
    let file = bytes(|path| built(dish(20)).save(path));
    let tree = read(&file).unwrap();
    assert_eq!(bytes(|path| tree.save(path)), file);
    assert_eq!(bytes(|path| built(dish(20)).save(path)), file);
}

#[test]
fn a_mapped_file_gives_the_answers_of_a_loaded_one() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("tree.ombra");
    let accel = built(dish(20));
    accel.save(&path).unwrap();
    // SAFETY: what is saved over it below is a new file.
    let mapped = unsafe { TriangleTree::map(&path) }.unwrap();
    let loaded = TriangleTree::load(&path).unwrap();
    assert_eq!(mapped.bytes(), loaded.bytes());
    built(dish(3)).save(&path).unwrap();
    let expected = answers(&accel);
    assert_eq!(answers(&mapped), expected);
    assert_eq!(answers(&loaded), expected);
    assert_ne!(answers(&TriangleTree::load(&path).unwrap()), expected);
}

#[test]
fn nothing_and_what_cannot_be_hit_is_saved_too() {
    let nan = vec![Point3::ORIGIN, Point3::new(1.0, 0.0, f32::NAN)];
    let nan = TriangleMesh::new(nan, vec![[0, 0, 1]; 9]).unwrap();
    for mesh in [TriangleMesh::default(), nan] {
        let count = mesh.triangles().len();
        let file = bytes(|path| built(mesh).save(path));
        let tree = read(&file).unwrap();
        assert_eq!(tree.triangles(), count);
        assert_eq!(tree.bounds(), Aabb::EMPTY);
        assert!(answers(&tree).0.iter().all(Option::is_none));
    }
}

#[test]
fn what_is_not_a_wide_tree_of_watertight_triangles_is_refused_and_leaves_no_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("tree.ombra");
    let mesh = Geometry::Mesh(Mesh::new(dish(2)));
    let cramer = Geometry::Mesh(Mesh::with_test(dish(2), TriangleTest::Cramer));
    let shapes = Geometry::Shapes(Shapes::default());
    for (geometry, kind) in [
        (mesh.clone(), StructureKind::KdRopes),
        (cramer, StructureKind::Bvh8),
        (shapes, StructureKind::Bvh8),
    ] {
        let error = Accel::build(geometry, kind).save(&path).unwrap_err();
        let error = error.to_string();
        assert!(error.contains(&format!("`{kind}`")), "{error}");
        assert!(error.contains("watertight"), "{error}");
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    Accel::build(mesh, StructureKind::Bvh8).save(&path).unwrap();
}

#[test]
fn a_file_that_cannot_be_there_is_named() {
    let error = TriangleTree::load("nowhere/tree.ombra").unwrap_err();
    let error = error.to_string();
    assert!(error.starts_with("nowhere/tree.ombra: cannot be opened: "));
    let error = built(dish(1)).save("nowhere/tree.ombra").unwrap_err();
    let error = error.to_string();
    assert!(error.starts_with("nowhere/tree.ombra: cannot be written: "));
}
