//! A primitive of your own: the intersection program.
//!
//! The engine knows triangles and some shapes. Anything else takes two functions: the box around
//! it, and where a ray crosses it. Here it is a field of distances: at every point, how far it is
//! to the surface at least. One may always go that far along the ray without passing through, and
//! then ask again: sphere tracing (Hart, "Sphere Tracing", The Visual Computer 12(10), 1996).

use std::ops::ControlFlow;

use ombra_accel::{Accel, StructureKind, Traversable};
use ombra_examples::ascii;
use ombra_geometry::{Aabb, Crossing, Point3, Ray, Vector3};
use ombra_pipeline::{Custom, Intersection};

const WIDTH: usize = 64;
const HEIGHT: usize = 32;

/// A ring around the z axis: a point's distance to a circle of radius 1, less 0.4.
struct Ring {
    centre: Point3,
}

impl Ring {
    fn distance(&self, point: Point3<f64>) -> f64 {
        let p = point - self.centre.wide();
        (p.x.hypot(p.y) - 1.0).hypot(p.z) - 0.4
    }
}

struct Rings(Vec<Ring>);

impl Intersection for Rings {
    fn count(&self) -> usize {
        self.0.len()
    }

    fn bounds(&self, primitive: u32) -> Aabb {
        let reach = Vector3::new(1.41, 1.41, 0.41);
        let centre = self.0[primitive as usize].centre;
        Aabb::around([centre - reach, centre + reach])
    }

    fn intersect(
        &self,
        ray: &Ray<f64>,
        primitive: u32,
        mut report: impl FnMut(Crossing) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let ring = &self.0[primitive as usize];
        let mut t = ray.t_min;
        for _ in 0..200 {
            let distance = ring.distance(ray.at(t));
            if distance < 1e-6 {
                // u and v are ours to use; here u says how far out on the ring the point is.
                let p = ray.at(t) - ring.centre.wide();
                let u = p.x.hypot(p.y) as f32 - 0.6;
                return report(Crossing { t, u, v: 0.0 });
            }
            t += distance / ray.direction.length();
            // The ray's end is the nearest hit so far: beyond it, there is nothing to find.
            if t > ray.t_max {
                break;
            }
        }
        ControlFlow::Continue(())
    }
}

fn world() -> Accel<Custom<Rings>> {
    let ring = |x, z| Ring {
        centre: Point3::new(x, 0.0, z),
    };
    let rings = Rings(vec![ring(-0.7, -5.0), ring(0.7, -6.0)]);
    Accel::build(Custom(rings), StructureKind::default())
}

/// From the origin through a pixel.
fn camera_ray(x: usize, y: usize) -> Ray {
    let right = (x as f32 + 0.5) / WIDTH as f32 - 0.5;
    let up = 0.5 - (y as f32 + 0.5) / HEIGHT as f32;
    Ray::new(Point3::ORIGIN, Vector3::new(right, 0.7 * up, -1.0))
}

fn main() {
    let world = world();
    let shade = |i: usize| {
        let hit = world.intersect(&camera_ray(i % WIDTH, i / WIDTH));
        hit.map_or(0.0, |hit| 0.2 + 0.9 * hit.u)
    };
    let shades: Vec<_> = (0..WIDTH * HEIGHT).map(shade).collect();
    print!("{}", ascii(WIDTH, &shades));
}

#[test]
fn rings_have_holes_and_hide_one_another() {
    let world = world();
    let through = |x, y, z| world.intersect(&Ray::between(Point3::ORIGIN, Point3::new(x, y, z)));
    // Through the hole of the first, where the second does not reach.
    assert_eq!(through(-1.0, 0.0, -7.0), None);
    let first = through(-2.0, 0.0, -6.0).unwrap();
    assert_eq!(first.primitive.0, 0);
    let second = through(2.0, 0.0, -7.0).unwrap();
    assert_eq!(second.primitive.0, 1);
    // Along the axis from beside the ring its surface is 0.4 before the plane of the circle.
    let ahead = Ray::new(Point3::new(-1.7, 0.0, 0.0), -Vector3::Z);
    assert!((world.intersect(&ahead).unwrap().t - 4.6).abs() < 1e-4);
    assert!(world.occluded(&ahead));
}
