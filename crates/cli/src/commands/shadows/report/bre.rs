//! Britain and Europe: sun in gardens by BRE 209, at windows by EN 17037.

mod gardens;
mod windows;

use ombra::sun::Calendar;

use super::super::args::{ShadowsArgs, WhenArgs};
use super::frame::Report;
use super::study::Study;

/// The day of both, unless another one is asked for: the equinox of spring, as the guide has it.
const DAY: &str = "03-21";

/// The sun counts from this altitude on, in degrees, unless another one is asked for: a convention of ours.
const ALTITUDE: f64 = 10.0;

pub(super) fn when(args: &ShadowsArgs, calendar: &Calendar) -> WhenArgs {
    let day = || format!("{}-{DAY}", calendar.year);
    let when = &args.when;
    WhenArgs {
        date: when.date.clone().or_else(|| Some(day())),
        min_altitude: when.min_altitude.or(Some(ALTITUDE)),
        ..when.clone()
    }
}

/// `None` if it was interrupted.
pub(super) fn report(study: &Study<'_>) -> Option<Report> {
    match &study.points {
        Some(points) => windows::report(study, points),
        None => gardens::report(study),
    }
}

/// What is told of the altitude from which on the sun counts.
fn altitude(study: &Study<'_>) -> String {
    match study.args.when.min_altitude {
        Some(asked) => format!(
            "The sun counts while it stands at least {asked}° high, as was asked for (--min-altitude)."
        ),
        None => format!(
            "The sun counts while it stands at least {ALTITUDE}° high, a convention here: lower sun is blocked by what is in no file. \
             --min-altitude says otherwise; 0 counts all of it."
        ),
    }
}
