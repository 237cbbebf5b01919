//! A sun that is a disc: points of equal weight, each with its own sheets.

use jiff::ToSpan as _;
use jiff::civil::date;
use ombra_accrual::{Exact, Fast, Occluders, Sampled, Samples, Tiles};
use ombra_city::{Facet, Grid, procedural_city};
use ombra_geometry::Point3;
use ombra_sun::{Disc, Hours, Place, Refraction, Sheet, Sky, Span};

use crate::solids::{Block, city, four_days, sheets, sky, spans};

/// Seconds of shadow, each point by its share.
fn partial(
    disc: &Disc,
    facets: &[Facet],
    sky: &Sky,
    spans: &[Span],
    places: &[Point3],
) -> Vec<f64> {
    let suns = disc.skies(sky);
    let sheets: Vec<Sheet> = suns.iter().flat_map(|sun| sheets(sun, spans)).collect();
    let occluders = Occluders::new(facets);
    let sums = Exact::new(&occluders, &sheets).seconds(places);
    sums.into_iter()
        .map(|sum| sum / suns.len() as f64)
        .collect()
}

/// A wall along x at y = -distance, seen from both sides.
fn wall(distance: f32, from: f32, to: f32, high: f32) -> Facet {
    let corner = |x: f32, z: f32| Point3::new(x, -distance, z);
    Facet {
        corners: [
            corner(from, 0.0),
            corner(to, 0.0),
            corner(to, high),
            corner(from, high),
        ],
        is_two_sided: true,
        owner: 0,
    }
}

#[test]
fn a_single_edge_takes_as_long_before_the_disc_as_before_its_middle() {
    // In the tropics the sun goes along the edge, near the zenith, and at an equinox along the wall.
    let days = [
        date(2026, 5, 2),
        date(2026, 6, 21),
        date(2026, 11, 2),
        date(2026, 12, 21),
    ];
    for latitude in [-64.0_f64, -33.9, 33.9, 40.7, 52.0, 64.0] {
        let sky = sky(latitude);
        let facets = [wall(20.0_f32.copysign(latitude as f32), -1e5, 3.0, 1e5)];
        for day in days {
            let spans = spans(&sky, &[day]);
            let whole = partial(&Disc::default(), &facets, &sky, &spans, &[Point3::ORIGIN]);
            let middle = partial(
                &Disc::with_rings(0),
                &facets,
                &sky,
                &spans,
                &[Point3::ORIGIN],
            );
            let error = (whole[0] - middle[0]).abs();
            assert!(error < 1.0, "{latitude} {day}: {error}");
        }
    }
}

/// The share of the disc on the near side of a line, `u` radii beyond its middle.
fn segment(u: f64) -> f64 {
    let u = u.clamp(-1.0, 1.0);
    0.5 + (u * (1.0 - u * u).sqrt() + u.asin()) / std::f64::consts::PI
}

/// Seconds that a strip between two upright planes through the place covers, by how much of the disc lies between them.
fn strip(sky: &Sky, span: Span, distance: f64, half: f64, radius: f64) -> f64 {
    let side = |x: f64| {
        let length = distance.hypot(x);
        // To the left of the way from the place to the edge at x, for a sun in the south.
        move |sun: [f64; 3]| ((sun[0] * distance + sun[1] * x) / length).asin() / radius
    };
    let (east, west) = (side(half), side(-half));
    let (each, middles) = span.middles(0.25);
    let covered = |at| {
        let sun = sky.direction(at);
        let share = segment(west(sun)) - segment(east(sun));
        if sun[1] < 0.0 { share } else { 0.0 }
    };
    middles.map(covered).sum::<f64>() * each
}

/// A pole of 10 cm is thinner than the sun: it never covers all of it.
#[test]
fn a_thin_pole_throws_partial_shade() {
    let sky = sky(52.0);
    let day = spans(&sky, &[date(2026, 3, 21)]);
    let radius = (959.63_f64 / 3600.0 / 0.9963).to_radians();
    let noon = sky.at_solar_time(43_200.0, day[0].start);
    for (distance, thickness) in [(20.0_f32, 0.1_f32), (35.0, 0.1), (60.0, 0.1)] {
        let pole = [wall(distance, -0.5 * thickness, 0.5 * thickness, 500.0)];
        let (far, half) = (f64::from(distance), 0.5 * f64::from(thickness));
        let seconds = |disc: &Disc, span| partial(disc, &pole, &sky, &[span], &[Point3::ORIGIN])[0];
        // All of its passing.
        let expected = strip(&sky, day[0], far, half, radius);
        let found = seconds(&Disc::default(), day[0]);
        assert!(
            (found - expected).abs() < 0.3,
            "{distance} m: {found} {expected}"
        );
        assert!(found > 5.0);
        // Only while it stands before the middle: to a point the pole is then the whole sky.
        let span = Span::new(noon - 3.0, noon + 3.0);
        let expected = strip(&sky, span, far, half, radius);
        assert_eq!(seconds(&Disc::with_rings(0), span), span.seconds());
        let found = seconds(&Disc::with_rings(11), span);
        assert!(
            (found - expected).abs() < 0.03 * 6.0,
            "{distance} m: {found} {expected}"
        );
        assert!(found < 0.8 * span.seconds());
    }
}

#[test]
fn a_day_is_within_a_second_of_rays_to_397_points() {
    let disc = Disc::with_rings(11);
    let mut errors = Vec::new();
    for (seed, latitude) in [(31, 40.7), (32, -33.9)] {
        let (facets, places) = city(seed, 90);
        let places = &places[..16];
        let sky = sky(latitude);
        for day in [date(2026, 6, 21), date(2026, 12, 21)] {
            let spans = spans(&sky, &[day]);
            let rays = Sampled::new(&facets);
            let mut truth = vec![0.0; places.len()];
            for sun in disc.skies(&sky) {
                let seconds = rays.seconds(&Samples::new(&sun, &spans, 30.0), places);
                for (sum, seconds) in truth.iter_mut().zip(seconds) {
                    *sum += seconds / disc.points().len() as f64;
                }
            }
            let found = partial(&Disc::default(), &facets, &sky, &spans, places);
            let middle = partial(&Disc::with_rings(0), &facets, &sky, &spans, places);
            for ((found, truth), middle) in found.iter().zip(truth).zip(middle) {
                errors.push([(found - truth).abs(), (middle - truth).abs()]);
            }
        }
    }
    let mean = |k: usize| errors.iter().map(|pair| pair[k]).sum::<f64>() / errors.len() as f64;
    println!("7 points {} s, their middle {} s", mean(0), mean(1));
    assert!(
        mean(0) < 1.0 && mean(1) > 5.0 * mean(0),
        "{} {}",
        mean(0),
        mean(1)
    );
}

/// While the sun rises, too: what of the disc is below the horizon is as covered as what is above.
#[test]
fn a_court_is_dark_all_day_an_open_place_never_and_one_more_block_takes_no_shadow_away() {
    let court = |k: usize, centre| Block {
        centre,
        half: if k < 2 { [30.0, 1.0] } else { [1.0, 30.0] },
        angle: 0.0,
        low: 0.0,
        high: 1e5,
    };
    let sides = [[0.0, 20.0], [0.0, -20.0], [20.0, 0.0], [-20.0, 0.0]];
    let court: Vec<Facet> = (0..4)
        .flat_map(|k| court(k, sides[k]).facets(k as u32))
        .collect();
    for latitude in [-33.9, 52.0, 66.0] {
        let sky = sky(latitude);
        let spans = spans(&sky, &four_days());
        let up: f64 = spans.iter().map(Span::seconds).sum();
        let seconds = |facets: &[Facet], places: &[Point3]| {
            partial(&Disc::default(), facets, &sky, &spans, places)
        };
        let dark = seconds(&court, &[Point3::ORIGIN])[0];
        assert!((dark - up).abs() < 0.01, "{latitude}: {dark} of {up}");
        assert_eq!(seconds(&[], &[Point3::ORIGIN]), [0.0]);
        let (facets, places) = city(41, 40);
        let fewer = seconds(&facets[..facets.len() - 6], &places);
        for (more, fewer) in seconds(&facets, &places).iter().zip(fewer) {
            assert!(*more >= fewer - 1e-3 && *more <= up + 1e-3);
        }
    }
}

#[test]
fn some_days_stand_for_all_with_a_disc_as_well() {
    let city = procedural_city(3, 40);
    let occluders = Occluders::new(&city.facets());
    let tiles = Tiles::on_ground(&city, &Grid::over(&city.facets(), 20.0).unwrap(), |_| true);
    for latitude in [40.7, 10.0] {
        let sky = Sky::new(Place::new(latitude, 0.0, 0.0).unwrap(), Refraction::None).unwrap();
        let suns = Disc::with_rings(1).skies(&sky);
        let day = |date| {
            let spans = Hours::default().spans(&sky, &jiff::tz::TimeZone::UTC, date);
            suns.iter().flat_map(|sun| sheets(sun, &spans)).collect()
        };
        let days: Vec<Vec<Sheet>> = (date(2026, 3, 1).series(1.day()).take(120))
            .map(day)
            .collect();
        let sheets = days.concat();
        let up: f64 = sheets.iter().map(|sheet| sheet.span().seconds()).sum();
        let fast = Fast::new(&occluders, &days, &tiles, 0.005, || true).unwrap();
        let found = fast.seconds_of(&tiles, 0..tiles.len());
        let exact = Exact::new(&occluders, &sheets).seconds_of(&tiles, 0..tiles.len());
        let off = found.iter().zip(&exact).map(|(a, b)| (a - b).abs());
        let off = off.fold(0.0, f64::max);
        assert!(off <= 0.005 * up, "{latitude}: {off} of {up}");
        assert!(
            (1..60).contains(&fast.days()),
            "{latitude}: {}",
            fast.days()
        );
    }
}
