//! What of each arc is covered, for each place of a tile: a union of stretches without sorting.
//!
//! Most stretches touch what is covered already: neighbouring walls share an edge. So of each arc
//! a covered beginning and a covered end are kept, and what touches neither waits in a list until it does. So
//! it is known at once when an arc is covered wholly, and what is behind needs not be looked at.

use crate::tile::PLACES;
use crate::way::MOST;

/// Shares of an arc's time that lie no further apart than this are joined: walls that share an edge
/// leave gaps by rounding, of about 1e-7. Of an arc of twenty minutes this is a millisecond.
pub(crate) const JOIN: f32 = 1e-6;

/// A stretch that touches neither the beginning nor the end.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Piece {
    place: usize,
    from: f32,
    to: f32,
}

/// The cover of all arcs.
#[derive(Debug)]
#[repr(C, align(64))]
pub(crate) struct Cover {
    /// By arc and place: covered from 0 to here.
    pub(crate) before: [[f32; PLACES]; MOST],
    /// And from here to 1.
    pub(crate) after: [[f32; PLACES]; MOST],
    /// Bit k: arc k is covered wholly for all places, or there is none.
    pub(crate) full: u64,
    /// Bit k: arc k has pieces.
    pub(crate) in_pieces: u64,
    /// By arc, of each place disjoint.
    pieces: [Vec<Piece>; MOST],
}

impl Cover {
    pub(crate) fn new() -> Self {
        Self {
            before: [[0.0; PLACES]; MOST],
            after: [[1.0; PLACES]; MOST],
            full: 0,
            in_pieces: 0,
            pieces: [const { Vec::new() }; MOST],
        }
    }

    /// Nothing of so many arcs is covered.
    pub(crate) fn clear(&mut self, arcs: usize) {
        self.before[..arcs].fill([0.0; PLACES]);
        self.after[..arcs].fill([1.0; PLACES]);
        self.full = if arcs < MOST { u64::MAX << arcs } else { 0 };
        while self.in_pieces != 0 {
            self.pieces[self.in_pieces.trailing_zeros() as usize].clear();
            self.in_pieces &= self.in_pieces - 1;
        }
    }

    /// Adds a stretch of one place's arc: what a kernel does for all places at once.
    pub(crate) fn add(&mut self, arc: usize, place: usize, from: f32, to: f32) {
        let (before, after) = (&mut self.before[arc][place], &mut self.after[arc][place]);
        if from <= *before + JOIN {
            *before = before.max(to);
        } else if *after <= to + JOIN {
            *after = after.min(from);
        } else {
            self.add_piece(arc, place, from, to);
        }
        self.settle(arc);
    }

    /// Adds a stretch that touches neither the beginning nor the end.
    pub(crate) fn add_piece(&mut self, arc: usize, place: usize, mut from: f32, mut to: f32) {
        let pieces = &mut self.pieces[arc];
        let mut k = 0;
        while k < pieces.len() {
            let own = pieces[k];
            if own.place == place && own.from <= to + JOIN && from <= own.to + JOIN {
                (from, to) = (from.min(own.from), to.max(own.to));
                pieces.swap_remove(k);
            } else {
                k += 1;
            }
        }
        pieces.push(Piece { place, from, to });
        self.in_pieces |= 1 << arc;
    }

    /// Joins pieces to what has grown up to them.
    #[inline(never)]
    pub(crate) fn settle(&mut self, arc: usize) {
        let (before, after) = (&mut self.before[arc], &mut self.after[arc]);
        let mut grown = true;
        while grown {
            grown = false;
            self.pieces[arc].retain(|piece| {
                let (before, after) = (&mut before[piece.place], &mut after[piece.place]);
                if piece.from <= *before + JOIN {
                    *before = before.max(piece.to);
                } else if *after <= piece.to + JOIN {
                    *after = after.min(piece.from);
                } else {
                    return true;
                }
                grown = true;
                false
            });
        }
        if self.pieces[arc].is_empty() {
            self.in_pieces &= !(1 << arc);
        }
    }

    /// Adds to the seconds of each place what of the arcs is covered, whose whole lengths are given.
    ///
    /// For all places at once: this is done for each arc of each tile, covered or not.
    #[inline(always)]
    pub(crate) fn add_seconds(&self, lengths: &[f64], seconds: &mut [f64; PLACES]) {
        let rows = self.before.iter().zip(&self.after);
        let mut sums = *seconds;
        for (&length, (before, after)) in lengths.iter().zip(rows) {
            for place in 0..PLACES {
                let (before, after) = (before[place], after[place]);
                let open = f64::from(after) - f64::from(before);
                let share = if before + JOIN < after {
                    1.0 - open
                } else {
                    1.0
                };
                sums[place] += length * share;
            }
        }
        *seconds = sums;
        let mut left = self.in_pieces;
        while left != 0 {
            let arc = left.trailing_zeros() as usize;
            left &= left - 1;
            self.add_pieces(arc, lengths[arc], seconds);
        }
    }

    /// Shares are added up before they are multiplied: such sums are exact, so that the order in which pieces came
    /// does not matter.
    #[inline(never)]
    fn add_pieces(&self, arc: usize, length: f64, seconds: &mut [f64; PLACES]) {
        let mut shares = [0.0; PLACES];
        for piece in &self.pieces[arc] {
            let place = piece.place;
            if self.before[arc][place] + JOIN < self.after[arc][place] {
                shares[place] += f64::from(piece.to) - f64::from(piece.from);
            }
        }
        for (seconds, share) in seconds.iter_mut().zip(shares) {
            *seconds += length * share;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is covered of the only arc, for the first place.
    fn stretches(added: &[[f32; 2]]) -> Vec<[f32; 2]> {
        let mut cover = Cover::new();
        cover.clear(1);
        for &[from, to] in added {
            cover.add(0, 0, from, to);
        }
        let (before, after) = (cover.before[0][0], cover.after[0][0]);
        let pieces = cover.pieces[0].iter().map(|piece| [piece.from, piece.to]);
        let mut all: Vec<[f32; 2]> = pieces.collect();
        all.push([0.0, before]);
        all.push([after, 1.0]);
        all.retain(|[from, to]| from < to);
        all.sort_by(|a, b| a[0].total_cmp(&b[0]));
        if after <= before + JOIN {
            all = vec![[0.0, 1.0]];
        }
        let mut seconds = [0.0; PLACES];
        cover.add_seconds(&[60.0], &mut seconds);
        let sum: f64 = all.iter().map(|[from, to]| f64::from(to - from)).sum();
        assert!((seconds[0] - 60.0 * sum).abs() < 1e-4, "{seconds:?} {sum}");
        assert_eq!(seconds[1..], [0.0; PLACES - 1]);
        all
    }

    #[test]
    fn the_order_in_which_stretches_come_does_not_matter() {
        let added = [
            [0.0, 0.1],
            [0.3, 0.4],
            [0.35, 0.5],
            [0.8, 0.9],
            [0.85, 1.0],
            [0.7, 0.81],
        ];
        let expected = [[0.0, 0.1], [0.3, 0.5], [0.7, 1.0]];
        let mut order = [0, 1, 2, 3, 4, 5];
        // Heap's way through all 720 orders.
        let mut counts = [0; 6];
        let mut k = 0;
        while k < 6 {
            assert_eq!(stretches(&order.map(|k| added[k])), expected, "{order:?}");
            while k < 6 && counts[k] >= k {
                counts[k] = 0;
                k += 1;
            }
            if k < 6 {
                order.swap(if k % 2 == 0 { 0 } else { counts[k] }, k);
                counts[k] += 1;
                k = 0;
            }
        }
    }

    #[test]
    fn nothing_covers_nothing_and_all_covers_all() {
        assert!(stretches(&[]).is_empty());
        assert_eq!(stretches(&[[0.0, 1.0]]), [[0.0, 1.0]]);
        assert_eq!(stretches(&[[0.5, 1.0], [0.0, 0.5]]), [[0.0, 1.0]]);
        assert_eq!(
            stretches(&[[0.2, 0.5], [0.1, 0.9], [0.3, 0.4]]),
            [[0.1, 0.9]]
        );
    }

    #[test]
    fn a_gap_that_is_only_rounding_is_closed() {
        let after = 0.5 + 2e-7;
        assert_eq!(stretches(&[[0.25, 0.5], [after, 0.75]]), [[0.25, 0.75]]);
    }
}
