//! The three maps of the lecture: winter, spring and fall, summer.

use std::path::PathBuf;
use std::process::ExitCode;

use super::{Session, ShadowsArgs, one};

/// The days for which the accumulation of shadows of New York was published (Miranda et al., "Shadow Accrual Maps:
/// Efficient Accumulation of City-Scale Shadows Over Time", TVCG 2019), each from 1.5 h after sunrise to 1.5 h
/// before sunset.
const DAYS: [(&str, &str); 3] = [
    ("winter", "12-21"),
    ("spring-fall", "09-22"),
    ("summer", "06-21"),
];

/// Seconds after sunrise and before sunset, unless others are asked for.
const MARGIN: f64 = 5400.0;

/// The year of these days, unless one is asked for.
const YEAR: i16 = 2026;

/// Makes a picture for each of the days in the folder where one is.
pub(super) fn run(args: &ShadowsArgs, session: &Session) -> anyhow::Result<ExitCode> {
    for (name, day) in DAYS {
        let year = args.when.year.unwrap_or(YEAR);
        let date = format!("{year}-{day}");
        let png = PathBuf::from(format!("demo-{name}.png"));
        let mut own = args.clone();
        own.when.date = Some(date);
        if own.when.after_sunrise == 0.0 && own.when.before_sunset == 0.0 {
            (own.when.after_sunrise, own.when.before_sunset) = (MARGIN, MARGIN);
        }
        own.png = Some(png);
        let code = one(&own, session)?;
        if code != ExitCode::SUCCESS {
            return Ok(code);
        }
    }
    Ok(ExitCode::SUCCESS)
}
