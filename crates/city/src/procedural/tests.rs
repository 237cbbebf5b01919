//! The generated cities are what they say.

use ombra_geometry::Point3;

use super::lots::{NARROWEST, Rectangle, WIDEST};
use super::{Random, demo_city, grid_of_lots, procedural_city};
use crate::building::{Building, Part};
use crate::{City, Inside};

fn height(building: &Building) -> f32 {
    let tops = building.parts.iter().map(|part| part.range()[1]);
    tops.fold(0.0, f32::max)
}

/// FNV-1a over all that stands there.
fn digest(city: &City) -> u64 {
    let mut digest = 0xcbf2_9ce4_8422_2325_u64;
    for facet in city.facets() {
        for byte in facet
            .corners
            .iter()
            .flat_map(|p| p.to_array())
            .flat_map(f32::to_le_bytes)
        {
            digest = (digest ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }
    digest
}

#[test]
fn forty_five_thousand_buildings_are_as_high_and_as_many_as_promised() {
    let city = procedural_city(1, 45_000);
    assert_eq!(city.buildings.len(), 45_000);
    let mut heights: Vec<f32> = city.buildings.iter().map(height).collect();
    heights.sort_by(f32::total_cmp);
    for (share, expected) in [
        (0.1, 12.0),
        (0.5, 23.0),
        (0.9, 61.0),
        (0.99, 142.0),
        (1.0, 250.0),
    ] {
        let found = heights[(share * 44_999.0) as usize];
        assert!((found - expected).abs() < 0.1, "{share}: {found}");
    }
    let prisms: usize = city.buildings.iter().map(|b| b.parts.len()).sum();
    let facets = city.facets().len();
    assert!(prisms.abs_diff(57_500) < 1500, "{prisms} prisms");
    assert!(facets.abs_diff(293_000) < 10_000, "{facets} facets");
    let bounds = (city.buildings.iter().flat_map(|b| &b.parts)).map(Part::bounds);
    let size = bounds.fold([[0.0_f32; 2]; 2], |[low, high], [a, b]| {
        [
            [0, 1].map(|k| low[k].min(a[k])),
            [0, 1].map(|k| high[k].max(b[k])),
        ]
    });
    let [wide, tall] = [0, 1].map(|k| size[1][k] - size[0][k]);
    assert!(
        (wide - 7800.0).abs() < 400.0 && (tall - 7400.0).abs() < 400.0,
        "{wide} by {tall} m"
    );
}

#[test]
fn lots_do_not_overlap_and_are_built_on_to_their_fronts() {
    let lots = grid_of_lots(&mut Random::new(3), 3000);
    let overlap = |a: &Rectangle, b: &Rectangle| {
        (0..2).all(|k| a.low[k] < b.high[k] - 1e-9 && b.low[k] < a.high[k] - 1e-9)
    };
    for (i, lot) in lots.iter().enumerate() {
        assert!((NARROWEST..=WIDEST).contains(&lot.width), "{lot:?}");
        assert!(
            lots[..i]
                .iter()
                .all(|other| !overlap(&lot.whole, &other.whole)),
            "{lot:?}"
        );
        let (whole, built) = (lot.whole, lot.built);
        let contains =
            (0..2).all(|k| whole.low[k] <= built.low[k] && built.high[k] <= whole.high[k]);
        assert!(
            contains && built.size().into_iter().all(|x| x > 5.0),
            "{lot:?}"
        );
    }
}

#[test]
fn the_same_arguments_give_the_same_bytes_and_another_seed_others() {
    let city = |seed| digest(&procedural_city(seed, 700));
    assert_eq!(city(1), 6_398_181_774_869_258_377);
    assert_ne!(city(1), city(2));
    assert_eq!(digest(&demo_city()), digest(&demo_city()));
}

#[test]
fn a_small_one_is_small_and_none_is_none() {
    assert_eq!(procedural_city(9, 300).buildings.len(), 300);
    assert!(procedural_city(9, 0).facets().is_empty());
    assert_eq!(procedural_city(9, 1).buildings.len(), 1);
}

#[test]
fn outlines_run_counter_clockwise_and_buildings_are_solid() {
    let [wide, demo] = [procedural_city(2, 2000), demo_city()];
    for city in [&wide, &demo] {
        let inside = Inside::new(city);
        for part in city.buildings.iter().flat_map(|b| &b.parts) {
            if let Part::Prism(prism) = part {
                assert!(prism.outline.area() > 1.0, "{prism:?}");
            }
            let [low, high] = part.bounds();
            let [x, y] = [0, 1].map(|k| 0.5 * (low[k] + high[k]));
            // The middle of an L may lie in its yard.
            let is_l = matches!(part, Part::Prism(prism) if prism.outline.outer.len() == 6);
            assert!(is_l || inside.contains(Point3::new(x, y, 0.5)), "{part:?}");
        }
    }
}

#[test]
fn the_demo_has_what_it_is_said_to_have() {
    let city = demo_city();
    assert!(
        (200..=400).contains(&city.buildings.len()),
        "{}",
        city.buildings.len()
    );
    let named = |name: &str| {
        city.buildings
            .iter()
            .filter(|b| b.id.as_deref() == Some(name))
            .count()
    };
    assert_eq!(["church", "column", "pavilion"].map(named), [1; 3]);
    assert!((4..=8).contains(&named("tower")));
    assert!(city.facets().iter().all(|facet| !facet.is_two_sided));
    let [low, high] = [f32::min, f32::max].map(|of| {
        let all = city
            .buildings
            .iter()
            .flat_map(|b| &b.parts)
            .flat_map(Part::bounds);
        all.flatten().fold(0.0, of)
    });
    assert!(low > -400.0 && high < 400.0, "{low} to {high}");
}
