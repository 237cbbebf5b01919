//! The other question: not what a ray meets, but what is nearest to a point.
//!
//! A ball around the point that is as large as the distance touches nothing inside it. So a ray can be
//! walked ball by ball, without a formula for where it meets anything: each step is as long as the
//! distance, and where there is no distance left, there is the hit. Hart, "Sphere Tracing", The Visual
//! Computer 12, 1996. Here it is held against the engine's own hits.

use ombra_accel::{Accel, Distances, Shapes, StructureKind, Traversable};
use ombra_geometry::shape::{Cuboid, ShapeError, Sphere, Torus};
use ombra_geometry::{Normal3, Point3, Ray, Vector3};

const WIDTH: usize = 64;
const HEIGHT: usize = 24;

/// A ring, a ball and a box, all cut by the plane y = 0.
fn scene() -> Result<Accel<Shapes>, ShapeError> {
    let up = Normal3::new(0.0, 1.0, 0.0);
    let shapes = vec![
        Torus::new(Point3::new(-2.0, 0.0, 0.0), up, 1.5, 0.4)?.into(),
        Sphere::new(Point3::new(2.0, 0.5, 0.8), 1.0).into(),
        Cuboid::new(Point3::new(1.0, -1.0, -1.8), Point3::new(4.0, 1.0, -1.0))?.into(),
    ];
    Ok(Accel::build(Shapes(shapes), StructureKind::default()))
}

/// The t at which a ray meets something, found by distances alone; `direction` has length 1.
fn walk(
    distances: &Distances<'_, Shapes>,
    origin: Point3<f64>,
    direction: Vector3<f64>,
) -> Option<f64> {
    let mut t = 0.0;
    while t < 20.0 {
        let nearest = distances.closest_point(origin + direction * t, f64::INFINITY)?;
        if nearest.distance < 1e-6 {
            return Some(t);
        }
        t += nearest.distance;
    }
    None
}

/// Rays from one place in many directions.
fn rays() -> impl Iterator<Item = Ray> {
    (0..200_u8).map(|i| {
        let (across, up) = (
            f32::from(i % 20) / 10.0 - 1.0,
            f32::from(i / 20) / 10.0 - 0.5,
        );
        Ray::new(
            Point3::new(0.0, 2.0, 8.0),
            Vector3::new(across, up - 0.25, -1.3),
        )
    })
}

/// The distance in the plane y = 0, as lines of equal distance.
fn map(distances: &Distances<'_, Shapes>) -> Vec<f32> {
    let shade = |pixel: usize| {
        let x = (pixel % WIDTH) as f64 / WIDTH as f64 * 10.0 - 5.0;
        let z = (pixel / WIDTH) as f64 / HEIGHT as f64 * 7.0 - 3.5;
        let nearest = distances.closest_point(Point3::new(x, 0.0, z), f64::INFINITY);
        nearest.map_or(0.0, |nearest| {
            // Full at the surface, then a step every half unit.
            let rings = (nearest.distance * 2.0).floor();
            if nearest.distance < 0.1 {
                1.0
            } else {
                (0.6 - 0.15 * rings).max(0.0) as f32
            }
        })
    };
    (0..WIDTH * HEIGHT).map(shade).collect()
}

fn main() -> anyhow::Result<()> {
    let scene = scene()?;
    let distances = scene.distances()?;
    print!("{}", ombra_examples::ascii(WIDTH, &map(&distances)));
    let point = Point3::new(0.0, 0.0, 0.0);
    let mut near = Vec::new();
    distances.all_within(point, 3.0, &mut near);
    println!("within 3 of {point:?}:");
    for found in near {
        println!(
            "  shape {} at {:.3}, {:?}",
            found.primitive, found.distance, found.point
        );
    }
    println!(
        "anything within 0.05: {}",
        distances.within_distance(point, 0.05)
    );
    let met = rays().find_map(|ray| Some((ray, scene.intersect(&ray)?)));
    let (ray, hit) = met.ok_or_else(|| anyhow::anyhow!("no ray meets anything"))?;
    let length = ray.direction.wide().length();
    let walked = walk(&distances, ray.origin.wide(), ray.direction.wide() / length);
    let hit = f64::from(hit.t) * length;
    println!("a ray meets something after {hit:.4}; walked by distances, after {walked:.4?}");
    Ok(())
}

#[test]
fn walking_by_distances_ends_where_the_ray_hits() -> anyhow::Result<()> {
    let scene = scene()?;
    let distances = scene.distances()?;
    let mut hits = 0;
    for ray in rays() {
        let direction = ray.direction.wide();
        let length = direction.length();
        let walked = walk(&distances, ray.origin.wide(), direction / length);
        if let Some(hit) = scene.intersect(&ray) {
            let t = walked.ok_or_else(|| anyhow::anyhow!("{ray:?} went through"))?;
            // A ray that nearly runs along a surface comes as near as 10^-6 to it long before.
            assert!(t <= f64::from(hit.t) * length + 1e-4, "{ray:?}");
            assert!(t >= f64::from(hit.t) * length - 1e-2, "{ray:?}");
            hits += 1;
        }
    }
    assert!(hits > 20, "{hits}");
    Ok(())
}
