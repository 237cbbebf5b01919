//! Days, and those that stand for others.

use ombra_sun::Sheet;

/// A day on which the sun counts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Day<'a> {
    pub(super) sheets: &'a [Sheet],
    /// How long it counts.
    pub(super) seconds: f64,
}

impl<'a> Day<'a> {
    /// `None` if it does not count.
    pub(super) fn new(sheets: &'a [Sheet]) -> Option<Self> {
        let seconds: f64 = sheets.iter().map(|sheet| sheet.span().seconds()).sum();
        (seconds > 0.0).then_some(Self { sheets, seconds })
    }

    /// When it begins, in seconds as [`Instant`](ombra_sun::Instant) counts them.
    fn start(&self) -> f64 {
        let starts = self.sheets.iter().map(|sheet| sheet.span().start.seconds());
        starts.fold(f64::INFINITY, f64::min)
    }

    /// The sine of the angle between the sun's way and the plane in which it goes about the pole at an equinox, up to
    /// its sign, which is that of all days.
    fn declination(&self) -> f64 {
        let lasting = |sheet: &&Sheet| sheet.span().seconds();
        let longest = |a: &&Sheet, b: &&Sheet| lasting(a).total_cmp(&lasting(b));
        let Some(sheet) = self.sheets.iter().max_by(longest) else {
            return 0.0;
        };
        let arcs = sheet.arcs();
        let (from, to) = (arcs[0].from, arcs[arcs.len() - 1].to);
        let middle = match arcs.len() / 2 {
            0 => arcs[0].direction(0.5),
            half => arcs[half].from,
        };
        // Across the circle through three places of its way lies the pole.
        let [a, b] = [[from, middle], [middle, to]].map(|[p, q]| [0, 1, 2].map(|i| q[i] - p[i]));
        let pole = [
            a[1] * b[2] - a[2] * b[1],
            a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0],
        ];
        let dot = |p: [f64; 3], q: [f64; 3]| (0..3).map(|i| p[i] * q[i]).sum::<f64>();
        dot(pole, from) / dot(pole, pole).sqrt().max(f64::MIN_POSITIVE)
    }
}

/// A day that stands for those around it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Taken {
    pub(super) day: usize,
    /// What its seconds count times.
    pub(super) times: f64,
    /// The times of it and the day taken before it, a quarter of both: so often it is unknown which of the two
    /// is right, if each is right for the days nearer to it.
    between: f64,
}

impl Taken {
    /// How many seconds are in question between the day taken before it and this one.
    pub(super) fn unknown(&self, before: f64, own: f64) -> f64 {
        self.between * (own - before)
    }

    /// Of days by their index, in order: each stands for those that are nearer to it than to others.
    pub(super) fn some(days: &[Day<'_>], which: &[usize]) -> Vec<Self> {
        let mut taken: Vec<Self> = Vec::with_capacity(which.len());
        let mut begin = 0;
        for (k, &day) in which.iter().enumerate() {
            let next = which.get(k + 1);
            let end = next.map_or(days.len(), |next| (day + next).div_ceil(2));
            // In all as long as the days that it stands for: where the sun counts longer, so does the shadow.
            let sum: f64 = days[begin..end].iter().map(|day| day.seconds).sum();
            let times = sum / days[day].seconds;
            let before = taken.last().map_or(0.0, |before| before.times);
            let between = 0.25 * (before + times);
            taken.push(Self {
                day,
                times,
                between,
            });
            begin = end;
        }
        taken
    }
}

/// The first and the last day and those between at which the sun turns back, north or south. What is in the
/// sun's way on any other day lies between what is on the one before and the one after: but for
/// what hangs in the air, a higher sun throws less shadow in each direction.
pub(super) fn turning(days: &[Day<'_>]) -> Vec<usize> {
    /// Nearer to one another than this the sun does not turn, in seconds: it was rounding.
    const APART: f64 = 60.0 * 86_400.0;
    let apart = |a: usize, b: usize| days[b].start() - days[a].start();
    let declination: Vec<f64> = days.iter().map(Day::declination).collect();
    let mut turning = vec![0];
    for (k, near) in declination.windows(3).enumerate() {
        let is_turn = (near[1] - near[0]) * (near[2] - near[1]) <= 0.0;
        let is_first = turning.len() == 1;
        if is_turn && (is_first || apart(turning[turning.len() - 1], k + 1) > APART) {
            turning.push(k + 1);
        }
    }
    if turning[turning.len() - 1] + 1 < days.len() {
        turning.push(days.len() - 1);
    }
    turning
}

/// Days evenly between those at which the sun turns, which are among them: about so many for all. Where the sun comes back
/// they lie between those of its way there, so that it is seen at as many heights as there are days; `shift` moves
/// all, 0 to 1 of a step.
pub(super) fn evenly(turning: &[usize], count: usize, shift: f64) -> Vec<usize> {
    let (first, last) = (turning[0], turning[turning.len() - 1]);
    let step = (last - first) as f64 / count.max(1) as f64;
    let mut which = vec![first];
    for (k, ends) in turning.windows(2).enumerate() {
        let length = (ends[1] - ends[0]) as f64;
        let parts = (length / step).round().max(1.0);
        let own = (shift + 0.5 * (k % 2) as f64).fract();
        for part in 0..parts as usize {
            let day = ends[0] + ((part as f64 + own) * length / parts).round() as usize;
            if day > which[which.len() - 1] && day < ends[1] {
                which.push(day);
            }
        }
        which.push(ends[1]);
    }
    which
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_that_are_taken_stand_for_all_days() {
        for all in 2..80_usize {
            let days: Vec<Day<'_>> = (0..all)
                .map(|k| Day {
                    sheets: &[],
                    seconds: 1000.0 + k as f64,
                })
                .collect();
            let total: f64 = days.iter().map(|day| day.seconds).sum();
            for turning in [vec![0, all - 1], vec![0, all / 2, all - 1]] {
                if turning.windows(2).any(|pair| pair[0] == pair[1]) {
                    continue;
                }
                for count in 1..all {
                    for shift in [0.0, 0.25, 0.5, 0.75] {
                        let which = evenly(&turning, count, shift);
                        assert!(which.windows(2).all(|pair| pair[0] < pair[1]));
                        assert!(turning.iter().all(|day| which.contains(day)));
                        let taken = Taken::some(&days, &which);
                        let sum: f64 = (taken.iter())
                            .map(|own| own.times * days[own.day].seconds)
                            .sum();
                        assert!((sum - total).abs() < 1e-6 * total, "{all} {which:?}");
                        assert!(taken.iter().all(|own| own.times > 0.0));
                    }
                }
            }
        }
    }
}
