//! Numbers in rows, and fewer of them by averaging.

use std::borrow::Cow;

/// Numbers in rows from the north; NaN where there is none.
pub(super) struct Cells<'a> {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) values: Cow<'a, [f32]>,
}

/// Which blocks of cells have no mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Blank {
    /// Those in which no cell has a number.
    IfAllAre,
    /// Those in which most cells have none, so that buildings keep their size.
    IfMostAre,
}

impl Cells<'_> {
    /// The cells in the middle of blocks of `factor` by `factor`.
    pub(super) fn middles(&self, factor: usize) -> Cells<'static> {
        let factor = factor.max(1);
        let middle = |block: usize, size: usize| (block * factor + factor / 2).min(size - 1);
        let [width, height] = [self.width, self.height].map(|size| size.div_ceil(factor));
        let rows = (0..height).flat_map(|row| (0..width).map(move |column| [column, row]));
        let values = rows.map(|[column, row]| {
            self.values[middle(row, self.height) * self.width + middle(column, self.width)]
        });
        Cells {
            width,
            height,
            values: values.collect(),
        }
    }

    /// The means of blocks of `factor` by `factor` cells, those without a number left out. Blocks at
    /// the east and south edges may be smaller.
    ///
    /// Means are of the cells themselves and never of other means, so that each cell counts alike.
    pub(super) fn means(&self, factor: usize, blank: Blank) -> Cells<'static> {
        let factor = factor.max(1);
        let width = self.width.div_ceil(factor);
        let mut values = Vec::with_capacity(width * self.height.div_ceil(factor));
        for rows in self.values.chunks(self.width * factor) {
            let mut sums = vec![0.0_f64; width];
            let mut counts = vec![0_usize; width];
            for row in rows.chunks_exact(self.width) {
                for (x, block) in row.chunks(factor).enumerate() {
                    for &value in block.iter().filter(|v| !v.is_nan()) {
                        sums[x] += f64::from(value);
                        counts[x] += 1;
                    }
                }
            }
            let block_height = rows.len() / self.width;
            for (x, (&sum, &count)) in sums.iter().zip(&counts).enumerate() {
                let cells = block_height * factor.min(self.width - x * factor);
                let is_blank = count == 0 || (blank == Blank::IfMostAre && 2 * count < cells);
                values.push(if is_blank {
                    f32::NAN
                } else {
                    (sum / count as f64) as f32
                });
            }
        }
        Cells {
            width,
            height: self.height.div_ceil(factor),
            values: values.into(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NO: f32 = f32::NAN;

    fn means(blank: Blank) -> Vec<f32> {
        let cells = Cells {
            width: 3,
            height: 3,
            values: Cow::Borrowed(&[1.0, 2.0, 7.0, NO, 3.0, NO, NO, 4.0, NO]),
        };
        let means = cells.means(2, blank);
        assert_eq!((means.width, means.height), (2, 2));
        means.values.into_owned()
    }

    #[test]
    fn cells_without_a_number_do_not_weigh() {
        let found = means(Blank::IfAllAre);
        assert_eq!(found[..3], [2.0, 7.0, 4.0]);
        assert!(found[3].is_nan());
    }

    #[test]
    fn a_block_that_is_mostly_building_is_building() {
        let cells = Cells {
            width: 2,
            height: 2,
            values: Cow::Borrowed(&[NO, NO, NO, 5.0]),
        };
        assert!(cells.means(2, Blank::IfMostAre).values[0].is_nan());
        assert_eq!(cells.means(2, Blank::IfAllAre).values[0], 5.0);
        assert_eq!(means(Blank::IfMostAre)[..3], [2.0, 7.0, 4.0]);
    }

    #[test]
    fn the_middle_of_a_block_that_is_cut_is_its_last_cell() {
        let cells = Cells {
            width: 5,
            height: 2,
            values: Cow::Borrowed(&[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]),
        };
        let middles = cells.middles(3);
        assert_eq!((middles.width, middles.height), (2, 1));
        assert_eq!(middles.values[..], [6.0, 9.0]);
    }

    #[test]
    fn a_factor_beyond_the_edge_gives_one_cell() {
        let cells = Cells {
            width: 3,
            height: 1,
            values: Cow::Borrowed(&[1.0, 2.0, 6.0]),
        };
        assert_eq!(cells.means(100, Blank::IfAllAre).values[..], [3.0]);
    }
}
