//! Which hours of a day.

use jiff::civil::Date;
use jiff::tz::TimeZone;

use crate::civil::CivilDay;
use crate::crossing::{Crossing, crossings};
use crate::position::DAY;
use crate::{Instant, Sky, Span, SunError, Window};

/// The most windows of one day.
pub const MAX_WINDOWS: usize = 256;

/// The altitude of the sun's centre, in degrees, at the sunrise and sunset of almanacs: 34' of refraction and 16' from the
/// centre to the upper edge.
pub const ALMANAC_SUNRISE: f64 = -50.0 / 60.0;

/// Which hours of each day: those within any of the windows, by the clock or by true solar time (no
/// window: the whole day), less the margins after sunrise and before sunset, while the sun is at
/// least as high as the minimum.
///
/// Sunrise and sunset are when the *centre* of the sun, lifted by refraction if the [`Sky`] has any,
/// crosses altitude 0, unless [another altitude](Self::with_sunrise) is asked for. Almanacs mean its upper edge through a
/// standard 34' of refraction, at [`ALMANAC_SUNRISE`], which is 3 to 7 minutes earlier and later at middle latitudes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Hours {
    clock: Vec<Window>,
    solar: Vec<Window>,
    after_sunrise: f64,
    before_sunset: f64,
    sunrise: f64,
    min_altitude: f64,
}

impl Hours {
    /// With these windows by the clock as well, as `09:00-12:00,13:00-15:30`: the instants at which
    /// the zone's clock shows a time of the window. Where the clock changes, times skipped count
    /// nothing and times shown twice count twice.
    ///
    /// # Errors
    /// Text that cannot be read, or too many windows.
    pub fn with_clock(self, windows: &str) -> Result<Self, SunError> {
        self.with_windows(&Window::list(windows)?, &[])
    }

    /// With these windows of true solar time as well. The civil day is what they are cut from: with
    /// a clock far from the sun, a window near midnight may come in two parts.
    ///
    /// # Errors
    /// Text that cannot be read, or too many windows.
    pub fn with_solar(self, windows: &str) -> Result<Self, SunError> {
        self.with_windows(&[], &Window::list(windows)?)
    }

    /// With these windows as well, by the clock and by true solar time.
    ///
    /// # Errors
    /// Too many windows.
    pub fn with_windows(mut self, clock: &[Window], solar: &[Window]) -> Result<Self, SunError> {
        self.clock.extend(clock);
        self.solar.extend(solar);
        let count = self.clock.len() + self.solar.len();
        if count > MAX_WINDOWS {
            return Err(SunError::TooManyWindows(count));
        }
        Ok(self)
    }

    /// Without the first seconds after each sunrise and the last before each sunset, 0 to 86 400. In
    /// polar day, with neither, nothing is left out.
    ///
    /// # Errors
    /// Out of range.
    pub fn with_margins(self, after_sunrise: f64, before_sunset: f64) -> Result<Self, SunError> {
        for margin in [after_sunrise, before_sunset] {
            if !(0.0..=DAY).contains(&margin) {
                return Err(SunError::Margin(margin));
            }
        }
        Ok(Self {
            after_sunrise,
            before_sunset,
            ..self
        })
    }

    /// With another altitude of the sun's centre, degrees from -5 to 5, as that of sunrise and sunset: the margins are
    /// counted from there. The sun counts from altitude 0 all the same.
    ///
    /// # Errors
    /// Out of range.
    pub fn with_sunrise(self, degrees: f64) -> Result<Self, SunError> {
        if !(-5.0..=5.0).contains(&degrees) {
            return Err(SunError::Sunrise(degrees));
        }
        Ok(Self {
            sunrise: degrees,
            ..self
        })
    }

    /// Only while the sun is at least this many degrees high, 0 to below 90. The default is 0.
    ///
    /// # Errors
    /// Out of range.
    pub fn with_min_altitude(self, degrees: f64) -> Result<Self, SunError> {
        if !(0.0..90.0).contains(&degrees) {
            return Err(SunError::MinAltitude(degrees));
        }
        Ok(Self {
            min_altitude: degrees,
            ..self
        })
    }

    /// The lowest altitude of the sun, degrees.
    #[must_use]
    pub const fn min_altitude(&self) -> f64 {
        self.min_altitude
    }

    /// The spans of a civil day (local midnight to local midnight) in which these hours are and the
    /// sun is up: disjoint, in order, each a millisecond or longer, their ends good to 0.1 ms of the
    /// sun's reckoned altitude and never below the minimum. None in polar night, and none for dates
    /// at the ends of jiff's years.
    #[must_use]
    pub fn spans(&self, sky: &Sky, zone: &TimeZone, date: Date) -> Vec<Span> {
        let Some(day) = CivilDay::new(date, zone) else {
            return Vec::new();
        };
        let up = sun_up(sky, day.whole, self.min_altitude);
        if up.is_empty() {
            return up;
        }
        let asked = Span::intersection(&self.windows(sky, &day), &up);
        Span::difference(&asked, &self.margins(sky, day.whole))
    }

    fn windows(&self, sky: &Sky, day: &CivilDay) -> Vec<Span> {
        if self.clock.is_empty() && self.solar.is_empty() {
            return vec![day.whole];
        }
        let clock = self.clock.iter().flat_map(|window| day.clock(*window));
        let solar = self
            .solar
            .iter()
            .flat_map(|window| solar_spans(sky, day.whole, *window));
        Span::union(clock.chain(solar).collect())
    }

    /// What the margins leave out. The sunrise of a day may be before its midnight, and the sunset
    /// after the next.
    fn margins(&self, sky: &Sky, day: Span) -> Vec<Span> {
        let (after, before) = (self.after_sunrise, self.before_sunset);
        if after == 0.0 && before == 0.0 {
            return Vec::new();
        }
        let wide = Span::new(day.start - after, day.end + before);
        let cut = altitude_crossings(sky, wide, self.sunrise)
            .into_iter()
            .map(|event| {
                let at = Instant::from_seconds(event.after);
                if event.rising {
                    Span::new(at, at + after)
                } else {
                    Span::new(at - before, at)
                }
            });
        Span::union(cut.collect())
    }
}

/// When the sun is at least so many degrees high.
fn sun_up(sky: &Sky, day: Span, altitude: f64) -> Vec<Span> {
    let mut spans = Vec::new();
    let mut start = (sky.at(day.start).altitude >= altitude).then_some(day.start);
    for event in altitude_crossings(sky, day, altitude) {
        if event.rising {
            start = Some(Instant::from_seconds(event.after).max(day.start));
        } else if let Some(start) = start.take() {
            spans.push(Span::new(start, Instant::from_seconds(event.before)));
        }
    }
    if let Some(start) = start {
        spans.push(Span::new(start, day.end));
    }
    Span::union(spans)
}

fn altitude_crossings(sky: &Sky, span: Span, altitude: f64) -> Vec<Crossing> {
    let limit = altitude.to_radians().sin();
    // The sine of the altitude is nearly a sine of time; the altitude has a kink near the zenith.
    let above = |seconds: f64| {
        let seen = sky.at(Instant::from_seconds(seconds)).altitude;
        let height = seen.to_radians().sin() - limit;
        // The sign is that of the altitude itself, to the last bit.
        if seen >= altitude {
            height.max(0.0)
        } else {
            height.min(-f64::MIN_POSITIVE)
        }
    };
    crossings(above, span.start.seconds(), span.end.seconds())
}

/// The instants of a civil day at which a sundial shows a time of the window.
fn solar_spans(sky: &Sky, day: Span, window: Window) -> Vec<Span> {
    // The true noons around the day: it may have parts of three solar days.
    let middle = Instant::from_seconds(0.5 * (day.start.seconds() + day.end.seconds()));
    let noon = sky.at_solar_time(DAY / 2.0, middle);
    let spans = (-1..=1).map(|days| {
        let near = noon + f64::from(days) * DAY;
        // Within half a day of that noon, so that the nearest instant is that of the same day.
        let at = |time: f64| {
            let guess = near + (time - DAY / 2.0);
            sky.at_solar_time(time.rem_euclid(DAY), guess)
        };
        Span::new(at(window.from()), at(window.to()))
    });
    Span::intersection(&Span::union(spans.collect()), &[day])
}
