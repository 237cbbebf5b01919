//! A hall with columns, arches, balconies and drapery around an open court: few large triangles and
//! many small ones side by side, as architects' models have them.

use ombra_geometry::{MeshError, Point3, TriangleMesh, Vector3};

use super::builder::{Builder, circle};

/// Spans between columns along the hall.
const SPANS: u32 = 10;
/// From column to column.
const SPAN: f32 = 3.0;
/// Length, height and width of the hall.
const HALL: [f32; 3] = [SPAN * SPANS as f32, 12.0, 18.0];
/// Where the two rows of columns stand across the hall, and the way from each to its aisle.
const ROWS: [(f32, f32); 2] = [(5.0, -1.0), (13.0, 1.0)];
/// How high the roofs of the aisles reach over the court.
const RIDGE: f32 = 13.5;
/// The floor of the balconies.
const BALCONY: f32 = 5.0;

/// With about 66 thousand triangles at a fineness of 8, about a sixteenth of it at 2.
pub(super) fn mesh(fineness: u32) -> Result<TriangleMesh, MeshError> {
    let mut hall = Hall {
        builder: Builder::default(),
        fineness: fineness.max(1),
    };
    hall.walls();
    for row in ROWS {
        for column in 0..=SPANS {
            let foot = Point3::new(SPAN * column as f32, 0.0, row.0);
            hall.column(foot, 0.42, 2.9, 3);
            hall.column(foot + Vector3::Y * BALCONY, 0.26, 3.2, 2);
        }
        for span in 0..SPANS {
            let from = Point3::new(SPAN * span as f32, 0.0, row.0);
            hall.arch(from + Vector3::Y * 2.9, 0.42, BALCONY - 0.25);
            hall.arch(from + Vector3::Y * (BALCONY + 3.2), 0.26, HALL[1]);
            hall.balustrade(from);
            hall.rafter(from, row);
        }
        for curtain in 0..3 {
            let from = SPAN * (1.5 + 2.5 * curtain as f32);
            hall.curtain(Point3::new(from, 8.6, row.0 - row.1 * 0.9));
        }
    }
    for span in 0..SPANS {
        hall.garlands(SPAN * span as f32);
        hall.sail(SPAN * span as f32, span % 2 == 0);
    }
    for x in [0.2, 0.8] {
        hall.vase(Point3::new(x * HALL[0], 0.0, 9.0));
    }
    hall.builder.finish()
}

struct Hall {
    builder: Builder,
    fineness: u32,
}

impl Hall {
    /// What is flat: a few triangles as large as the hall.
    fn walls(&mut self) {
        let [length, height, width] = HALL;
        let at = Point3::new;
        let b = &mut self.builder;
        b.wall(at(0.0, 0.0, 0.0), at(length, 0.0, width));
        b.wall(at(length, 0.0, 0.0), at(0.0, height, 0.0));
        b.wall(at(0.0, 0.0, width), at(length, height, width));
        b.wall(at(0.0, 0.0, 0.0), at(0.0, height, width));
        b.wall(at(length, 0.0, width), at(length, height, 0.0));
        for (row, aisle) in ROWS {
            let outside = if aisle < 0.0 { 0.0 } else { width };
            let inside = row - aisle * 0.5;
            let (low, high) = (f32::min(outside, inside), f32::max(outside, inside));
            b.cuboid(at(0.0, BALCONY - 0.25, low), at(length, BALCONY, high));
            // The aisles have a pitched roof, the court has none.
            b.quad([
                at(0.0, height, outside),
                at(length, height, outside),
                at(length, RIDGE, inside),
                at(0.0, RIDGE, inside),
            ]);
        }
    }

    /// A fluted shaft with a turned foot and head, on and under a square slab.
    fn column(&mut self, foot: Point3, radius: f32, height: f32, fine: u32) {
        let around = fine * self.fineness;
        let up = (fine * self.fineness / 4).max(1);
        let flute = |u: f32| 1.0 - 0.05 * ridge(u * 12.0);
        let b = &mut self.builder;
        b.turned(around, up, foot, |u, v| {
            [
                radius * 0.8 * flute(u) * (1.0 - 0.12 * v),
                height * (0.1 + 0.8 * v),
            ]
        });
        // Rings, wider toward the slab.
        let ring = |v: f32| radius * (0.82 + 0.2 * v + 0.06 * ridge(v * 3.0));
        b.turned(around, up, foot, |_, v| [ring(1.0 - v), height * 0.1 * v]);
        b.turned(around, up, foot, |_, v| {
            [ring(v) * 0.95, height * (0.9 + 0.1 * v)]
        });
        for y in [0.0, height] {
            let middle = foot + Vector3::Y * y;
            let half = Vector3::new(1.15 * radius, 0.04, 1.15 * radius);
            b.cuboid(middle - half, middle + half);
        }
    }

    /// A round arch over one span, moulded below, and the wall above it up to `top`.
    fn arch(&mut self, from: Point3, half_depth: f32, top: f32) {
        let along = 2 * self.fineness;
        let across = (self.fineness / 2).max(1);
        let radius = SPAN / 2.0;
        let rise = (top - from.y).min(radius) * 0.8;
        let place = |u: f32, out: f32, z: f32| {
            let [x, y] = circle(0.5 * (1.0 - u));
            from + Vector3::new(radius + x * radius * out, y * rise * out, z)
        };
        let b = &mut self.builder;
        b.sheet(along, across, |u, v| {
            let z = half_depth * 0.8 * (2.0 * v - 1.0);
            place(u, 0.9 + 0.05 * ridge(v * 3.0), z)
        });
        for side in [-1.0, 1.0] {
            let z = half_depth * 0.8 * side;
            b.sheet(along, 1, |u, v| {
                let edge = place(u, 0.9, z);
                Point3::new(edge.x, edge.y + (top - edge.y) * v, edge.z)
            });
        }
    }

    /// Turned balusters between rails, on the edge of the balcony over one span.
    fn balustrade(&mut self, from: Point3) {
        let fine = self.fineness;
        let b = &mut self.builder;
        let foot = from + Vector3::Y * BALCONY;
        for i in 1..7_u8 {
            let foot = foot + Vector3::new(SPAN * f32::from(i) / 7.0, 0.08, 0.0);
            b.turned(fine, (fine * 3 / 4).max(1), foot, |_, v| {
                let belly = v * (1.0 - v) * (1.3 - v);
                [0.02 + 0.22 * belly + 0.008 * ridge(v * 4.0), 0.8 * v]
            });
        }
        for y in [0.0, 0.88] {
            let low = foot + Vector3::new(0.0, y, -0.09);
            b.cuboid(low, low + Vector3::new(SPAN, 0.08, 0.18));
        }
    }

    /// Cloth in folds, hanging from its upper left corner.
    fn curtain(&mut self, corner: Point3) {
        let (across, down) = (5 * self.fineness, 3 * self.fineness);
        self.builder.sheet(across, down, |u, v| {
            let fold = 0.25 * (0.3 + 0.7 * v) * (2.0 * ridge(u * 6.0 + 0.4 * v) - 1.0);
            let sag = 0.3 * (2.0 * u - 1.0) * (2.0 * u - 1.0);
            corner + Vector3::new(2.2 * u, -4.5 * v - sag * v, fold)
        });
    }

    /// Beams under the roof of an aisle, slanting across it and along it.
    fn rafter(&mut self, from: Point3, (row, aisle): (f32, f32)) {
        let outside = if aisle < 0.0 { 0.0 } else { HALL[2] };
        for along in [0.0, SPAN] {
            let low = Point3::new(from.x + along, HALL[1] - 0.2, outside);
            let high = Point3::new(from.x + SPAN - along, RIDGE - 0.2, row);
            self.bar(low, high, 0.08);
        }
    }

    /// Cords across the court, from a column's head to that of the one after next opposite.
    fn garlands(&mut self, x: f32) {
        let far = (x + 2.0 * SPAN).min(HALL[0]);
        let [(near_row, _), (far_row, _)] = ROWS;
        let place = |x, y, z| Point3::new(x, y, z);
        for (from, to) in [(x, far), (far, x)] {
            let (from, to) = (place(from, 8.0, near_row), place(to, 8.0, far_row));
            let sag = |share: f32| Vector3::Y * (2.5 * share * (1.0 - share));
            let at = |i: u32| {
                let share = i as f32 / self.fineness as f32;
                from + (to - from) * share - sag(share)
            };
            let knots: Vec<_> = (0..=self.fineness).map(at).collect();
            for ends in knots.windows(2) {
                self.bar(ends[0], ends[1], 0.03);
            }
        }
    }

    /// Cloth of two triangles over a span of the court, high on one side and low on the other.
    fn sail(&mut self, x: f32, turned: bool) {
        let [(near, _), (far, _)] = ROWS;
        let (high, low) = if turned { (near, far) } else { (far, near) };
        let next = x + 1.4 * SPAN;
        self.builder.quad([
            Point3::new(x, HALL[1] - 0.5, high),
            Point3::new(x + 0.4 * SPAN, 7.0, low),
            Point3::new(next, 6.6, low),
            Point3::new(next - 0.4 * SPAN, HALL[1] - 0.5, high),
        ]);
    }

    /// A square bar from place to place: long thin triangles askew to all axes.
    fn bar(&mut self, from: Point3, to: Point3, half: f32) {
        let Some(along) = (to - from).normalized() else {
            return;
        };
        let (s, t) = along.orthonormal_basis();
        self.builder.hexahedron(|x, y, z| {
            let side = |upper| if upper { half } else { -half };
            let end = if z { to } else { from };
            end + s * side(x) + t * side(y)
        });
    }

    fn vase(&mut self, foot: Point3) {
        let fine = self.fineness;
        self.builder.turned(4 * fine, 3 * fine, foot, |u, v| {
            let body = 0.35 + 1.6 * v * (1.0 - v) * (1.2 - v);
            [body * (1.0 + 0.03 * ridge(u * 16.0)), 1.5 * v]
        });
    }
}

/// From 0 up to 1 and back, round, once a unit.
fn ridge(x: f32) -> f32 {
    let x = x.rem_euclid(1.0);
    4.0 * x * (1.0 - x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hall_has_as_many_triangles_as_it_says_and_of_very_different_sizes() {
        let hall = mesh(8).unwrap();
        let count = hall.triangles().len();
        assert!((60_000..72_000).contains(&count), "{count}");
        let area = |i| {
            let [a, b, c] = hall.corners(i);
            (b - a).cross(c - a).length() / 2.0
        };
        let mut areas: Vec<f32> = (0..count).map(area).collect();
        areas.sort_by(f32::total_cmp);
        assert!(areas[count - 1] > 1e4 * areas[count / 2]);
    }

    #[test]
    fn a_coarse_hall_is_small() {
        let count = mesh(2).unwrap().triangles().len();
        assert!((1_000..10_000).contains(&count), "{count}");
    }
}
