//! One ray, one triangle: the system of three equations, solved by Cramer's rule.
//!
//! p(t) = e + t d is the ray, f(u, v) = a + u (b − a) + v (c − a) the plane of the triangle. Where
//! they meet, u (b − a) + v (c − a) − t d = e − a: three equations for u, v and t.

use ombra_accel::{Accel, Mesh, StructureKind, Traversable};
use ombra_geometry::triangle::TriangleTest;
use ombra_geometry::{Point3, Ray, TriangleMesh, Vector3};

/// The determinant of the matrix with these columns.
fn determinant(x: Vector3, y: Vector3, z: Vector3) -> f32 {
    x.dot(y.cross(z))
}

/// (t, u, v), if the ray meets the triangle.
fn by_hand(ray: &Ray, [a, b, c]: [Point3; 3]) -> Option<(f32, f32, f32)> {
    let (x, y, z) = (b - a, c - a, -ray.direction);
    let right = ray.origin - a;
    let det = determinant(x, y, z);
    // Cramer's rule: put the right-hand side in the place of each column in turn.
    let u = determinant(right, y, z) / det;
    let v = determinant(x, right, z) / det;
    let t = determinant(x, y, right) / det;
    (det != 0.0 && t > 0.0 && u >= 0.0 && v >= 0.0 && u + v <= 1.0).then_some((t, u, v))
}

fn triangle() -> [Point3; 3] {
    [
        Point3::new(0.0, 0.0, 0.0),
        Point3::new(4.0, 0.0, 0.0),
        Point3::new(0.0, 4.0, 0.0),
    ]
}

fn rays() -> [Ray; 3] {
    let down = |x, y| Ray::new(Point3::new(x, y, 8.0), Vector3::new(0.0, 0.0, -2.0));
    [down(1.0, 2.0), down(3.0, 0.5), down(3.0, 3.0)]
}

/// The same question to the engine, with one of its own tests.
fn by_engine(ray: &Ray, test: TriangleTest) -> anyhow::Result<Option<(f32, f32, f32)>> {
    let mesh = TriangleMesh::new(triangle().to_vec(), vec![[0, 1, 2]])?;
    let accel = Accel::build(Mesh::with_test(mesh, test), StructureKind::default());
    Ok(accel.intersect(ray).map(|hit| (hit.t, hit.u, hit.v)))
}

fn main() -> anyhow::Result<()> {
    for ray in rays() {
        println!("from {:?} along {:?}", ray.origin, ray.direction);
        println!("  {:<16} {:?}", "by hand", by_hand(&ray, triangle()));
        for test in TriangleTest::ALL {
            println!("  {:<16} {:?}", test.name(), by_engine(&ray, test)?);
        }
    }
    Ok(())
}

#[test]
fn hand_and_engine_agree() -> anyhow::Result<()> {
    let expected = [Some((4.0, 0.25, 0.5)), Some((4.0, 0.75, 0.125)), None];
    for (ray, expected) in rays().iter().zip(expected) {
        assert_eq!(by_hand(ray, triangle()), expected);
        for test in TriangleTest::ALL {
            assert_eq!(by_engine(ray, test)?, expected);
        }
    }
    Ok(())
}
