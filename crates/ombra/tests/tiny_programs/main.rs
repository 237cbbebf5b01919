//! The two tiny programs of the lecture, which ombra has as ordinary scenes: each is held against a
//! program of its own, written down here from its rules, and against its reference picture if that
//! is there.

mod card;
mod contest;
mod vec3;

use std::path::PathBuf;

use ombra::pipeline::Cpu;
use ombra::render::{Crop, Rendering, Settings, Watch};
use ombra::scene::World;
use ombra::{LoadOptions, Loaded};

/// Renders a built-in scene as the scene wants it, changed by `change`.
fn render(name: &str, change: impl FnOnce(&mut Settings)) -> Rendering {
    let Loaded { scene, picture, .. } = ombra::load(name, &LoadOptions::default()).unwrap();
    let world = World::build(scene, Default::default()).unwrap();
    let mut settings = picture.settings(Settings::default());
    change(&mut settings);
    let camera = ombra::camera(&world, settings.aspect());
    let cpu = Cpu::all_threads();
    ombra::render::render(&world, &camera, &settings, &cpu, Watch::default()).unwrap()
}

/// A square of the picture.
const fn square(x0: u32, y0: u32, side: u32) -> Crop {
    Crop {
        x0,
        y0,
        x1: x0 + side,
        y1: y0 + side,
    }
}

/// A file beside the outside data, or `None`, said aloud, where there is none.
fn reference(name: &str) -> Option<PathBuf> {
    let beside = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data"));
    let data = std::env::var_os("OMBRA_TEST_DATA").map_or(beside, PathBuf::from);
    let file = data.join("../reference").join(name);
    if file.exists() {
        return Some(file);
    }
    eprintln!("skipped: no {} (OMBRA_TEST_DATA)", file.display());
    None
}
