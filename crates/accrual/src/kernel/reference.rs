//! What one polygon covers of one arc, seen from one place: the plain way, which vectors are held against and
//! which they leave grazing edges to.

/// How the sun stands to the plane through the place and one edge: at share u of the arc it is on the inner
/// side where `from` (1 − u) + `to` u + `bulge` u (1 − u) is not below 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Side {
    pub(crate) from: f32,
    pub(crate) to: f32,
    pub(crate) bulge: f32,
}

impl Side {
    fn at(&self, u: f32) -> f32 {
        self.from * (1.0 - u) + self.to * u + self.bulge * (u * (1.0 - u))
    }

    /// Where within the arc the sun may change sides.
    fn roots(&self) -> [Option<f32>; 2] {
        let Self { from, to, bulge } = *self;
        let slope = to - from + bulge;
        let square = slope * slope + 4.0 * bulge * from;
        if !(square >= 0.0) {
            return [None; 2];
        }
        // Of −bulge u² + slope u + from = 0, without cancellation.
        let root = square.sqrt().copysign(slope);
        let sum = 0.5 * (slope + root);
        let within = |u: f32| (u > 0.0 && u < 1.0).then_some(u);
        [within(sum / bulge), within(-from / sum)]
    }
}

/// Shows each stretch of the arc where the sun is on the inner side of all edges.
pub(crate) fn covered(sides: &[Side; 4], mut show: impl FnMut(f32, f32)) {
    let mut ends = [1.0_f32; 10];
    ends[0] = 0.0;
    let mut count = 1;
    for root in sides.iter().flat_map(Side::roots).flatten() {
        ends[count] = root;
        count += 1;
    }
    let ends = &mut ends[..=count];
    ends.sort_unstable_by(f32::total_cmp);
    let mut from = None;
    for pair in ends.windows(2) {
        let [a, b] = [pair[0], pair[1]];
        if a == b {
            continue;
        }
        let middle = 0.5 * (a + b);
        let inside = sides.iter().all(|side| side.at(middle) >= 0.0);
        match (inside, from) {
            (true, None) => from = Some(a),
            (false, Some(begun)) => {
                show(begun, a);
                from = None;
            }
            _ => {}
        }
    }
    if let Some(begun) = from {
        show(begun, 1.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stretches(sides: [[f32; 3]; 4]) -> Vec<[f32; 2]> {
        let sides = sides.map(|[from, to, bulge]| Side { from, to, bulge });
        let mut all = Vec::new();
        covered(&sides, |from, to| all.push([from, to]));
        all
    }

    const IN: [f32; 3] = [1.0, 1.0, 0.0];

    #[test]
    fn straight_sides_cut_where_they_are_crossed() {
        assert_eq!(stretches([IN; 4]), [[0.0, 1.0]]);
        assert_eq!(stretches([[1.0, -1.0, 0.0], IN, IN, IN]), [[0.0, 0.5]]);
        assert_eq!(stretches([[-1.0, 3.0, 0.0], IN, IN, IN]), [[0.25, 1.0]]);
        assert_eq!(
            stretches([[-1.0, 3.0, 0.0], [1.0, -1.0, 0.0], IN, IN]),
            [[0.25, 0.5]]
        );
        assert!(stretches([[-1.0, -1.0, 0.0], IN, IN, IN]).is_empty());
        assert!(stretches([[-3.0, 1.0, 0.0], [1.0, -1.0, 0.0], IN, IN]).is_empty());
    }

    #[test]
    fn an_arc_may_graze_a_side() {
        // At u = 1/2 a quarter of the bulge.
        let all = stretches([[-0.1, -0.1, 0.8], IN, IN, IN]);
        assert_eq!(all.len(), 1);
        assert!((all[0][0] + all[0][1] - 1.0).abs() < 1e-6);
        let all = stretches([[0.1, 0.1, -0.8], IN, IN, IN]);
        assert_eq!(all.len(), 2);
        assert_eq!((all[0][0], all[1][1]), (0.0, 1.0));
    }

    #[test]
    fn what_is_no_number_covers_nothing() {
        assert!(stretches([[f32::NAN, 1.0, 0.0], IN, IN, IN]).is_empty());
        assert!(stretches([[1.0, f32::NAN, 0.0], IN, IN, IN]).is_empty());
    }
}
