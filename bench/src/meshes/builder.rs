//! Meshes piece by piece.

use ombra_geometry::{MeshError, Point3, TriangleMesh, Vector3};

/// What is there so far.
#[derive(Clone, Debug, Default)]
pub(super) struct Builder {
    positions: Vec<Point3>,
    triangles: Vec<[u32; 3]>,
}

impl Builder {
    /// A vertex; gives its number.
    fn vertex(&mut self, position: Point3) -> u32 {
        self.positions.push(position);
        (self.positions.len() - 1) as u32
    }

    /// Two triangles.
    pub(super) fn quad(&mut self, corners: [Point3; 4]) {
        let [a, b, c, d] = corners.map(|corner| self.vertex(corner));
        self.triangles.extend([[a, b, c], [a, c, d]]);
    }

    /// The rectangle between two opposite corners, in the plane in which they agree in a
    /// coordinate.
    pub(super) fn wall(&mut self, from: Point3, to: Point3) {
        let upright = Vector3::new(0.0, to.y - from.y, 0.0);
        let along = if from.y == to.y {
            // A floor: the second side runs along z.
            let along = Vector3::new(to.x - from.x, 0.0, 0.0);
            let across = Vector3::new(0.0, 0.0, to.z - from.z);
            return self.quad([from, from + across, from + across + along, from + along]);
        } else {
            Vector3::new(to.x - from.x, 0.0, to.z - from.z)
        };
        self.quad([from, from + along, from + along + upright, from + upright]);
    }

    /// Eight corners, twelve triangles. Corner `4 z + 2 y + x` has these as upper where a bit is set.
    pub(super) fn hexahedron(&mut self, corner: impl Fn(bool, bool, bool) -> Point3) {
        let v: Vec<u32> = (0..8)
            .map(|i| self.vertex(corner(i & 1 != 0, i & 2 != 0, i & 4 != 0)))
            .collect();
        for [a, b, c, d] in [
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 2, 3, 1],
            [1, 3, 7, 5],
            [5, 7, 6, 4],
            [4, 6, 2, 0],
        ] {
            self.triangles.push([v[a], v[b], v[c]]);
            self.triangles.push([v[a], v[c], v[d]]);
        }
    }

    /// A box along the axes.
    pub(super) fn cuboid(&mut self, low: Point3, high: Point3) {
        self.hexahedron(|x, y, z| {
            let pick = |upper, low, high| if upper { high } else { low };
            Point3::new(
                pick(x, low.x, high.x),
                pick(y, low.y, high.y),
                pick(z, low.z, high.z),
            )
        });
    }

    /// A curved sheet: `2 · across · down` triangles over `place(u, v)`, both in `[0, 1]`.
    pub(super) fn sheet(&mut self, across: u32, down: u32, place: impl Fn(f32, f32) -> Point3) {
        let first = self.positions.len() as u32;
        for j in 0..=down {
            for i in 0..=across {
                self.vertex(place(i as f32 / across as f32, j as f32 / down as f32));
            }
        }
        let row = across + 1;
        for j in 0..down {
            for i in 0..across {
                let a = first + j * row + i;
                self.triangles.push([a, a + row, a + row + 1]);
                self.triangles.push([a, a + row + 1, a + 1]);
            }
        }
    }

    /// A body turned about the upright axis through `foot`: `profile(v)` is radius and height, `v`
    /// from 0 at the foot to 1.
    pub(super) fn turned(
        &mut self,
        around: u32,
        up: u32,
        foot: Point3,
        profile: impl Fn(f32, f32) -> [f32; 2],
    ) {
        self.sheet(around, up, |u, v| {
            let [radius, height] = profile(u, v);
            // The seam closes exactly.
            let [x, z] = circle(if u == 1.0 { 0.0 } else { u });
            foot + Vector3::new(x * radius, height, z * radius)
        });
    }

    /// All of it, without the triangles whose area is zero: they can never be hit, and only make
    /// builds differ.
    pub(super) fn finish(self) -> Result<TriangleMesh, MeshError> {
        without_area(self.positions, self.triangles)
    }
}

/// A mesh of the triangles that have an area.
pub(super) fn without_area(
    positions: Vec<Point3>,
    mut triangles: Vec<[u32; 3]>,
) -> Result<TriangleMesh, MeshError> {
    triangles.retain(|corners| {
        let [a, b, c] = corners.map(|i| positions.get(i as usize).map(|p| p.wide()));
        // An index out of range is for the mesh to tell of.
        let (Some(a), Some(b), Some(c)) = (a, b, c) else {
            return true;
        };
        (b - a).cross(c - a).length_squared() > 0.0
    });
    TriangleMesh::new(positions, triangles)
}

/// The place on the unit circle after a share of a turn, nearly: in each quarter the rational
/// parametrisation, since library sines differ between machines.
pub(super) fn circle(turn: f32) -> [f32; 2] {
    let quarters = turn.rem_euclid(1.0) * 4.0;
    let t = quarters.fract();
    let square = 1.0 + t * t;
    let (c, s) = ((1.0 - t * t) / square, 2.0 * t / square);
    match quarters as u32 {
        0 => [c, s],
        1 => [-s, c],
        2 => [-c, -s],
        _ => [s, -c],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_circle_is_round_and_goes_all_the_way() {
        for i in 0..16 {
            let [x, y] = circle(i as f32 / 16.0);
            assert!((x * x + y * y - 1.0).abs() < 1e-6);
        }
        assert_eq!(circle(0.25), [-0.0, 1.0]);
        assert_eq!(circle(0.5), [-1.0, -0.0]);
    }

    #[test]
    fn a_cuboid_is_closed_and_faces_outward() {
        let mut builder = Builder::default();
        builder.cuboid(Point3::ORIGIN, Point3::new(1.0, 2.0, 3.0));
        let mesh = builder.finish().unwrap();
        assert_eq!(mesh.triangles().len(), 12);
        // Of a closed surface that faces outward this is six times the volume.
        let volume: f32 = (0..12)
            .map(|i| {
                let [a, b, c] = mesh.corners(i).map(|p| p - Point3::ORIGIN);
                a.dot(b.cross(c))
            })
            .sum();
        assert_eq!(volume, 36.0);
    }

    #[test]
    fn what_has_no_area_is_left_out() {
        let p = |x| Point3::new(x, 0.0, 0.0);
        let mesh = without_area(vec![p(0.0), p(1.0), p(2.0)], vec![[0, 1, 2], [0, 0, 1]]);
        assert!(mesh.unwrap().triangles().is_empty());
    }
}
