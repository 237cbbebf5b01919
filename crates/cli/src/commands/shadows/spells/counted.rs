//! Which time is asked about, and by how much it counts.

use jiff::civil::Date;
use jiff::tz::TimeZone;
use ombra::accrual::Counted;
use ombra::sun::{Calendar, Days, Hours, Sky, Span, Window};

/// By how much some hours or days count: `12:00-14:00=2`, `2026-12-21=0.5`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Weight {
    what: String,
    /// Hours by the clock; days where there are none.
    hours: Option<Vec<Window>>,
    weight: f64,
}

impl Weight {
    /// As it was typed.
    pub(super) fn text(&self) -> String {
        format!("{}={}", self.what, self.weight)
    }

    /// From text; days are read later, by whose calendar they are.
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        let wanted = "hours or days and a number are wanted, as 12:00-14:00=2 or winter=0.5";
        let (what, weight) = text.rsplit_once('=').ok_or(wanted)?;
        let weight = weight.trim().parse().ok();
        let weight = weight
            .filter(|weight: &f64| (0.0..=1e6).contains(weight))
            .ok_or(wanted)?;
        let hours = if what.contains(':') {
            Some(Window::list(what).map_err(|error| error.to_string())?)
        } else {
            None
        };
        let what = what.to_owned();
        Ok(Self {
            what,
            hours,
            weight,
        })
    }
}

/// Some stretches of time, in order, each with its weight: those of all weights that it lies in, multiplied. And those weights that none
/// of it lies in.
pub(super) fn weighed(
    spans: &[Span],
    weights: &[Weight],
    dates: &[Date],
    (sky, zone, calendar): (&Sky, &TimeZone, &Calendar),
) -> Result<(Vec<Counted>, Vec<String>), String> {
    let mut idle = Vec::new();
    let mut all: Vec<Counted> = spans.iter().map(|&span| Counted::plainly(span)).collect();
    for weight in weights {
        let (hours, days) = match &weight.hours {
            Some(windows) => {
                let hours = Hours::default().with_windows(windows, &[]);
                (hours.map_err(|error| error.to_string())?, dates.to_vec())
            }
            None => {
                let days = Days::parse(&weight.what, calendar);
                let days = days.map_err(|error| format!("--weight {}: {error}", weight.what))?;
                (Hours::default(), days.dates().to_vec())
            }
        };
        let within: Vec<Span> = days
            .iter()
            .flat_map(|&date| hours.spans(sky, zone, date))
            .collect();
        let now: Vec<Span> = all.iter().map(|counted| counted.span).collect();
        if Span::intersection(&now, &within).is_empty() {
            idle.push(weight.text());
        }
        all = all
            .iter()
            .flat_map(|counted| split(counted, &within, weight.weight))
            .collect();
    }
    Ok((all, idle))
}

/// The parts of a stretch of time within others, by a weight more, and without.
fn split(counted: &Counted, within: &[Span], weight: f64) -> Vec<Counted> {
    let own = [counted.span];
    let part = |weight| move |span| Counted { span, weight };
    let inside = Span::intersection(&own, within).into_iter();
    let outside = Span::difference(&own, within).into_iter();
    let inside = inside.map(part(counted.weight * weight));
    let mut parts: Vec<Counted> = inside.chain(outside.map(part(counted.weight))).collect();
    parts.sort_by_key(|part| part.span.start);
    parts
}

#[cfg(test)]
mod tests {
    use ombra::sun::Instant;

    use super::*;

    fn span(from: f64, to: f64) -> Span {
        Span::new(Instant::from_seconds(from), Instant::from_seconds(to))
    }

    #[test]
    fn a_weight_is_hours_or_days_and_a_number() {
        assert!(Weight::parse("12:00-14:00=2").unwrap().hours.is_some());
        assert!(Weight::parse("2026-12-21=0").unwrap().hours.is_none());
        for wrong in [
            "",
            "2",
            "12:00-14:00",
            "12:00=1",
            "winter=-1",
            "winter=x",
            "winter=inf",
        ] {
            assert!(Weight::parse(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn weights_part_time_and_multiply() {
        let counted = Counted {
            span: span(0.0, 10.0),
            weight: 3.0,
        };
        let parts = split(
            &counted,
            &[span(-1.0, 2.0), span(4.0, 6.0), span(9.0, 20.0)],
            2.0,
        );
        let expected = [
            (0.0, 2.0, 6.0),
            (2.0, 4.0, 3.0),
            (4.0, 6.0, 6.0),
            (6.0, 9.0, 3.0),
            (9.0, 10.0, 6.0),
        ];
        let expected = expected.map(|(from, to, weight)| Counted {
            span: span(from, to),
            weight,
        });
        assert_eq!(parts, expected);
        assert_eq!(split(&counted, &[], 2.0), [counted]);
    }
}
