//! When a slow wave changes its sign.
//!
//! All that is asked of the sun here - its altitude against a limit, whether it climbs, which way
//! it turns - is close to a sine of one wave a day. So samples two hours apart, the extremes
//! between them and a bracketing search find every change of sign.

/// Seconds between samples, at most.
const STEP: f64 = 7200.0;
/// Seconds between the two sides of a crossing, at most.
const WIDTH: f64 = 1e-4;
/// Seconds to which an extreme is found that might reach over zero and back. A wave that is on the
/// other side for less may be missed.
const EXTREME: f64 = 0.5;

/// A change of sign, in seconds: two instants close together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Crossing {
    /// The last instant of the old sign.
    pub(crate) before: f64,
    /// The first of the new.
    pub(crate) after: f64,
    /// Whether the new sign is that of f >= 0.
    pub(crate) rising: bool,
}

/// All changes of sign of `f` in `from..=to`, in order. Zero counts as positive.
pub(crate) fn crossings(f: impl Fn(f64) -> f64, from: f64, to: f64) -> Vec<Crossing> {
    if !(to > from) {
        return Vec::new();
    }
    let samples = samples(&f, from, to);
    samples
        .windows(2)
        .filter(|pair| positive(pair[0].1) != positive(pair[1].1))
        .filter(|pair| pair[1].0 >= from && pair[0].0 <= to)
        .map(|pair| narrow(&f, pair[0], pair[1]))
        .filter(|crossing| crossing.after >= from && crossing.before <= to)
        .collect()
}

fn positive(value: f64) -> bool {
    value >= 0.0
}

/// Values so close together that no two changes of sign lie between neighbours; one more sample on
/// either side, so that an extreme near an end is seen.
fn samples(f: &impl Fn(f64) -> f64, from: f64, to: f64) -> Vec<(f64, f64)> {
    let count = ((to - from) / STEP).ceil().max(1.0);
    let step = (to - from) / count;
    let even: Vec<_> = (-1..=count as i64 + 1)
        .map(|i| from + i as f64 * step)
        .map(|t| (t, f(t)))
        .collect();
    let mut all = vec![even[0]];
    for triple in even.windows(3) {
        let peak = over(f, triple[0], triple[1], triple[2]);
        all.extend(peak.filter(|peak| peak.0 < triple[1].0));
        all.push(triple[1]);
        all.extend(peak.filter(|peak| peak.0 > triple[1].0));
    }
    all.push(even[even.len() - 1]);
    all
}

/// A point of the other sign between `a` and `c`, where `f` at `b` comes closest to zero without
/// reaching it.
fn over(
    f: &impl Fn(f64) -> f64,
    a: (f64, f64),
    b: (f64, f64),
    c: (f64, f64),
) -> Option<(f64, f64)> {
    let up = positive(b.1);
    let (near, far) = (b.1.abs(), a.1.abs().max(c.1.abs()));
    let bulges = positive(a.1) == up
        && positive(c.1) == up
        && near <= a.1.abs()
        && near <= c.1.abs()
        // A parabola through the three goes beyond the middle one by less than this.
        && near <= far - near;
    if !bulges {
        return None;
    }
    // Golden sections towards the least |f|.
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let (mut low, mut high) = (a.0, c.0);
    let mut inner = [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
    let mut value = inner.map(f);
    loop {
        for (t, v) in inner.into_iter().zip(value) {
            if positive(v) != up {
                return Some((t, v));
            }
        }
        if high - low < EXTREME {
            return None;
        }
        if value[0].abs() < value[1].abs() {
            high = inner[1];
            inner = [high - GOLDEN * (high - low), inner[0]];
            value = [f(inner[0]), value[0]];
        } else {
            low = inner[0];
            inner = [inner[1], low + GOLDEN * (high - low)];
            value = [value[1], f(inner[1])];
        }
    }
}

/// The change of sign between two points, to [`WIDTH`].
///
/// I. Oliveira, R. Takahashi, "An Enhancement of the Bisection Method Average Performance
/// Preserving Minmax Optimality", ACM TOMS 47 (2020): never worse than bisection by more than a
/// step, and some eight evaluations where bisection takes 26.
fn narrow(f: &impl Fn(f64) -> f64, low: (f64, f64), high: (f64, f64)) -> Crossing {
    let rising = positive(high.1);
    let ((mut a, mut fa), (mut b, mut fb)) = (low, high);
    let kappa = 0.2 / (b - a);
    let mut reach = WIDTH / 2.0 * 2_f64.powi(((b - a) / WIDTH).log2().ceil() as i32 + 1);
    // Doubles of our centuries are 0.2 µs apart, so that this ends.
    while b - a > WIDTH {
        let half = 0.5 * (a + b);
        let radius = reach - 0.5 * (b - a);
        let secant = if fb == fa {
            half
        } else {
            (fb * a - fa * b) / (fb - fa)
        };
        let truncation = kappa * (b - a) * (b - a);
        let towards = (half - secant).signum();
        let moved = if truncation <= (half - secant).abs() {
            secant + towards * truncation
        } else {
            half
        };
        let t = if (moved - half).abs() <= radius {
            moved
        } else {
            half - towards * radius
        };
        let value = f(t);
        if positive(value) == rising {
            (b, fb) = (t, value);
        } else {
            (a, fa) = (t, value);
        }
        reach *= 0.5;
    }
    Crossing {
        before: a,
        after: b,
        rising,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wave(offset: f64) -> impl Fn(f64) -> f64 {
        move |t: f64| offset + (t / 86_400.0 * std::f64::consts::TAU).sin()
    }

    #[test]
    fn finds_both_crossings_of_a_day() {
        let found = crossings(wave(0.0), -1000.0, 86_400.0 - 2000.0);
        assert_eq!(found.len(), 2);
        assert!(found[0].rising && found[0].before.abs() < 1e-3);
        assert!(!found[1].rising && (found[1].after - 43_200.0).abs() < 1e-3);
        for crossing in found {
            assert!(crossing.after - crossing.before <= WIDTH);
        }
    }

    #[test]
    fn finds_a_grazing_peak_and_leaves_out_none() {
        // Above zero for about 86400/2π · 2·sqrt(2e-9) = 1.2 s around 21600.
        assert_eq!(crossings(wave(-1.0 + 1e-9), 0.0, 86_400.0).len(), 2);
        assert_eq!(crossings(wave(-1.0 - 1e-9), 0.0, 86_400.0).len(), 0);
        assert_eq!(crossings(wave(1.0 - 1e-9), 0.0, 86_400.0).len(), 2);
    }

    #[test]
    fn looks_only_within_the_ends() {
        assert_eq!(crossings(wave(0.0), 100.0, 43_000.0).len(), 0);
        assert_eq!(crossings(wave(0.0), 43_100.0, 43_300.0).len(), 1);
        assert_eq!(crossings(wave(0.0), 5.0, 5.0).len(), 0);
    }
}
