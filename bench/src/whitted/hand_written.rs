//! The recursion as one writes it without a pipeline: direct calls, one loop over pixels.

use ombra_accel::Traversable;
use ombra_geometry::Ray;
use ombra_scene::Rgb;
use rayon::prelude::*;

use super::{MAX_DEPTH, Picture, shading};
use crate::scenes::Stage;

pub(super) fn picture(stage: &Stage) -> Picture {
    let width = stage.pixels as usize;
    let mut picture = vec![[0; 3]; width * width];
    picture
        .par_chunks_mut(width.max(1))
        .enumerate()
        .for_each(|(y, row)| {
            for (x, pixel) in row.iter_mut().enumerate() {
                let ray = shading::camera_ray(stage, x as u32, y as u32);
                *pixel = shading::bits(trace(stage, &ray, 1));
            }
        });
    picture
}

fn trace(stage: &Stage, ray: &Ray, depth: u32) -> Rgb {
    let world = &stage.world;
    let Some(hit) = world.intersect(ray) else {
        return world.scene().background.at(ray.direction);
    };
    let material = world.material(&hit);
    let place = world.interaction(ray, &hit);
    let mut colour = shading::ambient(stage, material, &place);
    for light in &world.scene().lights {
        if let Some(sample) = light.sample_li(place.point, || [0.5; 2])
            && let Some((direct, shadow)) = shading::direct(material, &place, &sample)
            && !world.occluded(&shadow)
        {
            colour += direct;
        }
    }
    if depth < MAX_DEPTH && !material.reflection.is_black() {
        let reflected = trace(stage, &shading::mirrored(&place), depth + 1);
        colour += material.reflection * reflected;
    }
    colour
}
