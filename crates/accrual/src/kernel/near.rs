//! How near polygons are toward the sun.

use super::lanes::Lanes;
use super::polygon::dot;
use crate::occluder::Occluder;
use crate::tile::{PLACES, Tile};
use crate::way::Way;

/// How near a polygon is, as one over its distance, which along an arc is nearly linear.
#[derive(Clone, Copy)]
pub(super) struct Near<P> {
    /// At the beginning of the arc, and at its end.
    pub(super) begin: P,
    pub(super) end: P,
    pub(super) bulge: P,
}

/// The same for each place of a tile, in memory.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(crate) struct Nears {
    begin: [f32; PLACES],
    end: [f32; PLACES],
    bulge: [f32; PLACES],
}

impl Nears {
    /// Of one place.
    pub(crate) fn of(&self, place: usize) -> [f32; 3] {
        [self.begin[place], self.end[place], self.bulge[place]]
    }

    /// # Safety
    /// - The processor has the instructions of `P`, which are sixteen.
    #[inline(always)]
    pub(super) unsafe fn load<P: Lanes>(&self) -> Near<P> {
        // SAFETY: the caller's promise.
        unsafe {
            Near {
                begin: P::load(self.begin.as_ptr()),
                end: P::load(self.end.as_ptr()),
                bulge: P::load(self.bulge.as_ptr()),
            }
        }
    }
}

impl<P: Lanes> Near<P> {
    /// # Safety
    /// - As above.
    #[inline(always)]
    pub(super) unsafe fn store(self) -> Nears {
        let mut nears = Nears {
            begin: [0.0; PLACES],
            end: [0.0; PLACES],
            bulge: [0.0; PLACES],
        };
        // SAFETY: the caller's promise; there is room for sixteen.
        unsafe {
            self.begin.store(nears.begin.as_mut_ptr());
            self.end.store(nears.end.as_mut_ptr());
            self.bulge.store(nears.bulge.as_mut_ptr());
        }
        nears
    }

    /// # Safety
    /// - The processor has the instructions of `P`; so below.
    #[inline(always)]
    pub(super) unsafe fn new(occluder: &Occluder, tile: &Tile, way: &Way, arc: usize) -> Self {
        // SAFETY: the caller's promise; a tile has sixteen places.
        unsafe {
            let mut away = [P::splat(0.0); 3];
            for ((away, at), corner) in away.iter_mut().zip(&tile.at).zip(occluder.corner[0]) {
                *away = P::splat(corner).minus(P::load(at.as_ptr()));
            }
            let above = P::splat(1.0).over(dot(away, occluder.normal));
            let along = |sun: [f32; 3]| {
                let [x, y, z] = occluder.normal;
                x * sun[0] + y * sun[1] + z * sun[2]
            };
            let [begin, end] = [way.knots[arc], way.knots[arc + 1]].map(along);
            Self {
                begin: above.times(P::splat(begin)),
                end: above.times(P::splat(end)),
                bulge: above.times(P::splat(along(way.bulges[arc]))),
            }
        }
    }

    /// At a share of the arc's time.
    ///
    /// # Safety
    /// - As above.
    #[inline(always)]
    pub(super) unsafe fn at(&self, share: P) -> P {
        // SAFETY: the caller's promise.
        unsafe {
            let rest = P::splat(1.0).minus(share);
            let chord = rest.times(self.begin).plus(share.times(self.end));
            chord.plus(share.times(rest).times(self.bulge))
        }
    }

    /// # Safety
    /// - As above.
    #[inline(always)]
    pub(super) unsafe fn or_where_not(self, mask: P::Mask, other: Self) -> Self {
        // SAFETY: the caller's promise.
        unsafe {
            Self {
                begin: self.begin.or_where_not(mask, other.begin),
                end: self.end.or_where_not(mask, other.end),
                bulge: self.bulge.or_where_not(mask, other.bulge),
            }
        }
    }
}

/// The square of how far away a polygon is that covers all of an arc for all places of a tile, level, at most.
///
/// # Safety
/// - The processor has the instructions of `P`, which are sixteen.
#[inline(always)]
pub(super) unsafe fn farthest<P: Lanes>(
    occluder: &Occluder,
    tile: &Tile,
    way: &Way,
    arc: usize,
) -> f32 {
    // SAFETY: the caller's promise.
    let nears = unsafe { Near::<P>::new(occluder, tile, way, arc).store() };
    let least = |nears: &[f32; PLACES]| nears.iter().copied().fold(f32::INFINITY, f32::min);
    let [begin, end] = [least(&nears.begin), least(&nears.end)];
    let level = |[x, y, _]: [f32; 3]| x * x + y * y;
    // Between the ends it bulges a little.
    let bulge = nears
        .bulge
        .iter()
        .fold(0.0_f32, |most, own| most.max(own.abs()));
    let near = 0.999 * (begin.min(end) - 0.25 * bulge);
    let most = level(way.knots[arc]).max(level(way.knots[arc + 1])) * 1.01;
    if near > 0.0 {
        most / (near * near)
    } else {
        f32::INFINITY
    }
}
