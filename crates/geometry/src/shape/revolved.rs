//! A straight line turned about an axis: what the cylinder and the cone share.

use std::f64::consts::PI;

use super::error::{ShapeError, direction, finite};
use super::frame::{Frame, LocalRay, disk_reach, nearest_of, report, unit};
use super::interval::Interval;
use super::turn::turn;
use super::{Ends, Surface, SurfacePoint, SurfaceSample};
use crate::triangle::share;
use crate::{Aabb, Crossings, Point3, Ray, Vector3, sampling};

/// What `Interval` calls the side and the two caps.
const SIDE: usize = 0;
const BASE: usize = 1;
const TOP: usize = 2;

/// The radius goes from `radii[0]` in the plane z = 0 of the frame to `radii[1]` at z = `height`.
/// Neither is negative and one is above 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Revolved {
    pub(super) frame: Frame,
    pub(super) height: f64,
    pub(super) radii: [f64; 2],
    pub(super) ends: Ends,
}

impl Revolved {
    pub(super) fn new(
        [(base_name, base), (top_name, top)]: [(&'static str, Point3); 2],
        radii: [f64; 2],
        ends: Ends,
    ) -> Result<Self, ShapeError> {
        finite(base_name, base.is_finite())?;
        finite(top_name, top.is_finite())?;
        let axis = top.wide() - base.wide();
        Ok(Self {
            frame: Frame::along(base.wide(), direction("axis", axis)?),
            height: axis.length(),
            radii,
            ends,
        })
    }

    /// How fast the radius grows along the axis.
    fn slope(&self) -> f64 {
        (self.radii[1] - self.radii[0]) / self.height
    }

    /// How much of a line is inside the solid, `o` and `d` being relative to the middle of the axis.
    ///
    /// The side is where |o + s d|² in the plane across the axis is the square of the radius there,
    /// R + s D: a quadratic A s² + 2 B s + C. Its discriminant is written without cancellation, by
    /// Lagrange's identity (a² b² − (a·b)² = (a × b)²), and as with the sphere one root comes from
    /// the other. Where A < 0 the line is steeper than the cone and the inside is beyond the roots,
    /// one part in each of the two cones that meet in the apex.
    fn clip(&self, o: Vector3<f64>, d: Vector3<f64>) -> Interval {
        let slope = self.slope();
        let radius = (self.radii[0] + self.radii[1]) / 2.0 + slope * o.z;
        let growth = slope * d.z;
        let a = d.x * d.x + d.y * d.y - growth * growth;
        let b = o.x * d.x + o.y * d.y - radius * growth;
        let c = o.x * o.x + o.y * o.y - radius * radius;
        let cross = o.x * d.y - o.y * d.x;
        let mixed = [radius * d.x - growth * o.x, radius * d.y - growth * o.y];
        let discriminant = mixed[0] * mixed[0] + mixed[1] * mixed[1] - cross * cross;

        let mut inside = Interval::LINE;
        if discriminant < 0.0 && a > 0.0 {
            inside.clear();
            return inside;
        }
        let q = -(b + discriminant.max(0.0).sqrt().copysign(b));
        let (s0, s1) = if q == 0.0 { (0.0, 0.0) } else { (q / a, c / q) };
        if a > 0.0 {
            inside.begin(s0.min(s1), SIDE);
            inside.end(s0.max(s1), SIDE);
        } else if a < 0.0 {
            if growth > 0.0 {
                inside.begin(s0.max(s1), SIDE);
            } else {
                inside.end(s0.min(s1), SIDE);
            }
        } else if b > 0.0 {
            inside.end(s1, SIDE);
        } else if b < 0.0 {
            inside.begin(s1, SIDE);
        } else if c > 0.0 {
            inside.clear();
        }
        // After the side, so that at a rim the side wins: an open one includes its rims.
        let half = self.height / 2.0;
        inside.cut(o.z + half, -d.z, BASE);
        inside.cut(half - o.z, d.z, TOP);
        inside
    }

    /// u runs around the axis. v runs on the side from the base (0) to the top (1), on a cap from
    /// its centre (0) to the rim (1).
    fn uv(&self, face: usize, local: Vector3<f64>) -> [f32; 2] {
        let v = match face {
            SIDE => local.z / self.height,
            cap => local.x.hypot(local.y) / self.radii[cap - BASE],
        };
        [turn(local.x, local.y), unit(v)]
    }

    fn nearest_face(&self, local: Vector3<f64>) -> usize {
        if self.ends == Ends::Open {
            return SIDE;
        }
        let slope = self.slope();
        let out = local.x.hypot(local.y);
        let side = (out - self.radii[0] - slope * local.z).abs() / slope.hypot(1.0);
        let (base, top) = (local.z.abs(), (local.z - self.height).abs());
        if side <= base.min(top) {
            SIDE
        } else if base <= top {
            BASE
        } else {
            TOP
        }
    }

    fn normal(&self, face: usize, local: Vector3<f64>) -> Vector3<f64> {
        match face {
            BASE => Vector3::new(0.0, 0.0, -1.0),
            TOP => Vector3::new(0.0, 0.0, 1.0),
            _ => {
                // At an apex there is no direction outward; the axis stands in for it.
                let out = Vector3::new(local.x, local.y, 0.0).normalized();
                let out = out.unwrap_or(Vector3::new(0.0, 0.0, 0.0));
                let normal = out - Vector3::new(0.0, 0.0, self.slope());
                normal.normalized().unwrap_or(Vector3::new(0.0, 0.0, 1.0))
            }
        }
    }

    /// The areas of the side, the base and the top.
    fn areas(&self) -> [f64; 3] {
        let [base, top] = self.radii;
        let side = PI * (base + top) * self.height.hypot(top - base);
        match self.ends {
            Ends::Open => [side, 0.0, 0.0],
            Ends::Capped => [side, PI * base * base, PI * top * top],
        }
    }

    /// A uniform point on the side: the square of the radius there is uniform.
    fn sample_side(&self, x0: f64, x1: f64) -> Vector3<f64> {
        let [base, top] = self.radii;
        let radius = (base * base + x0 * (top * top - base * base)).sqrt();
        // (radius − base) / (top − base), which is 0 / 0 for a cylinder, multiplied out.
        let along = if radius + base > 0.0 {
            x0 * (base + top) / (radius + base)
        } else {
            0.0
        };
        let (sin, cos) = (2.0 * PI * x1).sin_cos();
        Vector3::new(radius * cos, radius * sin, self.height * along)
    }
}

impl Surface for Revolved {
    fn crossings(&self, ray: &Ray<f64>) -> Crossings {
        let mut found = Crossings::new();
        let half = Vector3::new(0.0, 0.0, self.height / 2.0);
        let middle = Frame {
            origin: self.frame.world(half),
            ..self.frame
        };
        let Some(local) = LocalRay::in_frame(ray, &middle) else {
            return found;
        };
        for (s, face) in self.clip(local.origin, local.direction).ends() {
            if face == SIDE || self.ends == Ends::Capped {
                report(&mut found, ray, local.t(s), || {
                    self.uv(face, local.at(s) + half)
                });
            }
        }
        found
    }

    fn bounds(&self) -> Aabb {
        let reach = disk_reach(self.frame.z);
        let top = self.frame.origin + self.frame.z * self.height;
        let [base_radius, top_radius] = self.radii;
        let base = self.frame.origin;
        Aabb::enclosing(Aabb::around([
            base - reach * base_radius,
            base + reach * base_radius,
            top - reach * top_radius,
            top + reach * top_radius,
        ]))
    }

    /// In the plane through the axis and the point: the nearest of up to three segments.
    fn to_nearest(&self, point: Point3<f64>) -> Vector3<f64> {
        let local = self.frame.local(point);
        let out = local.x.hypot(local.y);
        // On the axis any direction is as good as any other.
        let (x, y) = if out > 0.0 {
            (local.x / out, local.y / out)
        } else {
            (1.0, 0.0)
        };
        let [base, top] = self.radii;
        let height = self.height;
        let side = ([base, 0.0], [top, height]);
        let caps = [([0.0, 0.0], [base, 0.0]), ([0.0, height], [top, height])];
        let caps = match self.ends {
            Ends::Capped => &caps[..],
            Ends::Open => &[],
        };
        let nearest = |&([r0, z0], [r1, z1]): &([f64; 2], [f64; 2])| {
            let from = Vector3::new(r0 - out, 0.0, z0 - local.z);
            let along = Vector3::new(r1 - r0, 0.0, z1 - z0);
            from + along * share(from, along)
        };
        let to = nearest_of([side].iter().chain(caps).map(nearest));
        self.frame
            .world_vector(Vector3::new(to.x * x, to.x * y, to.z))
    }

    fn surface_at(&self, point: Point3<f64>) -> SurfacePoint {
        let local = self.frame.local(point);
        let face = self.nearest_face(local);
        SurfacePoint {
            normal: self.frame.world_normal(self.normal(face, local)),
            uv: self.uv(face, local),
        }
    }

    fn area(&self) -> f64 {
        self.areas().iter().sum()
    }

    fn sample(&self, [x0, x1]: [f32; 2]) -> Option<SurfaceSample> {
        let (face, x0) = sampling::choose(f64::from(x0), self.areas().into_iter());
        let local = if face == SIDE {
            self.sample_side(x0, f64::from(x1))
        } else {
            let radius = self.radii[face - BASE] * x0.sqrt();
            let (sin, cos) = (2.0 * PI * f64::from(x1)).sin_cos();
            let height = if face == TOP { self.height } else { 0.0 };
            Vector3::new(radius * cos, radius * sin, height)
        };
        Some(SurfaceSample {
            point: self.frame.world(local),
            normal: self.frame.world_normal(self.normal(face, local)),
            pdf: 1.0 / self.area(),
        })
    }
}
