//! Trees of rays that were worked out by hand.

use ombra_geometry::{Hit, Vector3};
use ombra_pipeline::Cpu;
use ombra_render::Settings;
use ombra_render::explain::{
    End, ExplainError, Explainer, LightWay, Part, PixelTree, RayKind, TracedRay, explain,
};
use ombra_scene::{Camera, Material, Rgb, Scene, Texture};

use crate::stage::{
    WIDTH, assert_close, ball, build, camera_at, directional, flat_camera, floor, point, quad,
    scene, settings, wall, white,
};

const MIDDLE: [u32; 2] = [WIDTH / 2, WIDTH / 2];

fn tree(scene: Scene, camera: &Camera, settings: &Settings, pixel: [u32; 2]) -> PixelTree {
    let cpu = Cpu::with_threads(1).unwrap();
    explain(&build(scene), camera, settings, pixel, &cpu).unwrap()
}

fn hit(ray: &TracedRay) -> &Hit {
    &ray.met.as_ref().expect("it met something").hit
}

#[test]
fn a_mirror_that_faces_a_checkered_floor() {
    let mirror = quad(
        point(-5.0, -5.0, -5.0),
        Vector3::new(10.0, 0.0, 0.0),
        Vector3::new(0.0, 10.0, 10.0),
    );
    let checkered = Material {
        diffuse: Texture::Checker {
            colours: [Rgb::new(0.8, 0.2, 0.0), Rgb::WHITE],
            size: 1.0,
        },
        ..white()
    };
    let mut scene = scene(
        vec![
            (mirror, Material::mirror("mirror", Rgb::grey(0.5))),
            (floor(-3.0, 4.0), checkered),
        ],
        Vec::new(),
    );
    scene.ambient = Rgb::grey(0.5);
    // A pixel is a tenth of a unit: this one looks at x = 0.4, y = 0.3, where the mirror is at
    // z = 0.3. It sends what comes along −z down, to a square of the first colour.
    let camera = flat_camera(3.3);
    let tree = tree(scene, &camera, &settings(), [20, 13]);
    assert_close(tree.colour, Rgb::new(0.2, 0.05, 0.0), 1e-6);

    let [sample] = &tree.samples[..] else {
        panic!("one sample")
    };
    let [seen, reflected] = &sample.rays[..] else {
        panic!("two rays: {:?}", sample.rays)
    };
    assert_eq!(
        (seen.kind, seen.parent, seen.step),
        (RayKind::Camera, None, 0)
    );
    assert_eq!((seen.end, hit(seen).instance.index()), (End::Surface, 0));
    assert!((hit(seen).t - 9.7).abs() < 1e-5);
    assert!(seen.cost.tests_made > 0 && seen.cost.nodes_visited > 0);

    assert_eq!(reflected.kind, RayKind::Reflected);
    assert_eq!((reflected.parent, reflected.step), (Some(0), 1));
    assert!((reflected.ray.direction - -Vector3::Y).length() < 1e-6);
    let place = reflected.met.unwrap();
    assert_eq!(place.hit.instance.index(), 1);
    assert!((place.point - point(0.4, -3.0, 0.3)).length() < 1e-5);
    assert!(place.front);
    assert_eq!(reflected.weight, Rgb::grey(0.5));
    assert_eq!(reflected.weight_in_pixel, Rgb::grey(0.5));
    assert_close(reflected.radiance, Rgb::new(0.4, 0.1, 0.0), 1e-6);
    assert!(reflected.parts.contains(&Part::Ambient(reflected.radiance)));
}

#[test]
fn light_that_cannot_leave_a_glass_ball() {
    let background = Rgb::new(0.2, 0.4, 0.6);
    let mut scene = scene(
        vec![(ball(0.0, 0.0, 0.0, 1.0), Material::glass("glass", 1.5))],
        Vec::new(),
    );
    scene.background = background.into();
    // From within, along a chord 0.9 from the centre: the sine of the angle is 0.9 at every bounce,
    // above 1 / 1.5.
    let camera = camera_at(point(0.0, 0.9, 0.0), point(1.0, 0.9, 0.0), 30.0);
    let settings = Settings {
        max_depth: 3,
        ..settings()
    };
    let tree = tree(scene, &camera, &settings, MIDDLE);
    let rays = &tree.samples[0].rays;
    assert_eq!(rays.len(), 5);
    for (step, ray) in rays[..4].iter().enumerate() {
        assert_eq!(ray.step as usize, step);
        assert_eq!(ray.parent, step.checked_sub(1));
        let split = ray.split.expect("glass");
        assert!(split.total && split.mirrored == 1.0 && (split.eta - 1.5).abs() < 1e-6);
        assert!(!ray.met.unwrap().front);
        assert_eq!(ray.weight, Rgb::WHITE);
        let kind = if step == 0 {
            RayKind::Camera
        } else {
            RayKind::Reflected
        };
        assert_eq!(ray.kind, kind);
    }
    assert_eq!((rays[4].end, rays[4].met), (End::MaxDepth, None));
    assert_eq!(rays[4].cost.nodes_visited, 0, "it was not sent");
    assert_eq!(tree.colour, background);
}

#[test]
fn a_ball_of_glass_that_absorbs() {
    let absorption = Rgb::new(0.1, 0.5, 2.0);
    let glass = Material {
        absorption,
        emission: Rgb::new(0.0, 0.0, 0.25),
        ..Material::glass("amber", 1.5)
    };
    let mut scene = scene(vec![(ball(0.0, 0.0, 0.0, 1.0), glass)], Vec::new());
    scene.background = Rgb::new(0.9, 0.6, 0.3).into();
    let settings = Settings {
        max_depth: 6,
        ..settings()
    };
    let camera = camera_at(point(0.0, 0.0, 5.0), point(0.0, 0.0, 0.0), 40.0);
    let tree = tree(scene, &camera, &settings, MIDDLE);
    let sample = &tree.samples[0];
    let mut within = 0;
    for (index, ray) in sample.rays.iter().enumerate() {
        let bits = |colour: Rgb| colour.to_array().map(f32::to_bits);
        let sum = sample.adds_up_to(index);
        assert_eq!(bits(sum), bits(ray.radiance), "ray {index}");
        // Rays within the ball, and only they, have come through glass.
        let met = ray.met;
        assert_eq!(
            ray.absorbed.is_some(),
            met.is_some_and(|place| !place.front),
            "ray {index}"
        );
        let Some(absorbed) = ray.absorbed else {
            continue;
        };
        within += 1;
        assert!((absorbed.way - met.unwrap().hit.t).abs() < 1e-5);
        let left = absorption.to_array().map(|a| (-a * absorbed.way).exp());
        assert_close(absorbed.left, left.into(), 1e-6);
        for child in sample.children(index) {
            let child = &sample.rays[child];
            let through_ball = ray.weight_in_pixel * absorbed.left * child.weight;
            assert_eq!(child.weight_in_pixel, through_ball);
        }
    }
    assert!(within >= 2, "{within}");
    // Close to the middle the way is a diameter: most of the blue is gone.
    let first = sample.rays.iter().find_map(|ray| ray.absorbed).unwrap();
    assert!((first.way - 2.0).abs() < 0.01 && first.left.b < 0.02);
}

#[test]
fn a_point_in_the_shade() {
    // The light comes from the upper left at 45°, and a ball is in its way.
    let in_shade = scene(
        vec![
            (wall(0.0, 5.0), white()),
            (ball(-2.0, 0.0, 2.0, 0.5), white()),
        ],
        vec![directional(1.0, 0.0, -1.0), directional(0.0, 0.0, 1.0)],
    );
    let tree = tree(in_shade, &flat_camera(3.3), &settings(), MIDDLE);
    assert_eq!(tree.colour, Rgb::BLACK);
    let [seen, shadow] = &tree.samples[0].rays[..] else {
        panic!("two rays: {:?}", tree.samples[0].rays)
    };
    assert_eq!(shadow.kind, RayKind::Shadow { light: 0 });
    assert_eq!((shadow.end, shadow.radiance), (End::Blocked, Rgb::BLACK));
    let [blocker] = shadow.crossed[..] else {
        panic!("one blocker: {:?}", shadow.crossed)
    };
    assert_eq!(
        (blocker.hit.instance.index(), blocker.transmission),
        (1, None)
    );
    assert!((blocker.hit.t - (8_f32.sqrt() - 0.5)).abs() < 1e-4);
    let cosine = 0.5_f32.sqrt();
    assert_close(shadow.weight, Rgb::grey(cosine), 1e-6);
    let lights: Vec<_> = seen
        .parts
        .iter()
        .filter_map(|part| match part {
            Part::Light(light) => Some((light.light, light.way)),
            _ => None,
        })
        .collect();
    assert_eq!(lights, [(0, LightWay::Ray(1)), (1, LightWay::Behind)]);
}

#[test]
fn what_is_not_in_the_picture_cannot_be_explained() {
    let world = build(Scene::default());
    let camera = flat_camera(1.0);
    let at = |pixel| Explainer::new(&world, &camera, &settings(), pixel).map(drop);
    assert!(at([WIDTH - 1, WIDTH - 1]).is_ok());
    for outside in [[WIDTH, 0], [0, WIDTH], [u32::MAX, u32::MAX]] {
        assert!(
            matches!(at(outside), Err(ExplainError::PixelOutside { .. })),
            "{outside:?}"
        );
    }
    let cpu = Cpu::with_threads(1).unwrap();
    let mut explainer = Explainer::new(&world, &camera, &settings(), [0, 0]).unwrap();
    let beyond = explainer.sample(1, &cpu);
    assert_eq!(
        beyond,
        Err(ExplainError::NoSuchSample { sample: 1, spp: 1 })
    );
    let nothing = explainer.sample(0, &cpu).unwrap();
    assert_eq!(
        (nothing.rays.len(), nothing.rays[0].end),
        (1, End::Background)
    );
}

#[test]
fn a_tree_without_end_is_given_up() {
    // Surfaces that pass on twice what arrives: no ray is ever unimportant.
    let material = Material {
        reflection: Rgb::WHITE,
        transmission: Rgb::WHITE,
        index_of_refraction: 1.0,
        ..Material::mirror("too bright", Rgb::WHITE)
    };
    let things = (0..3).map(|i| (wall(-(i as f32), 5.0), material.clone()));
    let world = build(scene(things.collect(), Vec::new()));
    let settings = Settings {
        max_depth: 128,
        ..settings()
    };
    let camera = flat_camera(3.3);
    let mut explainer = Explainer::new(&world, &camera, &settings, MIDDLE).unwrap();
    let cpu = Cpu::with_threads(1).unwrap();
    let error = explainer.sample(0, &cpu);
    assert_eq!(error, Err(ExplainError::TooManyRays { sample: 0 }));
}
