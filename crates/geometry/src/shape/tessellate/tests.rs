use super::*;
use crate::shape::{
    Cone, ConvexPolyhedron, Cuboid, Cylinder, Disk, Ends, Frustum, FrustumView, OrientedBox, Plane,
    Rectangle, Sphere, Torus, Triangle,
};
use crate::{Aabb, Angle, Ray, Vector3};

/// One of each but the plane, none of them along the axes.
fn shapes() -> Vec<Shape> {
    let p = |x, y, z| Point3::new(x, y, z);
    let v = |x, y, z| Vector3::new(x, y, z);
    let n = Normal3::new(0.3, -0.5, 0.8);
    let corners = [
        p(0.0, 0.0, 0.0),
        p(1.0, 0.2, 0.0),
        p(0.0, 1.0, 0.1),
        p(0.1, 0.0, 1.0),
    ];
    let faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]].map(|face| face.to_vec());
    let view = FrustumView {
        eye: p(1.0, 2.0, 3.0),
        direction: v(-1.0, 0.2, 0.3),
        up: v(0.0, 1.0, 0.0),
        vertical_fov: Angle::from_degrees(50.0),
        aspect: 1.5,
        near: 0.5,
        far: 2.0,
    };
    let capped = Ends::Capped;
    vec![
        Sphere::new(p(1.0, 2.0, -3.0), 1.5).into(),
        Triangle::new(p(0.0, 0.0, 0.0), p(1.0, 0.0, 0.3), p(0.0, 2.0, 0.1)).into(),
        Disk::new(p(0.5, 0.0, 0.0), n, 0.8).unwrap().into(),
        Rectangle::new(p(0.0, 1.0, 0.0), v(1.0, 0.5, 0.0), v(0.2, 0.0, 1.0))
            .unwrap()
            .into(),
        Cylinder::new(p(0.0, 0.0, 0.0), p(1.0, 1.0, 1.0), 0.4, capped)
            .unwrap()
            .into(),
        Cylinder::new(p(0.0, 0.0, 0.0), p(1.0, 1.0, 1.0), 0.4, Ends::Open)
            .unwrap()
            .into(),
        Cone::new(p(0.0, 0.0, 0.0), p(0.0, 1.0, 0.5), 0.6, capped)
            .unwrap()
            .into(),
        Cone::truncated(p(0.0, 0.0, 0.0), p(0.0, 1.0, 0.5), [0.2, 0.6], capped)
            .unwrap()
            .into(),
        Cuboid::new(p(0.0, 0.0, 0.0), p(1.0, 2.0, 3.0))
            .unwrap()
            .into(),
        OrientedBox::new(
            p(0.0, 1.0, 0.0),
            v(1.0, 0.5, 0.0),
            v(0.0, 1.0, 0.3),
            v(1.0, 0.5, 0.2),
        )
        .unwrap()
        .into(),
        Frustum::new(&view).unwrap().into(),
        ConvexPolyhedron::from_faces(&corners, &faces)
            .unwrap()
            .into(),
        Torus::new(p(0.1, 0.2, 0.3), n, 1.0, 0.3).unwrap().into(),
    ]
}

const TOLERANCES: [f64; 3] = [0.2, 0.02, 0.002];

/// How far a point is from the shape: as far as a short ray through it, along the normal there.
fn distance_from_shape(shape: &Shape, point: Point3<f64>, reach: f64) -> f64 {
    let normal = shape.normal_at(point).to_vector();
    let ray = Ray::new(point - normal * reach, normal);
    let crossings = shape.crossings(&ray);
    let off = crossings.iter().map(|crossing| (crossing.t - reach).abs());
    off.fold(f64::INFINITY, f64::min)
}

/// The nearest point of a triangle: Ericson, "Real-Time Collision Detection", 2005, section 5.1.5,
/// found here by trying the inside and the three edges.
fn distance_from_triangle(p: Point3<f64>, [a, b, c]: [Point3<f64>; 3]) -> f64 {
    let normal = (b - a).cross(c - a);
    let inside =
        |from: Point3<f64>, to: Point3<f64>| (to - from).cross(p - from).dot(normal) >= 0.0;
    if inside(a, b) && inside(b, c) && inside(c, a) {
        return ((p - a).dot(normal) / normal.length()).abs();
    }
    let from_edge = |from: Point3<f64>, to: Point3<f64>| {
        let along = to - from;
        let s = ((p - from).dot(along) / along.length_squared()).clamp(0.0, 1.0);
        (from + along * s - p).length()
    };
    from_edge(a, b).min(from_edge(b, c)).min(from_edge(c, a))
}

#[test]
fn the_mesh_is_within_the_tolerance_of_the_shape() {
    for shape in shapes() {
        for tolerance in TOLERANCES {
            let mesh = tessellate(&shape, tolerance).unwrap();
            assert_eq!(mesh.degenerate_triangles(), 0, "{shape:?}");
            let mut worst: f64 = 0.0;
            for i in 0..mesh.triangles().len() {
                let [a, b, c] = mesh.corners(i).map(Point3::wide);
                for (u, v) in [
                    (0.333, 0.333),
                    (0.4999, 1e-4),
                    (1e-4, 0.4999),
                    (0.4999, 0.4999),
                    (0.1, 0.2),
                ] {
                    let point = a + (b - a) * u + (c - a) * v;
                    worst = worst.max(distance_from_shape(&shape, point, 2.0 * tolerance));
                }
            }
            assert!(worst <= tolerance, "{worst} over {tolerance}: {shape:?}");
        }
    }
}

#[test]
fn the_shape_is_within_the_tolerance_of_the_mesh() {
    for shape in shapes() {
        for tolerance in TOLERANCES {
            let mesh = tessellate(&shape, tolerance).unwrap();
            let triangles: Vec<_> = (0..mesh.triangles().len())
                .map(|i| mesh.corners(i).map(Point3::wide))
                .collect();
            for i in 0..64_u32 {
                let xi = [i as f32 / 64.0, (i as f32 * 0.618_034).fract()];
                let point = shape.sample(xi).unwrap().point;
                let nearest = triangles
                    .iter()
                    .map(|corners| distance_from_triangle(point, *corners))
                    .fold(f64::INFINITY, f64::min);
                assert!(
                    nearest <= tolerance,
                    "{nearest} over {tolerance}: {shape:?}"
                );
            }
        }
    }
}

#[test]
fn vertices_have_the_normals_and_parameters_of_the_shape() {
    for shape in shapes() {
        let mesh = tessellate(&shape, 0.01).unwrap();
        let (normals, uvs) = (mesh.normals().unwrap(), mesh.uvs().unwrap());
        for triangle in 0..mesh.triangles().len() {
            let outward = mesh.geometric_normal(triangle).unwrap();
            let corners = mesh.triangles()[triangle];
            for vertex in corners.map(|i| i as usize) {
                let turned = outward.dot(normals[vertex].wide().to_vector());
                assert!(turned > 0.7, "{turned}: {shape:?}");
            }
            // At a vertex a normal or a parameter may jump; in the middle it may not.
            let [a, b, c] = mesh.corners(triangle).map(Point3::wide);
            let middle = a + (b - a) * 0.3 + (c - a) * 0.3;
            let expected = shape.surface_at(middle);
            let blended = mesh.interpolated_normal(triangle, 0.3, 0.3).unwrap();
            let along = blended.wide().normalized().unwrap();
            let along = along.dot(expected.normal.to_vector());
            assert!(along > 0.98, "{along}: {shape:?}");
            let uv = mesh.uv_at(triangle, 0.3, 0.3).unwrap();
            for (found, expected) in uv.into_iter().zip(expected.uv) {
                assert!(
                    (found - expected).abs() < 0.06,
                    "{uv:?}, {expected}: {shape:?}"
                );
            }
        }
        assert!(uvs.iter().flatten().all(|x| (0.0..=1.0).contains(x)));
    }
}

#[test]
fn closed_shapes_become_closed_meshes() {
    for shape in shapes() {
        let flat = matches!(
            shape,
            Shape::Triangle(_) | Shape::Rectangle(_) | Shape::Disk(_)
        );
        let open = flat || shape == shapes()[5];
        let mesh = tessellate(&shape, 0.05).unwrap();
        // Vertices in one place are one vertex here: of the same bits, or within rounding.
        let size = f64::from(shape.bounds().extent().max_norm());
        let mut places: Vec<Point3> = Vec::new();
        let mut merged = |p: Point3| {
            let same = |q: &Point3| (p.wide() - q.wide()).length() < 1e-6 * size;
            places.iter().position(same).unwrap_or_else(|| {
                places.push(p);
                places.len() - 1
            }) as u32
        };
        let triangles = (0..mesh.triangles().len()).map(|i| mesh.corners(i).map(&mut merged));
        let triangles: Vec<_> = triangles.collect();
        let welded = TriangleMesh::new(places, triangles).unwrap();
        assert_eq!(welded.is_closed(), !open, "{shape:?}");
    }
}

#[test]
fn what_has_no_surface_has_no_triangles_and_what_cannot_be_is_refused() {
    for bad in [
        Sphere::new(Point3::ORIGIN, 0.0),
        Sphere::new(Point3::new(f32::NAN, 0.0, 0.0), 1.0),
    ] {
        assert!(tessellate(&bad.into(), 0.1).unwrap().triangles().is_empty());
    }
    let needle = Triangle::new(Point3::ORIGIN, Point3::ORIGIN, Point3::new(1.0, 0.0, 0.0));
    assert_eq!(triangle_count(&needle.into(), 0.1), Ok(0));
    let up = Normal3::new(0.0, 0.0, 1.0);
    let plane = Plane::new(Point3::ORIGIN, up).unwrap();
    assert_eq!(
        tessellate(&plane.into(), 0.1),
        Err(TessellationError::Endless)
    );
    let ball: Shape = Sphere::new(Point3::ORIGIN, 1.0).into();
    for tolerance in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = tessellate(&ball, tolerance);
        assert!(
            matches!(refused, Err(TessellationError::Tolerance { .. })),
            "{tolerance}"
        );
    }
    for tolerance in [1e-300, 1e-9, 2e-7] {
        let refused = tessellate(&ball, tolerance);
        assert!(
            matches!(refused, Err(TessellationError::TooFine { .. })),
            "{tolerance}"
        );
    }
    let far: Shape = Sphere::new(Point3::new(1e7, 0.0, 0.0), 1.0).into();
    assert!(
        tessellate(&far, 1e-3).is_err(),
        "the coordinates have no room for that"
    );
}

#[test]
fn sizes_at_the_ends_of_the_number_range_are_fine() {
    for radius in [1e-30_f32, 1e30] {
        let ball: Shape = Sphere::new(Point3::ORIGIN, radius).into();
        let mesh = tessellate(&ball, f64::from(radius) * 0.01).unwrap();
        assert!(mesh.triangles().len() > 100);
        let bounds: Aabb = mesh.bounds();
        assert!((bounds.max.z / radius - 1.0).abs() < 1e-6);
    }
}

#[test]
fn a_finer_tolerance_takes_triangles_in_proportion() {
    let ball: Shape = Sphere::new(Point3::ORIGIN, 1.0).into();
    let count = |tolerance| triangle_count(&ball, tolerance).unwrap();
    let ratio = count(1e-5) as f64 / count(1e-3) as f64;
    assert!((ratio / 100.0 - 1.0).abs() < 0.1, "{ratio}");
    assert_eq!(
        count(1e-3),
        tessellate(&ball, 1e-3).unwrap().triangles().len() as u64
    );
    assert_eq!(count(1e9), 48, "8 parts around, and 4 from pole to pole");
}
