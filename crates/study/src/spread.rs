//! Many numbers in a few: the middle, and how far they spread.

use serde::Serialize;

/// Of measurements, one a round.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Spread {
    /// As many are below as above.
    pub median: f64,
    /// A quarter is below.
    pub lower_quartile: f64,
    /// A quarter is above.
    pub upper_quartile: f64,
    /// The smallest.
    pub least: f64,
    /// The largest.
    pub most: f64,
    /// How many there are.
    pub rounds: usize,
}

impl Spread {
    /// Of some numbers; `None` if there are none.
    #[must_use]
    pub fn of(numbers: &[f64]) -> Option<Self> {
        let mut sorted = numbers.to_vec();
        sorted.sort_by(f64::total_cmp);
        (!sorted.is_empty()).then(|| Self {
            median: quantile(&sorted, 0.5),
            lower_quartile: quantile(&sorted, 0.25),
            upper_quartile: quantile(&sorted, 0.75),
            least: sorted[0],
            most: sorted[sorted.len() - 1],
            rounds: sorted.len(),
        })
    }

    /// Half of what lies between the quartiles, as a share of the median.
    #[must_use]
    pub fn relative(&self) -> f64 {
        (self.upper_quartile - self.lower_quartile) / (2.0 * self.median)
    }
}

/// Of counts, one a ray.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Distribution {
    /// Their sum over their number.
    pub mean: f64,
    /// A quarter is below.
    pub lower_quartile: f64,
    /// As many are below as above.
    pub median: f64,
    /// A quarter is above.
    pub upper_quartile: f64,
    /// The largest.
    pub most: u64,
}

impl Distribution {
    /// Of some counts; all 0 if there are none.
    #[must_use]
    pub fn of(counts: impl IntoIterator<Item = u64>) -> Self {
        let mut sorted: Vec<u64> = counts.into_iter().collect();
        sorted.sort_unstable();
        let numbers: Vec<f64> = sorted.iter().map(|&count| count as f64).collect();
        if numbers.is_empty() {
            return Self {
                mean: 0.0,
                lower_quartile: 0.0,
                median: 0.0,
                upper_quartile: 0.0,
                most: 0,
            };
        }
        Self {
            mean: numbers.iter().sum::<f64>() / numbers.len() as f64,
            lower_quartile: quantile(&numbers, 0.25),
            median: quantile(&numbers, 0.5),
            upper_quartile: quantile(&numbers, 0.75),
            most: sorted[sorted.len() - 1],
        }
    }
}

/// Of sorted numbers, at least one; between neighbours where the place is not a whole number.
fn quantile(sorted: &[f64], share: f64) -> f64 {
    let place = share * (sorted.len() - 1) as f64;
    let (low, high) = (place.floor() as usize, place.ceil() as usize);
    sorted[low] + (sorted[high] - sorted[low]) * (place - place.floor())
}

/// The geometric mean of numbers above 0; `None` of none.
pub(crate) fn geometric_mean(numbers: impl IntoIterator<Item = f64>) -> Option<f64> {
    let logs: Vec<f64> = numbers.into_iter().map(f64::ln).collect();
    let mean = logs.iter().sum::<f64>() / logs.len() as f64;
    mean.is_finite().then(|| mean.exp())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_spread_of_nothing_one_and_many() {
        assert_eq!(Spread::of(&[]), None);
        assert_eq!(Spread::of(&[7.0]).unwrap().relative(), 0.0);
        let spread = Spread::of(&[4.0, 1.0, 3.0, 2.0]).unwrap();
        assert_eq!((spread.median, spread.least, spread.most), (2.5, 1.0, 4.0));
        assert_eq!((spread.lower_quartile, spread.upper_quartile), (1.75, 3.25));
        assert_eq!(spread.rounds, 4);
    }

    #[test]
    fn counts_of_rays_spread_too() {
        let counts = Distribution::of([0, 10, 2]);
        assert_eq!((counts.mean, counts.median, counts.most), (4.0, 2.0, 10));
        assert_eq!(Distribution::of([]).most, 0);
    }

    #[test]
    fn the_geometric_mean_is_that_of_ratios() {
        assert_eq!(geometric_mean([]), None);
        assert!((geometric_mean([2.0, 0.5]).unwrap() - 1.0).abs() < 1e-12);
        assert_eq!(geometric_mean([0.0, 1.0]), None);
    }
}
