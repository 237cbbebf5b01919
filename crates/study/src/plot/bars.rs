//! Bars to the right, each with its number at its end.

use super::{Anchor, Scale, Svg, width_of};
use crate::family::Family;
use crate::spread::Spread;

const WIDTH: f64 = 470.0;
const NAMES: f64 = 104.0;
const TOP: f64 = 34.0;
const ROW: f64 = 25.0;
/// How high a bar is; the second one is beneath.
const BAR: f64 = 8.0;

/// One row: the spread on the fewest threads and on more.
pub(crate) struct Bar {
    pub(crate) name: &'static str,
    pub(crate) few: Option<Spread>,
    pub(crate) many: Option<Spread>,
    /// Said after the numbers.
    pub(crate) note: &'static str,
}

/// A plot of bars.
pub(crate) struct Bars<'a> {
    pub(crate) title: &'a str,
    pub(crate) bars: Vec<Bar>,
    /// How a number is said.
    pub(crate) say: fn(f64) -> String,
}

impl Bars<'_> {
    pub(crate) fn draw(&self, says: &str) -> String {
        let height = TOP + ROW * self.bars.len() as f64 + 4.0;
        let mut svg = Svg::new(WIDTH, height);
        svg.text([0.0, 16.0], Anchor::Start, "head", self.title);
        let upper = |spread: &Option<Spread>| spread.map_or(0.0, |s| s.upper_quartile);
        let scale = Scale::linear(
            self.bars
                .iter()
                .flat_map(|b| [upper(&b.few), upper(&b.many)]),
        );
        let widest = self.bars.iter().map(|bar| width_of(&self.label(bar)));
        let room = WIDTH - NAMES - 10.0 - widest.fold(0.0, f64::max);
        let place = |number: f64| NAMES + scale.place(number) * room;
        for (row, bar) in self.bars.iter().enumerate() {
            let y = TOP + ROW * row as f64;
            let middle = y + ROW / 2.0 - 1.0;
            svg.text([NAMES - 8.0, middle + 4.0], Anchor::End, "", bar.name);
            let class = format!("fill {}", Family::of(bar.name).class());
            let both = bar.many.is_some();
            let mut end: f64 = NAMES;
            for (index, spread) in [bar.few, bar.many].into_iter().enumerate() {
                let Some(spread) = spread else { continue };
                let top = match (both, index) {
                    (false, _) => middle - BAR * 0.75,
                    (true, 0) => middle - BAR,
                    (true, _) => middle + 1.0,
                };
                let high = if both { BAR } else { BAR * 1.5 };
                let long = (place(spread.median) - NAMES).max(1.0);
                let opacity = if index == 0 { 1.0 } else { 0.45 };
                svg.area([NAMES, top], [long, high], &class, opacity);
                let [low, far] = [spread.lower_quartile, spread.upper_quartile].map(place);
                if far - low > 1.0 {
                    let y = top + high / 2.0;
                    svg.line([low, y], [far, y], "whisker");
                }
                end = end.max(far).max(NAMES + long);
            }
            let label = self.label(bar);
            svg.text([end + 6.0, middle + 4.0], Anchor::Start, "", &label);
        }
        svg.line([NAMES, TOP - 4.0], [NAMES, height - 4.0], "axis");
        svg.finish(says)
    }

    fn label(&self, bar: &Bar) -> String {
        let say = |spread: Option<Spread>| spread.map(|spread| (self.say)(spread.median));
        let numbers: Vec<_> = [say(bar.few), say(bar.many)]
            .into_iter()
            .flatten()
            .collect();
        match numbers.is_empty() {
            true => "not measured".to_owned(),
            false => format!("{}{}", numbers.join(" | "), bar.note),
        }
    }
}
