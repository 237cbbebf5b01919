//! Shapes: endless ones are exact, curved ones keep to their tolerance; and all cameras.

use std::sync::atomic::AtomicBool;

use ombra_accel::{Geometry, Shapes};
use ombra_geometry::shape::{Cone, Cylinder, Disk, Ends, Plane, Shape, Sphere, Torus};
use ombra_geometry::{Angle, Normal3, Transform, TriangleMesh, Vector3};
use ombra_pipeline::Cpu;
use ombra_render::raster::notice;
use ombra_render::{IntegratorKind, RenderError, Settings, Watch, render};
use ombra_scene::camera::{
    Aperture, Camera, Orthographic, Panorama, Perspective, Pose, Projection, ThinLens,
};
use ombra_scene::{Light, Material, Rgb, Scene, World};

use crate::{assert_agreement, camera, compared, point, scene, settings, world};

fn of_shapes(shapes: Vec<Shape>) -> Scene {
    let mut scene = Scene {
        lights: vec![Light::Directional {
            direction: Vector3::new(-0.4, -0.5, -1.0),
            intensity: Rgb::WHITE,
        }],
        ..Scene::default()
    };
    for shape in shapes {
        let geometry = Geometry::Shapes(Shapes(vec![shape]));
        scene.add(
            "shape",
            geometry,
            Material::default(),
            Transform::identity(),
        );
    }
    scene
}

fn plane(height: f32, normal: [f32; 3]) -> Shape {
    let normal = Normal3::from(normal);
    Plane::new(point(0.0, 0.0, height), normal).unwrap().into()
}

fn curved() -> World {
    let up = Normal3::new(0.2, -0.4, 0.9);
    world(of_shapes(vec![
        Sphere::new(point(-1.5, 0.0, 0.0), 0.8).into(),
        Torus::new(point(0.5, 0.0, 0.0), up, 0.7, 0.25)
            .unwrap()
            .into(),
        Cylinder::new(point(1.8, 0.0, -0.5), point(2.0, 0.3, 0.7), 0.4, Ends::Open)
            .unwrap()
            .into(),
        Cone::new(
            point(0.0, 1.5, -0.5),
            point(0.2, 1.4, 1.0),
            0.6,
            Ends::Capped,
        )
        .unwrap()
        .into(),
        Disk::new(point(-1.0, 1.8, 0.5), up, 0.6).unwrap().into(),
        plane(-0.8, [0.0, 0.0, 1.0]),
    ]))
}

fn with(projection: Projection) -> Camera {
    let pose = Pose::look_at(
        point(0.5, -6.0, 2.0),
        point(0.2, 0.5, 0.0),
        Vector3::new(0.1, 0.0, 1.0),
    );
    Camera {
        pose: pose.unwrap(),
        projection,
    }
}

fn perspective() -> Perspective {
    Perspective::new(Angle::from_degrees(40.0))
}

#[test]
fn curved_shapes_differ_on_edges_alone() {
    let shift = [0.1, -0.05];
    for projection in [
        Projection::Perspective(perspective()),
        Projection::Perspective(Perspective {
            shift,
            ..perspective()
        }),
        Projection::Orthographic(Orthographic { height: 4.5 }),
    ] {
        assert_agreement(&curved(), &with(projection), "curved");
    }
}

#[test]
fn endless_planes_are_drawn_to_the_horizon() {
    // From above, from below, along the plane, and several through one another.
    let down = camera(point(0.0, 0.0, 1.0), point(5.0, 3.0, 0.0), 60.0);
    let level = camera(point(0.0, 0.0, 1.0), point(5.0, 3.0, 1.0), 90.0);
    let below = camera(point(0.0, 0.0, -2.0), point(5.0, 3.0, 0.0), 60.0);
    let within = camera(point(1.0, 1.0, 0.0), point(5.0, 3.0, 0.0), 60.0);
    let one = world(of_shapes(vec![plane(0.0, [0.0, 0.0, 1.0])]));
    for eye in [down, level, below] {
        assert_agreement(&one, &eye, "plane");
    }
    let covered = compared(&one, &level, 1).covered;
    assert!((20_000..44_000).contains(&covered), "half of it: {covered}");
    // An eye in the plane itself: rays begin on it and meet it at distance 0; drawn, it is an edge.
    let on_it = compared(&one, &within, 1);
    assert_eq!((on_it.covered, on_it.same_primitive), (64_000, 0));
    let several = world(of_shapes(vec![
        plane(0.0, [0.0, 0.0, 1.0]),
        plane(1.5, [1.0, 0.3, -0.7]),
        plane(-3.0, [0.2, -1.0, 0.4]),
        Sphere::new(point(4.0, 2.0, 0.3), 1.0).into(),
    ]));
    assert_agreement(&several, &down, "planes");
    let flat = with(Projection::Orthographic(Orthographic { height: 9.0 }));
    assert_agreement(&several, &flat, "planes without perspective");
}

#[test]
fn shapes_around_the_eye_are_seen_from_within() {
    let sky = world(of_shapes(vec![
        Sphere::new(point(0.0, 0.0, 0.0), 100.0).into(),
        Cylinder::new(
            point(-2.0, 0.0, 0.0),
            point(20.0, 0.0, 0.0),
            1.0,
            Ends::Open,
        )
        .unwrap()
        .into(),
    ]));
    let eye = camera(point(0.1, 0.2, 0.3), point(5.0, 0.4, 0.1), 70.0);
    assert_agreement(&sky, &eye, "from within");
}

#[test]
fn a_corner_at_distance_one_is_no_sign_of_perspective() {
    let corners = [
        point(-1.0, -1.0, -1.0),
        point(1.0, -1.0, 2.0),
        point(0.0, 1.0, -3.0),
    ];
    let mesh = TriangleMesh::new(corners.to_vec(), vec![[0, 1, 2]]).unwrap();
    let through = world(scene(vec![mesh]));
    let eye = Camera {
        pose: Pose::look_at(point(0.0, 0.0, 0.0), point(0.0, 0.0, -1.0), Vector3::Y).unwrap(),
        projection: Projection::Orthographic(Orthographic { height: 3.0 }),
    };
    assert_agreement(&through, &eye, "through the plane of the camera");
    assert!(compared(&through, &eye, 1).covered > 1000);
}

#[test]
fn degenerate_shapes_are_not_seen() {
    let nothing = world(of_shapes(vec![
        Sphere::new(point(0.0, 0.0, 0.0), 0.0).into(),
        Sphere::new(point(f32::NAN, 0.0, 0.0), 1.0).into(),
    ]));
    let eye = with(Projection::Perspective(perspective()));
    let agreement = compared(&nothing, &eye, 1);
    assert_eq!((agreement.covered, agreement.share()), (0, 1.0));
}

fn drawn(camera: &Camera, spp: u32) -> Vec<Rgb> {
    let settings = Settings {
        integrator: IntegratorKind::Raster,
        ..settings(64, 40, spp)
    };
    let cpu = Cpu::all_threads();
    let rendering = render(&curved(), camera, &settings, &cpu, Watch::default()).unwrap();
    assert_eq!((rendering.rays, rendering.film.done()), (0, 1.0));
    rendering.raw()
}

#[test]
fn a_lens_is_drawn_through_its_middle_and_that_is_said() {
    let lens = with(Projection::ThinLens(ThinLens {
        fov: Angle::from_degrees(40.0),
        lens_radius: 0.5,
        focus_distance: 3.0,
        aperture: Aperture::Disk,
        shift: [0.0; 2],
    }));
    let pinhole = with(Projection::Perspective(perspective()));
    assert!(notice(&lens).is_some_and(|notice| notice.contains("lens")));
    assert_eq!(notice(&pinhole), None);
    for spp in [1, 4] {
        let (one, other) = (drawn(&lens, spp), drawn(&pinhole, spp));
        let apart = one.iter().zip(&other);
        let far = apart.filter(|(a, b)| (a.r - b.r).abs() > 1e-3).count();
        assert!(far < 10, "{far}: the same but for rounding");
    }
}

#[test]
fn a_panorama_is_refused() {
    let around = with(Projection::Panorama(Panorama));
    let settings = Settings {
        integrator: IntegratorKind::Raster,
        ..settings(64, 32, 1)
    };
    let cpu = Cpu::all_threads();
    let refused = render(&curved(), &around, &settings, &cpu, Watch::default());
    assert_eq!(refused, Err(RenderError::NotRasterizable));
}

#[test]
fn stopped_before_the_start_nothing_is_drawn() {
    let stop = AtomicBool::new(true);
    let settings = Settings {
        integrator: IntegratorKind::Raster,
        ..settings(64, 40, 4)
    };
    let watch = Watch {
        stop: Some(&stop),
        ..Watch::default()
    };
    let eye = with(Projection::Perspective(perspective()));
    let rendering = render(&curved(), &eye, &settings, &Cpu::all_threads(), watch).unwrap();
    assert!(rendering.stopped);
    assert_eq!(rendering.film.done(), 0.0);
}
