//! A ray made ready for the kernels, in single precision.
//!
//! # Why no box is missed
//! A hit counts if its point lies in its primitive's box padded by the `hit_pad` of
//! [`traversal_ray`](crate::TraversalRay). A kernel must not miss such a box. With F the distance
//! from the origin o to the farthest corner of the structure, ε the precision of singles and m the
//! largest component of the direction d:
//!
//! 1. `hit_pad` is 12 ε F at most. The t of a hit is rounded: half of ε F.
//! 2. A component of d below 2⁻³⁰ m is taken as ± 2⁻³⁰ m. Along the part of the ray that lies in the
//!    structure that moves it by less than 2⁻²⁹ F.
//! 3. Where a ray meets a plane p is computed as p i + k, with i = 1/d rounded and k = − (o ± pad) i
//!    rounded. Rounding i moves the plane by half of ε F (both terms alike), rounding o ± pad by
//!    half of ε (|o| + pad), rounding k by as much, and rounding the sum by half of ε F; if a level
//!    has no fused multiply-add, rounding the product by half of ε |p| besides. Since |p| is at most
//!    |o| + F, that is below 3 ε (|o| + F) in all. (A plane of the compact layout may lie beyond the
//!    farthest corner, by less than 1/127 of its node: it has moved outward by far more than what
//!    rounding adds for that.)
//!
//! So a pad of 16 ε F + 4 ε (|o| + F) is enough. It is computed rounded up: `PAD` and `PAD_AT`.

use ombra_geometry::Ray;
use ombra_geometry::triangle::{TriangleKernel as _, Watertight};

use super::box_ray::BoxRay;
use crate::{Reach, TraversalRay};

/// The pad for each unit of the distance to the farthest corner.
pub(super) const PAD: f32 = 21.0 * f32::EPSILON;
/// The pad for each unit of the largest coordinate of the origin.
pub(super) const PAD_AT: f32 = 5.0 * f32::EPSILON;
/// A component of the direction counts as at least this part of the largest one.
pub(super) const LEAST: f32 = 1.0 / (1 << 30) as f32;

/// A structure as the making of rays sees it: what [`Reach`] says, in single precision and safely
/// on the side of "no".
#[derive(Clone, Copy, Debug)]
pub(crate) struct Near {
    pub(super) centre: [f32; 4],
    /// No corner is further from the centre than this.
    pub(super) half: f32,
    /// A ray from up to here is near; negative if none is.
    pub(super) limit: f32,
}

/// Coordinates beyond this are left to double precision: squares of what is computed with them may
/// leave the number range.
const LARGEST: f64 = 1e15;

impl Near {
    pub(crate) fn new(reach: &Reach) -> Self {
        let (bounds, extent) = (reach.bounds(), reach.extent());
        let usable = reach.is_single() && reach.coordinate() <= LARGEST;
        let centre = bounds.centre();
        let rounding = 2.0 * f64::from(f32::EPSILON) * reach.coordinate();
        Self {
            centre: [centre.x as f32, centre.y as f32, centre.z as f32, 0.0],
            half: (0.5001 * extent + rounding) as f32,
            // What is far is decided in double precision: 16 extents from the centre.
            limit: if usable {
                (15.9 * extent - 8.0 * rounding) as f32
            } else {
                -1.0
            },
        }
    }
}

/// A ray made ready.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SingleRay {
    pub(crate) boxes: BoxRay,
    pub(crate) t_max: f32,
    /// Which axes take the places of x, y and z where the ray is the z axis.
    pub(crate) axes: [u32; 3],
    /// The origin, by those axes.
    pub(crate) origin: [f32; 3],
    pub(crate) watertight: Watertight<f32>,
}

/// A ray in double precision that is to be traced in single; `None` if it is not. Its range is rounded
/// inward, so that it holds the same singles.
#[inline]
pub(crate) fn rounded(ray: &TraversalRay) -> Option<Ray> {
    if !ray.single() {
        return None;
    }
    let Ray {
        origin,
        direction,
        t_min,
        t_max,
    } = ray.ray;
    let mut from = t_min as f32;
    if f64::from(from) < t_min {
        from = from.next_up();
    }
    Some(Ray {
        origin: origin.cast(),
        direction: direction.cast(),
        t_min: from,
        t_max: not_above(t_max),
    })
}

/// The largest single that is not above a number.
#[inline]
pub(crate) fn not_above(x: f64) -> f32 {
    let single = x as f32;
    if f64::from(single) > x {
        single.next_down()
    } else {
        single
    }
}

impl SingleRay {
    /// The same for a ray in double precision that is to be traced in single.
    #[inline]
    pub(crate) fn rounded(ray: &TraversalRay, near: &Near) -> Option<Self> {
        Self::new(&rounded(ray)?, near)
    }

    /// `None` if the ray is not valid, or is to be traced in double precision.
    #[inline(always)]
    pub(crate) fn new(ray: &Ray, near: &Near) -> Option<Self> {
        let (origin, direction) = (ray.origin.to_array(), ray.direction.to_array());
        let ([ox, oy, oz], [dx, dy, dz]) = (origin, direction);
        // What has a NaN or an infinity makes the sum a NaN, or fails to be near.
        let sum = (ox + oy + oz) * 0.0 + (dx.abs() + dy.abs() + dz.abs());
        if !((sum <= 3e10) & (ray.t_min <= ray.t_max)) {
            return None;
        }
        let boxes = BoxRay::new(origin, direction, ray.t_min, near)?;
        let watertight = Watertight::new(ray);
        let [x, y, z] = watertight.axes();
        let by_axis = [ox, oy, oz, 0.0];
        Some(Self {
            boxes,
            t_max: ray.t_max,
            axes: [x as u32, y as u32, z as u32],
            origin: [
                by_axis[x as usize & 3],
                by_axis[y as usize & 3],
                by_axis[z as usize & 3],
            ],
            watertight,
        })
    }
}
