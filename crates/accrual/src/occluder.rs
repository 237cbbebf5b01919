//! What throws shadow: convex polygons in a tree of boxes.

use std::collections::HashMap;

use ombra_accel::BoxTree;
use ombra_city::Facet;
use ombra_geometry::{Aabb, Point3};

/// A polygon as the kernel wants it.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(crate) struct Occluder {
    /// Outward, as long as it happens to be. What tells whether it is seen at all comes first, in one line of
    /// the cache.
    pub(crate) normal: [f32; 3],
    /// Whether it throws shadow on both its sides.
    pub(crate) is_two_sided: bool,
    /// See [`Facet::owner`].
    pub(crate) owner: u32,
    /// The corners, counter-clockwise seen from outside.
    pub(crate) corner: [[f32; 3]; 4],
    /// From each corner to the next one; 0 where a corner is there twice.
    pub(crate) edge: [[f32; 3]; 4],
}

/// Everything that throws shadow, found by where it is.
#[derive(Clone, Debug)]
pub struct Occluders {
    pub(crate) list: Vec<Occluder>,
    pub(crate) tree: BoxTree,
    /// The largest coordinate, in metres.
    pub(crate) reach: f32,
}

impl Occluders {
    /// Of polygons in local metres. Those with a corner that is not finite, or without an area, throw
    /// no shadow.
    #[must_use]
    pub fn new(facets: &[Facet]) -> Self {
        let list: Vec<Occluder> = facets.iter().filter_map(Occluder::new).collect();
        let boxes: Vec<Aabb> = list.iter().map(Occluder::bounds).collect();
        let reach = boxes.iter().fold(0.0, |reach: f32, own| {
            let all = [own.min.to_array(), own.max.to_array()].concat();
            all.into_iter().fold(reach, |reach, x| reach.max(x.abs()))
        });
        let tree = BoxTree::build(&boxes);
        Self { list, tree, reach }
    }

    /// Without some of them: they stay where they are and are seen from nowhere. Of polygons that are there several times so many
    /// go as are named.
    #[must_use]
    pub(crate) fn without(&self, facets: &[Facet]) -> Self {
        let bits = |corner: &[[f32; 3]; 4]| corner.map(|at| at.map(f32::to_bits));
        let mut named: HashMap<_, usize> = HashMap::new();
        for own in facets.iter().filter_map(Occluder::new) {
            *named
                .entry((bits(&own.corner), own.is_two_sided))
                .or_default() += 1;
        }
        let mut left = self.clone();
        for own in &mut left.list {
            if let Some(count) = named.get_mut(&(bits(&own.corner), own.is_two_sided))
                && *count > 0
            {
                *count -= 1;
                own.normal = [0.0; 3];
            }
        }
        left
    }

    /// How many polygons there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.list.len()
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }
}

impl Occluder {
    fn new(facet: &Facet) -> Option<Self> {
        let corner = facet.corners.map(Point3::to_array);
        let between = |a: [f32; 3], b: [f32; 3]| [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
        let edge = [0, 1, 2, 3].map(|k| between(corner[k], corner[(k + 1) % 4]));
        // Of the diagonals: right for triangles too, and best for what is not quite planar.
        let [a, b] = [between(corner[0], corner[2]), between(corner[1], corner[3])];
        let normal = [
            a[1] * b[2] - a[2] * b[1],
            a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0],
        ];
        let sum = normal.iter().map(|x| x.abs()).sum::<f32>();
        (sum > 0.0 && sum.is_finite()).then_some(Self {
            corner,
            edge,
            normal,
            is_two_sided: facet.is_two_sided,
            owner: facet.owner,
        })
    }

    fn bounds(&self) -> Aabb {
        Aabb::around(self.corner.map(Point3::from))
    }
}
