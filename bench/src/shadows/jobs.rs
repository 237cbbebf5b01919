//! Periods of which shadow time is asked for.

use anyhow::Context as _;
use jiff::civil::{Date, date};
use ombra_city::City;
use ombra_sun::{Calendar, Days, Hours, Place, Refraction, Sheet, Sky, Span};
use rayon::prelude::*;

use super::samples::Samples;

/// The year of all dates.
const YEAR: i16 = 2026;

/// Summer, autumn and winter.
const DATES: [(&str, i8, i8); 3] = [("Jun 21", 6, 21), ("Sep 22", 9, 22), ("Dec 21", 12, 21)];

/// Seconds after sunrise and before sunset that the shorter days leave out.
const MARGIN: f64 = 5400.0;

/// The sky of a city and its clock.
#[derive(Debug)]
pub(super) struct Skies {
    pub(super) sky: Sky,
    calendar: Calendar,
}

/// A period, ready for everybody.
#[derive(Debug)]
pub(super) struct Period {
    pub(super) name: String,
    pub(super) spans: Vec<Span>,
    pub(super) by_day: Vec<Vec<Sheet>>,
    pub(super) sheets: Vec<Sheet>,
    pub(super) samples: Samples,
}

impl Skies {
    pub(super) fn of(city: &City) -> anyhow::Result<Self> {
        let origin = &city.origin;
        let place = Place::new(origin.latitude(), origin.longitude(), 0.0)?;
        Ok(Self {
            sky: Sky::new(place, Refraction::None)?,
            calendar: Calendar::of(&place, YEAR).context("the time zone of the city")?,
        })
    }

    fn period(&self, name: String, hours: &Hours, dates: &[Date]) -> Period {
        let spans_of = |&date: &Date| hours.spans(&self.sky, &self.calendar.zone, date);
        let days: Vec<Vec<Span>> = dates.par_iter().map(spans_of).collect();
        let sheets_of = |spans: &Vec<Span>| {
            let sheets = spans.iter().map(|&span| Sheet::cover(&self.sky, span));
            sheets.flatten().collect()
        };
        let by_day: Vec<Vec<Sheet>> = days.par_iter().map(sheets_of).collect();
        let (spans, sheets) = (days.concat(), by_day.concat());
        let samples = Samples::new(&self.sky, &spans);
        Period {
            name,
            spans,
            by_day,
            sheets,
            samples,
        }
    }

    /// Three days without their ends, and from rise to set.
    pub(super) fn days(&self) -> anyhow::Result<[Vec<Period>; 2]> {
        let short = Hours::default().with_margins(MARGIN, MARGIN)?;
        let of = |hours: &Hours, ends: &str| {
            let day = |&(name, month, day): &(&str, i8, i8)| {
                self.period(format!("{name} {ends}"), hours, &[date(YEAR, month, day)])
            };
            DATES.iter().map(day).collect()
        };
        Ok([of(&short, "±90 min"), of(&Hours::default(), "rise to set")])
    }

    /// Every day of the year from rise to set; or every so manieth.
    pub(super) fn year(&self, every: usize) -> anyhow::Result<Period> {
        let days = Days::between(date(YEAR, 1, 1), date(YEAR, 12, 31))?;
        let dates: Vec<Date> = days.iter().step_by(every.max(1)).collect();
        let name = if every <= 1 {
            "year".to_owned()
        } else {
            format!("year, each {every}th day")
        };
        Ok(self.period(name, &Hours::default(), &dates))
    }
}
