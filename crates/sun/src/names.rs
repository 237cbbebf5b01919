//! Weekdays and months by name, as filters.

use std::str::FromStr;

use jiff::civil::Weekday;

use crate::SunError;

const WEEKDAYS: [&str; 7] = [
    "monday",
    "tuesday",
    "wednesday",
    "thursday",
    "friday",
    "saturday",
    "sunday",
];
const MONTHS: [&str; 12] = [
    "january",
    "february",
    "march",
    "april",
    "may",
    "june",
    "july",
    "august",
    "september",
    "october",
    "november",
    "december",
];

/// A set of weekdays; all of them by default. From text: `mon-fri,sun`, `weekends`; names whole or
/// cut to three letters or more, in any case; a range may run over the end of the week.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Weekdays(u16);

impl Weekdays {
    /// Whether it has this day.
    #[must_use]
    pub fn contains(self, day: Weekday) -> bool {
        self.0 >> day.to_monday_zero_offset() & 1 == 1
    }
}

impl Default for Weekdays {
    fn default() -> Self {
        Self(0x7f)
    }
}

impl FromStr for Weekdays {
    type Err = SunError;

    fn from_str(text: &str) -> Result<Self, SunError> {
        let spelled = text
            .to_lowercase()
            .replace("weekdays", "mon-fri")
            .replace("weekends", "sat-sun");
        set(&spelled, &|name| named(name, &WEEKDAYS), 7)
            .map(Self)
            .map_err(SunError::Weekday)
    }
}

/// A set of months; all of them by default. From text: `jan,mar-may`, `1,3-5`; names whole or cut to
/// three letters or more, in any case; a range may run over the end of the year.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Months(u16);

impl Months {
    /// Whether it has this month, counted from 1 as jiff does.
    #[must_use]
    pub fn contains(self, month: i8) -> bool {
        (1..=12).contains(&month) && self.0 >> (month - 1) & 1 == 1
    }
}

impl Default for Months {
    fn default() -> Self {
        Self(0xfff)
    }
}

impl FromStr for Months {
    type Err = SunError;

    fn from_str(text: &str) -> Result<Self, SunError> {
        let place = |name: &str| match name.parse::<usize>() {
            Ok(number) => (1..=12).contains(&number).then(|| number - 1),
            Err(_) => named(name, &MONTHS),
        };
        set(&text.to_lowercase(), &place, 12)
            .map(Self)
            .map_err(SunError::Month)
    }
}

fn named(name: &str, names: &[&str]) -> Option<usize> {
    let short = name.strip_suffix('.').unwrap_or(name);
    (short.len() >= 3)
        .then(|| names.iter().position(|full| full.starts_with(short)))
        .flatten()
}

/// The bits of a list of names and ranges of them around a circle of `count`; the name that is none
/// as the error.
fn set(text: &str, place: &dyn Fn(&str) -> Option<usize>, count: usize) -> Result<u16, String> {
    let find = |name: &str| place(name.trim()).ok_or_else(|| name.trim().to_owned());
    let mut bits = 0;
    for item in text.split(',') {
        let (first, last) = item.split_once('-').unwrap_or((item, item));
        let (mut at, last) = (find(first)?, find(last)?);
        bits |= 1 << last;
        while at != last {
            bits |= 1 << at;
            at = (at + 1) % count;
        }
    }
    Ok(bits)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weekdays_from_text() {
        let days: Weekdays = "mon-Wed, sunday".parse().unwrap();
        assert!(days.contains(Weekday::Tuesday) && days.contains(Weekday::Sunday));
        assert!(!days.contains(Weekday::Thursday));
        let over: Weekdays = "fri-mon".parse().unwrap();
        assert!(over.contains(Weekday::Saturday) && !over.contains(Weekday::Tuesday));
        let all: Weekdays = "weekdays,weekends".parse().unwrap();
        assert_eq!(all, Weekdays::default());
        for text in ["", "mo", "mon-", "noday", "mon,,tue", "1"] {
            assert!(text.parse::<Weekdays>().is_err(), "{text}");
        }
    }

    #[test]
    fn months_from_text() {
        let months: Months = "Jan,mar-may".parse().unwrap();
        assert_eq!(months, "1,3-5".parse().unwrap());
        assert!(months.contains(4) && !months.contains(2));
        let over: Months = "nov-feb".parse().unwrap();
        assert!(over.contains(12) && over.contains(1) && !over.contains(3));
        assert!(!over.contains(0) && !over.contains(13) && !over.contains(-1));
        for text in ["", "ma", "13", "0", "-1", "smarch", "ju"] {
            assert!(text.parse::<Months>().is_err(), "{text}");
        }
    }
}
