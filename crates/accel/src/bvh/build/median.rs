//! Halves the list at the median centre along the widest axis: the tree that is taught first, and
//! the shallowest one.

use super::{Builder, centre_bounds};
use crate::Bounded;
use crate::partition::halve;

/// Cuts at the object median.
#[derive(Clone, Copy, Debug)]
pub enum Median {}

impl Builder for Median {
    type Item = Bounded;

    fn items(primitives: &[Bounded]) -> Vec<Bounded> {
        primitives.to_vec()
    }

    fn bounded(item: &Bounded) -> &Bounded {
        item
    }

    fn split(items: &mut [Bounded]) -> Option<usize> {
        let axis = centre_bounds(&*items).extent().dominant_axis();
        Some(halve(items, axis))
    }
}
