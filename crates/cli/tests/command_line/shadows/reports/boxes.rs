//! A city of boxes in files, and whether the sun is covered by them, found out by slabs.

use std::path::Path;

use ombra::city::{Grid, Origin, StudyArea};
use ombra::formats::Limits;
use ombra::formats::city::{CityOptions, read_area, read_city};
use ombra::sun::{Instant, Place, Refraction, Sky};
use serde_json::{Value, json};

/// From west to east, from south to north in metres about a place, and how tall.
#[derive(Clone, Copy, Debug)]
pub(super) struct Block(pub(super) [f64; 4], pub(super) f64);

/// A place on Earth, in degrees.
#[derive(Clone, Copy, Debug)]
pub(super) struct Town {
    pub(super) latitude: f64,
    pub(super) longitude: f64,
}

impl Town {
    /// Degrees of so many metres east and north of the town.
    pub(super) fn at(self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (a, e2) = (6_378_137.0, 0.006_694_379_990_14);
        let (sin, cos) = self.latitude.to_radians().sin_cos();
        let w2: f64 = 1.0 - e2 * sin * sin;
        let east = (a * cos / w2.sqrt()).to_radians();
        let north = (a * (1.0 - e2) / w2.powf(1.5)).to_radians();
        [self.longitude + x / east, self.latitude + y / north]
    }

    /// A rectangle as a feature.
    pub(super) fn feature(self, [west, south, east, north]: [f64; 4], properties: Value) -> Value {
        let corners = [
            [west, south],
            [east, south],
            [east, north],
            [west, north],
            [west, south],
        ];
        let ring = corners.map(|corner| self.at(corner));
        json!({"type": "Feature", "properties": properties,
            "geometry": {"type": "Polygon", "coordinates": [ring]}})
    }

    pub(super) fn write(self, folder: &Path, name: &str, features: &[Value]) {
        let file = json!({"type": "FeatureCollection", "features": features});
        std::fs::write(folder.join(name), file.to_string()).unwrap();
    }

    pub(super) fn write_blocks(self, folder: &Path, name: &str, blocks: &[Block]) {
        let feature = |block: &Block| self.feature(block.0, json!({"height": block.1}));
        self.write(
            folder,
            name,
            &blocks.iter().map(feature).collect::<Vec<_>>(),
        );
    }

    /// Named rectangles.
    pub(super) fn write_areas(self, folder: &Path, name: &str, areas: &[(&str, [f64; 4])]) {
        let feature = |(name, area): &(&str, [f64; 4])| self.feature(*area, json!({"name": name}));
        self.write(folder, name, &areas.iter().map(feature).collect::<Vec<_>>());
    }

    /// Blocks in the local metres of a city's file.
    pub(super) fn local(self, origin: &Origin, blocks: &[Block]) -> Vec<Block> {
        let corner = |x, y| origin.to_local(self.at([x, y]));
        let local = |&Block([west, south, east, north], height): &Block| {
            let ([a, b], [c, d]) = (corner(west, south), corner(east, north));
            Block([a, b, c, d], height)
        };
        blocks.iter().map(local).collect()
    }
}

pub(super) fn origin(folder: &Path, city: &str) -> Origin {
    read_city(folder.join(city), &CityOptions::default())
        .unwrap()
        .origin
}

pub(super) fn sky(origin: &Origin) -> Sky {
    let place = Place::new(origin.latitude(), origin.longitude(), 0.0).unwrap();
    Sky::new(place, Refraction::None).unwrap()
}

/// The middles of cells that lie in the areas of a file, in local metres.
pub(super) fn places(folder: &Path, areas: &str, origin: &Origin, cell: f64) -> Vec<[f64; 2]> {
    let file = read_area(folder.join(areas), &Limits::default()).unwrap();
    let study = StudyArea::new(origin, &file.crs, &file.polygons()).unwrap();
    let [low, high] = study.bounds();
    let grid = Grid::within(low, high, cell).unwrap();
    let cells = (0..grid.height).flat_map(|row| (0..grid.width).map(move |column| (column, row)));
    let middles = cells.map(|(column, row)| grid.centre(column, row));
    middles.filter(|&at| study.contains(at)).collect()
}

/// Whether any of the blocks covers the sun, seen from a place at a height.
pub(super) fn is_dark(blocks: &[Block], [x, y]: [f64; 2], z: f64, sun: [f64; 3]) -> bool {
    blocks
        .iter()
        .any(|&Block([west, south, east, north], height)| {
            let slabs = [
                (west - x, east - x, sun[0]),
                (south - y, north - y, sun[1]),
                (-z, height - z, sun[2]),
            ];
            let (mut from, mut to) = (0.0_f64, f64::INFINITY);
            for (low, high, along) in slabs {
                let [a, b] = [low / along, high / along];
                from = from.max(a.min(b));
                to = to.min(a.max(b));
            }
            from < to
        })
}

/// An instant of a report.
pub(super) fn instant(cell: &Value) -> Instant {
    let text = cell.as_str().unwrap_or_else(|| panic!("{cell} is no time"));
    Instant::from(text.parse::<jiff::Timestamp>().unwrap())
}

/// Instants so many seconds apart, the middles of equal parts.
pub(super) fn instants(from: Instant, to: Instant, step: f64) -> (f64, Vec<Instant>) {
    let (each, middles) = ombra::sun::Span::new(from, to).middles(step);
    (each, middles.collect())
}

/// A number of a report.
pub(super) fn number(row: &Value, key: &str) -> f64 {
    row[key]
        .as_f64()
        .unwrap_or_else(|| panic!("{key} of {row}"))
}
