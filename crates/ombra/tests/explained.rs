//! The tree of a pixel adds up to the pixel of the picture, to the last bit, in every built-in scene.

use ombra::accel::StructureKind;
use ombra::geometry::Angle;
use ombra::pipeline::Cpu;
use ombra::render::explain::explain;
use ombra::render::{IntegratorKind, Settings, Watch, render};
use ombra::scene::camera::{Aperture, Projection, ThinLens};
use ombra::scene::{Camera, Rgb, World};
use ombra::{LoadOptions, builtin, load};

const SIDE: u32 = 12;

fn bits(colour: Rgb) -> [u32; 3] {
    colour.to_array().map(f32::to_bits)
}

fn built(name: &str) -> World {
    let loaded = load(name, &LoadOptions::default()).unwrap();
    World::build(loaded.scene, StructureKind::default()).unwrap()
}

/// Every pixel of a small picture: the tree's colour is the pixel, and each ray is the sum of its
/// parts.
fn check(name: &str, world: &World, camera: &Camera, settings: &Settings) {
    let cpu = Cpu::all_threads();
    let picture = render(world, camera, settings, &cpu, Watch::default()).unwrap();
    let mut rays = 0;
    for y in 0..settings.height {
        for x in 0..settings.width {
            let tree = explain(world, camera, settings, [x, y], &cpu).unwrap();
            let rendered = picture.film.average(x, y).unwrap();
            let what = format!("{name}, {}, pixel {x},{y}", settings.integrator);
            assert_eq!(bits(tree.colour), bits(rendered), "{what}");
            assert_eq!(tree.samples.len(), settings.spp as usize);
            for sample in &tree.samples {
                assert_eq!(bits(sample.rays[0].radiance), bits(sample.radiance));
                for (index, ray) in sample.rays.iter().enumerate() {
                    assert_eq!(
                        bits(sample.adds_up_to(index)),
                        bits(ray.radiance),
                        "{what}, ray {index}: {ray:?}"
                    );
                }
                let sent = |ray: &&ombra::render::explain::TracedRay| {
                    use ombra::render::explain::End;
                    !matches!(ray.end, End::MaxDepth | End::Unimportant)
                };
                rays += sample.rays.iter().filter(sent).count() as u64;
            }
        }
    }
    assert_eq!(rays, picture.rays, "{name}: every ray is in a tree");
}

#[test]
fn trees_add_up_to_the_picture() {
    for scene in builtin::ALL {
        let world = built(scene.name);
        let camera = ombra::camera(&world, 1.0);
        // The rasterizer has no rays.
        let with_rays = IntegratorKind::ALL
            .iter()
            .filter(|&&i| i != IntegratorKind::Raster);
        for &integrator in with_rays {
            for spp in [1, 4] {
                let settings = Settings {
                    width: SIDE,
                    height: SIDE,
                    spp,
                    integrator,
                    ..Settings::default()
                };
                check(scene.name, &world, &camera, &settings);
            }
        }
    }
}

#[test]
fn trees_add_up_through_a_lens() {
    let world = built("whitted");
    let lens = ThinLens {
        fov: Angle::from_degrees(38.0),
        shift: [0.0; 2],
        lens_radius: 0.2,
        focus_distance: 5.0,
        aperture: Aperture::default(),
    };
    let camera = Camera {
        projection: Projection::ThinLens(lens),
        ..ombra::camera(&world, 1.0)
    };
    for spp in [1, 4] {
        let settings = Settings {
            width: SIDE,
            height: SIDE,
            spp,
            seed: 7,
            ..Settings::default()
        };
        check("whitted with a lens", &world, &camera, &settings);
    }
}
