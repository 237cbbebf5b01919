//! The moments of a day that are shown.

use ombra::sun::Instant;

use super::super::when::When;
use super::wrong_usage;

/// The most of them.
const MOST: usize = 1500;

/// The most bits that are kept, one a moment and place: 4 GB.
const MOST_BITS: usize = 1 << 35;

/// A moment, and how the clock shows it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Moment {
    pub(super) at: Instant,
    pub(super) clock: String,
}

/// The whole multiples of `every` seconds by the clock, counted from midnight, in the hours in which the sun counts.
pub(super) fn of(when: &When, every: f64, places: usize) -> anyhow::Result<Vec<Moment>> {
    if when.days != 1 {
        wrong_usage(&format!(
            "--frames show one day, but {} are asked for: name one, as with --date 2026-12-21",
            when.days
        ));
    }
    let zone = &when.time_zone;
    let mut moments = Vec::new();
    let count = when
        .spans
        .iter()
        .map(|span| span.seconds() / every + 1.0)
        .sum::<f64>();
    if count as usize > MOST {
        wrong_usage(&format!(
            "--every: {count:.0} frames are more than {MOST}: take longer steps or fewer hours"
        ));
    }
    for span in &when.spans {
        let start = span.start.zoned(zone).time();
        let clock = f64::from(start.hour()) * 3600.0
            + f64::from(start.minute()) * 60.0
            + f64::from(start.second())
            + f64::from(start.subsec_nanosecond()) * 1e-9;
        let first = (clock / every).ceil() * every - clock;
        let steps = ((span.seconds() - first) / every).floor();
        for step in 0..=steps.max(-1.0) as i64 {
            // Of a clock's whole seconds, whatever rounding did.
            let seconds = span.start.seconds() + first + step as f64 * every;
            let at = Instant::from_seconds((seconds * 1000.0).round() / 1000.0);
            let time = at.zoned(zone).time();
            let clock = if time.second() == 0 {
                format!("{:02}:{:02}", time.hour(), time.minute())
            } else {
                format!(
                    "{:02}:{:02}:{:02}",
                    time.hour(),
                    time.minute(),
                    time.second()
                )
            };
            moments.push(Moment { at, clock });
        }
    }
    if moments.is_empty() {
        wrong_usage(&format!(
            "--every: no multiple of {every} s by the clock lies in the {:.2} h of sun that are asked for; take shorter steps",
            when.hours()
        ));
    }
    if places.saturating_mul(moments.len()) > MOST_BITS {
        wrong_usage(&format!(
            "--frames: {} frames of {places} places are too many to keep: take larger cells, a smaller area or longer steps",
            moments.len()
        ));
    }
    Ok(moments)
}
