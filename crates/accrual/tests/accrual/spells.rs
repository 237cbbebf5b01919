//! Stretches of shadow against rays to every polygon.

use ombra_accel::Level;
use ombra_accrual::{Exact, Occluders, Spells, Stretch};
use ombra_city::Facet;
use ombra_geometry::Point3;
use ombra_sun::{Instant, Sheet, Sky};

use crate::numbers::Numbers;
use crate::solids::{city, four_days, sheets, sky, spans};

/// Which owners cover the sun of a moment, with how far away each is, the nearest first.
fn covering(facets: &[Facet], sky: &Sky, place: Point3, moment: Instant) -> Vec<(f64, u32)> {
    let sun = sky.direction(moment);
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [
            a[1] * b[2] - a[2] * b[1],
            a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0],
        ]
    };
    let mut found: Vec<(f64, u32)> = Vec::new();
    for facet in facets {
        let away = facet.corners.map(|corner| {
            let (corner, place) = (corner.to_array(), place.to_array());
            [0, 1, 2].map(|k| f64::from(corner[k]) - f64::from(place[k]))
        });
        let minus = |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|k| a[k] - b[k]);
        let normal = cross(minus(away[2], away[0]), minus(away[3], away[1]));
        let along = dot(normal, sun);
        let sides = [0, 1, 2, 3].map(|k| dot(cross(away[k], away[(k + 1) % 4]), sun));
        let is_within =
            sides.iter().all(|&side| side >= 0.0) || sides.iter().all(|&side| side <= 0.0);
        let distance = dot(normal, away[0]) / along;
        let is_seen = facet.is_two_sided || along < 0.0;
        if is_seen && is_within && distance > 0.0 {
            found.push((distance, facet.owner));
        }
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    found
}

fn all_levels(occluders: &Occluders, sheets: &[Sheet], places: &[Point3]) -> Vec<Vec<Stretch>> {
    let found = Spells::new(occluders, sheets).stretches(places);
    for level in Level::available() {
        let other = Spells::new(occluders, sheets).at_level(level);
        assert_eq!(other.stretches(places), found, "{level:?}");
    }
    found.iter().map(<[Stretch]>::to_vec).collect()
}

/// Holds stretches against rays at random moments of four days. How many of these were in shadow, of one alone, of what is no
/// building.
fn hold_against_rays(
    facets: &[Facet],
    places: &[Point3],
    latitude: f64,
    seed: u64,
    moments: usize,
) -> [usize; 3] {
    let occluders = Occluders::new(facets);
    let sky = sky(latitude);
    let spans = spans(&sky, &four_days());
    let found = all_levels(&occluders, &sheets(&sky, &spans), places);
    let mut numbers = Numbers(seed);
    let (mut dark, mut alone, mut besides) = (0, 0, 0);
    for (place, stretches) in places.iter().zip(&found) {
        assert!(stretches.iter().all(|stretch| stretch.from < stretch.to));
        assert!(stretches.windows(2).all(|pair| pair[0].to <= pair[1].from));
        for span in &spans {
            for _ in 0..moments {
                let share = f64::from(numbers.within(0.0, 1.0));
                let moment =
                    Instant::from_seconds(span.start.seconds() + share * (span.end - span.start));
                // At a corner of a polygon or where two cross it is a matter of rounding.
                let around = [-0.3, 0.0, 0.3].map(|later| {
                    let moment = Instant::from_seconds(moment.seconds() + later);
                    let all = covering(facets, &sky, *place, moment);
                    let owner = all.first().map(|own| own.1);
                    (owner, all.iter().all(|own| Some(own.1) == owner))
                });
                if around[0] != around[1] || around[1] != around[2] {
                    continue;
                }
                let own = (stretches.iter()).find(|own| own.from <= moment && moment <= own.to);
                let expected = around[1].0.map(|owner| (owner, around[1].1));
                assert_eq!(
                    own.map(|own| (own.owner, own.is_alone)),
                    expected,
                    "{latitude} {place:?} {moment:?}"
                );
                dark += usize::from(own.is_some());
                alone += usize::from(own.is_some_and(|own| own.is_alone));
                besides += usize::from(own.is_some_and(|own| own.owner >= Facet::CONTEXT));
            }
        }
    }
    [dark, alone, besides]
}

/// A triangle that stands upright, seen from both sides.
fn slope(x: f32, owner: u32) -> Facet {
    Facet {
        corners: [
            Point3::new(x, -30.0, 0.0),
            Point3::new(x + 30.0, -20.0, 50.0),
            Point3::new(x + 60.0, -30.0, 0.0),
            Point3::new(x + 60.0, -30.0, 0.0),
        ],
        is_two_sided: true,
        owner,
    }
}

/// A wall seen from both sides.
fn wall([a, b]: [[f32; 2]; 2], height: f32, owner: u32) -> Facet {
    let at = |[x, y]: [f32; 2], z| Point3::new(x, y, z);
    Facet {
        corners: [at(a, 0.0), at(b, 0.0), at(b, height), at(a, height)],
        is_two_sided: true,
        owner,
    }
}

#[test]
fn each_moment_belongs_to_what_the_ray_meets_first() {
    for (seed, latitude) in [(1, 40.0), (2, -33.0), (3, 8.0), (4, 66.0)] {
        let (mut facets, places) = city(seed, 60);
        // A hill and a tree besides, which are no buildings.
        facets.extend([slope(-60.0, Facet::TERRAIN), slope(10.0, Facet::CONTEXT)]);
        let [dark, alone, besides] = hold_against_rays(&facets, &places, latitude, seed, 20);
        assert!(
            alone > 100 && dark > alone + 100 && besides > 0,
            "{dark} {alone} {besides}"
        );
        // Sixteen neighbours, whom one polygon shades together.
        let near = |k: usize| {
            let centre = places[7 * (k / 16) % places.len()];
            Point3::new(
                centre.x + (k % 4) as f32,
                centre.y + (k / 4 % 4) as f32,
                0.0,
            )
        };
        let near: Vec<Point3> = (0..160).map(near).collect();
        let [dark, alone, _] = hold_against_rays(&facets, &near, latitude, seed, 10);
        assert!(alone > 100 && dark > alone + 100, "{dark} {alone}");
    }
}

#[test]
fn who_stands_in_an_inner_corner_is_seen() {
    // A house with a notch that opens toward the places, and another one whose front crosses it.
    let facets = [
        wall([[5.0, -11.0], [0.0, -20.0]], 60.0, 0),
        wall([[0.0, -20.0], [-5.0, -11.0]], 60.0, 0),
        wall([[-30.0, -19.3], [30.0, -19.3]], 60.0, 1),
    ];
    let places: Vec<Point3> = (0..96)
        .map(|k| Point3::new(-2.4 + 0.05 * k as f32, 0.0, 0.0))
        .collect();
    let [dark, ..] = hold_against_rays(&facets, &places, 48.0, 5, 60);
    assert!(dark > 1000, "{dark}");
    let sky = sky(48.0);
    let sheets = sheets(&sky, &spans(&sky, &four_days()));
    let found = Spells::new(&Occluders::new(&facets), &sheets).stretches(&places);
    let seconds = |stretches: &[Stretch]| -> f64 {
        let own = stretches.iter().filter(|own| own.owner == 1);
        own.map(Stretch::seconds).sum()
    };
    assert!(found.iter().all(|stretches| seconds(stretches) > 60.0));
}

#[test]
fn a_tower_behind_a_tree_is_behind_it() {
    let facets = [
        wall([[-40.0, -30.0], [40.0, -30.0]], 60.0, Facet::CONTEXT),
        wall([[-90.0, -100.0], [90.0, -100.0]], 200.0, 0),
    ];
    let places: Vec<Point3> = (0..16)
        .map(|k| Point3::new((k % 4) as f32, (k / 4) as f32, 0.0))
        .collect();
    hold_against_rays(&facets, &places, 48.0, 6, 60);
    let sky = sky(48.0);
    let sheets = sheets(&sky, &spans(&sky, &four_days()[3..]));
    let found = Spells::new(&Occluders::new(&facets), &sheets).stretches(&places);
    let tree = found
        .iter()
        .flatten()
        .filter(|own| own.owner == Facet::CONTEXT);
    let [mut alone, mut shared] = [0.0; 2];
    for stretch in tree {
        *if stretch.is_alone {
            &mut alone
        } else {
            &mut shared
        } += stretch.seconds();
    }
    assert!(shared > 16.0 * 3600.0 && alone < shared, "{alone} {shared}");
}

#[test]
fn stretches_add_up_to_the_shadow() {
    for (seed, latitude) in [(5, 52.0), (6, -10.0), (7, 78.0)] {
        let (facets, mut places) = city(seed, 50);
        places.insert(3, Point3::new(f32::NAN, 0.0, 0.0));
        let occluders = Occluders::new(&facets);
        let sky = sky(latitude);
        let sheets = sheets(&sky, &spans(&sky, &four_days()));
        let found = all_levels(&occluders, &sheets, &places);
        let exact = Exact::new(&occluders, &sheets).seconds(&places);
        assert_eq!(found.len(), places.len());
        assert!(found[3].is_empty());
        for (stretches, exact) in found.iter().zip(exact) {
            let sum: f64 = stretches.iter().map(Stretch::seconds).sum();
            assert!((sum - exact).abs() < 0.02, "{sum} and {exact}");
        }
    }
}

#[test]
fn walls_that_meet_count_once() {
    // Streets of houses wall to wall, of which many have two walls in one plane.
    let city = ombra_city::procedural_city(1, 300);
    let facets = city.facets();
    let occluders = Occluders::new(&facets);
    let corner = facets[0].corners[0];
    let places: Vec<Point3> = (0..640)
        .map(|k| Point3::new(corner.x + (k % 32) as f32, corner.y + (k / 32) as f32, 0.0))
        .collect();
    let sky = sky(40.7);
    let sheets = sheets(&sky, &spans(&sky, &four_days()));
    let found = Spells::new(&occluders, &sheets).stretches(&places);
    let exact = Exact::new(&occluders, &sheets).seconds(&places);
    for (stretches, exact) in found.iter().zip(exact) {
        assert!(stretches.windows(2).all(|pair| pair[0].to <= pair[1].from));
        let sum: f64 = stretches.iter().map(Stretch::seconds).sum();
        assert!((sum - exact).abs() < 0.1, "{sum} and {exact}");
    }
}

#[test]
fn what_stands_alone_takes_what_the_others_leave() {
    // What a building takes alone is what is gained without it.
    let (facets, places) = city(8, 40);
    let sky = sky(45.0);
    let sheets = sheets(&sky, &spans(&sky, &four_days()));
    let occluders = Occluders::new(&facets);
    let found = Spells::new(&occluders, &sheets).stretches(&places);
    let all = Exact::new(&occluders, &sheets).seconds(&places);
    let mut gained = 0;
    for owner in 0..40 {
        let others: Vec<Facet> = (facets.iter().copied())
            .filter(|facet| facet.owner != owner)
            .collect();
        let without = Exact::new(&Occluders::new(&others), &sheets).seconds(&places);
        for (place, stretches) in found.iter().enumerate() {
            let own = (stretches.iter()).filter(|own| own.owner == owner && own.is_alone);
            let alone: f64 = own.map(Stretch::seconds).sum();
            let gain = all[place] - without[place];
            assert!(
                (alone - gain).abs() < 0.05,
                "{owner} {place}: {alone} and {gain}"
            );
            gained += usize::from(gain > 60.0);
        }
    }
    assert!(gained > 30, "{gained}");
}

#[test]
fn nothing_throws_no_stretches() {
    let sky = sky(45.0);
    let sheets = sheets(&sky, &spans(&sky, &four_days()));
    let nothing = Occluders::new(&[]);
    let found = Spells::new(&nothing, &sheets).stretches(&[Point3::ORIGIN]);
    assert_eq!((found.len(), found.of(0).len()), (1, 0));
    let (facets, places) = city(9, 5);
    let some = Occluders::new(&facets);
    let never = Spells::new(&some, &[]).stretches(&places);
    assert!(never.len() == places.len() && never.iter().all(<[Stretch]>::is_empty));
    assert!(Spells::new(&some, &sheets).stretches(&[]).is_empty());
}
