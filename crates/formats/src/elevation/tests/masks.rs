//! The shadow of a real surface model against masks by UMEP, which marches over the raster.

use ombra_accel::{Accel, Mesh, StructureKind, Traversable as _};
use ombra_accrual::Ground;
use ombra_city::{City, Extent, Facet, HeightField};
use ombra_geometry::{Point3, Ray, Vector3};

use super::super::*;
use crate::city::tests::outside_data;

/// An array of doubles as NumPy writes it (version 1.0 of its format).
fn npy(name: &str) -> Option<Vec<f64>> {
    let bytes = std::fs::read(outside_data(name)?).unwrap();
    let head = 10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    let (numbers, rest) = bytes[head..].as_chunks::<8>();
    assert!(rest.is_empty());
    Some(numbers.iter().map(|&b| f64::from_le_bytes(b)).collect())
}

/// By the raster alone, from pixel to pixel: how far, in metres, the highest pixel that stands before the sun comes
/// above the way of its light. Above 0 a pixel is in shadow.
struct Marched {
    margin: Vec<f64>,
}

impl Marched {
    fn new(field: &HeightField, [dx, dy]: [i64; 2], altitude: f64) -> Self {
        let size = field.size().map(i64::from);
        let rise = altitude.to_radians().tan();
        let at = |[x, y]: [i64; 2]| f64::from(field.at([x as u32, y as u32]));
        let margin = |x: i64, y: i64| {
            let steps = (1..).map(|k| (k, [x + k * dx, y + k * dy]));
            let within = steps.take_while(|(_, p)| (0..2).all(|i| (0..size[i]).contains(&p[i])));
            let above = within.map(|(k, p)| at(p) - at([x, y]) - k as f64 * rise);
            above.fold(f64::NEG_INFINITY, f64::max)
        };
        let pixels = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (x, y)));
        Self {
            margin: pixels.map(|(x, y)| margin(x, y)).collect(),
        }
    }
}

/// One mask: which way along the raster the sun stands, and its altitude in degrees.
fn assert_matches(name: &str, toward: [i64; 2], altitude: f64) {
    let (Some(path), Some(mask)) = (
        outside_data("city/dsm_athens/DSM.tif"),
        npy(&format!("city/dsm_athens/reference/{name}")),
    ) else {
        return;
    };
    let field = read_elevation(path, None, &Limits::default())
        .unwrap()
        .field;
    let city = City::of_surface(&field, None, Extent::EVERYWHERE).unwrap();
    let accel = Accel::build(
        Mesh::new(Facet::mesh(&city.facets())),
        StructureKind::default(),
    );
    let ground = Ground::new(&city);
    let marched = Marched::new(&field, toward, altitude);
    let local = |pixel: [u32; 2]| city.origin.to_local(field.on_map(pixel));
    // The masks are in the grid's own axes and metres: its north leans against the true one of local metres, and
    // its metres are shorter by 0.0004.
    const STEPS: i64 = 100;
    let middle = [200, 200];
    let next = [0, 1].map(|k| (middle[k] as i64 + STEPS * toward[k]) as u32);
    let [x, y] = [0, 1].map(|k| local(next)[k] - local(middle)[k]);
    let z = STEPS as f64 * altitude.to_radians().tan();
    let toward_sun = Vector3::new(x as f32, y as f32, z as f32);
    let (mut wrong, mut unexplained, mut nowhere) = (0, 0, 0);
    for (k, &sunlit) in mask.iter().enumerate() {
        let pixel = [k as u32 % 400, k as u32 / 400];
        let Some(place) = ground.at(local(pixel)) else {
            nowhere += 1;
            continue;
        };
        let found = !accel.occluded(&Ray::new(place, toward_sun));
        wrong += usize::from(found != (sunlit == 1.0));
        // Places lie 2 cm above the surface, and those on a wall where two triangles meet up to 2 cm lower
        // or higher: from that height the raster gives the same answer, but for a hair.
        let lift = f64::from(place.z) - f64::from(field.at(pixel));
        assert!(lift.abs() < 0.05, "{lift} m at {pixel:?}");
        let margin = marched.margin[k] - lift;
        // Along the very rim of the surface light passes beside it or not, by rounding.
        let is_along_rim = (0..2).any(|k| toward[k] == 0 && [0, 399].contains(&pixel[k]));
        let is_wrong = found == (margin > 0.0) && margin.abs() > 3e-3;
        unexplained += usize::from(is_wrong && !is_along_rim);
    }
    let share = 1.0 - (wrong + nowhere) as f64 / mask.len() as f64;
    println!(
        "{name}: {wrong} differ, {nowhere} are nowhere: {:.4} % match",
        100.0 * share
    );
    assert!(share >= 0.999, "{name}: {wrong} wrong, {nowhere} nowhere");
    assert_eq!(unexplained, 0, "{name}: of {wrong}");
}

#[test]
fn the_morning_of_athens() {
    assert_matches("shadow_morning_bldg_sh.npy", [1, 0], 30.0);
}

#[test]
fn the_noon_of_athens() {
    assert_matches("shadow_noon_bldg_sh.npy", [0, 1], 60.0);
}

/// With the terrain below it, the places that are left are the same ones, with the same light.
#[test]
fn with_terrain_streets_are_ground_and_roofs_are_not() {
    let (Some(surface), Some(terrain)) = (
        outside_data("city/dsm_athens/DSM.tif"),
        outside_data("city/dsm_athens/DEM.tif"),
    ) else {
        return;
    };
    let [surface, terrain] = [surface, terrain].map(|path| {
        let read = read_elevation(path, None, &Limits::default());
        read.unwrap().field
    });
    let whole = City::of_surface(&surface, None, Extent::EVERYWHERE).unwrap();
    let city = City::of_surface(&surface, Some(&terrain), Extent::EVERYWHERE).unwrap();
    let triangles = |city: &City| city.terrain.len() + city.context.len();
    assert!(
        triangles(&whole).abs_diff(triangles(&city)) < 300,
        "the same surface"
    );
    let (all, ground) = (Ground::new(&whole), Ground::new(&city));
    let (mut streets, mut roofs) = (0, 0);
    for k in 0..400_u32 * 400 {
        let (pixel, map) = ([k % 400, k / 400], surface.on_map([k % 400, k / 400]));
        let above = f64::from(surface.at(pixel)) - f64::from(terrain.at(pixel));
        let local = city.origin.to_local(map);
        match ground.at(local) {
            Some(place) => {
                streets += 1;
                let surface: Point3 = all.at(local).unwrap();
                assert!(
                    (place.z - surface.z).abs() < 0.03,
                    "{place:?} and {surface:?}"
                );
                assert!(above <= 2.01, "{above} m above the terrain at {pixel:?}");
            }
            None => roofs += usize::from(above > 2.0),
        }
    }
    assert!(
        streets > 50_000 && roofs > 50_000,
        "{streets} streets, {roofs} roofs"
    );
}
