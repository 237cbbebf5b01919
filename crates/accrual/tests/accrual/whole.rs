//! What holds for every city.

use ombra_accrual::{Exact, Occluders};
use ombra_city::Facet;
use ombra_geometry::Point3;

use crate::numbers::Numbers;
use crate::solids::{Block, city, four_days, sheets, sky, spans};

fn seconds(facets: &[Facet], places: &[Point3], latitude: f64) -> Vec<f64> {
    let sky = sky(latitude);
    let sheets = sheets(&sky, &spans(&sky, &four_days()));
    Exact::new(&Occluders::new(facets), &sheets).seconds(places)
}

fn assert_same(a: &[f64], b: &[f64], most: f64) {
    assert_eq!(a.len(), b.len());
    for (k, (a, b)) in a.iter().zip(b).enumerate() {
        assert!((a - b).abs() <= most, "place {k}: {a} and {b}");
    }
}

#[test]
fn another_building_never_takes_shadow_away() {
    let (mut facets, places) = city(1, 60);
    let before = seconds(&facets, &places, 47.0);
    let mut numbers = Numbers(2);
    for owner in 100..104 {
        let tower = Block {
            high: 150.0,
            ..Block::random(&mut numbers, 120.0, 20.0)
        };
        facets.extend(tower.facets(owner));
    }
    let after = seconds(&facets, &places, 47.0);
    let mut more = 0;
    for (before, after) in before.iter().zip(&after) {
        // Stretches are joined across gaps of a millionth of an arc.
        assert!(after - before >= -1e-2, "{before} and then {after}");
        more += usize::from(after - before > 60.0);
    }
    assert!(more > 10, "towers are seen: {more}");
}

#[test]
fn polygons_that_are_there_twice_or_in_pieces_change_nothing() {
    let (facets, places) = city(3, 60);
    let expected = seconds(&facets, &places, 52.0);
    let twice: Vec<Facet> = [&facets[..], &facets[..]].concat();
    assert_same(&seconds(&twice, &places, 52.0), &expected, 1e-2);
    let halved = facets.iter().flat_map(|facet| {
        let [a, b, c, d] = facet.corners;
        let (e, f) = (a.lerp(b, 0.5), d.lerp(c, 0.5));
        [[a, e, f, d], [e, b, c, f]].map(|corners| Facet { corners, ..*facet })
    });
    assert_same(
        &seconds(&halved.collect::<Vec<_>>(), &places, 52.0),
        &expected,
        0.02,
    );
    let triangles = facets.iter().flat_map(|facet| {
        let [a, b, c, d] = facet.corners;
        [[a, b, c, c], [a, c, d, d]].map(|corners| Facet { corners, ..*facet })
    });
    assert_same(
        &seconds(&triangles.collect::<Vec<_>>(), &places, 52.0),
        &expected,
        0.02,
    );
    let mut backward = facets.clone();
    backward.reverse();
    assert_same(&seconds(&backward, &places, 52.0), &expected, 1e-2);
    let two_sided: Vec<Facet> = facets
        .iter()
        .map(|f| Facet {
            is_two_sided: true,
            ..*f
        })
        .collect();
    assert_same(&seconds(&two_sided, &places, 52.0), &expected, 1e-2);
}

#[test]
fn places_do_not_change_one_another() {
    let (facets, places) = city(4, 60);
    let expected = seconds(&facets, &places, 35.0);
    for (k, &place) in places.iter().enumerate().step_by(7) {
        assert_same(&seconds(&facets, &[place], 35.0), &expected[k..=k], 1e-2);
    }
    let mut far = places.clone();
    far.insert(3, Point3::new(1e7, -1e7, 0.0));
    far.insert(5, Point3::new(f32::NAN, 0.0, 0.0));
    let mut found = seconds(&facets, &far, 35.0);
    assert_eq!((found.remove(5), found.remove(3)), (0.0, 0.0));
    assert_same(&found, &expected, 1e-2);
}

#[test]
fn days_add_up() {
    let (facets, places) = city(5, 40);
    let occluders = Occluders::new(&facets);
    let sky = sky(59.0);
    let all = spans(&sky, &four_days());
    let exact = |spans: &[_]| Exact::new(&occluders, &sheets(&sky, spans)).seconds(&places);
    let mut sum = vec![0.0; places.len()];
    for span in &all {
        for (sum, own) in sum.iter_mut().zip(exact(&[*span])) {
            *sum += own;
        }
    }
    assert_same(&exact(&all), &sum, 1e-9);
}

#[test]
fn the_number_of_threads_changes_no_bit() {
    let (facets, places) = city(6, 60);
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| seconds(&facets, &places, 45.0))
    };
    assert_eq!(with(1), with(4));
}

#[test]
fn what_is_looked_at_together_changes_nothing() {
    let (facets, _) = city(7, 60);
    let occluders = Occluders::new(&facets);
    // Tiles of neighbours, and days that come one after another: both share their walks.
    let places: Vec<Point3> = (0..=255_u8)
        .map(|k| [k & 3 | k >> 2 & 12, k >> 2 & 3 | k >> 4 & 12])
        .map(|[x, y]| Point3::new(f32::from(x), f32::from(y), 0.0))
        .collect();
    for latitude in [40.0, -20.0, 70.0] {
        let sky = sky(latitude);
        let first = jiff::civil::date(2026, 2, 20);
        let days: Vec<_> = first.series(jiff::Span::new().days(1)).take(20).collect();
        let each: Vec<Vec<f64>> = (spans(&sky, &days).iter())
            .flat_map(|span| sheets(&sky, &[*span]))
            .map(|sheet| {
                let exact = Exact::new(&occluders, &[sheet]);
                let together = exact.seconds(&places);
                let alone = places.chunks(16).flat_map(|tile| exact.seconds(tile));
                assert!(together.iter().copied().eq(alone));
                together
            })
            .collect();
        let all = Exact::new(&occluders, &sheets(&sky, &spans(&sky, &days))).seconds(&places);
        let sums = (0..places.len()).map(|place| each.iter().map(|day| day[place]).sum::<f64>());
        let sums: Vec<f64> = sums.collect();
        assert!(sums.iter().any(|&sum| sum > 0.0));
        assert_same(&all, &sums, 1e-9);
    }
}
