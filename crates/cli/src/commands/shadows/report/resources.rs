//! What a rule protects: areas of a file, and the places that stand for them.

use std::path::Path;

use anyhow::{Context as _, bail};
use ombra::accrual::{Ground, Tiles};
use ombra::city::{City, Extent, Grid, Inside, Origin, StudyArea, area_of};
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
    /// Square metres, those that several polygons cover counted once.
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
            size: area_of(&polygons),
            polygons,
            within,
        });
    }
    Ok(areas)
}

/// What each is called; those of the same name are told apart by their places in the file.
fn names(areas: &[NamedArea]) -> Vec<String> {
    let own = areas.iter().map(|area| area.name.as_deref());
    let own: Vec<&str> = own.map(|name| name.unwrap_or_default().trim()).collect();
    let called = |(area, &name): (&NamedArea, &&str)| {
        let is_shared = || own.iter().filter(|&&other| other == name).count() > 1;
        match name {
            "" => area.place.clone(),
            _ if is_shared() => format!("{name} ({})", area.place),
            _ => name.to_owned(),
        }
    };
    areas.iter().zip(&own).map(called).collect()
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
        if area.size <= 0.0 {
            return Some(
                "encloses nothing: its rings lie on themselves or on one another".to_owned(),
            );
        }
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
            area(Some(" Green "), "feature 5"),
        ];
        let expected = [
            "Park (feature 0)",
            "Green (feature 1)",
            "Park (feature 2)",
            "feature 3",
            "feature 4",
            "Green (feature 5)",
        ];
        assert_eq!(names(&all), expected);
    }
}
