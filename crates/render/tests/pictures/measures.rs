//! Pictures of what is no light: normals, distances, costs, openness.

use ombra_render::{IntegratorKind, Settings};
use ombra_scene::Rgb;

use crate::stage::*;

fn with(integrator: IntegratorKind, spp: u32) -> Settings {
    Settings {
        integrator,
        spp,
        ..settings()
    }
}

#[test]
fn normals_are_colours() {
    let world = build(scene(vec![(ball(0.0, 0.0, 0.0, 1.0), white())], vec![]));
    let rendering = picture(&world, &flat_camera(2.2), &with(IntegratorKind::Normals, 1));
    let at = |x, y| rendering.film.average(x, y).unwrap();
    assert_close(at(16, 16), Rgb::new(0.5, 0.5, 1.0), 1e-4);
    assert_eq!(at(0, 0), Rgb::BLACK, "nothing");
    let right = at(30, 16);
    assert!(right.r > 0.9 && right.b > 0.5 && right.b < 0.8, "{right:?}");
    let shown = rendering.display()[16 * 33 + 16].to_srgb();
    assert!((shown[0] - 0.5).abs() < 1e-3);
}

#[test]
fn normals_point_out_of_a_ball_even_from_within() {
    let world = build(scene(vec![(ball(0.0, 0.0, 10.0, 1.0), white())], vec![]));
    let rendering = picture(&world, &flat_camera(0.5), &with(IntegratorKind::Normals, 1));
    let seen = rendering.film.average(16, 16).unwrap();
    assert_close(seen, Rgb::new(0.5, 0.5, 0.0), 1e-4);
}

#[test]
fn depth_is_the_distance_and_looks_lighter_the_nearer() {
    let things = vec![(wall(0.0, 0.5), white()), (wall(-5.0, 2.0), white())];
    let world = build(scene(things, vec![]));
    let rendering = picture(&world, &flat_camera(6.0), &with(IntegratorKind::Depth, 4));
    let index = |x: usize| 16 * 33 + x;
    let (raw, shown) = (rendering.raw(), rendering.display());
    assert_eq!(raw[index(16)], Rgb::grey(10.0));
    assert_eq!(raw[index(8)], Rgb::grey(15.0));
    assert_eq!(raw[index(0)], Rgb::grey(f32::INFINITY));
    assert_eq!(shown[index(16)], Rgb::WHITE);
    assert!(shown[index(8)].r < 0.1 && shown[index(8)].r > 0.0);
    assert_eq!(shown[index(0)], Rgb::BLACK);
}

#[test]
fn a_distance_at_an_edge_is_that_of_what_is_hit() {
    let world = build(scene(vec![(wall(0.0, 0.5), white())], vec![]));
    let rendering = picture(&world, &flat_camera(6.0), &with(IntegratorKind::Depth, 16));
    for distance in rendering.raw() {
        assert!(
            distance.r == 10.0 || distance.r == f32::INFINITY,
            "{distance:?}"
        );
    }
}

#[test]
fn cost_counts_tests_and_nodes() {
    let world = build(scene(vec![(wall(0.0, 0.5), white())], vec![]));
    let rendering = picture(&world, &flat_camera(6.0), &with(IntegratorKind::Cost, 2));
    let (raw, shown) = (rendering.raw(), rendering.display());
    assert!(
        raw[16 * 33 + 16].g >= 2.0,
        "an instance and a triangle at least"
    );
    for steps in &raw {
        assert_eq!(steps.b, steps.r + steps.g);
    }
    assert_ne!(shown[16 * 33 + 16], shown[0]);
    assert_eq!(rendering.rays, 33 * 33 * 2);
}

#[test]
fn a_closed_room_is_dark_and_a_plane_open() {
    // A small room in a large scene, so that its walls are nearby.
    let far = ball(1000.0, 0.0, 0.0, 1.0);
    let room = ball(0.0, 0.0, 10.0, 1.0);
    let world = build(scene(vec![(room, white()), (far, white())], vec![]));
    let occluded = picture(
        &world,
        &flat_camera(0.5),
        &with(IntegratorKind::AmbientOcclusion, 8),
    );
    assert!(occluded.raw().iter().all(|&pixel| pixel == Rgb::BLACK));

    let world = build(scene(vec![(wall(0.0, 9.0), white())], vec![]));
    let open = picture(
        &world,
        &flat_camera(1.0),
        &with(IntegratorKind::AmbientOcclusion, 8),
    );
    assert!(open.raw().iter().all(|&pixel| pixel == Rgb::WHITE));
}

#[test]
fn a_corner_is_half_open() {
    // Where two walls meet at a right angle, half of the cosine-weighted hemisphere is covered.
    let things = vec![(wall(0.0, 2.0), white()), (floor(-0.02, 3.0), white())];
    let world = build(scene(things, vec![]));
    let settings = Settings {
        spp: 256,
        ..with(IntegratorKind::AmbientOcclusion, 1)
    };
    let film = picture(&world, &flat_camera(0.05), &settings).film;
    let openness = film.average(16, 16).unwrap().r;
    assert!((openness - 0.5).abs() < 0.06, "{openness}");
}
