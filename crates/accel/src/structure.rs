//! What an acceleration structure is: boxes sorted in space, and a walk along a ray.

use std::ops::ControlFlow;

use ombra_geometry::Aabb;

use crate::{Reach, TraversalRay};

/// What a builder sees of a primitive: never the triangle, only its box. Centres are derived.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounded {
    /// Its box: finite and not empty.
    pub bounds: Aabb,
    /// Its index among the primitives.
    pub primitive: u32,
}

/// An acceleration structure: the law that all of them keep.
///
/// For a ray and a primitive whose padded box contains a point of the ray at some `t` within the
/// ray's range, `traverse` calls [`Visitor::leaf`] with that primitive and a span that holds `t`
/// exactly once, unless the visitor broke off before or its `t_max` is below `t`. "Padded" means by
/// [`TraversalRay::hit_pad`]; the structure adds more for its own rounding.
pub trait Structure: Send + Sync + Sized {
    /// Sorts primitives. There may be none; the boxes are finite and not empty. `reach` is that of
    /// all the boxes together.
    fn build(primitives: &[Bounded], reach: &Reach) -> Self;

    /// Shows the visitor what the ray may hit, roughly from near to far.
    fn traverse<V: Visitor>(&self, ray: &TraversalRay, visitor: &mut V) -> ControlFlow<()>;

    /// Bytes held on the heap.
    fn bytes(&self) -> usize;
}

/// What a traversal reports to.
pub trait Visitor {
    /// The traversal may leave out whatever is farther than this (strictly). It shrinks as hits are
    /// accepted.
    fn t_max(&self) -> f64;

    /// Primitives to test. Only crossings within `span` count here.
    fn leaf(&mut self, primitives: &[u32], span: Span) -> ControlFlow<()>;

    /// A node was visited: a box or a plane tested, a cell entered.
    fn node(&mut self);
}

/// A part of a ray: t in `[from, to)`.
///
/// A structure that cuts space names the part within the present cell, so that a primitive that
/// lies in several cells counts once, in the cell where the ray crosses it. The first cell's span
/// starts at −∞ and the last one's ends at ∞. A structure that cuts the list of primitives has
/// each primitive in one place and uses [`Span::ALL`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// The first t within.
    pub from: f64,
    /// The first t that is beyond.
    pub to: f64,
}

impl Span {
    /// The whole line.
    pub const ALL: Self = Self {
        from: f64::NEG_INFINITY,
        to: f64::INFINITY,
    };

    /// Whether `t` lies within.
    #[must_use]
    #[inline]
    pub fn contains(&self, t: f64) -> bool {
        self.from <= t && t < self.to
    }
}
