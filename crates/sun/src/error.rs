//! What can be wrong with a place, a period or its hours.

use jiff::civil::Date;

use crate::days::{MAX_DAYS, YEARS};
use crate::hours::MAX_WINDOWS;

/// Why a place, days or hours cannot be used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SunError {
    /// Not on the globe.
    #[error("latitude {0} is not from -90 to 90 degrees (north is positive)")]
    Latitude(f64),
    /// Not on the globe.
    #[error("longitude {0} is not from -180 to 180 degrees (east is positive)")]
    Longitude(f64),
    /// Not where cities are.
    #[error("height {0} is not from -500 to 9000 metres above the sea")]
    Height(f64),
    /// No such air.
    #[error("air pressure {0} is not from 1 to 1100 millibars (1013.25 is that at the sea)")]
    Pressure(f64),
    /// No such air.
    #[error("air temperature {0} is not from -90 to 60 degrees Celsius")]
    Temperature(f64),
    /// The map of time zones has a hole here.
    #[error("no time zone is known at latitude {latitude}, longitude {longitude}: name one")]
    NoZone {
        /// Degrees north.
        latitude: f64,
        /// Degrees east.
        longitude: f64,
    },
    /// A name that the time zone database lacks.
    #[error("no time zone is called `{0}`: names are as `Europe/Amsterdam` or `UTC`")]
    UnknownZone(String),
    /// Not a day, a range, a month, a year or a season.
    #[error(
        "`{0}` is no period: write a day `2026-12-21`, a range `2026-06-01..2026-08-31`, a month \
         `2026-03`, a year `2026`, or a season `winter` or `winter 2026`; several with commas"
    )]
    Period(String),
    /// The calendar lacks this day.
    #[error("there is no day {year}-{month:02}-{day:02}: that month has {last} days")]
    NoSuchDay {
        /// Which year.
        year: i16,
        /// Which month, from 1.
        month: i8,
        /// The day asked for.
        day: i8,
        /// The last day that it has.
        last: i8,
    },
    /// Beyond what the sun's position is reckoned for.
    #[error("year {0} is not from {first} to {last}", first = YEARS.start(), last = YEARS.end())]
    Year(i64),
    /// From after to.
    #[error("the period ends on {to}, before it begins on {from}: turn them round")]
    Backwards {
        /// The first day.
        from: Date,
        /// The last day.
        to: Date,
    },
    /// Longer than anybody means.
    #[error("a period of {0} days; the longest is {MAX_DAYS}")]
    TooManyDays(usize),
    /// All days were left out.
    #[error("no day of the period is left: none is on the weekdays and in the months asked for")]
    NoDays,
    /// Not the name of a weekday.
    #[error("`{0}` is no weekday: write `mon`, `mon-fri,sun`")]
    Weekday(String),
    /// Not the name of a month.
    #[error("`{0}` is no month: write `jan`, `jan,mar-may` or `1,3-5`")]
    Month(String),
    /// Not the name of a season.
    #[error("`{0}` is no season: write `winter`, `spring`, `summer`, `fall` or `autumn`")]
    Season(String),
    /// Not two times of day.
    #[error("`{0}` is no window of a day: write `09:00-15:30`; several with commas")]
    Window(String),
    /// A window of no length, or over midnight.
    #[error(
        "the window `{0}` does not end after it begins; one over midnight is two: \
         `22:00-24:00,00:00-02:00`"
    )]
    WindowOrder(String),
    /// More windows than a day has use for.
    #[error("{0} windows of a day; the most are {MAX_WINDOWS}")]
    TooManyWindows(usize),
    /// Not a length of time.
    #[error("`{0}` is no length of time from 0 to 24 hours: write `90min`, `1h30min` or `1.5h`")]
    Duration(String),
    /// A margin that is none.
    #[error("a margin of {0} s is not from 0 to 86400 s")]
    Margin(f64),
    /// Not where the sun rises.
    #[error("sunrise at altitude {0} is not from -5 to 5 degrees")]
    Sunrise(f64),
    /// Not a height of the sun.
    #[error("minimum altitude {0} is not from 0 to below 90 degrees")]
    MinAltitude(f64),
}
