//! Before, after and net, as files.

use ombra::city::City;
use ombra::formats::places::{write_places_geojson, write_places_parquet};
use ombra::formats::raster::{
    Band, MapStyle, Raster, Scale, Unit, map_picture, write_geotiff_bands,
};
use ombra::formats::{Metadata, write_image};

use super::super::args::{OutputKind, ShadowsArgs};
use super::super::output::{EXACT, OUTSIDE, stem};
use super::super::places::{Kind, Places};
use super::super::rows::with_rows;
use super::super::when::When;
use super::Minutes;
use crate::commands::command;

/// Of the city and the places as they are after the change.
pub(super) fn write(
    args: &ShadowsArgs,
    city: &City,
    places: &Places,
    when: &When,
    minutes: &Minutes,
) -> anyhow::Result<()> {
    let Minutes { before, after, net } = minutes;
    if let Some(path) = &args.output {
        let metadata = metadata(when);
        let change = Some([&before[..], &net[..]]);
        match (OutputKind::of(path), &places.kind) {
            (OutputKind::GeoJson, _) => with_rows(places, city, after, change, |rows| {
                write_places_geojson(path, rows, &metadata)
            })?,
            (OutputKind::Parquet, _) => with_rows(places, city, after, change, |rows| {
                write_places_parquet(path, rows, &metadata)
            })?,
            (OutputKind::GeoTiff, Kind::Grid { grid, .. }) => {
                let mut bands = Vec::new();
                for (name, values) in [
                    ("before", before),
                    ("after", after),
                    ("net new shadow", net),
                ] {
                    let raster = Raster::new(&city.origin, *grid, Unit::Minutes, values)?;
                    bands.push(Band { name, raster });
                }
                write_geotiff_bands(path, &bands, &metadata)?;
            }
            (OutputKind::GeoTiff, _) => unreachable!("refused before anything was measured"),
        }
    }
    if let (Some(path), Kind::Grid { grid, .. }) = (&args.png, &places.kind) {
        let raster = Raster::new(&city.origin, *grid, Unit::Minutes, net)?;
        let title = || format!("Net new shadow: {}", stem(&args.city));
        let style = MapStyle {
            title: args.title.clone().unwrap_or_else(title),
            subtitle: format!("{} ({})", when.text, when.zone),
            footer: format!("ombra {}; {}", env!("CARGO_PKG_VERSION"), bound(when)),
            scale: Scale::Change,
            outside: places.outside(city, places.tiles.places().len()),
            outside_name: OUTSIDE.to_owned(),
            ..MapStyle::default()
        };
        let metadata = Metadata {
            version: Some(concat!("ombra ", env!("CARGO_PKG_VERSION")).to_owned()),
            ..Metadata::default()
        };
        write_image(path, &map_picture(&raster, &style), &metadata)?;
    }
    Ok(())
}

fn bound(when: &When) -> String {
    format!("before and after {EXACT}; the sun is {}", when.sun())
}

/// What says how the numbers came about.
fn metadata(when: &When) -> Vec<(String, String)> {
    let version = concat!("ombra ", env!("CARGO_PKG_VERSION"));
    let all = [
        ("command", command()),
        ("version", version.to_owned()),
        ("when", when.text.clone()),
        ("time_zone", when.zone.clone()),
        ("days", when.days.to_string()),
        ("sun", when.sun()),
        ("sun_hours", format!("{:.6}", when.hours())),
        ("method", "exact".to_owned()),
        ("bound", bound(when)),
        (
            "unit",
            "minutes in shadow before and after, and after less before".to_owned(),
        ),
    ];
    all.map(|(name, value)| (name.to_owned(), value)).into()
}
