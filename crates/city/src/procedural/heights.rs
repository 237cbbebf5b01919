//! How high the buildings of a city are.

use super::lots::Lot;
use super::random::Random;

/// Which share of the buildings is at most so many metres high; straight in between.
const QUANTILES: [(f64, f64); 7] = [
    (0.0, 8.0),
    (0.1, 12.0),
    (0.5, 23.0),
    (0.9, 61.0),
    (0.99, 142.0),
    (0.999, 190.0),
    (1.0, 250.0),
];

/// The height of the building on each lot. Wide lots, those on avenues and those in the middle of the
/// city tend to have the higher ones; how many there are of each is as the quantiles say.
pub(super) fn assigned(lots: &[Lot], random: &mut Random) -> Vec<f64> {
    let corner = |of: fn(f64, f64) -> f64, start: f64| {
        lots.iter().fold([start; 2], |most, lot| {
            let middle = lot.whole.middle();
            [0, 1].map(|k| of(most[k], middle[k]))
        })
    };
    let (low, high) = (
        corner(f64::min, f64::INFINITY),
        corner(f64::max, f64::NEG_INFINITY),
    );
    let wishes: Vec<f64> = (lots.iter())
        .map(|lot| {
            let middle = lot.whole.middle();
            let away =
                [0, 1].map(|k| (2.0 * middle[k] - low[k] - high[k]) / (high[k] - low[k] + 1.0));
            let near = 1.0 - (away[0] * away[0] + away[1] * away[1]).min(1.0);
            let wide = (lot.width / 30.0).min(1.0);
            let avenue = if lot.on_avenue { 0.15 } else { 0.0 };
            0.9 * wide + avenue + 0.25 * near + random.unit()
        })
        .collect();
    let mut order: Vec<usize> = (0..lots.len()).collect();
    order.sort_by(|&a, &b| wishes[a].total_cmp(&wishes[b]).then(a.cmp(&b)));
    let mut heights = vec![0.0; lots.len()];
    let last = (lots.len().max(2) - 1) as f64;
    for (rank, &lot) in order.iter().enumerate() {
        heights[lot] = quantile(rank as f64 / last);
    }
    heights
}

fn quantile(share: f64) -> f64 {
    let next = QUANTILES.partition_point(|&(at, _)| at < share);
    let (to, high) = QUANTILES[next.clamp(1, QUANTILES.len() - 1)];
    let (from, low) = QUANTILES[next.clamp(1, QUANTILES.len() - 1) - 1];
    low + (high - low) * (share - from) / (to - from)
}
