//! Whether both loops see the same, pixel by pixel.

use crate::Crop;
use crate::raster::Seen;

/// How many places where the two disagree are kept.
const PLACES: usize = 16;

/// A jump in depth, as a part of the depth, from which on two neighbouring pixels that see the same
/// shape are taken to see parts of it one behind the other.
const JUMP: f64 = 0.02;

/// How far two pictures agree on what is seen in each pixel.
///
/// Rays are the judge: a pixel is on an edge if one of its eight neighbours sees, by rays, another
/// primitive, the background, or the same shape at a depth that differs by more than 2 %. Where none
/// does and the two differ, it still is on the edge of something narrower than a pixel if a ray within
/// 1/16 of a pixel sees what was drawn.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct VisibilityAgreement {
    /// How many pixels were compared.
    pub pixels: u64,
    /// How many of them see something, by rays.
    pub covered: u64,
    /// Where both see the same primitive, or both nothing.
    pub same_primitive: u64,
    /// Where both see the same object, or both nothing.
    pub same_object: u64,
    /// Where they see different primitives, on an edge.
    pub differing_on_edges: u64,
    /// Where they see different primitives and no edge is near.
    pub differing_elsewhere: u64,
    /// How many pixels are on an edge, whether they differ or not.
    pub edges: u64,
    /// The first places where no edge explains the difference: column and row in the picture.
    pub unexplained: Vec<[u32; 2]>,
}

impl VisibilityAgreement {
    /// The share of pixels in which both see the same primitive, 0 to 1.
    #[must_use]
    pub fn share(&self) -> f64 {
        if self.pixels == 0 {
            return 1.0;
        }
        self.same_primitive as f64 / self.pixels as f64
    }

    /// Compares two pictures of the same extent, row by row from the top. `is_beside` says whether
    /// rays very near to that of a pixel see what was drawn there.
    pub(super) fn of(
        rays: &[Option<Seen>],
        raster: &[Option<Seen>],
        extent: &Crop,
        is_beside: &dyn Fn([u32; 2], &Option<Seen>) -> bool,
    ) -> Self {
        let mut agreement = Self {
            pixels: extent.pixels(),
            ..Self::default()
        };
        let width = extent.width() as usize;
        for (i, (by_rays, drawn)) in rays.iter().zip(raster).enumerate() {
            let place = [i % width, i / width];
            let on_edge = is_on_edge(rays, place, [width, extent.height() as usize]);
            let same = primitive(by_rays) == primitive(drawn);
            agreement.covered += u64::from(by_rays.is_some());
            agreement.edges += u64::from(on_edge);
            agreement.same_primitive += u64::from(same);
            let object = |seen: &Option<Seen>| seen.map(|seen| seen.instance);
            agreement.same_object += u64::from(object(by_rays) == object(drawn));
            if same {
                continue;
            }
            let [x, y] = place.map(|i| i as u32);
            let pixel = [extent.x0 + x, extent.y0 + y];
            if on_edge {
                agreement.differing_on_edges += 1;
            } else if is_beside(pixel, drawn) {
                agreement.differing_on_edges += 1;
                agreement.edges += 1;
            } else {
                agreement.differing_elsewhere += 1;
                if agreement.unexplained.len() < PLACES {
                    agreement.unexplained.push(pixel);
                }
            }
        }
        agreement
    }
}

fn primitive(seen: &Option<Seen>) -> Option<[u32; 3]> {
    seen.map(|seen| [seen.instance.0, seen.geometry.0, seen.primitive.0])
}

fn is_on_edge(seen: &[Option<Seen>], [x, y]: [usize; 2], [width, height]: [usize; 2]) -> bool {
    let here = &seen[y * width + x];
    let around = |i: usize, count: usize| i.saturating_sub(1)..(i + 2).min(count);
    around(y, height).any(|row| {
        around(x, width).any(|column| {
            let there = &seen[row * width + column];
            primitive(here) != primitive(there) || jumps(here, there)
        })
    })
}

fn jumps(here: &Option<Seen>, there: &Option<Seen>) -> bool {
    match (here, there) {
        (Some(here), Some(there)) => {
            (here.depth - there.depth).abs() > JUMP * here.depth.min(there.depth)
        }
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ombra_geometry::{GeometryId, InstanceId, PrimitiveId};

    fn see(primitives: [u32; 25]) -> Vec<Option<Seen>> {
        let one = |primitive: u32| {
            (primitive > 0).then_some(Seen {
                instance: InstanceId(primitive / 10),
                geometry: GeometryId(0),
                primitive: PrimitiveId(primitive),
                depth: 1.0,
            })
        };
        primitives.map(one).to_vec()
    }

    #[test]
    fn edges_explain_differences_and_nothing_else_does() {
        #[rustfmt::skip]
        let rays = see([
            1, 1, 1, 0, 0,
            1, 1, 1, 0, 0,
            1, 1, 1, 0, 0,
            1, 1, 1, 0, 0,
            1, 1, 1, 0, 0,
        ]);
        let extent = Crop {
            x0: 10,
            y0: 20,
            x1: 15,
            y1: 25,
        };
        let nowhere = |_: [u32; 2], _: &Option<Seen>| false;
        let same = VisibilityAgreement::of(&rays, &rays, &extent, &nowhere);
        assert_eq!((same.share(), same.covered, same.edges), (1.0, 15, 10));
        let mut drawn = rays.clone();
        drawn[2] = None;
        drawn[11] = None;
        drawn[5] = see([12; 25])[0];
        let differing = VisibilityAgreement::of(&rays, &drawn, &extent, &nowhere);
        assert_eq!(differing.same_primitive, 22);
        assert_eq!(differing.same_object, 22);
        assert_eq!(
            (differing.differing_on_edges, differing.differing_elsewhere),
            (1, 2)
        );
        assert_eq!(differing.unexplained, [[10, 21], [11, 22]]);
        // A sliver of 12 through the first of the two.
        let sliver = |pixel: [u32; 2], drawn: &Option<Seen>| {
            pixel == [10, 21] && primitive(drawn).is_some_and(|ids| ids[2] == 12)
        };
        let explained = VisibilityAgreement::of(&rays, &drawn, &extent, &sliver);
        assert_eq!(
            (explained.differing_on_edges, explained.edges),
            (2, differing.edges + 1)
        );
        assert_eq!(explained.unexplained, [[11, 22]]);
    }

    #[test]
    fn nothing_agrees_with_nothing() {
        assert_eq!(VisibilityAgreement::default().share(), 1.0);
    }
}
