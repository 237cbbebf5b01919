//! What every sampler is believed to do.

use super::*;

const SEED: u64 = 7;

fn points(kind: SamplerKind, pixel: [u32; 2], count: u32) -> Vec<[f32; 2]> {
    (0..count)
        .map(|index| {
            Numbers::new(kind, SEED, pixel)
                .sample(index)
                .pair(Dimension::Pixel)
        })
        .collect()
}

/// The boxes of a grid with `2ᵃ × 2ᵇ` boxes that hold each of some points.
fn boxes(points: &[[f32; 2]], a: u32, b: u32) -> impl Iterator<Item = usize> {
    let (columns, rows) = (1_usize << a, 1_usize << b);
    points.iter().map(move |&[x, y]| {
        let column = (x * columns as f32) as usize;
        let row = (y * rows as f32) as usize;
        row * columns + column
    })
}

#[test]
fn points_are_uniform_by_the_chi_square_test() {
    for &kind in SamplerKind::ALL {
        for pixel in [[0, 0], [1, 0], [4095, 77]] {
            let points = points(kind, pixel, 1 << 14);
            let mut counts = [0_f64; 256];
            boxes(&points, 4, 4).for_each(|i| counts[i] += 1.0);
            let expected = points.len() as f64 / 256.0;
            let chi_square: f64 = counts
                .iter()
                .map(|c| (c - expected) * (c - expected) / expected)
                .sum();
            // 255 degrees of freedom: the mean is 255, the standard deviation √510; this is 4 of
            // them away.
            assert!(chi_square < 345.0, "{kind:?} {pixel:?}: {chi_square}");
        }
    }
}

#[test]
fn pixels_among_themselves_are_uniform_too() {
    for &kind in SamplerKind::ALL {
        for index in [0, 1, 5] {
            let mut counts = [0_f64; 64];
            let firsts: Vec<_> = (0..1 << 12)
                .map(|i| {
                    Numbers::new(kind, SEED, [i % 64, i / 64])
                        .sample(index)
                        .pair(Dimension::Pixel)
                })
                .collect();
            boxes(&firsts, 3, 3).for_each(|i| counts[i] += 1.0);
            let chi_square: f64 = counts.iter().map(|c| (c - 64.0) * (c - 64.0) / 64.0).sum();
            // 63 degrees of freedom: 63 + 4 √126.
            assert!(chi_square < 108.0, "{kind:?} {index}: {chi_square}");
        }
    }
}

#[test]
fn each_run_of_a_power_of_two_sobol_points_fills_every_elementary_interval() {
    for pixel in [[0, 0], [3, 9], [640, 479]] {
        let all = points(SamplerKind::Sobol, pixel, 1 << 8);
        for k in 0..=8 {
            for run in all.chunks(1 << k) {
                for a in 0..=k {
                    let mut seen = vec![false; 1 << k];
                    for i in boxes(run, a, k - a) {
                        assert!(!seen[i], "two of 2^{k} points in one box of 2^{a} columns");
                        seen[i] = true;
                    }
                }
            }
        }
    }
}

#[test]
fn numbers_are_below_one_and_depend_on_everything_they_are_given() {
    for &kind in SamplerKind::ALL {
        let pair = |seed, pixel, index, dimension| {
            let pair = Numbers::new(kind, seed, pixel)
                .sample(index)
                .pair(dimension);
            assert!(pair.iter().all(|x| (0.0..1.0).contains(x)));
            pair
        };
        let first = pair(1, [2, 3], 4, Dimension::Pixel);
        assert_eq!(first, pair(1, [2, 3], 4, Dimension::Pixel));
        assert_ne!(first, pair(2, [2, 3], 4, Dimension::Pixel));
        assert_ne!(first, pair(1, [3, 2], 4, Dimension::Pixel));
        assert_ne!(first, pair(1, [2, 3], 5, Dimension::Pixel));
        assert_ne!(first, pair(1, [2, 3], 4, Dimension::Lens));
        pair(u64::MAX, [u32::MAX; 2], u32::MAX, Dimension::Hemisphere);
    }
}

/// Pearson's correlation.
fn correlation(pairs: &[(f32, f32)]) -> f64 {
    let n = pairs.len() as f64;
    let wide = || pairs.iter().map(|&(a, b)| (f64::from(a), f64::from(b)));
    let (ma, mb) = wide().fold((0.0, 0.0), |(sa, sb), (a, b)| (sa + a / n, sb + b / n));
    let (mut ab, mut aa, mut bb) = (0.0, 0.0, 0.0);
    for (a, b) in wide() {
        ab += (a - ma) * (b - mb);
        aa += (a - ma) * (a - ma);
        bb += (b - mb) * (b - mb);
    }
    ab / (aa * bb).sqrt()
}

#[test]
fn neighbours_and_dimensions_know_nothing_of_one_another() {
    let count = 1 << 12;
    // Four standard deviations of the correlation of independent numbers.
    let limit = 4.0 / f64::from(count).sqrt();
    for &kind in SamplerKind::ALL {
        let sample = |x: u32, index| Numbers::new(kind, SEED, [x, 11]).sample(index);
        let across_pixels: Vec<_> = (0..count)
            .map(|x| {
                let at = |x| sample(x, 0).pair(Dimension::Pixel)[0];
                (at(x), at(x + 1))
            })
            .collect();
        let across_dimensions: Vec<_> = (0..count)
            .map(|index| {
                let sample = sample(5, index);
                let [u, _] = sample.pair(Dimension::Pixel);
                let [_, v] = sample.pair(Dimension::Hemisphere);
                (u, v)
            })
            .collect();
        for pairs in [across_pixels, across_dimensions] {
            let correlation = correlation(&pairs);
            assert!(correlation.abs() < limit, "{kind:?}: {correlation}");
        }
    }
}
