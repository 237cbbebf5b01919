//! A stretch of a day as arcs that turn one way.

use std::f64::consts::PI;

use crate::crossing::{Crossing, crossings};
use crate::{Arc, Instant, Refraction, Sky, Span};

/// The most arcs of one sheet.
pub const MAX_ARCS: usize = 64;

/// The farthest that the sun turns in one sheet, degrees of azimuth.
pub const MAX_SWEEP: f64 = 350.0;

/// Seconds next to an end in which no cut is made: what the sun turns back there is next to nothing.
const MARGIN: f64 = 0.05;

/// The arcs of a sheet that are kept for where refraction needs more of them.
const SPARE: usize = 16;

/// The latitude, degrees, up to which the sun may turn back in azimuth: the tropic, and room.
const TROPIC: f64 = 25.0;
/// The latitude from which the sun may be up at its lowest: the polar circle, less room for
/// refraction.
const POLAR: f64 = 60.0;

/// How arcs share a sheet's time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Knots {
    /// Seconds of an arc in the mean; longer where 64 arcs would not do. 60 to 7200.
    pub spacing: f64,
    /// How much denser arcs are at a low sun, where many obstacles lie in few degrees: knots are at
    /// x - w sin(2πx)/2π, so that arcs there are 1-w as long as in the mean. 0 to 0.9.
    pub crowding: f64,
    /// Sine of the altitude below which an end of a sheet counts as low.
    pub low: f64,
}

impl Default for Knots {
    fn default() -> Self {
        Self {
            spacing: 1200.0,
            crowding: 0.8,
            low: 0.1,
        }
    }
}

/// The sun's way over a stretch of time in which its azimuth only grows or only falls, by at most
/// [`MAX_SWEEP`], and its altitude rises, then falls, or does one of the two. At most [`MAX_ARCS`]
/// arcs, each beginning with the instant and the direction that the one before it ends with.
///
/// With the default [`Knots`] and no refraction the arcs are within 1e-5° and 0.4 ms of the reckoned
/// sun, at every latitude and date tried; with refraction, within 3e-4° and 50 ms.
///
/// Directions are good to 2e-8 (SPA's zenith distance is an arc cosine): by so much, measured as
/// lengths on the unit sphere, both laws may be broken where the sun turns back or is at the zenith.
#[derive(Clone, Debug, PartialEq)]
pub struct Sheet {
    arcs: Vec<Arc>,
}

impl Sheet {
    /// The sheets of a span in which the sun is up, as [`Hours::spans`](crate::Hours::spans) gives:
    /// one for most; up to three where the sun goes both ways in the tropics; two or three in polar
    /// day. They follow each other without a gap; a span of no length has none.
    #[must_use]
    pub fn cover(sky: &Sky, span: Span) -> Vec<Self> {
        Self::cover_with(sky, span, Knots::default())
    }

    /// The same with other knots; out of their ranges, the nearest within.
    #[must_use]
    pub fn cover_with(sky: &Sky, span: Span, knots: Knots) -> Vec<Self> {
        cuts(sky, span)
            .windows(2)
            .map(|ends| Self::between(sky, ends[0], ends[1], knots))
            .collect()
    }

    /// The arcs, in order: one at least.
    #[must_use]
    pub fn arcs(&self) -> &[Arc] {
        &self.arcs
    }

    /// From when to when.
    #[must_use]
    pub fn span(&self) -> Span {
        let (first, last) = (self.arcs[0], self.arcs[self.arcs.len() - 1]);
        Span::new(
            Instant::from_seconds(first.start),
            Instant::from_seconds(last.end),
        )
    }

    /// Whether the azimuth grows: in the north, all day; in the south, nowhere beyond the tropics.
    #[must_use]
    pub fn clockwise(&self) -> bool {
        // The area that the shadow's tip sweeps: where the sun is near the zenith it says little of
        // the direction, and counts little.
        let area = |arc: &Arc| arc.areal_speed(0.0) + arc.areal_speed(1.0);
        self.arcs.iter().map(area).sum::<f64>() > 0.0
    }

    /// How far the sun turns, degrees: positive clockwise, negative the other way. Up to
    /// [`MAX_SWEEP`], of which a single arc past the zenith may take a little more than 180.
    #[must_use]
    pub fn sweep(&self) -> f64 {
        let sign = if self.clockwise() { 1.0 } else { -1.0 };
        let mut total = 0.0;
        let mut last = None;
        let middles = self
            .arcs
            .iter()
            .flat_map(|arc| [arc.from, arc.direction(0.5)]);
        let end = self.arcs[self.arcs.len() - 1].to;
        // In the zenith, to rounding, there is no azimuth.
        let sure = |d: &[f64; 3]| d[0].hypot(d[1]) > 1e-6;
        for direction in middles.chain([end]).filter(sure) {
            if let Some(last) = last {
                // From half a degree back, for rounding, to nearly all round.
                total += (sign * turn(last, direction) + 0.5).rem_euclid(360.0) - 0.5;
            }
            last = Some(direction);
        }
        sign * total
    }

    fn between(sky: &Sky, start: f64, end: f64, knots: Knots) -> Self {
        let duration = end - start;
        let spacing = bounded(knots.spacing, 60.0, 7200.0);
        // Arcs of an instant's length would be lost in rounding.
        let least = (duration / 15.0).floor().clamp(1.0, 4.0);
        let most = match sky.refraction() {
            Refraction::None if sky.is_at_disc_point() => MAX_ARCS - 2,
            Refraction::None => MAX_ARCS,
            Refraction::Standard { .. } => MAX_ARCS - SPARE,
        };
        let count = (duration / spacing).ceil().clamp(least, most as f64) as usize;
        let at = |seconds: f64| sky.direction(Instant::from_seconds(seconds));
        let (first, last) = (at(start), at(end));
        let (low_start, low_end) = (first[2] < knots.low, last[2] < knots.low);
        let mut arcs = Vec::with_capacity(count);
        let (mut from, mut begin) = (first, start);
        for k in 1..=count {
            let share = crowded(k as f64 / count as f64, knots.crowding, low_start, low_end);
            let (stop, to) = if k == count {
                (end, last)
            } else {
                let stop = start + share * duration;
                (stop, at(stop))
            };
            arcs.push(Arc::between(sky, begin, stop, from, to));
            (from, begin) = (to, stop);
        }
        if sky.is_at_disc_point() {
            cut_at_horizon(sky, &mut arcs);
        }
        if sky.refraction() != Refraction::None {
            refine(sky, &mut arcs);
        }
        Self { arcs }
    }
}

/// Cuts arcs in two where refraction bends the sun's way more than they can follow. It falls from
/// half a degree at the horizon to a tenth at 8°: the error of an arc goes with the cube of the
/// degrees that it climbs, and is 1e-4° for one of 0.9° at the horizon.
fn refine(sky: &Sky, arcs: &mut Vec<Arc>) {
    let mut at = 0;
    while at < arcs.len() && arcs.len() < MAX_ARCS {
        let arc = arcs[at];
        let [from, to] = [arc.from, arc.to].map(|end| end[2].asin().to_degrees());
        let may_climb = 0.6 + 0.25 * from.min(to).max(0.0);
        let length = arc.end - arc.start;
        if (to - from).abs() <= may_climb || length < 30.0 {
            at += 1;
            continue;
        }
        cut(sky, arcs, at, arc.start + 0.5 * length);
    }
}

/// Cuts arcs in two where a point of the sun's disc rises or sets, for it goes along the horizon until then: that happens once
/// at either end of a sheet, at most.
fn cut_at_horizon(sky: &Sky, arcs: &mut Vec<Arc>) {
    let height = |seconds: f64| sky.toward(Instant::from_seconds(seconds))[2];
    let (start, end) = (arcs[0].start, arcs[arcs.len() - 1].end);
    if height(start) >= 0.0 && height(end) >= 0.0 {
        return;
    }
    for event in crossings(height, start, end) {
        // Where it is still on the horizon: were it above by rounding, the arc along the horizon would sag below it.
        let seconds = if event.rising {
            event.before
        } else {
            event.after
        };
        let is_within = |arc: &Arc| arc.start < seconds && seconds < arc.end;
        if let Some(at) = arcs.iter().position(is_within) {
            cut(sky, arcs, at, seconds);
        }
    }
}

/// Cuts an arc in two at an instant within it.
fn cut(sky: &Sky, arcs: &mut Vec<Arc>, at: usize, seconds: f64) {
    let arc = arcs[at];
    let sun = sky.direction(Instant::from_seconds(seconds));
    arcs[at] = Arc::between(sky, arc.start, seconds, arc.from, sun);
    arcs.insert(at + 1, Arc::between(sky, seconds, arc.end, sun, arc.to));
}

/// The value within its limits; the lower one for what is no number.
fn bounded(value: f64, low: f64, high: f64) -> f64 {
    if value >= low { value.min(high) } else { low }
}

/// Where the knot at an even share lies, with knots denser at the ends that are low.
fn crowded(x: f64, crowding: f64, low_start: bool, low_end: bool) -> f64 {
    let w = bounded(crowding, 0.0, 0.9);
    let both = |x: f64| x - w * (2.0 * PI * x).sin() / (2.0 * PI);
    match (low_start, low_end) {
        (true, true) => both(x),
        (true, false) => 2.0 * both(0.5 * x),
        (false, true) => 2.0 * both(0.5 + 0.5 * x) - 1.0,
        (false, false) => x,
    }
}

/// The ends of a span and the instants within at which a new sheet must begin, in order.
fn cuts(sky: &Sky, span: Span) -> Vec<f64> {
    let (start, end) = (span.start.seconds(), span.end.seconds());
    if !(end > start) {
        return Vec::new();
    }
    let latitude = sky.place().latitude.abs();
    let mut inner = Vec::new();
    if latitude < TROPIC {
        inner.extend(crossings(|t| turning(sky, t), start, end));
    }
    if latitude > POLAR {
        let lowest = crossings(|t| climbing(sky, t), start, end);
        inner.extend(lowest.into_iter().filter(|event| event.rising));
    }
    let mut cuts = vec![start];
    let mut inner: Vec<_> = inner.iter().map(|event: &Crossing| event.after).collect();
    inner.sort_by(f64::total_cmp);
    for cut in inner {
        if cut > cuts[cuts.len() - 1] + MARGIN && cut < end - MARGIN {
            cuts.push(cut);
        }
    }
    cuts.push(end);
    halved(sky, &cuts)
}

/// With pieces in which the sun goes round farther than a sheet may cut in two.
fn halved(sky: &Sky, cuts: &[f64]) -> Vec<f64> {
    let mut all = vec![cuts[0]];
    for ends in cuts.windows(2) {
        if swept(sky, ends[0], ends[1]) > MAX_SWEEP {
            all.push(0.5 * (ends[0] + ends[1]));
        }
        all.push(ends[1]);
    }
    all
}

/// How far the sun goes round, degrees. Short pieces of a day cannot go far and are not measured.
fn swept(sky: &Sky, start: f64, end: f64) -> f64 {
    const LONG: f64 = 20.0 * 3600.0;
    const PARTS: u32 = 24;
    if end - start < LONG {
        return 0.0;
    }
    let at = |k: u32| {
        let share = f64::from(k) / f64::from(PARTS);
        sky.direction(Instant::from_seconds(start + share * (end - start)))
    };
    let total: f64 = (0..PARTS).map(|k| turn(at(k), at(k + 1))).sum();
    total.abs()
}

/// Seconds before and after, between which rates are taken.
const RATE: f64 = 5.0;

/// Positive while the azimuth grows: the sine of its change, scaled to be a smooth wave.
fn turning(sky: &Sky, seconds: f64) -> f64 {
    let a = sky.direction(Instant::from_seconds(seconds - RATE));
    let b = sky.direction(Instant::from_seconds(seconds + RATE));
    b[0] * a[1] - b[1] * a[0]
}

/// Positive while the sun climbs.
fn climbing(sky: &Sky, seconds: f64) -> f64 {
    let a = sky.direction(Instant::from_seconds(seconds - RATE));
    let b = sky.direction(Instant::from_seconds(seconds + RATE));
    b[2] - a[2]
}

/// Degrees of azimuth from one direction to another, clockwise, -180 to 180.
fn turn(a: [f64; 3], b: [f64; 3]) -> f64 {
    let sine = b[0] * a[1] - b[1] * a[0];
    let cosine = a[0] * b[0] + a[1] * b[1];
    sine.atan2(cosine).to_degrees()
}
