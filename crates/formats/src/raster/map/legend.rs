//! What the colours stand for.

use super::canvas::{Canvas, Colour};
use super::ground::OUTLINE;
use super::text::Face;
use super::{INK, MapStyle, Scale, ramp, round};
use crate::raster::{Raster, Unit};

/// Pixels that it is tall, at scale 1.
pub(super) const HEIGHT: u32 = 68;
const BAR_WIDTH: u32 = 360;
const BAR_HEIGHT: u32 = 16;
const BAR_TOP: u32 = 26;

/// The values at which the legend has ticks, and what its end stands for.
pub(super) struct Legend {
    unit: Unit,
    scale: Scale,
    /// The value of the dark end, in `unit`; more than 0.
    max: f64,
    ticks: Vec<(f64, String)>,
}

impl Legend {
    pub(super) fn new(raster: &Raster<'_>, style: &MapStyle) -> Self {
        Self::of(raster.values(), raster.unit().minutes(), style)
    }

    /// Of values that are so many minutes each.
    pub(super) fn of(values: &[f32], minutes: f32, style: &MapStyle) -> Self {
        let unit = style.unit;
        let per_unit = f64::from(minutes) / f64::from(unit.minutes());
        let values = values.iter().filter(|v| !v.is_nan());
        if style.scale.is_of_moment() {
            return Self {
                unit: Unit::Minutes,
                scale: style.scale,
                max: ramp::LAST_STATE.into(),
                ticks: Vec::new(),
            };
        }
        let size = |value: &f32| match style.scale {
            Scale::Shadow | Scale::Moment | Scale::MomentOfChange => *value,
            Scale::Change => value.abs(),
        };
        let largest = f64::from(values.map(size).fold(0.0, f32::max)) * per_unit;
        let legend = match style.max.filter(|m| *m > 0.0 && m.is_finite()) {
            Some(max) => Self::up_to(unit, f64::from(max), largest),
            None => Self::of_all(unit, largest),
        };
        if style.scale == Scale::Change {
            legend.both_ways()
        } else {
            legend
        }
    }

    fn of_shadow(unit: Unit, max: f64, ticks: Vec<(f64, String)>) -> Self {
        Self {
            unit,
            scale: Scale::Shadow,
            max,
            ticks,
        }
    }

    /// From as much less to as much more: half as many ticks a side.
    fn both_ways(self) -> Self {
        let last = self.ticks.len() - 1;
        let is_shown = |k: usize| k == 0 || k == last || (last.is_multiple_of(2) && 2 * k == last);
        let shown = (self.ticks.into_iter().enumerate()).filter(|(k, _)| is_shown(*k));
        let mut ticks = Vec::new();
        for (_, (value, text)) in shown {
            if value > 0.0 {
                ticks.push((-value, format!("-{text}")));
                ticks.push((value, format!("+{text}")));
            } else {
                ticks.push((value, text));
            }
        }
        Self {
            scale: Scale::Change,
            ticks,
            ..self
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
        Self::of_shadow(unit, max, ticks)
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
        Self::of_shadow(unit, max, ticks)
    }

    /// Draws it with its upper left corner at `x`, `y`; `swatches` name what has no value.
    pub(super) fn draw(
        &self,
        canvas: &mut Canvas,
        x: i64,
        y: i64,
        scale: u32,
        swatches: &[(Colour, String)],
    ) {
        if self.scale.is_of_moment() {
            draw_moment(canvas, [x, y], scale, self.scale, swatches);
            return;
        }
        let (body, small) = (Face::body(scale), Face::small(scale));
        let what = if self.scale == Scale::Change {
            "Net new shadow"
        } else {
            "Time in shadow"
        };
        let caption = format!("{what} ({})", self.unit.name());
        body.draw(canvas, x, y, &caption, INK);

        let [width, height, top] = [BAR_WIDTH, BAR_HEIGHT, BAR_TOP].map(|v| v * scale);
        let bar = [x + i64::from(scale), y + i64::from(top)];
        for column in 0..width {
            let colour = ramp::of(self.scale, column as f32 / (width - 1) as f32);
            canvas.rectangle(bar[0] + i64::from(column), bar[1], 1, height, colour);
        }
        canvas.frame(bar, [width, height], scale, INK);
        let below = bar[1] + i64::from(height);
        for (value, text) in &self.ticks {
            let share = f64::from(ramp::along(self.scale, (value / self.max) as f32));
            let along = (share * f64::from(width - scale)).round() as i64;
            canvas.rectangle(bar[0] + along, below, scale, 5 * scale, INK);
            // The first label begins where the bar does, so that nothing sticks out.
            let middle = bar[0] + along;
            let least = x + i64::from(small.width(text) / 2);
            let label_top = below + i64::from(7 * scale);
            small.draw_centred(canvas, middle.max(least), label_top, text, INK);
        }
        let left = bar[0] + i64::from(width + 44 * scale);
        if swatches.len() > 1 {
            // One above the other.
            draw_swatches(
                canvas,
                [left, bar[1] - i64::from(13 * scale)],
                scale,
                swatches,
            );
        } else {
            draw_swatches(canvas, [left, bar[1]], scale, swatches);
        }
    }
}

/// What the colours of a moment are called, and those of places without a value.
fn draw_moment(
    canvas: &mut Canvas,
    [x, y]: [i64; 2],
    scale: u32,
    of: Scale,
    swatches: &[(Colour, String)],
) {
    const NAMES: [&str; 4] = ["Sun", "Shadow", "New shadow", "Shadow that is gone"];
    let states: Vec<_> = (ramp::STATES.into_iter().zip(NAMES))
        .map(|(colour, name)| (colour, name.to_owned()))
        .collect();
    let count = if of == Scale::Moment { 2 } else { 4 };
    let (body, top) = (Face::body(scale), y + i64::from(BAR_TOP / 2 * scale));
    let mut left = x + i64::from(scale);
    for column in states[..count].chunks(2).chain([swatches]) {
        draw_swatches(canvas, [left, top], scale, column);
        let widest = column.iter().map(|(_, name)| body.width(name)).max();
        left += i64::from(widest.unwrap_or(0) + 62 * scale);
    }
}

/// One below the other.
fn draw_swatches(canvas: &mut Canvas, at: [i64; 2], scale: u32, swatches: &[(Colour, String)]) {
    let mut top = at[1];
    for (colour, name) in swatches {
        let size = [24 * scale, BAR_HEIGHT * scale];
        canvas.rectangle(at[0], top, size[0], size[1], *colour);
        canvas.frame([at[0], top], size, scale, OUTLINE);
        let text = [
            at[0] + i64::from(size[0] + 10 * scale),
            top - i64::from(3 * scale),
        ];
        Face::body(scale).draw(canvas, text[0], text[1], name, INK);
        top += i64::from(26 * scale);
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
