//! A row each, with a dot for the middle and a line for how far it goes, along one axis of ratios.

use super::scale::label;
use super::{Anchor, Scale, Svg, width_of};

const WIDTH: f64 = 800.0;
const TOP: f64 = 34.0;
const ROW: f64 = 23.0;

/// One row.
pub(crate) struct Mark {
    pub(crate) name: String,
    /// The class of its colour.
    pub(crate) class: &'static str,
    pub(crate) middle: f64,
    /// From where to where it goes.
    pub(crate) range: [f64; 2],
    /// Said at the right.
    pub(crate) said: String,
    /// Whether a new group begins here.
    pub(crate) begins: bool,
}

/// A plot of rows. Ratios; 1 is where both are equal.
pub(crate) struct Strip<'a> {
    pub(crate) title: &'a str,
    pub(crate) axis: &'a str,
    pub(crate) marks: Vec<Mark>,
    /// A range that is shaded, and what it is.
    pub(crate) band: Option<([f64; 2], &'a str)>,
}

impl Strip<'_> {
    pub(crate) fn draw(&self, says: &str) -> String {
        let bottom = TOP + 16.0 + ROW * self.marks.len() as f64;
        let mut svg = Svg::new(WIDTH, bottom + 46.0);
        svg.text([0.0, 16.0], Anchor::Start, "head", self.title);
        let widest = |of: fn(&Mark) -> &str| {
            let all = self.marks.iter().map(|mark| width_of(of(mark)));
            all.fold(0.0, f64::max)
        };
        let left = widest(|mark| &mark.name) + 10.0;
        let right = WIDTH - widest(|mark| &mark.said) - 12.0;
        let ends = self.marks.iter().flat_map(|mark| mark.range);
        let band = self.band.map_or([1.0; 2], |(band, _)| band);
        let scale = Scale::log(ends.chain([1.0]).chain(band));
        let place = |number: f64| left + scale.place(number) * (right - left);
        if let Some((band, name)) = self.band {
            let [from, to] = band.map(place);
            svg.area([from, TOP], [to - from, bottom - TOP], "band", 1.0);
            svg.text(
                [(from + to) / 2.0, TOP + 11.0],
                Anchor::Middle,
                "quiet",
                name,
            );
        }
        for tick in scale.ticks() {
            let at = place(tick);
            svg.line([at, TOP], [at, bottom], "rule");
            let times = format!("{} ×", label(tick));
            svg.text([at, bottom + 17.0], Anchor::Middle, "quiet", &times);
        }
        svg.line([place(1.0), TOP], [place(1.0), bottom], "axis");
        svg.text(
            [(left + right) / 2.0, bottom + 38.0],
            Anchor::Middle,
            "",
            self.axis,
        );
        for (row, mark) in self.marks.iter().enumerate() {
            let y = TOP + 16.0 + ROW * (row as f64 + 0.5);
            if mark.begins && row > 0 {
                svg.line([0.0, y - ROW / 2.0], [WIDTH, y - ROW / 2.0], "rule");
            }
            svg.text([left - 10.0, y + 4.0], Anchor::End, "", &mark.name);
            let [from, to] = mark.range.map(place);
            svg.line([from, y], [to, y], &format!("line {}", mark.class));
            let title = format!("{}: {}", mark.name, mark.said);
            svg.dot(
                [place(mark.middle), y],
                5.0,
                &format!("dot {}", mark.class),
                &title,
            );
            svg.text([WIDTH, y + 4.0], Anchor::End, "", &mark.said);
        }
        svg.finish(says)
    }
}
