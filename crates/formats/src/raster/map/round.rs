//! Numbers that people count in.

/// 1, 2 or 5 times a power of ten: the largest that is not more than `most`, which is more than 0.
pub(super) fn round_down(most: f64) -> f64 {
    let power = power_of_ten(most);
    // The logarithm may be a hair off at powers of ten.
    let candidates = [0.5, 1.0, 2.0, 5.0, 10.0].map(|f| f * power);
    let fitting = candidates.into_iter().filter(|&c| c <= most * (1.0 + 1e-9));
    fitting.fold(candidates[0], f64::max)
}

/// Steps of 1, 2 or 5 times a power of ten, rising, from a thousandth of `size` to ten times it.
pub(super) fn steps(size: f64) -> impl Iterator<Item = f64> {
    let power = power_of_ten(size);
    let exponents = -3..=1;
    exponents.flat_map(move |e| [1.0, 2.0, 5.0].map(|f| f * power * 10_f64.powi(e)))
}

/// A number with as many decimals as its neighbours at this step need.
pub(super) fn text(number: f64, step: f64) -> String {
    if number.abs() >= 1e7 || number != 0.0 && number.abs() < 1e-4 {
        return format!("{number:e}");
    }
    let decimals = (-step.log10() - 1e-9).ceil().clamp(0.0, 6.0);
    format!("{number:.*}", decimals as usize)
}

fn power_of_ten(size: f64) -> f64 {
    10_f64.powf(size.log10().floor())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn round_numbers_are_one_two_or_five() {
        for (most, expected) in [
            (1.0, 1.0),
            (1.99, 1.0),
            (2.0, 2.0),
            (49.0, 20.0),
            (50.0, 50.0),
            (999.0, 500.0),
            (1000.0, 1000.0),
            (0.07, 0.05),
            (0.001, 0.001),
        ] {
            let found = round_down(most);
            assert!((found / expected - 1.0).abs() < 1e-9, "{most}: {found}");
        }
    }

    #[test]
    fn decimals_are_those_of_the_step() {
        assert_eq!(text(120.0, 20.0), "120");
        assert_eq!(text(0.5, 0.5), "0.5");
        assert_eq!(text(1.0, 0.25), "1.0");
        assert_eq!(text(0.15, 0.05), "0.15");
        assert_eq!(text(0.0, 1e-9), "0.000000");
        assert_eq!(text(2e30, 1e30), "2e30");
    }
}
