//! Places of many pixels, of which few are reckoned.

/// Where some pixels lie, by bilinear interpolation between every so many of them: projections bend so
/// little over 50 m that the rest is below a tenth of a millimetre, and to project costs a microsecond.
pub(super) struct Lattice {
    step: u32,
    across: usize,
    nodes: Vec<[f64; 2]>,
}

impl Lattice {
    /// For pixels from 0 up to, but not including, `size`.
    pub(super) fn new(
        [width, height]: [u32; 2],
        step: u32,
        place: impl Fn([f64; 2]) -> [f64; 2],
    ) -> Self {
        let [across, down] = [width, height].map(|n| n.div_ceil(step) + 1);
        let node = |row: u32, column: u32| place([column, row].map(|k| f64::from(k * step)));
        let nodes = (0..down).flat_map(|row| (0..across).map(move |column| (row, column)));
        Self {
            step,
            across: across as usize,
            nodes: nodes.map(|(row, column)| node(row, column)).collect(),
        }
    }

    pub(super) fn at(&self, pixel: [u32; 2]) -> [f64; 2] {
        let [column, row] = pixel.map(|k| (k / self.step) as usize);
        let [s, t] = pixel.map(|k| f64::from(k % self.step) / f64::from(self.step));
        let node =
            |down: usize, right: usize| self.nodes[(row + down) * self.across + column + right];
        let [a, b, c, d] = [node(0, 0), node(0, 1), node(1, 0), node(1, 1)];
        [0, 1]
            .map(|k| (1.0 - t) * ((1.0 - s) * a[k] + s * b[k]) + t * ((1.0 - s) * c[k] + s * d[k]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_bilinear_comes_out_and_what_bends_is_near() {
        let bilinear = |[u, v]: [f64; 2]| [2.0 * u + 3.0 * v + 1.0, u * v];
        for step in [1, 3, 7] {
            let lattice = Lattice::new([10, 8], step, bilinear);
            for pixel in [[0, 0], [9, 7], [4, 5], [7, 0]] {
                let (found, expected) = (lattice.at(pixel), bilinear(pixel.map(f64::from)));
                assert!((0..2).all(|k| (found[k] - expected[k]).abs() < 1e-9));
            }
        }
        assert_eq!(Lattice::new([1, 1], 50, bilinear).at([0, 0]), [1.0, 0.0]);
    }
}
