//! From a number to a place along an axis, and back to numbers that are round.

use crate::numbers::short;

/// How numbers are laid out along an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Scale {
    /// From 0 to a number above it.
    Linear(f64),
    /// Between two numbers above 0: equal ways are equal ratios.
    Log(f64, f64),
}

impl Scale {
    /// From 0 to a little over the largest.
    pub(crate) fn linear(numbers: impl IntoIterator<Item = f64>) -> Self {
        let most = numbers
            .into_iter()
            .filter(|n| n.is_finite())
            .fold(0.0, f64::max);
        Self::Linear(if most > 0.0 { most * 1.06 } else { 1.0 })
    }

    /// From a little below the smallest to a little over the largest, a factor of two at least.
    pub(crate) fn log(numbers: impl IntoIterator<Item = f64>) -> Self {
        let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
        for number in numbers.into_iter().filter(|n| n.is_finite() && *n > 0.0) {
            least = least.min(number);
            most = most.max(number);
        }
        if most == 0.0 {
            return Self::Log(0.5, 2.0);
        }
        let spare = (2.0 / (most / least))
            .sqrt()
            .max((most / least).powf(0.08))
            .max(1.06);
        Self::Log(least / spare, most * spare)
    }

    /// From 0 to 1.
    pub(crate) fn place(self, number: f64) -> f64 {
        match self {
            Self::Linear(most) => number / most,
            Self::Log(least, most) => (number / least).ln() / (most / least).ln(),
        }
    }

    /// Round numbers within, six or so.
    pub(crate) fn ticks(self) -> Vec<f64> {
        match self {
            Self::Linear(most) => {
                let rough = most / 5.0;
                let ten = 10_f64.powf(rough.log10().floor());
                let step = [1.0, 2.0, 5.0, 10.0].map(|k| k * ten);
                let step = step
                    .into_iter()
                    .find(|&step| step >= rough)
                    .unwrap_or(rough);
                let count = (most / step).floor() as usize;
                (0..=count).map(|i| i as f64 * step).collect()
            }
            Self::Log(least, most) => {
                let finest: &[f64] = &[1.0, 1.5, 2.0, 3.0, 5.0, 7.0];
                let steps: [&[f64]; 3] = [finest, &[1.0, 2.0, 5.0], &[1.0]];
                let within = |digits: &[f64]| -> Vec<f64> {
                    let tens = least.log10().floor() as i32..=most.log10().ceil() as i32;
                    let all = tens
                        .flat_map(|ten| digits.iter().map(move |digit| digit * 10_f64.powi(ten)));
                    all.filter(|n| (least..=most).contains(n)).collect()
                };
                let all = steps.map(within);
                let few = all.iter().find(|ticks| ticks.len() <= 7);
                few.unwrap_or(&all[2]).clone()
            }
        }
    }
}

/// A tick as text, without zeros that say nothing.
pub(super) fn label(tick: f64) -> String {
    let text = short(tick);
    if text.contains('.') && !text.contains('e') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_within() {
        assert_eq!(
            Scale::Linear(1.0).ticks(),
            [0.0, 0.2, 0.4, 0.6000000000000001, 0.8, 1.0]
        );
        assert_eq!(
            Scale::Log(8.0, 1200.0).ticks(),
            [10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0]
        );
        for scale in [
            Scale::Log(0.9, 1.3),
            Scale::Log(1e-3, 1e9),
            Scale::Linear(1e-9),
        ] {
            let ticks = scale.ticks();
            assert!(!ticks.is_empty(), "{scale:?}");
            assert!(
                ticks.iter().all(|&t| (0.0..=1.0).contains(&scale.place(t))),
                "{scale:?}"
            );
        }
    }

    #[test]
    fn a_tick_keeps_the_zeros_that_count() {
        for (tick, text) in [
            (100.0, "100"),
            (0.5, "0.5"),
            (2.0, "2"),
            (0.0, "0"),
            (1e-4, "0.0001"),
        ] {
            assert_eq!(label(tick), text);
        }
    }

    #[test]
    fn nothing_and_one_number_have_a_scale_too() {
        assert_eq!(Scale::linear([]), Scale::Linear(1.0));
        assert_eq!(Scale::log([]), Scale::Log(0.5, 2.0));
        let one = Scale::log([3.0]);
        assert!((one.place(3.0) - 0.5).abs() < 1e-9, "{one:?}");
    }
}
