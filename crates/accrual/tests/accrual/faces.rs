//! Roofs and façades, and places in any order.

use jiff::civil::date;
use ombra_accrual::{Exact, Occluders, OnFaces, Sampled, Samples, Tiles};
use ombra_city::{City, Crs, Draft, DraftBuilding, DraftPart, FaceKind, FacePlace};
use ombra_geometry::Point3;

use crate::closed_forms::while_so;
use crate::numbers::Numbers;
use crate::solids::{sheets, sky, spans};

/// Boxes about a place on the map: west, south, east, north in metres, base and top.
fn city(latitude: f64, boxes: &[([f64; 4], f64, f64)]) -> City {
    let (east, north) = (111_320.0 * latitude.to_radians().cos(), 111_132.0);
    let at = |x: f64, y: f64| [5.0 + x / east, latitude + y / north];
    let mut draft = Draft::new(Crs::wgs84());
    for &([west, south, east, north], base, top) in boxes {
        let ring = vec![
            at(west, south),
            at(east, south),
            at(east, north),
            at(west, north),
        ];
        draft.buildings.push(DraftBuilding {
            place: "test".to_owned(),
            parts: vec![DraftPart::Footprint {
                rings: vec![ring],
                base,
                top,
            }],
            ..DraftBuilding::default()
        });
    }
    draft.finish().unwrap()
}

fn ats(places: &[FacePlace]) -> Vec<Point3> {
    places.iter().map(|place| place.at).collect()
}

#[test]
fn a_wall_to_the_north_has_no_sun_at_the_equinox_and_one_to_the_south_has_all() {
    for latitude in [45.0, -45.0] {
        let city = city(latitude, &[([-200.0, -10.0, 200.0, 10.0], 0.0, 30.0)]);
        let sky = sky(latitude);
        let spans = spans(&sky, &[date(2026, 9, 23)]);
        let up: f64 = spans.iter().map(|span| span.seconds()).sum();
        let walls = OnFaces::of(&city, FaceKind::Facade, 5.0, |_| true).unwrap();
        assert_eq!(walls.hidden, 0);
        let occluders = Occluders::new(&city.facets());
        let exact = Exact::new(&occluders, &sheets(&sky, &spans));
        let seconds = exact.seconds(&ats(&walls.places));
        // How long the sun is to the north, behind a wall that looks south, and to the south.
        let behind = [
            while_so(&sky, &spans, |[_, north, _]| north > 0.0),
            while_so(&sky, &spans, |[_, north, _]| north < 0.0),
        ];
        let mut seen = [0; 2];
        for (place, shadow) in walls.places.iter().zip(seconds) {
            // Away from the ends, past which the sun grazes the wall as it rises.
            if place.normal.y.abs() < 0.5 || !(10.0..390.0).contains(&place.at.x) {
                continue;
            }
            let faces_the_sun = f64::from(place.normal.y) * latitude < 0.0;
            seen[usize::from(faces_the_sun)] += 1;
            // The day is not quite the equinox, and a minute may pass between the place and its wall.
            let expected = behind[usize::from(place.normal.y > 0.0)];
            assert!(
                (shadow - expected).abs() < 70.0,
                "{place:?}: {shadow}, behind the wall for {expected}"
            );
            let whole = if faces_the_sun { 0.0 } else { up };
            assert!((shadow - whole).abs() < 240.0, "{shadow} of {up}");
        }
        assert!(seen[0] > 400 && seen[0] == seen[1], "{seen:?}");
    }
}

#[test]
fn a_roof_that_nothing_is_higher_than_lies_in_the_sun() {
    let blocks = [
        ([0.0, 0.0, 20.0, 20.0], 0.0, 12.0),
        ([40.0, 0.0, 60.0, 20.0], 0.0, 12.0),
    ];
    let city = city(52.0, &blocks);
    let sky = sky(52.0);
    let spans = spans(&sky, &[date(2026, 12, 21)]);
    let roofs = OnFaces::of(&city, FaceKind::Roof, 2.0, |_| true).unwrap();
    assert_eq!(roofs.places.len(), 200);
    let occluders = Occluders::new(&city.facets());
    let exact = Exact::new(&occluders, &sheets(&sky, &spans));
    assert!(
        exact
            .seconds(&ats(&roofs.places))
            .iter()
            .all(|&shadow| shadow == 0.0)
    );
}

#[test]
fn what_lies_in_or_against_another_building_is_left_out_and_counted() {
    // A tower on a podium, and a neighbour wall to wall, but for 4 cm.
    let podium = ([0.0, 0.0, 40.0, 20.0], 0.0, 6.0);
    let tower = ([0.0, 0.0, 20.0, 20.0], 6.0, 60.0);
    let neighbour = ([40.04, 0.0, 60.04, 20.0], 0.0, 6.0);
    let city = city(52.0, &[podium, tower, neighbour]);
    let roofs = OnFaces::of(&city, FaceKind::Roof, 2.0, |_| true).unwrap();
    assert_eq!((roofs.places.len(), roofs.hidden), (300, 100));
    let walls = OnFaces::of(&city, FaceKind::Facade, 2.0, |_| true).unwrap();
    assert_eq!(walls.hidden, 2 * 10 * 3);
    let all = 3 * (2 * 20 + 2 * 10) + 27 * 4 * 10 + 3 * 4 * 10;
    assert_eq!(walls.places.len(), all - walls.hidden);
}

#[test]
fn faces_agree_with_rays() {
    let mut numbers = Numbers(7);
    let mut within = |from: f32, to: f32| f64::from(numbers.within(from, to));
    let boxes: Vec<([f64; 4], f64, f64)> = (0..40)
        .map(|_| {
            let (x, y) = (within(-120.0, 120.0), within(-120.0, 120.0));
            let (w, d) = (within(6.0, 30.0), within(6.0, 30.0));
            ([x, y, x + w, y + d], 0.0, within(4.0, 50.0))
        })
        .collect();
    for latitude in [40.7, -33.0, 64.0] {
        let city = city(latitude, &boxes);
        let facets = city.facets();
        let sky = sky(latitude);
        let spans = spans(&sky, &[date(2026, 3, 21), date(2026, 6, 21)]);
        let occluders = Occluders::new(&facets);
        let exact = Exact::new(&occluders, &sheets(&sky, &spans));
        let (sampled, step) = (Sampled::new(&facets), 30.0);
        let samples = Samples::new(&sky, &spans, step);
        for kind in [FaceKind::Roof, FaceKind::Facade] {
            let found = OnFaces::of(&city, kind, 7.0, |_| true).unwrap();
            let places = ats(&found.places);
            assert!(places.len() > 80, "{}", places.len());
            let (ours, theirs) = (exact.seconds(&places), sampled.seconds(&samples, &places));
            let mut sum = 0.0;
            for ((place, a), b) in found.places.iter().zip(&ours).zip(&theirs) {
                sum += a - b;
                // Each change of light is off by half a step at most; there are a few a day.
                assert!((a - b).abs() < 8.0 * step, "{place:?}: {a} and {b}");
            }
            let mean = sum / places.len() as f64;
            assert!(mean.abs() < 5.0, "{kind:?} {latitude}: {mean}");
        }
    }
}

#[test]
fn tiles_of_a_list_have_each_place_once_and_change_nothing() {
    let mut numbers = Numbers(3);
    let mut places: Vec<Point3> = (0..1003)
        .map(|_| {
            let [x, y] = [(); 2].map(|()| numbers.within(-100.0, 100.0));
            Point3::new(x, y, numbers.within(0.0, 20.0))
        })
        .collect();
    places[17] = Point3::new(f32::NAN, 0.0, 0.0);
    places[18] = places[19];
    let tiles = Tiles::near(&places);
    assert_eq!((tiles.len(), tiles.places().len()), (63, 1003));
    assert_eq!(
        [0, 15, 16, 1002, 1003].map(|places| tiles.before(places)),
        [0, 0, 1, 62, 63]
    );
    let mut indices = tiles.indices().to_vec();
    indices.sort_unstable();
    assert!(
        indices
            .iter()
            .enumerate()
            .all(|(k, &index)| k == index as usize)
    );

    let city = city(50.0, &[([-10.0, -10.0, 10.0, 10.0], 0.0, 30.0)]);
    let sky = sky(50.0);
    let spans = spans(&sky, &[date(2026, 3, 21)]);
    let occluders = Occluders::new(&city.facets());
    let exact = Exact::new(&occluders, &sheets(&sky, &spans));
    let one_by_one: Vec<f64> = places.iter().map(|&p| exact.seconds(&[p])[0]).collect();
    let found = exact.seconds_of(&tiles, 0..tiles.len());
    for (&index, found) in tiles.indices().iter().zip(found) {
        let alone = one_by_one[index as usize];
        assert!((found - alone).abs() < 0.02, "{index}: {found} and {alone}");
    }
    assert!(Tiles::near(&[]).is_empty());
    assert_eq!(Tiles::near(&[Point3::ORIGIN]).len(), 1);
    assert_eq!(Tiles::near(&[Point3::ORIGIN; 40]).len(), 3);
}
