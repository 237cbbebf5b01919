//! Where a line crosses a surface, before anybody asks which crossing counts.

use arrayvec::ArrayVec;

/// The most crossings that one shape can have with a line: the torus, a quartic.
pub const MAX_CROSSINGS: usize = 4;

/// The crossings of a ray with one shape, near to far.
pub type Crossings = ArrayVec<Crossing, MAX_CROSSINGS>;

/// One crossing of a ray with the surface of one shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Where on the ray, in the precision that the shape worked in. A `Hit` rounds it, once.
    pub t: f64,
    /// See [`Hit::u`](crate::Hit::u).
    pub u: f32,
    /// See [`Hit::v`](crate::Hit::v).
    pub v: f32,
}

/// Who owns an edge that two triangles share.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum EdgeRule {
    /// Both: a triangle includes its edges, so that nothing escapes between two of them. For the
    /// closest hit and for occlusion.
    #[default]
    Closed,
    /// Exactly one of the two, by the rule that rasterizers use for pixels on an edge, so that a
    /// ray through an edge crosses the surface once. For counting crossings.
    HalfOpen,
}
