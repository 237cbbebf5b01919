//! Local shading: what is drawn has the colours that rays with the same shading find.

use ombra_accel::{Geometry, Mesh, StructureKind};
use ombra_geometry::mesh::{generate, smooth_normals};
use ombra_geometry::{Angle, Transform, TriangleMesh, Vector3};
use ombra_pipeline::Cpu;
use ombra_render::compare::{Comparison, compare};
use ombra_render::{Settings, Watch};
use ombra_scene::camera::Camera;
use ombra_scene::{Light, Material, Rgb, Scene, Texture, World};

use crate::{camera, point, scene, settings, world};

fn both(world: &World, camera: &Camera, settings: &Settings) -> Comparison {
    let cpu = Cpu::all_threads();
    let kind = StructureKind::default();
    compare(world, camera, settings, kind, &cpu, &Watch::default())
        .unwrap()
        .unwrap()
}

/// A smooth ball, a turned and stretched ring and a chequered floor of meshes, with two lights.
fn meshes() -> Scene {
    let smooth = |mesh: TriangleMesh| smooth_normals(&mesh, Angle::from_degrees(60.0)).unwrap();
    let ball = smooth(generate::icosphere(3, point(-1.0, 0.3, 0.0), 1.0));
    let ring = smooth(generate::torus(point(0.0, 0.0, 0.0), [1.0, 0.3], [48, 24]));
    let floor = generate::grid(point(-6.0, -6.0, -1.0), [12.0, 12.0], [1, 1]);
    let shiny = |name: &str, colour| Material {
        specular: Rgb::grey(0.6),
        shininess: 20.0,
        ..Material::matt(name, colour)
    };
    let chequered = Material {
        diffuse: Texture::Checker {
            colours: [Rgb::new(0.9, 0.2, 0.1), Rgb::grey(0.7)],
            size: 0.7,
        },
        emission: Rgb::grey(0.05),
        ..Material::default()
    };
    let placed = Transform::rotation(Vector3::new(1.0, 0.5, 0.2), 0.8).then(
        &Transform::<ombra_geometry::World, ombra_geometry::World>::scale(Vector3::new(
            1.0, 0.6, 1.4,
        ))
        .then(&Transform::translation(Vector3::new(1.3, 0.2, 0.4))),
    );
    let mut scene = Scene {
        ambient: Rgb::grey(0.1),
        background: Rgb::new(0.3, 0.5, 0.8).into(),
        lights: vec![
            Light::Directional {
                direction: Vector3::new(-0.3, -1.0, -0.5),
                intensity: Rgb::grey(0.6),
            },
            Light::Area {
                corner: point(3.0, 3.0, 4.0),
                edge_u: Vector3::X,
                edge_v: Vector3::Y,
                intensity: Rgb::grey(0.4),
                falloff: Default::default(),
            },
        ],
        ..scene(vec![])
    };
    let mut add = |mesh, material, placed| {
        scene.add("mesh", Geometry::Mesh(Mesh::new(mesh)), material, placed);
    };
    add(
        ball,
        shiny("ball", Rgb::new(0.2, 0.5, 0.8)),
        Transform::identity(),
    );
    add(ring, shiny("ring", Rgb::new(0.8, 0.6, 0.2)), placed);
    add(floor, chequered, Transform::identity());
    scene
}

#[test]
fn of_meshes_is_that_of_rays_to_rounding() {
    let world = world(meshes());
    let eye = camera(point(0.5, -5.0, 3.0), point(0.2, 0.0, 0.0), 45.0);
    for spp in [1, 3] {
        let both = both(&world, &eye, &settings(200, 120, spp));
        let (drawn, traced) = (both.raster.rendering.raw(), both.local.rendering.raw());
        let apart = |(a, b): (&Rgb, &Rgb)| {
            let (a, b) = (a.to_array(), b.to_array());
            [0, 1, 2].map(|k| (a[k] - b[k]).abs())
        };
        let differing = drawn.iter().zip(&traced).map(apart);
        let differing = differing.filter(|d| d.iter().any(|x| *x > 1e-4)).count();
        // A sample on an edge, of a triangle or between two squares, may fall to either side.
        assert!(
            differing <= 24,
            "{differing} pixels, {spp} spp: {:?}",
            both.shading
        );
        let equal = both.shading.equal as f64 / both.shading.pixels as f64;
        assert!(equal >= 0.999, "{:?}", both.shading);
        let without_shadows = both.rays_add.within_one;
        assert!(
            without_shadows < both.shading.within_one,
            "there are shadows"
        );
    }
}

#[test]
fn tests_are_counted_in_either_order_of_the_loops() {
    let world = world(meshes());
    let eye = camera(point(0.5, -5.0, 3.0), point(0.2, 0.0, 0.0), 45.0);
    let both = both(&world, &eye, &settings(160, 96, 1));
    let pixels: Vec<_> = both.resolutions.iter().map(|row| row.pixels).collect();
    assert_eq!(pixels, [40 * 24, 80 * 48, 160 * 96]);
    for row in &both.resolutions {
        let triangles = 1280 + 2 * 48 * 24 + 2;
        assert_eq!((row.primitives, row.drawn), (triangles, triangles));
        assert_eq!(row.all_coverage_tests(), triangles * row.pixels);
        let tally = row.raster;
        assert!(tally.nearest <= tally.covered && tally.covered <= tally.coverage_tests);
        assert!(tally.coverage_tests < row.all_coverage_tests());
        assert!(row.rays.tests_made < row.all_intersection_tests());
    }
    // The same surfaces in more triangles: as many pixels are covered.
    let [once, four, sixteen] = [0, 1, 2].map(|i| both.primitives[i].operations);
    assert_eq!(
        (four.drawn, sixteen.drawn),
        (4 * once.drawn, 16 * once.drawn)
    );
    let covered = once.raster.covered as f64;
    for finer in [four, sixteen] {
        assert!((finer.raster.covered as f64 / covered - 1.0).abs() < 0.01);
    }
}

#[test]
fn an_empty_scene_is_background_for_both() {
    let scene = Scene {
        background: Rgb::new(0.1, 0.2, 0.3).into(),
        ..scene(vec![])
    };
    let eye = camera(point(0.0, -5.0, 0.0), point(0.0, 0.0, 0.0), 45.0);
    let both = both(&world(scene), &eye, &settings(16, 9, 2));
    assert_eq!((both.shading.equal, both.rays_add.equal), (144, 144));
    assert_eq!(both.raster.rendering.film.average(3, 3).unwrap().g, 0.2);
    assert_eq!(both.resolutions[2].raster.coverage_tests, 0);
}
