//! One ray, one sphere: a quadratic equation.
//!
//! A point p is on the sphere if (p − c) · (p − c) = R². Put the ray p = e + t d in:
//! (d · d) t² + 2 d · (e − c) t + (e − c) · (e − c) − R² = 0. The sign of the discriminant
//! B² − 4 A C says whether the ray passes, touches, or crosses twice.

use ombra_geometry::shape::{Sphere, Surface};
use ombra_geometry::{Point3, Ray, Vector3};

/// Where the ray meets the sphere, near to far.
fn by_hand(ray: &Ray, sphere: &Sphere) -> Vec<f32> {
    let from_centre = ray.origin - sphere.centre;
    let a = ray.direction.dot(ray.direction);
    let b = 2.0 * ray.direction.dot(from_centre);
    let c = from_centre.dot(from_centre) - sphere.radius * sphere.radius;
    let discriminant = b * b - 4.0 * a * c;
    if discriminant < 0.0 {
        return vec![];
    }
    let root = discriminant.sqrt();
    let mut crossings = vec![(-b - root) / (2.0 * a), (-b + root) / (2.0 * a)];
    crossings.dedup();
    // What lies behind the origin does not count.
    crossings.retain(|&t| t >= 0.0);
    crossings
}

/// The same question to the engine. It works in double precision and orders its steps so that
/// nothing cancels, which shows for spheres that are small and far away.
fn by_engine(ray: &Ray, sphere: &Sphere) -> Vec<f32> {
    let crossings = sphere.crossings(&(*ray).into());
    crossings.iter().map(|crossing| crossing.t as f32).collect()
}

fn sphere() -> Sphere {
    Sphere::new(Point3::new(0.0, 0.0, -5.0), 1.0)
}

/// What each ray is, and the ray.
fn rays() -> [(&'static str, Ray); 4] {
    let ahead = |x, z| Ray::new(Point3::new(x, 0.0, z), -Vector3::Z);
    [
        ("through the middle", ahead(0.0, 0.0)),
        ("touching", ahead(1.0, 0.0)),
        ("passing", ahead(1.5, 0.0)),
        ("from inside", ahead(0.0, -5.0)),
    ]
}

fn main() {
    for (name, ray) in rays() {
        let (hand, engine) = (by_hand(&ray, &sphere()), by_engine(&ray, &sphere()));
        println!("{name:<20} by hand {hand:?}, by the engine {engine:?}");
    }
}

#[test]
fn hand_and_engine_agree() {
    let expected: [&[f32]; 4] = [&[4.0, 6.0], &[5.0], &[], &[1.0]];
    for ((_, ray), expected) in rays().iter().zip(expected) {
        assert_eq!(by_hand(ray, &sphere()), expected);
        assert_eq!(by_engine(ray, &sphere()), expected);
    }
}
