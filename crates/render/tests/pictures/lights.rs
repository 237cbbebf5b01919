//! Lights, shadows, and Phong's model.

use ombra_geometry::{Angle, Vector3};
use ombra_scene::light::Falloff;
use ombra_scene::{Light, Material, Rgb};

use crate::stage::*;

const RED: Rgb = Rgb::new(1.0, 0.0, 0.0);

#[test]
fn a_matt_ball_under_a_distant_light_is_as_bright_as_the_cosine() {
    let towards = Vector3::new(0.48, 0.6, 0.64);
    let light = Light::Directional {
        direction: -towards * 7.0,
        intensity: Rgb::new(1.0, 0.5, 0.25),
    };
    let world = build(scene(
        vec![(ball(0.0, 0.0, 0.0, 1.0), white())],
        vec![light],
    ));
    let film = picture(&world, &flat_camera(2.2), &settings()).film;
    let mut on_the_ball = 0;
    for y in 0..WIDTH {
        for x in 0..WIDTH {
            let at = |i: u32| ((i as f32 + 0.5) / WIDTH as f32 - 0.5) * 2.2;
            let (px, py) = (at(x), -at(y));
            let squared = 1.0 - px * px - py * py;
            if squared < 0.01 {
                continue;
            }
            on_the_ball += 1;
            let cosine = Vector3::new(px, py, squared.sqrt()).dot(towards).max(0.0);
            let expected = Rgb::new(1.0, 0.5, 0.25) * cosine;
            assert_close(film.average(x, y).unwrap(), expected, 2e-5);
        }
    }
    assert!(on_the_ball > 600);
    assert_eq!(film.average(0, 0), Some(Rgb::BLACK), "the background");
}

#[test]
fn what_is_in_the_way_of_a_light_puts_a_place_into_shade() {
    let lit = |things: Vec<_>| {
        let mut all = vec![(wall(0.0, 5.0), white())];
        all.extend(things);
        let light = Light::Point {
            position: point(3.0, 0.0, 4.0),
            intensity: Rgb::grey(0.5),
            falloff: Falloff::None,
        };
        middle(scene(all, vec![light]), &flat_camera(1.0), 8)
    };
    let open = Rgb::grey(0.5 * 0.8);
    assert_close(lit(vec![]), open, 1e-5);
    let between = || ball(1.5, 0.0, 2.0, 0.5);
    assert_eq!(lit(vec![(between(), white())]), Rgb::BLACK);
    let beyond = ball(6.0, 0.0, 8.0, 0.5);
    assert_close(lit(vec![(beyond, white())]), open, 1e-5);
    let lamp = Material::luminous("lamp", RED);
    assert_close(lit(vec![(between(), lamp)]), open, 1e-5);
    let glass = Material {
        transmission: Rgb::new(0.5, 1.0, 0.0),
        ..Material::glass("green", 1.5)
    };
    // Twice: into the ball and out of it.
    assert_close(lit(vec![(between(), glass)]), Rgb::new(0.1, 0.4, 0.0), 1e-5);
}

#[test]
fn a_light_behind_a_surface_does_not_shine_through() {
    for direction in [[0.3, 0.2, 1.0], [1.0, 0.0, 0.0]] {
        let [x, y, z] = direction;
        let back_lit = scene(vec![(wall(0.0, 5.0), white())], vec![directional(x, y, z)]);
        assert_eq!(middle(back_lit, &flat_camera(1.0), 8), Rgb::BLACK);
    }
}

#[test]
fn both_sides_of_a_surface_are_shaded_alike() {
    // The wall faces away from the camera.
    let turned = quad(
        point(-1.0, -1.0, 0.0),
        Vector3::new(0.0, 2.0, 0.0),
        Vector3::new(2.0, 0.0, 0.0),
    );
    let lit = scene(vec![(turned, white())], vec![directional(0.0, -0.6, -0.8)]);
    assert_close(middle(lit, &flat_camera(1.0), 8), Rgb::grey(0.8), 1e-6);
}

#[test]
fn ambient_light_is_scattered_everywhere() {
    let mut lit = scene(vec![(wall(0.0, 5.0), Material::matt("red", RED))], vec![]);
    lit.ambient = Rgb::grey(0.25);
    assert_eq!(middle(lit, &flat_camera(1.0), 8), RED * 0.25);
}

#[test]
fn a_highlight_is_phongs() {
    let shiny = Material {
        specular: Rgb::grey(0.5),
        shininess: 10.0,
        ..Material::matt("shiny", Rgb::BLACK)
    };
    for degrees in [0.0_f32, 10.0, 40.0] {
        let angle = Angle::from_degrees(degrees);
        let light = directional(angle.sin(), 0.0, -angle.cos());
        let lit = scene(vec![(wall(0.0, 5.0), shiny.clone())], vec![light]);
        let expected = Rgb::grey(0.5 * angle.cos().powi(10));
        assert_close(middle(lit, &flat_camera(1.0), 8), expected, 1e-5);
    }
}

#[test]
fn what_glows_is_shaded_as_well() {
    let emission = Rgb::new(3.0, 2.0, 1.0);
    let glowing = Material {
        diffuse: Rgb::WHITE.into(),
        reflection: Rgb::WHITE,
        ..Material::luminous("glowing", emission)
    };
    let mut lit = scene(
        vec![(wall(0.0, 5.0), glowing)],
        vec![directional(0.0, 0.0, -1.0)],
    );
    lit.ambient = Rgb::WHITE;
    let of_others = Rgb::grey(2.0);
    assert_eq!(middle(lit, &flat_camera(1.0), 0), emission + of_others);
}

#[test]
fn a_lamp_shows_its_own_light_alone() {
    let emission = Rgb::new(3.0, 2.0, 1.0);
    let lamp = Material::luminous("lamp", emission);
    let mut lit = scene(
        vec![(wall(0.0, 5.0), lamp)],
        vec![directional(0.0, 0.0, -1.0)],
    );
    lit.ambient = Rgb::WHITE;
    assert_eq!(middle(lit, &flat_camera(1.0), 0), emission);
}

#[test]
fn nothing_looks_like_the_background() {
    let mut empty = scene(vec![], vec![directional(0.0, 0.0, -1.0)]);
    empty.background = RED.into();
    assert_eq!(middle(empty, &flat_camera(1.0), 8), RED);
}

#[test]
fn a_point_light_falls_off_and_a_spot_has_an_edge() {
    let wall_lit_by = |light: Light| {
        let world = build(scene(vec![(wall(0.0, 5.0), white())], vec![light]));
        picture(&world, &flat_camera(4.0), &settings()).film
    };
    let position = point(0.0, 0.0, 2.0);
    let falloff = Falloff::InverseSquare;
    let intensity = Rgb::WHITE;
    let film = wall_lit_by(Light::Point {
        position,
        intensity,
        falloff,
    });
    let at = |x: u32| film.average(x, WIDTH / 2).unwrap();
    assert_close(at(16), Rgb::grey(0.25), 1e-5);
    let aside = 8.0 * 4.0 / 33.0_f32;
    let squared = 4.0 + aside * aside;
    assert_close(at(24), Rgb::grey(2.0 / squared.powf(1.5)), 1e-5);

    let film = wall_lit_by(Light::Spot {
        position,
        direction: -Vector3::Z,
        inner: Angle::from_degrees(20.0),
        outer: Angle::from_degrees(30.0),
        intensity,
        falloff: Falloff::None,
    });
    let row: Vec<f32> = (16..WIDTH)
        .map(|x| film.average(x, 16).unwrap().r)
        .collect();
    assert_eq!(row[0], 1.0);
    let edge = 2.0 * Angle::from_degrees(30.0).tan() / 4.0 * 33.0;
    for (i, &brightness) in row.iter().enumerate() {
        assert_eq!(brightness > 0.0, (i as f32) < edge, "{i}: {row:?}");
    }
    assert!(row.windows(2).all(|pair| pair[1] <= pair[0]));
}

#[test]
fn lights_that_make_no_sense_do_no_harm() {
    let lights = vec![
        directional(0.0, 0.0, 0.0),
        directional(f32::NAN, 0.0, 1.0),
        Light::Point {
            position: point(0.0, 0.0, 0.0),
            intensity: Rgb::grey(f32::INFINITY),
            falloff: Falloff::InverseSquare,
        },
        directional(0.0, 0.0, -1.0),
    ];
    let lit = scene(vec![(wall(0.0, 5.0), white())], lights);
    assert_eq!(middle(lit, &flat_camera(1.0), 8), Rgb::WHITE);
}
