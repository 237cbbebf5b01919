//! How far things are from a point: the nearest one, whether there is one, all of them.
//!
//! The answers come from a function that measures one primitive (`measured`), and a structure only
//! decides which primitives it need not be asked about. What it leaves out cannot matter, rounding
//! included (`boxes`), so all answers are those of asking about every primitive, to the bit.
//!
//! Structures other than `bvh8` are made for rays: below them every primitive is measured.

mod boxes;
mod measured;
mod nearby;
mod placed;

use std::fmt;

use ombra_geometry::{GeometryId, InstanceId, Point3, PrimitiveId};

use crate::Accel;

pub(crate) use boxes::Boxes;
pub(crate) use measured::Placed;
pub use measured::{Measured, Place};
pub use nearby::Nearby;

/// The nearest point of a primitive to a point.
///
/// # The rule for ties
/// Of those equally far away the first one is that with the smallest (instance, geometry, primitive),
/// as with a [`Hit`](ombra_geometry::Hit).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClosestPoint {
    /// Where, in the space of the query.
    pub point: Point3<f64>,
    /// How far that is from where was asked.
    pub distance: f64,
    /// What a hit there would have as its [`u`](ombra_geometry::Hit::u).
    pub u: f32,
    /// What a hit there would have as its [`v`](ombra_geometry::Hit::v).
    pub v: f32,
    /// Which primitive of the geometry.
    pub primitive: PrimitiveId,
    /// Which geometry.
    pub geometry: GeometryId,
    /// Which placement of the geometry.
    pub instance: InstanceId,
}

/// Why no distances can be had.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum NoDistance {
    /// A curved shape is stretched along some axes more than along others. Then the nearest point in
    /// its own space is not the nearest one in the world, and there is no formula for that one.
    Stretched {
        /// Which placement stretches it.
        instance: InstanceId,
        /// Which shape of the geometry.
        primitive: PrimitiveId,
    },
    /// What is placed is itself made of placements.
    Nested,
}

impl NoDistance {
    /// The same, of an instance.
    pub(crate) const fn at(self, index: u32) -> Self {
        match self {
            Self::Stretched { primitive, .. } => Self::Stretched {
                instance: InstanceId(index),
                primitive,
            },
            Self::Nested => self,
        }
    }
}

impl fmt::Display for NoDistance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Stretched {
                instance,
                primitive,
            } => write!(
                f,
                "instance {instance} stretches shape {primitive}, which is curved, along some axes more \
                 than along others; distances need an even scale, or triangles in its place"
            ),
            Self::Nested => f.write_str(
                "an instance places what is itself made of instances; distances have two levels",
            ),
        }
    }
}

impl std::error::Error for NoDistance {}

/// Primitives that distances can be asked of.
#[derive(Debug)]
pub struct Distances<'a, P> {
    accel: &'a Accel<P>,
    mask: u32,
}

impl<P> Clone for Distances<'_, P> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<P> Copy for Distances<'_, P> {}

impl<P: Measured> Accel<P> {
    /// What answers questions about distances. A mesh and a list of shapes always have it; instances
    /// unless one stretches a curved shape unevenly, since an answer that passed over that one would
    /// be wrong.
    ///
    /// # Errors
    /// Names the first primitive from which no distance can be measured.
    pub fn distances(&self) -> Result<Distances<'_, P>, NoDistance> {
        self.distances_seen(u32::MAX)
    }

    /// The same of what a mask sees.
    pub(crate) fn distances_seen(&self, mask: u32) -> Result<Distances<'_, P>, NoDistance> {
        self.primitives().check(None)?;
        Ok(Distances { accel: self, mask })
    }
}

impl<P: Measured> Distances<'_, P> {
    /// The nearest point of all that is not further away than `max_distance`, which may be infinite.
    ///
    /// A closed shape or mesh is its surface: a point inside it is as far away as the way out. From a
    /// point that is not finite, and within a distance that is NaN or negative, there is nothing.
    #[must_use]
    pub fn closest_point(&self, point: Point3<f64>, max_distance: f64) -> Option<ClosestPoint> {
        self.ask(point, Nearby::closest(self.mask, max_distance))
            .into_closest()
    }

    /// Whether anything is not further away than `distance`.
    #[must_use]
    pub fn within_distance(&self, point: Point3<f64>, distance: f64) -> bool {
        self.ask(point, Nearby::any(self.mask, distance)).is_found()
    }

    /// The nearest point of each primitive that is not further away than `distance`, near to far, in
    /// place of what `found` held.
    pub fn all_within(&self, point: Point3<f64>, distance: f64, found: &mut Vec<ClosestPoint>) {
        let list = std::mem::take(found);
        *found = self
            .ask(point, Nearby::all(self.mask, distance, list))
            .into_all();
    }

    fn ask(&self, point: Point3<f64>, mut nearby: Nearby) -> Nearby {
        // NaN is no distance either.
        if point.is_finite() && nearby.limit() >= 0.0 {
            // Broken off or not, what was found is in it.
            let _ = self.accel.measure(&Place::of_world(point), &mut nearby);
        }
        nearby
    }
}
