//! Where shadow time is asked for, sixteen places a tile.

use ombra_accrual::Ground;
use ombra_city::{City, Facet, Inside};
use ombra_geometry::Point3;

use crate::random::Random;

/// Places of a tile, along each of its sides.
const SIDE: usize = 4;

/// Places of a tile.
pub(super) const TILE: usize = SIDE * SIDE;

/// How often a window or a wall may be in vain, for each that is wanted.
const TRIES: usize = 50;

/// Square windows on the ground, 1 m from place to place, each about a building picked at random: their
/// tiles of which no place lies in a building.
pub(super) fn on_ground(city: &City, inside: &Inside, windows: usize, side: usize) -> Vec<Point3> {
    let ground = Ground::new(city);
    let mut random = Random::new(11);
    let mut places = Vec::new();
    let mut found = 0;
    for _ in 0..windows * TRIES {
        let Some(middle) = some_building(city, &mut random) else {
            break;
        };
        let low = middle.map(|x| x.round() - 0.5 * side as f32);
        let before = places.len();
        for tile in 0..(side / SIDE) * (side / SIDE) {
            let corner = [tile % (side / SIDE), tile / (side / SIDE)].map(|k| (SIDE * k) as f32);
            let own: Option<Vec<Point3>> = (0..TILE)
                .map(|k| {
                    let x = low[0] + corner[0] + (k % SIDE) as f32 + 0.5;
                    let y = low[1] + corner[1] + (k / SIDE) as f32 + 0.5;
                    let place = ground.at([x, y].map(f64::from))?;
                    (!inside.contains(place)).then_some(place)
                })
                .collect();
            places.extend(own.unwrap_or_default());
        }
        found += usize::from(places.len() > before);
        if found == windows {
            break;
        }
    }
    places
}

/// The middle of it, up to 20 m aside.
fn some_building(city: &City, random: &mut Random) -> Option<[f32; 2]> {
    let pick = (f64::from(random.unit()) * city.buildings.len() as f64) as usize;
    let [low, high] = city.buildings.get(pick)?.parts.first()?.bounds();
    Some([0, 1].map(|k| 0.5 * (low[k] + high[k]) + random.between(-20.0, 20.0)))
}

/// Walls picked at random, with one tile over all of each, 5 cm before it; none of which a place lies in
/// a building.
pub(super) fn on_facades(facets: &[Facet], inside: &Inside, walls: usize) -> Vec<Point3> {
    const SMALLEST: f32 = 4.0;
    const BEFORE: f32 = 0.05;
    let mut random = Random::new(12);
    let mut places = Vec::new();
    for _ in 0..walls * TRIES {
        if places.len() >= walls * TILE || facets.is_empty() {
            break;
        }
        let pick = (f64::from(random.unit()) * facets.len() as f64) as usize;
        let [a, b, _, d] = facets[pick].corners.map(Point3::to_array);
        let across = [b[0] - a[0], b[1] - a[1]];
        let (width, height) = (across[0].hypot(across[1]), d[2] - a[2]);
        let is_upright = (a[0] - d[0]).hypot(a[1] - d[1]) < 0.01 && (a[2] - b[2]).abs() < 0.01;
        if !is_upright || width < SMALLEST || height < SMALLEST {
            continue;
        }
        let outward = [across[1] / width, -across[0] / width].map(|x| BEFORE * x);
        let tile = (0..TILE).map(|k| {
            let [u, v] = [k % SIDE, k / SIDE].map(|k| (k as f32 + 0.5) / SIDE as f32);
            Point3::new(
                a[0] + u * across[0] + outward[0],
                a[1] + u * across[1] + outward[1],
                a[2] + v * height,
            )
        });
        let tile: Vec<Point3> = tile.collect();
        if !tile.iter().any(|&place| inside.contains(place)) {
            places.extend(tile);
        }
    }
    places
}

/// About so many of them, in whole tiles spread evenly over all.
pub(super) fn some(places: &[Point3], count: usize) -> Vec<Point3> {
    let tiles: Vec<&[Point3]> = places.chunks(TILE).collect();
    let wanted = count.div_ceil(TILE).min(tiles.len());
    (0..wanted)
        .flat_map(|k| tiles[k * tiles.len() / wanted].iter().copied())
        .collect()
}
