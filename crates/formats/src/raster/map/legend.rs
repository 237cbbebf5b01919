//! What the colours stand for.

use super::canvas::Canvas;
use super::ground::{Empty, OUTLINE};
use super::text::Face;
use super::{INK, MapStyle, ramp, round};
use crate::raster::{Raster, Unit};

/// Pixels that it is tall, at scale 1.
pub(super) const HEIGHT: u32 = 68;
const BAR_WIDTH: u32 = 360;
const BAR_HEIGHT: u32 = 16;
const BAR_TOP: u32 = 26;

/// The values at which the legend has ticks, and what its end stands for.
pub(super) struct Legend {
    unit: Unit,
    /// The value of the dark end, in `unit`; more than 0.
    max: f64,
    ticks: Vec<(f64, String)>,
}

impl Legend {
    pub(super) fn new(raster: &Raster<'_>, style: &MapStyle) -> Self {
        let unit = style.unit;
        let per_unit = f64::from(raster.unit().minutes()) / f64::from(unit.minutes());
        let values = raster.values().iter().filter(|v| !v.is_nan());
        let largest = f64::from(values.copied().fold(0.0, f32::max)) * per_unit;
        match style.max.filter(|m| *m > 0.0 && m.is_finite()) {
            Some(max) => Self::up_to(unit, f64::from(max), largest),
            None => Self::of_all(unit, largest),
        }
    }

    /// Minutes at the dark end.
    pub(super) fn top(&self) -> f32 {
        (self.max * f64::from(self.unit.minutes())) as f32
    }

    /// A legend that ends at the first tick that is not less than any value.
    fn of_all(unit: Unit, largest: f64) -> Self {
        // Where there is no shadow at all, a legend has to end somewhere: after an hour.
        let hour = f64::from(Unit::Hours.minutes() / unit.minutes());
        let largest = if largest > 0.0 { largest } else { hour };
        let with_ends = steps(unit, largest).into_iter().map(|step| {
            let count = (largest / step - 1e-6).ceil().max(1.0);
            (step, count * step)
        });
        let mut fitting = with_ends.filter(|&(step, max)| fits(step, max));
        let (step, max) = fitting.next().unwrap_or((largest, largest));
        let ticks = ticks(step, max);
        Self { unit, max, ticks }
    }

    /// A legend that ends where it is told to, with a plus if there is more.
    fn up_to(unit: Unit, max: f64, largest: f64) -> Self {
        let mut fitting = steps(unit, max).into_iter().filter(|&s| fits(s, max));
        let step = fitting.next().unwrap_or(max);
        let mut ticks = ticks(step, max);
        ticks.retain(|(at, _)| *at == 0.0 || at + 0.7 * step <= max);
        let more = if largest > max * (1.0 + 1e-6) {
            "+"
        } else {
            ""
        };
        let is_multiple = (max / step).fract().abs() < 1e-6;
        let own_step = if is_multiple { step } else { step / 10.0 };
        ticks.push((max, format!("{}{more}", round::text(max, own_step))));
        Self { unit, max, ticks }
    }

    /// Draws it with its upper left corner at `x`, `y`; `swatches` name what has no value.
    pub(super) fn draw(
        &self,
        canvas: &mut Canvas,
        x: i64,
        y: i64,
        scale: u32,
        swatches: &[(Empty, String)],
    ) {
        let (body, small) = (Face::body(scale), Face::small(scale));
        let caption = format!("Time in shadow ({})", self.unit.name());
        body.draw(canvas, x, y, &caption, INK);

        let [width, height, top] = [BAR_WIDTH, BAR_HEIGHT, BAR_TOP].map(|v| v * scale);
        let bar = [x + i64::from(scale), y + i64::from(top)];
        for column in 0..width {
            let colour = ramp::colour(column as f32 / (width - 1) as f32);
            canvas.rectangle(bar[0] + i64::from(column), bar[1], 1, height, colour);
        }
        canvas.frame(bar, [width, height], scale, INK);
        let below = bar[1] + i64::from(height);
        for (value, text) in &self.ticks {
            let along = (value / self.max * f64::from(width - scale)).round() as i64;
            canvas.rectangle(bar[0] + along, below, scale, 5 * scale, INK);
            // The first label begins where the bar does, so that nothing sticks out.
            let middle = bar[0] + along;
            let least = x + i64::from(small.width(text) / 2);
            let label_top = below + i64::from(7 * scale);
            small.draw_centred(canvas, middle.max(least), label_top, text, INK);
        }
        let mut swatch = [bar[0] + i64::from(width + 44 * scale), bar[1]];
        if swatches.len() > 1 {
            // One above the other.
            swatch[1] -= i64::from(13 * scale);
        }
        for (empty, name) in swatches {
            let size = [24 * scale, height];
            canvas.rectangle(swatch[0], swatch[1], size[0], size[1], empty.colour());
            canvas.frame(swatch, size, scale, OUTLINE);
            let text_left = swatch[0] + i64::from(size[0] + 10 * scale);
            let text_top = swatch[1] - i64::from(3 * scale);
            body.draw(canvas, text_left, text_top, name, INK);
            swatch[1] += i64::from(26 * scale);
        }
    }
}

/// Steps that ticks may be apart, rising. Minutes are counted in quarters and whole hours.
fn steps(unit: Unit, size: f64) -> Vec<f64> {
    let by_tens: Vec<f64> = round::steps(size).collect();
    if unit == Unit::Hours {
        return by_tens;
    }
    let of_the_clock = [15.0, 30.0, 60.0, 120.0, 180.0, 240.0];
    let is_ten = |s: &f64| (12.0..300.0).contains(s);
    let mut steps: Vec<f64> = by_tens.into_iter().filter(|s| !is_ten(s)).collect();
    steps.extend(of_the_clock.into_iter().filter(|s| *s <= 10.0 * size));
    steps.sort_by(f64::total_cmp);
    steps
}

/// Whether the labels of ticks have room.
fn fits(step: f64, max: f64) -> bool {
    let count = max / step;
    let face = Face::small(1);
    let longest = round::text(max, step)
        .len()
        .max(round::text(step, step).len());
    let label = face.width(&"0".repeat(longest + 2));
    count <= 8.5 && f64::from(label) * count <= f64::from(BAR_WIDTH)
}

fn ticks(step: f64, max: f64) -> Vec<(f64, String)> {
    let count = (max / step + 1e-6).floor().min(100.0) as u32;
    let values = (0..=count).map(|i| f64::from(i) * step);
    values
        .map(|value| {
            // "0" needs no decimals.
            let text = match value {
                0.0 => "0".to_owned(),
                _ => round::text(value, step),
            };
            (value, text)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(legend: &Legend) -> Vec<&str> {
        legend.ticks.iter().map(|t| t.1.as_str()).collect()
    }

    #[test]
    fn ticks_are_round_and_the_last_one_holds_all() {
        let minutes = |largest| Legend::of_all(Unit::Minutes, largest);
        assert_eq!(
            labels(&minutes(465.3)),
            ["0", "60", "120", "180", "240", "300", "360", "420", "480"]
        );
        assert_eq!(
            labels(&minutes(60.0)),
            ["0", "10", "20", "30", "40", "50", "60"]
        );
        assert_eq!(minutes(0.0).max, 60.0);
        assert_eq!(Legend::of_all(Unit::Hours, 0.0).max, 1.0);
        assert!(minutes(131_000.0).max >= 131_000.0);
        let hours = Legend::of_all(Unit::Hours, 7.9);
        assert_eq!(
            labels(&hours),
            ["0", "1", "2", "3", "4", "5", "6", "7", "8"]
        );
        assert_eq!(hours.top(), 480.0);
        let short = Legend::of_all(Unit::Hours, 0.9);
        assert_eq!(labels(&short), ["0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
    }

    #[test]
    fn an_end_that_is_given_is_kept() {
        let end = |max, largest| Legend::up_to(Unit::Minutes, max, largest);
        let more = end(240.0, 300.0);
        assert_eq!(more.top(), 240.0);
        assert_eq!(labels(&more).last(), Some(&"240+"));
        assert_eq!(labels(&end(240.0, 240.0)).last(), Some(&"240"));
        let odd = end(100.0, 0.0);
        assert_eq!(labels(&odd), ["0", "15", "30", "45", "60", "75", "100"]);
    }

    #[test]
    fn any_size_has_a_legend() {
        for exponent in -40..39 {
            let largest = 3.7 * 10_f64.powi(exponent);
            for unit in [Unit::Minutes, Unit::Hours] {
                for legend in [
                    Legend::of_all(unit, largest),
                    Legend::up_to(unit, largest, 1.0),
                ] {
                    let count = legend.ticks.len();
                    assert!((2..=11).contains(&count), "{largest}: {count}");
                    assert!(legend.max > 0.0);
                }
            }
        }
    }
}
