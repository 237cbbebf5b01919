//! Lines turned about an axis: spheres, disks, cylinders, cones, rings.
//!
//! A curved line becomes a chain of chords, and the circle in which it is turned a polygon. Both are
//! inside of what they stand for, by a sagitta each, and the two together are off by no more than
//! their sum: a point of the mesh is moved outward, away from the axis, by the one, and then to the
//! line by the other.

use std::f64::consts::{PI, TAU};

use super::{Soup, parts_of_circle};
use crate::Vector3;
use crate::shape::frame::Frame;
use crate::shape::revolved::Revolved;
use crate::shape::{Disk, Ends, Sphere, Torus};

/// The fewest parts of a circle, so that small things still look round.
const LEAST_AROUND: u64 = 8;

/// A point of a line, in the half plane of (distance from the axis, height along it).
#[derive(Clone, Copy, Debug)]
struct Turning {
    radius: f64,
    height: f64,
    /// Of unit length: outward from the axis, and along it.
    normal: [f64; 2],
    v: f64,
}

/// A straight or round line. The surface is on the right of somebody who walks along it with the axis
/// on the left: going up makes an outside, going outward a lower side.
enum Line {
    /// From one point to another.
    Straight([Turning; 2]),
    /// An arc about a point of the half plane: radius and height of that point, radius of the arc,
    /// from an angle through another one, in so many parts. v runs from 0 to 1.
    Arc {
        centre: [f64; 2],
        radius: f64,
        from: f64,
        through: f64,
        parts: u64,
    },
}

impl Line {
    fn parts(&self) -> u64 {
        match self {
            Self::Straight(_) => 1,
            Self::Arc { parts, .. } => *parts,
        }
    }

    fn at(&self, i: u64) -> Turning {
        match self {
            Self::Straight(ends) => ends[i as usize],
            Self::Arc {
                centre,
                radius,
                from,
                through,
                parts,
            } => {
                // A full circle ends where it began, to the last bit.
                let full = *through == TAU;
                let turned = if full { i % parts } else { i };
                let (sin, cos) = (from + through * turned as f64 / *parts as f64).sin_cos();
                // The ends of a half circle about the axis are on the axis, but for rounding.
                let pole = !full && (i == 0 || i == *parts);
                Turning {
                    radius: if pole { 0.0 } else { centre[0] + radius * cos },
                    height: centre[1] + radius * sin,
                    normal: if pole { [0.0, sin] } else { [cos, sin] },
                    v: i as f64 / *parts as f64,
                }
            }
        }
    }
}

/// What a shape is cut into.
pub(super) struct Turned {
    frame: Frame,
    lines: Vec<Line>,
    around: u64,
}

impl Turned {
    pub(super) fn triangles(&self) -> u64 {
        let strips = self.lines.iter().map(|line| {
            let ends = [line.at(0), line.at(line.parts())];
            let pointed = ends.iter().filter(|end| end.radius == 0.0).count() as u64;
            (2 * line.parts() - pointed).saturating_mul(self.around)
        });
        strips.fold(0, u64::saturating_add)
    }

    pub(super) fn add_to(&self, soup: &mut Soup) {
        for line in &self.lines {
            let mut last = self.ring(soup, line.at(0));
            for i in 1..=line.parts() {
                let next = self.ring(soup, line.at(i));
                self.strip(soup, last, next);
                last = next;
            }
        }
    }

    /// The vertices of one point of a line: one more than parts, since u is 0 and 1 at the same
    /// place; on the axis one a part, each in the middle of its part.
    fn ring(&self, soup: &mut Soup, point: Turning) -> Ring {
        let first = soup.positions.len() as u32;
        let on_axis = point.radius == 0.0;
        let (count, shift) = if on_axis {
            (self.around, 0.5)
        } else {
            (self.around + 1, 0.0)
        };
        for i in 0..count {
            let part = |i: u64| (i as f64 + shift) / self.around as f64;
            let (sin, cos) = (TAU * part(i % self.around)).sin_cos();
            let place = Vector3::new(point.radius * cos, point.radius * sin, point.height);
            let [out, up] = point.normal;
            let normal = Vector3::new(out * cos, out * sin, up);
            let uv = [part(i) as f32, point.v as f32];
            soup.vertex(self.frame.world(place), self.frame.world_normal(normal), uv);
        }
        Ring { first, on_axis }
    }

    fn strip(&self, soup: &mut Soup, from: Ring, to: Ring) {
        for i in 0..self.around as u32 {
            let [a, b] = [from.first + i, from.first + i + 1];
            let [d, c] = [to.first + i, to.first + i + 1];
            match (from.on_axis, to.on_axis) {
                (false, false) => soup.triangles.extend([[a, b, c], [a, c, d]]),
                (true, false) => soup.triangles.push([a, c, d]),
                (false, true) => soup.triangles.push([a, b, d]),
                (true, true) => {}
            }
        }
    }
}

/// The vertices that one point of a line has become.
#[derive(Clone, Copy)]
struct Ring {
    first: u32,
    on_axis: bool,
}

pub(super) fn of_sphere(sphere: &Sphere, tolerance: f64) -> Turned {
    let radius = f64::from(sphere.radius);
    let around = parts_of_circle(radius, tolerance / 2.0, LEAST_AROUND);
    let arc = Line::Arc {
        centre: [0.0, 0.0],
        radius,
        from: -PI / 2.0,
        through: PI,
        parts: around.div_ceil(2),
    };
    Turned {
        frame: Frame::along(sphere.centre.wide(), Vector3::new(0.0, 0.0, 1.0)),
        lines: vec![arc],
        around,
    }
}

pub(super) fn of_torus(torus: &Torus, tolerance: f64) -> Turned {
    let sagitta = tolerance / 2.0;
    let arc = Line::Arc {
        centre: [torus.major, 0.0],
        radius: torus.minor,
        from: 0.0,
        through: TAU,
        parts: parts_of_circle(torus.minor, sagitta, LEAST_AROUND),
    };
    Turned {
        frame: torus.frame,
        lines: vec![arc],
        around: parts_of_circle(torus.major + torus.minor, sagitta, LEAST_AROUND),
    }
}

pub(super) fn of_disk(disk: &Disk, tolerance: f64) -> Turned {
    Turned {
        frame: disk.frame,
        lines: vec![upper_cap(disk.radius, 0.0)],
        around: parts_of_circle(disk.radius, tolerance, LEAST_AROUND),
    }
}

pub(super) fn of_revolved(revolved: &Revolved, tolerance: f64) -> Turned {
    let [base, top] = revolved.radii;
    let height = revolved.height;
    let length = height.hypot(top - base);
    let side = |radius, height, v| Turning {
        radius,
        height,
        normal: [revolved.height / length, (base - top) / length],
        v,
    };
    let mut lines = vec![Line::Straight([
        side(base, 0.0, 0.0),
        side(top, height, 1.0),
    ])];
    if revolved.ends == Ends::Capped {
        if base > 0.0 {
            let at = |radius, v| Turning {
                radius,
                height: 0.0,
                normal: [0.0, -1.0],
                v,
            };
            lines.push(Line::Straight([at(0.0, 0.0), at(base, 1.0)]));
        }
        if top > 0.0 {
            lines.push(upper_cap(top, height));
        }
    }
    Turned {
        frame: revolved.frame,
        lines,
        around: parts_of_circle(base.max(top), tolerance, LEAST_AROUND),
    }
}

/// From the rim inward, which faces up.
fn upper_cap(radius: f64, height: f64) -> Line {
    let at = |radius, v| Turning {
        radius,
        height,
        normal: [0.0, 1.0],
        v,
    };
    Line::Straight([at(radius, 1.0), at(0.0, 0.0)])
}
