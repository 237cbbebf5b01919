//! Stretches of shadow as they go on from arc to arc.

use arrayvec::ArrayVec;
use ombra_sun::Instant;

use super::stretch::{Stretch, Stretches};
use super::sweep::Sweep;
use crate::kernel::{NOBODY, Shown, bits};
use crate::tile::PLACES;
use crate::way::Way;

/// Stretches that lie no further apart than this, in seconds, are one: more than [`JOIN`](crate::cover::JOIN) of the longest arc.
const TOUCHING: f64 = 0.01;

/// What goes on for the places of a tile while the arcs come one after another.
#[derive(Debug)]
pub(super) struct Runs {
    /// Whose shadow each place lies in now, and since when; bit k of the mask: place k lies in that of others as well.
    owner: [u32; PLACES],
    shared: u32,
    since: [f64; PLACES],
    /// What is over.
    found: ArrayVec<Vec<Stretch>, PLACES>,
}

impl Runs {
    pub(super) fn new() -> Self {
        Self {
            owner: [NOBODY; PLACES],
            shared: 0,
            since: [0.0; PLACES],
            found: (0..PLACES).map(|_| Vec::new()).collect(),
        }
    }

    /// One more arc. Those of a way come in order, and ways as well.
    pub(super) fn add(&mut self, way: &Way, shown: &Shown<'_>, sweep: &mut Sweep) {
        let whose = &shown.whose;
        let seconds =
            |share: f32| way.starts[shown.arc] + way.seconds[shown.arc] * f64::from(share);
        if whose.open == 0 && whose.shared == self.shared && whose.owner == self.owner {
            return;
        }
        let mut changed = whose.open | (whose.shared ^ self.shared);
        for place in 0..PLACES {
            changed |= u32::from(whose.owner[place] != self.owner[place]) << place;
        }
        let begin = seconds(0.0);
        for place in bits(changed) {
            let is_open = whose.open >> place & 1 == 1;
            if !is_open {
                self.end(place, begin);
                self.begin(
                    place,
                    whose.owner[place],
                    whose.shared >> place & 1 == 1,
                    begin,
                );
                continue;
            }
            let mut until = begin;
            for part in sweep.parts(shown, place) {
                let (owner, is_shared) = (part.owner, part.is_shared);
                let [from, to] = [part.from, part.to].map(seconds);
                let is_touching = from - until <= TOUCHING;
                if !(is_touching
                    && self.owner[place] == owner
                    && self.is_shared(place) == is_shared)
                {
                    // No light between two that touch.
                    self.end(place, if is_touching { from } else { until });
                    self.begin(place, owner, is_shared, from);
                }
                until = to;
            }
            if seconds(1.0) - until > TOUCHING {
                self.end(place, until);
            }
        }
    }

    fn is_shared(&self, place: usize) -> bool {
        self.shared >> place & 1 == 1
    }

    fn begin(&mut self, place: usize, owner: u32, is_shared: bool, at: f64) {
        self.owner[place] = owner;
        self.shared = self.shared & !(1 << place) | (u32::from(is_shared) << place);
        self.since[place] = at;
    }

    fn end(&mut self, place: usize, at: f64) {
        let owner = self.owner[place];
        if owner == NOBODY {
            return;
        }
        let stretch = Stretch {
            from: Instant::from_seconds(self.since[place]),
            to: Instant::from_seconds(at),
            owner,
            is_alone: !self.is_shared(place),
        };
        self.begin(place, NOBODY, false, at);
        let found = &mut self.found[place];
        // Where one way goes on where another one ends.
        match found.last_mut() {
            Some(last)
                if stretch.from - last.to <= TOUCHING
                    && last.owner == owner
                    && last.is_alone == stretch.is_alone =>
            {
                last.to = stretch.to;
            }
            _ if stretch.from < stretch.to => found.push(stretch),
            _ => {}
        }
    }

    /// A way is over.
    pub(super) fn end_all(&mut self, at: f64) {
        for place in 0..PLACES {
            self.end(place, at);
        }
    }

    /// Hands over what was found for the first places of the tile: those that are somewhere.
    pub(super) fn take(&mut self, places: impl IntoIterator<Item = bool>, all: &mut Stretches) {
        for (found, is_somewhere) in self.found.iter_mut().zip(places) {
            all.push(found.drain(..).filter(|_| is_somewhere));
        }
        for found in &mut self.found {
            found.clear();
        }
    }
}
