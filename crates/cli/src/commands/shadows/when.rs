//! From what was typed to stretches of time and the way of the sun.

use anyhow::bail;
use jiff::civil::Date;
use jiff::tz::TimeZone;
use ombra::accrual::Samples;
use ombra::sun::{
    Calendar, Days, Disc, Hours, MAX_DAYS, Months, Place, Refraction, Sheet, Sky, Span, SunError,
    Weekdays, Window,
};
use rayon::prelude::*;

use super::args::{Said, SunArgs, WhenArgs};
use super::{no_days, wrong_usage};

/// More samples would fill the memory.
const MOST_SAMPLES: f64 = 1e7;

/// The stretches of time that count, and where the sun is meanwhile.
pub(super) struct When {
    pub(super) days: usize,
    pub(super) spans: Vec<Span>,
    /// Where the spans of each day end.
    ends: Vec<usize>,
    /// The points that stand for the sun, each for the same share of it: one, or those of its disc.
    pub(super) suns: Vec<Sky>,
    pub(super) is_refracted: bool,
    pub(super) zone: String,
    pub(super) time_zone: TimeZone,
    /// For people: which days and hours.
    pub(super) text: String,
    /// All days, and the first and the last of them.
    pub(super) dates: Vec<Date>,
    pub(super) ends_on: [Date; 2],
}

impl When {
    /// `step` is that of samples, in seconds, where there are any.
    pub(super) fn new(
        args: &WhenArgs,
        sun: SunArgs,
        place: Place,
        step: Option<f64>,
    ) -> anyhow::Result<Self> {
        let calendar = calendar(args, &place)?;
        let zone = calendar.zone.clone();
        let (days, named) = days(args, &calendar)?;
        let weekdays = args
            .weekdays
            .as_ref()
            .map_or_else(Weekdays::default, |said| said.value);
        let months = args
            .months
            .as_ref()
            .map_or_else(Months::default, |said| said.value);
        let days = days.only(weekdays, months);
        let days = days.unwrap_or_else(|error| wrong_usage(&error.to_string()));
        let refraction = if sun.refraction {
            Refraction::SEA
        } else {
            Refraction::None
        };
        let sky = Sky::new(place, refraction)?;
        let hours = hours(args).unwrap_or_else(|error| wrong_usage(&error.to_string()));
        let by_day: Vec<Vec<Span>> = (days.dates().par_iter())
            .map(|&date| hours.spans(&sky, &zone, date))
            .collect();
        let spans = by_day.concat();
        let suns = if sun.disc {
            Disc::default().skies(&sky)
        } else {
            vec![sky]
        };
        let most_days = MAX_DAYS / suns.len();
        if days.dates().len() > most_days {
            wrong_usage(&format!(
                "--disc: {} days are more than {most_days}: take fewer days",
                days.dates().len()
            ));
        }
        let seconds = spans.iter().map(Span::seconds).sum::<f64>();
        let samples = step.map_or(0.0, |step| seconds / step * suns.len() as f64);
        if samples > MOST_SAMPLES {
            wrong_usage(&format!(
                "--step: {samples:.0} samples are more than {MOST_SAMPLES}: take longer steps or fewer days"
            ));
        }
        if spans.is_empty() {
            bail!("{}", no_sun(&sky, &zone, days.dates(), &text(args, &named)));
        }
        Ok(Self {
            days: by_day.len(),
            ends: (by_day.iter())
                .scan(0, |end, day| {
                    *end += day.len();
                    Some(*end)
                })
                .collect(),
            spans,
            suns,
            is_refracted: sun.refraction,
            zone: zone.iana_name().unwrap_or("its own time zone").to_owned(),
            time_zone: zone,
            text: text(args, &with_ends(&named, days.dates())),
            dates: days.dates().to_vec(),
            ends_on: [days.dates()[0], days.dates()[days.dates().len() - 1]],
        })
    }

    /// Hours in which the sun counts.
    pub(super) fn hours(&self) -> f64 {
        self.spans.iter().map(Span::seconds).sum::<f64>() / 3600.0
    }

    /// The least altitude of the sun in these hours, in radians, or a little less.
    pub(super) fn lowest_altitude(&self) -> f64 {
        const STEP: f64 = 600.0;
        // Where the sun turns between two looks, as on a polar night, it is lower by no more than this.
        const TURN: f64 = 3e-4;
        // No point of the disc is farther from the middle.
        const RADIUS: f64 = 4.8e-3;
        let below = if self.is_disc() { TURN + RADIUS } else { TURN };
        // The points that stand for the sun have the one in the middle first.
        let sky = self.suns[0];
        let of_span = |span: &Span| {
            let (_, middles) = span.middles(STEP);
            let instants = middles.chain([span.start, span.end]);
            let altitude = |instant| sky.direction(instant)[2].clamp(-1.0, 1.0).asin();
            instants.map(altitude).fold(f64::INFINITY, f64::min)
        };
        let lowest = self.spans.par_iter().map(of_span);
        lowest.reduce(|| f64::INFINITY, f64::min) - below
    }

    /// The days, and what counts of each.
    pub(super) fn by_day(&self) -> impl Iterator<Item = (Date, &[Span])> {
        let begins = [0].into_iter().chain(self.ends.iter().copied());
        let days = begins
            .zip(&self.ends)
            .map(|(begin, &end)| &self.spans[begin..end]);
        self.dates.iter().copied().zip(days)
    }

    /// The way of the sun, day by day: of all points that stand for it.
    pub(super) fn sheets(&self) -> Vec<Vec<Sheet>> {
        let days: Vec<&[Span]> = self.by_day().map(|day| day.1).collect();
        let sheets = |spans: &&[Span]| {
            let of_span =
                |&span: &Span| (self.suns.iter()).flat_map(move |sun| Sheet::cover(sun, span));
            spans.iter().flat_map(of_span).collect()
        };
        days.par_iter().map(sheets).collect()
    }

    pub(super) fn samples(&self, step: f64) -> Vec<Samples> {
        (self.suns.par_iter())
            .map(|sun| Samples::new(sun, &self.spans, step))
            .collect()
    }

    pub(super) const fn is_disc(&self) -> bool {
        self.suns.len() > 1
    }

    /// What the sun is taken for, for people.
    pub(super) fn sun(&self) -> String {
        if self.is_disc() {
            format!("a disc of {} points", self.suns.len())
        } else {
            "a point".to_owned()
        }
    }
}

/// By whose clock days begin, and which year is that of days without one.
pub(super) fn calendar(args: &WhenArgs, place: &Place) -> anyhow::Result<Calendar> {
    let zone = match &args.time_zone {
        Some(name) => TimeZone::get(name).unwrap_or_else(|_| {
            wrong_usage(&format!(
                "--time-zone {name}: no such time zone; one is Europe/Berlin"
            ))
        }),
        None => place.time_zone()?,
    };
    let this_year = jiff::ZonedDateTime::now()
        .with_time_zone(zone.clone())
        .year();
    let year = args.year.unwrap_or(this_year);
    let calendar = Calendar::with_zone(place, year, zone);
    Ok(calendar.unwrap_or_else(|error| wrong_usage(&format!("--year {year}: {error}"))))
}

fn days(args: &WhenArgs, calendar: &Calendar) -> anyhow::Result<(Days, String)> {
    let (option, named) = match (&args.date, &args.from, &args.to, &args.season) {
        (Some(date), ..) => ("--date", date.clone()),
        (_, Some(from), Some(to), _) => ("--from --to", format!("{from}..{to}")),
        (.., Some(season)) => {
            let days = Days::season(season.value, calendar.year, calendar)?;
            return Ok((days, format!("{} {}", season.text, calendar.year)));
        }
        _ => no_days(),
    };
    match Days::parse(&named, calendar) {
        Ok(days) => Ok((days, named)),
        Err(error) => wrong_usage(&format!("{option} {named}: {error}")),
    }
}

/// What a name such as "winter 2026" means is said, too.
fn with_ends(named: &str, dates: &[Date]) -> String {
    match dates {
        [first, .., last] if named.contains(char::is_alphabetic) => {
            format!("{named} ({first} to {last})")
        }
        _ => named.to_owned(),
    }
}

/// Why there is no shadow to measure.
fn no_sun(sky: &Sky, zone: &TimeZone, dates: &[Date], asked: &str) -> String {
    let up = |&date: &Date| Hours::default().spans(sky, zone, date);
    let spans: Vec<Span> = dates.iter().flat_map(up).collect();
    if spans.is_empty() {
        return format!("the sun does not rise ({asked}): there is no shadow to measure");
    }
    let altitudes = spans.iter().flat_map(|span| {
        let (_, middles) = span.middles(600.0);
        middles.map(|instant| sky.direction(instant)[2].asin().to_degrees())
    });
    let highest = altitudes.fold(0.0, f64::max);
    let hours = spans.iter().map(Span::seconds).sum::<f64>() / 3600.0;
    format!(
        "nothing is left of the {hours:.1} h of sun, which stands {highest:.1}° high at most ({asked}): there is no shadow to \
         measure"
    )
}

fn hours(args: &WhenArgs) -> Result<Hours, SunError> {
    let windows = |said: &Option<Said<Vec<Window>>>| {
        said.as_ref()
            .map_or_else(Vec::new, |said| said.value.clone())
    };
    Hours::default()
        .with_windows(&windows(&args.hours), &windows(&args.solar_time))?
        .with_margins(args.after_sunrise, args.before_sunset)?
        .with_sunrise(args.sunrise)?
        .with_min_altitude(args.min_altitude.unwrap_or(0.0))
}

fn text(args: &WhenArgs, named: &str) -> String {
    let mut parts = vec![named.replace("..", " to ")];
    parts.extend(args.weekdays.iter().map(|said| said.text.clone()));
    parts.extend(args.months.iter().map(|said| said.text.clone()));
    parts.extend(args.hours.iter().map(|said| said.text.clone()));
    let solar = |said: &Said<_>| format!("{} true solar time", said.text);
    parts.extend(args.solar_time.iter().map(solar));
    let minutes = |seconds: f64| format!("{:.0} min", seconds / 60.0);
    if args.after_sunrise > 0.0 {
        parts.push(format!(
            "from {} after sunrise",
            minutes(args.after_sunrise)
        ));
    }
    if args.before_sunset > 0.0 {
        parts.push(format!("to {} before sunset", minutes(args.before_sunset)));
    }
    let lowest = args.min_altitude.filter(|&lowest| lowest > 0.0);
    parts.extend(lowest.map(|lowest| format!("sun at least {lowest}° high")));
    parts.join(", ")
}
