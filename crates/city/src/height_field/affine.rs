//! From pixels to a map, and back.

/// x = a·u + b·v + c, y = d·u + e·v + f, and the way back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Affine {
    forth: [f64; 6],
    back: [f64; 4],
}

impl Affine {
    /// `None` if there is no way back.
    pub(crate) fn new(forth: [f64; 6]) -> Option<Self> {
        let [a, b, _, d, e, _] = forth;
        let determinant = a * e - b * d;
        let back = [e, -b, -d, a].map(|x| x / determinant);
        let all = forth.iter().chain(&back);
        (determinant != 0.0 && all.copied().all(f64::is_finite)).then_some(Self { forth, back })
    }

    pub(crate) fn apply(&self, [u, v]: [f64; 2]) -> [f64; 2] {
        let [a, b, c, d, e, f] = self.forth;
        [a * u + b * v + c, d * u + e * v + f]
    }

    pub(crate) fn invert(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [_, _, c, _, _, f] = self.forth;
        let ([x, y], [a, b, d, e]) = ([x - c, y - f], self.back);
        [a * x + b * y, d * x + e * y]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_way_back_leads_to_the_same_place() {
        let turned = Affine::new([3.0, 1.0, 100.0, -1.0, -2.0, 50.0]).unwrap();
        assert_eq!(turned.apply([2.0, 1.0]), [107.0, 46.0]);
        let [u, v] = turned.invert([107.0, 46.0]);
        assert!((u - 2.0).abs() < 1e-12 && (v - 1.0).abs() < 1e-12);
        assert_eq!(Affine::new([1.0, 2.0, 0.0, 2.0, 4.0, 0.0]), None);
        assert_eq!(Affine::new([f64::INFINITY, 0.0, 0.0, 0.0, 1.0, 0.0]), None);
    }
}
