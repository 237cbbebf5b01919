//! Some days, measured.

use ombra_sun::Sheet;

use crate::exact::Exact;
use crate::kernel::Room;
use crate::occluder::Occluders;
use crate::tile::{PLACES, Tile};

use super::choice::is_known;
use super::day::{Day, Taken};

/// Days that stand for all, ready to be measured.
#[derive(Debug)]
pub(super) struct Step<'a> {
    exact: Exact<'a>,
    /// To which of these days each sheet belongs.
    day_of: Vec<usize>,
    taken: Vec<Taken>,
}

impl<'a> Step<'a> {
    pub(super) fn new(occluders: &'a Occluders, days: &[Day<'_>], taken: Vec<Taken>) -> Self {
        let sheets = taken.iter().map(|own| days[own.day].sheets).enumerate();
        let sheets = sheets.flat_map(|(k, sheets)| sheets.iter().map(move |own| (own.clone(), k)));
        let (sheets, day_of): (Vec<Sheet>, Vec<usize>) = sheets.unzip();
        Self {
            exact: Exact::new(occluders, &sheets),
            day_of,
            taken,
        }
    }

    /// How many days there are.
    pub(super) fn len(&self) -> usize {
        self.taken.len()
    }

    /// Shows the seconds of each tile, if its days tell: no place of it has more than so many seconds in question.
    pub(super) fn each(
        &self,
        tiles: &[Tile],
        tolerance: f64,
        room: &mut Room,
        mut show: impl FnMut(usize, Option<[f64; PLACES]>),
    ) {
        let mut by_day = vec![[0.0; PLACES]; self.len() * tiles.len()];
        self.exact.by_way(tiles, room, |tile, sheet, seconds, _| {
            let sums = &mut by_day[tile * self.len() + self.day_of[sheet]];
            for (sum, seconds) in sums.iter_mut().zip(seconds) {
                *sum += seconds;
            }
        });
        for (tile, by_day) in by_day.chunks_exact(self.len()).enumerate() {
            show(tile, self.sum(by_day, tolerance));
        }
    }

    fn sum(&self, by_day: &[[f64; PLACES]], tolerance: f64) -> Option<[f64; PLACES]> {
        let mut seconds = [0.0; PLACES];
        let mut squares = [0.0; PLACES];
        let mut last = by_day[0];
        for (own, taken) in by_day.iter().zip(&self.taken) {
            for place in 0..PLACES {
                seconds[place] += taken.times * own[place];
                squares[place] += taken.unknown(last[place], own[place]).powi(2);
            }
            last = *own;
        }
        let mut questions = squares.iter().map(|square: &f64| square.sqrt());
        questions
            .all(|question| is_known(question, tolerance))
            .then_some(seconds)
    }
}
