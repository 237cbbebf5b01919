//! Whether lines cross.

use super::LEAST_EDGE;
use crate::polygon::edges;

/// Whether any two edges of some rings cross.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Answer {
    /// None do; they may touch.
    No,
    /// Some do.
    Yes,
    /// It would take too long to tell.
    TooMuch,
}

/// So many pairs are tried: 0.2 s or so. An outline of a building needs a few for each edge.
const MOST_TRIED: u64 = 50_000_000;

/// Edges in the order in which they begin, along the longer side of the box around all; each is held
/// against those that still run (Shamos and Hoey 1976, without their order across: outlines are
/// short).
pub(super) fn any_crossing(rings: &[Vec<[f64; 2]>]) -> Answer {
    // Seen in a mirror, lines cross where they did.
    let is_wide = extent(rings, 0) >= extent(rings, 1);
    let seen = |[x, y]: [f64; 2]| if is_wide { [x, y] } else { [y, x] };
    let mut all: Vec<[[f64; 2]; 2]> = rings
        .iter()
        .flat_map(|ring| edges(ring.iter().copied().map(seen)))
        .map(|(a, b)| if a[0] <= b[0] { [a, b] } else { [b, a] })
        .collect();
    all.sort_by(|s, t| s[0][0].total_cmp(&t[0][0]));
    let mut running: Vec<[[f64; 2]; 2]> = Vec::new();
    let mut tried = 0;
    for edge in all {
        running.retain(|other| other[1][0] >= edge[0][0]);
        tried += running.len() as u64;
        if running.iter().any(|other| do_cross(edge, *other)) {
            return Answer::Yes;
        }
        if tried > MOST_TRIED {
            return Answer::TooMuch;
        }
        running.push(edge);
    }
    Answer::No
}

fn extent(rings: &[Vec<[f64; 2]>], axis: usize) -> f64 {
    let nothing = [f64::INFINITY, f64::NEG_INFINITY];
    let [low, high] = (rings.iter().flatten()).fold(nothing, |[low, high], p| {
        [low.min(p[axis]), high.max(p[axis])]
    });
    high - low
}

/// Whether each of two edges has its ends to either side of the other, and not just by rounding.
fn do_cross([a, b]: [[f64; 2]; 2], [c, d]: [[f64; 2]; 2]) -> bool {
    let apart = a[1].max(b[1]) < c[1].min(d[1]) || c[1].max(d[1]) < a[1].min(b[1]);
    !apart && splits(a, b, c, d) && splits(c, d, a, b)
}

/// Whether `c` and `d` lie to either side of the line from `a` to `b`.
fn splits(a: [f64; 2], b: [f64; 2], c: [f64; 2], d: [f64; 2]) -> bool {
    let along = [b[0] - a[0], b[1] - a[1]];
    let side = |p: [f64; 2]| along[0] * (p[1] - a[1]) - along[1] * (p[0] - a[0]);
    let least = LEAST_EDGE * along[0].hypot(along[1]);
    let (c, d) = (side(c), side(d));
    c.min(d) < -least && c.max(d) > least
}
