//! What a query answers: numbers and ids.

use crate::{GeometryId, InstanceId, PrimitiveId};

/// One crossing of a ray with a primitive, as numbers and ids.
///
/// It becomes a place with a normal and a material once, in a closest-hit program; it does not
/// carry them.
///
/// # The rule for ties
/// Of crossings with the same `t`, the nearest is the one with the smallest
/// (instance, geometry, primitive). Every structure keeps to this rule, so all give the same hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Where on the ray, in units of its direction's length.
    pub t: f32,
    /// On a triangle the barycentric weight of its second vertex; on a shape its surface parameter
    /// u, in `[0, 1]`.
    pub u: f32,
    /// On a triangle the barycentric weight of its third vertex; on a shape its surface parameter
    /// v, in `[0, 1]`.
    pub v: f32,
    /// Which primitive of the geometry.
    pub primitive: PrimitiveId,
    /// Which geometry.
    pub geometry: GeometryId,
    /// Which placement of the geometry.
    pub instance: InstanceId,
}
