//! Meshes, the degenerate ones first.

use ombra_accel::{Geometry, Mesh};
use ombra_geometry::{Point3, TriangleMesh, Vector3};

use crate::numbers::Numbers;

pub(crate) fn all() -> Vec<(&'static str, TriangleMesh)> {
    let one = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(Point3::from);
    vec![
        ("nothing", TriangleMesh::default()),
        ("one triangle", soup(vec![one])),
        ("all the same", soup(vec![one; 60])),
        ("zero area", zero_area()),
        ("NaN and infinite vertices", not_finite()),
        ("cube", cuboid(1.0)),
        ("icosphere", icosphere(2)),
        ("random soup", random_soup(400, 1.0, 0.3)),
        ("sparse soup", random_soup(300, 1.0, 0.02)),
        ("slivers", slivers(300)),
        ("axis-aligned planes", planes()),
        ("one plane", plane(6, 0)),
        ("huge and tiny", huge_and_tiny()),
        ("two far clusters", far_clusters()),
        ("icosphere at 1e6", moved(&icosphere(2), 100.0, 1e6)),
        ("icosphere at 1e7", moved(&icosphere(2), 1000.0, 1e7)),
        (
            "soup at 1e7, on the grain",
            moved(&random_soup(300, 1.0, 0.5), 8.0, 1e7),
        ),
        ("icosphere of size 1e-6", moved(&icosphere(2), 1e-6, 0.0)),
        ("icosphere of size 1e6", moved(&icosphere(2), 1e6, 0.0)),
        (
            "soup of size 1e-20",
            moved(&random_soup(100, 1.0, 0.3), 1e-20, 0.0),
        ),
        (
            "soup of size 1e-37",
            moved(&random_soup(100, 1.0, 0.3), 1e-37, 0.0),
        ),
        (
            "soup of size 1e20",
            moved(&random_soup(100, 1.0, 0.3), 1e20, 0.0),
        ),
        (
            "soup of size 1e38",
            moved(&random_soup(100, 1.0, 0.3), 1e38, 0.0),
        ),
    ]
}

pub(crate) fn geometry(mesh: TriangleMesh) -> Geometry {
    Geometry::Mesh(Mesh::new(mesh))
}

/// Triangles that share nothing.
pub(crate) fn soup(triangles: Vec<[Point3; 3]>) -> TriangleMesh {
    let indices = (0..triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]);
    TriangleMesh::new(triangles.concat(), indices.collect()).unwrap()
}

pub(crate) fn random_soup(count: usize, half: f32, size: f32) -> TriangleMesh {
    let mut numbers = Numbers::new(11);
    let triangles = (0..count).map(|_| {
        let centre = numbers.point(half);
        [(); 3].map(|()| centre + numbers.point(size).to_vector())
    });
    soup(triangles.collect())
}

fn zero_area() -> TriangleMesh {
    let mut numbers = Numbers::new(12);
    let mut triangles = Vec::new();
    for _ in 0..20 {
        let (a, b) = (numbers.point(1.0), numbers.point(1.0));
        triangles.push([a; 3]);
        triangles.push([a, b, a]);
        triangles.push([a, a.lerp(b, 0.5), b]);
        triangles.push([a, b, numbers.point(1.0)]);
    }
    soup(triangles)
}

fn not_finite() -> TriangleMesh {
    let mut triangles = Vec::new();
    let mut numbers = Numbers::new(13);
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX] {
        for corner in 0..3 {
            let mut triangle = [(); 3].map(|()| numbers.point(1.0));
            triangles.push(triangle);
            if bad < f32::MAX || corner == 0 {
                triangle[corner].y = bad;
            }
            triangles.push(triangle);
        }
    }
    // The largest number would make the rest a point: the bad corners alone stay.
    triangles.retain(|t| t.iter().all(|p| p.y != f32::MAX));
    soup(triangles)
}

pub(crate) fn slivers(count: usize) -> TriangleMesh {
    let mut numbers = Numbers::new(14);
    let triangles = (0..count).map(|_| {
        let (a, b) = (numbers.point(10.0), numbers.point(10.0));
        let width = 10.0_f32.powf(numbers.within(-6.0, -1.0));
        [a, b, b + numbers.direction() * width]
    });
    soup(triangles.collect())
}

/// The surface of a cube about the origin, two triangles a face, facing outward.
pub(crate) fn cuboid(half: f32) -> TriangleMesh {
    let corner = |i: u32| {
        let side = |bit: u32| if i >> bit & 1 == 1 { half } else { -half };
        Point3::new(side(0), side(1), side(2))
    };
    let faces = [
        [0, 4, 6, 2],
        [1, 3, 7, 5],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 2, 3, 1],
        [4, 5, 7, 6],
    ];
    let triangles = faces
        .iter()
        .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]])
        .collect();
    TriangleMesh::new((0..8).map(corner).collect(), triangles).unwrap()
}

/// A closed sphere of radius 1: an octahedron, each triangle cut in four, `times` times.
pub(crate) fn icosphere(times: u32) -> TriangleMesh {
    let mut positions: Vec<Point3> = [
        [1.0, 0.0, 0.0],
        [-1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, -1.0, 0.0],
        [0.0, 0.0, 1.0],
        [0.0, 0.0, -1.0],
    ]
    .map(Point3::from)
    .to_vec();
    let mut triangles: Vec<[u32; 3]> = (0..8_u32)
        .map(|octant| {
            let pick = |axis: u32| 2 * axis + (octant >> axis & 1);
            let mirrored = octant.count_ones() % 2 == 1;
            let [a, b, c] = [pick(0), pick(1), pick(2)];
            if mirrored { [a, c, b] } else { [a, b, c] }
        })
        .collect();
    let mut middles = std::collections::HashMap::new();
    for _ in 0..times {
        let mut finer = Vec::new();
        for &[a, b, c] in &triangles {
            let mut middle = |from: u32, to: u32| {
                *middles
                    .entry((from.min(to), from.max(to)))
                    .or_insert_with(|| {
                        let between = positions[from as usize].lerp(positions[to as usize], 0.5);
                        let outward = between.to_vector().normalized().unwrap();
                        positions.push(Point3::ORIGIN + outward);
                        positions.len() as u32 - 1
                    })
            };
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            finer.extend([[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]);
        }
        triangles = finer;
    }
    TriangleMesh::new(positions, triangles).unwrap()
}

/// A flat grid of triangles across one axis, at 0.
fn plane(cells: u32, across: usize) -> TriangleMesh {
    let side = cells + 1;
    let position = |i: u32| {
        let mut p = [0.0; 3];
        p[(across + 1) % 3] = (i % side) as f32;
        p[(across + 2) % 3] = (i / side) as f32;
        Point3::from(p)
    };
    let triangles = (0..cells * cells).flat_map(|i| {
        let a = i / cells * side + i % cells;
        [[a, a + 1, a + side], [a + 1, a + side + 1, a + side]]
    });
    TriangleMesh::new(
        (0..side * side).map(position).collect(),
        triangles.collect(),
    )
    .unwrap()
}

/// Planes across all axes, and one of them twice.
fn planes() -> TriangleMesh {
    let mut triangles = Vec::new();
    for (across, at) in [(0, 0.0), (1, 0.0), (2, 0.0), (2, 3.0), (2, 3.0), (0, 6.0)] {
        let flat = plane(6, across);
        let mut offset = [0.0; 3];
        offset[across] = at;
        let by = Vector3::from(offset);
        let moved = (0..flat.triangles().len()).map(|i| flat.corners(i).map(|p| p + by));
        triangles.extend(moved);
    }
    soup(triangles)
}

fn huge_and_tiny() -> TriangleMesh {
    let tiny = random_soup(200, 0.5, 0.01);
    let mut triangles: Vec<_> = (0..200).map(|i| tiny.corners(i)).collect();
    let huge = [[-4e4, -3e4, 0.0], [5e4, -3e4, 0.1], [0.0, 6e4, -0.1]].map(Point3::from);
    triangles.insert(77, huge);
    soup(triangles)
}

fn far_clusters() -> TriangleMesh {
    let near = random_soup(100, 1.0, 0.3);
    let triangles = (0..100).map(|i| {
        let by = Vector3::new(if i % 2 == 0 { 0.0 } else { 3e5 }, 0.0, 0.0);
        near.corners(i).map(|p| p + by)
    });
    soup(triangles.collect())
}

/// Scaled, then moved by as much along each axis.
pub(crate) fn moved(mesh: &TriangleMesh, scale: f32, by: f32) -> TriangleMesh {
    let by = Vector3::new(by, -by, by);
    let positions = mesh.positions().iter();
    let positions = positions.map(|p| Point3::ORIGIN + p.to_vector() * scale + by);
    TriangleMesh::new(positions.collect(), mesh.triangles().to_vec()).unwrap()
}
