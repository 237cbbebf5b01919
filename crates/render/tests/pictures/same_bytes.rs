//! The same command gives the same bytes.

use ombra_accel::StructureKind;
use ombra_geometry::{Transform, Vector3};
use ombra_pipeline::Cpu;
use ombra_render::{Crop, IntegratorKind, SamplerKind, Settings, Watch, render};
use ombra_scene::camera::Camera;
use ombra_scene::{Light, Material, Rgb, Scene, World};

use crate::stage::*;

/// Something of everything: glass and mirror balls over a floor, three lights.
fn everything() -> Scene {
    let mirror = Material {
        reflection: Rgb::new(0.7, 0.8, 0.9),
        specular: Rgb::grey(0.5),
        ..Material::matt("mirror", Rgb::grey(0.1))
    };
    let glass = Material {
        transmission: Rgb::new(0.9, 0.95, 0.85),
        ..Material::glass("glass", 1.5)
    };
    let mut all = scene(
        vec![
            (floor(-1.0, 6.0), white()),
            (ball(-1.1, 0.0, 0.0, 1.0), mirror),
            (ball(1.1, 0.0, 0.0, 1.0), glass.clone()),
        ],
        vec![
            directional(-0.3, -1.0, -0.2),
            directional(0.5, -1.0, -0.1),
            Light::Point {
                position: point(4.0, 3.0, 0.5),
                intensity: Rgb::grey(0.5),
                falloff: Default::default(),
            },
        ],
    );
    let moved = Transform::translation(Vector3::new(2.5, 0.5, 0.8));
    all.add("bubble", ball(0.0, 0.0, 0.0, 0.7), glass, moved);
    all.ambient = Rgb::grey(0.1);
    all.background = Rgb::new(0.3, 0.5, 0.9).into();
    all
}

fn camera() -> Camera {
    camera_at(point(1.0, 2.0, 7.0), point(0.5, 0.0, 0.0), 40.0)
}

fn small(integrator: IntegratorKind) -> Settings {
    Settings {
        width: 40,
        height: 30,
        spp: 5,
        integrator,
        ..Settings::default()
    }
}

fn bits(pixels: &[Rgb]) -> Vec<[u32; 3]> {
    let bits = |pixel: &Rgb| pixel.to_array().map(f32::to_bits);
    pixels.iter().map(bits).collect()
}

#[test]
fn for_any_number_of_threads() {
    let world = build(everything());
    for &integrator in IntegratorKind::ALL {
        let by = |threads| {
            let cpu = Cpu::with_threads(threads).unwrap();
            render(
                &world,
                &camera(),
                &small(integrator),
                &cpu,
                Watch::default(),
            )
            .unwrap()
        };
        let one = by(1);
        assert_eq!(bits(&one.display()), bits(&one.display()));
        for threads in [2, 3] {
            let other = by(threads);
            assert_eq!(one, other, "{integrator} on {threads} threads");
            assert_eq!(bits(&one.raw()), bits(&other.raw()));
        }
    }
}

#[test]
fn for_a_part_as_for_the_whole() {
    let world = build(everything());
    for &integrator in IntegratorKind::ALL {
        let whole = picture(&world, &camera(), &small(integrator)).film;
        let crop = Crop {
            x0: 7,
            y0: 3,
            x1: 31,
            y1: 20,
        };
        let settings = Settings {
            crop: Some(crop),
            ..small(integrator)
        };
        let part = picture(&world, &camera(), &settings).film;
        assert_eq!((part.width(), part.height()), (24, 17));
        for y in 0..part.height() {
            for x in 0..part.width() {
                let pixel = part.average(x, y);
                assert_eq!(
                    pixel,
                    whole.average(x + crop.x0, y + crop.y0),
                    "{integrator}"
                );
            }
        }
    }
}

#[test]
fn with_any_structure() {
    let pictures = |integrator| {
        StructureKind::ALL.iter().map(move |&kind| {
            let world = World::build(everything(), kind).unwrap();
            (kind, picture(&world, &camera(), &small(integrator)).raw())
        })
    };
    for &integrator in IntegratorKind::ALL {
        // What finding costs is what structures differ in.
        if integrator == IntegratorKind::Cost {
            continue;
        }
        let mut judge = None;
        for (kind, pixels) in pictures(integrator) {
            let judge = judge.get_or_insert_with(|| bits(&pixels));
            assert_eq!(*judge, bits(&pixels), "{integrator} with {kind}");
        }
    }
}

#[test]
fn but_not_with_another_seed_or_sampler() {
    let world = build(everything());
    let first = picture(&world, &camera(), &small(IntegratorKind::Whitted));
    for other in [
        Settings {
            seed: 1,
            ..small(IntegratorKind::Whitted)
        },
        Settings {
            sampler: SamplerKind::Independent,
            ..small(IntegratorKind::Whitted)
        },
    ] {
        assert_ne!(first.film, picture(&world, &camera(), &other).film);
    }
}

#[test]
fn one_sample_goes_through_the_middle_whatever_the_seed() {
    let world = build(everything());
    let with_seed = |seed| {
        let settings = Settings {
            seed,
            spp: 1,
            ..small(IntegratorKind::Whitted)
        };
        picture(&world, &camera(), &settings).film
    };
    assert_eq!(with_seed(0), with_seed(99));
}
