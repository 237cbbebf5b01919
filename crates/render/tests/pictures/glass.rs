//! What is seen through things.

use ombra_geometry::{Angle, Vector3};
use ombra_scene::{Material, Rgb, Scene, Texture};

use crate::stage::*;

/// A floor that shows by its colour at which x it is met: a luminous strip on one side of x = `edge`.
fn strip(edge: f32) -> (ombra_accel::Geometry, Material) {
    let strip = quad(
        point(edge, -50.0, -3.0),
        Vector3::new(100.0, 0.0, 0.0),
        Vector3::new(0.0, 100.0, 0.0),
    );
    (strip, Material::luminous("strip", Rgb::WHITE))
}

fn clear(index_of_refraction: f32, fresnel: bool) -> Material {
    Material {
        fresnel,
        ..Material::glass("clear", index_of_refraction)
    }
}

#[test]
fn what_is_seen_under_water_is_where_snells_law_has_it() {
    for degrees in [0.0_f32, 30.0, 60.0] {
        for index in [1.0_f32, 1.33, 2.0] {
            let angle = Angle::from_degrees(degrees);
            // The camera looks at the origin of the surface z = 0; the strip is 3 below.
            let from = point(-angle.sin(), 0.0, angle.cos());
            let camera = camera_at(from, point(0.0, 0.0, 0.0), 1.0);
            let met = 3.0 * (angle.sin() / index).asin().tan();
            for (edge, expected) in [(met - 0.01, Rgb::WHITE), (met + 0.01, Rgb::BLACK)] {
                let things = vec![(wall(0.0, 9.0), clear(index, false)), strip(edge)];
                let seen = middle(scene(things, vec![]), &camera, 3);
                assert_eq!(seen, expected, "{degrees}° {index} {edge}");
            }
        }
    }
}

/// From within glass at z < 0, toward its surface at z = 0, seen from below at some angle to the
/// normal. Above is the background, below a light floor.
fn from_within(degrees: f32, fresnel: bool) -> Rgb {
    let angle = Angle::from_degrees(degrees);
    let surface = wall(0.0, 9.0);
    let floor = wall(-3.0, 90.0);
    let mut seen: Scene = scene(
        vec![
            (surface, clear(1.5, fresnel)),
            (floor, Material::luminous("floor", Rgb::new(1.0, 0.0, 0.0))),
        ],
        vec![],
    );
    seen.background = Rgb::new(0.0, 0.0, 1.0).into();
    let from = point(-angle.sin(), 0.0, -angle.cos());
    middle(seen, &camera_at(from, point(0.0, 0.0, 0.0), 1.0), 2)
}

#[test]
fn beyond_the_critical_angle_glass_is_a_mirror() {
    let critical = (1.0_f32 / 1.5).asin().to_degrees();
    for fresnel in [false, true] {
        assert_eq!(
            from_within(critical + 0.2, fresnel),
            Rgb::new(1.0, 0.0, 0.0)
        );
    }
    assert_eq!(from_within(critical - 0.2, false), Rgb::new(0.0, 0.0, 1.0));
}

#[test]
fn fresnel_shares_light_between_mirror_and_glass_and_loses_none() {
    for degrees in [0.0, 20.0, 35.0, 41.0, 60.0] {
        let seen = from_within(degrees, true);
        assert!((seen.r + seen.b - 1.0).abs() < 1e-5, "{degrees}: {seen:?}");
    }
    let straight = from_within(0.0, true);
    assert!((straight.r - 0.04).abs() < 1e-4, "{straight:?}");
}

#[test]
fn clear_glass_in_white_surroundings_is_white() {
    let mut furnace = scene(vec![(ball(0.0, 0.0, 0.0, 1.0), clear(1.5, true))], vec![]);
    furnace.background = Rgb::WHITE.into();
    let world = build(furnace);
    let pixels = picture(&world, &flat_camera(2.2), &settings()).display();
    for pixel in pixels {
        assert_close(pixel, Rgb::WHITE, 1e-4);
    }
}

#[test]
fn glass_that_does_not_bend_light_cannot_be_seen() {
    let checker = Material {
        diffuse: Texture::Checker {
            colours: [Rgb::BLACK, Rgb::WHITE],
            size: 0.3,
        },
        ..Material::default()
    };
    let view = |things: Vec<_>| {
        let mut seen = scene(things, vec![]);
        seen.ambient = Rgb::WHITE;
        let camera = camera_at(point(0.3, 0.2, 6.0), point(0.1, 0.0, 0.0), 25.0);
        picture(&build(seen), &camera, &settings()).display()
    };
    let back = || (wall(-2.0, 9.0), checker.clone());
    let through = view(vec![back(), (ball(0.0, 0.0, 0.0, 1.0), clear(1.0, false))]);
    let differing = view(vec![back()])
        .iter()
        .zip(&through)
        .filter(|(a, b)| a != b)
        .count();
    assert_eq!(differing, 0);
}
