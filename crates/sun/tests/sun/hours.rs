//! Which hours of a day.

use jiff::ToSpan;
use jiff::civil::Date;
use jiff::tz::{TimeZone, offset};
use ombra_sun::{Hours, Instant, MAX_WINDOWS, Place, Refraction, Sky, Span, SunError};

use crate::{Random, date, instant, mean_time, sky, total};

fn zone(name: &str) -> TimeZone {
    TimeZone::get(name).unwrap()
}

/// The South Pole, where the sun is up on both days on which New York changes its clocks.
fn always_up() -> Sky {
    sky(-90.0, 0.0)
}

fn clock(windows: &str) -> Hours {
    Hours::default().with_clock(windows).unwrap()
}

fn span(start: &str, end: &str) -> Span {
    Span::new(instant(start), instant(end))
}

#[test]
fn windows_by_the_clock() {
    let sky = sky(40.75, -73.98);
    let spans = clock("09:00-12:00,11:30-15:30,16:00-16:10").spans(
        &sky,
        &zone("America/New_York"),
        date("2026-12-21"),
    );
    let expected = [
        span("2026-12-21T09:00:00-05:00", "2026-12-21T15:30:00-05:00"),
        span("2026-12-21T16:00:00-05:00", "2026-12-21T16:10:00-05:00"),
    ];
    assert_eq!(spans, expected);
}

#[test]
fn a_day_of_changed_clocks_has_its_real_length() {
    let new_york = zone("America/New_York");
    for (day, hours, windows) in [
        // From 01:59:59 to 03:00:00.
        (
            "2026-03-08",
            23.0,
            [
                ("01:00-04:00", 2.0, 1),
                ("02:15-02:45", 0.0, 0),
                ("01:30-02:30", 0.5, 1),
            ],
        ),
        // From 01:59:59 back to 01:00:00.
        (
            "2026-11-01",
            25.0,
            [
                ("01:00-04:00", 4.0, 1),
                ("01:15-01:45", 1.0, 2),
                ("01:30-02:30", 1.5, 2),
            ],
        ),
    ] {
        let whole = Hours::default().spans(&always_up(), &new_york, date(day));
        assert_eq!((whole.len(), total(&whole)), (1, hours * 3600.0), "{day}");
        for (window, hours, count) in windows {
            let spans = clock(window).spans(&always_up(), &new_york, date(day));
            assert_eq!(
                (spans.len(), total(&spans)),
                (count, hours * 3600.0),
                "{day} {window}"
            );
        }
    }
    let sky = sky(40.75, -73.98);
    for (day, start, end) in [
        ("2026-03-07", "2026-03-07T14:00:00Z", "2026-03-07T20:30:00Z"),
        ("2026-03-08", "2026-03-08T13:00:00Z", "2026-03-08T19:30:00Z"),
        ("2026-11-01", "2026-11-01T14:00:00Z", "2026-11-01T20:30:00Z"),
    ] {
        let spans = clock("09:00-15:30").spans(&sky, &new_york, date(day));
        assert_eq!(spans, [span(start, end)]);
    }
}

/// Days that begin at 01:00, that lack midnight's hour or that are not there at all.
#[test]
fn odd_days_of_the_calendar() {
    let whole = |sky: &Sky, name: &str, day: &str| {
        total(&Hours::default().spans(sky, &zone(name), date(day))) / 3600.0
    };
    // Cuba changes at midnight: 00:00 to 01:00 in March, 01:00 back to 00:00 in November.
    assert_eq!(whole(&always_up(), "America/Havana", "2024-03-10"), 23.0);
    assert_eq!(whole(&always_up(), "America/Havana", "2024-11-03"), 25.0);
    // Lord Howe Island changes by half an hour.
    assert_eq!(
        whole(&always_up(), "Australia/Lord_Howe", "2026-10-04"),
        23.5
    );
    // Samoa went over the date line.
    assert_eq!(whole(&always_up(), "Pacific/Apia", "2011-12-30"), 0.0);
    assert_eq!(whole(&always_up(), "Pacific/Apia", "2011-12-31"), 24.0);
    // St John's once changed a minute after midnight: an hour of two dates, counted for the second.
    assert_eq!(whole(&always_up(), "America/St_Johns", "2009-11-01"), 25.0);
    assert_eq!(whole(&always_up(), "America/St_Johns", "2009-10-31"), 24.0);
}

#[test]
fn zones_far_from_greenwich() {
    let place = Place::new(1.87, -157.4, 3.0).unwrap();
    let kiritimati = Sky::new(place, Refraction::None).unwrap();
    let spans =
        clock("09:00-15:00").spans(&kiritimati, &place.time_zone().unwrap(), date("2024-02-29"));
    assert_eq!(
        spans,
        [span("2024-02-28T19:00:00Z", "2024-02-29T01:00:00Z")]
    );
    for hours in [-14, -12, 0, 12, 14] {
        let zone = TimeZone::fixed(offset(hours));
        let spans = clock("00:00-24:00").spans(&always_up(), &zone, date("2024-02-29"));
        let start = instant("2024-02-29T00:00:00Z") - f64::from(hours) * 3600.0;
        assert_eq!(spans, [Span::new(start, start + 86_400.0)]);
    }
}

#[test]
fn windows_of_true_solar_time() {
    let sky = sky(35.68, 139.69);
    let hours = Hours::default().with_solar("8-16").unwrap();
    let [found] = hours.spans(&sky, &zone("Asia/Tokyo"), date("2026-12-21"))[..] else {
        panic!("one span");
    };
    assert!((sky.solar_time(found.start) - 8.0 * 3600.0).abs() < 1e-3);
    assert!((sky.solar_time(found.end) - 16.0 * 3600.0).abs() < 1e-3);
    // True days about the winter solstice are half a minute longer than mean ones.
    assert!((found.seconds() - 8.0 * 3600.0 * (1.0 + 30.0 / 86_400.0)).abs() < 0.3);
    // Tokyo is east of its meridian by 4.69°, 18.8 min, and true time is ahead by 1.8 min.
    let clock = found.start.zoned(&zone("Asia/Tokyo"));
    assert_eq!((clock.hour(), clock.minute()), (7, 39));
}

/// Of a whole solar day nothing is lost or doubled, however far the clock is from the sun.
#[test]
fn solar_windows_fill_the_civil_day() {
    let hours = Hours::default()
        .with_solar("00:00-10:00,10:00-24:00")
        .unwrap();
    for offset_hours in -14..=14 {
        let zone = TimeZone::fixed(offset(offset_hours));
        for longitude in [-180.0, -100.0, 0.0, 77.0, 180.0] {
            let sky = sky(-90.0, longitude);
            let spans = hours.spans(&sky, &zone, date("2026-01-10"));
            assert!(
                (total(&spans) - 86_400.0).abs() < 0.01,
                "{offset_hours} {longitude}"
            );
        }
    }
}

#[test]
fn margins_after_sunrise_and_before_sunset() {
    let sky = sky(40.75, -73.98);
    let zone = zone("America/New_York");
    let whole = Hours::default().spans(&sky, &zone, date("2026-06-21"))[0];
    let hours = Hours::default().with_margins(5400.0, 3600.0).unwrap();
    let [cut] = hours.spans(&sky, &zone, date("2026-06-21"))[..] else {
        panic!("one span");
    };
    assert!((cut.start - whole.start - 5400.0).abs() < 1e-3);
    assert!((whole.end - cut.end - 3600.0).abs() < 1e-3);
    // Margins longer than the day leave nothing.
    let hours = Hours::default().with_margins(30_000.0, 30_000.0).unwrap();
    assert_eq!(hours.spans(&sky, &zone, date("2026-06-21")), []);
    // With a clock by which the sun rises at about 23:45, the next day begins within the margin.
    let late = TimeZone::fixed(offset(-10));
    let rise = Hours::default().spans(&sky, &late, date("2026-06-20"));
    let rise = rise[rise.len() - 1].start;
    let hours = Hours::default().with_margins(5400.0, 0.0).unwrap();
    let next = hours.spans(&sky, &late, date("2026-06-21"))[0];
    assert!(
        (next.start - rise - 5400.0).abs() < 1e-3,
        "{}",
        next.start - rise
    );
    // In polar day there is neither.
    let spans = hours.spans(&always_up(), &TimeZone::UTC, date("2026-12-21"));
    assert_eq!(total(&spans), 86_400.0);
}

#[test]
fn the_sun_is_never_below_the_minimum_and_is_at_it_at_the_ends() {
    let mut random = Random(7);
    for round in 0..60 {
        let place = Place::new(
            random.within(-90.0, 90.0),
            random.within(-180.0, 180.0),
            0.0,
        );
        let air = [Refraction::None, Refraction::SEA][round % 2];
        let sky = Sky::new(place.unwrap(), air).unwrap();
        let zone = mean_time(sky.place().longitude);
        let day = date("2026-01-01") + (random.within(0.0, 365.0) as i64).days();
        let least = [0.0, random.within(0.0, 60.0)][round / 2 % 2];
        let hours = Hours::default().with_min_altitude(least).unwrap();
        let spans = hours.spans(&sky, &zone, day);
        let midnight = Instant::from(&day.to_zoned_datetime(zone).unwrap());
        for (k, pair) in spans.windows(2).enumerate() {
            assert!(pair[0].end < pair[1].start, "{k}");
        }
        for span in &spans {
            for at in [span.start, span.end] {
                let altitude = sky.at(at).altitude;
                let inside = at > midnight && at < midnight + 86_400.0;
                assert!(altitude >= least, "{altitude} {least}");
                assert!(!inside || altitude < least + 1e-6, "{altitude} {least}");
            }
        }
        // Counted by the minute.
        let up =
            |minute: &i32| sky.at(midnight + f64::from(*minute) * 60.0 + 30.0).altitude >= least;
        let minutes = (0..1440).filter(up).count();
        let off = total(&spans) / 60.0 - minutes as f64;
        assert!(
            off.abs() <= spans.len() as f64 + 1e-6,
            "{off} {sky:?} {day}"
        );
    }
}

/// The sun that just comes over a limit at noon is found.
#[test]
fn grazing_the_minimum_at_noon() {
    let sky = sky(52.0, 0.0);
    let noon = sky.at_solar_time(43_200.0, instant("2026-12-21T12:00:00Z"));
    let top = sky.at(noon).altitude;
    for (below, length) in [(1e-4, 60.0..110.0), (1e-6, 6.0..11.0)] {
        let hours = Hours::default().with_min_altitude(top - below).unwrap();
        let spans = hours.spans(&sky, &TimeZone::UTC, date("2026-12-21"));
        assert!(length.contains(&total(&spans)), "{below}: {spans:?}");
    }
    let hours = Hours::default().with_min_altitude(top + 1e-6).unwrap();
    assert_eq!(hours.spans(&sky, &TimeZone::UTC, date("2026-12-21")), []);
}

#[test]
fn windows_and_limits_meet() {
    let sky = sky(52.0, 4.0);
    let hours = clock("08:00-12:00")
        .with_solar("11:00-14:00")
        .unwrap()
        .with_margins(3600.0, 0.0)
        .unwrap()
        .with_min_altitude(10.0)
        .unwrap();
    let [found] = hours.spans(&sky, &zone("Europe/Amsterdam"), date("2026-12-21"))[..] else {
        panic!("one span");
    };
    assert!((sky.at(found.start).altitude - 10.0).abs() < 1e-6);
    assert!((sky.solar_time(found.end) - 14.0 * 3600.0).abs() < 1e-3);
}

#[test]
fn the_months_are_the_year() {
    for (latitude, longitude) in [(52.0, 4.4), (78.2, 15.6), (-33.9, 151.2), (0.0, -78.5)] {
        let sky = sky(latitude, longitude);
        let zone = sky.place().time_zone().unwrap();
        let hours = Hours::default();
        let length = |days: &mut dyn Iterator<Item = Date>| -> f64 {
            days.map(|day| total(&hours.spans(&sky, &zone, day))).sum()
        };
        let first = date("2024-01-01");
        let year = length(&mut first.series(1.day()).take(366));
        let months: f64 = first
            .series(1.month())
            .take(12)
            .map(|first| length(&mut first.series(1.day()).take(first.days_in_month() as usize)))
            .sum();
        assert!((year - months).abs() < 1e-3);
        // The sun is up for half the year, but for the longer summer of the north.
        assert!(
            (year / 366.0 / 43_200.0 - 1.0).abs() < 0.03,
            "{latitude}: {year}"
        );
    }
}

/// A span of one day ends where that of the next begins: no instant of polar day is lost.
#[test]
fn days_follow_each_other() {
    let zone = zone("Arctic/Longyearbyen");
    let sky = sky(78.2, 15.6);
    let days = date("2026-05-01").series(1.day()).take(60);
    let spans: Vec<_> = days
        .map(|day| Hours::default().spans(&sky, &zone, day))
        .collect();
    for pair in spans.windows(2) {
        assert_eq!((pair[0].len(), pair[0][0].end), (1, pair[1][0].start));
    }
}

#[test]
fn hours_out_of_range_are_refused() {
    let hours = Hours::default;
    assert_eq!(
        hours().with_min_altitude(90.0),
        Err(SunError::MinAltitude(90.0))
    );
    assert_eq!(
        hours().with_min_altitude(-1.0),
        Err(SunError::MinAltitude(-1.0))
    );
    assert!(hours().with_min_altitude(f64::NAN).is_err());
    assert!(hours().with_margins(-1.0, 0.0).is_err());
    assert!(hours().with_margins(0.0, f64::INFINITY).is_err());
    assert!(hours().with_clock("").is_err());
    let many = vec!["9-10"; MAX_WINDOWS + 1].join(",");
    let error = hours().with_solar(&many).unwrap_err();
    assert_eq!(error.to_string(), "257 windows of a day; the most are 256");
}

#[test]
fn the_ends_of_the_calendar_have_no_spans() {
    for day in [Date::MIN, Date::MAX] {
        for hours in [-20, 0, 20] {
            let zone = TimeZone::fixed(offset(hours));
            let _ = Hours::default().spans(&always_up(), &zone, day);
        }
    }
}

#[test]
fn margins_may_be_counted_from_the_sunrise_of_almanacs() {
    let sky = sky(40.75, -73.98);
    let day = |hours: Hours| hours.spans(&sky, &zone("America/New_York"), date("2026-06-21"))[0];
    let margins = || Hours::default().with_margins(5400.0, 5400.0).unwrap();
    // Sunrise at 05:25, sunset at 20:31.
    let almanac = day(margins().with_sunrise(ombra_sun::ALMANAC_SUNRISE).unwrap());
    assert!((almanac.start - instant("2026-06-21T06:55:00-04:00")).abs() < 45.0);
    assert!((almanac.end - instant("2026-06-21T19:01:00-04:00")).abs() < 45.0);
    let middle = day(margins());
    assert!((240.0..360.0).contains(&(middle.start - almanac.start)));
    assert!((240.0..360.0).contains(&(almanac.end - middle.end)));
    // Without margins it makes no difference: the sun counts from the horizon up.
    let all = day(Hours::default().with_sunrise(-0.833).unwrap());
    assert_eq!(all, day(Hours::default()));
    assert_eq!(
        Hours::default().with_sunrise(9.0),
        Err(SunError::Sunrise(9.0))
    );
    assert!(Hours::default().with_sunrise(f64::NAN).is_err());
}
