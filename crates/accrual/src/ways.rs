//! Ways of the sun that lie near one another, and what holds for all of them.
//!
//! What may come before the sun on one day may on the next, so a walk down the tree serves several days at once. Where it
//! needs to know where an arc lies, it is told where the arcs of that number lie on all these days.

use crate::way::Way;

/// The most ways that are looked at together.
pub(crate) const TOGETHER: usize = 8;

/// Directions are looked up by azimuth in so many cells a turn.
const CELLS: usize = 1024;

/// What a turn is made larger by, on both sides, against rounding.
pub(crate) const TURN_PAD: f32 = 4e-6;

/// How far apart ways may begin and end, in [turns](crate::way::turn): two days at an equinox, two months at a solstice. In the outline of what
/// lies farther apart much is looked at in vain.
const APART: f32 = 0.02;

/// How many arcs more than another a way may have.
const MORE: usize = 4;

/// A sheet turns by 350° at most, so this is behind its start, by rounding.
const BEHIND: f32 = 3.95;

/// Some ways, and around all of them an outline.
#[derive(Clone, Debug)]
pub(crate) struct Ways {
    list: Vec<Way>,
    /// Which of the ways that were given each of them is.
    pub(crate) which: Vec<usize>,
    /// The most arcs of a way.
    len: usize,
    /// The lowest squared tangent of the altitude at each knot. A way that has fewer knots stays at its last one.
    flat: Vec<f32>,
    /// Between which turns each knot lies, counted from the start along the way.
    turns: Vec<[f32; 2]>,
    /// Where the first way begins.
    pub(crate) start: f32,
    /// 1 if azimuth grows with time, −1 if it falls.
    pub(crate) sign: f32,
    /// By cell, counted from the start: the first arc that is not over before it, if any, and the last
    /// that has begun within it.
    arcs: Box<[[u8; 2]; CELLS]>,
}

impl Ways {
    /// All ways, those together that lie near one another.
    pub(crate) fn together(ways: Vec<Way>) -> Vec<Self> {
        let mut groups: Vec<Vec<(usize, Way)>> = Vec::new();
        for (which, way) in ways.into_iter().enumerate() {
            // Any of them: the days of spring lie near those of autumn.
            let near = groups.iter_mut().rev();
            let mut near = near.filter(|group| group.len() < TOGETHER);
            match near.find(|group| group.iter().all(|(_, other)| is_near(&way, other))) {
                Some(group) => group.push((which, way)),
                None => groups.push(vec![(which, way)]),
            }
        }
        groups.into_iter().map(Self::new).collect()
    }

    /// One way alone.
    pub(crate) fn of_one(way: Way) -> Self {
        Self::new(vec![(0, way)])
    }

    fn new(group: Vec<(usize, Way)>) -> Self {
        let (which, list): (Vec<usize>, Vec<Way>) = group.into_iter().unzip();
        let len = list.iter().map(Way::len).max().unwrap_or(0);
        let sign = if list[0].is_clockwise { 1.0 } else { -1.0 };
        // How much later than the first of the list each begins.
        let later = |way: &Way| {
            let turn = wrapped(sign * (way.turns[0] - list[0].turns[0]));
            if turn > 2.0 { turn - 4.0 } else { turn }
        };
        let least = list.iter().map(later).fold(0.0, f32::min);
        let mut ways = Self {
            len,
            flat: vec![f32::INFINITY; len + 1],
            turns: vec![[f32::INFINITY, 0.0]; len + 1],
            start: wrapped(list[0].turns[0] + sign * least),
            sign,
            arcs: Box::new([[u8::MAX, 0]; CELLS]),
            which,
            list: Vec::new(),
        };
        for way in &list {
            ways.surround(way, later(way) - least);
        }
        ways.list = list;
        ways
    }

    /// Makes the outline hold a way that begins so much later than it.
    fn surround(&mut self, way: &Way, later: f32) {
        let start = way.turns[0];
        let mut turns: Vec<f32> = (way.turns.iter())
            .map(|turn| wrapped(self.sign * (turn - start)))
            .map(|turn| if turn > BEHIND { 0.0 } else { turn })
            .collect();
        for k in 1..turns.len() {
            turns[k] = turns[k].max(turns[k - 1]);
        }
        let stay = |knot: usize| knot.min(way.len());
        let turns: Vec<f32> = (0..=self.len)
            .map(|knot| later + turns[stay(knot)])
            .collect();
        for (knot, &turn) in turns.iter().enumerate() {
            let [from, to] = self.turns[knot];
            self.turns[knot] = [from.min(turn), to.max(turn)];
            self.flat[knot] = self.flat[knot].min(way.flat[stay(knot)]);
        }
        let width = 4.0 / CELLS as f32;
        for (cell, arcs) in self.arcs.iter_mut().enumerate() {
            let from = cell as f32 * width - TURN_PAD;
            let to = (cell + 1) as f32 * width + TURN_PAD;
            let first = turns[1..].partition_point(|&turn| turn < from);
            let last = turns[..self.len].partition_point(|&turn| turn <= to).max(1) - 1;
            *arcs = [arcs[0].min(first as u8), arcs[1].max(last as u8)];
        }
    }

    /// The ways, at most [`TOGETHER`].
    pub(crate) fn list(&self) -> &[Way] {
        &self.list
    }

    /// How many arcs the longest has.
    pub(crate) fn len(&self) -> usize {
        self.len
    }

    /// The first and the last arc that may lie between two turns, counted from the start along the
    /// way; the first is not before the last if there is none.
    #[inline(always)]
    pub(crate) fn between(&self, from: f32, to: f32) -> [usize; 2] {
        let cell = |turn: f32| ((turn * (CELLS / 4) as f32) as usize).min(CELLS - 1);
        let first = usize::from(self.arcs[cell(from)][0]);
        let last = usize::from(self.arcs[cell(to)][1]);
        if from <= to {
            return [first, last];
        }
        // The start lies between.
        let is_in_gap = first >= self.len;
        [0, if is_in_gap { last } else { self.len - 1 }]
    }

    /// Between which turns some arcs lie.
    #[inline(always)]
    pub(crate) fn turns_of(&self, [first, last]: [usize; 2]) -> [f32; 2] {
        [self.turns[first][0], self.turns[last + 1][1]]
    }

    /// The lowest squared tangent of the sun's altitude within some arcs, see [`Way::lowest`].
    #[inline(always)]
    pub(crate) fn lowest(&self, [first, last]: [usize; 2]) -> f32 {
        let (a, b) = (self.flat[first], self.flat[last + 1]);
        if a < b { a } else { b }
    }
}

/// Whether two ways have much in common.
fn is_near(one: &Way, other: &Way) -> bool {
    let apart = |knot: usize, own: usize| {
        let turn = wrapped(one.turns[knot] - other.turns[own]);
        turn.min(4.0 - turn)
    };
    one.is_clockwise == other.is_clockwise
        && one.len().abs_diff(other.len()) <= MORE
        && apart(0, 0) <= APART
        && apart(one.len(), other.len()) <= APART
        && has_room(one)
        && has_room(other)
}

/// Whether a way goes around so little that ways which begin before it do not go around wholly.
fn has_room(way: &Way) -> bool {
    let sign = if way.is_clockwise { 1.0 } else { -1.0 };
    let later = way
        .turns
        .iter()
        .map(|turn| wrapped(sign * (turn - way.turns[0])));
    let most = later.filter(|&turn| turn <= BEHIND).fold(0.0, f32::max);
    most + 2.0 * APART < BEHIND
}

/// A turn between 0 and 4.
#[inline(always)]
fn wrapped(turn: f32) -> f32 {
    if turn < 0.0 {
        turn + 4.0
    } else if turn >= 4.0 {
        turn - 4.0
    } else {
        turn
    }
}

#[cfg(test)]
mod tests {
    use ombra_sun::{Hours, Place, Refraction, Sheet, Sky};

    use super::*;
    use crate::way::turn;

    fn sheets(latitude: f64, refraction: Refraction) -> Vec<Sheet> {
        let sky = Sky::new(Place::new(latitude, 5.0, 0.0).unwrap(), refraction).unwrap();
        let first = jiff::civil::date(2026, 1, 1);
        let days = first.series(jiff::Span::new().days(5)).take(73);
        let spans =
            days.flat_map(|day| Hours::default().spans(&sky, &jiff::tz::TimeZone::UTC, day));
        spans.flat_map(|span| Sheet::cover(&sky, span)).collect()
    }

    #[test]
    fn each_way_lies_within_the_outline_of_those_that_it_is_with() {
        let mut sizes = [0; TOGETHER + 1];
        for (k, latitude) in [-78.0, -33.0, 0.0, 10.0, 23.4, 52.0, 66.0, 80.0]
            .into_iter()
            .enumerate()
        {
            let refraction = [Refraction::None, Refraction::SEA][k % 2];
            let sheets = sheets(latitude, refraction);
            let ways: Vec<Way> = sheets.iter().map(Way::new).collect();
            let groups = Ways::together(ways.clone());
            let mut seen: Vec<usize> = groups.iter().flat_map(|ways| ways.which.clone()).collect();
            seen.sort_unstable();
            assert!(seen.into_iter().eq(0..sheets.len()));
            assert!(groups.len() < sheets.len(), "nothing is together");
            for group in &groups {
                sizes[group.list().len()] += 1;
                for &which in &group.which {
                    let clockwise = if sheets[which].clockwise() { 1.0 } else { -1.0 };
                    assert_eq!(group.sign, clockwise);
                    for (k, arc) in sheets[which].arcs().iter().enumerate() {
                        for share in [0.001, 0.3, 0.7, 0.999] {
                            let sun = arc.direction(share).map(|x| x as f32);
                            let flat = sun[2].max(0.0).powi(2) / (sun[0].powi(2) + sun[1].powi(2));
                            assert!(group.lowest([k, k]) <= flat, "{latitude} {which} {k}");
                            let turn = wrapped(group.sign * (turn(sun) - group.start));
                            if flat < 1e4 && turn < BEHIND {
                                let [first, last] = group.between(turn, turn);
                                assert!(first <= k && k <= last, "{latitude} {which} {k} {share}");
                                let [from, to] = group.turns_of([k, k]);
                                assert!(from - TURN_PAD <= turn && turn <= to + TURN_PAD);
                            }
                        }
                    }
                }
            }
        }
        assert!(sizes[1..].iter().all(|&count| count > 0), "{sizes:?}");
    }
}
