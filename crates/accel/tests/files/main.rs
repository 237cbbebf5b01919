//! A structure that is saved and loaded again, and files that are wrong.

mod broken;
mod whole;

use ombra_accel::{Accel, Mesh, StructureFileError, StructureKind, Traversable, TriangleTree};
use ombra_geometry::{Hit, Point3, Ray, TriangleMesh, Vector3};

/// A dish of triangles that share vertices.
fn dish(cells: u32) -> TriangleMesh {
    let side = cells + 1;
    let position = |i: u32| {
        let [x, z] = [i % side, i / side].map(|k| k as f32 / cells as f32 - 0.5);
        Point3::new(x, x * x + 0.7 * z * z, z)
    };
    let triangles = (0..cells * cells).flat_map(|i| {
        let a = i / cells * side + i % cells;
        [[a, a + 1, a + side], [a + 1, a + side + 1, a + side]]
    });
    let positions = (0..side * side).map(position).collect();
    TriangleMesh::new(positions, triangles.collect()).unwrap()
}

/// Small triangles with long ones among them: `bvh8-high` lists some of those more than once.
fn straw(stalks: u32) -> TriangleMesh {
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for k in 0..stalks {
        let [x, y, z] = [7, 13, 29].map(|step| (step * k % 101) as f32 / 101.0 - 0.5);
        let [along, across] = if k % 5 == 0 { [0.8, 0.6] } else { [0.02, 0.01] };
        let corner = 3 * k;
        positions.extend([
            Point3::new(x, y, z),
            Point3::new(x + along, y + 0.9 * along, z),
            Point3::new(x, y + 0.01, z + across),
        ]);
        triangles.push([corner, corner + 1, corner + 2]);
    }
    TriangleMesh::new(positions, triangles).unwrap()
}

/// The structures that can be files.
const KINDS: [StructureKind; 3] = [
    StructureKind::Bvh8,
    StructureKind::Bvh8Fast,
    StructureKind::Bvh8High,
];

fn built(mesh: TriangleMesh) -> Accel<Mesh> {
    Accel::build(Mesh::new(mesh), StructureKind::Bvh8)
}

/// From near and, to be traced in double precision, from afar.
fn rays() -> Vec<Ray> {
    let mut rays = Vec::new();
    for i in 0..200_u32 {
        let [x, z] = [i % 14, i / 14].map(|k| k as f32 / 13.0 - 0.5);
        let target = Point3::new(x, 0.1, z);
        for away in [1.0, 1e4] {
            let from = Point3::new(0.3 * away, 1.1 * away, -0.4 * away);
            rays.push(Ray::new(from, target - from));
        }
        rays.push(Ray::new(target, Vector3::new(x, 0.05, z)));
    }
    rays
}

type Answers = (Vec<Option<Hit>>, Vec<bool>, Vec<Vec<Hit>>);

/// What a structure says to the rays, asked in every way.
fn answers(world: &impl Traversable) -> Answers {
    let rays = rays();
    let alone: Vec<_> = rays.iter().map(|ray| world.intersect(ray)).collect();
    let occluded: Vec<_> = rays.iter().map(|ray| world.occluded(ray)).collect();
    let (mut hits, mut some) = (vec![None; rays.len()], vec![false; rays.len()]);
    world.intersect_many(&rays, &mut hits);
    world.occluded_many(&rays, &mut some);
    assert_eq!((&hits, &some), (&alone, &occluded));
    let all = rays.iter().map(|ray| {
        let mut all = Vec::new();
        world.all_hits(ray, &mut all);
        all
    });
    (hits, occluded, all.collect())
}

/// The bytes of the file that a structure is saved as.
fn bytes(save: impl FnOnce(&std::path::Path) -> Result<(), StructureFileError>) -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("tree.ombra");
    save(&path).unwrap();
    std::fs::read(path).unwrap()
}

fn read(bytes: &[u8]) -> Result<TriangleTree, StructureFileError> {
    TriangleTree::read_bytes("a.ombra", bytes)
}
