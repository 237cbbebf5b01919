//! The places of a run as the rows of a table.

use ombra::accrual::Ground;
use ombra::city::{City, Crs, Inside};
use ombra::formats::places::{PlaceChange, PlaceRow, PlaceShare};
use ombra::geometry::Point3;

use super::bound::Bound;
use super::places::{Kind, Places, Within};

/// Longitude, latitude and height.
pub(super) fn position(city: &City, at: Point3) -> [f64; 3] {
    let [longitude, latitude] = city.origin.to_geographic([at.x, at.y].map(f64::from));
    [longitude, latitude, f64::from(at.z)]
}

/// Calls with all rows in turn: `minutes` are one number a place, NaN where there is none. Of a city that is changed, where they are after
/// the change, `change` are those before it and how many are new. `by` is what each building takes.
pub(super) fn with_rows<R>(
    places: &Places,
    city: &City,
    minutes: &[f32],
    change: Option<[&[f32]; 2]>,
    by: Option<&[Vec<PlaceShare<'_>>]>,
    write: impl FnOnce(&mut dyn Iterator<Item = PlaceRow<'_>>) -> R,
) -> R {
    let position = |at| position(city, at);
    let number = |value: f32| Some(value).filter(|value| !value.is_nan());
    let known = |index: usize| number(minutes[index]);
    let change = |index: usize| {
        change.map(|[before, net]| PlaceChange {
            before: number(before[index]),
            after: known(index),
            net: number(net[index]),
        })
    };
    let building = |number: u32| (number, city.buildings[number as usize].id.as_deref());
    match &places.kind {
        Kind::Grid { grid, bound } => {
            let (ground, inside) = (Ground::new(city), Inside::new(city));
            let cells =
                (0..grid.height).flat_map(|row| (0..grid.width).map(move |column| (row, column)));
            let mut rows = cells.enumerate().filter_map(|(index, (row, column))| {
                let centre = grid.centre(column, row);
                // All cells that an area touches belong to it.
                if matches!(bound, Bound::Study(_)) && !bound.contains(centre) {
                    return None;
                }
                // A hole of a surface model is no place.
                let at = ground.at(centre)?;
                let owner = inside.building(at);
                Some(PlaceRow {
                    position: position(at),
                    minutes: known(index),
                    change: change(index),
                    by: by.map(|by| &*by[index]),
                    inside: owner.is_some(),
                    building: owner.map(building),
                    ..PlaceRow::default()
                })
            });
            write(&mut rows)
        }
        Kind::Faces { kind, found } => {
            let mut rows = found
                .places
                .iter()
                .enumerate()
                .map(|(index, place)| PlaceRow {
                    position: position(place.at),
                    minutes: known(index),
                    change: change(index),
                    by: by.map(|by| &*by[index]),
                    building: Some(building(place.building)),
                    surface: Some((kind.name(), place.normal)),
                    ..PlaceRow::default()
                });
            write(&mut rows)
        }
        Kind::Points {
            file, at, inside, ..
        } => {
            let is_geographic = file.crs.as_ref().is_some_and(|crs| *crs == Crs::wgs84());
            let mut rows = file.points.iter().enumerate().map(|(index, point)| {
                let mut position = position(at[index]);
                if is_geographic {
                    // As they were given, to the last digit.
                    [position[0], position[1]] = point.at;
                }
                PlaceRow {
                    position,
                    minutes: known(index),
                    change: change(index),
                    by: by.map(|by| &*by[index]),
                    inside: inside[index].is_some(),
                    building: match inside[index] {
                        Some(Within::Building(number)) => Some(building(number)),
                        Some(Within::Raised) | None => None,
                    },
                    id: point.id.as_deref(),
                    properties: Some(&point.properties),
                    ..PlaceRow::default()
                }
            });
            write(&mut rows)
        }
    }
}
