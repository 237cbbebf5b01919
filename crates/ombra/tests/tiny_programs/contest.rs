//! The minimal ray tracing contest.

use ombra::builtin;
use ombra::formats::Limits;
use ombra::formats::minray::{Contest, ContestPicture, ContestSphere, read_contest_picture};

use crate::vec3::Vec3;
use crate::{reference, render};

const SCENES: [&str; 3] = ["minray", "minray:test2", "minray:test3"];

/// What ombra makes of one of the contest's scenes.
fn ours(name: &str) -> ContestPicture {
    let rendering = render(name, |_| ());
    let (width, height) = (rendering.film.width(), rendering.film.height());
    ContestPicture::from_light(width, height, &rendering.raw())
}

fn contest(name: &str) -> Contest {
    builtin::find(name).unwrap().contest().unwrap().unwrap()
}

/// The largest difference of a component.
fn difference(a: &[[f32; 3]], b: &[[f32; 3]]) -> f32 {
    assert_eq!(a.len(), b.len());
    a.iter()
        .flatten()
        .zip(b.iter().flatten())
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f32::max)
}

#[test]
fn the_first_scene_is_the_contests_picture() {
    let Some(file) = reference("minray/test1.ap") else {
        return;
    };
    let theirs = read_contest_picture(file, &Limits::default()).unwrap();
    let off = difference(ours("minray").pixels(), theirs.pixels());
    assert!(off <= 1.0, "{off}");
}

#[test]
fn the_scenes_are_what_a_program_by_the_rules_makes_of_them() {
    for name in SCENES {
        let ours = ours(name);
        let theirs = picture(&contest(name));
        let off = difference(ours.pixels(), &theirs);
        assert!(off <= 1.0, "{name}: {off}");
    }
}

#[test]
fn a_deeper_tree_is_another_picture() {
    // Or the test above would not notice what is beyond the last ray.
    let shallow = picture(&Contest {
        depth: 2,
        ..contest("minray")
    });
    assert!(difference(&shallow, &picture(&contest("minray"))) > 10.0);
}

/// The contest's rules, in double precision and with nothing of ombra's.
fn picture(contest: &Contest) -> Vec<[f32; 3]> {
    let size = f64::from(contest.size);
    let half = f64::from(contest.size / 2);
    let away = half / (f64::from(contest.angle_of_view).to_radians() / 2.0).tan();
    let mut pixels = Vec::new();
    for y in 0..contest.size {
        for x in 0..contest.size {
            let direction = Vec3::new(f64::from(x) - half, away, half - f64::from(y)).unit();
            let light = trace(contest, contest.depth, Vec3::new(0.0, 0.0, 0.0), direction);
            pixels.push(light.0.map(|c| (c * 255.0).round() as f32));
        }
    }
    assert_eq!(pixels.len() as f64, size * size);
    pixels
}

/// Which sphere is met first, and where.
fn met(contest: &Contest, from: Vec3, direction: Vec3) -> Option<(usize, f64)> {
    let meets = |sphere: &ContestSphere| {
        let way = Vec3::from_singles(sphere.centre) - from;
        let along = way.dot(direction);
        let radius = f64::from(sphere.radius);
        let root = (along * along - way.dot(way) + radius * radius).sqrt();
        // NaN where the line passes by.
        [along - root, along + root].into_iter().find(|&t| t > 1e-7)
    };
    let all = contest.spheres.iter().enumerate();
    let meets = all.filter_map(|(i, sphere)| Some((i, meets(sphere)?)));
    meets.min_by(|a, b| a.1.total_cmp(&b.1))
}

fn trace(contest: &Contest, depth: u32, from: Vec3, direction: Vec3) -> Vec3 {
    let black = Vec3::new(0.0, 0.0, 0.0);
    if depth == 0 {
        return black;
    }
    let ambient = Vec3::from_singles(contest.ambient);
    let Some((index, t)) = met(contest, from, direction) else {
        return ambient;
    };
    let sphere = &contest.spheres[index];
    let point = from + direction * t;
    let outward = (point - Vec3::from_singles(sphere.centre)).unit();
    let outside = outward.dot(direction) < 0.0;
    let ir = f64::from(sphere.ir);
    let (normal, eta) = if outside {
        (outward, 1.0 / ir)
    } else {
        (-outward, ir)
    };
    let mut scattered = ambient;
    for (light, lamp) in contest.spheres.iter().enumerate() {
        let toward = (Vec3::from_singles(lamp.centre) - point).unit();
        let cosine = toward.dot(normal);
        let strength = f64::from(lamp.kl) * cosine;
        if strength > 0.0 && met(contest, point, toward).is_some_and(|(first, _)| first == light) {
            scattered = scattered + Vec3::from_singles(lamp.colour) * strength;
        }
    }
    let colour = Vec3::from_singles(sphere.colour);
    let cosine = -normal.dot(direction);
    let mirrored = direction + normal * (2.0 * cosine);
    let beyond = 1.0 - eta * eta * (1.0 - cosine * cosine);
    let through = if beyond > 0.0 {
        let bent = direction * eta + normal * (eta * cosine - beyond.sqrt());
        trace(contest, depth - 1, point, bent)
    } else {
        black
    };
    colour.times(scattered) * f64::from(sphere.kd)
        + trace(contest, depth - 1, point, mirrored) * f64::from(sphere.ks)
        + through * f64::from(sphere.kt)
        + colour * f64::from(sphere.kl)
}
