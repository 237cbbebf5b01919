//! Before, after and net, as files.

use ombra::city::City;
use ombra::formats::places::{write_places_geojson, write_places_parquet};
use ombra::formats::raster::{Band, MapStyle, Raster, Scale, Unit, write_geotiff_bands};

use super::super::args::{OutputKind, ShadowsArgs};
use super::super::output::{EXACT, OUTSIDE, VERSION, metadata, stem, write_map};
use super::super::places::{Kind, Places};
use super::super::rows::with_rows;
use super::super::when::When;
use super::Minutes;

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
        let metadata = of_run(args, when);
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
            footer: format!("{VERSION}; {}", bound(when)),
            scale: Scale::Change,
            outside: places.outside(city, places.tiles.places().len()),
            outside_name: OUTSIDE.to_owned(),
            ..MapStyle::default()
        };
        write_map(path, &raster, &style)?;
    }
    Ok(())
}

/// What says how the numbers came about.
pub(super) fn of_run(args: &ShadowsArgs, when: &When) -> Vec<(String, String)> {
    let unit = "minutes in shadow before and after, and after less before";
    metadata(when, args.method, bound(when), unit)
}

fn bound(when: &When) -> String {
    format!("before and after {EXACT}; the sun is {}", when.sun())
}
