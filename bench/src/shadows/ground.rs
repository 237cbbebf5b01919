//! How high the ground is.

use ombra_city::City;
use ombra_geometry::Point3;

/// Metres above the terrain, so that it does not shade itself.
const ABOVE: f32 = 0.05;

/// The ground within a square window.
#[derive(Debug)]
pub(super) struct Ground {
    flat: Option<f32>,
    triangles: Vec<[Point3; 3]>,
}

/// That of a city, from the lowest corner of a window on.
pub(super) fn ground(city: &City, low: [f32; 2], side: f32) -> Ground {
    let touches = |triangle: &[Point3; 3]| {
        let most = |of: fn(f32, f32) -> f32, axis: fn(&Point3) -> f32| {
            triangle.iter().map(axis).reduce(of).unwrap_or(f32::NAN)
        };
        most(f32::max, |p| p.x) >= low[0]
            && most(f32::min, |p| p.x) <= low[0] + side
            && most(f32::max, |p| p.y) >= low[1]
            && most(f32::min, |p| p.y) <= low[1] + side
    };
    Ground {
        flat: city.terrain.is_empty().then_some(city.ground),
        triangles: city.terrain.iter().copied().filter(touches).collect(),
    }
}

impl Ground {
    /// The z there; nothing where the terrain has a hole.
    pub(super) fn at(&self, place: [f32; 2]) -> Option<f32> {
        self.flat.or_else(|| {
            let all = self.triangles.iter().filter_map(|t| height(t, place));
            all.reduce(f32::max).map(|z| z + ABOVE)
        })
    }
}

/// The z of a triangle above a place, if it lies there.
fn height([a, b, c]: &[Point3; 3], [x, y]: [f32; 2]) -> Option<f32> {
    let cross = |p: &Point3, q: &Point3| (p.x - x) * (q.y - y) - (p.y - y) * (q.x - x);
    let [u, v, w] = [cross(b, c), cross(c, a), cross(a, b)];
    let sum = u + v + w;
    let is_in = [u, v, w].iter().all(|&e| e * sum >= 0.0) && sum != 0.0;
    is_in.then(|| (u * a.z + v * b.z + w * c.z) / sum)
}
