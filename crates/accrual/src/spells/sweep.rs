//! Whose shadow one place lies in, in each part of an arc, out of what was found before it.
//!
//! What is nearest is laid down first, and what comes later goes behind what lies there already, or before it if it is nearer
//! after all. Once all of the arc lies in the shadow of two and whatever is left is farther away, nothing more matters.

use crate::cover::JOIN;
use crate::kernel::Shown;

/// A part of an arc that lies in one shadow.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    pub(super) from: f32,
    pub(super) to: f32,
    /// The nearest.
    pub(super) owner: u32,
    /// Whether others cover the sun as well.
    pub(super) is_shared: bool,
    /// Which piece is the nearest.
    piece: usize,
}

/// What of the arc one polygon covers.
#[derive(Clone, Copy, Debug)]
struct Piece {
    from: f32,
    to: f32,
    owner: u32,
    /// One over its distance: at the beginning of the arc, at its end, and how much that bulges.
    near: [f32; 3],
    /// No less than that at any time, and no more.
    most: f32,
    least: f32,
}

impl Piece {
    fn new(from: f32, to: f32, owner: u32, near: [f32; 3]) -> Self {
        let mut piece = Self {
            from,
            to,
            owner,
            near,
            most: 0.0,
            least: 0.0,
        };
        let (a, b) = (piece.near(from), piece.near(to));
        let bulge = 0.25 * near[2].abs();
        piece.most = a.max(b) + bulge;
        piece.least = a.min(b) - bulge;
        piece
    }

    /// At a share of the arc's time.
    fn near(&self, share: f32) -> f32 {
        let ([begin, end, bulge], rest) = (self.near, 1.0 - share);
        rest * begin + share * end + share * rest * bulge
    }

    /// Whether it is nearer than another one; of what stands in the same place it is always the same one.
    fn is_before(&self, other: &Self, share: f32) -> bool {
        let (own, others) = (self.near(share), other.near(share));
        own > others || own == others && self.owner < other.owner
    }
}

/// Room for one arc of one place, kept between them.
#[derive(Debug, Default)]
pub(super) struct Sweep {
    /// The nearest first.
    pieces: Vec<Piece>,
    parts: Vec<Part>,
    next: Vec<Part>,
}

impl Sweep {
    /// The parts of the arc for one place of the tile, in order.
    pub(super) fn parts(&mut self, shown: &Shown<'_>, place: usize) -> &[Part] {
        let pieces = &mut self.pieces;
        pieces.clear();
        for (entry, nears) in shown.entries.iter().zip(shown.nears) {
            let record = &shown.records[entry.index as usize];
            let (from, to) = (record.from[place], record.to[place]);
            if to - from > JOIN {
                pieces.push(Piece::new(from, to, entry.owner, nears.of(place)));
            }
        }
        self.lay_all()
    }

    /// Lays the pieces, in whatever order they are.
    fn lay_all(&mut self) -> &[Part] {
        let Self {
            pieces,
            parts,
            next,
        } = self;
        parts.clear();
        pieces.sort_unstable_by(|a, b| b.most.total_cmp(&a.most).then(a.owner.cmp(&b.owner)));
        for (number, piece) in pieces.iter().enumerate() {
            if is_done(parts, pieces, piece.most) {
                break;
            }
            if is_hidden(parts, pieces, piece) {
                continue;
            }
            next.clear();
            lay(pieces, number, parts, next);
            std::mem::swap(parts, next);
        }
        parts
    }
}

/// Whether all of the arc is shared, and what is no nearer than this is behind it.
fn is_done(parts: &[Part], pieces: &[Piece], most: f32) -> bool {
    let mut until = 0.0;
    for part in parts {
        let is_behind = most < pieces[part.piece].least;
        if !(part.is_shared && is_behind && part.from <= until + JOIN) {
            return false;
        }
        until = part.to;
    }
    until + JOIN >= 1.0
}

/// Whether all of the piece is behind what is shared already, so that it changes nothing.
fn is_hidden(parts: &[Part], pieces: &[Piece], piece: &Piece) -> bool {
    let mut until = piece.from;
    for part in parts {
        if part.to <= until {
            continue;
        }
        let is_behind = piece.most < pieces[part.piece].least;
        if !(part.is_shared && is_behind && part.from <= until + JOIN) {
            return false;
        }
        until = part.to;
        if piece.to <= until + JOIN {
            return true;
        }
    }
    false
}

/// Lays one more piece among the parts.
fn lay(pieces: &[Piece], number: usize, parts: &[Part], next: &mut Vec<Part>) {
    let piece = &pieces[number];
    let own = |from, to, is_shared| Part {
        from,
        to,
        owner: piece.owner,
        is_shared,
        piece: number,
    };
    // What of the piece comes before this was laid.
    let mut laid = piece.from;
    for &part in parts {
        let (begin, end) = (part.from.max(piece.from), part.to.min(piece.to));
        if end - begin <= JOIN {
            if part.to > piece.to && piece.to - laid > JOIN {
                next.push(own(laid, piece.to, false));
                laid = piece.to;
            }
            next.push(part);
            continue;
        }
        if begin - laid > JOIN {
            next.push(own(laid, begin, false));
        }
        // No part is shorter than what is joined.
        let begin = if begin - part.from > JOIN {
            begin
        } else {
            part.from
        };
        let end = if part.to - end > JOIN { end } else { part.to };
        laid = end;
        let other = &pieces[part.piece];
        let is_shared = part.is_shared || other.owner != piece.owner;
        let is_behind = piece.most < other.least;
        let is_before = |share| !is_behind && piece.is_before(other, share);
        let [mut first, mut last] = [is_before(begin), is_before(end)];
        let mut change = end;
        if first != last {
            // Where solids overlap another one may become the nearest on the way.
            change = first_change(begin, end, |share| is_before(share) == first);
            if change - begin <= JOIN {
                first = last;
            } else if end - change <= JOIN {
                last = first;
            }
        }
        if !first && !last && is_shared == part.is_shared {
            next.push(part);
            continue;
        }
        if part.from < begin {
            next.push(Part { to: begin, ..part });
        }
        let mut push = |from, to, is_before| {
            next.push(if is_before {
                own(from, to, is_shared)
            } else {
                Part {
                    from,
                    to,
                    is_shared,
                    ..part
                }
            });
        };
        if first == last {
            push(begin, end, first);
        } else {
            push(begin, change, first);
            push(change, end, last);
        }
        if end < part.to {
            next.push(Part { from: end, ..part });
        }
    }
    if piece.to - laid > JOIN {
        next.push(own(laid, piece.to, false));
    }
}

/// Until when something is so that is so at the beginning and not at the end.
fn first_change(mut begin: f32, mut end: f32, is_so: impl Fn(f32) -> bool) -> f32 {
    while end - begin > JOIN {
        let middle = 0.5 * (begin + end);
        if middle <= begin || middle >= end {
            break;
        }
        if is_so(middle) {
            begin = middle;
        } else {
            end = middle;
        }
    }
    end
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whose shadow it is, and whether there is another one: of all pieces, at a moment.
    fn plainly(pieces: &[Piece], at: f32) -> Option<(u32, bool)> {
        let covering: Vec<&Piece> = (pieces.iter())
            .filter(|piece| piece.from <= at && at <= piece.to)
            .collect();
        let nearest = covering
            .iter()
            .copied()
            .reduce(|a, b| if b.is_before(a, at) { b } else { a })?;
        let is_other = |piece: &&Piece| piece.owner != nearest.owner;
        Some((nearest.owner, covering.iter().any(is_other)))
    }

    #[test]
    fn each_moment_belongs_to_the_nearest_piece() {
        let mut seed = 3_u32;
        let mut random = || {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (seed >> 8) as f32 / (1 << 24) as f32
        };
        let mut sweep = Sweep::default();
        let (mut shared, mut alone) = (0, 0);
        for round in 0..5000 {
            sweep.pieces.clear();
            for _ in 0..round % 9 {
                let mut end = || (random() * 1.4 - 0.2).clamp(0.0, 1.0);
                let (a, b) = (end(), end());
                let owner = (random() * 4.0) as u32;
                let near = [1.0 + random(), 1.0 + random(), 0.2 * random() - 0.1];
                // Some begin and end nearly where others do.
                let (a, b) = match sweep.pieces.last() {
                    Some(other) if round % 2 == 0 => (other.to - 1e-7, b),
                    _ => (a, b),
                };
                if a.min(b) + 1e-4 < a.max(b) {
                    sweep
                        .pieces
                        .push(Piece::new(a.min(b), a.max(b), owner, near));
                }
            }
            let parts = sweep.lay_all().to_vec();
            assert!(parts.iter().all(|part| part.from < part.to), "{parts:?}");
            let is_after = |pair: &[Part]| pair[0].to <= pair[1].from + JOIN;
            assert!(
                parts.windows(2).all(is_after),
                "{parts:?} {:?}",
                sweep.pieces
            );
            for _ in 0..50 {
                let at = random();
                let around = [-2e-6, 0.0, 2e-6].map(|later| plainly(&sweep.pieces, at + later));
                if around[0] != around[1] || around[1] != around[2] {
                    continue;
                }
                let own = parts.iter().find(|part| part.from <= at && at <= part.to);
                let own = own.map(|part| (part.owner, part.is_shared));
                // Once all is in the shadow of two nobody asks how many there are.
                assert_eq!(own, around[1], "{at} {parts:?} {:?}", sweep.pieces);
                shared += usize::from(own.is_some_and(|own| own.1));
                alone += usize::from(own.is_some_and(|own| !own.1));
            }
        }
        assert!(shared > 1000 && alone > 1000, "{shared} {alone}");
    }
}
