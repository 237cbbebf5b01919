//! What of an arc is in whose shadow, out of what was found before it.

use ombra_geometry::Point3;
use ombra_sun::Instant;

use crate::cover::JOIN;
use crate::kernel::Record;
use crate::occluder::Occluder;
use crate::way::Way;

use super::stretch::Stretch;

/// Stretches that lie no further apart than this, in seconds, are one: that is [`JOIN`] of the longest arc.
const TOUCHING: f64 = 0.01;

/// One arc, and what was found before it.
pub(super) struct Arc<'a> {
    occluders: &'a [Occluder],
    records: &'a [Record],
    start: f64,
    length: f64,
    /// See [`Way`].
    from: [f32; 3],
    to: [f32; 3],
    bulge: [f32; 3],
}

impl<'a> Arc<'a> {
    /// Of the records, which are one at least, all are of the same arc of the way.
    pub(super) fn new(occluders: &'a [Occluder], way: &Way, records: &'a [Record]) -> Self {
        let arc = records[0].arc as usize;
        Self {
            occluders,
            records,
            start: way.starts[arc],
            length: way.seconds[arc],
            from: way.knots[arc],
            to: way.knots[arc + 1],
            bulge: way.bulges[arc],
        }
    }

    /// How far away the polygon is toward the sun of a moment; the unit depends on the moment.
    fn distance(&self, part: &Part, place: Point3, moment: f32) -> f32 {
        let Occluder { corner, normal, .. } = &self.occluders[part.which as usize];
        let (place, share) = (place.to_array(), moment * (1.0 - moment));
        let (mut above, mut along) = (0.0, 0.0);
        for axis in 0..3 {
            let sun = self.from[axis] * (1.0 - moment) + self.to[axis] * moment;
            above += normal[axis] * (corner[0][axis] - place[axis]);
            along += normal[axis] * (sun + share * self.bulge[axis]);
        }
        above / along
    }

    fn instant(&self, moment: f32) -> Instant {
        Instant::from_seconds(self.start + self.length * f64::from(moment))
    }
}

/// A part of the arc that a polygon covers, as seen from one place.
#[derive(Clone, Copy, Debug)]
struct Part {
    from: f32,
    to: f32,
    which: u32,
    owner: u32,
}

/// Room for one arc of one place, kept between them.
#[derive(Debug, Default)]
pub(super) struct Sweep {
    parts: Vec<Part>,
    cuts: Vec<f32>,
}

impl Sweep {
    /// Adds the stretches of one arc of a place to those of the arcs before.
    pub(super) fn add(
        &mut self,
        arc: &Arc<'_>,
        place: usize,
        at: Point3,
        found: &mut Vec<Stretch>,
    ) {
        if let Some((owner, is_alone)) = of_all(arc.records, place) {
            push(arc, [0.0, 1.0], owner, is_alone, found);
            return;
        }
        let Self { parts, cuts } = self;
        parts.clear();
        parts.extend(
            (arc.records.iter())
                .map(|record| Part {
                    from: record.from[place],
                    to: record.to[place],
                    which: record.which,
                    owner: record.owner,
                })
                .filter(|part| part.from < part.to),
        );
        if let [part] = parts[..] {
            push(arc, [part.from, part.to], part.owner, true, found);
            return;
        }
        // Between two cuts the same polygons cover the sun.
        cuts.clear();
        cuts.extend(parts.iter().flat_map(|part| [part.from, part.to]));
        cuts.sort_unstable_by(f32::total_cmp);
        cuts.dedup_by(|next, before| *next - *before <= JOIN);
        for ends in cuts.windows(2) {
            let moment = 0.5 * (ends[0] + ends[1]);
            let is_covering = |part: &&Part| part.from < moment && moment < part.to;
            let mut covering = parts.iter().filter(is_covering);
            let Some(first) = covering.next().map(|part| part.owner) else {
                continue;
            };
            if covering.all(|part| part.owner == first) {
                push(arc, [ends[0], ends[1]], first, true, found);
                continue;
            }
            let nearest = |moment| {
                let all = parts.iter().filter(is_covering);
                // Of what stands in the same place, always the same one.
                let keys = all.map(|part| (arc.distance(part, at, moment), part.owner));
                let none = (f32::INFINITY, u32::MAX);
                keys.fold(none, |a, b| if b < a { b } else { a }).1
            };
            let [mut begin, end] = [ends[0], ends[1]];
            let last = nearest(end);
            let mut owner = nearest(begin);
            // Where solids overlap another one may become the nearest on the way.
            for _ in 0..parts.len() {
                if owner == last {
                    break;
                }
                let change = first_change(begin, end, |moment| nearest(moment) == owner);
                push(arc, [begin, change], owner, false, found);
                begin = change;
                owner = nearest(begin);
            }
            push(arc, [begin, end], last, false, found);
        }
    }
}

/// Whose shadow a place lies in all along the arc, and whether it is of that one alone, if that is plain: something covers all of
/// the arc, and nothing else comes as near. This is by far the most that happens.
fn of_all(records: &[Record], place: usize) -> Option<(u32, bool)> {
    let is_whole = |record: &&Record| record.from[place] <= JOIN && record.to[place] >= 1.0 - JOIN;
    let whole = records.iter().filter(is_whole);
    let first = whole.min_by(|a, b| a.far.total_cmp(&b.far))?;
    let (mut is_alone, mut is_shared) = (true, false);
    for other in records.iter().filter(|other| other.owner != first.owner) {
        if other.from[place] < other.to[place] {
            if other.near < first.far {
                return None;
            }
            is_alone = false;
            is_shared |= is_whole(&other);
        }
    }
    // What stands behind a part of the time only is a matter of cuts.
    (is_alone || is_shared).then_some((first.owner, is_alone))
}

/// Until when something is so that is so at the beginning and not at the end.
fn first_change(mut begin: f32, mut end: f32, is_so: impl Fn(f32) -> bool) -> f32 {
    while end - begin > JOIN {
        let middle = 0.5 * (begin + end);
        if middle <= begin || middle >= end {
            break;
        }
        if is_so(middle) {
            begin = middle;
        } else {
            end = middle;
        }
    }
    end
}

/// Adds a part of an arc, to the last stretch if it is more of the same.
fn push(arc: &Arc<'_>, ends: [f32; 2], owner: u32, is_alone: bool, found: &mut Vec<Stretch>) {
    let [from, to] = ends.map(|moment| arc.instant(moment));
    match found.last_mut() {
        Some(last) if from - last.to <= TOUCHING => {
            if last.owner == owner && last.is_alone == is_alone {
                last.to = to;
                return;
            }
            // No light between two that touch.
            last.to = from;
        }
        _ => {}
    }
    found.push(Stretch {
        from,
        to,
        owner,
        is_alone,
    });
}
