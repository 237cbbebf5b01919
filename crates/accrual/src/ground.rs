//! How high the ground is.

use ombra_accel::{Accel, Mesh, StructureKind, Traversable as _};
use ombra_city::City;
use ombra_geometry::{Point3, Ray, TriangleMesh, Vector3};

/// How far above terrain places lie, in metres: terrain is triangles, and a place in the very plane of one would
/// be on either side by rounding.
const ABOVE: f32 = 0.02;

/// Places are looked for so far aside, in metres, where no triangle is straight below.
const CRACK: f32 = 2e-4;

/// The ground of a city: its terrain, or flat.
#[derive(Debug)]
pub struct Ground {
    terrain: Option<Accel<Mesh>>,
    /// Where there is no terrain; `None` if there is no ground there either.
    flat: Option<f32>,
}

impl Ground {
    /// Makes ready to answer for a city.
    #[must_use]
    pub fn new(city: &City) -> Self {
        let positions: Vec<Point3> = city.terrain.iter().flatten().copied().collect();
        let triangles = (0..city.terrain.len() as u32).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]);
        let mesh = TriangleMesh::new(positions, triangles.collect());
        let mesh = mesh.expect("corners are counted as they come");
        Self {
            terrain: (!city.terrain.is_empty())
                .then(|| Accel::build(Mesh::new(mesh), StructureKind::default())),
            flat: (!city.is_terrain_all).then_some(city.ground),
        }
    }

    /// The place on the ground, local metres: the highest where terrain hangs over, the flat ground where it
    /// has a hole; `None` if there is no ground ([`City::is_terrain_all`]).
    #[must_use]
    pub fn at(&self, [x, y]: [f64; 2]) -> Option<Point3> {
        let (x, y) = (x as f32, y as f32);
        let height = self.terrain.as_ref().and_then(|terrain| {
            let top = terrain.bounds().max.z + 1.0;
            // Where the corner of one triangle lies on the side of another, rounding leaves a crack.
            let aside = CRACK.max(x.abs().max(y.abs()) * 4.0 * f32::EPSILON);
            let near = [
                [0.0, 0.0],
                [aside, aside],
                [-aside, -aside],
                [aside, -aside],
                [-aside, aside],
            ];
            near.into_iter().find_map(|[dx, dy]| {
                let down = Ray::new(Point3::new(x + dx, y + dy, top), -Vector3::Z);
                Some(top - terrain.intersect(&down)?.t + ABOVE)
            })
        });
        Some(Point3::new(x, y, height.or(self.flat)?))
    }
}
