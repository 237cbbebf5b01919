//! Sheets keep their laws, and arcs keep the time.

use jiff::ToSpan;
use ombra_sun::{
    Arc, Hours, Instant, Knots, MAX_ARCS, MAX_SWEEP, Place, Refraction, Sheet, Sky, Span,
};

use crate::{Random, date, mean_time, sky, up};

/// How far an arc is off the true sun, at worst over its time.
#[derive(Clone, Copy, Debug, Default)]
struct Error {
    /// Degrees.
    angle: f64,
    /// Seconds that the sun takes for the part of it along its way.
    time: f64,
}

impl Error {
    fn of(sky: &Sky, arc: &Arc) -> Self {
        let mut worst = Self::default();
        for k in 1..16 {
            let share = f64::from(k) / 16.0;
            let at = Instant::from_seconds(arc.start + share * (arc.end - arc.start));
            let (truth, later) = (sky.direction(at - 5.0), sky.direction(at + 5.0));
            let middle = sky.direction(at);
            let q = unit(arc.direction(share));
            let off: [f64; 3] = std::array::from_fn(|i| q[i] - middle[i]);
            let speed: [f64; 3] = std::array::from_fn(|i| (later[i] - truth[i]) / 10.0);
            worst.angle = worst.angle.max(dot(off, off).sqrt().to_degrees());
            worst.time = worst.time.max((dot(off, speed) / dot(speed, speed)).abs());
        }
        worst
    }

    fn max(self, other: Self) -> Self {
        Self {
            angle: self.angle.max(other.angle),
            time: self.time.max(other.time),
        }
    }

    fn over(sky: &Sky, sheets: &[Sheet]) -> Self {
        let arcs = sheets.iter().flat_map(Sheet::arcs);
        arcs.map(|arc| Self::of(sky, arc))
            .fold(Self::default(), Self::max)
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn unit(a: [f64; 3]) -> [f64; 3] {
    let length = dot(a, a).sqrt();
    a.map(|x| x / length)
}

/// On which side of the vertical the way of an arc goes by, and how far: positive if it turns
/// clockwise about it.
fn side(arc: &Arc, share: f64) -> f64 {
    let at = arc.direction(share);
    let slope = |i: usize| arc.to[i] - arc.from[i] + (1.0 - 2.0 * share) * arc.bulge[i];
    (slope(0) * at[1] - at[0] * slope(1)) / slope(0).hypot(slope(1)).max(1e-12)
}

/// The laws that a sheet promises, looked for between the knots as well.
pub(crate) fn lawful(sky: &Sky, span: Span, sheets: &[Sheet]) {
    let what = format!("{sky:?} {span:?}");
    assert!(!sheets.is_empty(), "{what}");
    let mut at = span.start;
    for sheet in sheets {
        assert_eq!(sheet.span().start, at, "{what}");
        at = sheet.span().end;
        assert!((1..=MAX_ARCS).contains(&sheet.arcs().len()), "{what}");
        for pair in sheet.arcs().windows(2) {
            assert_eq!((pair[0].end, pair[0].to), (pair[1].start, pair[1].from));
        }
        let sweep = sheet.sweep();
        let sign = if sheet.clockwise() { 1.0 } else { -1.0 };
        assert!(sweep * sign >= 0.0, "{sweep} {what}");
        assert!(sweep.abs() <= MAX_SWEEP, "{sweep} {what}");
        let mut before = sheet.arcs()[0].from;
        let (mut turned, mut near, mut falling) = (0.0, 0.0_f64, false);
        for arc in sheet.arcs() {
            assert!(arc.start < arc.end, "{what}");
            for k in 1..=20 {
                let now = unit(arc.direction(f64::from(k) / 20.0));
                let sine = now[0] * before[1] - now[1] * before[0];
                let turn = sine.atan2(now[0] * before[0] + now[1] * before[1]);
                turned += turn.abs().to_degrees();
                near = near.max(now[2]);
                // Turned back by so much, or gone by on the wrong side of the vertical.
                let radius = now[0].hypot(now[1]).min(before[0].hypot(before[1]));
                let beside = side(arc, f64::from(k) / 20.0);
                let back = -sign
                    * if sign * turn * radius < -3e-8 {
                        beside
                    } else {
                        0.0
                    };
                assert!(back < 3e-8, "turns back by {back} at {k} {arc:?} {what}");
                let climb = now[2] - before[2];
                assert!(
                    !falling || climb < 2e-8,
                    "climbs again by {climb} {arc:?} {what}"
                );
                falling |= climb < -2e-8;
                before = now;
            }
        }
        // Close to the zenith, one step may take more than half a turn.
        let plain = near < 0.9999;
        assert!(
            !plain || (turned - sweep.abs()).abs() < 1e-5,
            "{turned} {sweep} {what}"
        );
    }
    assert_eq!(at, span.end, "{what}");
}

#[test]
fn sheets_of_random_places_and_days_are_lawful() {
    let mut random = Random(5);
    let mut worst = [Error::default(); 2];
    for round in 0..400 {
        let latitude = match round % 4 {
            0 => random.within(-25.0, 25.0),
            1 => random.within(60.0, 90.0),
            2 => random.within(-90.0, -60.0),
            _ => random.within(-66.0, 66.0),
        };
        let place = Place::new(latitude, random.within(-180.0, 180.0), 0.0).unwrap();
        let air = round / 4 % 2;
        let sky = Sky::new(place, [Refraction::None, Refraction::SEA][air]).unwrap();
        let day = date("2024-01-01") + (random.within(0.0, 730.0) as i64).days();
        for span in Hours::default().spans(&sky, &mean_time(place.longitude), day) {
            let sheets = Sheet::cover(&sky, span);
            lawful(&sky, span, &sheets);
            let error = Error::over(&sky, &sheets);
            worst[air] = worst[air].max(error);
        }
    }
    println!("without air {:?}, with {:?}", worst[0], worst[1]);
    assert!(
        worst[0].time < 1e-3 && worst[0].angle < 1e-5,
        "{:?}",
        worst[0]
    );
    assert!(
        worst[1].time < 0.05 && worst[1].angle < 3e-4,
        "{:?}",
        worst[1]
    );
}

/// Where the sun's way is at its most awkward: through the zenith, along the equator at the
/// equinox, about the poles, and grazing the horizon.
#[test]
fn sheets_of_awkward_places_and_days_are_lawful() {
    let mut latitudes = vec![
        0.0, 1e-6, 1e-3, 0.1, 66.5, 67.2, 89.0, 89.9, 89.95, 89.999, 90.0,
    ];
    latitudes.extend([23.43, 23.435, 23.436, 23.437, 23.44, 23.5, 24.9, 25.1]);
    let south: Vec<_> = latitudes.iter().map(|latitude| -latitude).collect();
    latitudes.extend(south);
    for latitude in latitudes {
        let sky = sky(latitude, 0.0);
        for day in [
            "2026-03-18",
            "2026-03-19",
            "2026-03-20",
            "2026-03-21",
            "2026-03-22",
            "2026-06-21",
            "2026-07-30",
            "2026-09-22",
            "2026-09-23",
            "2026-09-24",
            "2026-12-21",
        ] {
            for span in up(&sky, day) {
                lawful(&sky, span, &Sheet::cover(&sky, span));
            }
        }
    }
}

/// Straight overhead at noon, and past it by a hair on either side.
#[test]
fn sheets_through_the_zenith_are_lawful() {
    for day in ["2026-04-20", "2026-05-16", "2026-08-10"] {
        let at = crate::instant(&format!("{day}T12:00:00Z"));
        let noon = sky(15.0, 0.0).at_solar_time(43_200.0, at);
        // Where the sun is overhead at that noon, to about the last bit.
        let mut latitude = 15.0;
        for _ in 0..20 {
            let direction = sky(latitude, 0.0).direction(noon);
            latitude += direction[1].asin().to_degrees();
        }
        for off in [0.0, 1e-9, 1e-6, 1e-4, 1e-3, 0.01, 0.1, 1.0] {
            for latitude in [latitude - off, latitude + off] {
                let sky = sky(latitude, 0.0);
                for span in up(&sky, day) {
                    let sheets = Sheet::cover(&sky, span);
                    lawful(&sky, span, &sheets);
                    assert!(Error::over(&sky, &sheets).time < 1e-3);
                }
            }
        }
    }
}

#[test]
fn short_spans_have_sheets() {
    let sky = sky(52.0, 4.0);
    let noon = crate::instant("2026-06-21T12:00:00Z");
    for seconds in [0.002, 0.5, 20.0, 59.0, 61.0, 3600.0] {
        let span = Span::new(noon, noon + seconds);
        let sheets = Sheet::cover(&sky, span);
        lawful(&sky, span, &sheets);
        assert!(sheets[0].arcs().len() <= 7);
    }
    assert_eq!(Sheet::cover(&sky, Span::new(noon, noon)), []);
    assert_eq!(Sheet::cover(&sky, Span::new(noon, noon - 5.0)), []);
}

#[test]
fn how_many_sheets_and_arcs() {
    let count = |latitude: f64, day: &str| {
        let sky = sky(latitude, 0.0);
        let spans = up(&sky, day);
        assert_eq!(spans.len(), 1);
        let sheets = Sheet::cover(&sky, spans[0]);
        let arcs: Vec<_> = sheets.iter().map(|sheet| sheet.arcs().len()).collect();
        (arcs, sheets[0].clockwise())
    };
    assert_eq!(count(40.75, "2026-06-21"), (vec![45], true));
    assert_eq!(count(-40.75, "2026-12-21"), (vec![45], false));
    // North of the zenith at noon: south of it near the horizon, then back.
    assert_eq!(count(10.0, "2026-06-21").0.len(), 3);
    // A day about the pole: the piece before the lowest sun, and two halves.
    assert!(count(75.0, "2026-06-21").0.len() <= 4);
}

/// Sparse knots still keep the time, which is what the choice of the bulge is for.
#[test]
fn arcs_of_half_an_hour_keep_the_time_to_milliseconds() {
    let knots = Knots {
        spacing: 1800.0,
        ..Knots::default()
    };
    for latitude in [0.0, 23.0, 40.75, 52.0, 64.0, 78.0, -35.0] {
        let sky = sky(latitude, 0.0);
        for day in ["2026-06-21", "2026-09-02", "2026-12-21"] {
            for span in up(&sky, day) {
                let sheets = Sheet::cover_with(&sky, span, knots);
                let error = Error::over(&sky, &sheets);
                assert!(
                    error.time < 2e-3 && error.angle < 1e-4,
                    "{latitude} {day} {error:?}"
                );
            }
        }
    }
}

/// What an arc's doc says of the bulge.
#[test]
fn arcs_meet_the_sun_in_the_middle() {
    let sky = sky(52.0, 4.0);
    let span = up(&sky, "2026-06-21")[0];
    for arc in Sheet::cover(&sky, span)[0].arcs() {
        let middle = sky.direction(Instant::from_seconds(0.5 * (arc.start + arc.end)));
        let q = unit(arc.direction(0.5));
        let off = (0..3).map(|i| (q[i] - middle[i]).abs()).fold(0.0, f64::max);
        assert!(off < 1e-15, "{off}");
        let chord: [f64; 3] = std::array::from_fn(|i| arc.to[i] - arc.from[i]);
        assert!(dot(arc.bulge, chord).abs() < 1e-6 * dot(chord, chord).sqrt());
    }
}

#[test]
fn a_year_of_sheets_is_quick() {
    let (sky, zone) = (sky(52.0, 4.0), mean_time(4.0));
    let started = std::time::Instant::now();
    let year = date("2026-01-01").series(1.day()).take(365);
    let arcs: usize = year
        .flat_map(|day| Hours::default().spans(&sky, &zone, day))
        .flat_map(|span| Sheet::cover(&sky, span))
        .map(|sheet| sheet.arcs().len())
        .sum();
    println!("{arcs} arcs in {:?}", started.elapsed());
    assert!(arcs > 365 * 30);
}

#[test]
fn knots_out_of_range_are_brought_within() {
    let sky = sky(40.75, 0.0);
    let span = up(&sky, "2026-06-21")[0];
    for value in [f64::NAN, f64::INFINITY, -1.0, 0.0, 1e9] {
        let knots = Knots {
            spacing: value,
            crowding: value,
            low: value,
        };
        let sheets = Sheet::cover_with(&sky, span, knots);
        lawful(&sky, span, &sheets);
    }
}
