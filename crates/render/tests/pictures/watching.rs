//! How renderings are watched and stopped, and what is refused.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use ombra_geometry::Angle;
use ombra_pipeline::Cpu;
use ombra_render::{Film, IntegratorKind, Progress, RenderError, Settings, Watch, render};
use ombra_scene::World;
use ombra_scene::camera::{Aperture, Projection, ThinLens};

use crate::stage::*;

fn world() -> World {
    build(scene(
        vec![(ball(0.0, 0.0, 0.0, 1.0), white())],
        vec![directional(0.0, 0.0, -1.0)],
    ))
}

fn cpu() -> Cpu {
    Cpu::with_threads(2).unwrap()
}

#[test]
fn passes_grow_and_progress_ends_at_the_total() {
    let settings = Settings {
        spp: 100,
        width: 20,
        height: 20,
        ..Settings::default()
    };
    let most = AtomicU64::new(0);
    let rays = AtomicU64::new(0);
    let progress = |progress: Progress| {
        assert_eq!(progress.total, 20 * 20 * 100);
        most.fetch_max(progress.done, Ordering::Relaxed);
        rays.fetch_max(progress.rays, Ordering::Relaxed);
    };
    let mut samples = Vec::new();
    let mut pass = |film: &Film| samples.push(film.samples(3, 3));
    let watch = Watch {
        stop: None,
        progress: Some(&progress),
        pass: Some(&mut pass),
    };
    let rendering = render(&world(), &flat_camera(3.0), &settings, &cpu(), watch).unwrap();
    assert_eq!(samples, [1, 2, 4, 8, 16, 32, 48, 64, 80, 96, 100]);
    assert_eq!(most.into_inner(), 20 * 20 * 100);
    assert_eq!(rays.into_inner(), rendering.rays);
    assert_eq!(rendering.film.done(), 1.0);
    assert!(!rendering.stopped);
}

#[test]
fn a_stop_keeps_what_is_done() {
    let settings = Settings {
        spp: 64,
        width: 64,
        height: 64,
        ..Settings::default()
    };
    let whole = render(
        &world(),
        &flat_camera(3.0),
        &settings,
        &cpu(),
        Watch::default(),
    )
    .unwrap();
    let stop = AtomicBool::new(false);
    // In the middle of the fifth pass.
    let progress = |progress: Progress| {
        if progress.done > 64 * 64 * 10 {
            stop.store(true, Ordering::Relaxed);
        }
    };
    let watch = Watch {
        stop: Some(&stop),
        progress: Some(&progress),
        pass: None,
    };
    let part = render(&world(), &flat_camera(3.0), &settings, &cpu(), watch).unwrap();
    assert!(part.stopped && part.rays < whole.rays);
    let done = part.film.done();
    assert!((0.125..0.25).contains(&done), "{done}");
    for y in 0..64 {
        for x in 0..64 {
            assert!([8, 16].contains(&part.film.samples(x, y)));
            assert!(part.film.average(x, y).is_some());
        }
    }
}

#[test]
fn a_stop_before_the_start_leaves_a_blank_film() {
    let stop = AtomicBool::new(true);
    let watch = Watch {
        stop: Some(&stop),
        ..Watch::default()
    };
    for &integrator in IntegratorKind::ALL {
        let settings = Settings {
            integrator,
            ..settings()
        };
        let watch = Watch {
            stop: watch.stop,
            ..Watch::default()
        };
        let rendering = render(&world(), &flat_camera(3.0), &settings, &cpu(), watch).unwrap();
        assert!(rendering.stopped);
        assert_eq!((rendering.rays, rendering.film.done()), (0, 0.0));
        assert_eq!(rendering.film.average(1, 1), None);
        assert_eq!(rendering.display().len(), 33 * 33);
    }
}

#[test]
fn settings_that_make_no_picture_are_refused_in_words() {
    let refused = |settings: &Settings| {
        let watch = Watch::default();
        render(&world(), &flat_camera(3.0), settings, &cpu(), watch).unwrap_err()
    };
    let error = refused(&Settings {
        width: 0,
        ..settings()
    });
    assert!(matches!(error, RenderError::EmptyPicture { width: 0, .. }));
    let error = refused(&Settings {
        spp: 0,
        ..settings()
    });
    assert_eq!(
        error.to_string(),
        "0 samples a pixel: there must be 1 to 16777216"
    );
}

#[test]
fn a_camera_without_rays_is_an_error_that_names_the_first_pixel() {
    let mut camera = flat_camera(3.0);
    camera.projection = Projection::ThinLens(ThinLens {
        fov: Angle::from_degrees(f32::NAN),
        lens_radius: 0.1,
        focus_distance: 1.0,
        aperture: Aperture::Disk,
        shift: [0.0; 2],
    });
    let error = render(&world(), &camera, &settings(), &cpu(), Watch::default()).unwrap_err();
    let RenderError::Launch(error) = error else {
        panic!("{error:?}")
    };
    assert!(
        error
            .to_string()
            .starts_with("at launch index (0, 0, 0): invalid radiance ray")
    );
}
