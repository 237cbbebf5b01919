//! The way of the sun over a stretch of time, ready for the kernel.

use ombra_sun::Sheet;

/// The most arcs of a way.
pub(crate) const MOST: usize = 64;

/// Directions are looked up by azimuth in so many cells a turn.
const CELLS: usize = 1024;

/// Arcs, in single precision, and which of them lie in which direction.
#[derive(Clone, Debug)]
pub(crate) struct Way {
    /// Where the sun is at the ends of the arcs: x east, y north, z up.
    pub(crate) knots: Vec<[f32; 3]>,
    /// How far each arc bulges out from its chord: at share u of its time, u (1 − u) times this.
    pub(crate) bulges: Vec<[f32; 3]>,
    /// How long each arc takes.
    pub(crate) seconds: Vec<f64>,
    /// The largest bulge, a quarter of it: how far an arc departs from its chord at most.
    pub(crate) sag: f32,
    /// The squared tangent of the altitude at each knot, a little too low.
    flat: Vec<f32>,
    /// How far around each knot lies, counted from the start along the way.
    turns: Vec<f32>,
    /// Where the way begins, see [`turn`].
    pub(crate) start: f32,
    /// 1 if azimuth grows with time, −1 if it falls.
    pub(crate) sign: f32,
    /// By cell, counted from the start: the first arc that is not over before it, if any, and the last
    /// that has begun within it.
    arcs: Box<[[u8; 2]; CELLS]>,
}

/// How far around a horizontal direction lies, clockwise from north, from 0 to 4: a quarter is 1, and
/// within a quarter it grows as the share of y in |x| + |y|. It needs no angle.
pub(crate) fn turn([east, north, _]: [f32; 3]) -> f32 {
    let size = east.abs() + north.abs();
    let q = if size > 0.0 { east / size } else { 0.0 };
    match (north >= 0.0, q >= 0.0) {
        (true, true) => q,
        (true, false) => 4.0 + q,
        (false, _) => 2.0 - q,
    }
}

/// What a turn is made larger by, on both sides, against rounding.
pub(crate) const TURN_PAD: f32 = 4e-6;

impl Way {
    /// Of one sheet, which has an arc at least and [`MOST`] at most.
    pub(crate) fn new(sheet: &Sheet) -> Self {
        let arcs = sheet.arcs();
        assert!((1..=MOST).contains(&arcs.len()), "a sheet has 1 to 64 arcs");
        let single = |v: [f64; 3]| v.map(|x| x as f32);
        // At sunrise the sun may be below the horizon by rounding: walls on the ground where a place is
        // would not cover it then, for a moment, and no such arc would ever be covered wholly.
        let knot = |v: [f64; 3]| {
            let [x, y, z] = single(v);
            [x, y, z.max(0.0)]
        };
        let mut knots: Vec<[f32; 3]> = arcs.iter().map(|arc| knot(arc.from)).collect();
        knots.push(knot(arcs[arcs.len() - 1].to));
        let bulges: Vec<[f32; 3]> = arcs.iter().map(|arc| single(arc.bulge)).collect();
        let sag = bulges.iter().fold(0.0_f32, |most, [x, y, z]| {
            most.max((x * x + y * y + z * z).sqrt())
        });
        let flat = knots.iter().map(|&[x, y, z]| {
            let up = z.max(0.0);
            0.999 * up * up / (x * x + y * y).max(f32::MIN_POSITIVE)
        });
        let turns: Vec<f32> = knots.iter().map(|&knot| turn(knot)).collect();
        let sign = if sheet.clockwise() { 1.0 } else { -1.0 };
        let start = turns[0];
        let mut relative: Vec<f32> = turns.iter().map(|t| wrapped(sign * (t - start))).collect();
        // What rounds to just before the start has not gone around: a sheet turns by 350° at most.
        for turn in relative.iter_mut().filter(|turn| **turn > 3.95) {
            *turn = 0.0;
        }
        for k in 1..relative.len() {
            if relative[k] < relative[k - 1] {
                relative[k] = relative[k - 1];
            }
        }
        Self {
            bulges,
            seconds: arcs.iter().map(|arc| arc.end - arc.start).collect(),
            sag: 0.25 * sag,
            flat: flat.collect(),
            start,
            sign,
            arcs: by_cell(&relative),
            turns: relative,
            knots,
        }
    }

    /// How many arcs.
    pub(crate) fn len(&self) -> usize {
        self.bulges.len()
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
        let is_in_gap = first >= self.len();
        [0, if is_in_gap { last } else { self.len() - 1 }]
    }

    /// Between which turns some arcs lie.
    #[inline(always)]
    pub(crate) fn turns_of(&self, [first, last]: [usize; 2]) -> [f32; 2] {
        [self.turns[first], self.turns[last + 1]]
    }

    /// The lowest squared tangent of the sun's altitude within some arcs: altitude has no minimum within
    /// a sheet.
    #[inline(always)]
    pub(crate) fn lowest(&self, [first, last]: [usize; 2]) -> f32 {
        let (a, b) = (self.flat[first], self.flat[last + 1]);
        if a < b { a } else { b }
    }
}

/// A turn between 0 and 4.
#[inline(always)]
pub(crate) fn wrapped(turn: f32) -> f32 {
    if turn < 0.0 {
        turn + 4.0
    } else if turn >= 4.0 {
        turn - 4.0
    } else {
        turn
    }
}

/// See [`Way::arcs`].
fn by_cell(turns: &[f32]) -> Box<[[u8; 2]; CELLS]> {
    let count = turns.len() - 1;
    let mut cells = Box::new([[0; 2]; CELLS]);
    let width = 4.0 / CELLS as f32;
    for (cell, arcs) in cells.iter_mut().enumerate() {
        let from = cell as f32 * width - TURN_PAD;
        let to = (cell + 1) as f32 * width + TURN_PAD;
        let first = turns[1..].partition_point(|&turn| turn < from);
        let last = turns[..count].partition_point(|&turn| turn <= to).max(1) - 1;
        *arcs = [first as u8, last as u8];
    }
    cells
}
