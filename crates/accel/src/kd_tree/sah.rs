//! Where to cut: the surface area heuristic.
//!
//! A ray that meets a box meets a smaller box in it with the probability of the ratio of their
//! surfaces. So a cut costs one step and, in each half, that probability times the tests there
//! (MacDonald, Booth, "Heuristics for Ray Tracing Using Space Subdivision", The Visual Computer
//! 6(3), 1990). The best planes are at the faces of the primitives' boxes; a sweep over these in
//! order knows at each how many primitives have begun and how many have ended.

use ombra_geometry::{Aabb, Axis};

use super::build::Event;

/// What a step down costs, a primitive's test being 1. Cheaper steps make the tree larger and hardly
/// faster.
const STEP: f64 = 1.0;

/// What a cut that leaves one half empty costs less: such a half is passed without a test, and the
/// heuristic, which thinks rays endless, does not see that many rays begin close by (Wald, Havran
/// 2006).
const EMPTY_SPACE: f64 = 0.8;

/// A cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Split {
    pub(super) axis: Axis,
    pub(super) plane: f64,
    /// How many primitives lie below, and above.
    pub(super) counts: [usize; 2],
    /// Expected, in tests of a primitive.
    pub(super) cost: f64,
}

/// The best cut of a box across one axis, if there is one: `count` primitives whose boxes begin and
/// end at `events`, in order, some of them outside the box.
pub(super) fn best_across(
    axis: Axis,
    events: &[Event],
    count: usize,
    bounds: &Aabb<f64>,
) -> Option<Split> {
    let area = bounds.half_area();
    if !(area > 0.0) {
        return None;
    }
    let (min, max) = (bounds.min[axis], bounds.max[axis]);
    let extent = bounds.extent();
    let (b, c) = (extent[axis.next()], extent[axis.next().next()]);
    // The probability of a half of some width is `ends + sides · width`.
    let (ends, sides) = (b * c / area, (b + c) / area);

    // Whatever begins at `min` or before lies below every plane, and nothing ends there.
    let mut begun = events.partition_point(|event| event.position <= min);
    let mut ended = 0;
    let mut best: Option<Split> = None;
    // Of events at the same place, ends come first: the last of the ends, or the first of the
    // beginnings, sees the true counts, and the others too many. So they need not be grouped.
    for event in &events[begun..] {
        let plane = event.position;
        if plane >= max {
            break;
        }
        ended += usize::from(event.is_end());
        let (below, above) = (begun, count - ended);
        let bonus = if below == 0 || above == 0 {
            EMPTY_SPACE
        } else {
            1.0
        };
        let tests = (ends + sides * (plane - min)) * below as f64
            + (ends + sides * (max - plane)) * above as f64;
        let cost = STEP + bonus * tests;
        if best.is_none_or(|best| cost < best.cost) {
            best = Some(Split {
                axis,
                plane,
                counts: [below, above],
                cost,
            });
        }
        begun += usize::from(!event.is_end());
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use ombra_geometry::Point3;

    fn events(spans: &[(f64, f64)]) -> Vec<Event> {
        let mut events: Vec<_> = (0..)
            .zip(spans)
            .flat_map(|(i, &(from, to))| [Event::begin(from, i), Event::end(to, i)])
            .collect();
        events.sort_by(Event::order);
        events
    }

    fn unit() -> Aabb<f64> {
        Aabb::around([Point3::new(0.0, 0.0, 0.0), Point3::new(1.0, 1.0, 1.0)])
    }

    #[test]
    fn empty_space_is_cut_off() {
        let events = events(&[(0.7, 0.9), (0.7, 0.8), (0.72, 0.9)]);
        let split = best_across(Axis::X, &events, 3, &unit()).unwrap();
        assert_eq!(split.plane, 0.7);
        assert!(split.cost < 3.0);
    }

    #[test]
    fn two_crowds_are_parted() {
        let spans: Vec<_> = (0..20)
            .map(|i| if i < 10 { (0.0, 0.4) } else { (0.6, 1.0) })
            .collect();
        let split = best_across(Axis::Y, &events(&spans), 20, &unit()).unwrap();
        assert!(split.plane == 0.4 || split.plane == 0.6);
    }

    #[test]
    fn boxes_that_fill_everything_offer_no_cut() {
        let events = events(&[(-1.0, 2.0), (0.0, 1.0)]);
        assert_eq!(best_across(Axis::Z, &events, 2, &unit()), None);
    }

    #[test]
    fn a_box_without_surface_offers_no_cut() {
        let point = Aabb::around([Point3::new(0.5, 0.5, 0.5)]);
        let events = events(&[(0.4, 0.6)]);
        assert_eq!(best_across(Axis::X, &events, 1, &point), None);
    }
}
