//! What a rule protects: areas of a file, and the places that stand for them.

use std::path::Path;

use anyhow::{Context as _, bail};
use ombra::accrual::{Ground, Tiles};
use ombra::city::{City, Extent, Grid, Inside, Origin, StudyArea};
use ombra::formats::Limits;
use ombra::formats::city::{NamedArea, read_area};

use super::super::bound::{BESIDE, is_apart};
use super::super::wrong_usage;
use crate::commands::Talk;

/// An area of the file, in local metres.
pub(super) struct Area {
    pub(super) name: String,
    /// Polygons, each its outer ring and holes.
    pub(super) polygons: Vec<Vec<Vec<[f64; 2]>>>,
    pub(super) within: StudyArea,
    /// Square metres.
    pub(super) size: f64,
}

/// An area and the places in it.
pub(super) struct Resource {
    pub(super) area: Area,
    pub(super) grid: Grid,
    /// How many cells of the grid have their middles in the area.
    pub(super) cells: usize,
    /// How many of these lie in a building before the change, or in a hole of the terrain, and how many of the others lie in a building
    /// after it.
    pub(super) in_buildings: usize,
    pub(super) built_over: usize,
    /// The rest, which is measured.
    pub(super) tiles: Tiles,
}

/// The areas of a file.
pub(super) fn read(
    path: &Path,
    origin: &Origin,
    all: Extent,
    talk: &Talk,
) -> anyhow::Result<Vec<Area>> {
    let file = read_area(path, &Limits::default())?;
    let name = path.display();
    for finding in &file.findings {
        talk.say(&format!("{name}: {finding}"));
    }
    let local = origin.on_map(file.crs.clone());
    let mut areas = Vec::with_capacity(file.areas.len());
    for (own, called) in file.areas.iter().zip(names(&file.areas)) {
        let within = StudyArea::new(origin, &file.crs, &own.polygons)
            .with_context(|| format!("{name}: {}", own.place))?;
        let [low, high] = within.bounds();
        if is_apart(Extent { low, high }, all.widened(BESIDE)) {
            bail!(
                "{name}: {called} lies more than {:.0} km outside of the city; its coordinates are taken for those of {}",
                BESIDE / 1000.0,
                file.crs
            );
        }
        let ring = |ring: &Vec<[f64; 2]>| ring.iter().map(|&at| local.to_local(at)).collect();
        let polygon = |rings: &Vec<Vec<_>>| rings.iter().map(ring).collect();
        let polygons: Vec<Vec<Vec<[f64; 2]>>> = own.polygons.iter().map(polygon).collect();
        areas.push(Area {
            name: called,
            size: polygons.iter().map(|rings| size(rings)).sum(),
            polygons,
            within,
        });
    }
    Ok(areas)
}

/// What each is called; those of the same name are told apart by their places in the file.
fn names(areas: &[NamedArea]) -> Vec<String> {
    let called = |area: &NamedArea| {
        let name = area.name.as_deref().map(str::trim).unwrap_or_default();
        let is_shared = || areas.iter().filter(|other| other.name == area.name).count() > 1;
        match name {
            "" => area.place.clone(),
            _ if is_shared() => format!("{name} ({})", area.place),
            _ => name.to_owned(),
        }
    };
    areas.iter().map(called).collect()
}

/// Square metres within the outer ring, less its holes.
fn size(rings: &[Vec<[f64; 2]>]) -> f64 {
    let of = |ring: &[[f64; 2]]| {
        let Some(&[x, y]) = ring.first() else {
            return 0.0;
        };
        // About a corner, so that no digits are lost far from the origin.
        let cross = |pair: &[[f64; 2]]| {
            let [a, b] = [pair[0], pair[1]].map(|at| [at[0] - x, at[1] - y]);
            a[0] * b[1] - a[1] * b[0]
        };
        0.5 * ring.windows(2).map(cross).sum::<f64>().abs()
    };
    let mut sizes = rings.iter().map(|ring| of(ring));
    sizes.next().unwrap_or(0.0) - sizes.sum::<f64>()
}

impl Resource {
    /// With places on the ground that lie in no building, neither before nor after a change.
    pub(super) fn new(area: Area, cell: f64, before: &City, after: &City) -> Self {
        let [from, to] = area.within.bounds();
        let grid = Grid::within(from, to, cell).unwrap_or_else(|error| {
            wrong_usage(&format!("--cell: {}: {error}", area.name));
        });
        let ground = Ground::new(before);
        let [inside, inside_after] = [before, after].map(Inside::new);
        let contains = |at| area.within.contains(at);
        let stays_free = |at| {
            let place = ground.at(at);
            place.is_some_and(|place| !inside_after.contains(place))
        };
        let tiles = Tiles::on_ground(before, &grid, |at| contains(at) && stays_free(at));
        let (mut cells, mut in_buildings) = (0, 0);
        for row in 0..grid.height {
            for at in (0..grid.width).map(|column| grid.centre(column, row)) {
                if contains(at) {
                    cells += 1;
                    let place = ground.at(at);
                    in_buildings += usize::from(place.is_none_or(|place| inside.contains(place)));
                }
            }
        }
        let built_over = cells - in_buildings - tiles.places().len();
        Self {
            area,
            grid,
            cells,
            in_buildings,
            built_over,
            tiles,
        }
    }

    /// Places that are measured.
    pub(super) fn places(&self) -> usize {
        self.tiles.places().len()
    }

    /// The square metres for which a place stands.
    pub(super) fn each(&self) -> f64 {
        self.area.size / self.cells.max(1) as f64
    }

    /// The square metres that all places stand for: of the area without what buildings stand on.
    pub(super) fn open(&self) -> f64 {
        self.each() * self.places() as f64
    }

    /// Why there is nothing to be measured, if so.
    pub(super) fn nothing(&self) -> Option<String> {
        let Self { area, grid, .. } = self;
        if self.cells == 0 {
            return Some(format!(
                "no place of the grid of {} m lies in its {:.1} m²: take smaller cells (--cell)",
                grid.cell, area.size
            ));
        }
        (self.places() == 0).then(|| match self.built_over {
            0 => "lies wholly in buildings".to_owned(),
            _ => "lies wholly in buildings once the change is built".to_owned(),
        })
    }

    /// What is worth to be told of its places.
    pub(super) fn finding(&self) -> Option<String> {
        if let Some(nothing) = self.nothing() {
            return Some(format!("{}: {nothing}; it is not measured", self.area.name));
        }
        (self.built_over > 0).then(|| {
            format!(
                "{}: the change is built over {:.1} % of its open area, which is left out",
                self.area.name,
                100.0 * self.built_over as f64 / (self.places() + self.built_over) as f64
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_those_of_rings_less_holes() {
        let square = |at: f64, side: f64| {
            let corners = [
                [0.0, 0.0],
                [side, 0.0],
                [side, side],
                [0.0, side],
                [0.0, 0.0],
            ];
            corners.map(|[x, y]| [x + at, y + at]).to_vec()
        };
        assert_eq!(size(&[square(1e5, 10.0)]), 100.0);
        let mut hole = square(1e5 + 1.0, 2.0);
        assert_eq!(size(&[square(1e5, 10.0), hole.clone()]), 96.0);
        hole.reverse();
        assert_eq!(size(&[square(1e5, 10.0), hole]), 96.0);
        assert_eq!(size(&[]), 0.0);
        assert_eq!(size(&[vec![]]), 0.0);
    }

    #[test]
    fn names_tell_areas_apart() {
        let area = |name: Option<&str>, place: &str| NamedArea {
            name: name.map(str::to_owned),
            place: place.to_owned(),
            polygons: Vec::new(),
        };
        let all = [
            area(Some("Park"), "feature 0"),
            area(Some("Green"), "feature 1"),
            area(Some("Park"), "feature 2"),
            area(None, "feature 3"),
            area(Some(" "), "feature 4"),
        ];
        let expected = [
            "Park (feature 0)",
            "Green",
            "Park (feature 2)",
            "feature 3",
            "feature 4",
        ];
        assert_eq!(names(&all), expected);
    }
}
