//! The way of the sun over a stretch of time, ready for the kernel.

use ombra_sun::{MAX_ARCS, Sheet};

/// The most arcs of a way: sets of them are 64 bits.
pub(crate) const MOST: usize = 64;
const _: () = assert!(MAX_ARCS <= MOST);

/// Arcs, in single precision.
#[derive(Clone, Debug)]
pub(crate) struct Way {
    /// Where the sun is at the ends of the arcs: x east, y north, z up.
    pub(crate) knots: Vec<[f32; 3]>,
    /// How far each arc bulges out from its chord: at share u of its time, u (1 − u) times this.
    pub(crate) bulges: Vec<[f32; 3]>,
    /// When each arc begins, in seconds as [`Instant`](ombra_sun::Instant) counts them.
    pub(crate) starts: Vec<f64>,
    /// How long each arc takes.
    pub(crate) seconds: Vec<f64>,
    /// The largest bulge, a quarter of it: how far an arc departs from its chord at most.
    pub(crate) sag: f32,
    /// The squared tangent of the altitude at each knot, a little too low.
    pub(crate) flat: Vec<f32>,
    /// How far around each knot lies, see [`turn`].
    pub(crate) turns: Vec<f32>,
    /// Whether azimuth grows with time; else it falls.
    pub(crate) is_clockwise: bool,
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
        Self {
            bulges,
            starts: arcs.iter().map(|arc| arc.start).collect(),
            seconds: arcs.iter().map(|arc| arc.end - arc.start).collect(),
            sag: 0.25 * sag,
            flat: flat.collect(),
            turns: knots.iter().map(|&knot| turn(knot)).collect(),
            is_clockwise: sheet.clockwise(),
            knots,
        }
    }

    /// How many arcs.
    pub(crate) fn len(&self) -> usize {
        self.bulges.len()
    }

    /// The lowest squared tangent of the sun's altitude within some arcs: altitude has no minimum within
    /// a sheet.
    #[inline(always)]
    pub(crate) fn lowest(&self, [first, last]: [usize; 2]) -> f32 {
        let (a, b) = (self.flat[first], self.flat[last + 1]);
        if a < b { a } else { b }
    }
}
