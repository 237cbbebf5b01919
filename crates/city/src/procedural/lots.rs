//! Blocks, cut into lots.

use super::random::Random;

/// The narrowest and the widest lot, metres along its front.
pub(super) const NARROWEST: f64 = 6.0;
pub(super) const WIDEST: f64 = 60.0;

/// A piece of a block, and the part of it that is built on. Metres in the grid: x along the streets, y
/// along the avenues.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lot {
    /// What belongs to it.
    pub(super) whole: Rectangle,
    /// Where the building stands: all of the front, and less than all of the depth.
    pub(super) built: Rectangle,
    /// Metres along the front.
    pub(super) width: f64,
    /// Whether the front is on an avenue.
    pub(super) on_avenue: bool,
}

/// From a lowest corner to a highest one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rectangle {
    pub(super) low: [f64; 2],
    pub(super) high: [f64; 2],
}

impl Rectangle {
    pub(super) fn size(&self) -> [f64; 2] {
        [0, 1].map(|k| self.high[k] - self.low[k])
    }

    pub(super) fn middle(&self) -> [f64; 2] {
        [0, 1].map(|k| 0.5 * (self.low[k] + self.high[k]))
    }

    /// Without so many metres at all four sides.
    pub(super) fn shrunk(&self, by: f64) -> Self {
        Self {
            low: self.low.map(|x| x + by),
            high: self.high.map(|x| x - by),
        }
    }
}

/// How a block is cut: at both ends lots along the avenue, between them two rows along the streets,
/// back to back.
#[derive(Clone, Copy, Debug)]
pub(super) struct BlockPlan {
    /// Metres along the streets, and along the avenues.
    pub(super) size: [f64; 2],
    /// Metres that the lots along an avenue are deep.
    pub(super) end: f64,
    /// Times 12 m, the mean width of lots on the streets; those on the avenues are twice as wide.
    pub(super) width: f64,
}

impl BlockPlan {
    /// The lots of a block with its lowest corner there.
    pub(super) fn cut(&self, corner: [f64; 2], random: &mut Random, lots: &mut Vec<Lot>) {
        let [x0, y0] = corner;
        let [x1, y1] = [x0 + self.size[0], y0 + self.size[1]];
        let inner = [x0 + self.end, x1 - self.end];
        for (outside, inside) in [(x0, inner[0]), (x1, inner[1])] {
            for front in fronts(y0, y1, 2.0 * self.width, random) {
                let share = random.between(0.75, 1.0);
                lots.push(lot(1, front, [outside, inside], share));
            }
        }
        let middle = 0.5 * (y0 + y1);
        for outside in [y0, y1] {
            for front in fronts(inner[0], inner[1], self.width, random) {
                // Wide buildings are deep ones.
                let least = if front[1] - front[0] < 16.0 {
                    0.5
                } else {
                    0.65
                };
                let share = random.between(least, least + 0.25);
                lots.push(lot(0, front, [outside, middle], share));
            }
        }
    }
}

/// A lot with its front along an axis, reaching from the outside of the block to its inside.
fn lot(along: usize, front: [f64; 2], [outside, inside]: [f64; 2], built_share: f64) -> Lot {
    let back = outside + built_share * (inside - outside);
    let rectangle = |back: f64| {
        let mut rectangle = Rectangle {
            low: [outside.min(back); 2],
            high: [outside.max(back); 2],
        };
        rectangle.low[along] = front[0];
        rectangle.high[along] = front[1];
        rectangle
    };
    Lot {
        whole: rectangle(inside),
        built: rectangle(back),
        width: front[1] - front[0],
        on_avenue: along == 1,
    }
}

/// Cuts a stretch into fronts, in the mean `scale` times 12 m wide.
fn fronts(from: f64, to: f64, scale: f64, random: &mut Random) -> Vec<[f64; 2]> {
    let mut fronts = Vec::new();
    let mut at = from;
    while at < to {
        let rest = to - at;
        let wanted = (scale * width(random)).min(WIDEST);
        let next = if rest - wanted >= NARROWEST {
            at + wanted
        } else if rest <= WIDEST {
            to
        } else {
            at + 0.5 * rest
        };
        fronts.push([at, next]);
        at = next;
    }
    fronts
}

/// Most are townhouses, some take the place of several.
fn width(random: &mut Random) -> f64 {
    let (low, high) = match random.unit() {
        kind if kind < 0.60 => (NARROWEST, 9.0),
        kind if kind < 0.85 => (9.0, 16.0),
        kind if kind < 0.96 => (16.0, 30.0),
        _ => (30.0, WIDEST),
    };
    random.between(low, high)
}
