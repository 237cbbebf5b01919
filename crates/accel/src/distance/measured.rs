//! What a distance can be measured from.

use std::ops::ControlFlow;

use ombra_geometry::triangle::nearest;
use ombra_geometry::{
    GeometryId, InstanceId, Object, Point3, PrimitiveId, Transform, TriangleMesh, Vector3, World,
};

use super::{Nearby, NoDistance, placed};
use crate::{Geometry, Mesh, Primitives, Shapes};

/// From where distances are measured, and how what they are measured from stands there.
#[derive(Clone, Copy, Debug)]
pub struct Place<'a> {
    pub(crate) point: Point3<f64>,
    pub(crate) placed: Option<Placed<'a>>,
    pub(crate) geometry: GeometryId,
    pub(crate) instance: InstanceId,
}

/// A placement that moves something.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Placed<'a> {
    pub(crate) world_from_object: &'a Transform<Object, World>,
    pub(crate) object_from_world: &'a Transform<World, Object>,
    /// Whether it turns and scales and does nothing else.
    pub(crate) is_even: bool,
}

impl<'a> Placed<'a> {
    pub(crate) fn new(
        world_from_object: &'a Transform<Object, World>,
        object_from_world: &'a Transform<World, Object>,
    ) -> Self {
        Self {
            world_from_object,
            object_from_world,
            is_even: placed::is_even(world_from_object),
        }
    }
}

impl Place<'_> {
    pub(super) const fn of_world(point: Point3<f64>) -> Self {
        Self {
            point,
            placed: None,
            geometry: GeometryId(0),
            instance: InstanceId(0),
        }
    }

    /// The point, in the space of the query.
    #[must_use]
    pub const fn point(&self) -> Point3<f64> {
        self.point
    }

    /// How the primitives are placed in the space of the query; `None` if they are as they are.
    #[must_use]
    pub fn world_from_object(&self) -> Option<&Transform<Object, World>> {
        self.placed.as_ref().map(|placed| placed.world_from_object)
    }
}

/// Primitives from which a distance can be measured.
///
/// What is reported must lie in the primitive's box, to the bit where it is not placed.
pub trait Measured: Primitives {
    /// Whether a distance can be measured from every primitive, placed by this.
    ///
    /// # Errors
    /// The first one from which none can.
    fn check(&self, placed: Option<&Transform<Object, World>>) -> Result<(), NoDistance>;

    /// Reports the nearest point of a primitive, if there is one.
    ///
    /// # Errors
    /// `Break` if a report was answered with it.
    fn measure(&self, primitive: u32, place: &Place<'_>, nearby: &mut Nearby) -> ControlFlow<()>;
}

impl Measured for Mesh {
    fn check(&self, _placed: Option<&Transform<Object, World>>) -> Result<(), NoDistance> {
        Ok(())
    }

    #[inline]
    fn measure(&self, primitive: u32, place: &Place<'_>, nearby: &mut Nearby) -> ControlFlow<()> {
        of_triangle(self.mesh(), primitive, place, nearby)
    }
}

/// The distance from the origin to the box around three points; not more than that to what lies
/// between them, as it is rounded (see `boxes`).
#[inline]
fn box_distance([a, b, c]: [Vector3<f64>; 3]) -> f64 {
    let off = |a: f64, b: f64, c: f64| {
        let (least, most) = (a.min(b).min(c), a.max(b).max(c));
        least.max(-most).max(0.0)
    };
    Vector3::new(off(a.x, b.x, c.x), off(a.y, b.y, c.y), off(a.z, b.z, c.z)).length()
}

/// A triangle is measured where it stands, so that any placement will do.
#[inline]
fn of_triangle(
    mesh: &TriangleMesh,
    primitive: u32,
    place: &Place<'_>,
    nearby: &mut Nearby,
) -> ControlFlow<()> {
    let corners = mesh.corners(primitive as usize).map(Point3::wide);
    let corners = match &place.placed {
        None => corners,
        Some(placed) => corners.map(|corner| placed.world_from_object.point(corner)),
    };
    // Most triangles of a leaf are ruled out by their box, which takes no division.
    let around = box_distance(corners.map(|corner| corner - place.point));
    if around <= nearby.limit() && corners.iter().all(|corner| corner.is_finite()) {
        nearby.report(place, primitive, &nearest(place.point, corners))?;
    }
    ControlFlow::Continue(())
}

impl Measured for Shapes {
    fn check(&self, placement: Option<&Transform<Object, World>>) -> Result<(), NoDistance> {
        let is_even = placement.is_none_or(placed::is_even);
        let stretched = |shape| !placed::is_measurable(shape, is_even);
        match self.0.iter().position(stretched) {
            None => Ok(()),
            Some(shape) => Err(NoDistance::Stretched {
                instance: InstanceId(0),
                primitive: PrimitiveId(shape as u32),
            }),
        }
    }

    fn measure(&self, primitive: u32, place: &Place<'_>, nearby: &mut Nearby) -> ControlFlow<()> {
        match placed::of_shape(&self.0[primitive as usize], place) {
            None => ControlFlow::Continue(()),
            Some(nearest) => nearby.report(place, primitive, &nearest),
        }
    }
}

impl Measured for Geometry {
    fn check(&self, placed: Option<&Transform<Object, World>>) -> Result<(), NoDistance> {
        match self {
            Self::Mesh(mesh) => mesh.check(placed),
            Self::Shapes(shapes) => shapes.check(placed),
        }
    }

    #[inline]
    fn measure(&self, primitive: u32, place: &Place<'_>, nearby: &mut Nearby) -> ControlFlow<()> {
        match self {
            Self::Mesh(mesh) => mesh.measure(primitive, place, nearby),
            Self::Shapes(shapes) => shapes.measure(primitive, place, nearby),
        }
    }
}
