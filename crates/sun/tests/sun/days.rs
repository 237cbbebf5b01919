//! Which days a period has.

use jiff::tz::TimeZone;
use ombra_sun::{Calendar, Days, MAX_DAYS, Months, Place, SunError, Weekdays};

use crate::date;

fn calendar(latitude: f64, year: i16) -> Calendar {
    let place = Place::new(latitude, 0.0, 0.0).unwrap();
    Calendar::with_zone(&place, year, TimeZone::UTC).unwrap()
}

fn days(text: &str) -> Result<Days, SunError> {
    Days::parse(text, &calendar(52.0, 2026))
}

fn ends(days: &Days) -> (String, String, usize) {
    let dates = days.dates();
    (
        dates[0].to_string(),
        dates[dates.len() - 1].to_string(),
        dates.len(),
    )
}

#[test]
fn periods_from_text() {
    for (text, first, last, count) in [
        ("2026-12-21", "2026-12-21", "2026-12-21", 1),
        ("2026-06-01..2026-08-31", "2026-06-01", "2026-08-31", 92),
        ("2026-06-01 / 2026-08-31", "2026-06-01", "2026-08-31", 92),
        ("2026-06..2026-08", "2026-06-01", "2026-08-31", 92),
        ("2026", "2026-01-01", "2026-12-31", 365),
        ("2024", "2024-01-01", "2024-12-31", 366),
        ("2024-02", "2024-02-01", "2024-02-29", 29),
        ("2024-02-28..2024-03-01", "2024-02-28", "2024-03-01", 3),
        (
            "2026-12-21, 2026-03-20,2026-12-21",
            "2026-03-20",
            "2026-12-21",
            2,
        ),
        ("spring", "2026-03-20", "2026-06-20", 93),
        ("Summer", "2026-06-21", "2026-09-22", 94),
        ("fall", "2026-09-23", "2026-12-20", 89),
        ("autumn 2026", "2026-09-23", "2026-12-20", 89),
        ("winter-2026", "2026-12-21", "2027-03-19", 89),
    ] {
        let found = ends(&days(text).unwrap());
        assert_eq!(found, (first.to_owned(), last.to_owned(), count), "{text}");
    }
}

#[test]
fn seasons_are_the_other_way_round_in_the_south() {
    let south = calendar(-33.9, 2026);
    let summer = Days::parse("summer", &south).unwrap();
    assert_eq!(summer, days("winter").unwrap());
    let spring = Days::parse("spring", &south).unwrap();
    assert_eq!(spring, days("fall").unwrap());
}

/// The equinox of September 2026 is at 00:05 UTC of the 23rd: still the 22nd in New York.
#[test]
fn seasons_begin_by_the_clock_of_the_place() {
    let place = Place::new(40.75, -73.98, 0.0).unwrap();
    let fall = Days::parse("fall", &Calendar::of(&place, 2026).unwrap()).unwrap();
    assert_eq!(fall.dates()[0], date("2026-09-22"));
}

#[test]
fn the_seasons_are_the_year() {
    for year in [1600, 2024, 2998] {
        let calendar = calendar(10.0, year);
        let all = Days::parse("spring,summer,fall,winter", &calendar).unwrap();
        let (first, last) = (all.dates()[0], all.dates()[all.dates().len() - 1]);
        let unbroken = Days::between(first, last).unwrap();
        assert_eq!(all, unbroken);
        assert!((364..=367).contains(&all.dates().len()));
    }
}

#[test]
fn filters() {
    let only = |weekdays: &str, months: &str| {
        days("2026")
            .unwrap()
            .only(weekdays.parse().unwrap(), months.parse().unwrap())
    };
    assert_eq!(only("mon-fri", "feb").unwrap().dates().len(), 20);
    assert_eq!(only("sun", "jan-dec").unwrap().dates().len(), 52);
    let none = days("2026-02")
        .unwrap()
        .only(Weekdays::default(), "mar".parse().unwrap());
    assert_eq!(none.unwrap_err(), SunError::NoDays);
    let saturday = days("2026-11-28").unwrap();
    assert_eq!(saturday.iter().len(), 1);
    assert!(
        saturday
            .clone()
            .only("sat".parse().unwrap(), Months::default())
            .is_ok()
    );
    assert!(
        saturday
            .only("sun".parse().unwrap(), Months::default())
            .is_err()
    );
}

#[test]
fn what_is_no_period_is_named() {
    for text in [
        "",
        " ",
        "winters",
        "2026-",
        "2026-1-1-1",
        "26-12-21",
        "2026-00-01",
        "2026-13-01",
        "tomorrow",
        "winter twenty",
        "2026-12-21..",
        "..",
        "2026-12-21,",
        "２０２６-12-21",
        "2026-12-21T00:00",
        "+2026-12-21",
        "2026-999-1",
    ] {
        let error = days(text).unwrap_err();
        assert!(matches!(error, SunError::Period(_)), "{text}: {error}");
    }
    for (text, error) in [
        (
            "2026-02-29",
            "there is no day 2026-02-29: that month has 28 days",
        ),
        (
            "2026-04-31",
            "there is no day 2026-04-31: that month has 30 days",
        ),
        ("0999", "year 999 is not from 1600 to 2999"),
        ("3000-01-01", "year 3000 is not from 1600 to 2999"),
        (
            "winter 99999",
            "`winter 99999` is no period: write a day `2026-12-21`, a range `2026-06-01..2026-08-31`, a month `2026-03`, a year `2026`, or a season `winter` or `winter 2026`; several with commas",
        ),
        (
            "2026-12-21..2026-12-20",
            "the period ends on 2026-12-20, before it begins on 2026-12-21: turn them round",
        ),
        (
            "1700..2900",
            "a period of 438656 days; the longest is 36600",
        ),
    ] {
        assert_eq!(days(text).unwrap_err().to_string(), error);
    }
    assert!(days("winter 2999").is_err(), "it ends in 3000");
}

#[test]
fn lists_of_long_periods_are_bounded() {
    let error = days("1900..1999,2100..2199").unwrap_err();
    assert_eq!(error, SunError::TooManyDays(73_048));
    assert_eq!(days("1900..1999").unwrap().dates().len(), 36_524);
    const { assert!(MAX_DAYS > 36_525) };
}
