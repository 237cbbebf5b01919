//! One ray a pixel: the camera.
//!
//! A pixel at (x, y) of the screen, both from 0 to 1, is a point of the plane z = −1 before the
//! eye: ((2 x − 1) · aspect · tan(fov/2), (1 − 2 y) · tan(fov/2), −1). The ray starts at the eye
//! and goes through it. That is all; the picture is what the rays find.

use ombra_accel::{Accel, Shapes, StructureKind, Traversable};
use ombra_examples::ascii;
use ombra_geometry::shape::{Sphere, Surface};
use ombra_geometry::{Angle, Point3, Ray, Vector3};

const WIDTH: usize = 64;
const HEIGHT: usize = 32;

/// The ray through the middle of a pixel.
fn camera_ray(x: usize, y: usize) -> Ray {
    let half = (Angle::from_degrees(40.0) * 0.5).tan();
    // A character is about twice as high as it is wide, so this picture is a square.
    let aspect = 1.0;
    let screen_x = (x as f32 + 0.5) / WIDTH as f32;
    let screen_y = (y as f32 + 0.5) / HEIGHT as f32;
    let direction = Vector3::new(
        (2.0 * screen_x - 1.0) * aspect * half,
        (1.0 - 2.0 * screen_y) * half,
        -1.0,
    );
    Ray::new(Point3::ORIGIN, direction)
}

fn picture() -> Vec<f32> {
    let spheres = [
        Sphere::new(Point3::new(0.0, 0.0, -5.0), 1.2),
        Sphere::new(Point3::new(1.0, 0.9, -4.0), 0.4),
    ];
    let world = Accel::build(
        Shapes(spheres.map(Into::into).to_vec()),
        StructureKind::default(),
    );
    let to_light = Vector3::new(-0.6, 0.6, 0.5);
    let shade = |i: usize| {
        let ray = camera_ray(i % WIDTH, i / WIDTH);
        let Some(hit) = world.intersect(&ray) else {
            return 0.0;
        };
        // The more a surface faces the light, the brighter it is (Lambert).
        let point = ray.at(hit.t).wide();
        let normal = spheres[hit.primitive.index()].surface_at(point).normal;
        0.15 + 0.85 * normal.cast::<f32>().dot(to_light).max(0.0)
    };
    (0..WIDTH * HEIGHT).map(shade).collect()
}

fn main() {
    print!("{}", ascii(WIDTH, &picture()));
}

#[test]
fn the_balls_are_where_they_should_be() {
    let picture = picture();
    let at = |x: usize, y: usize| picture[y * WIDTH + x];
    assert_eq!(at(0, 0), 0.0, "nothing in the corner");
    assert!(at(WIDTH / 2, HEIGHT / 2) > 0.15, "a ball in the middle");
    // Light comes from the upper left.
    assert!(at(24, 12) > at(40, 20));
}
