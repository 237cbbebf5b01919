//! What is saved is what is loaded.
#![expect(unsafe_code, reason = "one test maps a file that it alone knows")]

use ombra_accel::{
    Accel, Geometry, Level, Mesh, OtherMesh, Shapes, StructureKind, Traversable as _, TriangleTree,
};
use ombra_geometry::triangle::TriangleTest;
use ombra_geometry::{Aabb, Point3, TriangleMesh};

use crate::{KINDS, answers, built, bytes, dish, rays, read, straw};

#[test]
fn a_loaded_structure_gives_the_answers_of_the_one_that_was_saved() {
    let dishes = [1, 2, 3, 20, 60].map(|cells| (dish(cells), 100));
    let straws = [9, 500, 5000].map(|stalks| (straw(stalks), 10));
    for (mesh, hits) in dishes.into_iter().chain(straws) {
        for kind in KINDS {
            let accel = Accel::build(Mesh::new(mesh.clone()), kind);
            let file = bytes(|path| accel.save(path));
            let tree = read(&file).unwrap();
            assert_eq!(tree.bounds(), accel.bounds());
            assert_eq!(tree.triangles(), mesh.triangles().len());
            let expected = answers(&accel);
            assert!(expected.0.iter().flatten().count() > hits, "{kind}");
            for level in Level::available() {
                assert_eq!(answers(&tree.clone().at_level(level)), expected, "{kind}");
            }
            for ray in &rays() {
                assert_eq!(tree.intersect_counted(ray), accel.intersect_counted(ray));
            }
        }
    }
}

#[test]
fn a_file_says_whether_triangles_are_listed_more_than_once() {
    for (kind, repeats) in KINDS.into_iter().zip([0, 0, 1]) {
        let accel = Accel::build(Mesh::new(straw(5000)), kind);
        let file = bytes(|path| accel.save(path));
        assert_eq!(file[68..72], [repeats, 0, 0, 0], "{kind}");
        assert_eq!(bytes(|path| read(&file).unwrap().save(path)), file);
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
fn a_loaded_structure_over_its_mesh_is_as_good_as_a_built_one() {
    let mesh = straw(500);
    let lower = |p: &Point3| Point3::new(p.x, 0.5 * p.y, p.z + 0.2 * p.y);
    let moved = mesh.positions().iter().map(lower).collect();
    let moved = TriangleMesh::new(moved, mesh.triangles().to_vec()).unwrap();
    let judge = |mesh: &TriangleMesh| Accel::build(Mesh::new(mesh.clone()), StructureKind::Bvh);
    for kind in KINDS {
        let file = bytes(|path| Accel::build(Mesh::new(mesh.clone()), kind).save(path));
        let tree = read(&file).unwrap();
        let mut accel = tree.clone().with_mesh(Mesh::new(mesh.clone())).unwrap();
        assert_eq!(answers(&accel), answers(&judge(&mesh)), "{kind}");
        assert_eq!(bytes(|path| accel.save(path)), file);
        let point = Point3::new(0.1, 0.2, 0.9);
        let nearest = |accel: &Accel<Mesh>| {
            let distances = accel.distances().unwrap();
            distances.closest_point(point, f64::INFINITY)
        };
        assert_eq!(nearest(&accel), nearest(&judge(&mesh)), "{kind}");
        assert!(accel.refit(Mesh::new(moved.clone())));
        assert_eq!(answers(&accel), answers(&judge(&moved)), "{kind}");
        // What was loaded is as it was.
        assert_eq!(answers(&tree), answers(&judge(&mesh)), "{kind}");
    }
}

#[test]
fn another_mesh_is_not_put_under_a_loaded_structure() {
    let mesh = straw(60);
    let tree = read(&bytes(|path| built(mesh.clone()).save(path))).unwrap();
    let refused = |mesh: Mesh| tree.clone().with_mesh(mesh).unwrap_err();
    let cramer = Mesh::with_test(mesh.clone(), TriangleTest::Cramer);
    assert_eq!(refused(cramer), OtherMesh::Test);
    let (count, structure) = (61, 60);
    let other = OtherMesh::Count {
        mesh: count,
        structure,
    };
    assert_eq!(refused(Mesh::new(straw(61))), other);
    let mut corners = mesh.positions().to_vec();
    corners[3 * 7 + 1].x += 0.125;
    let moved = TriangleMesh::new(corners.clone(), mesh.triangles().to_vec()).unwrap();
    assert_eq!(refused(Mesh::new(moved)), OtherMesh::Triangle(7));
    // A triangle that could not be hit when the structure was built.
    corners[3 * 7 + 1].x = f32::NAN;
    let nan = TriangleMesh::new(corners, mesh.triangles().to_vec()).unwrap();
    let tree = read(&bytes(|path| built(nan).save(path))).unwrap();
    let refused = tree.with_mesh(Mesh::new(mesh)).unwrap_err();
    assert_eq!(refused, OtherMesh::Triangle(7));
    assert!(refused.to_string().contains("triangle 7 "));
}

#[test]
fn nothing_and_what_cannot_be_hit_is_saved_too() {
    let nan = vec![Point3::ORIGIN, Point3::new(1.0, 0.0, f32::NAN)];
    let nan = TriangleMesh::new(nan, vec![[0, 0, 1]; 9]).unwrap();
    let mut endless = dish(1).positions().to_vec();
    endless[1].x = f32::INFINITY;
    let endless = TriangleMesh::new(endless, dish(1).triangles().to_vec()).unwrap();
    for mesh in [TriangleMesh::default(), nan, endless] {
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
        (mesh.clone(), StructureKind::Bvh8Compact),
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
