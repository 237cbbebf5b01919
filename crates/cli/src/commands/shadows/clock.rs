//! Times of day, as people write them.

use jiff::tz::{Dst, Offset, TimeZone};
use ombra::sun::{Instant, Span};

/// What shows the time.
pub(super) struct Clock {
    zone: TimeZone,
    /// Whether it is never put forward in summer.
    is_standard: bool,
}

impl Clock {
    /// The clock on the wall, which is put forward in summer.
    pub(super) const fn civil(zone: TimeZone) -> Self {
        Self {
            zone,
            is_standard: false,
        }
    }

    /// Standard time all year.
    pub(super) const fn standard(zone: TimeZone) -> Self {
        Self {
            zone,
            is_standard: true,
        }
    }

    /// Hours and minutes, to the nearest minute.
    pub(super) fn time(&self, instant: Instant) -> String {
        let nearest = instant + 30.0;
        let shown = self.offset(nearest).0.to_datetime(nearest.timestamp());
        shown.strftime("%H:%M").to_string()
    }

    /// To the second, with the date and the distance from UTC.
    pub(super) fn iso(&self, instant: Instant) -> String {
        let nearest = instant + 0.5;
        let offset = self.offset(nearest).0;
        let shown = offset.to_datetime(nearest.timestamp());
        let minutes = offset.seconds() / 60;
        let sign = if minutes < 0 { '-' } else { '+' };
        let (hours, minutes) = (minutes.abs() / 60, minutes.abs() % 60);
        format!(
            "{}{sign}{hours:02}:{minutes:02}",
            shown.strftime("%Y-%m-%dT%H:%M:%S")
        )
    }

    /// From one to the other.
    pub(super) fn span(&self, span: Span) -> String {
        format!("{} – {}", self.time(span.start), self.time(span.end))
    }

    /// What the time of these instants is called: "EST", or "EST and EDT".
    pub(super) fn name(&self, instants: impl Iterator<Item = Instant>) -> String {
        let mut names: Vec<String> = Vec::new();
        for instant in instants {
            let name = self.offset(instant).1;
            if !names.contains(&name) {
                names.push(name);
            }
        }
        names.join(" and ")
    }

    fn offset(&self, instant: Instant) -> (Offset, String) {
        let at = instant.timestamp();
        let info = self.zone.to_offset_info(at);
        let now = || (info.offset(), info.abbreviation().to_owned());
        if !self.is_standard || info.dst() == Dst::No {
            return now();
        }
        // What held before the clock was put forward.
        let earlier = self
            .zone
            .preceding(at)
            .find(|change| change.dst() == Dst::No);
        earlier.map_or_else(now, |change| {
            (change.offset(), change.abbreviation().to_owned())
        })
    }
}

/// A length of time in hours and minutes, to the nearest minute: "1 h 05 min".
pub(super) fn length(seconds: f64) -> String {
    let minutes = (seconds / 60.0).round() as i64;
    match (minutes / 60, minutes % 60) {
        (0, 0) if seconds > 0.0 => "less than a minute".to_owned(),
        (0, minutes) => format!("{minutes} min"),
        (hours, minutes) => format!("{hours} h {minutes:02} min"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn instant(text: &str) -> Instant {
        Instant::from(text.parse::<jiff::Timestamp>().unwrap())
    }

    #[test]
    fn standard_time_is_not_put_forward() {
        let zone = TimeZone::get("America/New_York").unwrap();
        let (civil, standard) = (Clock::civil(zone.clone()), Clock::standard(zone));
        let june = instant("2026-06-21T10:55:29Z");
        assert_eq!(
            (civil.time(june), standard.time(june)),
            ("06:55".into(), "05:55".into())
        );
        assert_eq!(standard.iso(june), "2026-06-21T05:55:29-05:00");
        assert_eq!(civil.iso(june), "2026-06-21T06:55:29-04:00");
        // Either side of the night in which the clock is put forward, and at its end.
        for (at, civil_time, standard_time) in [
            ("2026-03-08T06:59:00Z", "01:59", "01:59"),
            ("2026-03-08T07:00:00Z", "03:00", "02:00"),
            ("2026-11-01T05:59:00Z", "01:59", "00:59"),
            ("2026-11-01T06:00:00Z", "01:00", "01:00"),
        ] {
            let at = instant(at);
            assert_eq!(
                (&*civil.time(at), &*standard.time(at)),
                (civil_time, standard_time)
            );
        }
        let year = ["2026-01-21T12:00:00Z", "2026-06-21T12:00:00Z"].map(instant);
        assert_eq!(civil.name(year.into_iter()), "EST and EDT");
        assert_eq!(standard.name(year.into_iter()), "EST");
    }

    #[test]
    fn zones_without_summer_time_have_one_name() {
        let clock = Clock::standard(TimeZone::get("Asia/Kolkata").unwrap());
        assert_eq!(
            clock.iso(instant("2026-06-21T00:00:00Z")),
            "2026-06-21T05:30:00+05:30"
        );
        assert_eq!(
            clock.name([instant("2026-06-21T00:00:00Z")].into_iter()),
            "IST"
        );
    }

    #[test]
    fn lengths_are_in_hours_and_minutes() {
        assert_eq!(length(0.0), "0 min");
        assert_eq!(length(12.0), "less than a minute");
        assert_eq!(length(3570.0), "1 h 00 min");
        assert_eq!(length(7500.0), "2 h 05 min");
    }
}
