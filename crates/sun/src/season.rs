//! Equinoxes, solstices and the seasons between them.

use std::str::FromStr;

use jiff::ToSpan;
use jiff::civil::Date;

use crate::position::{DAY, prepared};
use crate::{Calendar, Instant, SunError};

/// The four turns of a year, by what they are in the north.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Turn {
    /// The sun goes north over the equator, about 20 March.
    MarchEquinox,
    /// It is farthest north, about 21 June.
    JuneSolstice,
    /// It goes south over the equator, about 22 September.
    SeptemberEquinox,
    /// It is farthest south, about 21 December.
    DecemberSolstice,
}

impl Turn {
    const ALL: [Self; 4] = [
        Self::MarchEquinox,
        Self::JuneSolstice,
        Self::SeptemberEquinox,
        Self::DecemberSolstice,
    ];

    /// When it is in a year: when the sun's apparent longitude is a multiple of 90°. Within SPA's
    /// accuracy, 0.0003°, which the sun takes 26 s for.
    #[must_use]
    pub fn instant(self, year: i16) -> Instant {
        let quarter = f64::from(self as u8);
        let years = f64::from(year) - 2000.0;
        // The mean turns drift by a quarter day a year against the count of 365.2422 days; near
        // enough to start from, as each step leaves a thirtieth of the miss.
        let first = 953_550_000.0 + years * 365.2422 * DAY;
        let mut instant = Instant::from_seconds(first + quarter * 91.31 * DAY);
        for _ in 0..12 {
            let miss = (90.0 * quarter - longitude(instant) + 180.0).rem_euclid(360.0) - 180.0;
            instant = instant + miss / 360.0 * 365.2422 * DAY;
        }
        instant
    }
}

/// The apparent ecliptic longitude of the sun, degrees, from its right ascension and declination.
fn longitude(instant: Instant) -> f64 {
    let sun = prepared(instant, None);
    // Mean obliquity, IAU 1980; nutation changes it by less than 0.003°, and the longitude next to
    // the turns by less than a millionth of that.
    let centuries = (instant.seconds() / DAY - 10_957.5) / 36_525.0;
    let obliquity = (23.439_291 - 0.013_004_2 * centuries).to_radians();
    let (sin_ra, cos_ra) = sun.right_ascension().to_radians().sin_cos();
    let y = sin_ra * obliquity.cos() + sun.declination().to_radians().tan() * obliquity.sin();
    y.atan2(cos_ra).to_degrees()
}

/// A season of the astronomical kind: from the day of one turn of the year to the day before the
/// next, by the calendar of the place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Season {
    /// From the equinox after winter.
    Spring,
    /// From the solstice of the longest day.
    Summer,
    /// From the equinox after summer; `fall` and `autumn` both name it.
    Autumn,
    /// From the solstice of the shortest day.
    Winter,
}

impl Season {
    /// Its first and last day. The year is that in which it begins: in the north, winter 2026 is
    /// from December 2026 to March 2027; in the south, summer 2026 is.
    #[must_use]
    pub fn days(self, year: i16, calendar: &Calendar) -> (Date, Date) {
        let north = self as usize;
        let begins = if calendar.north {
            north
        } else {
            (north + 2) % 4
        };
        let next_year = if begins == 3 { year + 1 } else { year };
        let date = |turn: usize, year| Turn::ALL[turn].instant(year).zoned(&calendar.zone).date();
        let (first, next) = (date(begins, year), date((begins + 1) % 4, next_year));
        (first, next.saturating_sub(1.day()))
    }
}

impl FromStr for Season {
    type Err = SunError;

    fn from_str(text: &str) -> Result<Self, SunError> {
        match text.trim().to_lowercase().as_str() {
            "spring" => Ok(Self::Spring),
            "summer" => Ok(Self::Summer),
            "autumn" | "fall" => Ok(Self::Autumn),
            "winter" => Ok(Self::Winter),
            _ => Err(SunError::Season(text.trim().to_owned())),
        }
    }
}
