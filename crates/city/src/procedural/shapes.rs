//! Buildings with flat roofs.

use super::grid::Grid;
use super::lots::{Lot, Rectangle};
use super::random::Random;
use crate::building::Part;

/// Metres from which buildings have podium and tower, where the lot is wide enough.
const TOWERS: f64 = 34.0;

/// The parts of the building on a lot.
pub(super) fn building(lot: &Lot, height: f64, grid: &Grid, random: &mut Random) -> Vec<Part> {
    let size = lot.built.size();
    let narrow = size[0].min(size[1]);
    if height >= TOWERS && narrow >= 10.0 && random.happens(0.9) {
        let podium = height * random.between(0.2, 0.6);
        let inset = random.between(0.06, 0.2) * narrow;
        let room = lot.built.shrunk(inset);
        let tower = if narrow >= 16.0 && random.happens(0.08) {
            grid.prism(&octagon(&room), height)
        } else {
            grid.prism(&corners(&room), height)
        };
        return vec![grid.prism(&corners(&lot.built), podium), tower];
    }
    if narrow >= 10.0 && random.happens(0.08) {
        let cut = [(); 2].map(|()| random.between(0.35, 0.6));
        return vec![grid.prism(&l_shape(lot, cut), height)];
    }
    vec![grid.prism(&corners(&lot.built), height)]
}

pub(super) fn corners(of: &Rectangle) -> [[f64; 2]; 4] {
    let ([x0, y0], [x1, y1]) = (of.low, of.high);
    [[x0, y0], [x1, y0], [x1, y1], [x0, y1]]
}

/// The largest regular one in the middle.
pub(super) fn octagon(room: &Rectangle) -> [[f64; 2]; 8] {
    let [x, y] = room.middle();
    let size = room.size();
    let far = 0.5 * size[0].min(size[1]);
    let near = far * (2_f64.sqrt() - 1.0);
    [
        [x + far, y - near],
        [x + far, y + near],
        [x + near, y + far],
        [x - near, y + far],
        [x - far, y + near],
        [x - far, y - near],
        [x - near, y - far],
        [x + near, y - far],
    ]
}

/// Without a piece of the back, at the side of higher coordinates.
fn l_shape(lot: &Lot, cut: [f64; 2]) -> Vec<[f64; 2]> {
    let Rectangle {
        low: [x0, y0],
        high: [x1, y1],
    } = lot.built;
    let [width, depth] = lot.built.size();
    let [dx, dy] = [width * cut[0], depth * cut[1]];
    // The back is where the lot goes on behind the building.
    let front_is_high = lot.whole.low[1] < y0 || lot.whole.low[0] < x0;
    match (lot.on_avenue, front_is_high) {
        (_, false) => vec![
            [x0, y0],
            [x1, y0],
            [x1, y1 - dy],
            [x1 - dx, y1 - dy],
            [x1 - dx, y1],
            [x0, y1],
        ],
        (false, true) => vec![
            [x0, y0],
            [x1 - dx, y0],
            [x1 - dx, y0 + dy],
            [x1, y0 + dy],
            [x1, y1],
            [x0, y1],
        ],
        (true, true) => vec![
            [x0, y0],
            [x1, y0],
            [x1, y1],
            [x0 + dx, y1],
            [x0 + dx, y1 - dy],
            [x0, y1 - dy],
        ],
    }
}
