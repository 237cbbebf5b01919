//! No surface shades itself.

use ombra_accel::{Geometry, Mesh};
use ombra_geometry::shape::{Cone, Cuboid, Cylinder, Disk, Ends, Plane, Shape, Sphere, Torus};
use ombra_geometry::{Object, Point3, Transform, TriangleMesh, Vector3, World as WorldSpace};
use ombra_render::{IntegratorKind, Settings};
use ombra_scene::camera::{Orthographic, Pose, Projection};
use ombra_scene::{Camera, Rgb, Scene};

use crate::stage::*;

/// A ball of triangles.
fn mesh_ball(centre: Point3, radius: f32) -> Geometry {
    let (rings, segments) = (24_u32, 48_u32);
    let mut positions = Vec::new();
    for ring in 0..=rings {
        let (sin_t, cos_t) = (std::f32::consts::PI * ring as f32 / rings as f32).sin_cos();
        for segment in 0..segments {
            let (sin, cos) = (std::f32::consts::TAU * segment as f32 / segments as f32).sin_cos();
            positions.push(centre + Vector3::new(sin_t * cos, cos_t, -sin_t * sin) * radius);
        }
    }
    let mut triangles = Vec::new();
    for ring in 0..rings {
        for segment in 0..segments {
            let next = (segment + 1) % segments;
            let (a, b) = (ring * segments + segment, ring * segments + next);
            let (c, d) = (a + segments, b + segments);
            triangles.extend([[a, c, b], [b, c, d]]);
        }
    }
    Geometry::Mesh(Mesh::new(TriangleMesh::new(positions, triangles).unwrap()))
}

/// Where things stand and how large they are: at the origin, at coordinates of their own far away,
/// and moved far away by a transform.
fn places() -> Vec<(f32, Vector3, Transform<Object, WorldSpace>)> {
    let far = Vector3::new(1e6, -7e5, 3e5);
    let mut places: Vec<_> = [1e-3, 1.0, 1e3]
        .map(|scale| (scale, Vector3::ZERO, Transform::identity()))
        .to_vec();
    places.push((1e3, far, Transform::identity()));
    places.push((1e3, Vector3::ZERO, Transform::translation(far.wide())));
    places
}

/// From where the camera looks at things.
const VIEW: Vector3 = Vector3::new(0.4, 1.0, 0.7);

/// Along the light, without perspective: what is seen is lit, and nothing else is.
fn along_the_light(middle: Point3, scale: f32) -> Camera {
    Camera {
        pose: Pose::look_at(middle + VIEW * (4.0 * scale), middle, Vector3::Y).unwrap(),
        projection: Projection::Orthographic(Orthographic {
            height: 2.6 * scale,
        }),
    }
}

/// Nearly along the light: the front of something convex is lit.
fn nearly_along_the_light(middle: Point3, scale: f32) -> Camera {
    camera_at(middle + VIEW * (4.0 * scale), middle, 24.0)
}

/// A picture of one thing whose front is lit: every pixel of it must be.
fn assert_no_dark_pixel(
    name: &str,
    camera: impl Fn(Point3, f32) -> Camera,
    make: impl Fn(Point3, f32) -> Geometry,
) {
    for (scale, offset, transform) in places() {
        let centre = Point3::ORIGIN + offset;
        let middle: Point3 = transform.point(centre.wide()).cast();
        let camera = camera(middle, scale);
        let mut lit = Scene {
            background: Rgb::WHITE.into(),
            lights: vec![directional(-VIEW.x, -VIEW.y, -VIEW.z)],
            ..Scene::default()
        };
        lit.add(name, make(centre, scale), white(), transform);
        let settings = Settings {
            width: 96,
            height: 96,
            ..settings()
        };
        let film = picture(&build(lit), &camera, &settings).film;
        let mut shaded = 0;
        for y in 0..96 {
            for x in 0..96 {
                let seen = film.average(x, y).unwrap().r;
                assert!(
                    seen > 0.0,
                    "{name} of {scale} at {offset:?}: ({x}, {y}) is dark"
                );
                shaded += u32::from(seen < 1.0);
            }
        }
        assert!(
            shaded > 1000,
            "{name} of {scale} at {offset:?} is not in the picture"
        );
    }
}

#[test]
fn a_lit_ball_has_no_dark_pixel() {
    assert_no_dark_pixel("ball", nearly_along_the_light, |centre, radius| {
        shape(Sphere::new(centre, radius))
    });
}

#[test]
fn a_lit_mesh_has_no_dark_pixel() {
    assert_no_dark_pixel("mesh", nearly_along_the_light, mesh_ball);
}

#[test]
fn a_lit_floor_has_no_dark_pixel() {
    assert_no_dark_pixel("floor", nearly_along_the_light, |centre, half| {
        let side = half * 20.0;
        quad(
            centre - Vector3::new(side, 0.0, side) * 0.5,
            Vector3::new(0.0, 0.0, side),
            Vector3::new(side, 0.0, 0.0),
        )
    });
}

#[test]
fn no_lit_shape_has_a_dark_pixel() {
    type Make = fn(Point3, f32) -> Shape;
    let shapes: [(&str, Make); 6] = [
        ("cylinder", |c, r| {
            let half = Vector3::new(0.0, 0.6 * r, 0.3 * r);
            Cylinder::new(c - half, c + half, 0.5 * r, Ends::Open)
                .unwrap()
                .into()
        }),
        ("cone", |c, r| {
            let half = Vector3::Y * (0.6 * r);
            Cone::new(c - half, c + half, 0.6 * r, Ends::Capped)
                .unwrap()
                .into()
        }),
        ("box", |c, r| {
            let half = Vector3::new(0.5, 0.4, 0.6) * r;
            Cuboid::new(c - half, c + half).unwrap().into()
        }),
        ("torus", |c, r| {
            let axis = Vector3::Y.to_normal();
            Torus::new(c, axis, 0.7 * r, 0.3 * r).unwrap().into()
        }),
        ("disk", |c, r| {
            Disk::new(c, Vector3::Y.to_normal(), r).unwrap().into()
        }),
        ("plane", |c, _| {
            Plane::new(c, Vector3::Y.to_normal()).unwrap().into()
        }),
    ];
    for (name, make) in shapes {
        assert_no_dark_pixel(name, along_the_light, |c, r| shape(make(c, r)));
    }
}

#[test]
fn an_open_floor_is_open_everywhere() {
    let world = build(scene(vec![(floor(0.0, 9.0), white())], vec![]));
    let settings = Settings {
        integrator: IntegratorKind::AmbientOcclusion,
        spp: 16,
        ..settings()
    };
    let camera = camera_at(point(0.0, 2.0, 5.0), point(0.0, 0.0, 0.0), 40.0);
    let pixels = picture(&world, &camera, &settings).raw();
    assert!(pixels.iter().all(|&pixel| pixel == Rgb::WHITE));
}
