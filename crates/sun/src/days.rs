//! Which days.

use std::ops::RangeInclusive;

use jiff::ToSpan;
use jiff::civil::Date;

use crate::{Calendar, Months, Season, SunError, Weekdays};

/// The years that days may be of: those of the Gregorian calendar for which ΔT can be estimated.
pub const YEARS: RangeInclusive<i16> = 1600..=2999;

/// The most days of one period: a hundred years.
pub const MAX_DAYS: usize = 36_600;

/// Days in order, each once; never none.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Days {
    dates: Vec<Date>,
}

impl Days {
    /// From text: a day `2026-12-21`, a range `2026-06-01..2026-08-31` (both ends count), a month
    /// `2026-03`, a year `2026`, a season `winter` (of the calendar's year) or `winter 2026`; or
    /// several with commas.
    ///
    /// # Errors
    /// What cannot be read, a day that the calendar lacks, a range turned round, too many days.
    pub fn parse(text: &str, calendar: &Calendar) -> Result<Self, SunError> {
        let mut dates = Vec::new();
        for item in text.split(',') {
            dates.extend(period(item.trim(), calendar)?.dates);
            // Days named twice count twice here, so that no list of long periods fills the memory.
            checked_count(dates.len())?;
        }
        dates.sort();
        dates.dedup();
        Ok(Self { dates })
    }

    /// From one day to another; both count.
    ///
    /// # Errors
    /// Turned round, out of [`YEARS`], or more than [`MAX_DAYS`].
    pub fn between(from: Date, to: Date) -> Result<Self, SunError> {
        checked_year(from.year().into())?;
        checked_year(to.year().into())?;
        if from > to {
            return Err(SunError::Backwards { from, to });
        }
        let count = from.duration_until(to).as_hours() / 24 + 1;
        checked_count(usize::try_from(count).unwrap_or(usize::MAX))?;
        let dates = from.series(1.day()).take_while(|date| *date <= to);
        Ok(Self {
            dates: dates.collect(),
        })
    }

    /// A single day.
    ///
    /// # Errors
    /// Out of [`YEARS`].
    pub fn one(date: Date) -> Result<Self, SunError> {
        Self::between(date, date)
    }

    /// A season, named by the year in which it begins; see [`Season::days`].
    ///
    /// # Errors
    /// Out of [`YEARS`].
    pub fn season(season: Season, year: i16, calendar: &Calendar) -> Result<Self, SunError> {
        checked_year(year.into())?;
        let (from, to) = season.days(year, calendar);
        Self::between(from, to)
    }

    /// Only those on some weekdays and in some months.
    ///
    /// # Errors
    /// If none is left.
    pub fn only(mut self, weekdays: Weekdays, months: Months) -> Result<Self, SunError> {
        let kept = |date: &Date| weekdays.contains(date.weekday()) && months.contains(date.month());
        self.dates.retain(kept);
        if self.dates.is_empty() {
            return Err(SunError::NoDays);
        }
        Ok(self)
    }

    /// All of them, in order.
    #[must_use]
    pub fn dates(&self) -> &[Date] {
        &self.dates
    }

    /// Each in turn.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = Date> + '_ {
        self.dates.iter().copied()
    }
}

fn period(text: &str, calendar: &Calendar) -> Result<Days, SunError> {
    let refuse = || SunError::Period(text.to_owned());
    if let Some((from, to)) = text.split_once("..").or_else(|| text.split_once('/')) {
        let from = stretch(from.trim())?.ok_or_else(refuse)?.0;
        let to = stretch(to.trim())?.ok_or_else(refuse)?.1;
        return Days::between(from, to);
    }
    if let Some((from, to)) = stretch(text)? {
        return Days::between(from, to);
    }
    let (name, year) = match text.split_once([' ', '-']) {
        None => (text, calendar.year),
        Some((name, year)) => (name, year.trim().parse().map_err(|_| refuse())?),
    };
    let season = name.parse().map_err(|_| refuse())?;
    Days::season(season, year, calendar)
}

/// The first and the last day of `2026-12-21`, `2026-12` or `2026`; none if it is not of the kind.
fn stretch(text: &str) -> Result<Option<(Date, Date)>, SunError> {
    let parts: Vec<_> = text.split('-').collect();
    let digits =
        |part: &&str| (1..=4).contains(&part.len()) && part.bytes().all(|b| b.is_ascii_digit());
    if parts.len() > 3 || parts[0].len() != 4 || !parts.iter().all(digits) {
        return Ok(None);
    }
    let numbers: Vec<i16> = parts.iter().flat_map(|part| part.parse()).collect();
    let year = checked_year(numbers[0].into())?;
    let refuse = || SunError::Period(text.to_owned());
    let part = |at: usize| {
        numbers
            .get(at)
            .map(|number| i8::try_from(*number).unwrap_or(0))
    };
    let month = part(1);
    let first = Date::new(year, month.unwrap_or(1), 1).map_err(|_| refuse())?;
    let Some(day) = part(2) else {
        let last = match month {
            Some(_) => first.last_of_month(),
            None => first.last_of_year(),
        };
        return Ok(Some((first, last)));
    };
    let date = Date::new(year, first.month(), day).map_err(|_| SunError::NoSuchDay {
        year,
        month: first.month(),
        day,
        last: first.days_in_month(),
    })?;
    Ok(Some((date, date)))
}

/// The year, if days may be of it.
pub(crate) fn checked_year(year: i64) -> Result<i16, SunError> {
    i16::try_from(year)
        .ok()
        .filter(|year| YEARS.contains(year))
        .ok_or(SunError::Year(year))
}

fn checked_count(count: usize) -> Result<(), SunError> {
    if count > MAX_DAYS {
        return Err(SunError::TooManyDays(count));
    }
    Ok(())
}
